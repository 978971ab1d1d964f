!> The solve of `fuge_solver`. What engines are made of is known here and not where the type is: neither a compiler nor
!> a reader of the type has to go through it.
submodule(fuge_solver_type) fuge_solve_procedure
  use fuge_certified_solution, only: certify
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_dense_engine, only: dense_engine
  use fuge_engine_choice, only: takes_products
  use fuge_force_level, only: explain_by_force_level, judge_force_level
  use fuge_monitor_type, only: monitor_relay
  use fuge_options_type, only: check_options
  use fuge_own_springs, only: settle_own_springs
  use fuge_problem_bounds, only: begins_with_one
  use fuge_problem_type, only: check_problem, copy_problem, move_solution
  use fuge_product_engine, only: product_engine
  use fuge_settled_motions, only: settle_motions
  use fuge_shared_problem, only: check_shared_problem
  use fuge_status, only: require_memory, FUGE_ERR_CANCELLED
  use fuge_threads, only: thread_team, usable_threads
  implicit none

contains

  module procedure solve
    type(fuge_options) :: chosen
    type(fuge_problem) :: copy
    type(monitor_relay) :: relay
    type(point_space) :: space
    logical :: usual

    if (present(options)) chosen = options
    if (present(monitor)) relay%listener => monitor
    self%history = fuge_history()
    self%has_solution = .false.
    self%last_report = fuge_info()
    space = operator%ranks()
    usual = begins_with_one(problem)
    call check_options(chosen, info)
    if (.not. (usual .or. info%failed())) call copy_problem(problem, copy, info)
    call space%agree(info)
    if (info%failed()) return
    if (usual) then
      call solve_from_one(self, operator, problem, chosen, space, relay, solution, info)
    else
      call solve_from_one(self, operator, copy, chosen, space, relay, solution, info)
    end if
  end procedure solve

  !> Solve a problem whose arrays begin with 1, with options that hold.
  subroutine solve_from_one(self, operator, problem, chosen, space, relay, solution, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: chosen
    type(point_space), intent(in) :: space
    type(monitor_relay), intent(inout) :: relay
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(fuge_solution) :: candidate
    type(thread_team) :: team

    if (space%total_count(operator%points()) < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before the solve')
      return
    end if
    call check_problem(problem, operator%points(), info)
    call space%agree(info)
    if (.not. (space%is_alone() .or. info%failed())) call check_shared_problem(problem, chosen, space, info)
    if (info%failed()) return

    self%threads = chosen%threads
    if (self%threads == 0) self%threads = usable_threads()
    call team%begin(self%threads)
    if (is_unloaded(problem)) then
      call solve_without_load(problem, space, candidate, info)
      if (.not. info%failed()) call certify(operator, problem, candidate, chosen%tolerance, info)
    else
      self%solved_by_products = takes_products(operator, chosen)
      if (self%solved_by_products) then
        call require_product_engine(self%by_products, space, info)
        if (.not. info%failed()) call solve_again_if_misled(self%by_products, operator, problem, chosen, relay, &
                                                            self%history, candidate, info)
      else
        call require_matrix_engine(self%by_matrix, info)
        if (.not. info%failed()) call solve_again_if_misled(self%by_matrix, operator, problem, chosen, relay, &
                                                            self%history, candidate, info)
      end if
      if (info%status == FUGE_ERR_CANCELLED) call report(info, FUGE_ERR_CANCELLED, 'cancelled at iteration ' &
                                                         //text(relay%reported)//' by the progress monitor')
      self%has_solution = .not. info%failed()
    end if
    call team%end()
    if (info%failed()) then
      ! A factor from which no accepted solution came is no start for the next solve.
      if (allocated(self%by_matrix)) call self%by_matrix%distrust_start()
    else
      self%last_report = info
      if (allocated(self%by_matrix) .and. .not. self%solved_by_products) call self%by_matrix%take_arrays(solution)
      call move_solution(candidate, solution)
    end if
  end subroutine solve_from_one

  !> Allocate the engine for matrices unless it is already. Error: FUGE_ERR_MEMORY.
  subroutine require_matrix_engine(engine, info)
    class(matrix_engine), intent(inout), allocatable :: engine
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 0
    if (.not. allocated(engine)) allocate (dense_engine :: engine, stat=stat)
    call require_memory(stat, 'the engine', info)
  end subroutine require_matrix_engine

  !> Allocate the engine for products unless it is already, on all ranks or on none. Error: FUGE_ERR_MEMORY.
  subroutine require_product_engine(engine, space, info)
    class(contact_engine), intent(inout), allocatable :: engine
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 0
    if (.not. allocated(engine)) allocate (product_engine :: engine, stat=stat)
    call require_memory(stat, 'the iteration', info)
    call space%agree(info)
  end subroutine require_product_engine

  !> Solve, and once more if what the engine has kept of an earlier solve has misled it. What the other engine keeps
  !> has no share in that, and stays.
  subroutine solve_again_if_misled(engine, operator, problem, options, monitor, history, solution, info)
    class(contact_engine), intent(inout) :: engine
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    call solve_and_certify(engine, operator, problem, options, monitor, history, solution, info)
    if (.not. engine%was_misled(info%status)) return
    call engine%distrust_start()
    solution = fuge_solution()
    info = fuge_info()
    call solve_and_certify(engine, operator, problem, options, monitor, history, solution, info)
  end subroutine solve_again_if_misled

  !> One solve by the `engine`, and its certificate.
  subroutine solve_and_certify(engine, operator, problem, options, monitor, history, solution, info)
    class(contact_engine), intent(inout) :: engine
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    call engine%solve(operator, problem, options, monitor, history, solution, info)
    if (.not. info%failed()) then
      call judge_force_level(operator, problem, solution, options%tolerance, info)
      if (info%failed()) call engine%forget_start()
    else if (.not. problem%has_law()) then
      call explain_by_force_level(operator, problem, options%tolerance, info)
    end if
    if (.not. info%failed()) call settle_own_springs(operator, problem, solution)
    if (.not. info%failed()) call settle_motions(operator, problem, solution, info)
    if (.not. info%failed()) call certify(operator, problem, solution, options%tolerance, info)
    if (.not. info%failed()) call engine%keep(operator, problem, solution)
  end subroutine solve_and_certify

  !> One translation without a load, which has no unique approach.
  pure function is_unloaded(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: is_unloaded

    is_unloaded = problem%has_one_load()
    if (is_unloaded) is_unloaded = .not. problem%resultant(1) > 0.0_dp
  end function is_unloaded

  !> The limit of a vanishing load: the bodies just touch at the smallest gap.
  subroutine solve_without_load(problem, space, solution, info)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%force(problem%points()), solution%gap(problem%points()), solution%motion(1), &
              solution%state(problem%points()), stat=stat)
    call require_memory(stat, 'the forces and gaps of', problem%points(), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    solution%force = 0.0_dp
    solution%motion = space%least(minval(problem%gap))
    solution%gap = problem%gap - solution%motion(1)
    solution%state = FUGE_OPEN
  end subroutine solve_without_load

end submodule fuge_solve_procedure
