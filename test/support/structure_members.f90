!> Stiffness matrices of members: bars, beams in a plane, beams of a grillage and a rectangular plate.
module structure_members
  use fuge, only: dp => fuge_dp
  use general_reference, only: eliminate
  implicit none
  private

  public :: bar, bar_direction, frame_beam, grillage_beam, plate

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

  !> A rectangular thin plate of a by b with the cubic polynomials of Adini, Clough and Melosh: deflection and slopes
  !> (w, dw/dx, dw/dy) of the corners (0, 0), (a, 0), (0, b), (a, b). `rigidity` is E t^3/(12 (1 - poisson^2)).
  pure function plate(a, b, rigidity, poisson) result(member)
    real(dp), intent(in) :: a, b, rigidity, poisson
    real(dp) :: member(12, 12)
    real(dp) :: corners(12, 12), curvature(3, 12), law(3, 3), inner(12, 12), shapes(12, 12), unit(12), x, y
    real(dp), parameter :: PLACES(3) = [-sqrt(0.6_dp), 0.0_dp, sqrt(0.6_dp)]
    real(dp), parameter :: WEIGHTS(3) = [5.0_dp, 8.0_dp, 5.0_dp]/18.0_dp
    logical :: regular
    integer :: j, k

    ! Lengths in units of the sides, so that the polynomials are of one size.
    do k = 1, 4
      x = real(mod(k - 1, 2), dp)
      y = real((k - 1)/2, dp)
      corners(3*k - 2, :) = polynomials(x, y)
      corners(3*k - 1, :) = along_x(x, y)/a
      corners(3*k, :) = along_y(x, y)/b
    end do
    law = rigidity*reshape([1.0_dp, poisson, 0.0_dp, poisson, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                            0.5_dp*(1.0_dp - poisson)], [3, 3])
    inner = 0.0_dp
    do j = 1, 3
      do k = 1, 3
        x = 0.5_dp*(1.0_dp + PLACES(j))
        y = 0.5_dp*(1.0_dp + PLACES(k))
        curvature = curvatures(x, y, a, b)
        inner = inner + WEIGHTS(j)*WEIGHTS(k)*a*b*matmul(transpose(curvature), matmul(law, curvature))
      end do
    end do
    do k = 1, 12
      unit = 0.0_dp
      unit(k) = 1.0_dp
      call eliminate(corners, unit, shapes(:, k), regular)
    end do
    member = matmul(transpose(shapes), matmul(inner, shapes))
  end function plate

  pure function polynomials(x, y) result(values)
    real(dp), intent(in) :: x, y
    real(dp) :: values(12)

    values = [1.0_dp, x, y, x*x, x*y, y*y, x**3, x*x*y, x*y*y, y**3, x**3*y, x*y**3]
  end function polynomials

  pure function along_x(x, y) result(values)
    real(dp), intent(in) :: x, y
    real(dp) :: values(12)

    values = [0.0_dp, 1.0_dp, 0.0_dp, 2*x, y, 0.0_dp, 3*x*x, 2*x*y, y*y, 0.0_dp, 3*x*x*y, y**3]
  end function along_x

  pure function along_y(x, y) result(values)
    real(dp), intent(in) :: x, y
    real(dp) :: values(12)

    values = [0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, x, 2*y, 0.0_dp, x*x, 2*x*y, 3*y*y, x**3, 3*x*y*y]
  end function along_y

  !> w_xx, w_yy and 2 w_xy of the polynomials.
  pure function curvatures(x, y, a, b) result(values)
    real(dp), intent(in) :: x, y, a, b
    real(dp) :: values(3, 12)

    values(1, :) = [0.0_dp, 0.0_dp, 0.0_dp, 2.0_dp, 0.0_dp, 0.0_dp, 6*x, 2*y, 0.0_dp, 0.0_dp, 6*x*y, 0.0_dp]/a**2
    values(2, :) = [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 2.0_dp, 0.0_dp, 0.0_dp, 2*x, 6*y, 0.0_dp, 6*x*y]/b**2
    values(3, :) = 2.0_dp*[0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 2*x, 2*y, 0.0_dp, 3*x*x, &
                           3*y*y]/(a*b)
  end function curvatures

end module structure_members
