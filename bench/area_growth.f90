!> Time and memory of a contact on one grid, in a process that does nothing else.
!>
!>     area_growth DIRECTORY NAME N
!>
!> NAME is sphere, light_area or heavy_area, on N x N cells. Appends to DIRECTORY/results.csv; the limit is as many pairs
!> of bare transforms as the solve makes products and preconditionings.
program area_growth
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_runs, only: new_area_row, run_area
  use bench_surfaces, only: bench_surface, make_surface
  use bench_transforms, only: grid_transform
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, FUGE_FREE
  use fuge_fft, only: good_length
  implicit none

  real(dp), parameter :: OF_SPHERE = 1.0e-10_dp, OF_ROUGH = 1.0e-8_dp

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: name, word
    type(bench_surface) :: surface
    type(bench_row) :: row
    real(dp) :: before
    integer :: n, table, stat
    logical :: forgotten

    call get_command_argument(1, directory)
    call get_command_argument(2, name)
    call get_command_argument(3, word)
    read (word, *, iostat=stat) n
    if (stat /= 0) error stop 'usage: area_growth DIRECTORY NAME N'
    call make_surface(trim(name), n, surface)
    row = new_area_row(surface)
    row%problem = 'area_growth'
    row%method = surface%name
    call forget_peak(forgotten)
    before = resident()
    call run_area(surface, merge(OF_SPHERE, OF_ROUGH, name == 'sphere'), row)
    if (forgotten .and. before > 0.0_dp) row%memory = peak_resident() - before
    row%limit = time_of_transforms(surface, row)
    call open_table(directory, table)
    call write_row(table, row)
    close (table)
  end subroutine run

  function time_of_transforms(surface, row) result(time)
    type(bench_surface), intent(in) :: surface
    type(bench_row), intent(in) :: row
    real(dp) :: time

    if (surface%boundary == FUGE_FREE) then
      time = row%work*pair(good_length(2*surface%n - 1)) + row%preconditionings*pair(good_length(surface%n))
    else
      time = (row%work + row%preconditionings)*pair(surface%n)
    end if
  end function time_of_transforms

  !> The time of a pair of bare transforms of length x length numbers.
  function pair(length) result(time)
    integer, intent(in) :: length
    real(dp) :: time
    type(grid_transform) :: transform
    type(stopwatch) :: watch

    call transform%create(length, length)
    do while (.not. watch%enough())
      call watch%start()
      call transform%forward()
      call transform%backward()
      call watch%stop()
      transform%values = 0.0_dp
    end do
    time = watch%best
    call transform%free()
  end function pair

end program area_growth
