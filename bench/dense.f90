!> Speed of the engines for a dense matrix against the time of one Cholesky solve of the
!> contact block, and errors against exact solutions.
!>
!>     dense DIRECTORY [quick] [write]
!>
!> writes DIRECTORY/dense.csv. `quick` leaves out what has more than 1025 points; `write`
!> also writes the problems P1 and P3 for other solvers.
program dense
  use, intrinsic :: iso_fortran_env, only: error_unit
  use bench_lapack, only: dposv
  use bench_problems, only: add_matrix, bench_problem, make_punch, make_cylinder, make_random
  use bench_records, only: bench_row, write_header, write_row, write_problem
  use bench_watch, only: stopwatch
  use fuge, only: dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, fuge_solve_dense, &
    fuge_solver, FUGE_CENTRE, FUGE_MEAN, FUGE_TABLEAU
  implicit none

  integer, parameter :: HALFPLANE_SIZES(4) = [65, 257, 1025, 4097], RANDOM_SIZES(4) = [50, 200, 800, 2000]
  integer, parameter :: QUICK_SIZE = 1025, LARGEST_TABLEAU = 300
  integer, parameter :: ELEMENTS(2) = [FUGE_CENTRE, FUGE_MEAN]
  character(len=6), parameter :: ELEMENT_NAMES(2) = ['centre', 'mean  ']
  !> The load step of the warm start.
  real(dp), parameter :: STEP = 1.01_dp
  integer, parameter :: BYTES = 8

  !> What the command line asks for, and the unit of the table.
  type :: settings
    character(len=256) :: directory = ''
    integer :: table = 0
    integer :: largest = huge(1)
    logical :: writes = .false.
  end type settings

  call run()

