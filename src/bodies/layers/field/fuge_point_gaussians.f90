!> Gaussians of many lengths averaged over loads, strips of a line or rectangles of an area, at one point: what a
!> mixture needs there.
!>
!> Gaussians far shorter than the distance of a load vanish; those far longer than all distances are the first terms of
!> their series, whose sums over all lengths are known.
module fuge_point_gaussians
  use fuge_constants, only: PI
  use fuge_depth_mixture, only: depth_mixture, NEGLIGIBLE, POWERS, STEP
  use fuge_kinds, only: dp
  use fuge_pressed_area, only: pressed_area
  implicit none
  private

  !> Derivatives along x and y: none, x, y, minus xx, minus yy, and minus xy.
  integer, parameter, public :: PLAIN = 1, SLOPE_X = 2, SLOPE_Y = 3, CURVE_X = 4, CURVE_Y = 5, TWIST = 6
  integer, parameter :: DERIVATIVES = 6
  integer, parameter :: ORDERS(2, DERIVATIVES) = reshape([0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 1, 1], [2, DERIVATIVES])
  !> Terms of the series of long Gaussians, in 1/t**2, after the first one; they count as long from FAR times the
  !> greatest distance on.
  integer, parameter :: TERMS = 3
  real(dp), parameter :: FAR = 60.0_dp
  !> Terms of a series below this share are rounding.
  real(dp), parameter :: ROUNDING = 1.0e-17_dp

  !> Strips of a line or rectangles of an area, and their forces.
  type, public :: point_loads
    !> Lengths are the caller's over 2**unit, forces over 2**force_unit.
    integer :: unit = 0, force_unit = 0
    !> Centres and half widths, (directions, loads); forces, (loads).
    real(dp), allocatable :: centre(:, :), half(:, :), force(:)
  contains
    procedure :: take_area
    procedure :: take_line
  end type point_loads

  !> Sums over all loads at a point.
  type, public :: point_gaussians
    !> Lengths are the caller's over 2**unit, forces over 2**force_unit.
    integer :: unit = 0, force_unit = 0, directions = 0
    !> Lengths number first, first + 1, .., the sums for them, (lengths, derivatives), and coefficients of the series of
    !> longer ones, (0:, derivatives).
    integer :: first = 0
    real(dp), allocatable :: t(:), near(:, :)
    real(dp) :: series(0:TERMS, DERIVATIVES) = 0.0_dp
  contains
    procedure :: add_up
    procedure :: value
    procedure :: line_datum
  end type point_gaussians

