!> The axis of a regular grid, found from the coordinates of its points in any order.
module fuge_grid_axis
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  implicit none
  private

  public :: find_axis, number_on_axis, position_on_axis

  !> Positions first + (k - 1)*spacing, k = 1 .. count.
  type, public :: grid_axis
    real(dp) :: first = 0.0_dp
    !> 0 for one position.
    real(dp) :: spacing = 0.0_dp
    integer :: count = 0
  end type grid_axis

  !> Coordinates that differ by less than this fraction of the widest step are the same position.
  real(dp), parameter :: SAME_POSITION = 0.25_dp
  !> A coordinate may be off its position by this fraction of the spacing: coordinates in files are rounded.
  real(dp), parameter :: POSITION_TOLERANCE = 0.05_dp

contains

  !> Find the axis of the coordinates `x` (n), n >= 1, named `name` in messages.
  !>
  !> `reason` is allocated if they are not at regular steps. `status` is not 0 without memory.
  pure subroutine find_axis(x, name, axis, reason, status)
    real(dp), intent(in) :: x(:)
    character(len=*), intent(in) :: name
    type(grid_axis), intent(out) :: axis
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(out) :: status
    real(dp), allocatable :: position(:)
    real(dp) :: widest
    integer :: k, positions

    call sort_distinct(x, position, positions, status)
    if (status /= 0) return
    axis%first = position(1)
    axis%count = 1
    if (positions == 1) return
    widest = maxval(position(2:positions) - position(:positions - 1))
    do k = 2, positions
      if (position(k) - position(k - 1) > SAME_POSITION*widest) axis%count = axis%count + 1
    end do
    axis%spacing = (position(positions) - position(1))/real(axis%count - 1, dp)
    do k = 2, positions
      if (is_on_axis(position(k), axis)) cycle
      reason = name//' = '//text(position(k))//' is no multiple of the step '//text(axis%spacing)//' away from '//name &
               //' = '//text(axis%first)//': positions must be a regular grid'
      return
    end do
  end subroutine find_axis

  !> The number of a position, 1 .. count.
  elemental function number_on_axis(x, axis) result(number)
    real(dp), intent(in) :: x
    type(grid_axis), intent(in) :: axis
    integer :: number

    number = 1
    if (axis%count > 1) number = 1 + nint((x - axis%first)/axis%spacing)
  end function number_on_axis

  !> Position number `number`.
  elemental function position_on_axis(number, axis) result(x)
    integer, intent(in) :: number
    type(grid_axis), intent(in) :: axis
    real(dp) :: x

    x = axis%first + real(number - 1, dp)*axis%spacing
  end function position_on_axis

  !> Is the coordinate at one of the positions?
  pure function is_on_axis(x, axis) result(on_axis)
    real(dp), intent(in) :: x
    type(grid_axis), intent(in) :: axis
    logical :: on_axis
    real(dp) :: number

    number = (x - axis%first)/axis%spacing
    on_axis = abs(number - anint(number)) <= POSITION_TOLERANCE
  end function is_on_axis

  !> The `distinct` different values of `x` in ascending order: position(:distinct).
  !>
  !> Ascending runs are merged in pairs, and equal values are dropped at once: the coordinates of a grid in the usual
  !> order take a time proportional to their number. `status` is not 0 without memory.
  pure subroutine sort_distinct(x, position, distinct, status)
    real(dp), intent(in) :: x(:)
    real(dp), allocatable, intent(out) :: position(:)
    integer, intent(out) :: distinct, status
    real(dp), allocatable :: merged(:)
    integer, allocatable :: begin(:)
    integer :: runs

    distinct = 0
    allocate (position(size(x)), merged(size(x)), begin(size(x) + 1), stat=status)
    if (status /= 0) return
    call find_runs(x, position, begin, runs)
    do while (runs > 1)
      call merge_runs(position, begin, runs, merged)
    end do
    distinct = begin(2) - 1
  end subroutine sort_distinct

  !> Copy `x` in ascending runs without repeated values: run k is run(begin(k):begin(k + 1) - 1).
  pure subroutine find_runs(x, run, begin, runs)
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: run(:)
    integer, intent(inout) :: begin(:)
    integer, intent(out) :: runs
    integer :: k, last

    runs = 1
    begin(1) = 1
    last = 1
    run(1) = x(1)
    do k = 2, size(x)
      if (.not. x(k) > run(last)) then
        if (.not. x(k) < run(last)) cycle
        runs = runs + 1
        begin(runs) = last + 1
      end if
      last = last + 1
      run(last) = x(k)
    end do
    begin(runs + 1) = last + 1
  end subroutine find_runs

  !> Merge runs 1 and 2, 3 and 4 and so on; `merged` is work space.
  pure subroutine merge_runs(run, begin, runs, merged)
    real(dp), intent(inout) :: run(:), merged(:)
    integer, intent(inout) :: begin(:), runs
    integer :: k, last, pairs

    pairs = runs/2
    last = 0
    do k = 1, pairs
      call merge_two(run(begin(2*k - 1):begin(2*k) - 1), run(begin(2*k):begin(2*k + 1) - 1), merged, last)
      ! Its old values, begin(k) of earlier pairs, are not needed any more.
      begin(k + 1) = last + 1
    end do
    if (2*pairs < runs) then
      call merge_two(run(begin(runs):begin(runs + 1) - 1), run(1:0), merged, last)
      begin(pairs + 2) = last + 1
    end if
    runs = runs - pairs
    run(:last) = merged(:last)
  end subroutine merge_runs

  !> Append two ascending runs to merged(:last), values in both of them once.
  pure subroutine merge_two(a, b, merged, last)
    real(dp), intent(in) :: a(:), b(:)
    real(dp), intent(inout) :: merged(:)
    integer, intent(inout) :: last
    integer :: i, k

    i = 1
    k = 1
    do while (i <= size(a) .and. k <= size(b))
      last = last + 1
      merged(last) = min(a(i), b(k))
      if (.not. a(i) > merged(last)) i = i + 1
      if (.not. b(k) > merged(last)) k = k + 1
    end do
    merged(last + 1:last + size(a) - i + 1) = a(i:)
    last = last + size(a) - i + 1
    merged(last + 1:last + size(b) - k + 1) = b(k:)
    last = last + size(b) - k + 1
  end subroutine merge_two

end module fuge_grid_axis
