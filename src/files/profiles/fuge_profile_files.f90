!> Profiles, heights z over positions x, from text files.
module fuge_profile_files
  use fuge_growing_arrays, only: resize
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_profile_lines, only: read_point, LINE_EMPTY, LINE_POINT, LINE_WORDS
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_profile

contains

  !> Read a profile from a text file with x and z on each line.
  !>
  !> Columns are separated by blanks, tabs, a comma or a semicolon; numbers have a decimal
  !> point and may have an exponent after e or d. Blank lines are skipped, and so are comments,
  !> which begin with # or ! at the beginning of a line or after the numbers, and one line of
  !> words before the numbers. `x` and `z` (any number of points >= 2) are allocated afresh, in
  !> the unit of the file, x strictly increasing.
  !> Errors, `x` and `z` unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  subroutine fuge_read_profile(path, x, z, info)
    character(len=*), intent(in) :: path
    real(dp), allocatable, intent(inout) :: x(:), z(:)
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    real(dp), allocatable :: read_x(:), read_z(:)
    integer :: points, status

    call file%load(path, info)
    if (info%failed()) return
    ! There are at most as many points as lines.
    points = file%count_lines()
    allocate (read_x(points), read_z(points), stat=status)
    if (status == 0) then
      call read_points(file, read_x, read_z, points, info)
      if (info%failed()) return
      deallocate (file%content)
      call resize(read_x, points, status)
      call resize(read_z, points, status)
    end if
    if (status == 0) then
      call move_alloc(read_x, x)
      call move_alloc(read_z, z)
    else
      call report(info, FUGE_ERR_MEMORY, file%name//': no memory for '//text(points)//' points')
    end if
  end subroutine fuge_read_profile

  !> Read all lines; on return `x` and `z` hold the first `points` points.
  pure subroutine read_points(file, x, z, points, info)
    type(text_file), intent(inout) :: file
    real(dp), intent(inout) :: x(:), z(:)
    integer, intent(out) :: points
    type(fuge_info), intent(inout) :: info
    logical :: exists, header

    points = 0
    header = .false.
    do
      call file%advance(exists)
      if (.not. exists) exit
      call read_line(file, x, z, points, header, info)
      if (info%failed()) return
    end do
    if (points < 2) call file%refuse('the file ends after '//text(points)//' point(s): a profile needs 2 or more', info)
  end subroutine read_points

  !> Add the present line to the points; `header` records that a line of words has been skipped.
  pure subroutine read_line(file, x, z, points, header, info)
    type(text_file), intent(in) :: file
    real(dp), intent(inout) :: x(:), z(:)
    integer, intent(inout) :: points
    logical, intent(inout) :: header
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    real(dp) :: next_x, next_z
    integer :: kind

    call read_point(file%content(file%first:file%last), kind, next_x, next_z, reason)
    if (kind == LINE_EMPTY) return
    if (kind == LINE_WORDS .and. points == 0 .and. .not. header) then
      header = .true.
      return
    end if
    if (kind == LINE_POINT .and. points > 0) then
      if (.not. next_x > x(points)) then
        kind = LINE_WORDS
        reason = 'x = '//text(next_x)//' does not exceed x = '//text(x(points)) &
                 //' of the point before: x must increase; sort the points and merge repeated ones'
      end if
    end if
    if (kind == LINE_POINT) then
      points = points + 1
      x(points) = next_x
      z(points) = next_z
    else
      call file%refuse(reason, info)
    end if
  end subroutine read_line

end module fuge_profile_files
