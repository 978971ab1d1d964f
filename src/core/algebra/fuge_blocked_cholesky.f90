!> Cholesky factors of large matrices in blocks that threads share, and forward substitution with many columns.
!>
!> Blocks are the same for any number of threads, and each is the work of one call of BLAS, so that results are the same
!> to the last bit. Small matrices are left to one call of LAPACK.
module fuge_blocked_cholesky
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm, dpotrf, dsyrk, dtrsm
  use fuge_threads, only: run_in_parts, work_in_parts
  implicit none
  private

  public :: factor_in_blocks, solve_in_blocks

  !> Matrices of at least this many rows are worked on in blocks.
  integer, parameter :: MANY_ROWS = 512
  !> Columns of a block of the factor, and of right-hand sides.
  integer, parameter :: BLOCK = 128, RIGHT_SIDES = 32

  !> What follows the factor of the columns from `first` on: the rows below them, then the square tiles behind them.
  type, extends(work_in_parts) :: trailing_work
    real(dp), pointer, contiguous :: matrix(:, :) => null()
    integer :: first = 1
    logical :: solves = .true.
  contains
    procedure :: do_part => do_trailing_part
  end type trailing_work

  type, extends(work_in_parts) :: substitution_work
    real(dp), pointer, contiguous :: lower(:, :) => null(), right(:, :) => null()
  contains
    procedure :: do_part => substitute_part
  end type substitution_work

contains

  !> The Cholesky factor of a symmetric positive definite matrix, whose lower half is read and replaced. `info` is 0,
  !> or positive if the matrix is not positive definite.
  subroutine factor_in_blocks(matrix, info)
    real(dp), intent(inout), target, contiguous :: matrix(:, :)
    integer, intent(out) :: info
    type(trailing_work) :: work
    integer :: blocks, n

    n = size(matrix, 2)
    info = 0
    if (n < MANY_ROWS) then
      if (n > 0) call dpotrf('L', n, matrix, size(matrix, 1), info)
      return
    end if
    work%matrix => matrix
    do while (work%first <= n)
      call factor_diagonal(size(matrix, 1), n, matrix, work%first, info)
      if (info /= 0) return
      blocks = (n - work%first)/BLOCK
      if (blocks > 0) then
        work%solves = .true.
        call run_in_parts(blocks, work)
        work%solves = .false.
        call run_in_parts((blocks*(blocks + 1))/2, work)
      end if
      work%first = work%first + BLOCK
    end do
  end subroutine factor_in_blocks

  subroutine factor_diagonal(lda, n, matrix, first, info)
    integer, intent(in) :: lda, n, first
    real(dp), intent(inout) :: matrix(lda, n)
    integer, intent(out) :: info

    call dpotrf('L', min(BLOCK, n - first + 1), matrix(first, first), lda, info)
  end subroutine factor_diagonal

  subroutine do_trailing_part(self, part, parts)
    class(trailing_work), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: column, row

    if (part >= parts) return
    if (self%solves) then
      call solve_rows(size(self%matrix, 1), size(self%matrix, 2), self%matrix, self%first, &
                      self%first + (part + 1)*BLOCK)
      return
    end if
    ! Tiles are numbered row by row.
    row = 0
    column = part
    do while (column > row)
      row = row + 1
      column = column - row
    end do
    call update_tile(size(self%matrix, 1), size(self%matrix, 2), self%matrix, self%first, &
                     self%first + (row + 1)*BLOCK, self%first + (column + 1)*BLOCK)
  end subroutine do_trailing_part

  !> The rows from `row` on of the block of columns from `first` on of the factor.
  subroutine solve_rows(lda, n, matrix, first, row)
    integer, intent(in) :: lda, n, first, row
    real(dp), intent(inout) :: matrix(lda, n)

    call dtrsm('R', 'L', 'T', 'N', min(BLOCK, n - row + 1), BLOCK, 1.0_dp, matrix(first, first), lda, &
               matrix(row, first), lda)
  end subroutine solve_rows

  !> Subtract the product of the block of columns from `first` on of the factor from the tile at `row` and `column`.
  subroutine update_tile(lda, n, matrix, first, row, column)
    integer, intent(in) :: lda, n, first, row, column
    real(dp), intent(inout) :: matrix(lda, n)
    integer :: rows

    rows = min(BLOCK, n - row + 1)
    if (row == column) then
      call dsyrk('L', 'N', rows, BLOCK, -1.0_dp, matrix(row, first), lda, 1.0_dp, matrix(row, row), lda)
    else
      call dgemm('N', 'T', rows, BLOCK, BLOCK, -1.0_dp, matrix(row, first), lda, matrix(column, first), lda, 1.0_dp, &
                 matrix(row, column), lda)
    end if
  end subroutine update_tile

  !> Replace the columns of `right` by their solutions with the lower triangular matrix `lower`.
  subroutine solve_in_blocks(lower, right)
    real(dp), intent(in), target, contiguous :: lower(:, :)
    real(dp), intent(inout), target, contiguous :: right(:, :)
    type(substitution_work) :: work

    if (size(right) < 1) return
    if (size(lower, 2) < MANY_ROWS .or. size(right, 2) <= RIGHT_SIDES) then
      call dtrsm('L', 'L', 'N', 'N', size(lower, 2), size(right, 2), 1.0_dp, lower, size(lower, 1), right, &
                 size(right, 1))
      return
    end if
    work%lower => lower
    work%right => right
    call run_in_parts((size(right, 2) + RIGHT_SIDES - 1)/RIGHT_SIDES, work)
  end subroutine solve_in_blocks

  subroutine substitute_part(self, part, parts)
    class(substitution_work), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last

    if (part >= parts) return
    first = part*RIGHT_SIDES + 1
    last = min(first + RIGHT_SIDES - 1, size(self%right, 2))
    call dtrsm('L', 'L', 'N', 'N', size(self%lower, 2), last - first + 1, 1.0_dp, self%lower, size(self%lower, 1), &
               self%right(:, first:last), size(self%right, 1))
  end subroutine substitute_part

end module fuge_blocked_cholesky
