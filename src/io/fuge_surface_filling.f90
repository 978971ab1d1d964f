!> Heights for points of a surface that were not measured.
module fuge_surface_filling
  use fuge_kinds, only: dp
  use fuge_surface_heights, only: NOT_MEASURED
  implicit none
  private

  public :: fill_surface

  !> Stands for a point that waits for its height.
  real(dp), parameter :: WAITING = -NOT_MEASURED

contains

  !> Give each point whose height is NOT_MEASURED the mean of its neighbours, from the rim of a hole inwards.
  !>
  !> Neighbours are the points next to it along x and along y that were measured or filled before. The new heights lie
  !> between those at the rim, so that a filled hole never touches first. `filled` is the number of such points.
  !> `status` is not 0 without memory or, `height` unchanged, if no point at all was measured.
  pure subroutine fill_surface(height, filled, status)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(out) :: filled, status
    integer, allocatable :: place(:, :)
    real(dp), allocatable :: value(:)
    integer :: first, k, last, queued

    status = 0
    filled = count(.not. height < NOT_MEASURED)
    if (filled == 0) return
    status = merge(1, 0, filled == size(height))
    if (status == 0) allocate (place(2, filled), value(filled), stat=status)
    if (status /= 0) return
    call queue_rim(height, place, queued)
    first = 1
    do while (first <= queued)
      last = queued
      do k = first, last
        value(k) = mean_of_neighbours(height, place(1, k), place(2, k))
      end do
      do k = first, last
        height(place(1, k), place(2, k)) = value(k)
      end do
      do k = first, last
        call queue_neighbours(height, place(1, k), place(2, k), place, queued)
      end do
      first = last + 1
    end do
  end subroutine fill_surface

  !> Queue the points at the rims of the holes: those next to a point with a height.
  pure subroutine queue_rim(height, place, queued)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(inout) :: place(:, :)
    integer, intent(out) :: queued
    integer :: i, j

    queued = 0
    do j = 1, size(height, 2)
      do i = 1, size(height, 1)
        if (is_known(height, i, j)) call queue_neighbours(height, i, j, place, queued)
      end do
    end do
  end subroutine queue_rim

  !> Queue the neighbours of a point that were not measured and do not wait yet.
  pure subroutine queue_neighbours(height, i, j, place, queued)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(in) :: i, j
    integer, intent(inout) :: place(:, :), queued
    integer :: k, next_i, next_j

    do k = 1, 4
      call find_neighbour(i, j, k, next_i, next_j)
      if (.not. is_inside(height, next_i, next_j)) cycle
      if (height(next_i, next_j) < NOT_MEASURED) cycle
      height(next_i, next_j) = WAITING
      queued = queued + 1
      place(:, queued) = [next_i, next_j]
    end do
  end subroutine queue_neighbours

  !> Mean height of the neighbours that have one.
  pure function mean_of_neighbours(height, i, j) result(mean)
    real(dp), intent(in) :: height(:, :)
    integer, intent(in) :: i, j
    real(dp) :: mean
    integer :: k, known, next_i, next_j

    mean = 0.0_dp
    known = 0
    do k = 1, 4
      call find_neighbour(i, j, k, next_i, next_j)
      if (.not. is_known(height, next_i, next_j)) cycle
      known = known + 1
      mean = mean + height(next_i, next_j)
    end do
    mean = mean/real(known, dp)
  end function mean_of_neighbours

  !> Neighbour k = 1 .. 4 of point (i, j), inside the surface or not.
  pure subroutine find_neighbour(i, j, k, next_i, next_j)
    integer, intent(in) :: i, j, k
    integer, intent(out) :: next_i, next_j
    integer, parameter :: ALONG_X(4) = [-1, 1, 0, 0], ALONG_Y(4) = [0, 0, -1, 1]

    next_i = i + ALONG_X(k)
    next_j = j + ALONG_Y(k)
  end subroutine find_neighbour

  !> Is (i, j) a point of the surface?
  pure function is_inside(height, i, j) result(inside)
    real(dp), intent(in) :: height(:, :)
    integer, intent(in) :: i, j
    logical :: inside

    inside = i >= 1 .and. j >= 1 .and. i <= size(height, 1) .and. j <= size(height, 2)
  end function is_inside

  !> Is (i, j) a point with a height?
  pure function is_known(height, i, j) result(known)
    real(dp), intent(in) :: height(:, :)
    integer, intent(in) :: i, j
    logical :: known

    known = is_inside(height, i, j)
    if (known) known = abs(height(i, j)) < NOT_MEASURED
  end function is_known

end module fuge_surface_filling
