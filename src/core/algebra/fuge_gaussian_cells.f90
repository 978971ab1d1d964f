!> Gaussians on cells side by side, averaged over a cell or over two: their shares of the cells, and the sums of the
!> waves that are the same on the cells. The width of a cell is the unit of length.
module fuge_gaussian_cells
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: fill_gaussian_sums, fill_shares, gaussian_share

  !> exp(-x**2) and erfc(x) are less than rounding.
  real(dp), parameter, public :: NEGLIGIBLE = 6.3_dp
  !> Up to this t the sum over cells is taken, above it the one over waves.
  real(dp), parameter :: SWITCH = 0.4_dp
  !> From this t on, the Gauss rule integrates a Gaussian over a cell to rounding.
  real(dp), parameter :: RESOLVED = 2.0_dp
  !> Cells on each side, and waves, that count.
  integer, parameter :: NEIGHBOURS = 5, ALIASES = 3
  !> Rule of Gauss and Legendre from 0 to 1.
  real(dp), parameter :: GAUSS_NODE(6) = 0.5_dp + 0.5_dp*[ &
    -0.93246951420315203_dp, -0.66120938646626451_dp, -0.23861918608319691_dp, &
    0.23861918608319691_dp, 0.66120938646626451_dp, 0.93246951420315203_dp]
  real(dp), parameter :: GAUSS_WEIGHT(6) = 0.5_dp*[ &
    0.17132449237917035_dp, 0.36076157304813861_dp, 0.46791393457269105_dp, &
    0.46791393457269105_dp, 0.36076157304813861_dp, 0.17132449237917035_dp]

contains

  !> The shares of a Gaussian of variance 2 t**2 about a cell, averaged over the cell if `power` is 2, that lie in the
  !> cells at the distances 0, 1, ..
  pure subroutine fill_shares(t, power, share)
    real(dp), intent(in) :: t
    integer, intent(in) :: power
    real(dp), intent(out) :: share(0:)
    integer :: count, j

    count = int(min(real(ubound(share, 1), dp), 2.0_dp + 2.0_dp*NEGLIGIBLE*t))
    share(count + 1:) = 0.0_dp
    do j = 0, count
      share(j) = gaussian_share(t, power, real(j, dp))
    end do
  end subroutine fill_shares

  !> As `fill_shares`, of the cell at the distance `x` >= 0.
  elemental function gaussian_share(t, power, x) result(share)
    real(dp), intent(in) :: t, x
    integer, intent(in) :: power
    real(dp) :: share

    if (t < RESOLVED) then
      if (power == 1) then
        share = 0.5_dp*(erfc((x - 0.5_dp)/(2.0_dp*t)) - erfc((x + 0.5_dp)/(2.0_dp*t)))
      else
        share = 0.5_dp*(antiderivative(x - 1.0_dp, t) - 2.0_dp*antiderivative(x, t) + antiderivative(x + 1.0_dp, t))
      end if
    else if (power == 1) then
      share = sum(GAUSS_WEIGHT*(gaussian(x + 0.5_dp*GAUSS_NODE, t) + gaussian(x - 0.5_dp*GAUSS_NODE, t)))*0.5_dp
    else
      share = sum(GAUSS_WEIGHT*(1.0_dp - GAUSS_NODE)*(gaussian(x + GAUSS_NODE, t) + gaussian(x - GAUSS_NODE, t)))
    end if
  end function gaussian_share

  elemental function gaussian(x, t) result(density)
    real(dp), intent(in) :: x, t
    real(dp) :: density

    density = exp(-(x/(2.0_dp*t))**2)/(2.0_dp*sqrt(PI)*t)
  end function gaussian

  !> `sums` of the size of `mu`: for each wave of `mu` periods in a cell, 0 <= mu <= 1/2, the sum over all waves that
  !> are the same on the cells of sinc(q/2)**`power` exp(-(t q)**2).
  pure subroutine fill_gaussian_sums(mu, t, power, sums)
    real(dp), intent(in), contiguous :: mu(:)
    real(dp), intent(in) :: t
    integer, intent(in) :: power
    real(dp), intent(out), contiguous :: sums(:)
    real(dp) :: share(0:NEIGHBOURS)
    integer :: k

    if (t < SWITCH) then
      call fill_shares(t, power, share)
      do k = 1, size(mu)
        sums(k) = sum_over_cells(share, mu(k))
      end do
    else
      do k = 1, size(mu)
        sums(k) = sum_over_waves(t, power, mu(k))
      end do
    end if
  end subroutine fill_gaussian_sums

  !> The integral of -erfc(s/(2 t)) over s up to x, from infinity.
  pure function antiderivative(x, t) result(value)
    real(dp), intent(in) :: x, t
    real(dp) :: value, ratio

    ratio = x/(2.0_dp*t)
    value = -x*erfc(ratio)
    if (abs(ratio) < 2.0_dp*NEGLIGIBLE) value = value + 2.0_dp*t/sqrt(PI)*exp(-ratio**2)
  end function antiderivative

  !> `share`(0) + 2 sum of `share`(j) cos(2 pi mu j).
  pure function sum_over_cells(share, mu) result(total)
    real(dp), intent(in) :: share(0:), mu
    real(dp) :: total, before, now, next, twice
    integer :: j

    twice = 2.0_dp*cos(2.0_dp*PI*mu)
    before = 1.0_dp
    now = 0.5_dp*twice
    total = share(0)
    do j = 1, ubound(share, 1)
      total = total + 2.0_dp*share(j)*now
      next = twice*now - before
      before = now
      now = next
    end do
  end function sum_over_cells

  !> The sum over a of sinc(pi (mu + a))**`power` exp(-(2 pi t (mu + a))**2), 0 <= `mu` <= 1/2.
  pure function sum_over_waves(t, power, mu) result(total)
    real(dp), intent(in) :: t, mu
    integer, intent(in) :: power
    real(dp) :: total, sinc, exponent
    integer :: a

    total = 0.0_dp
    do a = -ALIASES, ALIASES - 1
      exponent = (2.0_dp*PI*t*(mu + a))**2
      if (exponent > 2.0_dp*NEGLIGIBLE**2) cycle
      sinc = 1.0_dp
      if (mu > 0.0_dp) then
        sinc = sin(PI*mu)/(PI*(mu + a))
        if (power == 1 .and. mod(a, 2) /= 0) sinc = -sinc
      else if (a /= 0) then
        cycle
      end if
      total = total + sinc**power*exp(-exponent)
    end do
  end function sum_over_waves

end module fuge_gaussian_cells
