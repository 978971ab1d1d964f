!> The active-set engine: from checked data and a guess of the contact set to a solution and its status in words.
module fuge_active_set_engine
  use fuge_block_pivoting, only: run_active_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_engine_messages, only: explain_status
  use fuge_free_modes, only: find_free_way
  use fuge_initial_set, only: guess_contact_set
  use fuge_initial_states, only: guess_sides
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: contact_factor
  use fuge_matrix_checks, only: check_magnitudes, check_pairs
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_WARN_NOT_UNIQUE
  implicit none
  private

  public :: solve_by_active_set, solve_from

contains

  !> Block principal pivoting. `state` (n): on entry a guess, or none to have one made; on
  !> return the contact set, with its `factor`. `answer%motion` are the motions of the scene.
  subroutine solve_by_active_set(alpha, datum, canonical, options, monitor, state, factor, answer, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(inout) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    logical :: contact(size(state))
    integer :: sets

    call check_magnitudes(alpha(:size(alpha, 2), :), canonical%largest_load(), info)
    ! Opposite forces are in equilibrium only where all motions move both points alike.
    if (canonical%plain .and. .not. info%failed()) call check_pairs(alpha, info)
    if (info%failed()) return
    ! A guess from another problem may know of stops and points that are no more.
    where (canonical%excluded) state = 0
    where (canonical%upper >= huge(1.0_dp)) state = max(state, 0)
    if (.not. any(state /= 0)) then
      if (canonical%plain) then
        call guess_contact_set(alpha, canonical%gap, canonical%load(1), contact, info%products)
        state = merge(1, 0, contact)
      else
        state = merge(1, 0, abs(canonical%start) > 0.0_dp .or. canonical%gap < 0.0_dp)
        call guess_sides(alpha, canonical, state, info%products)
      end if
    end if
    call solve_from(alpha, datum, canonical, iteration_limit(options, size(state) + 1), monitor, state, factor, &
                    answer, sets, &
                    info)
    info%iterations = sets
  end subroutine solve_by_active_set

  !> From a contact set, found or guessed, to the answer and its words. `sets` counts
  !> those tried.
  subroutine solve_from(alpha, datum, canonical, limit, monitor, state, factor, answer, sets, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(inout) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    integer, intent(out) :: sets
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant
    integer :: more, status

    ! Without a translation nothing takes up a constant taken out of alpha.
    constant = merge(datum, 0.0_dp, canonical%has_translation)
    call run_active_set(alpha, constant, canonical, limit, monitor, factor, state, answer%force, answer%gap, &
                        answer%motion, sets, status)
    if (status == FUGE_DONE .and. factor%ridge > 0.0_dp) then
      ! A set tried on the way was singular; the last one need not be.
      factor = contact_factor()
      call run_active_set(alpha, constant, canonical, limit, monitor, factor, state, answer%force, answer%gap, &
                          answer%motion, more, status)
      sets = sets + more
    end if
    call explain_status(status, limit, count(state /= 0), info)
    if (status == FUGE_DONE .and. factor%ridge > 0.0_dp) then
      call report(info, FUGE_WARN_NOT_UNIQUE, 'alpha is singular on the contact: gaps and approach are unique, ' &
                  //'the forces are not; those given are near the least squares')
    else if (status == FUGE_DONE .and. .not. canonical%plain) then
      call report_free_way(canonical, state, answer, info)
    end if
  end subroutine solve_from

  !> Name a motion that the contact does not hold.
  subroutine report_free_way(canonical, state, answer, info)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    type(fuge_solution), intent(in) :: answer
    type(fuge_info), intent(inout) :: info
    real(dp) :: way(size(canonical%load))

    if (size(way) < 1) return
    call find_free_way(canonical, state, answer%force, answer%gap, way)
    if (.not. any(abs(way) > 0.0_dp)) return
    call report(info, FUGE_WARN_NOT_UNIQUE, 'the contact does not hold motion '//text(canonical%named_motion(way)) &
                //': its value, and the gaps that it moves, are one of many possible; the forces are unique')
  end subroutine report_free_way

end module fuge_active_set_engine
