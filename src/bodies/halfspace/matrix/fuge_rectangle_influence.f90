!> Influence coefficients of pairs of rectangles on an elastic half-space, accurate to rounding.
!>
!> A coefficient is factor times the mean of 1/r over two rectangles, or over a rectangle and a
!> point. Pairs far from each other are summed by multipoles, many at a time; close ones have a
!> closed form with more digits. Both round once, at the end.
module fuge_rectangle_influence
  use fuge_double_double, only: double_double, inverse_roots, squared_distances
  use fuge_kinds, only: dp
  use fuge_rectangle_multipoles, only: cosine_powers, expansion_order, multipoles, new_cosine_powers, new_multipoles, &
    sum_mixed_multipoles, sum_multipoles, FAR_RATIO, HIGHEST_ORDER
  use fuge_rectangle_potential, only: near_mean
  implicit none
  private

  public :: mixed_coefficients, new_rectangle_kernel, pair_coefficients, set_widths

  !> Pairs that `pair_coefficients` takes at once, at most.
  integer, parameter, public :: PAIRS = 128

  !> Pairs of different widths are summed together up to the first of these orders that is enough.
  integer, parameter :: GROUP_ORDERS(5) = [4, 6, 9, 13, HIGHEST_ORDER]

  !> 1/pi: a force f on a point displaces the surface at distance r by f/(pi E* r) (J. Boussinesq 1885; Johnson, 3.2).
  type(double_double), parameter, public :: HALFSPACE_FACTOR = &
    double_double(0.3183098861837907_dp, -1.9678676675182486e-17_dp)

  !> Data that all pairs share.
  type, public :: rectangle_kernel
    private
    type(double_double) :: factor
    type(cosine_powers) :: powers
    !> Widths along x and y of the rectangles, and what belongs to them.
    real(dp) :: observed(2) = 0.0_dp, loaded(2) = 0.0_dp
    real(dp) :: reach = 0.0_dp
    type(multipoles) :: terms
  end type rectangle_kernel

