!> From a problem to a certified answer: checks, choice of engine, certificate.
module fuge_solver_type
  use fuge_certificate, only: fuge_residual, fuge_violation
  use fuge_contact_set, only: solve_contact_set, check_definite
  use fuge_dense, only: fuge_dense_operator
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, check_options
  use fuge_problem_type, only: fuge_problem, fuge_solution, check_problem, set_problem, LARGEST_EXPONENT
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_WARN_RESIDUAL, FUGE_ERR_SIZE, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW
  use fuge_tableau, only: run_phase_one
  use fuge_text, only: text
  implicit none
  private

  public :: fuge_solve_dense, check_solvable

  !> Pivots allowed for each row when the caller sets no limit; two are usual.
  integer, parameter :: PIVOTS_PER_ROW = 50

  !> What stays between solves. One solver for each thread.
  type, public :: fuge_solver
    !> Basis and z of each pivot of the last tableau solve, if it was asked for.
    type(fuge_history) :: history
  contains
    procedure :: solve
  end type fuge_solver

contains

  !> Solve the contact problem (paper, equations 9 to 11) and certify the answer.
  !>
  !> `operator` displacements per force, `problem` gaps and load, `options` as in
  !> `fuge_options` (defaults when absent). On return info%status is FUGE_DONE, or
  !> FUGE_WARN_RESIDUAL with the residual in the message, or an error that leaves
  !> `solution` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION,
  !> FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_UNSUPPORTED, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine solve(self, operator, problem, solution, info, options)
    class(fuge_solver), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_options) :: chosen
    type(fuge_solution) :: answer

    if (present(options)) chosen = options
    self%history = fuge_history()
    call check_options(chosen, info)
    if (info%failed()) return
    if (operator%points() < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before the solve')
      return
    end if
    call check_problem(problem, operator%points(), info)
    if (info%failed()) return
    call allocate_answer(answer, operator%points(), info)
    if (info%failed()) return

    if (problem%resultant(1) > 0.0_dp) then
      call solve_by_tableau(operator, problem, chosen, self%history, answer, info)
    else
      call rest_without_load(problem, answer)
    end if
    if (info%failed()) return
    call certify(operator, problem, answer, chosen%tolerance, info)
    if (info%failed()) return
    call move_alloc(answer%force, solution%force)
    call move_alloc(answer%gap, solution%gap)
    call move_alloc(answer%rigid, solution%rigid)
  end subroutine solve

  pure subroutine allocate_answer(answer, n, info)
    type(fuge_solution), intent(inout) :: answer
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (answer%force(n), answer%gap(n), answer%rigid(1), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the answer, 3 arrays of ' &
                               //text(n)//' numbers at most')
  end subroutine allocate_answer

  !> The limit of a vanishing load: the bodies just touch at the smallest gap.
  pure subroutine rest_without_load(problem, answer)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: answer

    answer%force = 0.0_dp
    answer%rigid = minval(problem%gap)
    answer%gap = problem%gap - answer%rigid(1)
  end subroutine rest_without_load

  !> The paper's engine: Phase I finds the contact set, LAPACK the numbers.
  subroutine solve_by_tableau(operator, problem, options, history, answer, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    logical :: contact(size(problem%gap))
    integer :: limit, status

    select type (operator)
    type is (fuge_dense_operator)
      associate (alpha => operator%alpha, load => problem%resultant(1))
        call check_solvable(alpha, load, info)
        if (info%failed()) return
        limit = options%max_iterations
        if (limit == 0) limit = PIVOTS_PER_ROW*(size(problem%gap) + 1)
        call run_phase_one(alpha, problem%gap, load, options%pivot_rule, limit, &
                           options%keep_history, history, contact, info%iterations, status)
        if (status == FUGE_DONE) then
          call solve_contact_set(alpha, problem%gap, load, contact, answer%force, answer%gap, &
                                 answer%rigid(1), status)
        end if
        call explain(status, limit, count(contact), info)
      end associate
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'the tableau needs the coefficients of a fuge_dense_operator')
    end select
  end subroutine solve_by_tableau

  !> Put an engine's status into words.
  pure subroutine explain(status, limit, contacts, info)
    integer, intent(in) :: status, limit, contacts
    type(fuge_info), intent(inout) :: info

    select case (status)
    case (FUGE_DONE)
      return
    case (FUGE_ERR_ITERATION_LIMIT)
      call report(info, status, text(limit)//' pivots were not enough: raise max_iterations (0 allows ' &
                  //text(PIVOTS_PER_ROW)//' for each row)')
    case (FUGE_ERR_NOT_DEFINITE)
      call report(info, status, 'alpha is singular on the contact set of '//text(contacts) &
                  //' points: remove points that move together')
    case default
      call report(info, status, fuge_status_text(status))
    end select
  end subroutine explain

  !> Refuse what no engine solves with a load: numbers that overflow
  !> (FUGE_ERR_OVERFLOW), an alpha without a unique answer (FUGE_ERR_NOT_DEFINITE).
  subroutine check_solvable(alpha, load, info)
    real(dp), intent(in) :: alpha(:, :), load
    type(fuge_info), intent(inout) :: info

    call check_magnitudes(alpha(:size(alpha, 2), :), load, info)
    if (.not. info%failed()) call require_definite(alpha, info)
  end subroutine check_solvable

  subroutine require_definite(alpha, info)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: deficient, status

    call check_definite(alpha, deficient, status)
    if (status /= FUGE_DONE) then
      call report(info, status, 'no memory to factor alpha')
    else if (deficient > 0) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite on forces with zero sum: points 1 to ' &
                  //text(deficient)//' carry some that store no energy; look for a repeated point or a wrong sign ' &
                  //'at point '//text(deficient))
    end if
  end subroutine require_definite

  !> Refuse an alpha whose products with the load leave the range of double precision.
  pure subroutine check_magnitudes(alpha, load, info)
    real(dp), intent(in) :: alpha(:, :), load
    type(fuge_info), intent(inout) :: info
    integer :: deflection

    deflection = exponent(maxval(abs(alpha))) + exponent(load)
    if (deflection > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'alpha times load reaches 2**'//text(deflection) &
                  //': choose units in which it is smaller')
    end if
  end subroutine check_magnitudes

  !> Fill the report from the certificate; above the tolerance it is a warning.
  subroutine certify(operator, problem, answer, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: answer
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_violation) :: violation
    integer :: status

    call fuge_residual(operator, problem, answer, violation, status)
    if (status /= FUGE_DONE) then
      call report(info, status, 'certificate: '//fuge_status_text(status))
      return
    end if
    info%products = info%products + 1
    info%contacts = count(answer%force > 0.0_dp)
    info%residual = violation%worst()
    if (info%residual > tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' is above the tolerance ' &
                  //text(tolerance)//': alpha may be too badly conditioned for double precision')
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
    approach = solution%rigid(1)
  end subroutine fuge_solve_dense

end module fuge_solver_type
