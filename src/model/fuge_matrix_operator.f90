!> A dense influence matrix as an operator. The matrix stays the caller's: the operator
!> points to it and never copies it.
module fuge_matrix_operator
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: find_asymmetry
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW
  implicit none
  private

  !> Largest asymmetry taken for rounding, relative to the range of the coefficients.
  real(dp), parameter :: SYMMETRY_TOLERANCE = 1.0e-10_dp

  !> A symmetric influence matrix in full storage: `set` it, then solve.
  type, extends(fuge_operator), public :: fuge_dense_operator
    !> The caller's matrix; rows beyond n are padding.
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    !> The coefficient nearest to zero, or 0 if there are both signs: subtracting it from the
    !> coefficients costs no digits.
    real(dp), private :: datum_value = 0.0_dp
  contains
    procedure :: set
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => dense_magnitude
  end type fuge_dense_operator

contains

  !> Point to `alpha` as the influence matrix.
  !>
  !> `alpha` is (n, n), or (lda, n) with lda > n where the first n rows count; length per force. It is
  !> not copied: declare it `target` and keep it unchanged as long as the operator lives.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_POINTER for a section that is not contiguous; they leave the operator as it was.
  subroutine set(self, alpha, info)
    class(fuge_dense_operator), intent(inout) :: self
    real(dp), intent(in), target :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: least, most

    if (.not. is_contiguous(alpha)) then
      call report(info, FUGE_ERR_POINTER, 'alpha is a section with gaps between its columns: pass the whole ' &
        //'array, whose first n rows count')
      return
    end if
    call check_influence_matrix(alpha, info, least, most)
    if (info%failed()) return
    self%datum_value = max(least, 0.0_dp) + min(most, 0.0_dp)
    ! By its address, because the compiler does not know that alpha is contiguous.
    call c_f_pointer(c_loc(alpha(1, 1)), self%alpha, shape(alpha))
  end subroutine set

  !> Number of points n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_dense_operator), intent(in) :: self
    integer :: n

    n = 0
    if (associated(self%alpha)) n = size(self%alpha, 2)
  end function points

  !> u = (A - datum) f: `force` (n), force; `displacement` (n), length; `status` is FUGE_DONE.
  !>
  !> Column by column instead of by BLAS: the datum is subtracted from each coefficient before
  !> it is multiplied, and points without force cost nothing.
  subroutine apply(self, force, displacement, status)
    class(fuge_dense_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status
    integer :: j, n

    n = self%points()
    displacement = 0.0_dp
    do j = 1, n
      if (abs(force(j)) > 0.0_dp) displacement = displacement + (self%alpha(:n, j) - self%datum_value)*force(j)
    end do
    status = FUGE_DONE
  end subroutine apply

  !> The coefficient nearest to zero, length per force; 0 if there are both signs.
  function datum(self)
    class(fuge_dense_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%datum_value
  end function datum

  !> `magnitude` (n), length: sum_j |A_ij - datum| |f_j| at each point, from `force` (n).
  subroutine dense_magnitude(self, force, displacement, magnitude)
    class(fuge_dense_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    integer :: j, n

    n = size(displacement)
    magnitude = 0.0_dp
    do j = 1, n
      if (abs(force(j)) > 0.0_dp) magnitude = magnitude + abs((self%alpha(:n, j) - self%datum_value)*force(j))
    end do
  end subroutine dense_magnitude

  !> Refuse a matrix with fewer rows than columns, one that is not finite or not symmetric;
  !> `least` and `most` are its extreme coefficients.
  !>
  !> An asymmetry up to 1e-10 of the range of the coefficients passes as rounding.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW.
  pure subroutine check_influence_matrix(alpha, info, least, most)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), intent(out) :: least, most
    real(dp) :: weight(size(alpha, 2))
    integer :: i, j, n

    least = 0.0_dp
    most = 0.0_dp
    n = size(alpha, 2)
    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(n)//': alpha needs at least one column')
    else if (size(alpha, 1) < n) then
      call report(info, FUGE_ERR_SIZE, 'alpha has '//text(size(alpha, 1))//' rows and '//text(n) &
        //' columns: its leading dimension must be at least n')
    else
      call check_finite_coefficients(alpha(:n, :), info)
    end if
    if (info%failed()) return
    least = minval(alpha(:n, :))
    most = maxval(alpha(:n, :))
    if (max(exponent(least), exponent(most)) > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'alpha reaches from '//text(least)//' to '//text(most) &
        //': choose units in which it is smaller')
      return
    end if
    weight = 1.0_dp
    call find_asymmetry(alpha, weight, SYMMETRY_TOLERANCE*(most - least), i, j)
    if (i > 0) then
      call report(info, FUGE_ERR_NOT_SYMMETRIC, 'alpha('//index_text(i)//','//index_text(j)//') and alpha(' &
        //index_text(j)//','//index_text(i)//') differ by '//text(abs(alpha(i, j) - alpha(j, i))) &
        //' (coefficients from '//text(least)//' to '//text(most) &
        //'): if that is rounding, pass (alpha + alpha^T)/2')
    end if
  end subroutine check_influence_matrix

  pure subroutine check_finite_coefficients(alpha, info)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: i, j

    do j = 1, size(alpha, 2)
      do i = 1, size(alpha, 1)
        if (ieee_is_finite(alpha(i, j))) cycle
        call report(info, FUGE_ERR_NOT_FINITE, 'alpha('//index_text(i)//','//index_text(j)//') = ' &
          //text(alpha(i, j))//' is not a finite number')
        return
      end do
    end do
  end subroutine check_finite_coefficients

end module fuge_matrix_operator
