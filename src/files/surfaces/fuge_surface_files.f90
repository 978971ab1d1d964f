!> Surfaces, heights on a regular grid, from files and to files.
module fuge_surface_files
  use fuge_input_checks, only: check_finite
  use fuge_instrument_files, only: refuse_instrument
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_sdf_header, only: is_sdf
  use fuge_sdf_reader, only: read_sdf
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, FUGE_ERR_SIZE, &
    FUGE_ERR_WIDTH
  use fuge_surface_filling, only: fill_surface
  use fuge_surface_grid, only: read_grid, write_grid
  use fuge_surface_heights, only: check_heights
  use fuge_surface_points, only: read_points
  use fuge_surface_rows, only: find_first_row, row_form
  use fuge_surface_type, only: fuge_surface, FUGE_FILE_ANY, FUGE_FILE_GRID, FUGE_FILE_POINTS, FUGE_FILE_SDF
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_surface, fuge_write_surface

contains

  !> Read a surface from a file of one of three formats.
  !>
  !> FUGE_FILE_GRID: a line for each row of points, j = 1, 2 .. ny, with the heights of its points i = 1, 2 .. nx. The
  !> spacings are 0 unless comments before the first row say `# spacing_x = ..` and `# spacing_y = ..`.
  !> FUGE_FILE_POINTS: x, y and height of a point on each line, in any order; the points form a full regular grid.
  !> FUGE_FILE_SDF: the surface data file of ISO 25178-71, text or binary, in metres.
  !>
  !> In text, columns are separated by blanks, tabs, commas or semicolons; numbers have a decimal point and may have an
  !> exponent after e or d; blank lines, comments from # or ! on and, before the numbers, lines of words are skipped:
  !> those without a number, and those that begin with a word and have fewer columns than the first row.
  !> A point that was not measured is an empty column, NaN or BAD, or missing among points with x and y.
  !>
  !> `surface` is set afresh, lengths in the unit of the file. `format` (default FUGE_FILE_ANY): recognised by the
  !> content, SDF by its first line, points by three columns. `fill` (default .false.): points that were not measured,
  !> which are refused otherwise, get the mean height of their neighbours, from the rim of a hole inwards;
  !> `surface%filled` is their number.
  !> Errors, `surface` unchanged: FUGE_ERR_FILE with file, line and reason, and of a file that is not text the name of
  !> its format; FUGE_ERR_OPTION for `format`;
  !> FUGE_ERR_MEMORY.
  subroutine fuge_read_surface(path, surface, info, format, fill)
    character(len=*), intent(in) :: path
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: format
    logical, intent(in), optional :: fill
    type(text_file) :: file
    type(fuge_surface) :: found
    integer :: known
    logical :: filling

    known = FUGE_FILE_ANY
    if (present(format)) known = format
    filling = .false.
    if (present(fill)) filling = fill
    if (known < FUGE_FILE_ANY .or. known > FUGE_FILE_SDF) then
      call report(info, FUGE_ERR_OPTION, 'format = '//text(known)//' is unknown: use FUGE_FILE_ANY, FUGE_FILE_GRID, ' &
                  //'FUGE_FILE_POINTS or FUGE_FILE_SDF')
      return
    end if
    call file%load(path, info)
    if (.not. info%failed() .and. .not. is_sdf(file)) call refuse_instrument(file, info)
    if (.not. info%failed() .and. known == FUGE_FILE_ANY) call recognise(file, known, info)
    if (info%failed()) return
    select case (known)
    case (FUGE_FILE_SDF)
      call read_sdf(file, filling, found, info)
    case (FUGE_FILE_POINTS)
      call read_points(file, filling, found, info)
    case default
      call read_grid(file, filling, found, info)
    end select
    if (info%failed()) return
    deallocate (file%content)
    if (filling) call fill_all(file%name, found, info)
    if (.not. info%failed()) call move_surface(found, surface)
  end subroutine fuge_read_surface

  !> The format of a file that is a grid, points, or SDF.
  pure subroutine recognise(file, format, info)
    type(text_file), intent(inout) :: file
    integer, intent(out) :: format
    type(fuge_info), intent(inout) :: info
    type(row_form) :: form

    format = FUGE_FILE_SDF
    if (is_sdf(file)) return
    call find_first_row(file, form, info)
    format = merge(FUGE_FILE_POINTS, FUGE_FILE_GRID, form%columns == 3)
  end subroutine recognise

  !> Fill the points that were not measured.
  pure subroutine fill_all(name, surface, info)
    character(len=*), intent(in) :: name
    type(fuge_surface), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    integer :: status

    call fill_surface(surface%height, surface%filled, status)
    if (status == 0) return
    if (surface%filled == size(surface%height)) then
      call report(info, FUGE_ERR_FILE, name//' has no point that was measured')
    else
      call report(info, FUGE_ERR_MEMORY, name//': no memory to fill '//text(surface%filled)//' points')
    end if
  end subroutine fill_all

  !> Move a surface; its heights are not copied.
  pure subroutine move_surface(from, to)
    type(fuge_surface), intent(inout) :: from, to

    call move_alloc(from%height, to%height)
    to%spacing_x = from%spacing_x
    to%spacing_y = from%spacing_y
    to%origin_x = from%origin_x
    to%origin_y = from%origin_y
    to%filled = from%filled
  end subroutine move_surface

  !> Write a surface as a plain grid, which `fuge_read_surface` reads back to the last bit.
  !>
  !> An existing file is replaced.
  !> Comments before the heights have the spacings, those that are not 0. The origin is not written.
  !> Errors: FUGE_ERR_SIZE without heights, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH for a negative
  !> spacing, an existing file unchanged; FUGE_ERR_FILE if writing fails, the file is then empty.
  subroutine fuge_write_surface(path, surface, info)
    character(len=*), intent(in) :: path
    type(fuge_surface), intent(in) :: surface
    type(fuge_info), intent(out) :: info

    if (allocated(surface%height)) then
      call check_heights(surface%height, info)
    else
      call report(info, FUGE_ERR_SIZE, 'the surface has no heights')
    end if
    if (.not. info%failed()) call check_spacing(surface%spacing_x, 'spacing_x', info)
    if (.not. info%failed()) call check_spacing(surface%spacing_y, 'spacing_y', info)
    if (.not. info%failed()) call write_grid(path, surface, info)
  end subroutine fuge_write_surface

  !> Refuse a spacing that is neither positive nor 0, unknown (FUGE_ERR_WIDTH, FUGE_ERR_NOT_FINITE).
  pure subroutine check_spacing(spacing, name, info)
    real(dp), intent(in) :: spacing
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    call check_finite(spacing, name, info)
    if (info%failed()) return
    if (.not. spacing >= 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, name//' = '//text(spacing)//' is negative: pass 0 if it is unknown')
    end if
  end subroutine check_spacing

end module fuge_surface_files
