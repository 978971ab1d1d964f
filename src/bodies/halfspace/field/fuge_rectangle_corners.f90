!> Stresses and displacements under uniform pressure on a rectangle, in closed form.
!>
!> With X and Y the distances of the point from the edges, r**2 = X**2 + Y**2 + z**2, and D the difference over the
!> corners, they are sums of D of z X Y/(r (X**2 + z**2)), z**2 Y/(r (X**2 + z**2)), z/r, ln(r + z), and of the angles
!>
!>     A = atan(X Y/(z r)),  F = atan(Y/X) - atan(z Y/(X r)) = atan(X Y (r - z)/(X**2 r + z Y**2)).
!>
!> D A is the solid angle of the rectangle, and A - F is F with X and Y exchanged. Source: A. E. H. Love, The stress
!> produced in a semi-infinite solid by pressure on part of the boundary, Phil. Trans. R. Soc. A 228, 1929;
!> K. L. Johnson, Contact Mechanics, 1985, section 3.4.
module fuge_rectangle_corners
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: corner_displacement, corner_stress

  !> Terms that all formulas share: of the corners (i, j), the angles A and F, r and r + z.
  type :: corner_angles
    real(dp) :: solid(2, 2) = 0.0_dp, first(2, 2) = 0.0_dp, r(2, 2) = 0.0_dp, sum(2, 2) = 0.0_dp
  end type corner_angles

