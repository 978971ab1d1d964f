!> Sums of many waves, by the benchmark's own fast Fourier transform: its profiles do not depend
!> on the code that it measures.
module bench_waves
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: sum_of_waves

  real(dp), parameter :: PI = acos(-1.0_dp)

contains

  !> z_j = sum_k a_k cos(2 pi k j/n + b_k), j = 0 .. n - 1.
  !>
  !> `amplitude`, `phase` (at most n/2) from k = 1 on; `z` (n), n a power of two.
  subroutine sum_of_waves(amplitude, phase, z)
    real(dp), intent(in) :: amplitude(:), phase(:)
    real(dp), intent(out) :: z(:)
    complex(dp), allocatable :: wave(:)

    allocate (wave(0:size(z) - 1))
    wave = (0.0_dp, 0.0_dp)
    wave(1:size(phase)) = amplitude*cmplx(cos(phase), sin(phase), dp)
    call reverse_bits(wave)
    call combine(wave)
    z = real(wave, dp)
  end subroutine sum_of_waves

  !> The bit-reversed order.
  pure subroutine reverse_bits(wave)
    complex(dp), intent(inout) :: wave(0:)
    complex(dp) :: kept
    integer :: i, j, bit

    j = 0
    do i = 1, size(wave) - 1
      bit = size(wave)/2
      do while (iand(j, bit) /= 0)
        j = ieor(j, bit)
        bit = bit/2
      end do
      j = ior(j, bit)
      if (i >= j) cycle
      kept = wave(i)
      wave(i) = wave(j)
      wave(j) = kept
    end do
  end subroutine reverse_bits

  !> Cooley and Tukey, radix two, with the positive sign.
  pure subroutine combine(wave)
    complex(dp), intent(inout) :: wave(0:)
    complex(dp) :: factor, odd
    real(dp) :: angle
    integer :: half, start, k

    half = 1
    do while (half < size(wave))
      do k = 0, half - 1
        angle = PI*real(k, dp)/real(half, dp)
        factor = cmplx(cos(angle), sin(angle), dp)
        do start = k, size(wave) - 1, 2*half
          odd = factor*wave(start + half)
          wave(start + half) = wave(start) - odd
          wave(start) = wave(start) + odd
        end do
      end do
      half = 2*half
    end do
  end subroutine combine

end module bench_waves
