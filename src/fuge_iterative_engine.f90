!> The engine that needs nothing but products with the operator.
!>
!> Conjugate gradients solve the equations of a contact set just well enough to tell
!> which points pull and which penetrate; those change sides, and so on until none is
!> left and the residual is as small as asked for. An operator with coarser grids starts
!> there. Where changes of many points at once do not get on, forces only push and one point
!> joins at a time, down the energy: that ends (see fuge_active_set).
module fuge_iterative_engine
  use fuge_check, only: LARGEST_EXPONENT
  use fuge_contact_exchange, only: exchange, exchange_in_row
  use fuge_contact_filter, only: contact_filter
  use fuge_grids, only: grid_family
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_products, only: multiply
  use fuge_set_gradients, only: iterate, make_iterate, relax, measure, open_gap
  use fuge_step_back, only: step_back
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_CANCELLED
  use fuge_text, only: text
  implicit none
  private

  public :: solve_by_iteration

  !> Residual asked of a grid that only gives a start to a finer one.
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-4_dp
  !> The engine aims below the tolerance by this factor, because the certificate
  !> counts more than the equations of the set.
  real(dp), parameter :: MARGIN = 0.4_dp
  !> Block changes without fewer wrong points before single ones; the foresight ends
  !> when half of them are used.
  integer, parameter :: PATIENCE = 10
  !> Sets allowed for each point when the caller sets no limit.
  integer, parameter :: SETS_PER_POINT = 50

  !> What one solve works on, and what stays the same on all grids.
  type :: solve_context
    type(grid_family) :: family
    real(dp) :: tolerance = 0.0_dp
    integer :: limit = 0
    !> Points of the finest grid.
    integer :: points = 0
    !> Products and filters on coarser grids, as parts of those on the finest.
    real(dp) :: coarse_products = 0.0_dp, coarse_filters = 0.0_dp
  end type solve_context

