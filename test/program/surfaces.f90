!> Surfaces with known answers: `surfaces write FOLDER` makes their files, `surfaces check TABLE CASE [FIELD]` holds a
!> table of the program, and its fields, against the answer.
!>
!> A ball, by Hertz; a wave on a periodic surface, by H. M. Westergaard (K. L. Johnson, Contact Mechanics, 1985, 13.2).
program surfaces
  use fuge_hertz_theory, only: fuge_hertz_contact, fuge_hertz_ellipse
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> The ball, N and mm.
  integer, parameter :: CELLS = 121
  real(dp), parameter :: RADIUS = 10.0_dp, E_STAR = 115385.0_dp, LOAD = 100.0_dp, STEP = 0.0035_dp
  !> The wave: its length is 1.
  integer, parameter :: WAVE_CELLS = 128, WAVE_ROWS = 4
  real(dp), parameter :: AMPLITUDE = 0.01_dp
  character(len=*), parameter :: COLUMNS = &
    'pressure,load,cells,area,fraction,approach,mean_gap,contact_pressure,largest_pressure,residual,status'

  call run()

contains

  subroutine run()
    character(len=400) :: words(4)
    integer :: k

    do k = 1, 4
      call get_command_argument(k, words(k))
    end do
    if (words(1) == 'write') then
      call write_files(trim(words(2)))
    else if (words(3) == 'ball') then
      call check_ball(words(2))
      if (len_trim(words(4)) > 0) call check_field(words(4))
    else
      call check_wave(words(2))
    end if
  end subroutine run

  !> Height of the ball at a place of the grid.
  elemental function ball(i, j) result(height)
    integer, intent(in) :: i, j
    real(dp) :: height

    height = -(place(i)**2 + place(j)**2)/(2.0_dp*RADIUS)
  end function ball

  elemental function place(i) result(x)
    integer, intent(in) :: i
    real(dp) :: x

    x = STEP*(real(i, dp) - 0.5_dp*real(CELLS + 1, dp))
  end function place

  !> The ball with spacings in the file, with none, with holes, tilted, in columns with heights in um, as SDF in
  !> metres; the wave.
  subroutine write_files(folder)
    character(len=*), intent(in) :: folder
    integer :: file, i, j

    call create(folder//'/ball.txt', STEP, file)
    do j = 1, CELLS
      write (file, '(*(es25.16))') ball([(i, i=1, CELLS)], j)
    end do
    close (file)
    call create(folder//'/plain.txt', 0.0_dp, file)
    do j = 1, CELLS
      write (file, '(*(es25.16))') ball([(i, i=1, CELLS)], j)
    end do
    close (file)
    call create(folder//'/holes.txt', STEP, file)
    write (file, '(*(a))') ('NaN ', i=1, CELLS)
    do j = 2, CELLS
      write (file, '(a,*(es25.16))') 'NaN ', ball([(i, i=2, CELLS)], j)
    end do
    close (file)
    call create(folder//'/tilted.txt', STEP, file)
    do j = 1, CELLS
      write (file, '(*(es25.16))') ball([(i, i=1, CELLS)], j) + 0.01_dp*place([(i, i=1, CELLS)]) - 0.02_dp*place(j)
    end do
    close (file)
    call create(folder//'/columns.txt', 0.0_dp, file)
    do j = 1, CELLS
      do i = 1, CELLS
        write (file, '(3es25.16)') place(i), place(j), 1.0e3_dp*ball(i, j)
      end do
    end do
    close (file)
    call write_sdf(folder//'/ball.sdf')
    call create(folder//'/wave.txt', 1.0_dp/WAVE_CELLS, file)
    do j = 1, WAVE_ROWS
      write (file, '(*(es25.16))') (AMPLITUDE*cos(2.0_dp*PI*real(i, dp)/WAVE_CELLS), i=1, WAVE_CELLS)
    end do
    close (file)
    open (newunit=file, file=folder//'/cut.txt', status='replace', action='write')
    write (file, '(a)') '1 2 3 4', '1 2 3'
    close (file)
  end subroutine write_files

  !> A file of heights, with its spacing if that is not 0.
  subroutine create(path, spacing, file)
    character(len=*), intent(in) :: path
    real(dp), intent(in) :: spacing
    integer, intent(out) :: file

    open (newunit=file, file=path, status='replace', action='write', recl=40*CELLS*2)
    if (spacing > 0.0_dp) write (file, '(a,es24.16)') '# spacing_x = ', spacing, '# spacing_y = ', spacing
  end subroutine create

  subroutine write_sdf(path)
    character(len=*), intent(in) :: path
    integer :: file, i, j

    call create(path, 0.0_dp, file)
    write (file, '(a)') 'aISO-1.0', 'ManufacID = fuge', 'CreateDate = 010120260000', 'ModDate = 010120260000'
    write (file, '(a,i0)') 'NumPoints = ', CELLS, 'NumProfiles = ', CELLS
    write (file, '(a,es24.16)') 'Xscale = ', 1.0e-3_dp*STEP, 'Yscale = ', 1.0e-3_dp*STEP, 'Zscale = ', 1.0_dp
    write (file, '(a)') 'Zresolution = -1', 'Compression = 0', 'DataType = 7', 'CheckType = 0', '*'
    do j = 1, CELLS
      write (file, '(*(es25.16))') 1.0e-3_dp*ball([(i, i=1, CELLS)], j)
    end do
    write (file, '(a)') '*'
    close (file)
  end subroutine write_sdf

  !> The lines of a table behind its heading, as numbers.
  subroutine read_rows(path, heading, values, rows)
    character(len=*), intent(in) :: path, heading
    real(dp), intent(inout) :: values(:, :)
    integer, intent(out) :: rows
    character(len=400) :: line
    integer :: file, status

    rows = -1
    open (newunit=file, file=path, status='old', action='read')
    do
      read (file, '(a)', iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == '#' .or. len_trim(line) == 0) cycle
      rows = rows + 1
      if (rows == 0) then
        if (line /= heading) error stop 'other columns'
      else
        read (line, *) values(:, rows)
      end if
    end do
    close (file)
  end subroutine read_rows

  !> One load, by Hertz.
  subroutine check_ball(path)
    character(len=*), intent(in) :: path
    type(fuge_hertz_contact) :: hertz
    type(fuge_info) :: info
    real(dp) :: row(11, 1), surface
    integer :: rows

    call read_rows(path, COLUMNS, row, rows)
    if (rows /= 1) error stop 'not one line'
    call fuge_hertz_ellipse(RADIUS, RADIUS, E_STAR, LOAD, hertz, info)
    if (info%failed()) error stop 'no closed form'
    surface = (CELLS*STEP)**2
    call expect('pressure', row(1, 1), LOAD/surface, 1.0e-12_dp)
    call expect('load', row(2, 1), LOAD, 1.0e-12_dp)
    call expect('area by cells', row(4, 1), row(3, 1)*STEP**2, 1.0e-12_dp)
    call expect('area', row(4, 1), PI*hertz%semi_axis_x**2, 0.02_dp)
    call expect('fraction', row(5, 1), row(4, 1)/surface, 1.0e-12_dp)
    call expect('approach', row(6, 1), hertz%approach, 3.0e-4_dp)
    call expect('contact_pressure', row(8, 1), LOAD/row(4, 1), 1.0e-12_dp)
    call expect('largest_pressure', row(9, 1), hertz%peak_pressure, 1.0e-3_dp)
    if (.not. row(10, 1) <= 1.0e-10_dp) error stop 'residual'
    if (abs(row(11, 1)) > 0.0_dp) error stop 'status'
  end subroutine check_ball

  !> The map: its pressures carry the load, and no cell has both a pressure and a gap.
  subroutine check_field(path)
    character(len=*), intent(in) :: path
    real(dp), allocatable :: cell(:, :)
    integer :: rows

    allocate (cell(5, CELLS**2))
    call read_rows(path, 'x,y,height,pressure,gap', cell, rows)
    if (rows /= CELLS**2) error stop 'not as many cells'
    call expect('load of the map', sum(cell(4, :))*STEP**2, LOAD, 1.0e-7_dp)
    call expect('x', cell(1, CELLS) - cell(1, 1), STEP*(CELLS - 1), 1.0e-7_dp)
    call expect('y', cell(2, CELLS**2) - cell(2, 1), STEP*(CELLS - 1), 1.0e-7_dp)
    if (any(cell(4, :) < 0.0_dp .or. cell(5, :) < 0.0_dp)) error stop 'a negative pressure or gap'
    if (any(cell(4, :) > 0.0_dp .and. cell(5, :) > 0.0_dp)) error stop 'a pressure across a gap'
    if (abs(cell(1, maxloc(cell(4, :), 1)) - 0.5_dp*(cell(1, 1) + cell(1, CELLS))) > 0.5_dp*STEP) &
      error stop 'the largest pressure is not in the middle'
  end subroutine check_field

  !> Three loads: a quarter and a half of complete contact, and one and a half of it.
  subroutine check_wave(path)
    character(len=*), intent(in) :: path
    real(dp) :: complete, row(11, 3), share
    integer :: k, rows

    call read_rows(path, COLUMNS, row, rows)
    if (rows /= 3) error stop 'not three lines'
    complete = PI*E_STAR*AMPLITUDE
    do k = 1, 3
      share = row(1, k)/complete
      call expect('sum of mean gap and approach', row(6, k) + row(7, k), AMPLITUDE, 1.0e-9_dp)
      if (share < 1.0_dp) then
        call expect('fraction', row(5, k), 2.0_dp/PI*asin(sqrt(share)), 0.02_dp)
        call expect('largest pressure', row(9, k), 2.0_dp*complete*sqrt(share), 2.0e-3_dp)
      else
        call expect('fraction', row(5, k), 1.0_dp, 1.0e-12_dp)
        call expect('largest pressure', row(9, k), complete*(share + 1.0_dp), 1.0e-3_dp)
      end if
    end do
  end subroutine check_wave

  subroutine expect(name, found, expected, tolerance)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: found, expected, tolerance

    print '(a,2es24.16)', name, found, expected
    if (.not. abs(found - expected) <= tolerance*abs(expected)) error stop 'too far from the known answer'
  end subroutine expect

end program surfaces
