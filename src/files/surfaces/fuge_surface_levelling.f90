!> Levelling of a surface: subtraction of its mean height or its least-squares plane.
module fuge_surface_levelling
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_profile_sampling, only: FUGE_LEVEL_MEAN
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  use fuge_surface_heights, only: check_heights
  implicit none
  private

  public :: fuge_level_surface

  !> Value of `form`: subtract the least-squares plane.
  integer, parameter, public :: FUGE_LEVEL_PLANE = 2

contains

  !> Subtract the mean height or the least-squares plane from a surface, as usual for roughness.
  !>
  !> `height` (nx, ny), any numbers >= 1, is changed in place; `form` is FUGE_LEVEL_MEAN or FUGE_LEVEL_PLANE. All points
  !> have the same weight. With nx = 1 or ny = 1 the plane is a line.
  !> Errors, `height` unchanged: FUGE_ERR_SIZE without points, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_OPTION
  !> for `form`.
  pure subroutine fuge_level_surface(height, form, info)
    real(dp), intent(inout) :: height(:, :)
    integer, intent(in) :: form
    type(fuge_info), intent(out) :: info
    integer :: pass

    call check_heights(height, info)
    if (.not. info%failed() .and. form /= FUGE_LEVEL_MEAN .and. form /= FUGE_LEVEL_PLANE) then
      call report(info, FUGE_ERR_OPTION, 'form = '//text(form)//' is unknown: use FUGE_LEVEL_MEAN or FUGE_LEVEL_PLANE')
    end if
    if (info%failed()) return
    ! Relative to one height, so that an offset costs no digits.
    height = height - height(1, 1)
    ! The second pass removes the rounding errors of the first.
    do pass = 1, 2
      call subtract_plane(height, form == FUGE_LEVEL_PLANE)
    end do
  end subroutine fuge_level_surface

  !> Subtract the mean height and, if `tilted`, the slopes of the least-squares plane.
  !>
  !> Coordinates along x and along y are counted from the middle, -1/2 .. 1/2: mean and slopes are then independent of
  !> each other, and nothing overflows.
  pure subroutine subtract_plane(height, tilted)
    real(dp), intent(inout) :: height(:, :)
    logical, intent(in) :: tilted
    real(dp) :: of_row(size(height, 1)), of_column(size(height, 2))
    real(dp) :: mean, slope_x, slope_y, offset
    integer :: i, j

    call find_means(height, of_row, of_column)
    mean = sum(of_column)/real(size(of_column), dp)
    slope_x = 0.0_dp
    slope_y = 0.0_dp
    if (tilted) then
      slope_x = slope(of_row)
      slope_y = slope(of_column)
    end if
    do j = 1, size(height, 2)
      offset = mean + slope_y*coordinate(j, size(height, 2))
      do i = 1, size(height, 1)
        height(i, j) = height(i, j) - (offset + slope_x*coordinate(i, size(height, 1)))
      end do
    end do
  end subroutine subtract_plane

  !> Mean height of the points with each i, (nx), and with each j, (ny).
  pure subroutine find_means(height, of_row, of_column)
    real(dp), intent(in) :: height(:, :)
    real(dp), intent(out) :: of_row(:), of_column(:)
    integer :: j

    of_row = 0.0_dp
    do j = 1, size(height, 2)
      of_column(j) = sum(height(:, j))/real(size(height, 1), dp)
      of_row = of_row + height(:, j)
    end do
    of_row = of_row/real(size(height, 2), dp)
  end subroutine find_means

  !> Slope of the least-squares line through values at equal steps, per length of the whole; 0 for one value.
  pure function slope(value)
    real(dp), intent(in) :: value(:)
    real(dp) :: slope
    real(dp) :: moment, squares
    integer :: k

    moment = 0.0_dp
    squares = 0.0_dp
    do k = 1, size(value)
      moment = moment + coordinate(k, size(value))*value(k)
      squares = squares + coordinate(k, size(value))**2
    end do
    slope = 0.0_dp
    if (squares > 0.0_dp) slope = moment/squares
  end function slope

  !> Coordinate of value k of n, counted from the middle in lengths of the whole.
  elemental function coordinate(k, n)
    integer, intent(in) :: k, n
    real(dp) :: coordinate

    coordinate = 0.0_dp
    if (n > 1) coordinate = (real(k - 1, dp) - 0.5_dp*real(n - 1, dp))/real(n - 1, dp)
  end function coordinate

end module fuge_surface_levelling
