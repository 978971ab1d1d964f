!> From a problem to a certified answer: checks, choice of engine, certificate.
module fuge_solver_type
  use fuge_certificate, only: find_violation, fuge_violation
  use fuge_input_checks, only: check_finite
  use fuge_kkt_factor, only: contact_factor
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_active_set_engine, only: solve_by_active_set
  use fuge_tableau_engine, only: solve_by_tableau
  use fuge_history_type, only: fuge_history
  use fuge_iterative_engine, only: solve_by_iteration
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, monitor_relay
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, check_options, FUGE_AUTO, FUGE_TABLEAU, FUGE_ITERATIVE
  use fuge_problem_type, only: fuge_problem, fuge_solution, check_problem, set_problem
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_kkt_solution, only: solve_set, displaced, add_deflection
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, &
    FUGE_ERR_CALL_ORDER, FUGE_ERR_UNSUPPORTED, FUGE_ERR_CANCELLED, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_number_text, only: text
  implicit none
  private

  public :: fuge_solve_dense

  !> Relative change of the load up to which the last forces are the better start.
  real(dp), parameter :: WARM_RANGE = 0.25_dp
  !> Equilibrium of changes, relative.
  real(dp), parameter :: HELD_TO = 1.0e-6_dp
  !> Stands for the load where the approach is prescribed.
  real(dp), parameter :: HELD = -1.0_dp

  !> What stays between solves. One solver for each thread.
  type, public :: fuge_solver
    !> Basis and z of each pivot of the last tableau solve, if it was asked for.
    type(fuge_history) :: history
    !> Contact set of the last solve, where the next one starts (1 at the lower stop, -1
    !> at the upper one, 0 open), its factor, and what the problem looked like.
    integer, allocatable, private :: state(:)
    type(contact_factor), private :: factor
    type(canonical_problem), private :: canonical
    !> Forces of the last solve by products only, as parts of its load, and that load.
    real(dp), allocatable, private :: part(:)
    real(dp), private :: last_load = 0.0_dp
  contains
    procedure :: solve
    procedure :: reset
    !> For a change of one load, or of each.
    generic :: derivative => derivative_by_load, derivative_by_loads
    procedure, private :: derivative_by_load
    procedure, private :: derivative_by_loads
  end type fuge_solver

