!> Rows of weights that grow as they are added to: a sparse matrix under construction. Each entry has a weight along the
!> direction of its row, which is not known yet, and one along each axis. A long row may have several entries of one
!> column, which are to be summed, so that adding to it takes no longer than adding to a short one.
module fuge_weight_rows
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_weight, copy_row, row_length, start_rows

  !> At most this many entries of a row, the newest ones, are searched for a column.
  integer, parameter :: LOOKED_AT = 256

  type, public :: weight_rows
    !> First entry of each row and the entry after each one, 0 at the end.
    integer, allocatable, private :: first(:), next(:)
    integer, allocatable, private :: column(:)
    real(dp), allocatable, private :: weight(:), axes(:, :)
    integer, private :: used = 0
  end type weight_rows

contains

  !> `count` empty rows. `stat` is not zero without memory.
  pure subroutine start_rows(rows, count, stat)
    type(weight_rows), intent(out) :: rows
    integer, intent(in) :: count
    integer, intent(out) :: stat

    allocate (rows%first(count), rows%next(8*count + 8), rows%column(8*count + 8), rows%weight(8*count + 8), &
              rows%axes(3, 8*count + 8), stat=stat)
    if (stat == 0) rows%first = 0
  end subroutine start_rows

  !> Add to the weights of a column. `stat` is left alone on success.
  pure subroutine add_weight(rows, row, column, weight, axes, stat)
    type(weight_rows), intent(inout) :: rows
    integer, intent(in) :: row, column
    real(dp), intent(in) :: weight, axes(3)
    integer, intent(inout) :: stat
    integer :: k, p

    p = rows%first(row)
    do k = 1, LOOKED_AT
      if (p == 0) exit
      if (rows%column(p) == column) then
        rows%weight(p) = rows%weight(p) + weight
        rows%axes(:, p) = rows%axes(:, p) + axes
        return
      end if
      p = rows%next(p)
    end do
    call make_room(rows%column, rows%used, stat)
    call make_room(rows%weight, rows%used, stat)
    call make_room(rows%axes, rows%used, stat)
    call make_room(rows%next, rows%used, stat)
    if (stat /= 0) return
    rows%used = rows%used + 1
    rows%column(rows%used) = column
    rows%weight(rows%used) = weight
    rows%axes(:, rows%used) = axes
    rows%next(rows%used) = rows%first(row)
    rows%first(row) = rows%used
  end subroutine add_weight

  !> Entries of a row.
  pure function row_length(rows, row) result(length)
    type(weight_rows), intent(in) :: rows
    integer, intent(in) :: row
    integer :: length, p

    length = 0
    p = rows%first(row)
    do while (p > 0)
      length = length + 1
      p = rows%next(p)
    end do
  end function row_length

  !> The entries of a row; `column`, `weight` and `axes` have room for them.
  pure subroutine copy_row(rows, row, column, weight, axes)
    type(weight_rows), intent(in) :: rows
    integer, intent(in) :: row
    integer, intent(out) :: column(:)
    real(dp), intent(out) :: weight(:), axes(:, :)
    integer :: k, p

    column = 0
    weight = 0.0_dp
    axes = 0.0_dp
    k = 0
    p = rows%first(row)
    do while (p > 0)
      k = k + 1
      column(k) = rows%column(p)
      weight(k) = rows%weight(p)
      axes(:, k) = rows%axes(:, p)
      p = rows%next(p)
    end do
  end subroutine copy_row

end module fuge_weight_rows
