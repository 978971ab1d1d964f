!> Generated rough profiles for the example `rough`.
module rough_profile
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: self_affine_profile, rms_slope

  !> The spectrum of a generated profile. Of all its properties the real contact depends mainly on
  !> the mean square slope.
  real(dp), parameter :: HURST = 0.8_dp, SLOPE = 0.1_dp
  !> The period holds LONGEST of the longest waves; the shortest wave is SHORTEST cells long.
  integer, parameter :: LONGEST = 4, SHORTEST = 16
  integer(int64), parameter :: SEED = 2026_int64
  real(dp), parameter :: PI = acos(-1.0_dp)

contains

  !> Heights of `n` cells, a power of two, of a period 1: sum of a_m cos(2 pi m x + phase)
  !> with a_m ~ m**-(1/2 + H), random phases.
  !>
  !> A wave has the same phase for all n: more cells add shorter waves.
  subroutine self_affine_profile(n, height)
    integer, intent(in) :: n
    real(dp), intent(out) :: height(n)
    complex(dp), allocatable :: wave(:)
    real(dp) :: amplitude, phase, square
    integer(int64) :: state
    integer :: m

    allocate (wave(0:n - 1))
    wave = (0.0_dp, 0.0_dp)
    state = SEED
    square = 0.0_dp
    do m = LONGEST, n/SHORTEST
      amplitude = real(m, dp)**(-0.5_dp - HURST)
      phase = 2.0_dp*PI*random(state)
      wave(m) = amplitude*cmplx(cos(phase), sin(phase), dp)
      square = square + 0.5_dp*(2.0_dp*PI*real(m, dp)*amplitude)**2
    end do
    call add_up(wave)
    height = SLOPE/sqrt(square)*real(wave, dp)
  end subroutine self_affine_profile

  !> The next number between 0 and 1 of the "minimal standard" generator (S. K. Park,
  !> K. W. Miller, P. K. Stockmeyer, Comm. ACM 36, 1993): the same on every computer.
  function random(state)
    integer(int64), intent(inout) :: state
    real(dp) :: random
    integer(int64), parameter :: MULTIPLIER = 48271_int64, MODULUS = 2147483647_int64

    state = mod(MULTIPLIER*state, MODULUS)
    random = real(state, dp)/real(MODULUS, dp)
  end function random

  !> From the waves m = 0 .. n-1 to sum_m wave(m) exp(2 pi i m k/n) at the points k: even
  !> and odd waves apart are sums over half as many points (fast Fourier transform).
  recursive subroutine add_up(wave)
    complex(dp), intent(inout) :: wave(0:)
    complex(dp), allocatable :: even(:), odd(:)
    real(dp) :: angle
    integer :: half, k

    half = size(wave)/2
    if (half == 0) return
    allocate (even(0:half - 1), odd(0:half - 1))
    even = wave(0::2)
    odd = wave(1::2)
    call add_up(even)
    call add_up(odd)
    do k = 0, half - 1
      angle = PI*real(k, dp)/real(half, dp)
      odd(k) = odd(k)*cmplx(cos(angle), sin(angle), dp)
    end do
    wave(:half - 1) = even + odd
    wave(half:) = even - odd
  end subroutine add_up

  !> Root mean square of the slope from cell to cell, once round the period.
  pure function rms_slope(height, spacing) result(slope)
    real(dp), intent(in) :: height(:), spacing
    real(dp) :: slope
    integer :: n

    n = size(height)
    slope = sqrt((sum((height(2:) - height(:n - 1))**2) + (height(1) - height(n))**2)/real(n, dp))/spacing
  end function rms_slope

end module rough_profile
