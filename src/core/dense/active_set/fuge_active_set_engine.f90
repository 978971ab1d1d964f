!> The active-set engine: from checked data, and a guess of the contact set if there is one, to a solution and
!> its status in words.
module fuge_active_set_engine
  use fuge_ambiguous_forces, only: find_ambiguous_forces, mark_touching
  use fuge_block_pivoting, only: run_block_pivoting
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_engine_messages, only: explain_status, report_closed_gap, SINGULAR_ON_CONTACT, SINGULAR_WHERE_TOUCHING
  use fuge_initial_set, only: guess_initial_set
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_matrix_checks, only: check_largest, check_pairs
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: index_text
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_refinement_error, only: LARGEST
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_WARN_NOT_UNIQUE, FUGE_ERR_NOT_DEFINITE
  use fuge_unbounded_forces, only: equal_forces_hold_nothing, forces_are_unbounded
  use fuge_unresisted_motions, only: report_unresisted_motion
  use fuge_working_set, only: working_set
  implicit none
  private

  public :: solve_by_active_set, solve_from_set

  !> Ratio of the pivots above which it is checked whether the forces store any energy.
  real(dp), parameter :: NEARLY_SINGULAR = 1.0e8_dp

contains

  !> Solve by block principal pivoting.
  !>
  !> `canonical` with its matrix; `solution` allocated, its state (n) a guess on entry, or all open if there is
  !> none; on return solution and `factor` belong together. `kept` as in `run_block_pivoting`. Errors in `info`.
  subroutine solve_by_active_set(canonical, options, monitor, factor, solution, info, kept)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(working_set), intent(inout), optional :: kept
    integer :: sets

    call check_largest(canonical%survey%largest(), canonical%largest_load(), info)
    ! Opposite forces are in equilibrium only where all modes move both points alike.
    if (canonical%plain .and. .not. (canonical%survey%pairs_hold .or. info%failed())) then
      call check_pairs(canonical%alpha, info)
    end if
    if (info%failed()) return
    ! A guess from another problem may name stops and points that this one does not have.
    where (canonical%excluded) solution%state = FUGE_OPEN
    where (canonical%upper >= huge(1.0_dp)) solution%state = max(solution%state, FUGE_OPEN)
    if (canonical%has_limits()) then
      where (canonical%limit >= huge(1.0_dp)) solution%state = min(solution%state, FUGE_AT_LOWER_STOP)
      where (canonical%limit_upper >= huge(1.0_dp)) solution%state = max(solution%state, FUGE_AT_UPPER_STOP)
    else
      solution%state = min(max(solution%state, FUGE_AT_UPPER_STOP), FUGE_AT_LOWER_STOP)
    end if
    if (all(solution%state == FUGE_OPEN)) call make_guess(canonical, solution%state, info%products)
    call solve_from_set(canonical, iteration_limit(options, size(solution%state) + 1), monitor, factor, solution, &
                        sets, info, kept)
    info%iterations = sets
  end subroutine solve_by_active_set

  !> A first contact set; where projected gradients find none, the points that carry the load or overlap.
  subroutine make_guess(canonical, state, products)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(out) :: state(:)
    integer, intent(inout) :: products

    if (canonical%plain) then
      state = FUGE_AT_LOWER_STOP
    else
      state = merge(FUGE_AT_LOWER_STOP, FUGE_OPEN, abs(canonical%feasible_force) > 0.0_dp .or. canonical%gap < 0.0_dp)
    end if
    call guess_initial_set(canonical, state, products)
  end subroutine make_guess

  !> From a contact set, guessed or found by the tableau, to the solution and its status in words. `sets` counts the
  !> sets tried, `kept` as in `run_block_pivoting`.
  subroutine solve_from_set(canonical, limit, monitor, factor, solution, sets, info, kept)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    integer, intent(out) :: sets
    type(fuge_info), intent(inout) :: info
    type(working_set), intent(inout), optional :: kept
    integer :: more, status

    call run_block_pivoting(canonical, limit, monitor, factor, solution, sets, status, kept)
    if (status == FUGE_DONE .and. factor%regularisation > 0.0_dp) then
      ! A set tried on the way was singular; the last one need not be.
      factor = kkt_factor()
      call run_block_pivoting(canonical, limit, monitor, factor, solution, more, status, kept)
      sets = sets + more
    end if
    call explain_status(status, limit, count(solution%state /= FUGE_OPEN), info)
    if (status == FUGE_DONE .and. (factor%pivot_ratio > NEARLY_SINGULAR .or. factor%regularisation > 0.0_dp)) then
      call refuse_unbounded(canonical, solution, info)
      if (info%failed()) return
    end if
    if (status == FUGE_DONE) call report_not_unique(canonical, factor, solution, info)
  end subroutine solve_from_set

  !> Warn where the forces are not unique (FUGE_WARN_NOT_UNIQUE), or a motion is not. Error: FUGE_ERR_MEMORY.
  subroutine report_not_unique(canonical, factor, solution, info)
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: status
    logical :: ambiguous, open_ones, touching(size(solution%state))

    if (factor%regularisation > 0.0_dp) then
      call report(info, FUGE_WARN_NOT_UNIQUE, SINGULAR_ON_CONTACT)
    else
      call mark_touching(canonical, solution, touching, open_ones)
      ambiguous = open_ones
      if (open_ones) then
        call find_singularity(canonical, factor, touching, ambiguous, status)
        call require_memory(status, 'the test whether forces are unique', info)
        if (info%failed()) return
      end if
      if (ambiguous) call find_ambiguous_forces(canonical, solution, touching, ambiguous, info)
      if (info%failed()) return
      if (ambiguous) then
        solution%force_error = LARGEST
        call report(info, FUGE_WARN_NOT_UNIQUE, SINGULAR_WHERE_TOUCHING)
      end if
    end if
    if (.not. canonical%plain) call report_unresisted_motion(canonical, solution, info)
  end subroutine report_not_unique

  !> Is alpha `singular` on the points of a set (n) near that of the `factor`? `status` is not FUGE_DONE without memory.
  subroutine find_singularity(canonical, factor, set, singular, status)
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    logical, intent(in) :: set(:)
    logical, intent(out) :: singular
    integer, intent(out) :: status
    type(kkt_factor), allocatable :: trial

    singular = .false.
    allocate (trial, source=factor, stat=status)
    if (status /= 0) return
    ! Each trial would invert anew.
    trial%expects_solves = .false.
    call trial%set(canonical, set, status)
    singular = status == FUGE_ERR_NOT_DEFINITE .or. (status == FUGE_DONE .and. trial%regularisation > 0.0_dp)
    if (status == FUGE_ERR_NOT_DEFINITE) status = FUGE_DONE
  end subroutine find_singularity

  !> Refuse forces that would have to grow without bound (FUGE_ERR_NOT_DEFINITE, or FUGE_ERR_NO_EQUILIBRIUM where all
  !> motions are prescribed and the forces are equal).
  subroutine refuse_unbounded(canonical, solution, info)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info

    if (.not. forces_are_unbounded(canonical, solution)) return
    if (equal_forces_hold_nothing(canonical, solution)) then
      call report_closed_gap(-sum(canonical%gap)/real(size(canonical%gap), dp), [0, 0], info)
      return
    end if
    call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is singular, and there is no solution: forces that store no ' &
                //'energy, the largest at point '//index_text(maxloc(abs(solution%force), dim=1)) &
                //', cannot move the points to their stops; free the rigid motion that can, or change the gaps')
  end subroutine refuse_unbounded

end module fuge_active_set_engine
