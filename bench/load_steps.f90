!> Load steps by the iteration: the cost of a solve that may start from the solutions before it, beside one from
!> scratch.
!>
!>     load_steps [tolerance [problem]]
!>
!> Each problem is solved under loads that grow from solve to solve by 1, 5 and 20 %, and with the approaches that
!> belong to these loads; `tilt`, a flat square face under an eccentric load, with a moment that turns by 1, 5 and 20
!> degrees. A row has means over the last solves of a sequence: the points that change state from solve to solve, as a
!> fraction of the points in contact; products + preconditionings and contact sets (on all grids) of a solve from
!> scratch and of one in the sequence; how much that saves, and the largest excess of products of a single solve; times,
!> the fastest of three runs; the largest difference of a force, over the largest force.
program load_steps
  use bench_problems, only: bench_problem, make_known, make_rough, uniform_edges, whole
  use bench_surfaces, only: bench_surface, make_surface, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, fuge_operator, &
    fuge_options, fuge_problem, fuge_solution, fuge_solver, FUGE_ITERATIVE, FUGE_MEAN
  implicit none

  !> Mean pressures of the rough profiles over E*.
  real(dp), parameter :: LIGHT = 0.005_dp, HEAVY = 0.05_dp
  real(dp), parameter :: STEPS(3) = [0.01_dp, 0.05_dp, 0.20_dp]
  !> Solves of a sequence before those that count, and those that count.
  integer, parameter :: BEFORE = 3, COUNTED = 3
  integer, parameter :: RUNS = 3
  !> On the half-plane with 2**14 or 2**16 cells, on the half-space with 512 x 512, the last one with 128 x 128.
  character(len=10), parameter :: PROBLEMS(9) = [character(len=10) :: 'quartic_16', 'light_14', 'light_16', &
                                                 'heavy_14', 'heavy_16', 'sphere', 'light_area', 'heavy_area', 'tilt']
  !> Cells along a side of the tilted face, and the arm of its load over the side.
  integer, parameter :: FACE = 128
  real(dp), parameter :: ARM = 0.25_dp, DEGREE = acos(-1.0_dp)/180.0_dp

  type :: step_counts
    integer :: products(2) = 0, preconditionings(2) = 0, sets(2) = 0, changed = 0, contacts = 0, excess = -huge(1)
    real(dp) :: difference = 0.0_dp
    type(stopwatch) :: cold(COUNTED), warm(COUNTED)
  end type step_counts

  call run()

