!> A sparse stiffness matrix, factorised by CHOLMOD. It is a library of its own, so that programs
!> that do not need it need not link it.
module fuge_sparse
  use fuge_cholmod_factor, only: cholmod_factor
  use fuge_compressed_columns, only: compressed_columns
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MEMORY
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_symmetric_columns, only: symmetric_columns
  implicit none
  private

  !> A sparse stiffness matrix in compressed columns: `set` it, then condense.
  type, extends(fuge_stiffness), public :: fuge_sparse_stiffness
    type(symmetric_columns), private :: matrix
  contains
    procedure :: set
    procedure :: set_columns => set
    procedure :: degrees
    procedure :: diagonal
    procedure :: multiply
    procedure :: copy_columns
    procedure :: cholesky
    procedure :: can_order
  end type fuge_sparse_stiffness

contains

  !> Copy a stiffness matrix in compressed columns, counted from 1.
  !>
  !> `column` (degrees + 1), `row` and `value` (column(degrees + 1) - 1): column j holds
  !> the entries column(j) .. column(j + 1) - 1, force per displacement. The rows of a column
  !> may be in any order, repeated entries are added; the matrix has both triangles, or one of
  !> them.
  !> Errors, the stiffness unchanged: FUGE_ERR_SIZE, FUGE_ERR_DOF for a row out of range,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_MEMORY.
  subroutine set(self, column, row, value, info)
    class(fuge_sparse_stiffness), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info

    call self%matrix%set(column, row, value, info)
  end subroutine set

  !> Number of degrees of freedom; 0 before `set`.
  pure function degrees(self)
    class(fuge_sparse_stiffness), intent(in) :: self
    integer :: degrees

    degrees = self%matrix%degrees()
  end function degrees

  !> The diagonal of K: `terms` (degrees), force per displacement.
  pure subroutine diagonal(self, terms)
    class(fuge_sparse_stiffness), intent(in) :: self
    real(dp), intent(out) :: terms(:)

    call self%matrix%diagonal(terms)
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(fuge_sparse_stiffness), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: product(:), magnitude(:)

    call self%matrix%multiply(u, product, magnitude)
  end subroutine multiply

  !> Columns of K; arguments as in `fuge_stiffness_type`.
  subroutine copy_columns(self, chosen, block)
    class(fuge_sparse_stiffness), intent(in) :: self
    integer, intent(in) :: chosen(:)
    real(dp), intent(out), contiguous :: block(:, :)

    call self%matrix%copy_columns(chosen, block)
  end subroutine copy_columns

  !> CHOLMOD takes any order.
  pure function can_order(self)
    class(fuge_sparse_stiffness), intent(in) :: self
    logical :: can_order

    can_order = self%degrees() > 0
  end function can_order

  !> Cholesky factor of the constrained matrix; arguments as in `fuge_stiffness_type`.
  subroutine cholesky(self, constrained, shift, factor, pivots, failed, status)
    class(fuge_sparse_stiffness), intent(in) :: self
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    class(stiffness_factor), allocatable, intent(out) :: factor
    real(dp), intent(out) :: pivots(:)
    integer, intent(out) :: failed, status
    type(cholmod_factor), allocatable :: own
    type(compressed_columns) :: matrix
    integer :: stat

    pivots = 0.0_dp
    failed = 0
    status = FUGE_ERR_MEMORY
    call copy_constrained(self%matrix%upper, constrained, shift, matrix, stat)
    if (stat == 0) allocate (own, stat=stat)
    if (stat /= 0) return
    if (allocated(self%last)) then
      ! The diagonal is the last entry of a column.
      associate (diagonal => matrix%column(self%last + 1) - 1)
        matrix%value(diagonal) = matrix%value(diagonal)*(1.0_dp + self%stiffening)
      end associate
      call own%factorise(matrix, self%last, self%columns, pivots, failed, status)
    else
      call own%factorise(matrix, [integer ::], 0, pivots, failed, status)
    end if
    if (status == FUGE_DONE .and. failed == 0) call move_alloc(own, factor)
  end subroutine cholesky

  !> The upper triangle with the constrained rows and columns replaced by those of the
  !> identity, the rest of the diagonal multiplied by 1 + `shift`.
  pure subroutine copy_constrained(upper, constrained, shift, matrix, stat)
    type(compressed_columns), intent(in) :: upper
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    type(compressed_columns), intent(out) :: matrix
    integer, intent(out) :: stat
    integer :: i, j, p, q

    allocate (matrix%column(size(upper%column)), matrix%row(size(upper%row) + count(constrained)), &
              matrix%value(size(upper%row) + count(constrained)), stat=stat)
    if (stat /= 0) return
    q = 0
    matrix%column(1) = 1
    do j = 1, size(constrained)
      if (constrained(j)) then
        q = q + 1
        matrix%row(q) = j
        matrix%value(q) = 1.0_dp
      else
        do p = upper%column(j), upper%column(j + 1) - 1
          i = upper%row(p)
          if (constrained(i)) cycle
          q = q + 1
          matrix%row(q) = i
          matrix%value(q) = upper%value(p)
          if (i == j) matrix%value(q) = matrix%value(q)*(1.0_dp + shift)
        end do
      end if
      matrix%column(j + 1) = q + 1
    end do
  end subroutine copy_constrained

end module fuge_sparse
