!> A surface from three columns, x, y and height of a point on each line.
module fuge_surface_points
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_grid_axis, only: find_axis, grid_axis, number_on_axis, position_on_axis
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_surface_heights, only: allocate_heights, NOT_MEASURED
  use fuge_surface_rows, only: advance_to_row, count_rows, find_first_row, read_row, refuse_unmeasured, row_form
  use fuge_surface_type, only: fuge_surface
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: read_points

  !> Stands for a point that no line has named.
  real(dp), parameter :: NOT_NAMED = -NOT_MEASURED

contains

  !> Read points, in any order, that form a full regular grid.
  !>
  !> With `fill` the heights that were not measured are NOT_MEASURED, and up to half of the points may be missing.
  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine read_points(file, fill, surface, info)
    type(text_file), intent(inout) :: file
    logical, intent(in) :: fill
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    type(row_form) :: form
    type(grid_axis) :: axis(2)
    real(dp), allocatable :: point(:, :)
    integer :: points, status

    call find_first_row(file, form, info)
    if (info%failed()) return
    if (form%columns /= 3) then
      call file%refuse(text(form%columns)//' column(s): x, y and the height are needed', info)
      return
    end if
    call count_rows(file, points, info)
    if (info%failed()) return
    allocate (point(points, 3), stat=status)
    if (status /= 0) then
      call report(info, FUGE_ERR_MEMORY, file%name//': no memory for '//text(points)//' points')
      return
    end if
    call read_lines(file, fill, point, info)
    if (.not. info%failed()) call find_axes(file, point, axis, info)
    if (.not. info%failed()) call allocate_heights(file%name, axis(1)%count, axis(2)%count, surface%height, info)
    if (.not. info%failed()) call enter_points(file, point, axis, surface%height, info)
    if (.not. info%failed()) call check_all_named(file, axis, fill, surface%height, info)
    surface%spacing_x = axis(1)%spacing
    surface%spacing_y = axis(2)%spacing
    surface%origin_x = axis(1)%first
    surface%origin_y = axis(2)%first
  end subroutine read_points

  !> Read all lines: `point` (points, 3) has x, y and heights.
  pure subroutine read_lines(file, fill, point, info)
    type(text_file), intent(inout) :: file
    logical, intent(in) :: fill
    real(dp), intent(inout) :: point(:, :)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    type(row_form) :: form
    real(dp) :: values(3)
    integer :: k, unmeasured
    logical :: exists

    call find_first_row(file, form, info)
    do k = 1, size(point, 1)
      if (info%failed()) return
      call read_row(file%content(file%first:file%last), form, values, unmeasured, reason)
      if (allocated(reason)) then
        call file%refuse(reason, info)
      else if (unmeasured == 1 .or. unmeasured == 2) then
        call file%refuse('a position is missing: x, y and the height are needed', info)
      else if (unmeasured > 0 .and. .not. fill) then
        call refuse_unmeasured(file, unmeasured, info)
      else
        point(k, :) = values
        call advance_to_row(file, exists, info)
      end if
    end do
  end subroutine read_lines

  !> Find both axes, and refuse a number of points that does not fit them.
  pure subroutine find_axes(file, point, axis, info)
    type(text_file), intent(in) :: file
    real(dp), intent(in) :: point(:, :)
    type(grid_axis), intent(out) :: axis(2)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer(int64) :: grid_points
    integer :: direction, status

    do direction = 1, 2
      call find_axis(point(:, direction), achar(iachar('x') + direction - 1), axis(direction), reason, status)
      if (status /= 0) then
        call report(info, FUGE_ERR_MEMORY, file%name//': no memory to sort '//text(size(point, 1))//' points')
      else if (allocated(reason)) then
        call report(info, FUGE_ERR_FILE, file%name//': '//reason//', or the file is a grid of three columns')
      end if
      if (info%failed()) return
    end do
    grid_points = int(axis(1)%count, int64)*int(axis(2)%count, int64)
    if (grid_points/2_int64 > size(point, 1)) then
      call report(info, FUGE_ERR_FILE, file%name//': '//text(size(point, 1))//' points are no full grid of ' &
                  //text(axis(1)%count)//' positions x and '//text(axis(2)%count)//' positions y')
    end if
  end subroutine find_axes

  !> Enter each point in the grid; a second point at a position is refused.
  pure subroutine enter_points(file, point, axis, height, info)
    type(text_file), intent(inout) :: file
    real(dp), intent(in) :: point(:, :)
    type(grid_axis), intent(in) :: axis(2)
    real(dp), intent(inout) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: i, j, k

    height = NOT_NAMED
    do k = 1, size(point, 1)
      i = number_on_axis(point(k, 1), axis(1))
      j = number_on_axis(point(k, 2), axis(2))
      if (height(i, j) > NOT_NAMED) then
        call refuse_second_point(file, k, point(k, 1:2), info)
        return
      end if
      height(i, j) = point(k, 3)
    end do
  end subroutine enter_points

  !> Refuse point `k`, at a position that another one has.
  pure subroutine refuse_second_point(file, k, position, info)
    type(text_file), intent(inout) :: file
    integer, intent(in) :: k
    real(dp), intent(in) :: position(:)
    type(fuge_info), intent(inout) :: info
    type(row_form) :: form
    integer :: row
    logical :: exists

    call find_first_row(file, form, info)
    do row = 2, k
      call advance_to_row(file, exists, info)
    end do
    call file%refuse('a second point at x = '//text(position(1))//', y = '//text(position(2)) &
                     //': remove one of them, or say that the file is a grid of three columns', info)
  end subroutine refuse_second_point

  !> Refuse a grid with a missing point, or with `fill` make it one that was not measured.
  pure subroutine check_all_named(file, axis, fill, height, info)
    type(text_file), intent(in) :: file
    type(grid_axis), intent(in) :: axis(2)
    logical, intent(in) :: fill
    real(dp), intent(inout) :: height(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: i, j

    do j = 1, size(height, 2)
      do i = 1, size(height, 1)
        if (height(i, j) > NOT_NAMED) cycle
        height(i, j) = NOT_MEASURED
        if (fill) cycle
        call report(info, FUGE_ERR_FILE, file%name//': no point at x = '//text(position_on_axis(i, axis(1))) &
                    //', y = '//text(position_on_axis(j, axis(2)))//' of a regular grid of ' &
                    //text(size(height, 1))//' x '//text(size(height, 2))//': add it, or let missing points be filled')
        return
      end do
    end do
  end subroutine check_all_named

end module fuge_surface_points
