!> The survey of an influence matrix in one pass: whether all of it is usable, its extremes, how symmetric it is, and
!> whether any pair of points is unstable.
!>
!> The pass reads each coefficient once, in tiles together with the one on the other side of the diagonal. Most matrices
!> are symmetric to the last bit: then the half below the diagonal is all there is to look at. An operator keeps the
!> result, so that a solve has nothing left to check.
module fuge_matrix_survey
  use fuge_kinds, only: dp
  implicit none
  private

  public :: survey_matrix

  !> A negative energy below this fraction of the coefficients is rounding.
  real(dp), parameter, public :: PAIR_TOLERANCE = 1.0e-12_dp

  type, public :: matrix_survey
    !> All coefficients are finite, and small enough to be summed. If not, nothing else here is known.
    logical :: is_usable = .false.
    !> Extreme coefficients.
    real(dp) :: least = 0.0_dp, most = 0.0_dp
    !> Largest difference of two coefficients that ought to be equal.
    real(dp) :: asymmetry = 0.0_dp
    !> No pair of opposite forces gains energy.
    logical :: pairs_hold = .false.
  contains
    procedure :: largest
    procedure :: nearest_to_zero
  end type matrix_survey

  interface
    !> Survey the first n rows of `alpha` (at least n, n).
    module subroutine survey_matrix(alpha, survey)
      real(dp), intent(in), target, contiguous :: alpha(:, :)
      type(matrix_survey), intent(out) :: survey
    end subroutine survey_matrix
  end interface

contains

  !> The largest coefficient without its sign.
  pure function largest(self)
    class(matrix_survey), intent(in) :: self
    real(dp) :: largest

    largest = max(abs(self%least), abs(self%most))
  end function largest

  !> The coefficient nearest to zero, or 0 if there are both signs: subtracting it from the coefficients costs no
  !> digits.
  pure function nearest_to_zero(self) result(datum)
    class(matrix_survey), intent(in) :: self
    real(dp) :: datum

    datum = max(self%least, 0.0_dp) + min(self%most, 0.0_dp)
  end function nearest_to_zero

end module fuge_matrix_survey