contains

  !> Solve the contact problem (paper, equations 9 to 11) and certify the answer.
  !>
  !> `operator` displacements per force, `problem` gaps and load, `options` as in
  !> `fuge_options` (defaults when absent), `monitor` hears of each iteration and may
  !> cancel; there is none without a load. On return info%status is FUGE_DONE,
  !> FUGE_WARN_RESIDUAL with the residual in the message, FUGE_WARN_NOT_UNIQUE where
  !> alpha is singular on the contact (one of many sets of forces) or the contact does not
  !> hold a motion (one of many values of that; forces are unique), or an error that leaves `solution` untouched:
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_NO_EQUILIBRIUM,
  !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_UNSUPPORTED,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, FUGE_ERR_CALLBACK,
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
    type(fuge_solution) :: answer
    type(monitor_relay) :: relay

    if (present(options)) chosen = options
    if (present(monitor)) relay%listener => monitor
    self%history = fuge_history()
    self%factor = contact_factor()
    call check_options(chosen, info)
    if (info%failed()) return
    if (operator%points() < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before the solve')
      return
    end if
    call check_problem(problem, operator%points(), info)
    if (info%failed()) return
    call allocate_answer(answer, operator%points(), problem%mode_count(), info)
    if (info%failed()) return

    if (.not. rests(problem)) then
      call run_engine(self, operator, problem, chosen, relay, answer, info)
      if (info%status == FUGE_ERR_CANCELLED) call report(info, FUGE_ERR_CANCELLED, 'cancelled at iteration ' &
                                                         //text(relay%reported)//' by the progress monitor')
    else
      call rest_without_load(problem, answer)
    end if
    if (.not. info%failed()) call certify(operator, problem, answer, chosen%tolerance, info)
    if (info%failed()) then
      ! It is of no answer: a derivative must not use it.
      self%factor = contact_factor()
    else
      call take(answer, solution)
    end if
  end subroutine solve

  !> Forget the last contact set and the history: the next solve starts from scratch.
  !> Call it when the operator has changed, though nothing depends on it but speed.
  subroutine reset(self)
    class(fuge_solver), intent(inout) :: self

    self%history = fuge_history()
    self%factor = contact_factor()
    if (allocated(self%state)) deallocate (self%state)
    if (allocated(self%part)) deallocate (self%part)
  end subroutine reset

  !> How the last solution changes with gaps and load, to first order and exactly so as
  !> long as the contact set stays: dF, dc and dq, by two triangular solves.
  !>
  !> `operator` that of the last solve; `gap_change` (n) length and `load_change` force;
  !> `change` the changes in the order of `fuge_solution`. The contact stiffness
  !> dF_0/dv_0 is 1/change%motion(1) for gap_change 0 and load_change 1; column k of the
  !> sensitivity to the gaps is that of a unit gap_change at k. A point that just touches
  !> without force counts as on the side that the solve left it.
  !> Errors, `change` untouched: FUGE_ERR_CALL_ORDER without a solution with a load,
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_UNSUPPORTED, FUGE_ERR_MEMORY.
  subroutine derivative_by_load(self, operator, gap_change, load_change, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info

    call derivative_by_loads(self, operator, gap_change, [load_change], change, info)
  end subroutine derivative_by_load

  !> The same for changes of all resultants, `load_change` (m); those of prescribed
  !> motions are changes of the motion.
  subroutine derivative_by_loads(self, operator, gap_change, load_change, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: found
    real(dp) :: datum
    real(dp), allocatable :: reduced_gap(:), load(:), motion(:)
    integer :: n

    n = operator%points()
    if (.not. has_coefficients(operator)) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'derivatives need the coefficients of a fuge_dense_operator')
    else if (.not. (self%factor%is_set() .and. allocated(self%state))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution with a load by a dense engine: solve first, ' &
                  //'not by FUGE_ITERATIVE')
    else if (size(gap_change) /= n .or. size(self%state) /= n) then
      call report(info, FUGE_ERR_SIZE, 'gap_change has '//text(size(gap_change))//' value(s), the operator ' &
                  //text(n)//' points and the last solution '//text(size(self%state)))
    else if (size(load_change) /= self%canonical%mode_count()) then
      call report(info, FUGE_ERR_SIZE, 'load_change has '//text(size(load_change))//' value(s), the last problem ' &
                  //text(self%canonical%mode_count())//' motion(s)')
    else
      call check_finite(gap_change, 'gap_change', info)
      if (.not. info%failed()) call check_finite(load_change, 'load_change', info)
      if (.not. info%failed()) call allocate_answer(found, n, size(load_change), info)
    end if
    if (info%failed()) return
    select type (operator)
    class is (fuge_dense_operator)
      datum = merge(operator%datum(), 0.0_dp, self%canonical%has_translation)
      call self%canonical%change_of(gap_change, load_change, reduced_gap, load)
      allocate (motion(size(load)))
      call solve_set(self%factor, datum, reduced_gap, load, found%force, motion)
      if (any(abs(load - matmul(found%force, self%canonical%modes)) &
              > HELD_TO*max(abs(load), matmul(abs(found%force), abs(self%canonical%modes))))) then
        call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the contact does not hold the motions that these resultants act ' &
                    //'in: they would turn the body over, whatever the size of the change')
        return
      end if
      found%gap = reduced_gap - displaced(self%canonical%modes, motion)
      call add_deflection(operator%alpha, datum, self%state /= 0, found%force, found%gap)
      where (self%state /= 0) found%gap = 0.0_dp
      if (self%canonical%has_translation) motion(1) = motion(1) + datum*load(1)
      call self%canonical%motions_of(load_change, motion, found%motion)
      call self%canonical%open_outside(operator%alpha, gap_change, found%force, found%motion, found%gap)
      call take(found, change)
    end select
  end subroutine derivative_by_loads

  pure function has_coefficients(operator) result(has)
    class(fuge_operator), intent(in) :: operator
    logical :: has

    has = .false.
    select type (operator)
    class is (fuge_dense_operator)
      has = .true.
    end select
  end function has_coefficients

  pure subroutine take(answer, solution)
    type(fuge_solution), intent(inout) :: answer, solution

    call move_alloc(answer%force, solution%force)
    call move_alloc(answer%gap, solution%gap)
    call move_alloc(answer%motion, solution%motion)
  end subroutine take

  pure subroutine allocate_answer(answer, n, m, info)
    type(fuge_solution), intent(inout) :: answer
    integer, intent(in) :: n, m
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (answer%force(n), answer%gap(n), answer%motion(m), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the forces and gaps of ' &
                               //text(n)//' points')
  end subroutine allocate_answer

  !> The plain problem without a load has no unique approach.
  pure function rests(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: rests

    rests = problem%is_plain()
    if (rests) rests = .not. problem%resultant(1) > 0.0_dp
  end function rests

  !> The limit of a vanishing load: the bodies just touch at the smallest gap.
  pure subroutine rest_without_load(problem, answer)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: answer

    answer%force = 0.0_dp
    answer%motion = minval(problem%gap)
    answer%gap = problem%gap - answer%motion(1)
  end subroutine rest_without_load

  !> Choice of engine. FUGE_AUTO is the active set for a matrix, but the tableau for a
  !> history, which only that has; for any other operator the iteration.
  subroutine run_engine(self, operator, problem, options, monitor, answer, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info

    if (options%method == FUGE_ITERATIVE) then
      call iterate_warm(self, operator, problem, options, monitor, answer, info)
      return
    end if
    select type (operator)
    class is (fuge_dense_operator)
      call run_dense_engine(self, operator, problem, options, monitor, answer, info)
    class default
      if (options%method == FUGE_AUTO) then
        call iterate_warm(self, operator, problem, options, monitor, answer, info)
      else
        call report(info, FUGE_ERR_UNSUPPORTED, 'this engine needs the coefficients of a fuge_dense_operator: use ' &
                    //'FUGE_ITERATIVE for other operators')
      end if
    end select
  end subroutine run_engine

  subroutine run_dense_engine(self, operator, problem, options, monitor, answer, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    type(fuge_solution) :: found
    integer :: state(size(problem%gap))

    call make_canonical(problem, self%canonical, info)
    if (.not. info%failed()) call allocate_answer(found, size(state), size(self%canonical%load), info)
    if (info%failed()) return
    if (options%method == FUGE_TABLEAU .or. (options%method == FUGE_AUTO .and. options%keep_history)) then
      call solve_by_tableau(operator%alpha, operator%datum(), self%canonical, options, monitor, self%history, state, &
                            self%factor, found, info)
    else
      call solve_warm(self, operator%alpha, operator%datum(), options, monitor, state, found, info)
    end if
    if (info%failed()) return
    call remember(self, state)
    call self%canonical%motions_of(prescribed_values(problem), found%motion, answer%motion)
    call self%canonical%open_outside(operator%alpha, problem%gap, found%force, answer%motion, found%gap)
    call move_alloc(found%force, answer%force)
    call move_alloc(found%gap, answer%gap)
  end subroutine run_dense_engine

  !> The prescribed motions, zero where free, (m).
  pure function prescribed_values(problem) result(values)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: values(problem%mode_count())

    values = 0.0_dp
    if (allocated(problem%prescribed)) where (problem%prescribed) values = problem%motion
  end function prescribed_values

  !> The iteration from the last forces if the load is about the same, else from coarser
  !> grids; from scratch if the last forces lead nowhere.
  subroutine iterate_warm(self, operator, problem, options, monitor, answer, info)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    real(dp) :: load
    logical :: warm

    if (options%keep_history) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'only the tableau keeps a history, and it needs a fuge_dense_operator: ' &
                  //'leave keep_history out')
      return
    end if
    if (allocated(problem%modes) .or. allocated(problem%gap_upper) .or. allocated(problem%excluded)) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'the iteration solves one-sided contact under one load or with a ' &
                  //'prescribed approach: use FUGE_ACTIVE_SET with a fuge_dense_operator')
      return
    end if
    load = HELD
    if (problem%is_plain()) load = problem%resultant(1)
    warm = .false.
    if (allocated(self%part)) then
      warm = size(self%part) == size(problem%gap) &
             .and. abs(load - self%last_load) <= WARM_RANGE*abs(self%last_load)
      if (.not. warm) deallocate (self%part)
    end if
    call solve_by_iteration(operator, problem, options, monitor, self%part, answer, info)
    ! What the operator or the monitor ends is not for us to try again.
    if (warm .and. any(info%status == [FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW])) then
      ! The counts stay.
      call report(info, FUGE_DONE, '')
      if (allocated(self%part)) deallocate (self%part)
      call solve_by_iteration(operator, problem, options, monitor, self%part, answer, info)
    end if
    if (.not. info%failed()) self%last_load = load
  end subroutine iterate_warm

  !> Keep the contact set for the next solve; without memory that starts from scratch.
  pure subroutine remember(self, state)
    class(fuge_solver), intent(inout) :: self
    integer, intent(in) :: state(:)
    integer :: stat

    if (allocated(self%state)) deallocate (self%state)
    allocate (self%state(size(state)), stat=stat)
    if (stat == 0) self%state = state
  end subroutine remember

  !> The active set from the last contact set; from scratch if there is none, or if
  !> it leads nowhere.
  subroutine solve_warm(self, alpha, datum, options, monitor, state, answer, info)
    class(fuge_solver), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(out) :: state(:)
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    logical :: warm

    warm = .false.
    if (allocated(self%state)) warm = size(self%state) == size(state)
    state = 0
    if (warm) state = self%state
    call solve_by_active_set(alpha, datum, self%canonical, options, monitor, state, self%factor, answer, info)
    if (warm .and. info%failed() .and. info%status /= FUGE_ERR_CANCELLED) then
      info = fuge_info()
      state = 0
      call solve_by_active_set(alpha, datum, self%canonical, options, monitor, state, self%factor, answer, info)
    end if
  end subroutine solve_warm

  !> Fill the report from the certificate; above the tolerance it is a warning.
  subroutine certify(operator, problem, answer, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: answer
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_violation) :: violation

    call find_violation(operator, problem, answer, violation, info)
    if (info%failed()) return
    info%contacts = count(abs(answer%force) > 0.0_dp)
    info%residual = violation%worst()
    if (info%residual > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' is above the tolerance ' &
                  //text(tolerance)//': the operator may be too badly conditioned for double precision')
    end if
  end subroutine certify

  !> One call for a dense matrix and one load.
  !>
  !> `alpha` (n, n) length per force, `gap` (n) length, `load` force; out: `force`
  !> (n), `gap_out` (n) and `approach`, untouched on an error. Status and errors as
  !> for `solve` and for `set` of `fuge_dense_operator`.
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
