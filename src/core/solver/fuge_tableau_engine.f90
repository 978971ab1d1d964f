!> The engine that follows the paper: Phase I of the simplex method on the tableau, then the
!> forces solved anew on the contact set that it found.
module fuge_tableau_engine
  use fuge_active_set_engine, only: solve_from_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_definiteness, only: check_definite
  use fuge_engine_messages, only: explain_status, report_uncorrected
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_matrix_checks, only: check_largest
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: index_text
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_paper_tableau, only: run_phase_one
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: solve_by_tableau

  character(len=*), parameter :: PLAIN_FORCES = 'with zero sum'
  character(len=*), parameter :: GENERAL_FORCES = 'without resultant in the free motions'

contains

  !> Phase I finds the contact set. Forces and gaps are solved anew on it, which also corrects points that the
  !> rounding of the pivots misjudged.
  !>
  !> `canonical` with its matrix; `solution` allocated; solution and `factor` belong together on return. The pivots go
  !> to `history` if `options` ask for it. Errors in `info`.
  subroutine solve_by_tableau(canonical, options, monitor, history, factor, solution, info)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: limit, sets, status

    call check_solvable(canonical, info)
    if (info%failed()) return
    limit = iteration_limit(options, size(solution%state) + size(canonical%load))
    call run_phase_one(canonical, options, limit, monitor, history, solution%state, info%iterations, status)
    ! Only a limit that was asked for ends the solve; otherwise the set found so far is the guess.
    if (status == FUGE_ERR_ITERATION_LIMIT .and. options%max_iterations == 0) status = FUGE_DONE
    if (status /= FUGE_DONE) then
      call explain_status(status, limit, count(solution%state /= FUGE_OPEN), info)
    else
      ! The caller's limit is that of the pivots.
      limit = iteration_limit(fuge_options(), size(solution%state) + 1)
      call solve_from_set(canonical, limit, monitor, factor, solution, sets, info)
      if (info%status == FUGE_ERR_ITERATION_LIMIT) call report_uncorrected(info%iterations, limit, info)
    end if
  end subroutine solve_by_tableau

  !> Refuse what the tableau does not solve: numbers that overflow (FUGE_ERR_OVERFLOW), an alpha without a unique
  !> solution (FUGE_ERR_NOT_DEFINITE). A point with limits may have any force between them, so all points that have a
  !> force at all count; those whose limits are zero are excluded. Where every force is limited there is a solution
  !> even so.
  subroutine check_solvable(canonical, info)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_info), intent(inout) :: info
    integer :: deficient, status

    associate (alpha => canonical%alpha(:size(canonical%gap), :))
      call check_largest(canonical%survey%largest(), canonical%largest_load(), info)
      if (info%failed() .or. all_forces_are_bounded(canonical)) return
      call check_definite(alpha, merge(0.0_dp, canonical%datum, canonical%plain), canonical%modes, canonical%excluded, &
                          deficient, status)
    end associate
    call require_memory(status, 'a factor of alpha', info)
    if (status /= FUGE_DONE .or. deficient == 0) return
    if (canonical%has_limits()) then
      call report_deficient('FUGE_ACTIVE_SET takes them up to their limits')
    else
      call report_deficient('look for a repeated point or a wrong sign at point '//index_text(deficient))
    end if

  contains

    subroutine report_deficient(remedy)
      character(len=*), intent(in) :: remedy

      call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite on forces '//kind_of_forces(canonical) &
                  //': point '//index_text(deficient)//' and others carry some that store no energy; '//remedy)
    end subroutine report_deficient

  end subroutine check_solvable

  !> Has every force limits at the stops that there are?
  pure function all_forces_are_bounded(canonical) result(bounded)
    type(canonical_problem), intent(in) :: canonical
    logical :: bounded

    bounded = canonical%has_limits()
    if (bounded) bounded = all(canonical%excluded .or. (canonical%limit < huge(1.0_dp) .and. &
                               (canonical%upper >= huge(1.0_dp) .or. canonical%limit_upper < huge(1.0_dp))))
  end function all_forces_are_bounded

  pure function kind_of_forces(canonical) result(words)
    type(canonical_problem), intent(in) :: canonical
    character(len=merge(len(PLAIN_FORCES), len(GENERAL_FORCES), canonical%plain)) :: words

    words = GENERAL_FORCES
    if (canonical%plain) words = PLAIN_FORCES
  end function kind_of_forces

end module fuge_tableau_engine
