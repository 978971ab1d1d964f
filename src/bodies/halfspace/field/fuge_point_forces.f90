!> Stresses and displacements under point forces on the surface of an elastic half-space.
!>
!> Source: J. Boussinesq 1885; K. L. Johnson, Contact Mechanics, 1985, equations 3.18 and 3.19. Johnson's factor
!> (1 - z/r)/rho**2 is written as 1/(r (r + z)), so that no digits are lost below the force.
module fuge_point_forces
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_force_displacements, add_force_stresses, finish_displacement, finish_stress

  !> Fewer points than this are no lanes.
  integer, parameter :: FEW = 4
  !> Forces that are taken as lanes at once.
  integer, parameter :: LANES = 64

contains

  !> Add the sums over forces at `source_x`, `source_y` (n) from which `finish_stress` makes the stresses at points
  !> `x`, `y`, `z` (m).
  !>
  !> `force` (n); `poisson` Poisson's ratio; `sums` (m, 6). No point may be that of a force. Lengths have exponents of
  !> at most 60 or so, which keeps their powers in range. Compilers vectorise a sum only if its order stays the same:
  !> so the inner loop runs over the points, and if these are few, over forces as if they were points.
  pure subroutine add_force_stresses(source_x, source_y, force, poisson, x, y, z, sums)
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:), z(:)
    real(dp), intent(in) :: poisson
    real(dp), intent(inout), contiguous :: sums(:, :)
    real(dp) :: lane(LANES, 6), seen_x(LANES), seen_y(LANES), depth(LANES)
    integer :: first, i, n

    if (.not. maxval(z) > 0.0_dp) then
      call add_surface_stresses(source_x, source_y, force, poisson, x, y, sums)
      return
    else if (size(x) >= FEW) then
      call add_stress_lanes(source_x, source_y, force, poisson, size(x), x, y, z, sums)
      return
    end if
    do i = 1, size(x)
      depth = z(i)
      do first = 1, size(force), LANES
        n = min(LANES, size(force) - first + 1)
        seen_x(:n) = x(i) - source_x(first:first + n - 1)
        seen_y(:n) = y(i) - source_y(first:first + n - 1)
        lane(:n, :) = 0.0_dp
        call add_stress_lanes([0.0_dp], [0.0_dp], [1.0_dp], poisson, n, seen_x, seen_y, depth, lane)
        sums(i, :6) = sums(i, :6) + matmul(force(first:first + n - 1), lane(:n, :))
      end do
    end do
  end subroutine add_force_stresses

  !> The same for points on the surface, where only xx, yy = -xx and xy are left.
  pure subroutine add_surface_stresses(source_x, source_y, force, poisson, x, y, sums)
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:)
    real(dp), intent(in) :: poisson
    real(dp), intent(inout), contiguous :: sums(:, :)
    real(dp) :: dx, dy, factor, inverse, normal
    integer :: i, j

    do j = 1, size(force)
      factor = (1.0_dp - 2.0_dp*poisson)*force(j)
      do i = 1, size(x)
        dx = x(i) - source_x(j)
        dy = y(i) - source_y(j)
        inverse = 1.0_dp/(dx**2 + dy**2)
        normal = factor*inverse**2*((dx - dy)*(dx + dy))
        sums(i, 1) = sums(i, 1) + normal
        sums(i, 2) = sums(i, 2) - normal
        sums(i, 6) = sums(i, 6) + 2.0_dp*factor*inverse**2*(dx*dy)
      end do
    end do
  end subroutine add_surface_stresses

  !> The same for the first `n` points. The arguments are nine, because the lanes of a vector processor are plain
  !> arrays.
  pure subroutine add_stress_lanes(source_x, source_y, force, poisson, n, x, y, z, sums)
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:), z(:)
    real(dp), intent(in) :: poisson
    integer, intent(in) :: n
    real(dp), intent(inout), contiguous :: sums(:, :)
    real(dp) :: dx, dy, compressible, square, r, quotient, inverse, inverse_square, inverse_cube, part, cross, even
    integer :: i, j

    compressible = 1.0_dp - 2.0_dp*poisson
    do j = 1, size(force)
      do i = 1, n
        dx = x(i) - source_x(j)
        dy = y(i) - source_y(j)
        square = dx**2 + dy**2 + z(i)**2
        r = sqrt(square)
        ! One division for 1/r**2 and for 1/(r (r + z)).
        quotient = 1.0_dp/(square*(r + z(i)))
        inverse_square = quotient*(r + z(i))
        inverse = r*inverse_square
        inverse_cube = inverse*inverse_square
        part = r*quotient
        cross = force(j)*inverse_cube*inverse_square
        even = compressible*force(j)*(z(i)*inverse_cube - part)
        sums(i, 3) = sums(i, 3) + cross
        sums(i, 4) = sums(i, 4) + cross*dy
        sums(i, 5) = sums(i, 5) + cross*dx
        cross = compressible*force(j)*(2.0_dp*r + z(i))*inverse*part**2 - 3.0_dp*z(i)*cross
        sums(i, 1) = sums(i, 1) + (even + cross*dx**2)
        sums(i, 2) = sums(i, 2) + (even + cross*dy**2)
        sums(i, 6) = sums(i, 6) + cross*(dx*dy)
      end do
    end do
  end subroutine add_stress_lanes

  !> The stresses xx, yy, zz, yz, xz, xy at depth `z` from the sums of `add_force_stresses`.
  pure function finish_stress(sums, z) result(stress)
    real(dp), intent(in) :: sums(6), z
    real(dp) :: stress(6)

    stress = sums*(0.5_dp/PI)
    stress(3) = -3.0_dp*z**3*stress(3)
    stress(4:5) = -3.0_dp*z**2*stress(4:5)
  end function finish_stress

  !> Add the sums over forces from which `finish_displacement` makes the displacements; as `add_force_stresses`, with
  !> `sums` (m, 3), or more columns, which stay.
  pure subroutine add_force_displacements(source_x, source_y, force, poisson, x, y, z, sums)
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:), z(:)
    real(dp), intent(in) :: poisson
    real(dp), intent(inout), contiguous :: sums(:, :)
    real(dp) :: lane(LANES, 3), seen_x(LANES), seen_y(LANES), depth(LANES)
    integer :: first, i, n

    if (size(x) >= FEW) then
      call add_displacement_lanes(source_x, source_y, force, poisson, size(x), x, y, z, sums)
      return
    end if
    do i = 1, size(x)
      depth = z(i)
      do first = 1, size(force), LANES
        n = min(LANES, size(force) - first + 1)
        seen_x(:n) = x(i) - source_x(first:first + n - 1)
        seen_y(:n) = y(i) - source_y(first:first + n - 1)
        lane(:n, :) = 0.0_dp
        call add_displacement_lanes([0.0_dp], [0.0_dp], [1.0_dp], poisson, n, seen_x, seen_y, depth, lane)
        sums(i, :3) = sums(i, :3) + matmul(force(first:first + n - 1), lane(:n, :))
      end do
    end do
  end subroutine add_force_displacements

  !> The same for the first `n` points. The arguments are nine, because the lanes of a vector processor are plain
  !> arrays.
  pure subroutine add_displacement_lanes(source_x, source_y, force, poisson, n, x, y, z, sums)
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:), z(:)
    real(dp), intent(in) :: poisson
    integer, intent(in) :: n
    real(dp), intent(inout), contiguous :: sums(:, :)
    real(dp) :: dx, dy, compressible, stiff, square, r, quotient, inverse_square, inverse, radial
    integer :: i, j

    compressible = 1.0_dp - 2.0_dp*poisson
    stiff = 2.0_dp*(1.0_dp - poisson)
    do j = 1, size(force)
      do i = 1, n
        dx = x(i) - source_x(j)
        dy = y(i) - source_y(j)
        square = dx**2 + dy**2 + z(i)**2
        r = sqrt(square)
        quotient = 1.0_dp/(square*(r + z(i)))
        inverse_square = quotient*(r + z(i))
        inverse = r*inverse_square
        radial = force(j)*(z(i)*inverse*inverse_square - compressible*r*quotient)
        sums(i, 1) = sums(i, 1) + radial*dx
        sums(i, 2) = sums(i, 2) + radial*dy
        sums(i, 3) = sums(i, 3) + force(j)*inverse*(z(i)**2*inverse_square + stiff)
      end do
    end do
  end subroutine add_displacement_lanes

  !> Young's modulus times the displacements along x, y, z, from the sums of `add_force_displacements`.
  pure function finish_displacement(sums, poisson) result(displacement)
    real(dp), intent(in) :: sums(3), poisson
    real(dp) :: displacement(3)

    displacement = sums*((1.0_dp + poisson)*(0.5_dp/PI))
  end function finish_displacement

end module fuge_point_forces
