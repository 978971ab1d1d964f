!> The engine that needs products of an operator alone, the iteration, from the last solutions on.
module fuge_product_engine
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_contact_engine, only: contact_engine
  use fuge_force_level, only: judge_force_level
  use fuge_history_type, only: fuge_history
  use fuge_iterated_set, only: iterated_set
  use fuge_iterative_engine, only: is_general, solve_by_iteration
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution, set_problem
  use fuge_point_space, only: point_space
  use fuge_set_derivative, only: find_derivative_by_products
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_ERR_ITERATION_LIMIT, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_UNSUPPORTED
  use fuge_warm_start, only: load_history
  implicit none
  private

  type, extends(contact_engine), public :: product_engine
    private
    !> The last solutions.
    type(load_history) :: steps
    type(iterated_set) :: last
    !> The last problem needed its canonical form; otherwise, whether its approach was prescribed.
    logical :: is_general = .false., is_prescribed = .false.
  contains
    procedure :: solve
    procedure :: judge
    procedure :: was_misled
    procedure :: distrust_start => forget_start
    procedure :: forget_start
    procedure :: last_points
    procedure :: last_modes
    procedure :: derivative
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

    history = fuge_history()
    if (options%keep_history) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'only the tableau keeps a history, and it needs a dense operator: ' &
                  //'leave keep_history out')
      return
    end if
    if (problem%has_springs()) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'the iteration knows no compliance and no springs on motions: use a ' &
                  //'dense operator and FUGE_ACTIVE_SET')
      return
    end if
    space = operator%ranks()
    if (problem%has_limits() .and. .not. space%is_alone()) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'ranks know no limits of forces: solve on one process')
      return
    end if
    self%is_general = is_general(problem)
    self%is_prescribed = .not. (self%is_general .or. problem%is_plain())
    if (self%is_general) call make_canonical(problem, self%canonical, info, operator%ranks())
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
  end subroutine solve

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

  !> As for `contact_engine`.
  subroutine judge(self, operator, problem, tolerance, info)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info

    ! Points that give way make the level of the forces unique.
    if (self%is_general .and. .not. problem%has_limits()) then
      call judge_force_level(operator, self%canonical, problem%gap, self%last%state, tolerance, info)
    end if
  end subroutine judge

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
  end function last_points

  pure function last_modes(self) result(number)
    class(product_engine), intent(in) :: self
    integer :: number

    number = 1
    if (self%is_general) number = self%canonical%mode_count()
  end function last_modes

  !> By products on the contact set. No canonical form is kept of problems with one translation. Errors: those of
  !> `find_derivative_by_products`.
  subroutine derivative(self, operator, gap_change, load_change, change, info)
    class(product_engine), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(canonical_problem) :: canonical
    type(fuge_problem) :: problem
    type(point_space) :: space

    if (self%is_general) then
      call find_derivative_by_products(operator, self%canonical, self%last%state, self%last%tolerance, gap_change, &
                                       load_change, change, info)
      return
    end if
    call set_problem(0.0_dp*gap_change, 1.0_dp, problem, info)
    space = operator%ranks()
    call space%agree(info)
    if (info%failed()) return
    problem%prescribed = [self%is_prescribed]
    problem%motion = [0.0_dp]
    call make_canonical(problem, canonical, info, operator%ranks())
    if (.not. info%failed()) call find_derivative_by_products(operator, canonical, self%last%state, &
                                                              self%last%tolerance, gap_change, load_change, change, &
                                                              info)
  end subroutine derivative

end module fuge_product_engine
