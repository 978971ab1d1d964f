!> Influence coefficients of pairs of rectangles on an elastic half-space, accurate to rounding.
!>
!> A coefficient is factor times the mean of 1/r over two rectangles, or over a rectangle and a
!> point. Pairs far from each other are summed by multipoles, many at a time; close ones have a
!> closed form with more digits. Both round once, at the end.
module fuge_rectangle_influence
  use fuge_double_double, only: double_double, inverse_roots, squared_distances
  use fuge_kinds, only: dp
  use fuge_rectangle_multipoles, only: cosine_powers, expansion_order, multipoles, new_cosine_powers, new_multipoles, &
    sum_multipoles, FAR_RATIO, HIGHEST_ORDER
  use fuge_rectangle_potential, only: near_mean
  implicit none
  private

  public :: new_rectangle_kernel, pair_coefficients, set_widths

  !> Pairs that `pair_coefficients` takes at once, at most.
  integer, parameter, public :: PAIRS = 64

  !> 1/pi: a force f on a point displaces the surface at distance r by f/(pi E* r) (J. Boussinesq 1885; Johnson, 3.2).
  type(double_double), parameter, public :: HALFSPACE_FACTOR = &
    double_double(0.3183098861837907_dp, -1.9678676675182486e-17_dp)

  !> What all pairs share.
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

  !> `factor` of all coefficients: one over length per force times length.
  pure subroutine new_rectangle_kernel(factor, kernel)
    type(double_double), intent(in) :: factor
    type(rectangle_kernel), intent(out) :: kernel

    kernel%factor = factor
    call new_cosine_powers(kernel%powers)
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
    real(dp), dimension(PAIRS) :: high, low, ratio, cosine, correction, root_high, root_low
    real(dp) :: most
    integer :: order, n, k

    n = size(coefficient)
    call squared_distances(x_high, x_low, y_high, y_low, high(:n), low(:n))
    most = 0.0_dp
    do k = 1, n
      if (is_near(kernel, high(k))) then
        ! Any place that is far, for the multipoles.
        high(k) = kernel%reach**2/FAR_RATIO
        low(k) = 0.0_dp
        ratio(k) = 0.0_dp
        cosine(k) = 0.0_dp
        coefficient(k) = -1.0_dp
      else
        ratio(k) = kernel%reach**2/high(k)
        cosine(k) = ((x_high(k) - y_high(k))*(x_high(k) + y_high(k)))/high(k)
        coefficient(k) = 0.0_dp
      end if
      most = max(most, ratio(k))
    end do
    order = expansion_order(most)
    if (order > kernel%terms%order) call new_multipoles(kernel%powers, order, kernel%observed, kernel%loaded, &
      kernel%reach, kernel%terms)
    call sum_multipoles(kernel%terms, order, ratio(:n), cosine(:n), correction(:n))
    call inverse_roots(kernel%factor, high(:n), low(:n), root_high(:n), root_low(:n))
    do k = 1, n
      if (coefficient(k) < 0.0_dp) then
        coefficient(k) = near_mean(double_double(x_high(k), x_low(k)), double_double(y_high(k), y_low(k)), &
                                   kernel%observed, kernel%loaded, kernel%factor)
      else
        coefficient(k) = root_high(k) + (root_low(k) + root_high(k)*correction(k))
      end if
    end do
  end subroutine pair_coefficients

  !> Is a pair at this squared distance too close for the multipoles?
  pure function is_near(kernel, squared_distance) result(near)
    type(rectangle_kernel), intent(in) :: kernel
    real(dp), intent(in) :: squared_distance
    logical :: near

    near = kernel%reach**2 > FAR_RATIO*squared_distance
  end function is_near

end module fuge_rectangle_influence
