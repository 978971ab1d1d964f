!> Time to read a surface of n x n heights in each text format, against that to read the bytes alone.
!>
!> surface_files [n]; n = 1024 by default. Prints rows | format | MB | bytes alone | fuge | MB/s | to standard output,
!> processor times in seconds, and leaves no file. Both sides alternate and the least time of each counts, because other
!> programs may run.
program surface_files
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp, fuge_info, fuge_read_surface, fuge_surface, FUGE_FILE_ANY
  implicit none

  character(len=*), parameter :: PATH = 'surface_files_scratch.txt'
  integer, parameter :: REPETITIONS = 5
  character(len=12) :: argument
  real(dp), allocatable :: height(:, :)
  integer :: n

  n = 1024
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) n
  allocate (height(n, n))
  call random_number(height)
  height = 1.0e-6_dp*(height - 0.5_dp)
  call measure('grid, 10 digits', '', '(*(es17.9e2))', .false., '')
  call measure('grid, 17 digits', '', '(*(es25.16e3))', .false., '')
  call measure('grid, 19 digits (numpy.savetxt)', '', '(*(es26.18e2))', .false., '')
  call measure('three columns, 10 digits', '', '(3es17.9e2)', .true., '')
  call measure('SDF, 10 digits', 'aISO-1.0', '(*(es17.9e2))', .false., '*')

contains

  !> Write the heights after a header, a point on each line if they are `points`, and measure how long reading takes.
  subroutine measure(name, header, form, points, trailer)
    character(len=*), intent(in) :: name, header, form, trailer
    logical, intent(in) :: points
    character(len=:), allocatable :: bytes
    type(fuge_surface) :: surface
    type(fuge_info) :: info
    real(dp) :: alone, start, time
    integer(int64) :: length
    integer :: k, unit

    call write_file(header, form, points, trailer)
    inquire (file=PATH, size=length)
    alone = huge(alone)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      allocate (character(len=length) :: bytes)
      open (newunit=unit, file=PATH, access='stream', form='unformatted', action='read')
      read (unit) bytes
      close (unit)
      deallocate (bytes)
      alone = min(alone, seconds() - start)
      start = seconds()
      call fuge_read_surface(PATH, surface, info, FUGE_FILE_ANY)
      time = min(time, seconds() - start)
      if (info%failed()) error stop 'a surface was not read'
    end do
    print '(a,a,f0.1,2(a,es8.1),a,i0,a)', '| '//name, ' | ', 1.0e-6_dp*real(length, dp), ' | ', alone, ' | ', time, &
      ' | ', nint(1.0e-6_dp*real(length, dp)/max(time, 1.0e-6_dp)), ' |'
    open (newunit=unit, file=PATH)
    close (unit, status='delete')
  end subroutine measure

  subroutine write_file(header, form, points, trailer)
    character(len=*), intent(in) :: header, form, trailer
    logical, intent(in) :: points
    integer :: i, j, unit

    open (newunit=unit, file=PATH, status='replace', action='write', recl=64*max(n, 16))
    if (header /= '') write (unit, '(a,2(/,a,i0),3(/,a),/,a)') header, 'NumPoints = ', n, 'NumProfiles = ', n, &
        'Xscale = 1e-6', 'Yscale = 1e-6', 'Zscale = 1', '*'
    do j = 1, n
      if (points) then
        write (unit, form) (1.0e-6_dp*real(i, dp), 1.0e-6_dp*real(j, dp), height(i, j), i=1, n)
      else
        write (unit, form) height(:, j)
      end if
    end do
    if (trailer /= '') write (unit, '(a)') trailer
    close (unit)
  end subroutine write_file

  !> Processor time.
  function seconds()
    real(dp) :: seconds

    call cpu_time(seconds)
  end function seconds

end program surface_files