contains

  subroutine run()
    type(fuge_options) :: options
    character(len=32) :: argument, chosen
    integer :: k, stat

    options = fuge_options(FUGE_ITERATIVE)
    chosen = 'all'
    if (command_argument_count() > 0) then
      call get_command_argument(1, argument)
      read (argument, *, iostat=stat) options%tolerance
      if (stat /= 0) error stop 'usage: load_steps [tolerance [problem]]'
    end if
    if (command_argument_count() > 1) call get_command_argument(2, chosen)
    print '(a)', '| problem, step | changed | from scratch | sets | in sequence | sets | saved | excess | times | ' &
      //'difference |', '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do k = 1, size(PROBLEMS)
      if (chosen == 'all' .or. chosen == PROBLEMS(k)) call measure_problem(trim(PROBLEMS(k)), options)
    end do
  end subroutine run

  subroutine measure_problem(name, options)
    character(len=*), intent(in) :: name
    type(fuge_options), intent(in) :: options
    type(bench_problem) :: profile
    type(bench_surface) :: surface
    type(fuge_halfplane_operator) :: plane
    type(fuge_halfspace_operator) :: space
    type(fuge_info) :: info
    type(fuge_problem) :: problem
    integer :: n

    if (name == 'tilt') then
      call measure_tilt(options)
      return
    end if
    if (name == 'sphere' .or. index(name, 'area') > 0) then
      call make_surface(name, 512, surface)
      call set_operator(surface, space)
      problem = surface%contact()
      call measure(name//' 512 x 512', space, problem, options)
      return
    end if
    n = 2**14
    if (index(name, '16') > 0) n = 2**16
    if (index(name, 'light') > 0) then
      call make_rough(n, LIGHT, profile)
    else if (index(name, 'heavy') > 0) then
      call make_rough(n, HEAVY, profile)
    else
      call make_known('quartic', FUGE_MEAN, uniform_edges(n), profile)
    end if
    call plane%set(n, profile%width(1), profile%e_star, info, profile%element, profile%boundary)
    if (info%failed()) error stop 'no operator'
    allocate (problem%gap, source=profile%gap)
    allocate (problem%resultant, source=[profile%load])
    call measure(name, plane, problem, options)
  end subroutine measure_problem

  !> Loads, and the approaches that belong to them.
  subroutine measure(name, operator, problem, options)
    character(len=*), intent(in) :: name
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(fuge_problem) :: loaded, held
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: loads(1, 1 - BEFORE:COUNTED), approaches(1, 1 - BEFORE:COUNTED)
    integer :: j, k

    loaded = problem
    held = problem
    deallocate (held%resultant)
    held%prescribed = [.true.]
    do j = 1, size(STEPS)
      do k = 1 - BEFORE, COUNTED
        loads(:, k) = (1.0_dp + STEPS(j))**k*problem%resultant
        loaded%resultant = loads(:, k)
        call solver%solve(operator, loaded, solution, info, options)
        if (info%failed()) error stop 'not solved'
        approaches(:, k) = solution%motion
      end do
      call measure_sequence(name//', load, '//percent(STEPS(j)), operator, loaded, options, loads)
      call measure_sequence(name//', approach, '//percent(STEPS(j)), operator, held, options, approaches)
    end do
  end subroutine measure

  !> A moment that turns.
  subroutine measure_tilt(options)
    type(fuge_options), intent(in) :: options
    type(fuge_halfspace_operator) :: space
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    real(dp) :: resultants(3, 1 - BEFORE:COUNTED), angle
    integer :: j, k

    call space%set(FACE, FACE, 1.0_dp/real(FACE, dp), 1.0_dp/real(FACE, dp), 1.0_dp, info)
    if (info%failed()) error stop 'no operator'
    allocate (problem%gap(FACE**2), problem%modes(FACE**2, 3))
    problem%gap = 0.0_dp
    problem%modes(:, 1) = 1.0_dp
    do k = 1, FACE**2
      problem%modes(k, 2) = (real(modulo(k - 1, FACE), dp) + 0.5_dp)/real(FACE, dp) - 0.5_dp
      problem%modes(k, 3) = (real((k - 1)/FACE, dp) + 0.5_dp)/real(FACE, dp) - 0.5_dp
    end do
    do j = 1, size(STEPS)
      do k = 1 - BEFORE, COUNTED
        angle = 100.0_dp*STEPS(j)*DEGREE*real(k, dp) + 0.3_dp
        resultants(:, k) = [1.0_dp, ARM*cos(angle), ARM*sin(angle)]
      end do
      call measure_sequence('tilt, moment, '//whole(nint(100*STEPS(j)))//' degrees', space, problem, options, &
                            resultants)
    end do
  end subroutine measure_tilt

  !> `values`: the resultants or the approach of each solve.
  subroutine measure_sequence(name, operator, problem, options, values)
    character(len=*), intent(in) :: name
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    real(dp), intent(in) :: values(:, 1 - BEFORE:)
    type(step_counts) :: counts
    integer :: run

    do run = 1, RUNS
      call run_sequence(operator, problem, options, values, run == 1, counts)
    end do
    call print_row(name, counts)
  end subroutine measure_sequence

  subroutine run_sequence(operator, problem, options, values, counting, counts)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    real(dp), intent(in) :: values(:, 1 - BEFORE:)
    logical, intent(in) :: counting
    type(step_counts), intent(inout) :: counts
    type(fuge_problem) :: next
    type(fuge_solver) :: sequence, scratch
    type(fuge_solution) :: warm, cold
    type(fuge_info) :: warm_info, cold_info
    logical, allocatable :: last(:)
    integer :: k

    next = problem
    do k = 1 - BEFORE, 0
      call set_values(values(:, k), next)
      call sequence%solve(operator, next, warm, warm_info, options)
    end do
    do k = 1, COUNTED
      call set_values(values(:, k), next)
      last = warm%force > 0.0_dp
      call counts%warm(k)%start()
      call sequence%solve(operator, next, warm, warm_info, options)
      call counts%warm(k)%stop()
      call scratch%reset()
      call counts%cold(k)%start()
      call scratch%solve(operator, next, cold, cold_info, options)
      call counts%cold(k)%stop()
      if (warm_info%failed() .or. cold_info%failed()) error stop 'not solved'
      if (.not. counting) cycle
      counts%changed = counts%changed + count(last .neqv. warm%force > 0.0_dp)
      counts%contacts = counts%contacts + cold_info%contacts
      counts%products = counts%products + [cold_info%products, warm_info%products]
      counts%preconditionings = counts%preconditionings + [cold_info%preconditionings, warm_info%preconditionings]
      counts%sets = counts%sets + [cold_info%iterations, warm_info%iterations]
      counts%excess = max(counts%excess, warm_info%products - cold_info%products)
      counts%difference = max(counts%difference, maxval(abs(warm%force - cold%force))/maxval(cold%force))
    end do
  end subroutine run_sequence

  !> Resultants, or the approach where that is prescribed.
  subroutine set_values(values, problem)
    real(dp), intent(in) :: values(:)
    type(fuge_problem), intent(inout) :: problem

    if (allocated(problem%prescribed)) then
      problem%motion = values
    else
      problem%resultant = values
    end if
  end subroutine set_values

  pure function percent(step)
    real(dp), intent(in) :: step
    character(len=:), allocatable :: percent

    percent = whole(nint(100.0_dp*step))//' %'
  end function percent

  !> The mean of a solve, rounded.
  pure function mean(total)
    integer, intent(in) :: total
    character(len=:), allocatable :: mean

    mean = whole(nint(real(total)/real(COUNTED)))
  end function mean

  subroutine print_row(name, counts)
    character(len=*), intent(in) :: name
    type(step_counts), intent(in) :: counts
    real(dp) :: times(2), work(2)
    integer :: k

    times = 1.0e3_dp*[sum(counts%cold%best), sum(counts%warm%best)]/real(COUNTED, dp)
    work = real(counts%products + counts%preconditionings, dp)
    print '(3a,f4.1,a,2(4a,1x,2a),a,i0,3a,2(i0,a),es6.0,a)', '| ', name, ' | ', &
      100.0_dp*real(counts%changed, dp)/real(counts%contacts, dp), ' %', &
      (' | ', mean(counts%products(k)), ' + ', mean(counts%preconditionings(k)), '| ', mean(counts%sets(k)), k=1, 2), &
      ' | ', nint(100.0_dp*(1.0_dp - work(2)/work(1))), ' % | ', whole(counts%excess), ' | ', &
      nint(times(1)), ' ms, ', nint(times(2)), ' ms | ', counts%difference, ' |'
  end subroutine print_row

end program load_steps
