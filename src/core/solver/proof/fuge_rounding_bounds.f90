!> Bounds of the rounding of sums and products, themselves rounded up.
!>
!> Sums of n terms in double precision, in any order and with fused or separate products, are off by at most
!> gamma(n) = n u/(1 - n u) of the sum of the magnitudes of their terms (N. J. Higham, Accuracy and Stability of
!> Numerical Algorithms, 2002, section 3.1), as long as nothing underflows. What may underflow is a product of numbers
!> that are scaled to at most about 1, and is covered by LEAST.
module fuge_rounding_bounds
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  implicit none
  private

  public :: absolute_product, absolute_sums, gamma_bound, norm_bound, raised

  !> The unit roundoff.
  real(dp), parameter, public :: UNIT_ROUNDOFF = 0.5_dp*epsilon(1.0_dp)
  !> More than all that underflow can change in a sum of scaled numbers.
  real(dp), parameter, public :: LEAST = 2.0_dp**(-960)

contains

  !> gamma(n), rounded up, for n up to 2**40.
  pure function gamma_bound(n) result(bound)
    integer, intent(in) :: n
    real(dp) :: bound

    bound = 1.01_dp*real(n, dp)*UNIT_ROUNDOFF
  end function gamma_bound

  !> A non-negative `value` that was computed with up to n roundings, raised so that it is not below the exact one.
  elemental function raised(value, n)
    real(dp), intent(in) :: value
    integer, intent(in) :: n
    real(dp) :: raised

    raised = value*(1.0_dp + 1.02_dp*real(n + 2, dp)*UNIT_ROUNDOFF)
  end function raised

  !> An upper bound of |matrix| x, for x >= 0.
  pure subroutine absolute_product(matrix, x, y)
    real(dp), intent(in) :: matrix(:, :), x(:)
    real(dp), intent(out) :: y(:)
    integer :: j

    y = 0.0_dp
    do j = 1, size(x)
      if (x(j) > 0.0_dp) y = y + abs(matrix(:, j))*x(j)
    end do
    y = raised(y, size(x) + 1) + LEAST
  end subroutine absolute_product

  !> An upper bound of |transpose of matrix| x, for x >= 0.
  pure subroutine absolute_sums(matrix, x, y)
    real(dp), intent(in) :: matrix(:, :), x(:)
    real(dp), intent(out) :: y(:)
    integer :: j

    do j = 1, size(y)
      y(j) = raised(sum(abs(matrix(:, j))*x), size(x) + 1) + LEAST
    end do
  end subroutine absolute_sums

  !> An upper bound of the 2-norm, whose squares neither overflow nor underflow; huge of what is not finite.
  pure function norm_bound(values) result(bound)
    real(dp), intent(in) :: values(:)
    real(dp) :: bound
    real(dp) :: largest

    bound = 0.0_dp
    if (size(values) < 1) return
    bound = huge(1.0_dp)
    if (.not. all(ieee_is_finite(values))) return
    largest = maxval(abs(values))
    bound = 0.0_dp
    if (.not. largest > 0.0_dp) return
    bound = raised(largest*sqrt(sum((values/largest)**2)), size(values) + 8)
  end function norm_bound

end module fuge_rounding_bounds
