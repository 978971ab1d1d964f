!> From a problem to a certified solution: checks, choice of engine, certificate.
module fuge_solver_type
  use fuge_active_set_engine, only: solve_by_active_set
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_certificate, only: find_violation, fuge_violation
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_force_error, only: estimate_force_error
  use fuge_force_level, only: explain_by_force_level, judge_force_level
  use fuge_history_type, only: fuge_history
  use fuge_input_checks, only: check_finite
  use fuge_iterated_set, only: iterated_set
  use fuge_iterative_engine, only: is_general, solve_by_iteration
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_monitor_type, only: fuge_monitor, monitor_relay
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, check_options, FUGE_AUTO, FUGE_TABLEAU, FUGE_ITERATIVE
  use fuge_problem_type, only: fuge_problem, fuge_solution, check_problem, set_problem
  use fuge_ranks, only: shared_ranks
  use fuge_rim_contact, only: remark_contact_at_rim
  use fuge_sensitivity, only: find_derivative
  use fuge_set_derivative, only: find_derivative_by_products
  use fuge_shared_problem, only: check_shared_problem, differ
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED, FUGE_ERR_SIZE, &
    FUGE_ERR_MEMORY, FUGE_ERR_CALL_ORDER, FUGE_ERR_UNSUPPORTED, FUGE_ERR_CANCELLED, FUGE_ERR_ITERATION_LIMIT, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW
  use fuge_tableau_engine, only: solve_by_tableau
  use fuge_warm_start, only: load_history
  use fuge_working_set, only: working_set
  implicit none
  private

  public :: fuge_solve_dense

  !> Above this estimate of the relative error of the forces, a solution comes with a warning.
  real(dp), parameter :: MOST_FORCE_ERROR = 1.0e-3_dp

  !> Solves contact problems one after the other, each from the contact set of the last one. One solver for each
  !> thread.
  type, public :: fuge_solver
    !> Basis and z of each pivot of the last tableau solve, if it was asked for.
    type(fuge_history) :: history
    !> States of the last solve by a dense engine, where the next one starts, with their factor, and the problem.
    integer, allocatable, private :: state(:)
    !> The factor outlives a solve: the next one starts from it if the matrix is the same.
    type(kkt_factor), private :: factor
    type(canonical_problem), private :: canonical
    !> State, factor and problem belong to a solution that was accepted.
    logical, private :: has_solution = .false.
    !> The last solve started from a factor that it found.
    logical, private :: found_factor = .false.
    !> Arrays for the next solve, so that small problems do not spend their time on allocations.
    type(fuge_solution), private :: spare
    type(working_set), private :: set
    !> The last solutions of the iteration.
    type(load_history), private :: steps
    type(iterated_set), private :: last
    !> The last solve was by the iteration.
    logical, private :: solved_by_products = .false.
    !> The last problem of the iteration needed its canonical form; otherwise, whether its approach was prescribed.
    logical, private :: last_is_general = .false., last_is_prescribed = .false.
    !> The report of the last solution, for its derivatives.
    type(fuge_info), private :: last_report
  contains
    procedure :: solve
    procedure :: reset
    !> For a change of one load, or of each.
    generic :: derivative => derivative_by_load, derivative_by_loads
    procedure, private :: derivative_by_load
    procedure, private :: derivative_by_loads
  end type fuge_solver

