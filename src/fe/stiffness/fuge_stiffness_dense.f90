!> A stiffness matrix in full storage. The stiffness refers to the caller's array, or has a copy of compressed columns;
!> the factorisation alone fills a square.
module fuge_stiffness_dense
  use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
  use fuge_input_checks, only: find_asymmetry
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf, dpotrs
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_MEMORY
  use fuge_stiffness_check, only: check_entries, check_pair, SYMMETRY_TOLERANCE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_symmetric_columns, only: symmetric_columns
  implicit none
  private

  !> A stiffness matrix in full storage: `set` it, then condense.
  type, extends(fuge_stiffness), public :: fuge_dense_stiffness
    !> Columns of the caller's matrix; rows beyond the degrees of freedom are padding.
    real(dp), pointer, contiguous, private :: matrix(:, :) => null()
    !> A copy of compressed columns, if `matrix` is not associated.
    type(symmetric_columns), private :: entries
  contains
    procedure :: set
    procedure :: set_columns
    procedure :: degrees
    procedure :: diagonal
    procedure :: multiply
    procedure :: cholesky
  end type fuge_dense_stiffness

  type, extends(stiffness_factor) :: dense_factor
    real(dp), allocatable :: upper(:, :)
  contains
    procedure :: solve
  end type dense_factor

