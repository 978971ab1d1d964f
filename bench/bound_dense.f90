!> The active set beside its bound: the least work that any method on Cholesky factors has to do.
!>
!>     bound_dense [KIND N]
!>
!> The bound knows the contact set. It reads the matrix once, as a check has to, gathers the contact block, solves it
!> with one `dposv`, and multiplies the columns of the contact once, for gaps and certificate together. A cold solve
!> makes a new operator and a new solver; a warm one follows a solve at a load that was 1 % smaller. Both are compared
!> with the `dposv` alone too, and cold solves with two threads of fuge with those with one. All sides of a ratio are
!> measured alternately, and the fastest run of each counts. Writes rows of a Markdown table, with KIND (quartic or
!> random) and N those of one problem only. Threads of BLAS compete with those of fuge: OPENBLAS_NUM_THREADS=1.
program bound_dense
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use bench_lapack, only: dposv
  use bench_problems, only: bench_problem, add_matrix, contact_problem, make_known, make_random, uniform_edges, whole
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_MEAN
  implicit none

  !> Seconds for the repetitions of one row, and the fewest of them.
  real(dp), parameter :: PATIENCE = 1.5_dp
  integer, parameter :: FEWEST = 5
  !> A sample is as many runs as take this long in seconds, so that the clock is fine enough.
  real(dp), parameter :: SAMPLE = 2.0e-5_dp
  !> Solves of at least this many points have work for two threads, and this ratio of their times is wanted.
  integer, parameter :: MANY_POINTS = 800
  real(dp), parameter :: WANTED_TWO_THREADS = 0.62_dp
  !> The load step of the warm start.
  real(dp), parameter :: STEP = 1.01_dp
  integer, parameter :: QUARTICS(4) = [64, 256, 1024, 4096], RANDOMS(4) = [50, 200, 800, 2000]
  real(dp), parameter :: WANTED_QUARTIC(4) = [2.5_dp, 2.5_dp, 1.8_dp, 1.4_dp]
  real(dp), parameter :: WANTED_RANDOM(4) = [0.0_dp, 7.0_dp, 4.0_dp, 2.5_dp]
  real(dp), parameter :: WARM_QUARTIC(4) = [2.0_dp, 0.0_dp, 0.4_dp, 0.0_dp]
  real(dp), parameter :: WARM_RANDOM(4) = [0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp]
  !> Points of the small contact that a finite-element program solves in each Newton step, and its time in seconds.
  integer, parameter :: FEW_POINTS = 5
  real(dp), parameter :: WANTED_FEW = 3.0e-6_dp

  !> The least time of a sample so far, in seconds per run.
  type :: timing
    real(dp) :: best = huge(1.0_dp)
    integer :: batch = 1
    integer(int64) :: began = 0
  end type timing

  !> Arrays of the bound, allocated before it is timed.
  type :: bound_arrays
    integer, allocatable :: set(:)
    real(dp), allocatable :: block(:, :), answer(:, :), product(:)
    real(dp) :: checked = 0.0_dp
  end type bound_arrays

  call run()

