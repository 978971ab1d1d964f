!> Contacts with known answers by every engine, from coarse to fine.
!>
!>     exact DIRECTORY [quick] [write]
!>
!> appends to DIRECTORY/results.csv; `quick` omits the finest grids, `write` writes the problems for
!> other solvers.
program exact
  use bench_graded, only: make_graded
  use bench_judge, only: approach_error
  use bench_problems, only: bench_problem, add_matrix, make_known, uniform_edges, KNOWN, REACH
  use bench_records, only: bench_row, open_table, write_problem, write_row
  use bench_runs, only: new_row, run_by_products, run_dense, run_warm
  use bench_watch, only: stopwatch
  use closed_forms, only: cylinder, quartic_punch
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_info, fuge_polynomial_profile, &
    fuge_smooth_contact, fuge_solve_smooth_punch, FUGE_ACTIVE_SET, FUGE_MEAN, FUGE_TABLEAU
  implicit none

  !> Largest numbers of cells, powers of two: for dense engines, and for products only.
  integer, parameter :: COARSEST = 16, FINEST = 4096, FINEST_QUICK = 512
  integer, parameter :: COARSEST_FFT = 64, FINEST_FFT = 2**20, FINEST_FFT_QUICK = 2**14
  !> Above this size there is only one problem, also for other solvers.
  integer, parameter :: FINEST_OF_ALL = 1024, FINEST_TABLEAU = 256, FINEST_ITERATED = 256, FINEST_FOR_OTHERS = 2**16
  !> Tolerance of the iteration, the library's default.
  real(dp), parameter :: TOLERANCE = 1.0e-10_dp
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  !> The options of the command line, and the unit of the table.
  type :: settings
    character(len=256) :: directory = ''
    integer :: table = 0
    logical :: quick = .false., writes = .false.
  end type settings

  call run()

