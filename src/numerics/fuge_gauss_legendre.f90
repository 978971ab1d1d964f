!> Gauss-Legendre quadrature on (0, 1).
module fuge_gauss_legendre
  use fuge_constants, only: PI
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: gauss_rule

  !> More steps of Newton's method than any node needs.
  integer, parameter :: MOST_STEPS = 12

contains

  !> Nodes in ascending order and weights, whose sum is 1: exact for polynomials of degree 2 n - 1, n = size(node) > 0.
  !> `weight` has the same size.
  pure subroutine gauss_rule(node, weight)
    real(dp), intent(out) :: node(:), weight(:)
    real(xp) :: x, change, slope
    integer :: i, n, step

    n = size(node)
    do i = 1, (n + 1)/2
      ! A zero x of the Legendre polynomial on (-1, 1), from 1 down; the guess is that of F. G. Tricomi.
      x = real(cos(PI*(real(i, dp) - 0.25_dp)/(real(n, dp) + 0.5_dp)), xp)
      do step = 1, MOST_STEPS
        call newton_step(n, x, change, slope)
        x = x - change
        if (abs(change) <= 4.0_dp*epsilon(x)) exit
      end do
      call newton_step(n, x, change, slope)
      weight(n + 1 - i) = real(1.0_xp/((1.0_xp - x)*(1.0_xp + x)*slope**2), dp)
      node(n + 1 - i) = real(0.5_xp + 0.5_xp*x, dp)
      weight(i) = weight(n + 1 - i)
      node(i) = real(0.5_xp - 0.5_xp*x, dp)
    end do
  end subroutine gauss_rule

  !> P_n/P_n' and P_n' of the Legendre polynomial at x, by its recurrence.
  pure subroutine newton_step(n, x, change, slope)
    integer, intent(in) :: n
    real(xp), intent(in) :: x
    real(xp), intent(out) :: change, slope
    real(xp) :: now, before, next
    integer :: k

    before = 1.0_xp
    now = x
    do k = 2, n
      next = (real(2*k - 1, xp)*x*now - real(k - 1, xp)*before)/real(k, xp)
      before = now
      now = next
    end do
    slope = real(n, xp)*(before - x*now)/((1.0_xp - x)*(1.0_xp + x))
    change = now/slope
  end subroutine newton_step

end module fuge_gauss_legendre
