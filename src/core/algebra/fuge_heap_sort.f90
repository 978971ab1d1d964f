!> Heapsort (J. W. J. Williams, Algorithm 232, Communications of the ACM 7, 1964): O(n log n) in place, whatever the
!> order.
module fuge_heap_sort
  use fuge_kinds, only: dp
  implicit none
  private

  public :: heap_sort, reorder

contains

  !> Order the indices `order` of `keys` by them, ascending.
  pure subroutine heap_sort(keys, order)
    real(dp), intent(in) :: keys(:)
    integer, intent(inout) :: order(:)
    integer :: k, first

    do k = size(order)/2, 1, -1
      call sift_down(keys, k, order)
    end do
    do k = size(order), 2, -1
      first = order(1)
      order(1) = order(k)
      order(k) = first
      call sift_down(keys, 1, order(:k - 1))
    end do
  end subroutine heap_sort

  !> Put the value at `order`(k) at position k; `work` has room for all of them.
  pure subroutine reorder(order, values, work)
    integer, intent(in) :: order(:)
    real(dp), intent(inout) :: values(:), work(:)
    integer :: k

    do k = 1, size(order)
      work(k) = values(order(k))
    end do
    do k = 1, size(order)
      values(k) = work(k)
    end do
  end subroutine reorder

  !> Restore a heap, the greatest key first, in which only element `start` may be out of order.
  pure subroutine sift_down(keys, start, heap)
    real(dp), intent(in) :: keys(:)
    integer, intent(in) :: start
    integer, intent(inout) :: heap(:)
    integer :: parent, child, moved

    parent = start
    moved = heap(start)
    do
      child = 2*parent
      if (child > size(heap)) exit
      if (child < size(heap)) then
        if (keys(heap(child + 1)) > keys(heap(child))) child = child + 1
      end if
      if (keys(heap(child)) <= keys(moved)) exit
      heap(parent) = heap(child)
      parent = child
    end do
    heap(parent) = moved
  end subroutine sift_down

end module fuge_heap_sort
