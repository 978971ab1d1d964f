!> The rows of a grid that ranks share, and their exchange: each rank has some rows, one after the other.
module fuge_shared_rows
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: rows_of

  !> Which rows each rank has. Alone, as before it is set, a process has them all, and nothing is exchanged.
  type, extends(point_space), public :: shared_rows
    !> Cells of the whole grid in each direction; 0 where a process is alone.
    integer :: cells(2) = 0
    !> Rank r has the rows first(r) .. first(r + 1) - 1, (0:ranks); not allocated where a process is alone.
    integer, allocatable :: first(:)
  contains
    procedure :: own
    procedure :: points
    procedure :: fetch
    procedure :: collect
  end type shared_rows

contains

  !> The rows of the grid of `operator` that is `levels` times coarser than its own. Error: FUGE_ERR_MEMORY.
  subroutine rows_of(operator, levels, rows, info)
    class(fuge_operator), intent(in) :: operator
    integer, intent(in) :: levels
    type(shared_rows), intent(out) :: rows
    type(fuge_info), intent(inout) :: info

    rows%point_space = operator%ranks()
    if (rows%is_alone()) return
    rows%cells = (operator%grid() - 1)/2**levels + 1
    call operator%first_rows(levels, rows%first)
    call require_memory(merge(0, 1, allocated(rows%first)), 'the rows of', rows%members(), 'ranks', info)
    call rows%agree(info)
  end subroutine rows_of

  !> The first and the last row of this rank; not where a process is alone.
  pure function own(self) result(range)
    class(shared_rows), intent(in) :: self
    integer :: range(2)

    range = [self%first(self%number()), self%first(self%number() + 1) - 1]
  end function own

  !> Number of points of all ranks, of which this one has `here`.
  pure function points(self, here) result(n)
    class(shared_rows), intent(in) :: self
    integer, intent(in) :: here
    integer :: n

    n = here
    if (.not. self%is_alone()) n = product(self%cells)
  end function points

  !> `part`: the rows first(r) .. last(r) to each rank r, both (0:ranks - 1) and the same on all ranks; they may
  !> overlap.
  !>
  !> `values`: the rows of this rank, `length` values each. Error: FUGE_ERR_MEMORY.
  subroutine fetch(self, length, values, first, last, part, info)
    class(shared_rows), intent(in) :: self
    integer, intent(in) :: length, first(0:), last(0:)
    real(dp), intent(in), contiguous :: values(:)
    real(dp), allocatable, intent(out) :: part(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: sent(:)
    integer, dimension(0:size(first) - 1) :: to, from
    integer :: begin, done, me, r, stat

    me = self%number()
    do r = 0, size(first) - 1
      to(r) = length*overlap(self%own(), [first(r), last(r)])
      from(r) = length*overlap([self%first(r), self%first(r + 1) - 1], [first(me), last(me)])
    end do
    allocate (sent(sum(to)), part(length*max(last(me) - first(me) + 1, 0)), stat=stat)
    call agree_on_memory(self, length, stat, info)
    if (info%failed()) return
    done = 0
    do r = 0, size(first) - 1
      begin = length*(max(first(r), self%first(me)) - self%first(me))
      sent(done + 1:done + to(r)) = values(begin + 1:begin + to(r))
      done = done + to(r)
    end do
    call self%group%exchange(to, sent, from, part)
  end subroutine fetch

  !> `values`: to the rows of this rank, `length` values each, the sums of what all ranks have for them.
  !>
  !> `part`: the rows first(r) .. last(r) of this rank r, both (0:ranks - 1) and the same on all ranks; they may
  !> overlap.
  !> Error: FUGE_ERR_MEMORY.
  subroutine collect(self, length, part, first, last, values, info)
    class(shared_rows), intent(in) :: self
    integer, intent(in) :: length, first(0:), last(0:)
    real(dp), intent(in), contiguous :: part(:)
    real(dp), allocatable, intent(out) :: values(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: received(:)
    integer, dimension(0:size(first) - 1) :: to, from
    integer :: begin, done, me, r, stat

    me = self%number()
    do r = 0, size(first) - 1
      to(r) = length*overlap([self%first(r), self%first(r + 1) - 1], [first(me), last(me)])
      from(r) = length*overlap(self%own(), [first(r), last(r)])
    end do
    allocate (received(sum(from)), values(length*(self%first(me + 1) - self%first(me))), stat=stat)
    call agree_on_memory(self, length, stat, info)
    if (info%failed()) return
    call self%group%exchange(to, part, from, received)
    values = 0.0_dp
    done = 0
    do r = 0, size(first) - 1
      begin = length*(max(first(r), self%first(me)) - self%first(me))
      values(begin + 1:begin + from(r)) = values(begin + 1:begin + from(r)) + received(done + 1:done + from(r))
      done = done + from(r)
    end do
  end subroutine collect

  !> Report `stat` /= 0 of any rank.
  subroutine agree_on_memory(rows, length, stat, info)
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: length, stat
    type(fuge_info), intent(inout) :: info

    call require_memory(stat, 'an exchange of rows of', length, 'cells', info)
    call rows%agree(info)
  end subroutine agree_on_memory

  !> Number of rows that two ranges of rows, their first and last ones, have in common.
  pure function overlap(one, other) result(rows)
    integer, intent(in) :: one(2), other(2)
    integer :: rows

    rows = max(min(one(2), other(2)) - max(one(1), other(1)) + 1, 0)
  end function overlap

end module fuge_shared_rows
