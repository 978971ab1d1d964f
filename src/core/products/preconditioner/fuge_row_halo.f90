!> The rows of a grid beside those of a rank: copies of the rows that other ranks have, the halo. The grid is periodic:
!> beyond its last row follows the first one.
module fuge_row_halo
  use fuge_kinds, only: dp, sp
  use fuge_shared_rows, only: shared_rows
  implicit none
  private

  !> Which rows the halos of all ranks have, and space for messages. Set it once, then use it any number of times.
  type, public :: row_halo
    private
    !> How many values are sent to each rank to fetch halos, and received from it, (0:ranks - 1); `collect` goes the
    !> other way.
    integer, allocatable :: to(:), from(:)
    !> Rows of this rank that go to halos, and rows of its halo, each in the order of the ranks at the other end.
    integer, allocatable :: own(:), beside(:)
    real(dp), allocatable :: own_values(:), beside_values(:)
  contains
    procedure :: set
    procedure :: fetch
    procedure :: collect
  end type row_halo

contains

  !> Find the rows of all halos of a grid that ranks share; `stat` /= 0: there is no memory.
  subroutine set(self, rows, stat)
    class(row_halo), intent(out) :: self
    type(shared_rows), intent(in) :: rows
    integer, intent(out) :: stat
    integer :: me, mine(2), n, r, ranks, side, sent, wanted

    ranks = rows%members()
    me = rows%number()
    n = rows%cells(1)
    mine = rows%own()
    allocate (self%to(0:ranks - 1), self%from(0:ranks - 1), stat=stat)
    if (stat /= 0) return
    do r = 0, ranks - 1
      self%to(r) = n*count([(has_row(rows, me, row_beside(rows, r, side)), side=1, 2)])
      self%from(r) = n*count([(has_row(rows, r, row_beside(rows, me, side)), side=1, 2)])
    end do
    sent = sum(self%to)
    wanted = sum(self%from)
    allocate (self%own(sent/n), self%beside(wanted/n), self%own_values(sent), self%beside_values(wanted), stat=stat)
    if (stat /= 0) return
    sent = 0
    wanted = 0
    do r = 0, ranks - 1
      do side = 1, 2
        if (has_row(rows, me, row_beside(rows, r, side))) then
          sent = sent + 1
          self%own(sent) = row_beside(rows, r, side)
        end if
        if (has_row(rows, r, row_beside(rows, me, side))) then
          wanted = wanted + 1
          self%beside(wanted) = merge(mine(1) - 1, mine(2) + 1, side == 1)
        end if
      end do
    end do
  end subroutine set

  !> The row of the grid before those of rank `r`, `side` 1, or after them, 2.
  pure function row_beside(rows, r, side) result(row)
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: r, side
    integer :: row

    row = modulo(merge(rows%first(r) - 2, rows%first(r + 1) - 1, side == 1), rows%cells(2)) + 1
  end function row_beside

  !> Does rank `r` have row `row` of the grid?
  pure function has_row(rows, r, row)
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: r, row
    logical :: has_row

    has_row = rows%first(r) <= row .and. row < rows%first(r + 1)
  end function has_row

  !> Copy the rows of the halo of `values`, of which the first row is number `first` of the grid, from the ranks that
  !> have them.
  subroutine fetch(self, rows, first, values)
    class(row_halo), intent(inout) :: self
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: first
    real(sp), intent(inout), contiguous :: values(:, first:)
    integer :: k, n

    n = size(values, 1)
    do k = 1, size(self%own)
      self%own_values(n*(k - 1) + 1:n*k) = real(values(:, self%own(k)), dp)
    end do
    call rows%group%exchange(self%to, self%own_values, self%from, self%beside_values)
    do k = 1, size(self%beside)
      values(:, self%beside(k)) = real(self%beside_values(n*(k - 1) + 1:n*k), sp)
    end do
  end subroutine fetch

  !> Add the rows of the halo of `values`, of which the first row is number `first` of the grid, to those of the ranks
  !> that have them.
  subroutine collect(self, rows, first, values)
    class(row_halo), intent(inout) :: self
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: first
    real(sp), intent(inout), contiguous :: values(:, first:)
    integer :: k, n

    n = size(values, 1)
    do k = 1, size(self%beside)
      self%beside_values(n*(k - 1) + 1:n*k) = real(values(:, self%beside(k)), dp)
    end do
    call rows%group%exchange(self%from, self%beside_values, self%to, self%own_values)
    do k = 1, size(self%own)
      values(:, self%own(k)) = values(:, self%own(k)) + real(self%own_values(n*(k - 1) + 1:n*k), sp)
    end do
  end subroutine collect

end module fuge_row_halo
