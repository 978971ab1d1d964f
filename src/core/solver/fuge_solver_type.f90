!> From a problem to a certified solution: checks, choice of engine, certificate, derivatives.
module fuge_solver_type
  use fuge_contact_engine, only: contact_engine, matrix_engine
  use fuge_history_type, only: fuge_history
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution, set_problem
  use fuge_shared_problem, only: differ
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_solve_dense

  !> Solves contact problems one after the other, each from the contact set of the last one. One solver for each
  !> thread.
  type, public :: fuge_solver
    !> Basis and z of each pivot of the last tableau solve, if it was asked for.
    type(fuge_history) :: history
    !> Each is allocated by the first solve that needs it.
    class(matrix_engine), allocatable, private :: by_matrix
    class(contact_engine), allocatable, private :: by_products
    !> The last solve was by the iteration.
    logical, private :: solved_by_products = .false.
    !> The last solve was accepted, and had a load: only then are there derivatives.
    logical, private :: has_solution = .false.
    !> The report of the last solution, for its derivatives, and how many threads share their work.
    type(fuge_info), private :: last_report
    integer, private :: threads = 1
  contains
    procedure :: solve
    procedure :: start_from
    procedure :: reset
    !> For a change of one load, or of each; and of open gaps at some points only.
    generic :: derivative => derivative_by_load, derivative_by_loads, derivative_at_points
    procedure, private :: derivative_by_load
    procedure, private :: derivative_by_loads
    procedure, private :: derivative_at_points
    procedure :: has_found
    procedure :: thread_count
  end type fuge_solver

  interface
    !> Solve the contact problem (paper, equations 9 to 11) and certify the solution.
    !>
    !> `operator` displacements per force, `problem` gaps and load, `options` as in `fuge_options` (defaults when
    !> absent); options%threads share the work, and change no result. `monitor` hears of each iteration, in the thread
    !> of the call, and may cancel; without a load there are none. On return info%status is FUGE_DONE, with a message
    !> only if the contact reaches the rim of a free grid, or the first of these warnings that is true:
    !> FUGE_WARN_RESIDUAL with the residual in the message; FUGE_WARN_NOT_UNIQUE where alpha is singular on the points
    !> that touch, with or without force (the forces are then one of many possible), or the contact does not resist a
    !> mode (its motion is then one of many possible), or both; FUGE_WARN_ILL_CONDITIONED if info%force_error, the
    !> estimated error of the forces, is above 1e-3 and a thousand times the tolerance. Or it is an error that leaves
    !> `solution` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION, FUGE_ERR_NO_EQUILIBRIUM,
    !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY,
    !> FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED. The next solve is possible after any of them.
    module subroutine solve(self, operator, problem, solution, info, options, monitor)
      class(fuge_solver), intent(inout) :: self
      class(fuge_operator), intent(in) :: operator
      type(fuge_problem), intent(in) :: problem
      type(fuge_solution), intent(inout) :: solution
      type(fuge_info), intent(out) :: info
      type(fuge_options), intent(in), optional :: options
      class(fuge_monitor), intent(inout), optional, target :: monitor
    end subroutine solve
  end interface

