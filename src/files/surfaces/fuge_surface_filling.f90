!> Heights for points of a surface that were not measured.
module fuge_surface_filling
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_FINITE
  use fuge_surface_heights, only: check_heights, NOT_MEASURED
  implicit none
  private

  public :: fill_surface, fuge_fill_surface

  !> Stands for a point that waits for its height.
  real(dp), parameter :: WAITING = -NOT_MEASURED

contains

  !> Fill the points of a surface that were not measured, as `fuge_read_surface` fills those of a file.
  !>
  !> `height` (nx, ny), any numbers >= 1, is changed in place: each NaN becomes the mean height of its neighbours along
  !> x and along y, from the rim of a hole inwards. `filled` is their number. Errors, `height` unchanged and `filled` 0:
  !> FUGE_ERR_SIZE without points; FUGE_ERR_NOT_FINITE for infinity, and if all heights are NaN; FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_MEMORY.
  pure subroutine fuge_fill_surface(height, info, filled)
    real(dp), intent(inout) :: height(:, :)
    type(fuge_info), intent(out) :: info
    integer, intent(out), optional :: filled
    integer :: holes, status

    if (present(filled)) filled = 0
    call check_heights(height, info, holes=.true.)
    if (info%failed()) return
    if (all(ieee_is_nan(height))) then
      call report(info, FUGE_ERR_NOT_FINITE, 'all heights are NaN: no point was measured to fill the others from')
      return
    end if
    where (ieee_is_nan(height)) height = NOT_MEASURED
    call fill_surface(height, holes, status)
    if (status /= 0) then
      where (height >= NOT_MEASURED) height = ieee_value(height, ieee_quiet_nan)
      call report(info, FUGE_ERR_MEMORY, 'no memory to fill '//text(holes)//' points')
    else if (present(filled)) then
      filled = holes
    end if
  end subroutine fuge_fill_surface

  !> Give each point whose height is NOT_MEASURED the mean of its neighbours, from the rim of a hole inwards.
  !>
  !> Neighbours are the points next to it along x and along y that were measured or filled before. The new heights lie
  !> between those at the rim, so that a filled hole never touches first. `filled` is the number of such points.
  !> `status` is not 0 without memory or, `height` unchanged, if no point at all was measured.
  pure subroutine fill_surface(height, filled, status)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(out) :: filled, status
    integer, allocatable :: queue(:, :)
    real(dp), allocatable :: value(:)
    integer :: first, k, last, queued

    status = 0
    filled = count(.not. height < NOT_MEASURED)
    if (filled == 0) return
    status = merge(1, 0, filled == size(height))
    if (status == 0) allocate (queue(2, filled), value(filled), stat=status)
    if (status /= 0) return
    call queue_rim(height, queue, queued)
    first = 1
    do while (first <= queued)
      last = queued
      do k = first, last
        value(k) = mean_of_neighbours(height, queue(1, k), queue(2, k))
      end do
      do k = first, last
        height(queue(1, k), queue(2, k)) = value(k)
      end do
      do k = first, last
        call queue_neighbours(height, queue(1, k), queue(2, k), queue, queued)
      end do
      first = last + 1
    end do
  end subroutine fill_surface

  !> Queue the points at the rims of the holes: those next to a point with a height.
  pure subroutine queue_rim(height, queue, queued)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(inout) :: queue(:, :)
    integer, intent(out) :: queued
    integer :: i, j

    queued = 0
    do j = 1, size(height, 2)
      do i = 1, size(height, 1)
        if (is_known(height, i, j)) call queue_neighbours(height, i, j, queue, queued)
      end do
    end do
  end subroutine queue_rim

  !> Queue the neighbours of a point that were not measured and do not wait yet.
  pure subroutine queue_neighbours(height, i, j, queue, queued)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(in) :: i, j
    integer, intent(inout) :: queue(:, :), queued
    integer :: k, next_i, next_j

    do k = 1, 4
      call find_neighbour(i, j, k, next_i, next_j)
      if (.not. is_inside(height, next_i, next_j)) cycle
      if (height(next_i, next_j) < NOT_MEASURED) cycle
      height(next_i, next_j) = WAITING
      queued = queued + 1
      queue(:, queued) = [next_i, next_j]
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