contains

  subroutine run()
    type(settings) :: chosen
    integer :: k

    call read_settings(chosen)
    call open_table(chosen%directory, chosen%table)
    do k = 1, size(KNOWN)
      call run_uniform(trim(KNOWN(k)), chosen)
      if (KNOWN(k) /= 'wave') call run_graded(trim(KNOWN(k)), chosen)
      ! The iteration takes no tilts.
      if (all(KNOWN(k) /= [character(len=8) :: 'tilted', 'lifted'])) call run_fft(trim(KNOWN(k)), chosen)
      if (any(KNOWN(k) == [character(len=8) :: 'quartic', 'cylinder'])) call run_smooth(trim(KNOWN(k)), chosen)
    end do
    close (chosen%table)
  end subroutine run

  subroutine read_settings(chosen)
    type(settings), intent(inout) :: chosen
    character(len=16) :: word
    integer :: k

    call get_command_argument(1, chosen%directory)
    if (chosen%directory == '') error stop 'usage: exact DIRECTORY [quick] [write]'
    do k = 2, command_argument_count()
      call get_command_argument(k, word)
      if (word == 'quick') chosen%quick = .true.
      if (word == 'write') chosen%writes = .true.
    end do
  end subroutine read_settings

  !> Equal cells and a matrix.
  subroutine run_uniform(name, chosen)
    character(len=*), intent(in) :: name
    type(settings), intent(in) :: chosen
    type(bench_problem), target :: problem
    type(bench_row) :: row
    real(dp), allocatable :: force(:), other(:)
    integer :: n, most

    most = merge(FINEST_QUICK, merge(FINEST, FINEST_OF_ALL, name == 'quartic'), chosen%quick)
    n = COARSEST
    do while (n <= most)
      call make_known(name, FUGE_MEAN, uniform_edges(n), problem)
      row = new_row(problem, name)
      row%setup = matrix_time(problem)
      allocate (force(n), other(n))
      call run_dense(problem, FUGE_ACTIVE_SET, NONE, row, force)
      call write_row(chosen%table, row)
      if (chosen%writes .and. n <= FINEST_OF_ALL) call write_problem(chosen%directory, problem, row, force)
      if (name == 'quartic') then
        call run_warm(problem, force, row)
        call write_row(chosen%table, row)
        if (n <= FINEST_TABLEAU) then
          call run_dense(problem, FUGE_TABLEAU, force, row, other)
          call write_row(chosen%table, row)
        end if
      end if
      deallocate (force, other)
      n = 2*n
    end do
  end subroutine run_uniform

  function matrix_time(problem) result(time)
    type(bench_problem), intent(inout) :: problem
    real(dp) :: time
    type(stopwatch) :: watch

    do while (.not. watch%enough())
      call watch%start()
      call add_matrix(problem)
      call watch%stop()
    end do
    time = watch%best
  end function matrix_time

  !> Cells refined towards the edges of a coarse solution, or towards the corners.
  subroutine run_graded(name, chosen)
    character(len=*), intent(in) :: name
    type(settings), intent(in) :: chosen
    type(bench_problem), target :: problem
    type(bench_row) :: row
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)
    integer :: n, most

    n = COARSEST
    most = merge(FINEST_QUICK, FINEST_OF_ALL, chosen%quick)
    if (name == 'lifted') most = FINEST_ITERATED
    do while (n <= most)
      watch = stopwatch()
      do while (.not. watch%enough())
        call watch%start()
        call make_graded(name, n, problem)
        call watch%stop()
      end do
      allocate (force(problem%points()))
      row = new_row(problem, name)
      row%setup = watch%best
      call run_dense(problem, FUGE_ACTIVE_SET, NONE, row, force)
      row%method = 'graded'
      call write_row(chosen%table, row)
      deallocate (force)
      n = 2*n
    end do
  end subroutine run_graded

  !> Equal cells by FFT.
  subroutine run_fft(name, chosen)
    character(len=*), intent(in) :: name
    type(settings), intent(in) :: chosen
    type(bench_problem) :: problem
    type(bench_row) :: row
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)
    integer :: n

    n = COARSEST_FFT
    do while (n <= merge(FINEST_FFT_QUICK, FINEST_FFT, chosen%quick))
      call make_known(name, FUGE_MEAN, uniform_edges(n), problem)
      row = new_row(problem, name)
      watch = stopwatch()
      do while (.not. watch%enough())
        call watch%start()
        call operator%set(n, problem%width(1), problem%e_star, info, problem%element, problem%boundary)
        call watch%stop()
      end do
      if (info%failed()) error stop 'no operator of the half-plane'
      row%setup = watch%best
      allocate (force(n))
      call run_by_products(problem, operator, TOLERANCE, NONE, row, force)
      call write_row(chosen%table, row)
      ! For solvers that take profiles.
      if (chosen%writes .and. name == 'wave' .and. n > FINEST_OF_ALL .and. n <= FINEST_FOR_OTHERS) then
        call write_problem(chosen%directory, problem, row, force)
      end if
      deallocate (force)
      n = 2*n
    end do
  end subroutine run_fft

  !> Without cells: the pressure as a series. Its errors are measured at the centres of many cells.
  subroutine run_smooth(name, chosen)
    character(len=*), intent(in) :: name
    type(settings), intent(in) :: chosen
    integer, parameter :: PLACES = 10000
    type(bench_problem) :: problem
    type(bench_row) :: row
    type(fuge_polynomial_profile) :: profile
    type(fuge_smooth_contact) :: contact
    type(fuge_info) :: info
    type(stopwatch) :: watch

    call make_known(name, FUGE_MEAN, uniform_edges(PLACES), problem)
    profile%lower = -REACH
    profile%upper = REACH
    select type (form => problem%form)
    type is (quartic_punch)
      allocate (profile%coefficients, source=[0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, form%factor])
    type is (cylinder)
      allocate (profile%coefficients, source=[0.0_dp, 0.0_dp, 0.5_dp/form%radius])
    end select
    do while (.not. watch%enough())
      call watch%start()
      call fuge_solve_smooth_punch(profile, problem%e_star, problem%load, contact, info)
      call watch%stop()
    end do
    row = new_row(problem, name)
    row%method = 'smooth'
    row%element = ''
    row%time = watch%best
    if (info%status /= 0) row%failure = info%message(:len(row%failure))
    if (.not. info%failed()) call judge_smooth(problem, contact, info, row)
    call write_row(chosen%table, row)
  end subroutine run_smooth

  subroutine judge_smooth(problem, contact, info, row)
    type(bench_problem), intent(in) :: problem
    type(fuge_smooth_contact), intent(in) :: contact
    type(fuge_info), intent(in) :: info
    type(bench_row), intent(inout) :: row
    real(dp), dimension(problem%points()) :: exact, difference

    exact = problem%form%pressure(problem%x)
    difference = abs(contact%pressure(problem%x) - exact)
    row%n = size(contact%coefficients)
    row%unknowns = row%n
    row%residual = info%residual
    row%error_half_width = abs(contact%half_width/problem%form%a - 1.0_dp)
    row%error_pressure = dot_product(difference, problem%width)/problem%load
    row%error_force = maxval(difference)/maxval(exact)
    row%error_approach = approach_error(problem, contact%approach)
  end subroutine judge_smooth

end program exact