contains

  !> Take the rectangles of an area. `stat` as in an allocate statement.
  pure subroutine take_area(self, area, stat)
    class(point_loads), intent(inout) :: self
    type(pressed_area), intent(in) :: area
    integer, intent(out) :: stat

    allocate (self%centre(2, area%count), self%half(2, area%count), self%force(area%count), stat=stat)
    if (stat /= 0) return
    self%unit = area%unit
    self%force_unit = area%force_unit
    self%centre(1, :) = area%x(:area%count)
    self%centre(2, :) = area%y(:area%count)
    self%half(1, :) = area%half_x(:area%count)
    self%half(2, :) = area%half_y(:area%count)
    self%force = area%force(:area%count)
  end subroutine take_area

  !> Take strips with their images about x = 0 if they are `symmetric`. `stat` as in an allocate statement.
  pure subroutine take_line(self, x, width, force, symmetric, stat)
    class(point_loads), intent(inout) :: self
    real(dp), intent(in) :: x(:), width(:), force(:)
    logical, intent(in) :: symmetric
    integer, intent(out) :: stat
    integer :: image, images, j, n

    images = merge(2, 1, symmetric)
    n = images*count(abs(force) > 0.0_dp)
    allocate (self%centre(1, n), self%half(1, n), self%force(n), stat=stat)
    if (stat /= 0 .or. n == 0) return
    self%unit = exponent(maxval(abs(x) + width))
    self%force_unit = exponent(maxval(abs(force)))
    n = 0
    do j = 1, size(x)
      if (.not. abs(force(j)) > 0.0_dp) cycle
      do image = 1, images
        n = n + 1
        self%centre(1, n) = scale(merge(x(j), -x(j), image == 1), -self%unit)
        self%half(1, n) = scale(width(j), -self%unit - 1)
        self%force(n) = scale(force(j), -self%force_unit)/real(images, dp)
      end do
    end do
  end subroutine take_line

  !> The sums at the `place` (directions), in the caller's lengths, for lengths from number `first` on. `stat` as in an
  !> allocate statement.
  pure subroutine add_up(self, loads, place, first, stat)
    class(point_gaussians), intent(inout) :: self
    type(point_loads), intent(in) :: loads
    real(dp), intent(in) :: place(:)
    integer, intent(in) :: first
    integer, intent(out) :: stat
    real(dp) :: offset(size(place)), reach, scaling
    integer :: j, last

    self%unit = loads%unit
    if (maxval(abs(place)) > 0.0_dp) self%unit = max(self%unit, exponent(maxval(abs(place))))
    self%force_unit = loads%force_unit
    self%directions = size(place)
    scaling = scale(1.0_dp, loads%unit - self%unit)
    offset = scale(place, -self%unit)
    reach = 0.0_dp
    do j = 1, size(loads%force)
      reach = max(reach, maxval(abs(offset - scaling*loads%centre(:, j)) + scaling*loads%half(:, j)))
    end do
    self%first = first
    last = first - 1
    if (reach > 0.0_dp) last = max(last, ceiling((log(FAR*reach) + log_of_unit(self))/STEP))
    if (allocated(self%near)) deallocate (self%near, self%t)
    allocate (self%near(last - first + 1, DERIVATIVES), self%t(last - first + 1), stat=stat)
    if (stat /= 0) return
    do j = 1, size(self%t)
      self%t(j) = exp(STEP*real(first + j - 1, dp) - log_of_unit(self))
    end do
    self%near = 0.0_dp
    self%series = 0.0_dp
    do j = 1, size(loads%force)
      call add_load(self, offset - scaling*loads%centre(:, j), scaling*loads%half(:, j), loads%force(j))
    end do
  end subroutine add_up

  !> The logarithm of the unit of length.
  pure function log_of_unit(sums) result(logarithm)
    class(point_gaussians), intent(in) :: sums
    real(dp) :: logarithm

    logarithm = real(sums%unit, dp)*log(2.0_dp)
  end function log_of_unit

  !> Add a load with the half widths `half`; the place is at `offset` from its centre.
  pure subroutine add_load(sums, offset, half, force)
    class(point_gaussians), intent(inout) :: sums
    real(dp), intent(in) :: offset(:), half(:), force
    real(dp) :: average(0:2, 2), distance, series(0:TERMS, 0:2, 2)
    integer :: c, d, i, k, start

    average(:, 2) = [1.0_dp, 0.0_dp, 0.0_dp]
    distance = norm2(max(abs(offset) - half, 0.0_dp))
    start = 1
    if (distance > 0.0_dp) start = max(1, floor((log(0.5_dp*distance/NEGLIGIBLE) + log_of_unit(sums))/STEP) &
                                          - sums%first)
    do k = start, size(sums%near, 1)
      do d = 1, size(offset)
        average(:, d) = average_of(offset(d), half(d), sums%t(k))
      end do
      do c = 1, DERIVATIVES
        sums%near(k, c) = sums%near(k, c) + force*average(ORDERS(1, c), 1)*average(ORDERS(2, c), 2)
      end do
    end do
    series = 0.0_dp
    series(0, 0, 2) = 1.0_dp
    do d = 1, size(offset)
      call find_series(offset(d), half(d), series(:, :, d))
    end do
    do c = 1, DERIVATIVES
      do i = 0, TERMS
        sums%series(i:, c) = sums%series(i:, c) &
                             + force*series(i, ORDERS(1, c), 1)*series(:TERMS - i, ORDERS(2, c), 2)
      end do
    end do
  end subroutine add_load

  !> A Gaussian of variance 2 t**2 averaged over a width, its slope, and minus the slope of that.
  pure function average_of(offset, half, t) result(average)
    real(dp), intent(in) :: offset, half, t
    real(dp) :: average(0:2)
    real(dp) :: left, right

    if (t < 4.0_dp*half) then
      left = (abs(offset) - half)/(2.0_dp*t)
      right = (abs(offset) + half)/(2.0_dp*t)
      average(0) = 0.5_dp*(erfc(left) - erfc(right))
      average(1) = (gaussian(right, t) - gaussian(left, t))*sign(1.0_dp, offset)
      average(2) = (right*gaussian(right, t) - left*gaussian(left, t))/t
      average = average/(2.0_dp*half)
    else
      average = gaussian(0.5_dp*offset/t, t)*[1.0_dp, -0.5_dp/t, -0.25_dp/t**2] &
                *hermite_sums(0.5_dp*offset/t, (0.5_dp*half/t)**2)
    end if
  end function average_of

  !> The sums over j of `square`**j/(2 j + 1)! times the Hermite polynomials of the orders 2 j, 2 j + 1 and 2 j + 2 of
  !> x: a Gaussian in Taylor's series, averaged.
  pure function hermite_sums(x, square) result(total)
    real(dp), intent(in) :: x, square
    real(dp) :: total(0:2)
    real(dp) :: bound, coefficient, polynomial(0:2)
    integer :: j

    total = 0.0_dp
    polynomial = [1.0_dp, 2.0_dp*x, 4.0_dp*x**2 - 2.0_dp]
    coefficient = 1.0_dp
    bound = 1.0_dp
    j = 0
    do
      total = total + coefficient*polynomial
      j = j + 1
      ! Of the terms times exp(-x**2).
      bound = bound*square/real(j, dp)
      if (bound < ROUNDING) exit
      coefficient = coefficient*square/real(2*j*(2*j + 1), dp)
      polynomial(0) = polynomial(2)
      polynomial(1) = 2.0_dp*x*polynomial(0) - real(4*j, dp)*polynomial(1)
      polynomial(2) = 2.0_dp*x*polynomial(1) - real(4*j + 2, dp)*polynomial(0)
    end do
  end function hermite_sums

  !> A Gaussian of variance 2 t**2 at a distance of 2 t `x`.
  pure function gaussian(x, t) result(density)
    real(dp), intent(in) :: x, t
    real(dp) :: density

    density = 0.0_dp
    if (abs(x) < 2.0_dp*NEGLIGIBLE) density = exp(-x**2)/(2.0_dp*sqrt(PI)*t)
  end function gaussian

  !> The coefficients of (2 t)**(-2 k), k = 0, 1, .., in the averages of exp(-(x/(2 t))**2) over a width, and in their
  !> derivatives.
  pure subroutine find_series(offset, half, series)
    real(dp), intent(in) :: offset, half
    real(dp), intent(out) :: series(0:TERMS, 0:2)
    real(dp) :: h, x

    x = offset**2
    h = half**2
    series(:, 0) = [1.0_dp, -(x + h/3.0_dp), 0.5_dp*(x**2 + 2.0_dp*x*h + h**2/5.0_dp), &
                    -(x**3 + 5.0_dp*x**2*h + 3.0_dp*x*h**2 + h**3/7.0_dp)/6.0_dp]
    series(:, 1) = offset*[0.0_dp, -2.0_dp, 2.0_dp*(x + h), -(x**2 + 10.0_dp/3.0_dp*x*h + h**2)]
    series(:, 2) = [0.0_dp, 2.0_dp, -2.0_dp*(3.0_dp*x + h), 5.0_dp*x**2 + 10.0_dp*x*h + h**2]
  end subroutine find_series

  !> What a `function` of the mixture gives, with a derivative. On a line the displacement along z lacks its datum.
  pure function value(self, mixture, function, derivative)
    class(point_gaussians), intent(in) :: self
    type(depth_mixture), intent(in) :: mixture
    integer, intent(in) :: function, derivative
    real(dp) :: value
    real(dp) :: limit, rest
    integer :: k, m, next, power

    m = POWERS(function)
    value = 0.0_dp
    do k = 1, size(self%near, 1)
      value = value + mixture%weight_of(function, self%first + k - 1) &
              *self%t(k)**m*self%near(k, derivative)
    end do
    next = self%first + size(self%near, 1)
    rest = 0.0_dp
    do k = 0, TERMS
      power = m - self%directions - 2*k
      ! The sum over lengths has no limit: it belongs to the datum.
      limit = merge(mixture%beyond(1, function), 0.0_dp, power == 0)
      rest = rest + self%series(k, derivative)*0.25_dp**k &
             *mixture%sum_from(function, next, power, limit, log_of_unit(self))
    end do
    value = value + rest/(2.0_dp*sqrt(PI))**self%directions
    if (derivative == TWIST) value = -value
  end function value

  !> What is added to the displacement along z in plane strain so that far away it would be zero at the distance
  !> `reach`, in the caller's lengths.
  pure function line_datum(self, mixture, reach) result(displacement)
    class(point_gaussians), intent(in) :: self
    type(depth_mixture), intent(in) :: mixture
    real(dp), intent(in) :: reach
    real(dp) :: displacement

    displacement = mixture%datum_beyond(self%first + size(self%near, 1) - 1, reach) &
                   *self%series(0, PLAIN)/(2.0_dp*sqrt(PI))
  end function line_datum

end module fuge_point_gaussians
