!> Time and memory of one engine on one grid, in a process that does nothing else.
!>
!>     growth DIRECTORY ENGINE N
!>
!> ENGINE is tableau, active_set, iterative_dense or iterative_fft; the problem is the quartic punch.
!> Appends to DIRECTORY/results.csv.
program growth
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_problems, only: bench_problem, add_matrix, make_known, uniform_edges
  use bench_records, only: bench_row, open_table, write_row
  use bench_runs, only: new_row, run_by_products, run_dense
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_info, FUGE_ACTIVE_SET, FUGE_MEAN, &
    FUGE_TABLEAU
  implicit none

  real(dp), parameter :: TOLERANCE = 1.0e-10_dp
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: engine, word
    type(bench_problem), target :: problem
    type(bench_row) :: row
    real(dp) :: before
    integer :: n, table, stat
    logical :: forgotten

    call get_command_argument(1, directory)
    call get_command_argument(2, engine)
    call get_command_argument(3, word)
    read (word, *, iostat=stat) n
    if (stat /= 0) error stop 'usage: growth DIRECTORY ENGINE N'
    call make_known('quartic', FUGE_MEAN, uniform_edges(n), problem)
    row = new_row(problem, 'growth')
    call forget_peak(forgotten)
    before = resident()
    if (engine == 'iterative_fft') then
      call measure_fft(problem, row)
    else
      call measure_dense(problem, engine, row)
    end if
    if (forgotten .and. before > 0.0_dp) row%memory = peak_resident() - before
    call open_table(directory, table)
    call write_row(table, row)
    close (table)
  end subroutine run

  subroutine measure_fft(problem, row)
    type(bench_problem), intent(in) :: problem
    type(bench_row), intent(inout) :: row
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)

    do while (.not. watch%enough())
      call watch%start()
      call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element)
      call watch%stop()
    end do
    row%setup = watch%best
    allocate (force(problem%points()))
    call run_by_products(problem, operator, TOLERANCE, NONE, row, force)
  end subroutine measure_fft

  subroutine measure_dense(problem, engine, row)
    type(bench_problem), intent(inout), target :: problem
    character(len=*), intent(in) :: engine
    type(bench_row), intent(inout) :: row
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)

    do while (.not. watch%enough())
      call watch%start()
      call add_matrix(problem)
      call watch%stop()
    end do
    row%setup = watch%best
    allocate (force(problem%points()))
    select case (engine)
    case ('tableau')
      call run_dense(problem, FUGE_TABLEAU, NONE, row, force)
    case ('active_set')
      call run_dense(problem, FUGE_ACTIVE_SET, NONE, row, force)
    case ('iterative_dense')
      call operator%set(problem%alpha, info)
      call run_by_products(problem, operator, TOLERANCE, NONE, row, force)
    case default
      error stop 'ENGINE is tableau, active_set, iterative_dense or iterative_fft'
    end select
  end subroutine measure_dense

end program growth
