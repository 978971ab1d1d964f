!> Bounds of the eigenvalues of convolutions and of the rounding of their products.
!>
!> A convolution on a circle multiplies waves by eigenvalues, and its compression to some of the cells, a Toeplitz
!> matrix, has no eigenvalue beyond them. A transform of N values is off, in the 2-norm, by at most log2(N) small
!> multiples of the unit roundoff (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, theorem 24.2, for
!> powers of two); the multiples here hold for butterflies of any prime up to 13 with p terms in each sum. FFTW has
!> other algorithms for larger primes, of which nothing is said here.
module fuge_spectrum_bounds
  use fuge_kinds, only: dp
  implicit none
  private

  public :: transform_rounding

  !> Eigenvalues of a periodic surface are off by at most this fraction.
  real(dp), parameter, public :: WAVE_ERROR = 2.0_dp**(-46)
  real(dp), parameter :: UNIT_ROUNDOFF = 0.5_dp*epsilon(1.0_dp)
  !> Units in the last place for each factor of two, and for packing real numbers and multiplying by roots of unity.
  real(dp), parameter :: FACTOR_OF_TWO = 8.0_dp, PACKING = 24.0_dp
  integer, parameter :: PRIMES(5) = [3, 5, 7, 11, 13]

  !> The eigenvalues of a convolution.
  type, public :: spectrum_bounds
    !> `constant`: eigenvalue of the constant vector; `least`, `most`: bounds of the others' magnitudes; `together`:
    !> 2-norm of all.
    real(dp) :: constant = 0.0_dp, least = huge(1.0_dp), most = 0.0_dp, together = 0.0_dp
  contains
    procedure :: add_waves
    procedure :: scale_by
    procedure :: norm
  end type spectrum_bounds

contains

  !> Add the eigenvalues of waves other than the constant, at most `times` of each.
  pure subroutine add_waves(self, eigenvalues, times)
    class(spectrum_bounds), intent(inout) :: self
    real(dp), intent(in) :: eigenvalues(:)
    integer, intent(in) :: times
    real(dp) :: largest

    if (size(eigenvalues) < 1) return
    self%least = min(self%least, minval(eigenvalues))
    largest = maxval(abs(eigenvalues))
    self%most = max(self%most, largest)
    ! As fractions of the largest, because squares of compliances may be out of range.
    if (largest > 0.0_dp) self%together = hypot(self%together, &
                                                largest*sqrt(real(times, dp)*sum((eigenvalues/largest)**2)))
  end subroutine add_waves

  !> Multiply all eigenvalues by a positive `factor`.
  pure subroutine scale_by(self, factor)
    class(spectrum_bounds), intent(inout) :: self
    real(dp), intent(in) :: factor

    self%constant = factor*self%constant
    if (self%least < huge(1.0_dp)) self%least = factor*self%least
    self%most = factor*self%most
    self%together = factor*self%together
  end subroutine scale_by

  !> An upper bound of the 2-norm of all eigenvalues together.
  pure function norm(self)
    class(spectrum_bounds), intent(in) :: self
    real(dp) :: norm

    norm = 1.001_dp*self%together
  end function norm

  !> By how much a transform of `length` real values, or of half as many complex ones, is off at most, relative to the
  !> 2-norm; huge if that is not known.
  pure function transform_rounding(length) result(rounding)
    integer, intent(in) :: length
    real(dp) :: rounding
    integer :: k, rest

    rounding = PACKING
    rest = length
    do while (mod(rest, 2) == 0 .and. rest > 0)
      rounding = rounding + FACTOR_OF_TWO
      rest = rest/2
    end do
    do k = 1, size(PRIMES)
      do while (mod(rest, PRIMES(k)) == 0 .and. rest > 0)
        rounding = rounding + 2.0_dp*sqrt(real(PRIMES(k), dp))*real(PRIMES(k) + 4, dp)
        rest = rest/PRIMES(k)
      end do
    end do
    rounding = 1.01_dp*UNIT_ROUNDOFF*rounding
    if (rest /= 1) rounding = huge(rounding)
  end function transform_rounding

end module fuge_spectrum_bounds
