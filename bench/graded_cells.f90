!> Equal cells beside those of `fuge_graded_cells`: error over the number of cells, and times.
!>
!>     graded_cells
!>
!> Contacts of a half-plane with known answers: a cylinder and a quartic punch, whose contact ends inside the cells, and
!> flat faces, upright and tilted by a force beside the middle, within the kern and beyond it, where one side lifts off.
!> The grading begins with a solution on half as many equal cells, or 32, that tells where the contact ends; its time
!> counts. Writes rows of a Markdown table: cells, errors of the pressure (the fraction of the load in the wrong place)
!> and of the approach (as a fraction of 2 F/(pi E*)), and the time from the data to the answer, matrix included.
program graded_cells
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_graded, only: make_graded
  use bench_problems, only: bench_problem, add_matrix, make_known, uniform_edges
  use bench_records, only: bench_row
  use bench_runs, only: new_row, run_dense
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, FUGE_ACTIVE_SET, FUGE_MEAN
  implicit none

  character(len=8), parameter :: NAMES(5) = [character(len=8) :: 'cylinder', 'quartic', 'flat', 'tilted', 'lifted']
  integer, parameter :: CELLS(5) = [16, 32, 64, 128, 256]
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  call run()

contains

  subroutine run()
    integer :: j, k

    write (output_unit, '(a)') '| contact | equal cells | pressure | approach | time | graded cells | pressure | ' &
      //'approach | time |', '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do j = 1, size(NAMES)
      do k = 1, size(CELLS)
        write (output_unit, '(3a)', advance='no') '| ', trim(NAMES(j)), ' |'
        call measure(trim(NAMES(j)), CELLS(k), .false.)
        call measure(trim(NAMES(j)), CELLS(k), .true.)
        write (output_unit, '(a)') ''
      end do
    end do
  end subroutine run

  subroutine measure(name, n, graded)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    logical, intent(in) :: graded
    type(bench_problem), target :: problem
    type(bench_row) :: row
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)

    do while (.not. watch%enough())
      call watch%start()
      if (graded) then
        call make_graded(name, n, problem)
      else
        call make_known(name, FUGE_MEAN, uniform_edges(n), problem)
        call add_matrix(problem)
      end if
      call watch%stop()
    end do
    allocate (force(problem%points()))
    row = new_row(problem, name)
    call run_dense(problem, FUGE_ACTIVE_SET, NONE, row, force)
    write (output_unit, '(a,i0,2(a,es7.1),a,f0.2,a)', advance='no') ' ', problem%points(), ' | ', row%error_pressure, &
      ' | ', row%error_approach, ' | ', 1.0e3_dp*(watch%best + row%time), ' ms |'
    flush (output_unit)
  end subroutine measure

end program graded_cells
