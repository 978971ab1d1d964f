!> A dense influence matrix as an operator. The matrix stays the caller's: the operator
!> points to it and never copies it.
module fuge_matrix_operator
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_long_long
  use fuge_input_checks, only: find_asymmetry
  use fuge_kinds, only: dp
  use fuge_locks, only: new_stamp
  use fuge_matrix_survey, only: matrix_survey, survey_matrix
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW
  implicit none
  private

  !> Points whose rigid displacements differ by less than this fraction nearly coincide.
  real(dp), parameter :: ALIKE = 1.0e-3_dp
  !> A compliance up to this many units in the last place of its terms is rounding.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

  !> Largest asymmetry taken for rounding, relative to the range of the coefficients.
  real(dp), parameter :: SYMMETRY_TOLERANCE = 1.0e-10_dp

  !> A symmetric influence matrix in full storage: `set` it, then solve.
  type, extends(fuge_operator), public :: fuge_dense_operator
    !> The caller's matrix; rows beyond n are padding.
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    type(matrix_survey), private :: survey
    integer(c_long_long), private :: stamp_value = 0
  contains
    procedure :: set
    procedure :: set_surveyed
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => dense_magnitude
    procedure :: apply_with_magnitude => dense_apply_with_magnitude
    procedure :: least_pair_compliance => dense_pair_compliance
    procedure :: known => what_is_known
    procedure :: stamp
  end type fuge_dense_operator

  interface
    !> u = (A - datum) f: `force` (n), force; `displacement` (n), length; `status` is FUGE_DONE.
    !>
    !> By columns, four at a time, instead of by BLAS: the datum is subtracted from each coefficient before
    !> it is multiplied, and points without force cost nothing.
    module subroutine apply(self, force, displacement, status)
      class(fuge_dense_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine apply

    !> As `apply` and `magnitude`, in one pass over the columns of the points with force.
    module subroutine dense_apply_with_magnitude(self, force, displacement, magnitude, status)
      class(fuge_dense_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:), magnitude(:)
      integer, intent(out) :: status
    end subroutine dense_apply_with_magnitude
  end interface

contains

  !> Point to `alpha` as the influence matrix.
  !>
  !> `alpha` is (n, n), or (lda, n) with lda > n where the first n rows count; length per force. It is
  !> not copied: declare it `target`, and keep it unchanged until the operator is set again. After a change, even
  !> of one coefficient, set it again: solvers keep the factor of the matrix from solve to solve until then. Up to
  !> `threads` threads (default 1; 0: as many as there are cores) share the one pass over the matrix, which checks it.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW, FUGE_ERR_OPTION,
  !> FUGE_ERR_POINTER for a section that is not contiguous; they leave the operator as it was.
  subroutine set(self, alpha, info, threads)
    use fuge_threads, only: thread_team, usable_threads
    class(fuge_dense_operator), intent(inout) :: self
    real(dp), intent(in), target :: alpha(:, :)
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: threads
    real(dp), pointer, contiguous :: matrix(:, :)
    type(matrix_survey) :: survey
    type(thread_team) :: team

    if (.not. is_contiguous(alpha)) then
      call report(info, FUGE_ERR_POINTER, 'alpha is a section with gaps between its columns: pass the whole ' &
        //'array, whose first n rows count')
      return
    end if
    if (size(alpha, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(size(alpha, 2))//': alpha needs at least one column')
    else if (size(alpha, 1) < size(alpha, 2)) then
      call report(info, FUGE_ERR_SIZE, 'alpha has '//text(size(alpha, 1))//' rows and '//text(size(alpha, 2)) &
        //' columns: its leading dimension must be at least n')
    end if
    if (present(threads)) then
      if (threads < 0) call report(info, FUGE_ERR_OPTION, 'threads = '//text(threads) &
                                   //' is negative: use 0 for all cores, 1 for one thread, or more')
    end if
    if (info%failed()) return
    ! By its address, because the compiler does not know that alpha is contiguous.
    call c_f_pointer(c_loc(alpha(1, 1)), matrix, shape(alpha))
    if (present(threads)) call team%begin(merge(threads, usable_threads(), threads > 0))
    call survey_matrix(matrix, survey)
    call team%end()
    call judge_survey(matrix, survey, info)
    if (info%failed()) return
    self%alpha => matrix
    self%survey = survey
    self%stamp_value = new_stamp()
  end subroutine set

  !> Point to a square matrix of which all is known: its survey, and a stamp that no other matrix has.
  subroutine set_surveyed(self, alpha, survey, stamp)
    class(fuge_dense_operator), intent(inout) :: self
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    type(matrix_survey), intent(in) :: survey
    integer(c_long_long), intent(in) :: stamp

    call c_f_pointer(c_loc(alpha(1, 1)), self%alpha, shape(alpha))
    self%survey = survey
    self%stamp_value = stamp
  end subroutine set_surveyed

  !> The survey of the matrix.
  pure function what_is_known(self) result(survey)
    class(fuge_dense_operator), intent(in) :: self
    type(matrix_survey) :: survey

    survey = self%survey
  end function what_is_known

  !> A number that changes with every `set`, and that no other matrix has; 0 before `set`.
  pure function stamp(self)
    class(fuge_dense_operator), intent(in) :: self
    integer(c_long_long) :: stamp

    stamp = self%stamp_value
  end function stamp

  !> Number of points n; 0 before `set`.
  pure function points(self) result(n)
    class(fuge_dense_operator), intent(in) :: self
    integer :: n

    n = 0
    if (associated(self%alpha)) n = size(self%alpha, 2)
  end function points

  !> The coefficient nearest to zero, length per force; 0 if there are both signs.
  function datum(self)
    class(fuge_dense_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%survey%nearest_to_zero()
  end function datum

  !> `magnitude` (n), length: sum_j |A_ij - datum| |f_j| at each point, from `force` (n).
  subroutine dense_magnitude(self, force, displacement, magnitude)
    class(fuge_dense_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)
    real(dp) :: datum
    integer :: j, n

    n = size(displacement)
    datum = self%datum()
    magnitude = 0.0_dp
    do j = 1, n
      if (abs(force(j)) > 0.0_dp) magnitude = magnitude + abs((self%alpha(:n, j) - datum)*force(j))
    end do
  end subroutine dense_magnitude

  !> As in fuge_operator, from one pass over the coefficients of the contact.
  function dense_pair_compliance(self, contact, modes) result(compliance)
    class(fuge_dense_operator), intent(in) :: self
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: modes(:, :)
    real(dp) :: compliance
    real(dp) :: diagonal(size(contact)), value
    integer :: i, j

    diagonal = [(self%alpha(i, i), i=1, size(contact))]
    compliance = huge(compliance)
    do j = 2, size(contact)
      if (.not. contact(j)) cycle
      do i = 1, j - 1
        value = (diagonal(i) - self%alpha(i, j)) + (diagonal(j) - self%alpha(i, j))
        if (value >= compliance .or. .not. contact(i)) cycle
        if (.not. move_alike(modes(i, :), modes(j, :))) cycle
        if (value <= ROUNDINGS*epsilon(value)*(abs(diagonal(i)) + abs(diagonal(j)))) value = 0.0_dp
        compliance = value
      end do
    end do
  end function dense_pair_compliance

  !> Do rigid motions move two points alike, but for a small fraction of the largest displacement?
  pure function move_alike(one, other)
    real(dp), intent(in) :: one(:), other(:)
    logical :: move_alike

    move_alike = all(abs(one - other) <= ALIKE*max(maxval(abs(one)), maxval(abs(other))))
  end function move_alike

  !> Refuse a matrix (at least n, n) that its survey found not finite, too large or not symmetric.
  !>
  !> An asymmetry up to 1e-10 of the range of the coefficients passes as rounding. Contact is symmetric: another linear
  !> complementarity problem, such as a game or a program of optimisation with its multipliers, is none of fuge's.
  !> Errors: FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW.
  pure subroutine judge_survey(alpha, survey, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(matrix_survey), intent(in) :: survey
    type(fuge_info), intent(inout) :: info
    real(dp) :: weight(size(alpha, 2)), tolerance
    integer :: i, j, n

    n = size(alpha, 2)
    if (.not. survey%is_usable) then
      call check_finite_coefficients(alpha(:n, :), info)
      if (.not. info%failed()) call report(info, FUGE_ERR_OVERFLOW, 'alpha reaches from ' &
        //text(minval(alpha(:n, :)))//' to '//text(maxval(alpha(:n, :)))//': choose units in which it is smaller')
      return
    end if
    tolerance = SYMMETRY_TOLERANCE*(survey%most - survey%least)
    if (survey%asymmetry <= tolerance) return
    weight = 1.0_dp
    call find_asymmetry(alpha, weight, tolerance, i, j)
    call report(info, FUGE_ERR_NOT_SYMMETRIC, 'alpha('//index_text(i)//','//index_text(j)//') and alpha(' &
      //index_text(j)//','//index_text(i)//') differ by '//text(abs(alpha(i, j) - alpha(j, i))) &
      //' (coefficients from '//text(minval(alpha(:n, :)))//' to '//text(maxval(alpha(:n, :))) &
      //'): if that is rounding, pass (alpha + alpha^T)/2; if not, it is no contact problem, and the mean has ' &
      //'another answer')
  end subroutine judge_survey

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
