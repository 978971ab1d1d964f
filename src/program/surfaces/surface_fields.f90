!> Height, pressure and gap of a measured surface: for ParaView, or as a table that gnuplot draws.
module surface_fields
  use command_line, only: refuse
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_solution, FUGE_ERR_MEMORY
  use fuge_files, only: fuge_surface, fuge_write_results
  use text_table, only: table
  implicit none
  private

  public :: check_name, write_fields

contains

  !> Refuse endings of other files of VTK. Error: FUGE_ERR_OPTION.
  subroutine check_name(path, info)
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    if (ending(path) == '.vti' .or. index(ending(path), '.vt') == 0) return
    call refuse('--field '//path//': a surface is a grid, for ParaView a file *.vti; any other name is that of a ' &
                //'table', info)
  end subroutine check_name

  !> The last four characters.
  pure function ending(path)
    character(len=*), intent(in) :: path
    character(len=4) :: ending

    ending = path(max(len(path) - 3, 1):)
  end function ending

  !> Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine write_fields(path, surface, solution, info)
    character(len=*), intent(in) :: path
    type(fuge_surface), intent(in) :: surface
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: fields(:, :)
    type(fuge_info) :: of_file
    integer :: j, nx, status

    nx = size(surface%height, 1)
    allocate (fields(size(surface%height), 3), stat=status)
    if (status /= 0) then
      info%status = FUGE_ERR_MEMORY
      info%message = '--field '//path//': no memory for three fields'
      return
    end if
    do j = 1, size(surface%height, 2)
      fields(nx*(j - 1) + 1:nx*j, 1) = surface%height(:, j)
    end do
    fields(:, 2) = solution%force/(surface%spacing_x*surface%spacing_y)
    fields(:, 3) = solution%gap
    if (ending(path) /= '.vti') then
      call write_map(path, surface, fields, info)
      return
    end if
    call fuge_write_results(path, nx, size(surface%height, 2), surface%spacing_x, surface%spacing_y, &
                            [character(len=8) :: 'height', 'pressure', 'gap'], fields, of_file, &
                            origin=[surface%origin_x, surface%origin_y])
    if (of_file%failed()) info = of_file
  end subroutine write_fields

  !> A line for each cell; a blank line between rows, as gnuplot needs it to draw a map.
  subroutine write_map(path, surface, fields, info)
    character(len=*), intent(in) :: path
    type(fuge_surface), intent(in) :: surface
    real(dp), intent(in) :: fields(:, :)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=100) :: line
    integer :: i, j, k

    call csv%create(path, info)
    if (info%failed()) return
    call csv%put('x,y,height,pressure,gap')
    k = 0
    do j = 1, size(surface%height, 2)
      do i = 1, size(surface%height, 1)
        k = k + 1
        write (line, '(4(es16.8e3,","),es16.8e3)') surface%origin_x + surface%spacing_x*real(i - 1, dp), &
          surface%origin_y + surface%spacing_y*real(j - 1, dp), fields(k, :)
        call csv%put(line)
      end do
      if (j < size(surface%height, 2)) call csv%put('')
    end do
    call csv%finish(info)
  end subroutine write_map

end module surface_fields
