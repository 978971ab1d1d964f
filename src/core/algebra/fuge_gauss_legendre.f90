!> Gauss-Legendre quadrature on (0, 1).
module fuge_gauss_legendre
  use fuge_constants, only: PI
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: gauss_rule, gauss_rules

  !> More steps of Newton's method than any node needs; after one this small the error is rounding.
  integer, parameter :: MOST_STEPS = 12
  real(dp), parameter :: CLOSE = 1.0e-9_dp

contains

  !> Nodes in ascending order and weights, whose sum is 1: exact for polynomials of degree 2 n - 1, n = size(node) > 0.
  !> `weight` has the same size.
  pure subroutine gauss_rule(node, weight)
    real(dp), intent(out) :: node(:), weight(:)
    real(dp) :: fraction(size(node)), x, change, slope
    real(xp) :: fine_fraction(size(node)), fine_x, fine_change, fine_slope
    integer :: i, k, n, step

    n = size(node)
    fine_fraction = [(real(k - 1, xp)/real(k, xp), k=1, n)]
    fraction = real(fine_fraction, dp)
    do i = 1, (n + 1)/2
      ! A zero x of the Legendre polynomial on (-1, 1), from 1 down; the guess is that of F. G. Tricomi.
      x = (1.0_dp - (1.0_dp - 1.0_dp/real(n, dp))/(8.0_dp*real(n, dp)**2)) &
          *cos(PI*(real(i, dp) - 0.25_dp)/(real(n, dp) + 0.5_dp))
      do step = 1, MOST_STEPS
        call newton_step(fraction, x, change, slope)
        x = x - change
        if (abs(change) <= CLOSE) exit
      end do
      fine_x = real(x, xp)
      call fine_newton_step(fine_fraction, fine_x, fine_change, fine_slope)
      fine_x = fine_x - fine_change
      ! The slope there, by Legendre's equation: (1 - x**2) P'' = 2 x P' at a zero.
      fine_slope = fine_slope*(1.0_xp - fine_change*2.0_xp*fine_x/((1.0_xp - fine_x)*(1.0_xp + fine_x)))
      weight(n + 1 - i) = real(1.0_xp/((1.0_xp - fine_x)*(1.0_xp + fine_x)*fine_slope**2), dp)
      node(n + 1 - i) = real(0.5_xp + 0.5_xp*fine_x, dp)
      weight(i) = weight(n + 1 - i)
      node(i) = real(0.5_xp - 0.5_xp*fine_x, dp)
    end do
  end subroutine gauss_rule

  !> The rules of 1 .. n nodes, n = size(node, 1), for quadratures that choose among them: rule k is node(:k, k) and
  !> weight(:k, k). Elements below the diagonal keep their values; `weight` has the same shape.
  pure subroutine gauss_rules(node, weight)
    real(dp), intent(inout) :: node(:, :), weight(:, :)
    integer :: k

    do k = 1, size(node, 2)
      call gauss_rule(node(:k, k), weight(:k, k))
    end do
  end subroutine gauss_rules

  !> P_n/P_n' and P_n' of the Legendre polynomial at x, by its recurrence; `fraction` (n) has (k - 1)/k.
  pure subroutine newton_step(fraction, x, change, slope)
    real(dp), intent(in) :: fraction(:), x
    real(dp), intent(out) :: change, slope
    real(dp) :: now, before, next
    integer :: k

    before = 1.0_dp
    now = x
    do k = 2, size(fraction)
      next = x*now + fraction(k)*(x*now - before)
      before = now
      now = next
    end do
    slope = real(size(fraction), dp)*(before - x*now)/((1.0_dp - x)*(1.0_dp + x))
    change = now/slope
  end subroutine newton_step

  !> The same with more digits, so that the weights are exact to rounding.
  pure subroutine fine_newton_step(fraction, x, change, slope)
    real(xp), intent(in) :: fraction(:), x
    real(xp), intent(out) :: change, slope
    real(xp) :: now, before, next
    integer :: k

    before = 1.0_xp
    now = x
    do k = 2, size(fraction)
      next = x*now + fraction(k)*(x*now - before)
      before = now
      now = next
    end do
    slope = real(size(fraction), xp)*(before - x*now)/((1.0_xp - x)*(1.0_xp + x))
    change = now/slope
  end subroutine fine_newton_step

end module fuge_gauss_legendre
