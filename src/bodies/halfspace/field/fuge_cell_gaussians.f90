!> A Gaussian averaged over a cell, and its derivatives: the factors of its waves on a circle of cells, and its values.
!>
!> A factor is the sum over all waves that are the same on the cells, or for a narrow Gaussian its transform from cell
!> to cell, both of which converge like a Gaussian (Poisson's summation formula).
module fuge_cell_gaussians
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  implicit none
  private

  public :: circle_work, fill_gaussian_circle, fill_gaussian_places, fill_gaussian_waves

  !> Up to this width the sum over cells is taken, above it the one over waves.
  real(dp), parameter :: SWITCH = 0.4_dp
  !> Cells on each side, and waves, that count.
  integer, parameter :: NEIGHBOURS = 5, ALIASES = 3
  !> exp(-x) is less than rounding.
  real(dp), parameter :: NEGLIGIBLE = 80.0_dp
  !> From this width on, a Gauss rule of NODES nodes integrates a Gaussian over a cell to rounding.
  real(dp), parameter :: RESOLVED = 2.0_dp
  integer, parameter :: NODES = 8
  !> From this width on, in units of a circle, few waves make up a Gaussian on it.
  real(dp), parameter :: WIDE = 0.18_dp

contains

  !> `factor` (0:m, 0:2): for the waves of 0 .. m periods in `n` cells, m <= n/2, the sum over the waves q that are the
  !> same on the cells of q**order sinc(q/2) exp(-(t q)**2), of the order 0, 1, 2; the length is that of a cell.
  pure subroutine fill_gaussian_waves(n, t, factor)
    integer, intent(in) :: n
    real(dp), intent(in) :: t
    real(dp), intent(out) :: factor(0:, 0:)
    real(dp) :: share(0:NEIGHBOURS, 0:2)
    integer :: k

    if (t < SWITCH) then
      call fill_shares(t, share)
      do k = 0, ubound(factor, 1)
        factor(k, :) = sum_over_cells(share, real(k, dp)/real(n, dp))
      end do
    else
      do k = 0, ubound(factor, 1)
        factor(k, :) = sum_over_waves(t, real(k, dp)/real(n, dp))
      end do
    end if
  end subroutine fill_gaussian_waves

  !> `value` (0:m, 0:2): at the distances of 0 .. m cells the average over a cell of a Gaussian of variance 2 t**2, its
  !> slope, and minus the slope of that; the length is that of a cell.
  pure subroutine fill_gaussian_places(t, value)
    real(dp), intent(in) :: t
    real(dp), intent(out) :: value(0:, 0:)
    real(dp) :: node(NODES), weight(NODES), x
    integer :: j, k, last

    ! Beyond, everything is less than rounding.
    last = int(min(real(ubound(value, 1), dp), 1.0_dp + 2.0_dp*sqrt(NEGLIGIBLE)*t))
    value(last + 1:, :) = 0.0_dp
    if (t < RESOLVED) then
      call fill_shares(t, value(:last, :))
      value(:last, 1) = -value(:last, 1)
      return
    end if
    call gauss_rule(node, weight)
    value(:last, :) = 0.0_dp
    do k = 1, NODES
      do j = 0, last
        x = real(j, dp) + (node(k) - 0.5_dp)
        value(j, :) = value(j, :) + weight(k)*gaussian(x, t)*[1.0_dp, -0.5_dp*x/t**2, (0.5_dp - (0.5_dp*x/t)**2)/t**2]
      end do
    end do
  end subroutine fill_gaussian_places

  !> As `fill_gaussian_places`, on a circle of `n` cells, without the mean over the circle; m <= n/2.
  !>
  !> `work` (0:circle_work(n), 0:2).
  pure subroutine fill_gaussian_circle(n, t, work, value)
    integer, intent(in) :: n
    real(dp), intent(in) :: t
    real(dp), intent(inout) :: work(0:, 0:)
    real(dp), intent(out) :: value(0:, 0:)
    real(dp) :: sign_of_slope
    integer :: j, k, reach

    value = 0.0_dp
    if (t >= max(WIDE*real(n, dp), SWITCH)) then
      call add_waves(n, t, value)
      return
    end if
    reach = min(ubound(work, 1), 1 + int(2.0_dp*sqrt(NEGLIGIBLE)*t))
    call fill_gaussian_places(t, work(:reach, :))
    do k = -reach, reach
      j = modulo(k, n)
      if (j > ubound(value, 1)) cycle
      sign_of_slope = sign(1.0_dp, real(k, dp))
      value(j, :) = value(j, :) + work(abs(k), :)*[1.0_dp, sign_of_slope, 1.0_dp]
    end do
    value(:, 0) = value(:, 0) - 1.0_dp/real(n, dp)
  end subroutine fill_gaussian_circle

  !> The last number of the work space of `fill_gaussian_circle`.
  pure function circle_work(n) result(last)
    integer, intent(in) :: n
    integer :: last

    last = 2 + int(2.0_dp*sqrt(NEGLIGIBLE)*max(WIDE*real(n, dp), SWITCH))
  end function circle_work

  !> Add the values that belong to the waves of 1, 2, .. periods, as many as count.
  pure subroutine add_waves(n, t, value)
    integer, intent(in) :: n
    real(dp), intent(in) :: t
    real(dp), intent(inout) :: value(0:, 0:)
    real(dp) :: angle, factor(0:2)
    integer :: j, k

    do k = 1, min(n/2, int(sqrt(NEGLIGIBLE)*real(n, dp)/(2.0_dp*PI*t)))
      factor = sum_over_waves(t, real(k, dp)/real(n, dp))*(merge(1.0_dp, 2.0_dp, 2*k == n)/real(n, dp))
      do j = 0, ubound(value, 1)
        angle = 2.0_dp*PI*(modulo(real(j, dp)*real(k, dp), real(n, dp))/real(n, dp))
        value(j, :) = value(j, :) + factor*[cos(angle), -sin(angle), cos(angle)]
      end do
    end do
  end subroutine add_waves

  !> At the distances 0, 1, ..: the share of a Gaussian of variance 2 t**2 that lies in a cell, minus its slope, and
  !> minus the slope of that.
  pure subroutine fill_shares(t, share)
    real(dp), intent(in) :: t
    real(dp), intent(out) :: share(0:, 0:)
    real(dp) :: left, right
    integer :: j

    do j = 0, ubound(share, 1)
      left = real(j, dp) - 0.5_dp
      right = real(j, dp) + 0.5_dp
      share(j, 0) = 0.5_dp*(erfc(left/(2.0_dp*t)) - erfc(right/(2.0_dp*t)))
      share(j, 1) = gaussian(left, t) - gaussian(right, t)
      share(j, 2) = (right*gaussian(right, t) - left*gaussian(left, t))/(2.0_dp*t**2)
    end do
  end subroutine fill_shares

  pure function gaussian(x, t) result(density)
    real(dp), intent(in) :: x, t
    real(dp) :: density

    density = 0.0_dp
    if ((x/(2.0_dp*t))**2 < NEGLIGIBLE) density = exp(-(x/(2.0_dp*t))**2)/(2.0_dp*sqrt(PI)*t)
  end function gaussian

  !> The transforms of what `fill_shares` gives, even, odd and even, at `mu` periods for each cell.
  pure function sum_over_cells(share, mu) result(total)
    real(dp), intent(in) :: share(0:, 0:), mu
    real(dp) :: total(0:2)
    real(dp) :: angle
    integer :: j

    total = [share(0, 0), 0.0_dp, share(0, 2)]
    do j = 1, ubound(share, 1)
      angle = 2.0_dp*PI*(mu*real(j, dp))
      total = total + 2.0_dp*[share(j, 0)*cos(angle), share(j, 1)*sin(angle), share(j, 2)*cos(angle)]
    end do
  end function sum_over_cells

  pure function sum_over_waves(t, mu) result(total)
    real(dp), intent(in) :: t, mu
    real(dp) :: total(0:2)
    real(dp) :: exponent, q, term
    integer :: a

    total = 0.0_dp
    if (.not. mu > 0.0_dp) then
      total(0) = 1.0_dp
      return
    end if
    do a = -ALIASES, ALIASES - 1
      q = 2.0_dp*PI*(mu + real(a, dp))
      exponent = (t*q)**2
      if (exponent > NEGLIGIBLE) cycle
      term = 2.0_dp*sin(PI*mu)*exp(-exponent)
      if (mod(a, 2) /= 0) term = -term
      total = total + term*[1.0_dp/q, 1.0_dp, q]
    end do
  end function sum_over_waves

end module fuge_cell_gaussians
