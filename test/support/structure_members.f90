!> Stiffness matrices of members: bars, beams in a plane and beams of a grillage.
module structure_members
  use fuge_kinds, only: dp
  implicit none
  private

  public :: bar, bar_direction, frame_beam, grillage_beam

contains

  !> Unit vector from one end to the other, for the displacements of both: the elongation is `bar_direction` times
  !> (u_1, v_1, u_2, v_2).
  pure function bar_direction(from, to) result(direction)
    real(dp), intent(in) :: from(2), to(2)
    real(dp) :: direction(4)

    direction(3:) = (to - from)/norm2(to - from)
    direction(:2) = -direction(3:)
  end function bar_direction

  !> A bar of this axial stiffness EA, displacements (u_1, v_1, u_2, v_2).
  pure function bar(from, to, axial) result(member)
    real(dp), intent(in) :: from(2), to(2), axial
    real(dp) :: member(4, 4), direction(4)
    integer :: k

    direction = bar_direction(from, to)
    do k = 1, 4
      member(:, k) = axial/norm2(to - from)*direction*direction(k)
    end do
  end function bar

  !> A beam in bending: deflections and slopes (w_1, w_1', w_2, w_2').
  pure function bending(length, bending_stiffness) result(member)
    real(dp), intent(in) :: length, bending_stiffness
    real(dp) :: member(4, 4)

    associate (h => length)
      member = bending_stiffness/h**3*reshape([ &
        12.0_dp, 6*h, -12.0_dp, 6*h, 6*h, 4*h**2, -6*h, 2*h**2, &
        -12.0_dp, -6*h, 12.0_dp, -6*h, 6*h, 2*h**2, -6*h, 4*h**2], [4, 4])
    end associate
  end function bending

  !> A beam in a plane, displacements and rotation of each end (u_1, v_1, t_1, u_2, v_2, t_2).
  pure function frame_beam(from, to, axial, bending_stiffness) result(member)
    real(dp), intent(in) :: from(2), to(2), axial, bending_stiffness
    real(dp) :: member(6, 6), turn(4, 6), direction(2)
    integer, parameter :: ENDS(4) = [1, 2, 4, 5]

    direction = (to - from)/norm2(to - from)
    turn = 0.0_dp
    turn(1, :2) = [-direction(2), direction(1)]
    turn(2, 3) = 1.0_dp
    turn(3, 4:5) = [-direction(2), direction(1)]
    turn(4, 6) = 1.0_dp
    member = matmul(transpose(turn), matmul(bending(norm2(to - from), bending_stiffness), turn))
    member(ENDS, ENDS) = member(ENDS, ENDS) + bar(from, to, axial)
  end function frame_beam

  !> A beam of a grillage along its axis: deflection, slope and twist of each end (w_1, s_1, r_1, w_2, s_2, r_2).
  pure function grillage_beam(length, bending_stiffness, torsion) result(member)
    real(dp), intent(in) :: length, bending_stiffness, torsion
    real(dp) :: member(6, 6)
    integer, parameter :: BENT(4) = [1, 2, 4, 5]

    member = 0.0_dp
    member(BENT, BENT) = bending(length, bending_stiffness)
    member([3, 6], [3, 6]) = torsion/length*reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2])
  end function grillage_beam

end module structure_members