contains

  !> `factor` of all coefficients: one over length per force times length. `stat` as in an allocate statement.
  pure subroutine new_rectangle_kernel(factor, kernel, stat)
    type(double_double), intent(in) :: factor
    type(rectangle_kernel), intent(out) :: kernel
    integer, intent(out) :: stat

    kernel%factor = factor
    call new_cosine_powers(kernel%powers, stat)
  end subroutine new_rectangle_kernel

  !> The next pairs have the widths `observed` (2), 0 for points, and `loaded` (2), along x and y; length.
  pure subroutine set_widths(kernel, observed, loaded)
    type(rectangle_kernel), intent(inout) :: kernel
    real(dp), intent(in) :: observed(2), loaded(2)

    if (all(abs(kernel%observed - observed) <= 0.0_dp) .and. all(abs(kernel%loaded - loaded) <= 0.0_dp)) return
    kernel%observed = observed
    kernel%loaded = loaded
    kernel%reach = 0.5_dp*hypot(observed(1) + loaded(1), observed(2) + loaded(2))
    kernel%terms%order = 0
  end subroutine set_widths

  !> Coefficients of at most PAIRS pairs with the offsets x = `x_high` + `x_low`, and y likewise, of their centres.
  !> All arrays have one length.
  pure subroutine pair_coefficients(kernel, x_high, x_low, y_high, y_low, coefficient)
    type(rectangle_kernel), intent(inout) :: kernel
    real(dp), intent(in), contiguous :: x_high(:), x_low(:), y_high(:), y_low(:)
    real(dp), intent(out), contiguous :: coefficient(:)
    real(dp), dimension(PAIRS) :: high, low, ratio, cosine, correction
    integer :: order, n, k

    n = size(coefficient)
    call squared_distances(x_high, x_low, y_high, y_low, high(:n), low(:n))
    do k = 1, n
      ratio(k) = 0.0_dp
      cosine(k) = 0.0_dp
      if (is_near(kernel%reach**2, high(k))) cycle
      ratio(k) = kernel%reach**2/high(k)
      cosine(k) = ((x_high(k) - y_high(k))*(x_high(k) + y_high(k)))/high(k)
    end do
    order = expansion_order(maxval(ratio(:n)))
    if (order > kernel%terms%order) call new_multipoles(kernel%powers, order, kernel%observed, kernel%loaded, &
      kernel%reach, kernel%terms)
    call sum_multipoles(kernel%terms, order, ratio(:n), cosine(:n), correction(:n))
    ! Near pairs, which may have no distance at all, are computed with another one first.
    call correct_roots(kernel%factor, max(high(:n), kernel%reach**2), low(:n), correction(:n), coefficient)
    do k = 1, n
      if (is_near(kernel%reach**2, high(k))) coefficient(k) = near_mean( &
        double_double(x_high(k), x_low(k)), double_double(y_high(k), y_low(k)), kernel%observed, kernel%loaded, &
        kernel%factor)
    end do
  end subroutine pair_coefficients

  !> As `pair_coefficients`, with the widths `observed` (2, n) instead of those of `set_widths`.
  !>
  !> The sums cost the third power of their order, so the pairs are taken in groups of similar orders.
  pure subroutine mixed_coefficients(kernel, x_high, x_low, y_high, y_low, observed, coefficient)
    type(rectangle_kernel), intent(in) :: kernel
    real(dp), intent(in), contiguous :: x_high(:), x_low(:), y_high(:), y_low(:), observed(:, :)
    real(dp), intent(out), contiguous :: coefficient(:)
    real(dp), dimension(size(coefficient)) :: high, low, square, found
    integer, dimension(size(coefficient)) :: order, member
    integer :: group, count, k

    call squared_distances(x_high, x_low, y_high, y_low, high, low)
    do k = 1, size(coefficient)
      square(k) = 0.25_dp*((observed(1, k) + kernel%loaded(1))**2 + (observed(2, k) + kernel%loaded(2))**2)
      order(k) = 0
      if (.not. is_near(square(k), high(k))) then
        order(k) = expansion_order(square(k)/high(k))
      else
        coefficient(k) = near_mean(double_double(x_high(k), x_low(k)), double_double(y_high(k), y_low(k)), &
                                   observed(:, k), kernel%loaded, kernel%factor)
      end if
    end do
    do group = 1, size(GROUP_ORDERS)
      count = 0
      do k = 1, size(order)
        if (order(k) < 1 .or. order(k) > GROUP_ORDERS(group)) cycle
        count = count + 1
        member(count) = k
        order(k) = 0
      end do
      if (count < 1) cycle
      associate (these => member(:count))
        call group_coefficients(kernel, GROUP_ORDERS(group), x_high(these), y_high(these), high(these), low(these), &
                                square(these), observed(:, these), found(:count))
        coefficient(these) = found(:count)
      end associate
    end do
  end subroutine mixed_coefficients

  !> Far pairs of different widths by `order` multipoles; |R|**2 = `high` + `low`, s**2 = `square`. Nine arguments:
  !> what is known of each pair.
  pure subroutine group_coefficients(kernel, order, x, y, high, low, square, observed, coefficient)
    type(rectangle_kernel), intent(in) :: kernel
    integer, intent(in) :: order
    real(dp), intent(in), contiguous :: x(:), y(:), high(:), low(:), square(:), observed(:, :)
    real(dp), intent(out), contiguous :: coefficient(:)
    real(dp), dimension(size(x)) :: correction, cosine

    cosine = ((x - y)*(x + y))/high
    call sum_mixed_multipoles(kernel%powers, order, observed(1, :), observed(2, :), kernel%loaded, square, &
                              square/high, cosine, correction)
    call correct_roots(kernel%factor, high, low, correction, coefficient)
  end subroutine group_coefficients

  !> factor/|R| times 1 + correction, rounded once. All arrays have one length.
  pure subroutine correct_roots(factor, high, low, correction, coefficient)
    type(double_double), intent(in) :: factor
    real(dp), intent(in), contiguous :: high(:), low(:), correction(:)
    real(dp), intent(out), contiguous :: coefficient(:)
    real(dp), dimension(size(high)) :: root_high, root_low

    call inverse_roots(factor, high, low, root_high, root_low)
    coefficient = root_high + (root_low + root_high*correction)
  end subroutine correct_roots

  !> Is a pair at this squared distance too close for the multipoles? `square` is s**2.
  elemental function is_near(square, squared_distance) result(near)
    real(dp), intent(in) :: square, squared_distance
    logical :: near

    near = square > FAR_RATIO*squared_distance
  end function is_near

end module fuge_rectangle_influence
