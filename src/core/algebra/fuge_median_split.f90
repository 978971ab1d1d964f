!> Halves of a list by the median of a key (C. A. R. Hoare, Algorithm 65: Find, Communications of the ACM 4, 1961).
module fuge_median_split
  use fuge_kinds, only: dp
  implicit none
  private

  public :: sort_by_place, split_at_median

contains

  !> Reorder the indices `order` of `keys` so that the keys of the first (n + 1)/2 are at most those of the others.
  pure subroutine split_at_median(keys, order)
    real(dp), intent(in) :: keys(:)
    integer, intent(inout) :: order(:)
    integer :: middle, first, last, lower, upper, moved
    real(dp) :: pivot

    middle = (size(order) + 1)/2
    first = 1
    last = size(order)
    do while (first < last)
      pivot = keys(order((first + last)/2))
      lower = first
      upper = last
      do while (lower <= upper)
        do while (keys(order(lower)) < pivot)
          lower = lower + 1
        end do
        do while (pivot < keys(order(upper)))
          upper = upper - 1
        end do
        if (lower > upper) exit
        moved = order(lower)
        order(lower) = order(upper)
        order(upper) = moved
        lower = lower + 1
        upper = upper - 1
      end do
      if (upper < middle) first = lower
      if (middle < lower) last = upper
    end do
  end subroutine split_at_median

  !> Reorder the indices `order` of `places` (n, dimensions) by halves, and these again, down to lists of at most
  !> `least`, each time along the direction of the greatest extent. Halves are the first (n + 1)/2 and the rest.
  pure recursive subroutine sort_by_place(places, least, order)
    real(dp), intent(in) :: places(:, :)
    integer, intent(in) :: least
    integer, intent(inout) :: order(:)
    real(dp) :: extent, greatest
    integer :: along, k, middle

    if (size(order) <= max(least, 1)) return
    along = 1
    greatest = -1.0_dp
    do k = 1, size(places, 2)
      extent = extent_of(places(:, k), order)
      if (extent <= greatest) cycle
      greatest = extent
      along = k
    end do
    call split_at_median(places(:, along), order)
    middle = (size(order) + 1)/2
    call sort_by_place(places, least, order(:middle))
    call sort_by_place(places, least, order(middle + 1:))
  end subroutine sort_by_place

  !> The greatest difference of those `keys` that `order` names.
  pure function extent_of(keys, order) result(extent)
    real(dp), intent(in) :: keys(:)
    integer, intent(in) :: order(:)
    real(dp) :: extent, least, most
    integer :: k

    least = keys(order(1))
    most = least
    do k = 2, size(order)
      least = min(least, keys(order(k)))
      most = max(most, keys(order(k)))
    end do
    extent = most - least
  end function extent_of

end module fuge_median_split
