!> The engine that follows the paper: Phase I of the simplex method on the tableau, then the
!> forces solved anew on the contact set that it found.
module fuge_tableau_engine
  use fuge_active_set_engine, only: solve_from
  use fuge_canonical_problem, only: canonical_problem
  use fuge_definiteness, only: check_definite
  use fuge_engine_messages, only: explain_status
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: contact_factor
  use fuge_matrix_checks, only: check_magnitudes
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_paper_tableau, only: run_phase_one
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: solve_by_tableau

  character(len=*), parameter :: PLAIN_FORCES = 'with zero sum'
  character(len=*), parameter :: GENERAL_FORCES = 'without resultant in the free motions'

contains

  !> The paper's engine: Phase I finds the contact set, and the numbers are solved
  !> anew on it, which also mends points that the rounding of the pivots misjudged.
  !>
  !> `alpha` (at least n rows, n columns), `datum` its coefficient nearest to zero, `canonical` of
  !> a checked problem; `state` (n) and `factor` belong to the answer on return.
  subroutine solve_by_tableau(alpha, datum, canonical, options, monitor, history, state, factor, answer, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    integer, intent(out) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    integer :: limit, sets, status

    state = 0
    call check_solvable(alpha, datum, canonical, info)
    if (info%failed()) return
    limit = iteration_limit(options, size(state) + size(canonical%load))
    call run_phase_one(alpha, datum, canonical, options%pivot_rule, limit, options%keep_history, monitor, history, &
                       state, &
                       info%iterations, status)
    ! Only a limit that was asked for ends the solve; otherwise the set so far will do.
    if (status == FUGE_ERR_ITERATION_LIMIT .and. options%max_iterations == 0) status = FUGE_DONE
    if (status /= FUGE_DONE) then
      call explain_status(status, limit, count(state /= 0), info)
    else
      call solve_from(alpha, datum, canonical, iteration_limit(fuge_options(), size(state) + 1), monitor, state, &
                      factor, &
                      answer, &
                      sets, info)
    end if
  end subroutine solve_by_tableau

  !> Refuse what the tableau does not solve: numbers that overflow
  !> (FUGE_ERR_OVERFLOW), an alpha without a unique answer (FUGE_ERR_NOT_DEFINITE).
  subroutine check_solvable(alpha, datum, canonical, info)
    real(dp), intent(in) :: alpha(:, :), datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant
    integer :: deficient, status

    call check_magnitudes(alpha(:size(alpha, 2), :), canonical%largest_load(), info)
    if (info%failed()) return
    constant = merge(datum, 0.0_dp, canonical%has_translation .and. .not. canonical%plain)
    call check_definite(alpha, constant, canonical%modes, canonical%excluded, deficient, status)
    if (status /= FUGE_DONE) then
      call report(info, status, 'no memory to factor alpha')
    else if (deficient > 0) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite on forces '//kind_of_forces(canonical) &
                  //': point '//text(deficient)//' and others carry some that store no energy; look for a repeated ' &
                  //'point or a wrong sign at point '//text(deficient))
    end if
  end subroutine check_solvable

  pure function kind_of_forces(canonical) result(words)
    type(canonical_problem), intent(in) :: canonical
    character(len=merge(len(PLAIN_FORCES), len(GENERAL_FORCES), canonical%plain)) :: words

    words = GENERAL_FORCES
    if (canonical%plain) words = PLAIN_FORCES
  end function kind_of_forces

end module fuge_tableau_engine
