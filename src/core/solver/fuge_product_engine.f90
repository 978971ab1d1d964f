!> The engine that needs products of an operator alone, the iteration, from the last solutions on.
module fuge_product_engine
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_contact_engine, only: contact_engine
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_history_type, only: fuge_history
  use fuge_iterated_set, only: iterated_set
  use fuge_iterative_engine, only: is_general, solve_by_iteration
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: check_load, fuge_problem, fuge_solution, move_solution, set_problem
  use fuge_point_space, only: point_space
  use fuge_scaled_springs, only: scaled_springs
  use fuge_set_derivative, only: find_derivative_by_products
  use fuge_spring_matrix, only: balance_springs, extend_problem, name_springs, scale_force_error, strip_solution
  use fuge_spring_monitor, only: spring_monitor
  use fuge_spring_operator, only: spring_operator
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_ERR_CALLBACK, &
    FUGE_ERR_CANCELLED, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_UNSUPPORTED
  use fuge_unresisted_motions, only: report_unresisted_motion
  use fuge_warm_start, only: load_history
  implicit none
  private

  !> A motion on a spring is free from this excess of `excess_motions` on.
  real(dp), parameter :: MUCH_FARTHER = 1.0e3_dp
  real(dp), parameter :: LARGEST_EXCESS = 1.0e300_dp
  !> The tolerance on springs, of that of the solve over the excess; and none is stricter.
  real(dp), parameter :: SAFETY = 0.1_dp
  real(dp), parameter :: STRICTEST = 1.0e-13_dp
  !> The farthest that points get, over the range of their gaps, as a guess.
  real(dp), parameter :: USUAL_SHARE = 0.25_dp
  !> A solve whose tolerance is at most this multiple of the one that springs need is not done again.
  real(dp), parameter :: ENOUGH = 10.0_dp
  !> Solves of one problem with springs on motions.
  integer, parameter :: PASSES = 8

  type, extends(contact_engine), public :: product_engine
    private
    !> The last problem, where its canonical form is needed.
    type(canonical_problem) :: canonical
    !> The last solutions.
    type(load_history) :: steps
    type(iterated_set) :: last
    !> The springs of the last problem; not allocated: none. And the stiffness of those too soft for the operator, (m),
    !> zero where it has the spring.
    type(spring_operator), allocatable :: springs
    real(dp), allocatable :: soft(:)
    !> Their units in the last problem, and the points that springs on motions were; not allocated on a grid, where
    !> `springs` has them all.
    type(scaled_springs), allocatable :: scaled
    !> The last problem needed its canonical form; otherwise, whether its approach was prescribed.
    logical :: is_general = .false., is_prescribed = .false.
    !> The solution joins the last ones once it is certified, whose certificate needs memory too.
    logical :: keeps_later = .false.
  contains
    procedure :: solve
    procedure :: keep
    procedure :: was_misled
    procedure :: distrust_start => forget_start
    procedure :: forget_start
    procedure :: last_points
    procedure :: last_modes
    procedure :: derivative
    procedure :: has_found
  end type product_engine

