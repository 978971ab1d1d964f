!> A rough surface for the example `surface`, the same with every compiler.
module surface_heights
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: self_affine_surface, rms_gradient, perimeter

  !> The spectrum. Of all properties of a surface the real contact depends mainly on the mean square gradient.
  real(dp), parameter :: HURST = 0.8_dp, GRADIENT = 0.1_dp
  !> The period holds LONGEST of the longest waves; the shortest wave is SHORTEST_WAVE cells long.
  integer, parameter :: LONGEST = 4, SHORTEST_WAVE = 8
  integer(int64), parameter :: SEED = 2026_int64
  real(dp), parameter :: PI = acos(-1.0_dp)

contains

  !> Heights of n x n cells, n a power of two, of a surface with the period 1 in both directions: a sum of waves
  !> a cos(2 pi (kx x + ky y) + phase) with a ~ k**-(1 + H), k = |(kx, ky)|, and random phases.
  !>
  !> A wave has the same phase for all n: more cells add shorter waves, unless `shortest` says how many cells the
  !> shortest one is long, SHORTEST_WAVE if it is not given.
  subroutine self_affine_surface(n, height, shortest)
    integer, intent(in) :: n
    real(dp), intent(out) :: height(0:n - 1, 0:n - 1)
    integer, intent(in), optional :: shortest
    complex(dp), allocatable :: wave(:, :)
    real(dp) :: square
    integer(int64) :: state
    integer :: last, ring, kx, ky

    last = n/SHORTEST_WAVE
    if (present(shortest)) last = n/shortest
    allocate (wave(0:n - 1, 0:n - 1))
    wave = (0.0_dp, 0.0_dp)
    state = SEED
    square = 0.0_dp
    ! Of a wave and its opposite only one is needed: the upper half of each square ring, from the longest waves on.
    do ring = 1, last
      do ky = 0, ring
        do kx = -ring, ring
          if (max(abs(kx), ky) < ring .or. (ky == 0 .and. kx < 0)) cycle
          call add_wave(kx, ky, last, state, wave, square)
        end do
      end do
    end do
    call add_up(wave)
    wave = transpose(wave)
    call add_up(wave)
    height = GRADIENT/sqrt(square)*transpose(real(wave, dp))
  end subroutine self_affine_surface

  !> Add a wave, if it has at most `last` periods, to the spectrum and its part of the mean square gradient to `square`.
  subroutine add_wave(kx, ky, last, state, wave, square)
    integer, intent(in) :: kx, ky, last
    integer(int64), intent(inout) :: state
    complex(dp), intent(inout) :: wave(0:, 0:)
    real(dp), intent(inout) :: square
    real(dp) :: amplitude, phase, k

    phase = 2.0_dp*PI*random(state)
    k = hypot(real(kx, dp), real(ky, dp))
    if (k < LONGEST .or. k > last) return
    amplitude = k**(-1.0_dp - HURST)
    wave(modulo(kx, size(wave, 1)), modulo(ky, size(wave, 2))) = amplitude*cmplx(cos(phase), sin(phase), dp)
    square = square + 0.5_dp*(2.0_dp*PI*k*amplitude)**2
  end subroutine add_wave

  !> The next number between 0 and 1 of the "minimal standard" generator (S. K. Park,
  !> K. W. Miller, P. K. Stockmeyer, Comm. ACM 36, 1993): the same on every computer.
  function random(state)
    integer(int64), intent(inout) :: state
    real(dp) :: random
    integer(int64), parameter :: MULTIPLIER = 48271_int64, MODULUS = 2147483647_int64

    state = mod(MULTIPLIER*state, MODULUS)
    random = real(state, dp)/real(MODULUS, dp)
  end function random

  !> In each row, from the waves m = 0 .. n-1 to sum_m wave(m) exp(2 pi i m k/n) at the points k: even
  !> and odd waves apart are sums over half as many points (fast Fourier transform).
  recursive subroutine add_up(wave)
    complex(dp), intent(inout) :: wave(:, 0:)
    complex(dp), allocatable :: even(:, :), odd(:, :)
    real(dp) :: angle
    integer :: half, k

    half = size(wave, 2)/2
    if (half == 0) return
    allocate (even(size(wave, 1), 0:half - 1), odd(size(wave, 1), 0:half - 1))
    even = wave(:, 0::2)
    odd = wave(:, 1::2)
    call add_up(even)
    call add_up(odd)
    do k = 0, half - 1
      angle = PI*real(k, dp)/real(half, dp)
      odd(:, k) = odd(:, k)*cmplx(cos(angle), sin(angle), dp)
    end do
    wave(:, :half - 1) = even + odd
    wave(:, half:) = even - odd
  end subroutine add_up

  !> Root mean square of the gradient, by differences from cell to cell, once round the periods; `spacing` of the cells.
  pure function rms_gradient(height, spacing) result(gradient)
    real(dp), intent(in) :: height(:, :), spacing
    real(dp) :: gradient

    gradient = sqrt((sum((cshift(height, 1, 1) - height)**2) + sum((cshift(height, 1, 2) - height)**2)) &
                    /real(size(height), dp))/spacing
  end function rms_gradient

  !> The length of the boundary of the contact, in cells, once round the periods.
  pure function perimeter(contact) result(length)
    logical, intent(in) :: contact(:, :)
    integer :: length

    length = count(contact .neqv. cshift(contact, 1, 1)) + count(contact .neqv. cshift(contact, 1, 2))
  end function perimeter

end module surface_heights
