!> Repeated solves of a problem by one engine: the fastest time, its limit, residual and errors.
module bench_runs
  use bench_judge, only: judge
  use bench_lapack, only: dposv
  use bench_problems, only: bench_problem, contact_problem
  use bench_records, only: bench_row, element_name
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_info, fuge_operator, fuge_options, &
    fuge_problem, fuge_solution, fuge_solver, FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  implicit none
  private

  public :: solve_once, run_dense, run_warm, run_by_products, new_row

  !> Seconds that repetitions of one measurement may take together.
  real(dp), public :: patience = 0.1_dp

  !> Products in one sample: a single one is too short for the clock.
  integer, parameter :: BATCH = 5
  !> The load step of the warm start.
  real(dp), parameter :: STEP = 1.01_dp

contains

  !> The row with which a problem's measurements start.
  function new_row(problem, name) result(row)
    type(bench_problem), intent(in) :: problem
    character(len=*), intent(in) :: name
    type(bench_row) :: row

    row%problem = name
    row%n = problem%points()
    if (allocated(problem%x)) row%element = element_name(problem%element)
  end function new_row

  !> A cold solve from a matrix to a certified answer by a dense engine. Its limit is the time of one LAPACK
  !> call for the final contact block, without the copy it needs. The two are measured alternately, so that
  !> a busy machine slows both.
  subroutine run_dense(problem, method, reference, row, force)
    type(bench_problem), intent(in), target :: problem
    integer, intent(in) :: method
    real(dp), intent(in) :: reference(:)
    type(bench_row), intent(inout) :: row
    real(dp), intent(out) :: force(:)
    type(stopwatch) :: watch, limit
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    contact = contact_problem(problem)
    watch%budget = patience
    row%method = merge('tableau         ', 'active_set      ', method == FUGE_TABLEAU)
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(problem%alpha, info)
      if (.not. info%failed()) call solve_cold(operator, contact, fuge_options(method), solution, info)
      call watch%stop()
      if (info%failed()) exit
      call run_limit(problem%alpha, problem%gap, solution%force, limit)
    end do
    call note(watch, limit%best, info, row)
    row%work = merge(info%iterations, info%products, method == FUGE_TABLEAU)
    force = 0.0_dp
    if (info%failed()) return
    force = solution%force
    call judge(problem, operator, force, reference, row)
  end subroutine run_dense

  !> One solve by the active set.
  subroutine solve_once(problem, force)
    type(bench_problem), intent(in), target :: problem
    real(dp), intent(out) :: force(:)
    type(fuge_dense_operator) :: operator
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call operator%set(problem%alpha, info)
    call solve_cold(operator, contact_problem(problem), fuge_options(FUGE_ACTIVE_SET), solution, info)
    if (info%failed()) error stop 'not solved'
    force = solution%force
  end subroutine solve_once

  !> One solve by a new solver.
  subroutine solve_cold(operator, contact, options, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: contact
    type(fuge_options), intent(in) :: options
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solver%solve(operator, contact, solution, info, options)
  end subroutine solve_cold

  subroutine run_limit(alpha, gap, force, limit)
    real(dp), intent(in) :: alpha(:, :), gap(:), force(:)
    type(stopwatch), intent(inout) :: limit
    real(dp), allocatable :: block(:, :), answer(:, :)
    integer, allocatable :: set(:)
    integer :: j, k, m, info

    set = pack([(k, k=1, size(force))], force > 0.0_dp)
    m = size(set)
    allocate (block(m, m), answer(m, 1))
    do j = 1, m
      block(:, j) = alpha(set, set(j))
    end do
    answer(:, 1) = gap(set)
    call limit%start()
    call dposv('L', m, 1, block, m, answer, m, info)
    call limit%stop()
    if (info /= 0) error stop 'the contact block is not positive definite'
  end subroutine run_limit

  !> A solve after one at a load that was 1 % smaller, with the same operator. `row` is that of the
  !> cold solve.
  subroutine run_warm(problem, reference, row)
    type(bench_problem), intent(in), target :: problem
    real(dp), intent(in) :: reference(:)
    type(bench_row), intent(inout) :: row
    type(stopwatch) :: watch
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact, before
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call operator%set(problem%alpha, info)
    contact = contact_problem(problem)
    watch%budget = patience
    before = contact
    before%resultant = contact%resultant/STEP
    do while (.not. watch%enough())
      call solver%solve(operator, before, solution, info, fuge_options(FUGE_ACTIVE_SET))
      call watch%start()
      call solver%solve(operator, contact, solution, info, fuge_options(FUGE_ACTIVE_SET))
      call watch%stop()
    end do
    row%method = 'active_set_warm'
    call note(watch, row%limit, info, row)
    row%work = info%products
    if (.not. info%failed()) call judge(problem, operator, solution%force, reference, row)
  end subroutine run_warm

  !> A solve by products only, without the set-up of the operator; the limit is one product, measured alternately.
  subroutine run_by_products(problem, operator, tolerance, reference, row, force)
    type(bench_problem), intent(in) :: problem
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: tolerance, reference(:)
    type(bench_row), intent(inout) :: row
    real(dp), intent(out) :: force(:)
    type(stopwatch) :: watch, product
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    contact = contact_problem(problem)
    watch%budget = patience
    row%method = 'iterative_dense'
    select type (operator)
    class is (fuge_halfplane_operator)
      row%method = 'iterative_fft'
    end select
    row%tolerance = tolerance
    do while (.not. watch%enough())
      call watch%start()
      call solve_cold(operator, contact, fuge_options(FUGE_ITERATIVE, tolerance=tolerance), solution, info)
      call watch%stop()
      if (info%failed()) exit
      call run_products(operator, solution%force, product)
    end do
    call note(watch, product%best/real(BATCH, dp), info, row)
    row%work = info%products
    row%preconditionings = info%preconditionings
    force = 0.0_dp
    if (info%failed()) return
    force = solution%force
    call judge(problem, operator, force, reference, row)
  end subroutine run_by_products

  subroutine run_products(operator, force, watch)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable :: displacement(:)
    integer :: k, status

    allocate (displacement(size(force)), source=0.0_dp)
    call watch%start()
    do k = 1, BATCH
      call operator%apply(force, displacement, status)
      if (status /= 0) error stop 'no product'
    end do
    call watch%stop()
  end subroutine run_products

  !> The text of a warning or an error.
  subroutine note(watch, limit, info, row)
    type(stopwatch), intent(in) :: watch
    real(dp), intent(in) :: limit
    type(fuge_info), intent(in) :: info
    type(bench_row), intent(inout) :: row

    row%time = watch%best
    row%limit = -1.0_dp
    if (limit < huge(limit)/BATCH) row%limit = limit
    row%failure = ''
    if (info%status /= 0) row%failure = info%message(:len(row%failure))
  end subroutine note

end module bench_runs
