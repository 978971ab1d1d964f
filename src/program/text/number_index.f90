!> Finds nodes by their numbers: from the numbers in files to indices of arrays.
module number_index
  implicit none
  private

  type, public :: index_of_numbers
    integer, allocatable, private :: number(:), position(:)
  contains
    procedure :: set
    procedure :: find
  end type index_of_numbers

contains

  !> `numbers` differ from each other. O(n log n), O(n) if they ascend.
  pure subroutine set(self, numbers)
    class(index_of_numbers), intent(inout) :: self
    integer, intent(in) :: numbers(:)
    integer, allocatable :: merged(:), order(:)
    integer :: begin, k, n, width

    n = size(numbers)
    allocate (order(n), source=[(k, k=1, n)])
    allocate (merged(n), source=order)
    width = 1
    do while (width < n .and. .not. ascends(numbers, order))
      do begin = 1, n, 2*width
        call merge_runs(numbers, order, begin, min(width, n - begin + 1), min(2*width, n - begin + 1), merged)
      end do
      order = merged
      width = 2*width
    end do
    self%number = numbers(order)
    call move_alloc(order, self%position)
  end subroutine set

  pure function ascends(numbers, order)
    integer, intent(in) :: numbers(:), order(:)
    logical :: ascends
    integer :: k

    ascends = .true.
    do k = 2, size(order)
      ascends = numbers(order(k - 1)) <= numbers(order(k))
      if (.not. ascends) return
    end do
  end function ascends

  !> Merge two ascending runs of `order` from `begin` on, the first of `first` elements, both together of `all`.
  pure subroutine merge_runs(numbers, order, begin, first, all, merged)
    integer, intent(in) :: numbers(:), order(:), begin, first, all
    integer, intent(inout) :: merged(:)
    integer :: k, left, right
    logical :: take_left

    left = begin
    right = begin + first
    do k = begin, begin + all - 1
      take_left = left < begin + first
      if (take_left .and. right < begin + all) take_left = numbers(order(left)) <= numbers(order(right))
      if (take_left) then
        merged(k) = order(left)
        left = left + 1
      else
        merged(k) = order(right)
        right = right + 1
      end if
    end do
  end subroutine merge_runs

  !> The index of a number among those given to `set`; 0 if it is not there.
  pure function find(self, number) result(position)
    class(index_of_numbers), intent(in) :: self
    integer, intent(in) :: number
    integer :: position
    integer :: high, low, middle

    position = 0
    low = 1
    high = size(self%number)
    do while (low <= high)
      middle = low + (high - low)/2
      if (self%number(middle) == number) then
        position = self%position(middle)
        return
      else if (self%number(middle) < number) then
        low = middle + 1
      else
        high = middle - 1
      end if
    end do
  end function find

end module number_index