contains

  !> From checked data to an answer and its words.
  !>
  !> `problem` checked, load > 0; `part` (n) if allocated forces to start from, as parts
  !> of the load, and on return those of the answer; `answer` allocated. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CALLBACK,
  !> FUGE_ERR_CANCELLED.
  subroutine solve_by_iteration(operator, problem, options, monitor, part, answer, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: part(:)
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    type(solve_context) :: context
    type(iterate) :: state
    real(dp), allocatable :: shape(:)
    real(dp) :: lowest
    integer :: n, stat

    n = operator%points()
    call check_magnitude(problem, info)
    if (info%failed()) return
    allocate (shape(n), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps of '//text(n)//' points')
    if (.not. info%failed()) call context%family%make(operator, info)
    if (info%failed()) return
    context%points = n
    context%limit = options%max_iterations
    if (context%limit == 0) context%limit = int(min(real(SETS_PER_POINT, dp)*(real(n, dp) + 1.0_dp), 1.0e9_dp))

    associate (load => problem%resultant(1))
      lowest = minval(problem%gap)
      shape = (problem%gap - lowest)/load
      if (allocated(part)) then
        call make_iterate(state, n, info)
        if (info%failed()) return
        state%force = part
      else
        call climb_to_finest(context, shape, monitor, state, info)
        if (info%failed()) return
      end if
      context%tolerance = options%tolerance
      call find_contact(operator, context, 0, shape, monitor, state, info)
      if (info%failed()) return
      info%products = info%products + ceiling(context%coarse_products)
      info%filters = info%filters + ceiling(context%coarse_filters)
      ! What is left of a force that should have become zero.
      where (state%force <= 4.0_dp*epsilon(1.0_dp)*maxval(state%force)) state%force = 0.0_dp
      answer%force = load*state%force
      answer%gap = load*max(open_gap(shape, state%displacement, state%motion), 0.0_dp)
      where (state%contact) answer%gap = 0.0_dp
      answer%rigid = (load*state%motion + operator%datum()*sum(answer%force)) + lowest
      call move_alloc(state%force, part)
    end associate
  end subroutine solve_by_iteration

  !> Refuse gaps that overflow when divided by the load.
  pure subroutine check_magnitude(problem, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: excess

    excess = exponent(maxval(problem%gap) - minval(problem%gap)) - exponent(problem%resultant(1))
    if (excess > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps are 2**'//text(excess)//' times the load: choose units in which ' &
                  //'they are nearer to it')
    end if
  end subroutine check_magnitude

  !> Forces to start from on the finest grid: those of the coarsest one, carried from grid
  !> to grid.
  subroutine climb_to_finest(context, shape, monitor, state, info)
    type(solve_context), intent(inout) :: context
    real(dp), intent(in) :: shape(:)
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    type(iterate) :: coarse
    real(dp), allocatable :: force(:), coarse_shape(:)
    type(fuge_info) :: counted
    real(dp) :: share
    integer :: k

    context%tolerance = COARSE_TOLERANCE
    do k = size(context%family%coarse), 1, -1
      associate (grid => context%family%coarse(k)%operator)
        call shape_on_grid(shape, 2**k, grid%points(), coarse_shape, info)
        if (.not. info%failed()) call make_iterate(coarse, grid%points(), info)
        if (info%failed()) return
        call set_start(force, coarse%force)
        counted = fuge_info()
        counted%iterations = info%iterations
        call find_contact(grid, context, k, coarse_shape, monitor, coarse, counted)
        info%iterations = counted%iterations
        share = real(grid%points(), dp)/real(size(shape), dp)
        context%coarse_products = context%coarse_products + share*real(counted%products, dp)
        context%coarse_filters = context%coarse_filters + share*real(counted%filters, dp)
        if (counted%failed()) then
          call report(info, counted%status, 'on the grid of '//text(grid%points())//' points: '//counted%message)
          return
        end if
        call move_alloc(coarse%force, force)
        coarse = iterate()
      end associate
    end do
    call make_iterate(state, size(shape), info)
    if (.not. info%failed()) call set_start(force, state%force)
  end subroutine climb_to_finest

  !> Forces from the next coarser grid, or even ones.
  pure subroutine set_start(coarse, force)
    real(dp), intent(in), allocatable :: coarse(:)
    real(dp), intent(out) :: force(:)

    if (allocated(coarse)) then
      call interpolate(coarse, force)
    else
      force = 1.0_dp/real(size(force), dp)
    end if
  end subroutine set_start

  !> Linear between the centres of the coarse cells.
  pure subroutine interpolate(coarse, fine)
    real(dp), intent(in) :: coarse(:)
    real(dp), intent(out) :: fine(:)
    integer :: k, last

    last = size(coarse)
    do k = 1, last
      fine(2*k - 1) = 0.75_dp*coarse(k) + 0.25_dp*coarse(max(k - 1, 1))
      if (2*k <= size(fine)) fine(2*k) = 0.75_dp*coarse(k) + 0.25_dp*coarse(min(k + 1, last))
    end do
  end subroutine interpolate

  !> Mean of the gaps over the cells of a coarser grid.
  pure subroutine shape_on_grid(shape, width, cells, coarse, info)
    real(dp), intent(in) :: shape(:)
    integer, intent(in) :: width, cells
    real(dp), allocatable, intent(out) :: coarse(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, last, k, stat

    allocate (coarse(cells), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps on '//text(cells)//' cells')
      return
    end if
    do k = 1, cells
      first = (k - 1)*width + 1
      last = min(k*width, size(shape))
      coarse(k) = sum(shape(first:last))/real(last - first + 1, dp)
    end do
  end subroutine shape_on_grid

  !> The contact set of one grid and its forces, from forces to start with.
  !>
  !> Errors: those of the operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY,
  !> FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CANCELLED.
  subroutine find_contact(operator, context, grid, shape, monitor, state, info)
    class(fuge_operator), intent(in) :: operator
    type(solve_context), intent(inout) :: context
    integer, intent(in) :: grid
    real(dp), intent(in) :: shape(:)
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    type(contact_filter) :: filter
    logical, allocatable :: pulls(:), penetrates(:)
    real(dp) :: before
    integer :: wrong, fewest, patience_left, stat
    logical :: thorough

    allocate (pulls(size(shape)), penetrates(size(shape)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the contact set of '//text(size(shape))//' points')
      return
    end if
    fewest = huge(fewest)
    patience_left = PATIENCE
    before = huge(before)
    thorough = .false.
    state%contact = state%force > 0.0_dp
    call push(operator, state, info)
    do while (.not. info%failed())
      call settle(operator, context, grid, filter, shape, thorough, monitor, state, info)
      if (info%failed()) exit
      pulls = state%contact .and. state%force < 0.0_dp
      penetrates = .not. state%contact .and. open_gap(shape, state%displacement, state%motion) < -MARGIN*state%target
      wrong = count(pulls) + count(penetrates)
      if (wrong == 0) then
        ! A start for a finer grid is good enough when its set is.
        if (grid > 0) exit
        if (thorough .or. state%residual <= state%target) then
          ! Displacements by recurrence have drifted.
          call push(operator, state, info)
          if (info%failed()) exit
          call measure(shape, state, info)
          if (info%failed()) exit
          if (state%residual <= state%target .or. .not. state%residual < 0.5_dp*before) exit
          before = state%residual
        end if
        thorough = .true.
        cycle
      end if
      thorough = .false.
      patience_left = patience_left - 1
      if (wrong < fewest) patience_left = PATIENCE
      fewest = min(fewest, wrong)
      if (patience_left < 0) then
        call descend(operator, context, grid, filter, shape, monitor, state, info)
        exit
      else if (2*patience_left > PATIENCE .and. size(context%family%coarse) > 0) then
        call exchange_in_row(pulls, penetrates, state%contact)
      else
        call exchange(pulls, penetrates, state%contact)
      end if
      call push(operator, state, info)
    end do
    context%coarse_filters = context%coarse_filters + filter%coarse_share*real(size(shape), dp)/real(context%points, dp)
  end subroutine find_contact

  !> Solve for the forces of the present set; one more iteration.
  subroutine settle(operator, context, grid, filter, shape, thorough, monitor, state, info)
    class(fuge_operator), intent(in) :: operator
    type(solve_context), intent(in) :: context
    integer, intent(in) :: grid
    type(contact_filter), intent(inout) :: filter
    real(dp), intent(in) :: shape(:)
    logical, intent(in) :: thorough
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    integer :: status

    if (info%iterations >= context%limit) then
      call report(info, FUGE_ERR_ITERATION_LIMIT, text(context%limit)//' contact sets were not enough: raise ' &
                  //'max_iterations (0 allows '//text(SETS_PER_POINT)//' for each point)')
      return
    end if
    call filter%set(operator, context%family, grid, state%contact, maxval(abs(state%displacement)), info)
    if (info%failed()) return
    call relax(operator, context%family, grid, filter, shape, MARGIN*context%tolerance, thorough, state, info)
    if (info%failed()) return
    info%iterations = info%iterations + 1
    call tell_monitor(monitor, info%iterations, state%residual*(MARGIN*context%tolerance/state%target), &
                      count(state%contact), status)
    if (status /= FUGE_DONE) call report(info, FUGE_ERR_CANCELLED, 'cancelled by the progress callback after ' &
                                         //text(info%iterations)//' contact sets')
  end subroutine settle

  !> Forces of the contact set that only push and sum to one, and their displacements.
  subroutine push(operator, state, info)
    class(fuge_operator), intent(in) :: operator
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp) :: total

    where (state%contact)
      state%force = max(state%force, 0.0_dp)
    else where
      state%force = 0.0_dp
    end where
    total = sum(state%force)
    if (total > 0.0_dp) then
      state%force = state%force/total
    else
      where (state%contact) state%force = 1.0_dp/real(count(state%contact), dp)
    end if
    call multiply(operator, state%force, state%displacement, info)
  end subroutine push

  !> Down the energy: from pushing forces towards the answer of their set as far as no
  !> force pulls, then the point with the most negative gap joins, until none has one.
  subroutine descend(operator, context, grid, filter, shape, monitor, state, info)
    class(fuge_operator), intent(in) :: operator
    type(solve_context), intent(inout) :: context
    integer, intent(in) :: grid
    type(contact_filter), intent(inout) :: filter
    real(dp), intent(in) :: shape(:)
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: reached(:)
    logical, allocatable :: barred(:), tied(:)
    integer, allocatable :: side(:)
    integer :: newest, n, stat

    n = size(shape)
    allocate (reached(n), barred(n), tied(n), side(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the way down the energy of '//text(n)//' points')
      return
    end if
    barred = .false.
    tied = .false.
    newest = 0
    call push(operator, state, info)
    state%contact = state%force > 0.0_dp
    do while (.not. info%failed())
      reached = state%force
      call settle(operator, context, grid, filter, shape, .true., monitor, state, info)
      if (info%failed()) exit
      if (any(state%contact .and. state%force <= 0.0_dp)) then
        side = merge(1, 0, state%contact)
        call step_back(state%force, tied, side, reached, newest, barred)
        state%contact = side /= 0
        state%force = reached
      else
        if (newest > 0) barred = barred .and. barred(newest)
        newest = worst_gap(shape, state, barred)
        if (newest == 0) exit
        state%contact(newest) = .true.
      end if
      call push(operator, state, info)
    end do
    if (.not. info%failed()) call push(operator, state, info)
    if (.not. info%failed()) call measure(shape, state, info)
  end subroutine descend

  !> The point that penetrates most, of those not barred; 0 if there is none.
  pure function worst_gap(shape, state, barred) result(worst)
    real(dp), intent(in) :: shape(:)
    type(iterate), intent(in) :: state
    logical, intent(in) :: barred(:)
    integer :: worst
    real(dp) :: gap, deepest
    integer :: k

    worst = 0
    deepest = -MARGIN*state%target
    do k = 1, size(shape)
      if (state%contact(k) .or. barred(k)) cycle
      gap = open_gap(shape(k), state%displacement(k), state%motion)
      if (gap >= deepest) cycle
      worst = k
      deepest = gap
    end do
  end function worst_gap

end module fuge_iterative_engine
