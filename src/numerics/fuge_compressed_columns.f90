!> From entries (row, column, value) in any order to compressed columns.
module fuge_compressed_columns
  use fuge_kinds, only: dp
  implicit none
  private

  public :: order_triplets, sum_overflows, sum_repeated

contains

  !> Order in which `keys`, from 1 to `most`, do not decrease; equal ones stay as they are in
  !> `order`, which comes in with any order. `first` (most + 1): where each key begins.
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

  !> Sort by columns, in each by rows, equal places as they came: the time is proportional
  !> to the numbers of entries, rows and columns.
  !>
  !> `i`, `j`: row and column of each entry, from 1; `order`: its entries one after the other,
  !> column j at order(column(j) : column(j+1) - 1). `status` is not 0 without memory.
  pure subroutine order_triplets(rows, columns, i, j, order, column, status)
    integer, intent(in) :: rows, columns, i(:), j(:)
    integer, allocatable, intent(out) :: order(:), column(:)
    integer, intent(out) :: status
    integer, allocatable :: first(:), scratch(:)
    integer :: k

    allocate (order(size(i)), column(columns + 1), first(rows + 1), scratch(size(i)), stat=status)
    if (status /= 0) return
    do k = 1, size(order)
      order(k) = k
    end do
    call sort_by(i, rows, order, first, scratch)
    call sort_by(j, columns, order, column, scratch)
  end subroutine order_triplets

  !> Entries of the same place become one, their sum; the compressed columns shrink in place.
  !>
  !> `overflow` is the number of a place whose sum overflows, else 0.
  pure subroutine sum_repeated(column, row, value, overflow)
    integer, intent(inout) :: column(:), row(:)
    real(dp), intent(inout) :: value(:)
    integer, intent(out) :: overflow
    integer :: begin, finish, j, k, kept

    overflow = 0
    kept = 0
    finish = 0
    do j = 1, size(column) - 1
      begin = finish + 1
      finish = column(j + 1) - 1
      column(j) = kept + 1
      do k = begin, finish
        if (k > begin) then
          if (row(k) == row(kept)) then
            if (sum_overflows(value(kept), value(k))) then
              if (overflow == 0) overflow = kept
            else
              value(kept) = value(kept) + value(k)
            end if
            cycle
          end if
        end if
        kept = kept + 1
        row(kept) = row(k)
        value(kept) = value(k)
      end do
    end do
    column(size(column)) = kept + 1
  end subroutine sum_repeated

  pure function sum_overflows(a, b) result(overflows)
    real(dp), intent(in) :: a, b
    logical :: overflows

    overflows = abs(0.5_dp*a + 0.5_dp*b) > 0.5_dp*huge(1.0_dp)
  end function sum_overflows

end module fuge_compressed_columns