contains

  subroutine run()
    character(len=16) :: kind, number
    type(bench_problem), target :: problem
    integer :: k

    call get_command_argument(1, kind)
    call get_command_argument(2, number)
    write (output_unit, '(a)') '| problem | bound | fuge | ratio | wanted |', '| --- | ---: | ---: | ---: | ---: |'
    do k = 1, size(QUARTICS)
      if (kind /= '' .and. .not. (kind == 'quartic' .and. number == whole(QUARTICS(k)))) cycle
      call make_known('quartic', FUGE_MEAN, uniform_edges(QUARTICS(k)), problem)
      call add_matrix(problem)
      call measure_cold('quartic '//whole(QUARTICS(k)), problem, WANTED_QUARTIC(k))
      call measure_warm('quartic '//whole(QUARTICS(k)), problem, WARM_QUARTIC(k))
    end do
    do k = 1, size(RANDOMS)
      if (kind /= '' .and. .not. (kind == 'random' .and. number == whole(RANDOMS(k)))) cycle
      call make_random(RANDOMS(k), problem)
      call measure_cold('random '//whole(RANDOMS(k)), problem, WANTED_RANDOM(k))
      call measure_warm('random '//whole(RANDOMS(k)), problem, WARM_RANDOM(k))
    end do
    if (kind /= '') return
    call make_known('quartic', FUGE_MEAN, uniform_edges(FEW_POINTS), problem)
    call add_matrix(problem)
    call measure_few(problem)
  end subroutine run

  !> A new operator, a new solver, a solve, over the bound.
  subroutine measure_cold(name, problem, wanted)
    character(len=*), intent(in) :: name
    type(bench_problem), intent(in), target :: problem
    real(dp), intent(in) :: wanted
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(bound_arrays) :: arrays
    type(timing) :: bound, block, solve, shared
    integer :: run, repetition, info_lapack
    integer(int64) :: began

    contact = contact_problem(problem)
    call solve_cold(problem, contact, 1, solution)
    call prepare_bound(solution%force, arrays)
    call system_clock(began)
    run = 0
    do
      call start(bound)
      do repetition = 1, bound%batch
        call run_bound(problem, solution%force, arrays)
      end do
      call finish(bound)
      call start(solve)
      do repetition = 1, solve%batch
        call solve_cold(problem, contact, 1, solution)
      end do
      call finish(solve)
      call start(shared)
      do repetition = 1, shared%batch
        call solve_cold(problem, contact, 2, solution)
      end do
      call finish(shared)
      call gather(problem, arrays)
      call start(block)
      call dposv('L', size(arrays%set), 1, arrays%block, size(arrays%set), arrays%answer, size(arrays%set), info_lapack)
      call finish(block)
      block%batch = 1
      run = run + 1
      if (run < FEWEST) cycle
      if (seconds_since(began) > PATIENCE) exit
    end do
    call write_row(name//', cold', bound%best, solve%best, wanted)
    call write_row(name//', cold over dposv', block%best, solve%best, wanted_over_dposv(name))
    if (problem%points() >= MANY_POINTS) then
      call write_row(name//', cold, two threads over one', solve%best, shared%best, WANTED_TWO_THREADS)
    end if
  end subroutine measure_cold

  !> A solve after one at a load that was 1 % smaller, with the same operator, over the `dposv` alone.
  subroutine measure_warm(name, problem, wanted)
    character(len=*), intent(in) :: name
    type(bench_problem), intent(in), target :: problem
    real(dp), intent(in) :: wanted
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_problem) :: contact, before
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(bound_arrays) :: arrays
    type(timing) :: bound, solve
    integer :: run, info_lapack
    integer(int64) :: began

    contact = contact_problem(problem)
    before = contact
    before%resultant = contact%resultant/STEP
    call operator%set(problem%alpha, info)
    call solver%solve(operator, contact, solution, info)
    call prepare_bound(solution%force, arrays)
    call system_clock(began)
    run = 0
    do
      call gather(problem, arrays)
      call start(bound)
      call dposv('L', size(arrays%set), 1, arrays%block, size(arrays%set), arrays%answer, size(arrays%set), info_lapack)
      call finish(bound)
      call solver%solve(operator, before, solution, info)
      call start(solve)
      call solver%solve(operator, contact, solution, info)
      call finish(solve)
      bound%batch = 1
      solve%batch = 1
      if (info%failed()) error stop 'not solved'
      run = run + 1
      if (run < FEWEST) cycle
      if (seconds_since(began) > PATIENCE) exit
    end do
    call write_row(name//', warm over dposv', bound%best, solve%best, wanted)
  end subroutine measure_warm

  !> Warm solves of a few points under loads that alternate; the time wanted stands in the column of the bound.
  subroutine measure_few(problem)
    type(bench_problem), intent(in), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_problem) :: contact(2)
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(timing) :: solve
    integer :: repetition
    integer(int64) :: began

    contact(1) = contact_problem(problem)
    contact(2) = contact(1)
    contact(2)%resultant = STEP*contact(1)%resultant
    call operator%set(problem%alpha, info)
    call system_clock(began)
    do while (seconds_since(began) < PATIENCE)
      call start(solve)
      do repetition = 1, solve%batch
        call solver%solve(operator, contact(1 + mod(repetition, 2)), solution, info)
      end do
      call finish(solve)
      if (info%failed()) error stop 'not solved'
    end do
    call write_row('quartic '//whole(FEW_POINTS)//', warm, over the time wanted', WANTED_FEW, solve%best, 1.0_dp)
  end subroutine measure_few

  !> The multiple of one `dposv` that is wanted of a cold solve; 0 for none.
  pure function wanted_over_dposv(name) result(wanted)
    character(len=*), intent(in) :: name
    real(dp) :: wanted

    wanted = 0.0_dp
    if (name == 'quartic 64') wanted = 3.0_dp
    if (name == 'random 2000') wanted = 3.5_dp
  end function wanted_over_dposv

  subroutine solve_cold(problem, contact, threads, solution)
    type(bench_problem), intent(in), target :: problem
    type(fuge_problem), intent(in) :: contact
    integer, intent(in) :: threads
    type(fuge_solution), intent(inout) :: solution
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_options) :: options
    type(fuge_info) :: info

    options%threads = threads
    call operator%set(problem%alpha, info, threads)
    if (.not. info%failed()) call solver%solve(operator, contact, solution, info, options)
    if (info%failed()) error stop 'not solved'
  end subroutine solve_cold

  subroutine prepare_bound(force, arrays)
    real(dp), intent(in) :: force(:)
    type(bound_arrays), intent(out) :: arrays
    integer :: k

    arrays%set = pack([(k, k=1, size(force))], force > 0.0_dp)
    allocate (arrays%block(size(arrays%set), size(arrays%set)), arrays%answer(size(arrays%set), 1), &
              arrays%product(size(force)))
  end subroutine prepare_bound

  subroutine run_bound(problem, force, arrays)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    type(bound_arrays), intent(inout) :: arrays
    integer :: j, info

    arrays%checked = max(arrays%checked, largest_coefficient(problem%alpha))
    call gather(problem, arrays)
    call dposv('L', size(arrays%set), 1, arrays%block, size(arrays%set), arrays%answer, size(arrays%set), info)
    if (info /= 0) error stop 'the contact block is not positive definite'
    arrays%product = 0.0_dp
    do j = 1, size(arrays%set)
      call add_column(force(arrays%set(j)), problem%alpha(:, arrays%set(j)), arrays%product)
    end do
  end subroutine run_bound

  subroutine gather(problem, arrays)
    type(bench_problem), intent(in) :: problem
    type(bound_arrays), intent(inout) :: arrays
    integer :: i, j

    do j = 1, size(arrays%set)
      do i = j, size(arrays%set)
        arrays%block(i, j) = problem%alpha(arrays%set(i), arrays%set(j))
      end do
    end do
    arrays%answer(:, 1) = problem%gap(arrays%set)
  end subroutine gather

  pure subroutine add_column(factor, column, product)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: column(:)
    real(dp), intent(inout), contiguous :: product(:)

    product = product + factor*column
  end subroutine add_column

  !> One pass over the matrix.
  pure function largest_coefficient(alpha) result(largest)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp) :: largest
    integer :: i, j

    largest = 0.0_dp
    do j = 1, size(alpha, 2)
      do i = 1, size(alpha, 1)
        largest = max(largest, abs(alpha(i, j)))
      end do
    end do
  end function largest_coefficient

  subroutine start(watch)
    type(timing), intent(inout) :: watch

    call system_clock(watch%began)
  end subroutine start

  !> Note a sample, and make the next one longer if it was too short for the clock.
  subroutine finish(watch)
    type(timing), intent(inout) :: watch
    real(dp) :: time

    time = seconds_since(watch%began)
    watch%best = min(watch%best, time/real(watch%batch, dp))
    if (time < SAMPLE) watch%batch = 2*watch%batch
  end subroutine finish

  function seconds_since(began) result(seconds)
    integer(int64), intent(in) :: began
    real(dp) :: seconds
    integer(int64) :: now, rate

    call system_clock(now, rate)
    seconds = real(now - began, dp)/real(rate, dp)
  end function seconds_since

  subroutine write_row(name, bound, time, wanted)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: bound, time, wanted
    character(len=8) :: limit

    limit = ''
    if (wanted > 0.0_dp) write (limit, '(f0.1)') wanted
    if (limit(1:1) == '.') limit = '0'//limit(:7)
    write (output_unit, '(3a, 2(es9.2, a), f6.2, 3a)') '| ', name, ' | ', bound, ' s | ', time, ' s | ', time/bound, &
      ' | ', trim(limit), ' |'
    flush (output_unit)
  end subroutine write_row

end program bound_dense
