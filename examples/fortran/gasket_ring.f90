!> The flange ring of the example `gasket`: beam elements around the circle, condensed to its stations.
!>
!> A station has three degrees of freedom: the deflection upwards, the slope along the ring, and the twist. Elements are
!> straight from station to station, with bending stiffness EI out of the plane of the ring and torsional stiffness GJ.
module gasket_ring
  use fuge, only: dp => fuge_dp, fuge_body, fuge_condense, fuge_condensed, fuge_dense_stiffness, fuge_info
  implicit none
  private

  public :: condense_ring

  real(dp), parameter :: PI = acos(-1.0_dp)

  type, public :: flange_ring
    !> Radius of the circle through gasket and bolts.
    real(dp) :: radius = 0.0_dp
    !> EI and GJ, force times length squared.
    real(dp) :: bending = 0.0_dp, torsion = 0.0_dp
    !> Straightened to a beam of the same length, whose ends go on into each other; it does not twist.
    logical :: straight = .false.
  end type flange_ring

contains

  !> The ring as a floating body with contact at `stations` stations, and the load 1, upwards, along all of it.
  subroutine condense_ring(ring, stations, condensed, info)
    type(flange_ring), intent(in) :: ring
    integer, intent(in) :: stations
    type(fuge_condensed), intent(out) :: condensed
    type(fuge_info), intent(out) :: info
    real(dp), target :: matrix(3*stations, 3*stations)
    real(dp) :: element(6, 6)
    type(fuge_dense_stiffness) :: stiffness
    type(fuge_body) :: body
    integer :: dof(6), k

    matrix = 0.0_dp
    element = element_stiffness(ring, stations)
    do k = 0, stations - 1
      dof = [3*k + [1, 2, 3], 3*modulo(k + 1, stations) + [1, 2, 3]]
      matrix(dof, dof) = matrix(dof, dof) + element
    end do
    call stiffness%set(matrix, info)
    if (info%failed()) return
    body%floats = .true.
    if (ring%straight) body%fixed = [3]
    ! The gasket below pushes upwards.
    body%dof = reshape([(3*k - 2, k=1, stations)], [1, stations])
    body%normal = reshape([(1.0_dp, k=1, stations)], [1, stations])
    body%load = reshape(spread([1.0_dp/real(stations, dp), 0.0_dp, 0.0_dp], 2, stations), [3*stations])
    call fuge_condense(stiffness, body, condensed, info)
  end subroutine condense_ring

  !> A beam between two stations whose tangents differ by the angle `turn`; the chord is at half of it to each.
  pure function element_stiffness(ring, stations) result(element)
    type(flange_ring), intent(in) :: ring
    integer, intent(in) :: stations
    real(dp) :: element(6, 6)
    real(dp) :: length, turn, turned(6, 6)

    turn = 2.0_dp*PI/real(stations, dp)
    length = 2.0_dp*ring%radius*sin(0.5_dp*turn)
    if (ring%straight) then
      length = ring%radius*turn
      turn = 0.0_dp
    end if
    turned = 0.0_dp
    turned(:3, :3) = to_chord(0.5_dp*turn)
    turned(4:, 4:) = to_chord(-0.5_dp*turn)
    element = matmul(transpose(turned), matmul(straight_stiffness(length, ring%bending, ring%torsion), turned))
  end function element_stiffness

  !> From deflection, slope and twist of a station to those along a line at `angle` to its tangent.
  pure function to_chord(angle) result(rotation)
    real(dp), intent(in) :: angle
    real(dp) :: rotation(3, 3)

    rotation = 0.0_dp
    rotation(1, 1) = 1.0_dp
    rotation(2, 2:) = [cos(angle), sin(angle)]
    rotation(3, 2:) = [-sin(angle), cos(angle)]
  end function to_chord

  pure function straight_stiffness(length, bending, torsion) result(element)
    real(dp), intent(in) :: length, bending, torsion
    real(dp) :: element(6, 6)
    integer, parameter :: BENT(4) = [1, 2, 4, 5], TWISTED(2) = [3, 6]

    element = 0.0_dp
    element(BENT, BENT) = bending/length**3*reshape( &
      [12.0_dp, 6.0_dp*length, -12.0_dp, 6.0_dp*length, &
       6.0_dp*length, 4.0_dp*length**2, -6.0_dp*length, 2.0_dp*length**2, &
       -12.0_dp, -6.0_dp*length, 12.0_dp, -6.0_dp*length, &
       6.0_dp*length, 2.0_dp*length**2, -6.0_dp*length, 4.0_dp*length**2], [4, 4])
    element(TWISTED, TWISTED) = torsion/length*reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2])
  end function straight_stiffness

end module gasket_ring
