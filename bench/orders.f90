!> Errors of each element on many grids, from which the orders in the cell width follow: the edge of
!> the contact is anywhere in a cell.
!>
!>     orders DIRECTORY [quick]
!>
!> appends to DIRECTORY/results.csv.
program orders
  use bench_problems, only: bench_problem, make_known, uniform_edges
  use bench_records, only: bench_row, open_table, write_row
  use bench_runs, only: new_row, patience, run_by_products
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_info, FUGE_CENTRE, FUGE_HAT, FUGE_MEAN
  implicit none

  character(len=8), parameter :: NAMES(2) = ['quartic ', 'cylinder']
  integer, parameter :: ELEMENTS(3) = [FUGE_CENTRE, FUGE_MEAN, FUGE_HAT]
  integer, parameter :: GRIDS = 40
  real(dp), parameter :: FEWEST = 40.0_dp, MOST = 4000.0_dp, MOST_QUICK = 1000.0_dp
  !> Tolerance: errors of the solve have to be far below those of the grid.
  real(dp), parameter :: TOLERANCE = 1.0e-13_dp
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: word
    integer :: table, grid, name, element
    real(dp) :: last

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: orders DIRECTORY [quick]'
    call get_command_argument(2, word)
    last = merge(MOST_QUICK, MOST, word == 'quick')
    patience = 0.02_dp
    call open_table(directory, table)
    do name = 1, size(NAMES)
      do element = 1, size(ELEMENTS)
        do grid = 0, GRIDS - 1
          call measure(trim(NAMES(name)), ELEMENTS(element), &
                       nint(FEWEST*(last/FEWEST)**(real(grid, dp)/real(GRIDS - 1, dp))), table)
        end do
      end do
    end do
    close (table)
  end subroutine run

  subroutine measure(name, element, n, table)
    character(len=*), intent(in) :: name
    integer, intent(in) :: element, n, table
    type(bench_problem) :: problem
    type(bench_row) :: row
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp) :: force(n)

    call make_known(name, element, uniform_edges(n), problem)
    row = new_row(problem, name)
    watch%budget = patience
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(n, problem%width(1), problem%e_star, info, element)
      call watch%stop()
    end do
    row%setup = watch%best
    if (info%failed()) error stop 'no operator of the half-plane'
    call run_by_products(problem, operator, TOLERANCE, NONE, row, force)
    row%method = 'order'
    call write_row(table, row)
  end subroutine measure

end program orders