contains

  !> Stresses xx, yy, zz, yz, xz, xy under unit pressure on a rectangle.
  !>
  !> `x`, `y` (2): the point minus the edges, x(1) < x(2), length; `z` >= 0 depth; `poisson` Poisson's ratio. On the
  !> surface, zz is the mean of the values around the point, -1/2 at an edge and -1/4 at a corner, and xz and yz are
  !> zero. The logarithm of a corner at the point itself is replaced by `corner_log`: there xy is infinite, and finite
  !> only together with that of equally loaded neighbours.
  pure function corner_stress(x, y, z, poisson, corner_log) result(stress)
    real(dp), intent(in) :: x(2), y(2), z, poisson, corner_log
    real(dp) :: stress(6)
    type(corner_angles) :: angles
    real(dp) :: solid, first, compressible, along_x, along_y
    integer :: i, j

    angles = angles_at(x, y, z)
    solid = difference(angles%solid)
    first = difference(angles%first)
    compressible = 1.0_dp - 2.0_dp*poisson
    stress = 0.0_dp
    along_x = 0.0_dp
    along_y = 0.0_dp
    if (z > 0.0_dp) then
      do j = 1, 2
        do i = 1, 2
          call add_corner(x(i), y(j), z, angles%r(i, j), merge(1.0_dp, -1.0_dp, i == j), along_x, along_y, stress)
        end do
      end do
    end if
    stress(1) = along_x - 2.0_dp*poisson*solid - compressible*first
    stress(2) = along_y - 2.0_dp*poisson*solid - compressible*(solid - first)
    stress(3) = -(solid + along_x + along_y)
    stress(6) = stress(6) - compressible*corner_logarithm(angles%sum, corner_log)
    stress = stress*(0.5_dp/PI)
  end function corner_stress

  !> Add the algebraic terms of a corner at (`x`, `y`), with the `sign` of the corner: those of xx and of yy to
  !> `along_x` and `along_y`, those of the shear stresses to `stress`.
  pure subroutine add_corner(x, y, z, r, sign, along_x, along_y, stress)
    real(dp), intent(in) :: x, y, z, r, sign
    real(dp), intent(inout) :: along_x, along_y, stress(6)
    real(dp) :: of_x, of_y

    ! Quotients, so that no square of a small depth is lost.
    of_x = sign*(y/r)*(z/hypot(x, z))
    of_y = sign*(x/r)*(z/hypot(y, z))
    along_x = along_x + of_x*(x/hypot(x, z))
    along_y = along_y + of_y*(y/hypot(y, z))
    stress(4) = stress(4) + of_y*(z/hypot(y, z))
    stress(5) = stress(5) + of_x*(z/hypot(x, z))
    stress(6) = stress(6) - sign*(z/r)
  end subroutine add_corner

  !> Young's modulus times the displacements along x, y, z under unit pressure on a rectangle; arguments as for
  !> `corner_stress`.
  pure function corner_displacement(x, y, z, poisson) result(displacement)
    real(dp), intent(in) :: x(2), y(2), z, poisson
    real(dp) :: displacement(3)
    type(corner_angles) :: angles
    real(dp) :: along_x(2), along_y(2), compressible
    integer :: k

    angles = angles_at(x, y, z)
    do k = 1, 2
      along_y(k) = line_potential(y, angles%r(k, :), hypot(x(k), z))
      along_x(k) = line_potential(x, angles%r(:, k), hypot(y(k), z))
    end do
    compressible = 1.0_dp - 2.0_dp*poisson
    displacement(1) = -compressible*(log_moment(y, angles%sum) + moment(x, angles%first)) &
                      - 2.0_dp*(1.0_dp - poisson)*(z*(along_y(2) - along_y(1)))
    displacement(2) = -compressible*(log_moment(x, transpose(angles%sum)) &
                                     + moment(y, transpose(angles%solid - angles%first))) &
                      - 2.0_dp*(1.0_dp - poisson)*(z*(along_x(2) - along_x(1)))
    displacement(3) = 2.0_dp*(1.0_dp - poisson)*((x(2)*along_y(2) - x(1)*along_y(1)) &
                                                 + (y(2)*along_x(2) - y(1)*along_x(1))) &
                      - compressible*(z*difference(angles%solid))
    displacement = displacement*((1.0_dp + poisson)*(0.5_dp/PI))
  end function corner_displacement

  pure function angles_at(x, y, z) result(angles)
    real(dp), intent(in) :: x(2), y(2), z
    type(corner_angles) :: angles
    real(dp) :: flat
    integer :: i, j

    do j = 1, 2
      do i = 1, 2
        flat = hypot(x(i), y(j))
        angles%r(i, j) = hypot(flat, z)
        angles%sum(i, j) = angles%r(i, j) + z
        ! Zero on the lines of the edges: the mean of both sides where it jumps.
        if (.not. abs(x(i)*y(j)) > 0.0_dp) cycle
        angles%solid(i, j) = atan2(x(i)*y(j), z*angles%r(i, j))
        angles%first(i, j) = atan2((x(i)*y(j))*(flat*(flat/angles%sum(i, j))), x(i)**2*angles%r(i, j) + z*y(j)**2)
      end do
    end do
  end function angles_at

  !> D, the difference over the corners.
  pure function difference(values) result(d)
    real(dp), intent(in) :: values(2, 2)
    real(dp) :: d

    d = (values(2, 2) - values(1, 2)) - (values(2, 1) - values(1, 1))
  end function difference

  !> D of `values` times `x`, which belongs to the first index.
  pure function moment(x, values) result(d)
    real(dp), intent(in) :: x(2), values(2, 2)
    real(dp) :: d

    d = x(2)*(values(2, 2) - values(2, 1)) - x(1)*(values(1, 2) - values(1, 1))
  end function moment

  !> D of ln(r + z), with `corner_log` instead of the logarithm of 0.
  pure function corner_logarithm(sums, corner_log) result(d)
    real(dp), intent(in) :: sums(2, 2), corner_log
    real(dp) :: d
    integer :: i, j

    d = 0.0_dp
    if (minval(sums) > sqrt(tiny(d))) then
      d = log((sums(2, 2)/sums(1, 2))*(sums(1, 1)/sums(2, 1)))
      return
    end if
    do j = 1, 2
      do i = 1, 2
        if (sums(i, j) > 0.0_dp) then
          d = d + merge(1.0_dp, -1.0_dp, i == j)*log(sums(i, j))
        else
          d = d + merge(1.0_dp, -1.0_dp, i == j)*corner_log
        end if
      end do
    end do
  end function corner_logarithm

  !> D of Y ln(r + z), which is zero at a corner.
  pure function log_moment(y, sums) result(d)
    real(dp), intent(in) :: y(2), sums(2, 2)
    real(dp) :: d

    d = 0.0_dp
    if (abs(y(2)) > 0.0_dp) d = y(2)*log_ratio(sums(2, 2), sums(1, 2))
    if (abs(y(1)) > 0.0_dp) d = d - y(1)*log_ratio(sums(2, 1), sums(1, 1))
  end function log_moment

  !> ln(r + Y) at `y`(2) less that at `y`(1), the potential of an edge; `r` (2), and `distance` from its line. Zero on
  !> the line, where it is multiplied by zero.
  pure function line_potential(y, r, distance) result(potential)
    real(dp), intent(in) :: y(2), r(2), distance
    real(dp) :: potential

    potential = 0.0_dp
    if (.not. distance > 0.0_dp) return
    if (y(1) > 0.0_dp) then
      potential = log_ratio(r(2) + y(2), r(1) + y(1))
    else if (y(2) < 0.0_dp) then
      potential = log_ratio(r(1) - y(1), r(2) - y(2))
    else
      potential = log_ratio(r(2) + y(2), distance) + log_ratio(r(1) - y(1), distance)
    end if
  end function line_potential

  !> ln(a/b) of numbers that may be so small that the quotient overflows.
  pure function log_ratio(a, b) result(value)
    real(dp), intent(in) :: a, b
    real(dp) :: value

    if (min(a, b) > sqrt(tiny(a))) then
      value = log(a/b)
    else
      value = log(a) - log(b)
    end if
  end function log_ratio

end module fuge_rectangle_corners
