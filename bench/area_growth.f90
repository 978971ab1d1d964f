!> Time and memory of a contact on one grid, in a process that does nothing else.
!>
!>     area_growth DIRECTORY NAME N
!>
!> NAME is sphere, light_area or heavy_area, on N x N cells. Appends to DIRECTORY/results.csv; the limit is the
!> time of the products and preconditionings alone.
program area_growth
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_records, only: bench_row, open_table, write_row
  use bench_surface_runs, only: new_area_row, run_area, time_products
  use bench_surfaces, only: bench_surface, make_surface, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator
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
    row%limit = time_of_products(surface, row)
    call open_table(directory, table)
    call write_row(table, row)
    close (table)
  end subroutine run

  function time_of_products(surface, row) result(time)
    type(bench_surface), intent(in) :: surface
    type(bench_row), intent(in) :: row
    real(dp) :: time
    type(fuge_halfspace_operator) :: operator
    type(stopwatch) :: product, preconditioning

    call set_operator(surface, operator)
    call time_products(surface, operator, product, preconditioning)
    time = row%work*product%best + row%preconditionings*preconditioning%best
  end function time_of_products

end program area_growth