contains

  !> As for `contact_engine`: from the last solutions if they promise a better start than coarser grids; from scratch if
  !> they lead nowhere. FUGE_ERR_UNSUPPORTED if a history is asked for.
  subroutine solve(self, operator, problem, options, monitor, history, solution, info)
    class(product_engine), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: cells(2)

    history = fuge_history()
    if (options%keep_history) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'only the tableau keeps a history, and it needs a dense operator: ' &
                  //'leave keep_history out')
      return
    end if
    if (allocated(self%springs)) deallocate (self%springs)
    if (allocated(self%scaled)) deallocate (self%scaled)
    cells = operator%grid()
    space = operator%ranks()
    self%keeps_later = .not. problem%has_springs()
    if (problem%has_springs() .and. space%is_alone() .and. .not. all(cells > 0)) then
      call solve_scaled(self, operator, problem, options, monitor, solution, info)
    else if (problem%has_springs()) then
      call solve_on_springs(self, operator, problem, options, monitor, solution, info)
    else
      call solve_by_products(self, operator, problem, options, monitor, solution, info)
    end if
  end subroutine solve

  !> With springs, in units of their own, and with a point more for each one on a motion. Not on a grid, where all
  !> points have to be alike, nor where ranks share the points. Whether there is equilibrium, and what is not unique,
  !> are questions in the units of the problem.
  subroutine solve_scaled(self, operator, problem, options, monitor, solution, info)
    class(product_engine), intent(inout) :: self
    class(fuge_operator), intent(in), target :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout), target :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    ! Not those of the engine, which changes while it solves.
    type(spring_operator), allocatable, target :: springs
    type(scaled_springs), allocatable :: scaled
    type(spring_monitor) :: relay
    type(canonical_problem) :: canonical
    type(fuge_problem) :: extended, similar
    real(dp), allocatable :: balance(:)
    real(dp) :: largest
    logical :: on_spring(problem%mode_count()), possible
    integer :: stat

    allocate (springs, scaled, stat=stat)
    call require_memory(stat, 'springs', info)
    if (stat /= 0) return
    on_spring = .false.
    call springs%set_springs(problem, on_spring, operator%ranks(), info)
    if (.not. info%failed()) call extend_problem(problem, extended, info)
    if (.not. info%failed()) call make_canonical(extended, canonical, info)
    if (.not. info%failed()) call scaled%set(operator, problem, extended, possible, info)
    if (info%failed()) return
    if (.not. possible) then
      call solve_on_springs(self, operator, problem, options, monitor, solution, info)
      return
    end if
    call scaled%scale_problem(extended, similar, info)
    if (info%failed()) return
    call springs%attach(operator)
    call scaled%attach(springs)
    if (allocated(canonical%feasible_force)) &
      allocate (balance, source=scaled%scale_forces(canonical%feasible_force), stat=stat)
    call require_memory(stat, 'forces in equilibrium', info)
    if (stat /= 0) return
    relay%listener => monitor
    relay%springs = scaled%spring_points()
    call solve_by_products(self, scaled, similar, options, relay, solution, info, balance)
    call name_springs(problem, info)
    if (info%failed()) return
    call scaled%drop_rounding(similar, solution, largest)
    call scaled%restore(solution)
    call balance_springs(problem, extended, solution%force, solution%motion)
    call warn_of_unresisted_motion(canonical, solution, info)
    call strip_solution(problem%points(), solution, info)
    if (info%failed()) return
    if (.not. largest > 0.0_dp) info%force_error = 0.0_dp
    call scale_force_error(largest, solution%force, info%force_error)
    ! Motions on springs are found to the tolerance, and forces with them.
    if (relay%springs > 0) info%force_error = max(info%force_error, options%tolerance)
    call springs%detach()
    call scaled%detach()
    call move_alloc(springs, self%springs)
    call move_alloc(scaled, self%scaled)
  end subroutine solve_scaled

  !> Warn of a motion that the contact of `solution` does not resist, unless there is a warning already. Error:
  !> FUGE_ERR_MEMORY.
  subroutine warn_of_unresisted_motion(canonical, solution, info)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_solution) :: reduced

    if (info%status /= FUGE_DONE) return
    call allocate_solution(size(solution%force), size(canonical%load), reduced, info)
    if (info%failed()) return
    reduced%force = solution%force
    reduced%gap = solution%gap
    reduced%state = solution%state
    call report_unresisted_motion(canonical, reduced, info)
  end subroutine warn_of_unresisted_motion

  !> With springs, as parts of the operator. A motion on a spring so soft that the resultant would move it much farther
  !> than it gets is free instead, under the resultant less what its spring takes: a few solves find that, each with an
  !> error that is smaller by the same factor. Springs that are too soft for the first solve are left out of the next.
  subroutine solve_on_springs(self, operator, problem, options, monitor, solution, info)
    class(product_engine), intent(inout) :: self
    class(fuge_operator), intent(in), target :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    ! Not that of the engine, which changes while it solves.
    type(spring_operator), allocatable :: springs
    type(fuge_options) :: stricter
    logical, dimension(problem%mode_count()) :: attached, on_spring, too_soft
    real(dp), dimension(problem%mode_count()) :: carried, excess, load
    real(dp) :: farthest, guess, usual
    type(point_space) :: space
    integer :: pass, stat

    space = operator%ranks()
    allocate (springs, stat=stat)
    call require_memory(stat, 'springs', info)
    call space%agree(info)
    if (info%failed()) return
    stricter = options
    on_spring = problem%motions_on_springs()
    attached = on_spring
    load = problem%resultants()
    ! The first solve is exact enough already, where it is seen how far springs give way.
    usual = USUAL_SHARE*gap_range(problem, space)
    farthest = maxval(distances_alone(problem, space))
    if (usual > 0.0_dp .and. farthest > usual) then
      guess = MUCH_FARTHER
      if (farthest/MUCH_FARTHER < usual) guess = farthest/usual
      stricter%tolerance = tolerance_on_springs(options%tolerance, guess)
    end if
    do pass = 1, PASSES
      attached = on_spring
      call springs%set_springs(problem, attached, space, info)
      if (.not. info%failed()) then
        call springs%attach(operator)
        call solve_attached(self, springs, problem, load, stricter, monitor, solution, info)
      end if
      if (any(info%status == [FUGE_ERR_CANCELLED, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY])) exit
      if (info%failed() .and. pass == 1) then
        too_soft = is_beyond(problem, space)
        if (.not. any(too_soft)) exit
        call report(info, FUGE_DONE, '')
        on_spring = on_spring .and. .not. too_soft
        cycle
      else if (info%failed()) then
        ! Contact may not carry what the springs seem to leave to it.
        call report(info, FUGE_DONE, '')
        attached = problem%motions_on_springs()
        load = problem%resultants()
        call springs%set_springs(problem, attached, space, info)
        if (info%failed()) exit
        call springs%attach(operator)
        call solve_attached(self, springs, problem, load, options, monitor, solution, info)
        if (info%status == FUGE_ERR_OVERFLOW) call report(info, FUGE_ERR_OVERFLOW, 'motion_stiffness reaches down to ' &
          //text(minval(problem%motion_stiffness, mask=attached))//', and contact cannot carry the load instead of ' &
          //'the spring: choose units in which it is larger, or a dense operator and FUGE_ACTIVE_SET')
        exit
      end if
      excess = merge(excess_motions(problem, space, solution), 0.0_dp, on_spring)
      carried = merge(load, problem%resultants() - problem%spring_loads(solution%motion), on_spring)
      if (.not. any(excess > MUCH_FARTHER .or. abs(carried - load) > options%tolerance*abs(problem%resultants()))) then
        if (.not. any(excess > 1.0_dp)) exit
        if (stricter%tolerance <= ENOUGH*tolerance_on_springs(options%tolerance, maxval(excess))) exit
        stricter%tolerance = tolerance_on_springs(options%tolerance, maxval(excess))
      end if
      load = merge(problem%resultants() - problem%spring_loads(solution%motion), carried, excess > MUCH_FARTHER)
      on_spring = on_spring .and. .not. excess > MUCH_FARTHER
    end do
    ! Motions on springs are found to the tolerance, and forces with them.
    if (any(problem%motions_on_springs())) info%force_error = max(info%force_error, options%tolerance)
    call springs%detach()
    call move_alloc(springs, self%springs)
    self%soft = problem%stiffnesses()
    where (attached) self%soft = 0.0_dp
  end subroutine solve_on_springs

  !> The tolerance of a solve where springs would give way farther by `excess` than any point gets: their equations have
  !> larger terms than the certificate will see.
  pure function tolerance_on_springs(tolerance, excess) result(stricter)
    real(dp), intent(in) :: tolerance, excess
    real(dp) :: stricter

    stricter = min(max(SAFETY*tolerance/excess, STRICTEST), 0.5_dp*tolerance)
  end function tolerance_on_springs

  !> The difference of the largest gap and the least one.
  function gap_range(problem, space) result(range)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp) :: range

    range = space%largest(maxval(problem%gap)) - space%least(minval(problem%gap))
  end function gap_range

  !> Solve on `springs`, with the resultants `load` (m).
  subroutine solve_attached(self, springs, problem, load, options, monitor, solution, info)
    class(product_engine), intent(inout) :: self
    type(spring_operator), intent(in) :: springs
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: load(:)
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: fixed

    call springs%fix_motions(problem, load, fixed, info)
    ! Contact cannot pull where a soft spring was to do it.
    if (.not. info%failed() .and. fixed%has_one_load()) call check_load(fixed%resultant(1), info)
    if (info%failed()) return
    call solve_by_products(self, springs, fixed, options, monitor, solution, info)
    if (.not. info%failed()) call springs%find_motions(load, solution%force, solution%motion)
  end subroutine solve_attached

  !> Would the resultant move this motion so far on its spring alone that the gaps are lost in the rounding, (m)?
  function is_beyond(problem, space) result(beyond)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    logical :: beyond(problem%mode_count())
    real(dp) :: alone(problem%mode_count()), widest

    alone = distances_alone(problem, space)
    widest = space%largest(maxval(abs(problem%gap)))
    beyond = alone > widest/epsilon(widest)
  end function is_beyond

  !> How far the resultant would move the point that each motion moves most on its spring alone, (m), length; 0 without
  !> a spring.
  function distances_alone(problem, space) result(alone)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp) :: alone(problem%mode_count())
    real(dp) :: arm(problem%mode_count())
    logical :: on_spring(problem%mode_count())
    integer :: j

    on_spring = problem%motions_on_springs()
    arm = problem%arms()
    call space%raise(arm)
    alone = 0.0_dp
    do j = 1, size(alone)
      if (.not. on_spring(j)) cycle
      associate (most => LARGEST_EXCESS/max(arm(j), 1.0_dp), load => abs(problem%resultant(j)), &
                 stiffness => problem%motion_stiffness(j))
        ! The quotient could overflow.
        if (stiffness >= 1.0_dp) then
          alone(j) = min(load/stiffness, most)
        else if (load < most*stiffness) then
          alone(j) = load/stiffness
        else
          alone(j) = most
        end if
        alone(j) = min(arm(j), LARGEST_EXCESS)*alone(j)
      end associate
    end do
  end function distances_alone

  !> How many times farther than any point gets the resultant would move each motion on its spring alone, (m).
  function excess_motions(problem, space, solution) result(excess)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    type(fuge_solution), intent(in) :: solution
    real(dp) :: excess(size(solution%motion))
    real(dp), dimension(size(solution%motion)) :: alone, arm
    real(dp) :: farthest

    alone = distances_alone(problem, space)
    arm = problem%arms()
    call space%raise(arm)
    farthest = max(space%largest(maxval(abs(solution%gap - problem%gap))), maxval(arm*abs(solution%motion)))
    excess = 0.0_dp
    where (alone > farthest) excess = min(alone/max(farthest, tiny(farthest)), LARGEST_EXCESS)
  end function excess_motions

  !> `balance` (n), if given, are forces in equilibrium, which otherwise are looked for.
  subroutine solve_by_products(self, operator, problem, options, monitor, solution, info, balance)
    class(product_engine), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), optional :: balance(:)
    type(point_space) :: space

    self%is_general = is_general(problem)
    self%is_prescribed = .not. (self%is_general .or. problem%has_one_load())
    ! An absent array is not passed on: gfortran computes with its bounds, which are anything.
    if (self%is_general .and. present(balance)) then
      call make_canonical(problem, self%canonical, info, operator%ranks(), balance)
    else if (self%is_general) then
      call make_canonical(problem, self%canonical, info, operator%ranks())
    end if
    if (info%failed()) return
    call solve_by_iteration(operator, problem, self%canonical, options, monitor, self%steps, self%last, solution, info)
    ! Do not retry a solve that the operator or the monitor has ended.
    if (self%steps%started_warm &
        .and. any(info%status == [FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW])) then
      ! Status and message only: the counts go on.
      call report(info, FUGE_DONE, '')
      call self%steps%forget()
      call solve_by_iteration(operator, problem, self%canonical, options, monitor, self%steps, self%last, solution, &
                              info)
    end if
    if (.not. info%failed()) call give_states(self%last, solution, info)
    space = operator%ranks()
    call space%agree(info)
    if (.not. (self%keeps_later .or. info%failed())) call self%steps%store(problem, space, solution)
  end subroutine solve_by_products

  !> As for `contact_engine`: in the last solutions, which on springs have it already.
  subroutine keep(self, operator, problem, solution)
    class(product_engine), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution

    if (self%keeps_later) call self%steps%store(problem, operator%ranks(), solution)
  end subroutine keep

  !> A copy of the states for the caller, because derivatives need them too. Error: FUGE_ERR_MEMORY.
  subroutine give_states(set, solution, info)
    type(iterated_set), intent(in) :: set
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (allocated(solution%state)) deallocate (solution%state)
    allocate (solution%state(size(set%state)), stat=stat)
    call require_memory(stat, 'the states of', size(set%state), 'points', info)
    if (stat == 0) solution%state = set%state
  end subroutine give_states

  !> The start may have been so large that it left its rounding behind.
  pure function was_misled(self, status)
    class(product_engine), intent(in) :: self
    integer, intent(in) :: status
    logical :: was_misled

    was_misled = self%steps%started_warm .and. status == FUGE_WARN_RESIDUAL
  end function was_misled

  subroutine forget_start(self)
    class(product_engine), intent(inout) :: self

    call self%steps%forget()
  end subroutine forget_start

  pure function last_points(self) result(number)
    class(product_engine), intent(in) :: self
    integer :: number

    number = 0
    if (allocated(self%last%state)) number = size(self%last%state)
    if (allocated(self%scaled)) number = number - self%scaled%spring_points()
  end function last_points

  pure function last_modes(self) result(number)
    class(product_engine), intent(in) :: self
    integer :: number

    number = 1
    if (self%is_general) number = self%canonical%mode_count()
  end function last_modes

  !> By products on the contact set. Errors: those of `find_derivative_by_products`.
  subroutine derivative(self, operator, gap_change, load_change, change, info, wanted)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: wanted(:)

    if (allocated(self%scaled)) then
      call derivative_scaled(self, operator, gap_change, load_change, change, info)
    else if (allocated(self%springs)) then
      call derivative_on_springs(self, operator, gap_change, load_change, change, info)
    else
      call differentiate(self, operator, gap_change, load_change, change, info)
    end if
    ! The last product has all gaps.
    if (present(wanted) .and. .not. info%failed()) where (.not. wanted) change%gap = 0.0_dp
  end subroutine derivative

  pure function has_found(self, state) result(same)
    class(product_engine), intent(in) :: self
    integer, intent(in) :: state(:)
    logical :: same

    same = self%last_points() == size(state)
    if (same) same = all(int(self%last%state(:size(state))) == state)
  end function has_found

  !> With springs, in units of their own.
  subroutine derivative_scaled(self, operator, gap_change, load_change, change, info)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in), target :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(spring_operator), allocatable, target :: springs
    type(scaled_springs), allocatable :: scaled
    integer :: stat

    allocate (springs, source=self%springs, stat=stat)
    if (stat == 0) allocate (scaled, source=self%scaled, stat=stat)
    call require_memory(stat, 'the springs of', size(gap_change), 'points', info)
    if (stat /= 0) return
    call springs%attach(operator)
    call scaled%attach(springs)
    call differentiate(self, scaled, scaled%scale_changes(gap_change), load_change, change, info)
    if (info%failed()) return
    call scaled%restore(change)
    call strip_solution(size(gap_change), change, info)
  end subroutine derivative_scaled

  !> With springs, as parts of the operator.
  subroutine derivative_on_springs(self, operator, gap_change, load_change, change, info)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in), target :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(spring_operator), allocatable :: springs
    real(dp), dimension(size(load_change)) :: carried, corrected, fixed_change
    type(fuge_solution) :: found
    type(point_space) :: space
    integer :: pass, stat

    allocate (springs, source=self%springs, stat=stat)
    call require_memory(stat, 'the springs of', size(gap_change), 'points', info)
    space = operator%ranks()
    call space%agree(info)
    if (info%failed()) return
    call springs%attach(operator)
    carried = load_change
    do pass = 1, PASSES
      fixed_change = carried
      call springs%prescribe_motions(fixed_change)
      call differentiate(self, springs, gap_change, fixed_change, found, info)
      if (info%failed()) return
      call springs%find_motions(carried, found%force, found%motion)
      corrected = load_change - self%soft*found%motion
      if (all(abs(corrected - carried) <= self%last%tolerance*max(abs(corrected), abs(load_change)))) exit
      if (pass == PASSES) then
        call report(info, FUGE_ERR_ITERATION_LIMIT, 'derivatives: motions on soft springs do not settle in ' &
                    //text(PASSES)//' solves: use a dense operator and FUGE_ACTIVE_SET')
        return
      end if
      carried = corrected
    end do
    call move_solution(found, change)
  end subroutine derivative_on_springs

  !> Without springs. No canonical form is kept of problems with one translation.
  subroutine differentiate(self, operator, gap_change, load_change, change, info)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(canonical_problem) :: canonical
    type(fuge_problem) :: problem
    type(point_space) :: space

    if (self%is_general) then
      call find_derivative_by_products(operator, self%canonical, int(self%last%state), self%last%tolerance, &
                                       gap_change, load_change, change, info)
      return
    end if
    call set_problem(0.0_dp*gap_change, 1.0_dp, problem, info)
    space = operator%ranks()
    call space%agree(info)
    if (info%failed()) return
    problem%prescribed = [self%is_prescribed]
    problem%motion = [0.0_dp]
    call make_canonical(problem, canonical, info, operator%ranks())
    if (.not. info%failed()) call find_derivative_by_products(operator, canonical, int(self%last%state), &
                                                              self%last%tolerance, gap_change, load_change, change, &
                                                              info)
  end subroutine differentiate

end module fuge_product_engine