contains

  !> Solve the contact problem (paper, equations 9 to 11) and certify the solution.
  !>
  !> `operator` displacements per force, `problem` gaps and load, `options` as in `fuge_options` (defaults when
  !> absent). `monitor` hears of each iteration and may cancel; without a load there are none. On return info%status
  !> is FUGE_DONE, with a message only if the contact reaches the rim of a free grid, or the first of these warnings
  !> that is true: FUGE_WARN_RESIDUAL with the residual in the message; FUGE_WARN_NOT_UNIQUE where alpha is singular on
  !> the points that touch, with or without force (the forces are then one of many possible), or the contact does not
  !> resist a mode (its motion is then one of many possible), or both; FUGE_WARN_ILL_CONDITIONED if info%force_error, the estimated
  !> error of the forces, is above 1e-3. Or it is an error that leaves `solution` untouched:
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_NOT_DEFINITE,
  !> FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, FUGE_ERR_CALLBACK,
  !> FUGE_ERR_CANCELLED. The next solve is possible after any of them.
  subroutine solve(self, operator, problem, solution, info, options, monitor)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    class(fuge_monitor), intent(inout), optional, target :: monitor
    type(fuge_options) :: chosen
    type(fuge_solution) :: candidate
    type(monitor_relay) :: relay
    type(shared_ranks) :: ranks

    if (present(options)) chosen = options
    if (present(monitor)) relay%listener => monitor
    self%history = fuge_history()
    self%has_solution = .false.
    self%last_report = fuge_info()
    ranks = operator%ranks()
    call check_options(chosen, info)
    call ranks%agree(info)
    if (info%failed()) return
    if (ranks%total_count(operator%points()) < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before the solve')
      return
    end if
    call check_problem(problem, operator%points(), info)
    call ranks%agree(info)
    if (.not. (ranks%is_alone() .or. info%failed())) call check_shared_problem(problem, chosen, ranks, info)
    if (info%failed()) return

    if (is_unloaded(problem)) then
      call solve_without_load(problem, ranks, candidate, info)
      if (.not. info%failed()) call certify(operator, problem, candidate, chosen%tolerance, info)
    else
      call solve_and_certify(self, operator, problem, chosen, relay, candidate, info)
      if (is_misled(self, info%status)) then
        self%factor = kkt_factor()
        call self%steps%forget()
        candidate = fuge_solution()
        info = fuge_info()
        call solve_and_certify(self, operator, problem, chosen, relay, candidate, info)
      end if
      if (info%status == FUGE_ERR_CANCELLED) call report(info, FUGE_ERR_CANCELLED, 'cancelled at iteration ' &
                                                         //text(relay%reported)//' by the progress monitor')
    end if
    if (info%failed()) then
      ! The factor belongs to no accepted solution, so derivatives must not use it.
      self%factor = kkt_factor()
      self%has_solution = .false.
    else
      self%last_report = info
      call move_solution(solution, self%spare)
      call move_solution(candidate, solution)
    end if
  end subroutine solve

  !> Has what was kept of the last solve perhaps misled this one, which ended with `status`?
  !>
  !> The matrix may have changed since it was factored, although the operator was not set again, and the start of an
  !> iteration may have been so large that it left its rounding behind.
  pure function is_misled(self, status)
    type(fuge_solver), intent(in) :: self
    integer, intent(in) :: status
    logical :: is_misled

    if (self%solved_by_products) then
      is_misled = self%steps%started_warm .and. status == FUGE_WARN_RESIDUAL
    else
      is_misled = self%found_factor .and. any(status == [FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED])
    end if
  end function is_misled

  !> One solve by the engine that the options choose, and its certificate.
  subroutine solve_and_certify(self, operator, problem, options, monitor, solution, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    self%found_factor = .false.
    self%solved_by_products = .false.
    call run_engine(self, operator, problem, options, monitor, solution, info)
    if (.not. info%failed()) then
      if (.not. self%solved_by_products) then
        call judge_force_level(operator, self%canonical, problem%gap, self%state, options%tolerance, info)
      else if (self%last_is_general) then
        call judge_force_level(operator, self%canonical, problem%gap, self%last%state, options%tolerance, info)
      end if
      if (info%failed()) call forget_start(self)
    else if (is_general(problem)) then
      call explain_by_force_level(operator, self%canonical, problem%gap, options%tolerance, info)
    end if
    if (.not. info%failed()) call certify(operator, problem, solution, options%tolerance, info)
  end subroutine solve_and_certify

  !> Forget the last contact set and the history: the next solve starts from scratch. After a change of the operator
  !> that may be faster; the solution is the same.
  subroutine reset(self)
    class(fuge_solver), intent(inout) :: self

    self%history = fuge_history()
    self%factor = kkt_factor()
    self%has_solution = .false.
    self%last_report = fuge_info()
    call forget_start(self)
  end subroutine reset

  !> Forget where the next solve would start.
  subroutine forget_start(self)
    class(fuge_solver), intent(inout) :: self

    if (allocated(self%state)) deallocate (self%state)
    call self%steps%forget()
  end subroutine forget_start

  !> How the last solution changes with gaps and load, to first order, and exactly as long as the contact set stays:
  !> df, dc and dq, by triangular solves with the last factor; after the iteration by products on the contact set, to
  !> the tolerance of the solve.
  !>
  !> `operator` that of the last solve; `gap_change` (n) length and `load_change` force; `change` the changes in the
  !> order of `fuge_solution`. The contact stiffness dF_0/dv_0 is 1/change%motion(1) for gap_change 0 and load_change
  !> 1; column k of the sensitivity to the gaps is the change for a unit gap_change at k. A point that just touches
  !> without force stays in the state in which the solve left it. `info` is that of the solve, whose warnings hold for
  !> the derivative too, with the products of the derivative added; an error replaces status and message only.
  !> Errors, `change` untouched: FUGE_ERR_CALL_ORDER without a solution with a load, FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_UNSUPPORTED, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_MEMORY; by products also
  !> FUGE_ERR_ITERATION_LIMIT where the operator is too badly conditioned, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_CALLBACK.
  subroutine derivative_by_load(self, operator, gap_change, load_change, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info

    call derivative_by_loads(self, operator, gap_change, [load_change], change, info)
  end subroutine derivative_by_load

  !> As `derivative_by_load`, for changes of all resultants, `load_change` (m); where a motion is prescribed, of the
  !> motion.
  subroutine derivative_by_loads(self, operator, gap_change, load_change, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info
    type(shared_ranks) :: ranks

    info = self%last_report
    ranks = operator%ranks()
    call check_changes(self, ranks, operator%points(), gap_change, load_change, info)
    call ranks%agree(info)
    if (info%failed()) return
    if (differ(load_change, ranks)) then
      call report(info, FUGE_ERR_OPTION, 'load_change differs between the ranks')
      return
    end if
    if (self%solved_by_products) then
      call differentiate_by_products(self, operator, gap_change, load_change, change, info)
      return
    end if
    select type (operator)
    class is (fuge_dense_operator)
      call find_derivative(self%canonical, operator, self%factor, self%state, gap_change, load_change, change, info)
    class default
      call report(info, FUGE_ERR_CALL_ORDER, 'the last solve was with a matrix, not with this operator')
    end select
  end subroutine derivative_by_loads

  !> The derivative after the iteration, which keeps no canonical form of problems with one translation.
  subroutine differentiate_by_products(self, operator, gap_change, load_change, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    type(canonical_problem) :: canonical
    type(fuge_problem) :: problem
    type(shared_ranks) :: ranks

    if (self%last_is_general) then
      call find_derivative_by_products(operator, self%canonical, self%last%state, self%last%tolerance, gap_change, &
                                       load_change, change, info)
      return
    end if
    call set_problem(0.0_dp*gap_change, 1.0_dp, problem, info)
    ranks = operator%ranks()
    call ranks%agree(info)
    if (info%failed()) return
    problem%prescribed = [self%last_is_prescribed]
    problem%motion = [0.0_dp]
    call make_canonical(problem, canonical, info, operator%ranks())
    if (.not. info%failed()) call find_derivative_by_products(operator, canonical, self%last%state, &
                                                              self%last%tolerance, gap_change, load_change, change, &
                                                              info)
  end subroutine differentiate_by_products

  !> Refuse changes that fit no solution of n points.
  subroutine check_changes(self, ranks, n, gap_change, load_change, info)
    class(fuge_solver), intent(in) :: self
    type(shared_ranks), intent(in) :: ranks
    integer, intent(in) :: n
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_info), intent(inout) :: info

    integer :: all_points, modes, points

    points = 0
    modes = self%canonical%mode_count()
    if (self%solved_by_products) then
      if (.not. self%last_is_general) modes = 1
      if (allocated(self%last%state)) points = size(self%last%state)
    else if (allocated(self%state)) then
      points = size(self%state)
    end if
    all_points = ranks%total_count(points)
    if (.not. self%has_solution .or. all_points < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution with a load: solve first')
    else if (size(gap_change) /= n .or. points /= n) then
      call report(info, FUGE_ERR_SIZE, 'gap_change has '//text(size(gap_change))//' value(s), the operator ' &
                  //text(n)//' points and the last solution '//text(points))
    else if (size(load_change) /= modes) then
      call report(info, FUGE_ERR_SIZE, 'load_change has '//text(size(load_change))//' value(s), the last problem ' &
                  //text(modes)//' motion(s)')
    else
      call check_finite(gap_change, 'gap_change', info)
      if (.not. info%failed()) call check_finite(load_change, 'load_change', info)
    end if
  end subroutine check_changes

  pure subroutine move_solution(candidate, solution)
    type(fuge_solution), intent(inout) :: candidate, solution

    call move_alloc(candidate%force, solution%force)
    call move_alloc(candidate%gap, solution%gap)
    call move_alloc(candidate%motion, solution%motion)
  end subroutine move_solution

  !> The plain problem without a load, which has no unique approach.
  pure function is_unloaded(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: is_unloaded

    is_unloaded = problem%is_plain()
    if (is_unloaded) is_unloaded = .not. problem%resultant(1) > 0.0_dp
  end function is_unloaded

  !> The limit of a vanishing load: the bodies just touch at the smallest gap.
  subroutine solve_without_load(problem, ranks, solution, info)
    type(fuge_problem), intent(in) :: problem
    type(shared_ranks), intent(in) :: ranks
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%force(problem%points()), solution%gap(problem%points()), solution%motion(1), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the forces and gaps of '//text(problem%points()) &
                               //' points')
    call ranks%agree(info)
    if (stat /= 0 .or. info%failed()) return
    solution%force = 0.0_dp
    solution%motion = ranks%least(minval(problem%gap))
    solution%gap = problem%gap - solution%motion(1)
  end subroutine solve_without_load

  !> Choose the engine: FUGE_AUTO is the active set for a matrix, or the tableau if the history is asked for, which it
  !> alone keeps; for any other operator the iteration.
  subroutine run_engine(self, operator, problem, options, monitor, solution, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    if (options%method == FUGE_ITERATIVE) then
      call run_iteration(self, operator, problem, options, monitor, solution, info)
      return
    end if
    select type (operator)
    class is (fuge_dense_operator)
      call run_dense_engine(self, operator, problem, options, monitor, solution, info)
    class default
      if (options%method == FUGE_AUTO) then
        call run_iteration(self, operator, problem, options, monitor, solution, info)
      else
        call report(info, FUGE_ERR_UNSUPPORTED, 'this engine needs the coefficients of a dense operator: use ' &
                    //'FUGE_ITERATIVE for other operators')
      end if
    end select
  end subroutine run_engine

  subroutine run_dense_engine(self, operator, problem, options, monitor, solution, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_solution) :: engine_solution
    logical :: is_set

    call self%canonical%set_again(problem, is_set)
    if (.not. is_set) call make_canonical(problem, self%canonical, info)
    if (info%failed()) return
    call allocate_solution(problem%points(), size(self%canonical%load), engine_solution, info, self%spare)
    if (info%failed()) return
    call self%canonical%set_matrix(operator%alpha, operator%datum(), operator%known(), operator%stamp())
    self%found_factor = self%factor%belongs_to(self%canonical)
    if (.not. self%found_factor) self%factor = kkt_factor()
    if (options%method == FUGE_TABLEAU .or. (options%method == FUGE_AUTO .and. options%keep_history)) then
      self%factor = kkt_factor()
      self%found_factor = .false.
      call solve_by_tableau(self%canonical, options, monitor, self%history, self%factor, engine_solution, info)
    else
      call run_active_set(self, options, monitor, engine_solution, info)
    end if
    ! The matrix is the caller's and may be gone before the next call.
    self%canonical%alpha => null()
    if (info%failed()) return
    if (self%canonical%plain) then
      call move_alloc(engine_solution%motion, solution%motion)
    else
      call find_given_motions(self%canonical, operator%alpha, problem, engine_solution, solution, info)
      if (info%failed()) return
    end if
    call estimate_force_error(self%canonical, operator%alpha, self%factor, problem, solution%motion, engine_solution, &
                              info%force_error)
    call move_alloc(engine_solution%force, solution%force)
    call move_alloc(engine_solution%gap, solution%gap)
    call move_alloc(engine_solution%state, self%state)
    self%has_solution = .true.
  end subroutine run_dense_engine

  !> The motions in the given modes, and the gaps of excluded points.
  subroutine find_given_motions(canonical, alpha, problem, engine_solution, solution, info)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(contact_solution), intent(inout) :: engine_solution
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%motion(problem%mode_count()), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the motions')
      return
    end if
    call canonical%to_given_modes(problem%prescribed_motion(), engine_solution%motion, solution%motion)
    call canonical%set_excluded_gaps(alpha, problem%gap, engine_solution%force, solution%motion, engine_solution%gap)
  end subroutine find_given_motions

  !> The active set from the last contact set; from scratch if there is none, or if that start fails.
  subroutine run_active_set(self, options, monitor, solution, info)
    class(fuge_solver), intent(inout) :: self
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    logical :: warm

    warm = .false.
    if (allocated(self%state)) warm = size(self%state) == size(solution%state)
    if (warm) solution%state = self%state
    call solve_by_active_set(self%canonical, options, monitor, self%factor, solution, info, self%set)
    if (warm .and. info%failed() .and. info%status /= FUGE_ERR_CANCELLED) then
      info = fuge_info()
      self%factor = kkt_factor()
      self%found_factor = .false.
      solution%state = FUGE_OPEN
      call solve_by_active_set(self%canonical, options, monitor, self%factor, solution, info, self%set)
    end if
  end subroutine run_active_set

  !> The iteration from the last solutions if they promise a better start than coarser grids; from scratch if they lead
  !> nowhere.
  subroutine run_iteration(self, operator, problem, options, monitor, solution, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    call check_iterative(options, info)
    if (info%failed()) return
    self%last_is_general = is_general(problem)
    self%last_is_prescribed = .not. (self%last_is_general .or. problem%is_plain())
    if (self%last_is_general) call make_canonical(problem, self%canonical, info, operator%ranks())
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
    if (info%failed()) return
    self%solved_by_products = .true.
    self%has_solution = .true.
  end subroutine run_iteration

  !> Refuse what the iteration does not solve (FUGE_ERR_UNSUPPORTED).
  pure subroutine check_iterative(options, info)
    type(fuge_options), intent(in) :: options
    type(fuge_info), intent(inout) :: info

    if (options%keep_history) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'only the tableau keeps a history, and it needs a dense operator: ' &
                  //'leave keep_history out')
    end if
  end subroutine check_iterative

  !> Fill the report from the certificate. A residual above the tolerance is a warning, as are forces that may be far
  !> off by the estimate that the engine has left in info%force_error; contact at the rim of a grid is only a message.
  subroutine certify(operator, problem, solution, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_violation) :: violation
    type(shared_ranks) :: ranks

    call find_violation(operator, problem, solution, violation, info, enough=tolerance)
    if (info%failed()) return
    ranks = operator%ranks()
    info%contacts = ranks%total_count(count(abs(solution%force) > 0.0_dp))
    info%residual = violation%worst()
    if (violation%unresolved > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the forces reach ' &
                  //text(ranks%largest(maxval(abs(solution%force))))//' and dwarf the ' &
                  //'data: lengths are off by '//text(violation%unresolved)//' of the gaps; look for missing ' &
                  //'rigid motions, or for gaps that no forces can close or open')
    else if (info%residual > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' is above the tolerance ' &
                  //text(tolerance)//': the operator may be too badly conditioned for double precision')
    else if (info%status == FUGE_DONE .and. info%force_error > MOST_FORCE_ERROR) then
      call report(info, FUGE_WARN_ILL_CONDITIONED, 'the forces may be wrong by '//text(info%force_error)//' of the ' &
                  //'largest one although the equations hold to '//text(info%residual)//': merge points that nearly ' &
                  //'coincide, count tilts from a nearer point, or lower the tolerance of an iteration')
    else if (info%status == FUGE_DONE) then
      call remark_contact_at_rim(operator, solution%force, info)
    end if
  end subroutine certify

  !> One call for a dense matrix and one load.
  !>
  !> `alpha` (n, n) length per force, `gap` (n) length, `load` force; out: `force` (n), `gap_out` (n) and `approach`,
  !> untouched on an error. Status and errors as for `solve` and for `set` of `fuge_dense_operator`.
  subroutine fuge_solve_dense(alpha, gap, load, force, gap_out, approach, info)
    real(dp), intent(in), target :: alpha(:, :)
    real(dp), intent(in) :: gap(:), load
    real(dp), intent(inout) :: force(:), gap_out(:), approach
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver

    call operator%set(alpha, info)
    if (info%failed()) return
    if (size(force) /= operator%points() .or. size(gap_out) /= operator%points()) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' and gap_out '//text(size(gap_out)) &
                  //' value(s): both need '//text(operator%points()))
      return
    end if
    call set_problem(gap, load, problem, info)
    if (info%failed()) return
    call solver%solve(operator, problem, solution, info)
    if (info%failed()) return
    force = solution%force
    gap_out = solution%gap
    approach = solution%motion(1)
  end subroutine fuge_solve_dense

end module fuge_solver_type
