!> Sparse matrices: from triplets (row, column, value) in any order to compressed columns.
module fuge_compressed_columns
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: append, compress_columns, order_triplets, reserve, sum_overflows

  !> Entries of a matrix in any order; entries of the same row and column are contributions to one sum.
  type, public :: matrix_triplets
    integer :: count = 0
    integer, allocatable :: row(:), column(:)
    real(dp), allocatable :: value(:)
  end type matrix_triplets

  !> Compressed columns: column j holds the entries column(j) .. column(j + 1) - 1 of `row` and
  !> `value`, with ascending rows.
  type, public :: compressed_columns
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
  end type compressed_columns

contains

  !> Allocate memory for `most` entries, less than the largest integer, before the first `append`.
  !> `status` is not zero without memory.
  pure subroutine reserve(triplets, most, status)
    type(matrix_triplets), intent(inout) :: triplets
    integer(int64), intent(in) :: most
    integer, intent(out) :: status
    integer :: stat

    triplets%count = 0
    status = 1
    if (most >= int(huge(1), int64)) return
    allocate (triplets%row(most), triplets%column(most), triplets%value(most), stat=stat)
    if (stat == 0) status = 0
  end subroutine reserve

  !> Add an entry to reserved memory.
  pure subroutine append(triplets, row, column, value)
    type(matrix_triplets), intent(inout) :: triplets
    integer, intent(in) :: row, column
    real(dp), intent(in) :: value

    triplets%count = triplets%count + 1
    triplets%row(triplets%count) = row
    triplets%column(triplets%count) = column
    triplets%value(triplets%count) = value
  end subroutine append

  !> Sort triplets into compressed columns and add entries of the same row and column in the
  !> order in which they came. The time is proportional to the numbers of entries, rows and columns.
  !>
  !> `rows`, `columns`: size of the matrix. `overflow` is the number of an entry of `compressed`
  !> whose sum overflows, else 0. `status` is not zero without memory.
  pure subroutine compress_columns(triplets, rows, columns, compressed, overflow, status)
    type(matrix_triplets), intent(in) :: triplets
    integer, intent(in) :: rows, columns
    type(compressed_columns), intent(out) :: compressed
    integer, intent(out) :: overflow, status
    integer, allocatable :: order(:)
    integer :: entries

    overflow = 0
    entries = triplets%count
    call order_triplets(triplets, rows, columns, order, compressed%column, status)
    if (status == 0) allocate (compressed%row(entries), compressed%value(entries), stat=status)
    if (status /= 0) return
    compressed%row = triplets%row(order)
    compressed%value = triplets%value(order)
    deallocate (order)
    call sum_repeated(compressed, overflow)
    if (overflow == 0) call shorten(compressed, status)
  end subroutine compress_columns

  !> Order of triplets by columns, in each column by rows, entries of both the same as they
  !> came: column j has the triplets order(column(j) : column(j + 1) - 1).
  pure subroutine order_triplets(triplets, rows, columns, order, column, status)
    type(matrix_triplets), intent(in) :: triplets
    integer, intent(in) :: rows, columns
    integer, allocatable, intent(out) :: order(:), column(:)
    integer, intent(out) :: status
    integer, allocatable :: first(:), scratch(:)
    integer :: k, n

    n = triplets%count
    allocate (order(n), column(columns + 1), first(rows + 1), scratch(n), stat=status)
    if (status /= 0) return
    do k = 1, n
      order(k) = k
    end do
    call sort_by(triplets%row(:n), rows, order, first, scratch)
    call sort_by(triplets%column(:n), columns, order, column, scratch)
  end subroutine order_triplets

  !> Reorder `order` so that `keys`, from 1 to `most`, do not decrease; triplets with equal keys
  !> keep their order. `first` (most + 1): where each key begins.
  pure subroutine sort_by(keys, most, order, first, scratch)
    integer, intent(in) :: keys(:), most
    integer, intent(inout) :: order(:)
    integer, intent(out) :: first(:), scratch(:)
    integer :: k, key

    first = 0
    do k = 1, size(keys)
      first(keys(k) + 1) = first(keys(k) + 1) + 1
    end do
    first(1) = 1
    do key = 1, most
      first(key + 1) = first(key) + first(key + 1)
    end do
    scratch = order
    do k = 1, size(order)
      key = keys(scratch(k))
      order(first(key)) = scratch(k)
      first(key) = first(key) + 1
    end do
    do key = most, 1, -1
      first(key + 1) = first(key)
    end do
    first(1) = 1
  end subroutine sort_by

  !> Replace entries of the same row and column by their sum; the columns shrink in place, `row` and
  !> `value` keep their sizes. `overflow` as in `compress_columns`.
  pure subroutine sum_repeated(matrix, overflow)
    type(compressed_columns), intent(inout) :: matrix
    integer, intent(out) :: overflow
    integer :: begin, finish, j, k, last

    overflow = 0
    last = 0
    finish = 0
    associate (column => matrix%column, row => matrix%row, value => matrix%value)
      do j = 1, size(column) - 1
        begin = finish + 1
        finish = column(j + 1) - 1
        column(j) = last + 1
        do k = begin, finish
          if (k > begin) then
            if (row(k) == row(last)) then
              if (sum_overflows(value(last), value(k))) then
                if (overflow == 0) overflow = last
              else
                value(last) = value(last) + value(k)
              end if
              cycle
            end if
          end if
          last = last + 1
          row(last) = row(k)
          value(last) = value(k)
        end do
      end do
      column(size(column)) = last + 1
    end associate
  end subroutine sum_repeated

  !> Is a + b too large for double precision?
  pure function sum_overflows(a, b) result(overflows)
    real(dp), intent(in) :: a, b
    logical :: overflows

    overflows = abs(0.5_dp*a + 0.5_dp*b) > 0.5_dp*huge(1.0_dp)
  end function sum_overflows

  !> Release the memory of `row` and `value` beyond the last entry.
  pure subroutine shorten(matrix, status)
    type(compressed_columns), intent(inout) :: matrix
    integer, intent(out) :: status
    integer, allocatable :: row(:)
    real(dp), allocatable :: value(:)
    integer :: entries

    status = 0
    entries = matrix%column(size(matrix%column)) - 1
    if (entries == size(matrix%row)) return
    allocate (row(entries), value(entries), stat=status)
    if (status /= 0) return
    row = matrix%row(:entries)
    value = matrix%value(:entries)
    call move_alloc(row, matrix%row)
    call move_alloc(value, matrix%value)
  end subroutine shorten

end module fuge_compressed_columns
