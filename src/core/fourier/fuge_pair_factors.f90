!> The factors that multiply the transform of pairs of values, where the spectrum of an even kernel would multiply that
!> of the values.
!>
!> N even values are transformed as N/2 complex numbers z_j = x_2j + i x_(2j+1). With theta = 2 pi k/N and the spectrum
!> s, their transform Z becomes
!>
!>     Z'_k = (a - b sin(theta)) Z_k + i b cos(theta) conj(Z_(N/2-k)),   a, b = (s_k +- s_(N/2-k))/2.
!>
!> The factors of k are a -+ b sin(theta), those of Z_k and Z_(N/2-k) in their own numbers, and b cos(theta); twice as
!> large, because spectra are divided by the number of real values, not of complex ones.
module fuge_pair_factors
  use fuge_kinds, only: dp
  implicit none
  private

  public :: pair_factors, soften

contains

  !> The factors of number k, whose number of the spectrum is `one`; `other` that of N/2 - k, `root` real and imaginary
  !> parts of exp(-2 pi i k/N).
  pure function pair_factors(one, other, root) result(factors)
    real(dp), intent(in) :: one, other, root(2)
    real(dp) :: factors(3)

    associate (mean => one + other, half_difference => one - other)
      factors = [mean + half_difference*root(2), mean - half_difference*root(2), half_difference*root(1)]
    end associate
  end function pair_factors

  !> The factors of the spectrum s/(1 + softening s) from those of s, `factors` (3, :).
  pure subroutine soften(softening, factors)
    real(dp), intent(in) :: softening
    real(dp), intent(inout), contiguous :: factors(:, :)
    real(dp) :: difference, mean, product, reduction
    integer :: k

    do k = 1, size(factors, 2)
      ! Sum, square of the difference and product of the two numbers whose factors these are.
      mean = 0.5_dp*(factors(1, k) + factors(2, k))
      difference = 0.5_dp*(factors(2, k) - factors(1, k))
      product = 0.25_dp*(mean**2 - (difference**2 + factors(3, k)**2))
      reduction = 1.0_dp/(1.0_dp + softening*(mean + softening*product))
      mean = reduction*(mean + 2.0_dp*softening*product)
      difference = reduction*difference
      factors(:, k) = [mean - difference, mean + difference, reduction*factors(3, k)]
    end do
  end subroutine soften

end module fuge_pair_factors