contains

  !> Start the next solve with a matrix from these states of the points, (n), as in `fuge_solution`, instead of those of
  !> the last solve; any states are allowed, and change no solution. Without effect before the first solve with a
  !> matrix, if there are other points now, and on the iteration, which starts from its last solutions.
  subroutine start_from(self, state)
    class(fuge_solver), intent(inout) :: self
    integer, intent(in) :: state(:)

    if (allocated(self%by_matrix)) call self%by_matrix%start_from(state)
    ! The states are no longer those of the last solution.
    self%has_solution = self%has_solution .and. self%solved_by_products
  end subroutine start_from

  !> Forget the last contact set and the history: the next solve starts from scratch. After a change of the operator
  !> that may be faster; the solution is the same.
  subroutine reset(self)
    class(fuge_solver), intent(inout) :: self

    self%history = fuge_history()
    self%has_solution = .false.
    self%last_report = fuge_info()
    if (allocated(self%by_matrix)) call self%by_matrix%forget_start()
    if (allocated(self%by_products)) call self%by_products%forget_start()
  end subroutine reset

  !> How the last solution changes with gaps and load, to first order, and exactly as long as the contact set stays:
  !> df, dc and dq, by triangular solves with the last factor; after the iteration by products on the contact set, to
  !> the tolerance of the solve. As many threads share the work as in the last solve.
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

    call differentiate_last(self, operator, gap_change, load_change, change, info)
  end subroutine derivative_by_loads

  !> As `derivative_by_loads`, with the changes of open gaps where `wanted` (n) only, zero elsewhere: with a matrix of
  !> many points, most of them open, the others cost the larger part of the time.
  subroutine derivative_at_points(self, operator, gap_change, load_change, wanted, change, info)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    logical, intent(in) :: wanted(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info

    call differentiate_last(self, operator, gap_change, load_change, change, info, wanted)
  end subroutine derivative_at_points

  !> The derivative of the last solution, if there is one.
  subroutine differentiate_last(self, operator, gap_change, load_change, change, info, wanted)
    class(fuge_solver), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: wanted(:)

    info = self%last_report
    if (.not. self%has_solution) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution with a load: solve first')
    else if (self%solved_by_products) then
      call differentiate(self%by_products, operator, gap_change, load_change, self%threads, change, info, wanted)
    else
      call differentiate(self%by_matrix, operator, gap_change, load_change, self%threads, change, info, wanted)
    end if
  end subroutine differentiate_last

  !> Has the last solve found a solution with a load, with these states of the points, (n)? Only then there are
  !> derivatives.
  pure function has_found(self, state)
    class(fuge_solver), intent(in) :: self
    integer, intent(in) :: state(:)
    logical :: has_found

    has_found = self%has_solution
    if (.not. has_found) return
    if (self%solved_by_products) then
      has_found = self%by_products%has_found(state)
    else
      has_found = self%by_matrix%has_found(state)
    end if
  end function has_found

  !> How many threads shared the last solve, and share its derivatives.
  pure function thread_count(self)
    class(fuge_solver), intent(in) :: self
    integer :: thread_count

    thread_count = self%threads
  end function thread_count

  !> The derivative of the last solution of `engine`, for changes that fit it, by up to `threads` threads.
  subroutine differentiate(engine, operator, gap_change, load_change, threads, change, info, wanted)
    use fuge_threads, only: thread_team
    class(contact_engine), intent(in) :: engine
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    integer, intent(in) :: threads
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: wanted(:)
    type(point_space) :: space
    type(thread_team) :: team

    space = operator%ranks()
    if (present(wanted)) call check_wanted(operator%points(), wanted, info)
    if (.not. info%failed()) call check_changes(engine, operator%points(), gap_change, load_change, info)
    call space%agree(info)
    if (info%failed()) return
    if (differ(load_change, space)) then
      call report(info, FUGE_ERR_OPTION, 'load_change differs between the ranks')
      return
    end if
    call team%begin(threads)
    call engine%derivative(operator, gap_change, load_change, change, info, wanted)
    call team%end()
  end subroutine differentiate

  !> FUGE_ERR_SIZE unless `wanted` has a value for each of `n` points.
  pure subroutine check_wanted(n, wanted, info)
    integer, intent(in) :: n
    logical, intent(in) :: wanted(:)
    type(fuge_info), intent(inout) :: info

    if (size(wanted) /= n) call report(info, FUGE_ERR_SIZE, 'wanted has '//text(size(wanted))//' value(s), the ' &
                                       //'operator '//text(n)//' points')
  end subroutine check_wanted

  !> Refuse changes that fit no solution of n points.
  pure subroutine check_changes(engine, n, gap_change, load_change, info)
    class(contact_engine), intent(in) :: engine
    integer, intent(in) :: n
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_info), intent(inout) :: info
    integer :: points

    points = engine%last_points()
    if (size(gap_change) /= n .or. points /= n) then
      call report(info, FUGE_ERR_SIZE, 'gap_change has '//text(size(gap_change))//' value(s), the operator ' &
                  //text(n)//' points and the last solution '//text(points))
    else if (size(load_change) /= engine%last_modes()) then
      call report(info, FUGE_ERR_SIZE, 'load_change has '//text(size(load_change))//' value(s), the last problem ' &
                  //text(engine%last_modes())//' motion(s)')
    else
      call check_finite(gap_change, 'gap_change', info)
      if (.not. info%failed()) call check_finite(load_change, 'load_change', info)
    end if
  end subroutine check_changes

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
