!> Parametric pivoting: the course of a contact along a straight line of problems, without load steps.
!>
!> Gaps and resultants change linearly with a parameter. Between two events forces, gaps and motions are linear in it
!> too. An event is a parameter at which points come to a stop or leave it. Which points change when several could,
!> and how the next piece runs, follows from a small contact problem in the rates of the weakly active points. Where
!> no such rates exist, the motions that nothing resists jump.
module fuge_parametric_pivoting
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_path_certificate, only: path_certificate
  use fuge_path_factor, only: path_factor
  use fuge_path_jump, only: move_until_resisted
  use fuge_path_position, only: given_motions, load_line, path_position, ROUNDING
  use fuge_path_rates, only: find_rates, renew_values
  use fuge_path_type, only: append_entry, fuge_path, start_path
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: follow_line

  !> Values are renewed after this many events where the factor is well conditioned; else at every event.
  integer, parameter :: EVENTS_PER_RENEWAL = 64

contains

  !> Follow the line from the position to its end, or as far as equilibrium reaches.
  !>
  !> `canonical` with its matrix. `position` and `path` are left where the path ended; `certificate` started, on return
  !> it has seen all of the path. `status`: that of a factor, FUGE_ERR_MEMORY, FUGE_ERR_NO_EQUILIBRIUM beyond
  !> position%parameter, FUGE_ERR_ITERATION_LIMIT after more events than 50 for each point.
  subroutine follow_line(canonical, line, position, path, certificate, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(inout) :: position
    type(fuge_path), intent(inout) :: path
    type(path_certificate), intent(inout) :: certificate
    integer, intent(out) :: status
    type(path_factor) :: factor
    integer :: before(size(position%state))
    integer :: turn
    logical :: ended

    call start_path(position%state, size(line%start), path, status)
    if (status /= FUGE_DONE) return
    do turn = 1, ITERATIONS_PER_ROW*(size(before) + 1)
      before = position%state
      call move_until_resisted(canonical, line%load_rate, position, status)
      if (status == FUGE_DONE) call find_rates(canonical, line, factor, position, status)
      if (status /= FUGE_DONE) return
      where (position%state == FUGE_OPEN) position%force = 0.0_dp
      where (position%state /= FUGE_OPEN) position%gap = merge(0.0_dp, canonical%upper, position%state > FUGE_OPEN)
      if (is_renewal_due(canonical, factor, position, turn)) then
        if (turn > 1) call certificate%add_end(position%parameter, position%force, path)
        call renew_values(canonical, line, factor, position)
      end if
      if (turn == 1) call append_position(canonical, line, position, 0, path, status)
      if (status == FUGE_DONE) call append_changes(canonical, line, position, before, path, status)
      if (status == FUGE_DONE .and. all(position%state == before)) then
        call append_turn(canonical, line, position, path, status)
      end if
      if (status /= FUGE_DONE) return
      call certificate%add(position%parameter, position%force, path)
      call go_to_next_event(canonical, line, factor, position, ended)
      if (ended) return
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine follow_line

  !> Are the values to be solved for with the set of the piece that begins? They then belong to that set to the last
  !> digit, and so does the parameter of the next event. Not without any force, which is exact.
  pure function is_renewal_due(canonical, factor, position, turn) result(due)
    type(canonical_problem), intent(in) :: canonical
    type(path_factor), intent(in) :: factor
    type(path_position), intent(in) :: position
    integer, intent(in) :: turn
    logical :: due

    due = modulo(turn, EVENTS_PER_RENEWAL) == 0 .or. factor%needs_refinement(canonical)
    if (due) due = any(abs(position%force) > 0.0_dp)
  end function is_renewal_due

  !> Advance to the next event, or to the end of the line, and mark the points that may change there. Values are solved
  !> for anew if `renew` or if rounding could decide otherwise.
  subroutine go_to_next_event(canonical, line, factor, position, ended)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_factor), intent(in) :: factor
    type(path_position), intent(inout) :: position
    logical, intent(out) :: ended
    integer :: joining(size(position%state)), k
    real(dp) :: step, left

    left = line%last - position%parameter
    call find_next_event(canonical, position, left, step, joining)
    ended = .not. position%parameter + step < line%last - ROUNDING*(line%last + line%origin)
    position%parameter = merge(line%last, position%parameter + step, ended)
    if (ended) step = left
    position%force = position%force + step*position%force_rate
    position%gap = position%gap + step*position%gap_rate
    position%motion = position%motion + step*position%motion_rate
    if (ended .and. any(abs(position%force) > 0.0_dp)) call renew_values(canonical, line, factor, position)
    if (ended) return
    call position%mark_weakly_active(canonical, line, step)
    ! Those of the event itself, in spite of any rounding.
    do k = 1, size(joining)
      if (joining(k) /= FUGE_OPEN) position%weakly_active(k) = joining(k)
    end do
  end subroutine go_to_next_event

  !> How far the next event is, at most `left`, and the points that reach zero there: `stops` (n) has the stop at which
  !> they then are without force, and FUGE_OPEN for the other points. Weakly active points move away from zero.
  pure subroutine find_next_event(canonical, position, left, step, stops)
    type(canonical_problem), intent(in) :: canonical
    type(path_position), intent(in) :: position
    real(dp), intent(in) :: left
    real(dp), intent(out) :: step
    integer, intent(out) :: stops(:)
    real(dp) :: reach(size(stops))
    integer :: k

    reach = left
    stops = FUGE_OPEN
    do k = 1, size(stops)
      if (canonical%excluded(k) .or. .not. canonical%upper(k) > 0.0_dp) cycle
      associate (state => position%state(k), weak => position%weakly_active(k), gap => position%gap(k), &
                 gap_rate => position%gap_rate(k), upper => canonical%upper(k))
        if (state /= FUGE_OPEN) then
          if (weak == FUGE_OPEN) call approach_zero(state*position%force(k), state*position%force_rate(k), state, &
                                                    reach(k), stops(k))
        else if (gap_rate < 0.0_dp) then
          if (weak /= FUGE_AT_LOWER_STOP) call approach_zero(gap, gap_rate, FUGE_AT_LOWER_STOP, reach(k), stops(k))
        else if (upper < huge(upper)) then
          if (weak /= FUGE_AT_UPPER_STOP) call approach_zero(upper - gap, -gap_rate, FUGE_AT_UPPER_STOP, reach(k), &
                                                             stops(k))
        end if
      end associate
    end do
    step = minval(reach)
    where (reach > step) stops = FUGE_OPEN
  end subroutine find_next_event

  !> Where a value >= 0 reaches zero before `reach`, lower that, and note the stop.
  pure subroutine approach_zero(value, rate, stop_state, reach, noted)
    real(dp), intent(in) :: value, rate
    integer, intent(in) :: stop_state
    real(dp), intent(inout) :: reach
    integer, intent(inout) :: noted

    ! Not by a quotient that may overflow.
    if (.not. max(value, 0.0_dp) < -rate*reach) return
    reach = max(value, 0.0_dp)/abs(rate)
    noted = stop_state
  end subroutine approach_zero

  !> Append an entry for each point whose state has changed.
  subroutine append_changes(canonical, line, position, before, path, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    integer, intent(in) :: before(:)
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status
    integer :: k

    status = FUGE_DONE
    do k = 1, size(before)
      if (position%state(k) /= before(k)) call append_position(canonical, line, position, k, path, status)
      if (status /= FUGE_DONE) return
    end do
  end subroutine append_changes

  !> Append an entry for the first point that touches without force, if only its touching makes motions that nothing
  !> resists turn.
  subroutine append_turn(canonical, line, position, path, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status
    real(dp), parameter :: NO_TURN = 1.0e-10_dp
    real(dp), dimension(size(line%start)) :: motion, rate, last_rate

    status = FUGE_DONE
    if (.not. any(position%weakly_active /= FUGE_OPEN)) return
    call given_motions(canonical, line, position, motion, rate)
    last_rate = path%rate(:, path%entries)
    if (all(abs(rate - last_rate) <= NO_TURN*max(abs(rate), abs(last_rate)))) return
    call append_position(canonical, line, position, maxloc(abs(position%weakly_active), dim=1), path, status)
  end subroutine append_turn

  subroutine append_position(canonical, line, position, point, path, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    integer, intent(in) :: point
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status
    real(dp) :: motion(size(line%start)), rate(size(line%start))

    call given_motions(canonical, line, position, motion, rate)
    call append_entry(path, position%parameter, point, position%state, motion, rate, status)
  end subroutine append_position

end module fuge_parametric_pivoting