contains

  !> Use `matrix` as the stiffness matrix.
  !>
  !> `matrix` is (degrees, degrees), or (lda, degrees) with lda larger, both triangles
  !> filled; force per displacement. The array is not copied: declare it `target` and keep it
  !> unchanged as long as the stiffness is used.
  !> Errors, the stiffness unchanged: FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC.
  subroutine set(self, matrix, info)
    class(fuge_dense_stiffness), intent(inout) :: self
    real(dp), intent(in), target :: matrix(:, :)
    type(fuge_info), intent(out) :: info

    if (size(matrix, 2) < 1 .or. size(matrix, 1) < size(matrix, 2)) then
      call report(info, FUGE_ERR_SIZE, 'the stiffness matrix has '//text(size(matrix, 1))//' rows and ' &
                  //text(size(matrix, 2))//' columns: it needs at least one column, and a row for each')
    else if (.not. is_contiguous(matrix)) then
      call report(info, FUGE_ERR_POINTER, 'the stiffness matrix is a section with gaps between its columns: pass ' &
                  //'the whole array; rows beyond the degrees of freedom are ignored')
    else
      call check_stiffness(matrix, info)
    end if
    if (info%failed()) return
    ! Through an address, because only `set` knows that the matrix is contiguous.
    call c_f_pointer(c_loc(matrix(1, 1)), self%matrix, shape(matrix))
    call self%entries%clear()
  end subroutine set

  !> Copy a stiffness matrix in compressed columns; arguments as in `fuge_stiffness_type`.
  subroutine set_columns(self, column, row, value, info)
    class(fuge_dense_stiffness), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info

    call self%entries%set(column, row, value, info)
    if (.not. info%failed()) nullify (self%matrix)
  end subroutine set_columns

  !> Number of degrees of freedom; 0 before `set`.
  pure function degrees(self)
    class(fuge_dense_stiffness), intent(in) :: self
    integer :: degrees

    degrees = self%entries%degrees()
    if (associated(self%matrix)) degrees = size(self%matrix, 2)
  end function degrees

  !> The diagonal of K: `terms` (degrees), force per displacement.
  pure subroutine diagonal(self, terms)
    class(fuge_dense_stiffness), intent(in) :: self
    real(dp), intent(out) :: terms(:)
    integer :: j

    if (.not. associated(self%matrix)) then
      call self%entries%diagonal(terms)
      return
    end if
    do j = 1, self%degrees()
      terms(j) = self%matrix(j, j)
    end do
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(fuge_dense_stiffness), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: product(:), magnitude(:)
    integer :: j, n

    if (.not. associated(self%matrix)) then
      call self%entries%multiply(u, product, magnitude)
      return
    end if
    n = self%degrees()
    product = 0.0_dp
    magnitude = 0.0_dp
    do j = 1, n
      if (.not. abs(u(j)) > 0.0_dp) cycle
      product = product + self%matrix(:n, j)*u(j)
      magnitude = magnitude + abs(self%matrix(:n, j)*u(j))
    end do
  end subroutine multiply

  !> Cholesky factor of the constrained matrix; arguments as in `fuge_stiffness_type`.
  subroutine cholesky(self, constrained, shift, factor, pivots, failed, status)
    class(fuge_dense_stiffness), intent(in) :: self
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    class(stiffness_factor), allocatable, intent(out) :: factor
    real(dp), intent(out) :: pivots(:)
    integer, intent(out) :: failed, status
    type(dense_factor), allocatable :: own
    integer :: j, n, stat

    n = self%degrees()
    pivots = 0.0_dp
    failed = 0
    status = FUGE_ERR_MEMORY
    allocate (own, stat=stat)
    if (stat == 0) allocate (own%upper(n, n), stat=stat)
    if (stat /= 0) return
    status = FUGE_DONE
    if (associated(self%matrix)) then
      call copy_constrained(self%matrix, constrained, shift, own%upper)
    else
      call fill_constrained(self%entries, constrained, shift, own%upper)
    end if
    call dpotrf('U', n, own%upper, n, failed)
    if (failed /= 0) return
    do j = 1, n
      pivots(j) = own%upper(j, j)**2
    end do
    call move_alloc(own, factor)
  end subroutine cholesky

  !> The upper triangle with the constrained rows and columns replaced by those of the
  !> identity, the rest of the diagonal multiplied by 1 + `shift`.
  pure subroutine copy_constrained(matrix, constrained, shift, upper)
    real(dp), intent(in) :: matrix(:, :), shift
    logical, intent(in) :: constrained(:)
    real(dp), intent(out) :: upper(:, :)
    integer :: j

    do j = 1, size(constrained)
      if (constrained(j)) then
        upper(:j - 1, j) = 0.0_dp
        upper(j, j) = 1.0_dp
      else
        upper(:j - 1, j) = merge(0.0_dp, matrix(:j - 1, j), constrained(:j - 1))
        upper(j, j) = matrix(j, j)*(1.0_dp + shift)
      end if
    end do
  end subroutine copy_constrained

  !> As `copy_constrained`, from compressed columns.
  pure subroutine fill_constrained(matrix, constrained, shift, upper)
    type(symmetric_columns), intent(in) :: matrix
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    real(dp), intent(out) :: upper(:, :)
    integer :: i, j, p

    upper = 0.0_dp
    do j = 1, size(constrained)
      do p = matrix%upper%column(j), matrix%upper%column(j + 1) - 1
        i = matrix%upper%row(p)
        if (.not. (constrained(i) .or. constrained(j))) upper(i, j) = matrix%upper%value(p)
      end do
      if (constrained(j)) upper(j, j) = 1.0_dp
      if (.not. constrained(j)) upper(j, j) = upper(j, j)*(1.0_dp + shift)
    end do
  end subroutine fill_constrained

  !> Replace loads by displacements; arguments as in `fuge_stiffness_type`.
  subroutine solve(self, block, status)
    class(dense_factor), intent(in) :: self
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: status
    integer :: lapack_info

    call dpotrs('U', size(block, 1), size(block, 2), self%upper, size(self%upper, 1), block, size(block, 1), &
                lapack_info)
    status = FUGE_DONE
  end subroutine solve

  !> Refuse entries that are not finite or near overflow, and a matrix that is not symmetric.
  pure subroutine check_stiffness(matrix, info)
    real(dp), intent(in), contiguous :: matrix(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp) :: weight(size(matrix, 2))
    integer :: i, j, n

    n = size(matrix, 2)
    do j = 1, n
      call check_entries(matrix(:n, j), 1, j, info)
      if (info%failed()) return
      weight(j) = sqrt(abs(matrix(j, j)))
    end do
    call find_asymmetry(matrix, weight, SYMMETRY_TOLERANCE, i, j)
    if (i > 0) call check_pair(j, i, matrix(j, i), matrix(i, j), matrix(j, j), matrix(i, i), info)
  end subroutine check_stiffness

end module fuge_stiffness_dense