contains

  subroutine run()
    type(settings) :: chosen
    integer :: k

    call read_settings(chosen)
    open (newunit=chosen%table, file=trim(chosen%directory)//'/dense.csv', status='replace', action='write')
    call write_header(chosen%table)
    do k = 1, size(HALFPLANE_SIZES)
      if (HALFPLANE_SIZES(k) <= chosen%largest) call measure_halfplane(HALFPLANE_SIZES(k), chosen)
    end do
    do k = 1, size(RANDOM_SIZES)
      if (RANDOM_SIZES(k) <= chosen%largest) call measure_random(RANDOM_SIZES(k), chosen)
    end do
    close (chosen%table)
  end subroutine run

  subroutine read_settings(chosen)
    type(settings), intent(inout) :: chosen
    character(len=16) :: word
    integer :: k

    call get_command_argument(1, chosen%directory)
    if (chosen%directory == '') error stop 'usage: dense DIRECTORY [quick] [write]'
    do k = 2, command_argument_count()
      call get_command_argument(k, word)
      if (word == 'quick') chosen%largest = QUICK_SIZE
      if (word == 'write') chosen%writes = .true.
    end do
  end subroutine read_settings

  !> P1 and P2: all engines on centres; the other element for its errors, where n is moderate.
  !> Hats are left out: on equal cells their matrix is that of the means.
  subroutine measure_halfplane(n, chosen)
    integer, intent(in) :: n
    type(settings), intent(in) :: chosen
    type(bench_problem) :: punch, cylinder
    integer :: e

    do e = 1, size(ELEMENTS)
      if (e > 1 .and. n > QUICK_SIZE) cycle
      call make_punch(n, ELEMENTS(e), punch)
      call add_matrix(punch)
      call measure(punch, ELEMENT_NAMES(e), chosen, all_engines=e == 1, for_others=e == 1)
      call make_cylinder(n, ELEMENTS(e), cylinder)
      call add_matrix(cylinder)
      call measure(cylinder, ELEMENT_NAMES(e), chosen, all_engines=e == 1, for_others=.false.)
    end do
  end subroutine measure_halfplane

  subroutine measure_random(n, chosen)
    integer, intent(in) :: n
    type(settings), intent(in) :: chosen
    type(bench_problem) :: problem

    call make_random(n, problem)
    call measure(problem, '', chosen, all_engines=.true., for_others=.true.)
  end subroutine measure_random

  !> All rows of one problem.
  subroutine measure(problem, element, chosen, all_engines, for_others)
    type(bench_problem), intent(in) :: problem
    character(len=*), intent(in) :: element
    type(settings), intent(in) :: chosen
    logical, intent(in) :: all_engines, for_others
    type(bench_row) :: row
    real(dp) :: force(size(problem%gap))

    row%problem = problem%name
    row%element = element
    row%n = size(problem%gap)
    call time_cold(problem, row, force)
    if (for_others .and. chosen%writes) call write_problem(trim(chosen%directory), problem, force)
    call write_row(chosen%table, row)
    if (.not. all_engines) return
    call write_row(chosen%table, limit_row(row))
    call time_warm(problem, row)
    call write_row(chosen%table, row)
    if (row%n > LARGEST_TABLEAU) return
    call time_tableau(problem, row)
    call write_row(chosen%table, row)
  end subroutine measure

  !> The whole call from a matrix to a certified answer, nothing known before. Its limit,
  !> what the final contact block costs one call of LAPACK without the copy it needs, is
  !> measured in turns with it, so that a busy machine slows both.
  subroutine time_cold(problem, row, force)
    type(bench_problem), intent(in), target :: problem
    type(bench_row), intent(inout) :: row
    real(dp), intent(out) :: force(:)
    type(stopwatch) :: watch, limit
    type(fuge_info) :: info
    real(dp) :: gap(size(force)), approach

    do while (.not. watch%enough())
      call watch%start()
      call fuge_solve_dense(problem%alpha, problem%gap, problem%load, force, gap, approach, info)
      call watch%stop()
      if (.not. info%failed()) call run_limit(problem, force, limit)
    end do
    row%method = 'active_set'
    row%limit = limit%median()
    call note(problem, watch, info, info%products, force, row)
    row%memory = factor_bytes(row%unknowns)
  end subroutine time_cold

  subroutine run_limit(problem, force, limit)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(stopwatch), intent(inout) :: limit
    real(dp), allocatable :: block(:, :), answer(:, :)
    integer, allocatable :: set(:)
    integer :: k, m, info

    set = pack([(k, k=1, size(force))], force > 0.0_dp)
    m = size(set)
    block = problem%alpha(set, set)
    answer = reshape(problem%gap(set), [m, 1])
    call limit%start()
    call dposv('L', m, 1, block, m, answer, m, info)
    call limit%stop()
    if (info /= 0) error stop 'the contact block is not positive definite'
  end subroutine run_limit

  !> A solve after one at a load that was 1 % smaller; the operator stays.
  subroutine time_warm(problem, row)
    type(bench_problem), intent(in), target :: problem
    type(bench_row), intent(inout) :: row
    type(stopwatch) :: watch
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call operator%set(problem%alpha, info)
    contact%gap = problem%gap
    do while (.not. watch%enough())
      contact%resultant = [problem%load/STEP]
      call solver%solve(operator, contact, solution, info)
      contact%resultant = [problem%load]
      call watch%start()
      call solver%solve(operator, contact, solution, info)
      call watch%stop()
    end do
    row%method = 'active_set_warm'
    call note(problem, watch, info, info%products, solution%force, row)
    row%memory = factor_bytes(row%unknowns)
  end subroutine time_warm

  subroutine time_tableau(problem, row)
    type(bench_problem), intent(in), target :: problem
    type(bench_row), intent(inout) :: row
    type(stopwatch) :: watch
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    type(fuge_options) :: options

    call operator%set(problem%alpha, info)
    contact%gap = problem%gap
    contact%resultant = [problem%load]
    options%method = FUGE_TABLEAU
    do while (.not. watch%enough())
      call watch%start()
      call solver%solve(operator, contact, solution, info, options)
      call watch%stop()
    end do
    row%method = 'tableau'
    call note(problem, watch, info, info%iterations, solution%force, row)
    row%memory = real(BYTES, dp)*real(row%n + 2, dp)*real(2*row%n + 2, dp)
  end subroutine time_tableau

  pure function limit_row(row) result(limit)
    type(bench_row), intent(in) :: row
    type(bench_row) :: limit

    limit%problem = row%problem
    limit%method = 'limit'
    limit%element = row%element
    limit%n = row%n
    limit%unknowns = row%unknowns
    limit%time = row%limit
    limit%limit = row%limit
    limit%memory = real(BYTES, dp)*real(row%unknowns, dp)**2
  end function limit_row

  !> Fill a row from a solve.
  subroutine note(problem, watch, info, work, force, row)
    type(bench_problem), intent(in) :: problem
    type(stopwatch), intent(in) :: watch
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: work
    real(dp), intent(in) :: force(:)
    type(bench_row), intent(inout) :: row
    real(dp) :: half_width

    if (info%status /= 0) then
      write (error_unit, '(*(a))') trim(problem%name), ' ', trim(row%method), ': ', trim(info%message)
      error stop 'not solved'
    end if
    row%time = watch%median()
    row%unknowns = info%contacts
    row%work = work
    row%residual = info%residual
    if (.not. allocated(problem%exact)) return
    half_width = 0.5_dp*(maxval(problem%x, mask=force > 0.0_dp) - minval(problem%x, mask=force > 0.0_dp) &
                         + problem%width)
    row%error_half_width = abs(half_width - problem%half_width)/problem%half_width
    row%error_pressure = norm2(force - problem%exact)/norm2(problem%exact)
    row%error_force = maxval(abs(force - problem%exact))/maxval(problem%exact)
  end subroutine note

  !> The factor of the contact block and its borders, the largest of what a solve allocates.
  pure function factor_bytes(contacts) result(total)
    integer, intent(in) :: contacts
    real(dp) :: total

    associate (borders => 16 + contacts/8)
      total = real(BYTES, dp)*(real(contacts, dp)*real(contacts + borders, dp) + real(borders, dp)**2)
    end associate
  end function factor_bytes

end program dense
