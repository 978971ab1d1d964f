!> Results on a regular grid, or on several depths below one, as a file for ParaView, with the numbers as they are.
!>
!> Grids are VTK image data (VTI), grids at depths rectilinear grids (VTR).
module fuge_result_files
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_GRID, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_write_results, fuge_write_volume

contains

  !> Write results on a grid of rectangular cells to a VTI file, which ParaView reads; an existing file is replaced.
  !>
  !> `nx`, `ny`: numbers of cells; `spacing_x`, `spacing_y`: their sizes. `names` (k): of the results, different, no
  !> trailing blanks. `results` (nx*ny, k): their values, one for each cell, in the order i + nx*(j - 1); all finite.
  !> `origin` (2, default 0): the centre of cell (1, 1). Values are written as doubles, to the last bit.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for a name, an existing file unchanged;
  !> FUGE_ERR_FILE if writing fails, the file is then empty.
  !> Nine arguments: the file, the grid, the results, the report.
  subroutine fuge_write_results(path, nx, ny, spacing_x, spacing_y, names, results, info, origin)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: check_results, end_vtk, put_results
    character(len=*), intent(in) :: path, names(:)
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, results(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: origin(2)
    type(text_output) :: file
    real(dp) :: corner(2)

    corner = 0.0_dp
    if (present(origin)) corner = origin
    call check_grid(nx, ny, [spacing_x, spacing_y], corner, info)
    if (.not. info%failed()) call check_results(int(nx, int64)*int(ny, int64), text(nx)//' x '//text(ny), names, &
                                               results, info)
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    corner = corner - 0.5_dp*[spacing_x, spacing_y]
    call write_image_head(file, nx, ny, [spacing_x, spacing_y], corner, names)
    call put_results(file, results)
    call end_vtk(file)
    call file%finish(info)
  end subroutine fuge_write_results

  !> Write results at the centres of the cells of a grid and at several depths below each, such as those of
  !> `fuge_halfspace_stress_grid`, to a VTR file, which ParaView reads; an existing file is replaced.
  !>
  !> `nx`, `ny`, `spacing_x`, `spacing_y`, `names` (k) and `origin` as in `fuge_write_results`; ny = 1 for a half-plane.
  !> `depth` (m), ascending, length. `results` (nx*ny*m, k): one value for each point, those of the first depth
  !> first; all finite. The z of the file is the depth.
  !> Errors: those of `fuge_write_results`, FUGE_ERR_GRID for depths that do not ascend, FUGE_ERR_MEMORY.
  !> Ten arguments: the file, the points, the results, the report.
  subroutine fuge_write_volume(path, nx, ny, spacing_x, spacing_y, depth, names, results, info, origin)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: check_results, end_vtk, put_results
    character(len=*), intent(in) :: path, names(:)
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing_x, spacing_y, depth(:), results(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: origin(2)
    type(text_output) :: file
    real(dp), allocatable :: x(:, :), y(:, :)
    real(dp) :: first(2)
    integer :: k, stat

    first = 0.0_dp
    if (present(origin)) first = origin
    call check_grid(nx, ny, [spacing_x, spacing_y], first, info)
    if (.not. info%failed()) call check_depths(depth, info)
    if (.not. info%failed()) call check_results(int(nx, int64)*int(ny, int64)*size(depth, kind=int64), &
                                               text(nx)//' x '//text(ny)//' x '//text(size(depth)), names, results, &
                                               info)
    if (info%failed()) return
    allocate (x(nx, 1), y(ny, 1), stat=stat)
    call require_memory(stat, 'the coordinates of '//text(nx)//' x', ny, 'points', info)
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    x(:, 1) = first(1) + spacing_x*[(real(k, dp), k=0, nx - 1)]
    y(:, 1) = first(2) + spacing_y*[(real(k, dp), k=0, ny - 1)]
    call write_volume_head(file, [nx, ny, size(depth)], names)
    call put_results(file, results)
    call put_results(file, x)
    call put_results(file, y)
    call put_results(file, spread(depth, 2, 1))
    call end_vtk(file)
    call file%finish(info)
  end subroutine fuge_write_volume

  !> Write all that stands before the numbers of a grid, in XML.
  subroutine write_image_head(file, nx, ny, spacing, corner, names)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: begin_values, begin_vtk, number_pair, put_result_list
    type(text_output), intent(inout) :: file
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing(2), corner(2)
    character(len=*), intent(in) :: names(:)
    integer(int64) :: offset

    call begin_vtk(file, 'ImageData')
    call file%put('<ImageData WholeExtent="0 '//text(nx)//' 0 '//text(ny)//' 0 0" Origin="'//number_pair(corner) &
                  //' 0" Spacing="'//number_pair(spacing)//' 1">')
    call file%put('<Piece Extent="0 '//text(nx)//' 0 '//text(ny)//' 0 0">')
    offset = 0_int64
    call put_result_list(file, 'CellData', names, int(nx, int64)*int(ny, int64), offset)
    call file%put('</Piece>')
    call file%put('</ImageData>')
    call begin_values(file)
  end subroutine write_image_head

  !> Write all that stands before the numbers of a grid at depths, in XML; `points` (3) along x, y and z.
  subroutine write_volume_head(file, points, names)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: begin_values, begin_vtk, put_array, put_result_list
    type(text_output), intent(inout) :: file
    integer, intent(in) :: points(3)
    character(len=*), intent(in) :: names(:)
    character(len=:), allocatable :: extent
    integer(int64) :: offset

    extent = '0 '//text(points(1) - 1)//' 0 '//text(points(2) - 1)//' 0 '//text(points(3) - 1)
    call begin_vtk(file, 'RectilinearGrid')
    call file%put('<RectilinearGrid WholeExtent="'//extent//'">')
    call file%put('<Piece Extent="'//extent//'">')
    offset = 0_int64
    call put_result_list(file, 'PointData', names, product(int(points, int64)), offset)
    call file%put('<Coordinates>')
    call put_array(file, 'x', int(points(1), int64), offset)
    call put_array(file, 'y', int(points(2), int64), offset)
    call put_array(file, 'z', int(points(3), int64), offset)
    call file%put('</Coordinates>')
    call file%put('</Piece>')
    call file%put('</RectilinearGrid>')
    call begin_values(file)
  end subroutine write_volume_head

  !> Refuse depths that do not ascend (FUGE_ERR_GRID), none (FUGE_ERR_SIZE), NaN and infinity (FUGE_ERR_NOT_FINITE).
  pure subroutine check_depths(depth, info)
    real(dp), intent(in) :: depth(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(depth) < 1) call report(info, FUGE_ERR_SIZE, 'depth is empty: a volume needs one depth or more')
    if (.not. info%failed()) call check_finite(depth, 'depth', info)
    if (info%failed()) return
    do k = 2, size(depth)
      if (depth(k) > depth(k - 1)) cycle
      call report(info, FUGE_ERR_GRID, 'depth('//index_text(k)//') = '//text(depth(k)) &
                  //' is not greater than the one before: sort the depths')
      return
    end do
  end subroutine check_depths

  !> Refuse impossible numbers and sizes of cells, and an origin that is not finite or out of range.
  pure subroutine check_grid(nx, ny, spacing, origin, info)
    integer, intent(in) :: nx, ny
    real(dp), intent(in) :: spacing(2), origin(2)
    type(fuge_info), intent(inout) :: info

    if (nx < 1 .or. ny < 1) then
      call report(info, FUGE_ERR_SIZE, 'nx = '//text(nx)//', ny = '//text(ny)//': both must be 1 or more')
      return
    end if
    call check_finite(spacing(1), 'spacing_x', info)
    if (.not. info%failed()) call check_finite(spacing(2), 'spacing_y', info)
    if (.not. info%failed()) call check_finite(origin, 'origin', info)
    if (info%failed()) return
    if (.not. minval(spacing) > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing_x = '//text(spacing(1))//', spacing_y = '//text(spacing(2)) &
                  //': both must be > 0')
    end if
  end subroutine check_grid

end module fuge_result_files
