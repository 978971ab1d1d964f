!> Solver errors over time, for random matrices and rough profiles, which have no closed form.
!>
!>     solvers DIRECTORY [quick] [write]
!>
!> appends to DIRECTORY/results.csv; `quick` omits the large problems, `write` writes the problems for
!> other solvers.
program solvers
  use bench_problems, only: bench_problem, make_random, make_rough
  use bench_records, only: bench_row, open_table, write_problem, write_row
  use bench_runs, only: new_row, run_by_products, run_dense, run_warm
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_info, FUGE_ACTIVE_SET, FUGE_TABLEAU
  implicit none

  integer, parameter :: RANDOM_SIZES(4) = [50, 200, 800, 2000], QUICK_RANDOM = 800, FINEST_TABLEAU = 200
  integer, parameter :: ROUGH_SIZES(3) = [4096, 65536, 1048576], QUICK_ROUGH = 4096, FINEST_FOR_OTHERS = 65536
  character(len=5), parameter :: ROUGH(2) = ['light', 'heavy']
  real(dp), parameter :: PRESSURES(2) = [0.005_dp, 0.05_dp]
  !> Tolerances of the iteration; the last one solves to rounding.
  real(dp), parameter :: TOLERANCES(5) = [1.0e-2_dp, 1.0e-4_dp, 1.0e-6_dp, 1.0e-8_dp, 1.0e-10_dp], LAST = 1.0e-12_dp
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: word
    logical :: quick, writes
    integer :: k, table

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: solvers DIRECTORY [quick] [write]'
    quick = .false.
    writes = .false.
    do k = 2, command_argument_count()
      call get_command_argument(k, word)
      quick = quick .or. word == 'quick'
      writes = writes .or. word == 'write'
    end do
    call open_table(directory, table)
    do k = 1, size(RANDOM_SIZES)
      if (RANDOM_SIZES(k) <= QUICK_RANDOM .or. .not. quick) call run_random(RANDOM_SIZES(k), directory, table, writes)
    end do
    do k = 1, size(ROUGH_SIZES)
      if (ROUGH_SIZES(k) > QUICK_ROUGH .and. quick) cycle
      call run_rough(1, ROUGH_SIZES(k), directory, table, writes)
      call run_rough(2, ROUGH_SIZES(k), directory, table, writes)
    end do
    close (table)
  end subroutine run

  subroutine run_random(n, directory, table, writes)
    integer, intent(in) :: n, table
    character(len=*), intent(in) :: directory
    logical, intent(in) :: writes
    type(bench_problem), target :: problem
    type(bench_row) :: row
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    real(dp) :: force(n), other(n)
    integer :: k

    call make_random(n, problem)
    row = new_row(problem, 'random')
    call run_dense(problem, FUGE_ACTIVE_SET, NONE, row, force)
    call write_row(table, row)
    if (writes) call write_problem(directory, problem, row, force)
    call run_warm(problem, force, row)
    call write_row(table, row)
    if (n <= FINEST_TABLEAU) then
      call run_dense(problem, FUGE_TABLEAU, force, row, other)
      call write_row(table, row)
    end if
    call operator%set(problem%alpha, info)
    do k = 1, size(TOLERANCES)
      row = new_row(problem, 'random')
      call run_by_products(problem, operator, TOLERANCES(k), force, row, other)
      call write_row(table, row)
    end do
  end subroutine run_random

  !> From the smallest tolerance to the largest: the first answer is the reference. The largest
  !> grid takes long, and is only there for its time.
  subroutine run_rough(which, n, directory, table, writes)
    integer, intent(in) :: which, n, table
    character(len=*), intent(in) :: directory
    logical, intent(in) :: writes
    type(bench_problem) :: problem
    type(bench_row) :: row
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:), other(:)
    integer :: k

    call make_rough(n, PRESSURES(which), problem)
    allocate (force(n), other(n))
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(n, problem%width(1), problem%e_star, info, problem%element, problem%boundary)
      call watch%stop()
    end do
    if (info%failed()) error stop 'no operator of the half-plane'
    row = new_row(problem, ROUGH(which))
    row%setup = watch%best
    if (n > FINEST_FOR_OTHERS) then
      call run_by_products(problem, operator, TOLERANCES(size(TOLERANCES)), NONE, row, force)
      call write_row(table, row)
      return
    end if
    call run_by_products(problem, operator, LAST, NONE, row, force)
    call write_row(table, row)
    if (writes) call write_problem(directory, problem, row, force)
    do k = size(TOLERANCES), 1, -1
      call run_by_products(problem, operator, TOLERANCES(k), force, row, other)
      call write_row(table, row)
    end do
  end subroutine run_rough

end program solvers
