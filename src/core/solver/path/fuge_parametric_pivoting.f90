!> Parametric pivoting: the course of a contact along a straight line of problems, without load steps.
!>
!> Gaps and resultants change linearly with a parameter. Between two events forces, gaps and motions are linear in it
!> too. An event is a parameter at which points come to a corner of their law: to a stop, to no force or to a limit.
!> Which points change when several could, and how the next piece runs, follows from a small contact problem in the
!> rates of the weakly active points. Where no such rates exist, the motions that nothing resists jump.
module fuge_parametric_pivoting
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_law_corners, only: corner_sense, corners_of_state, distance_to_corner, has_touching_only, &
    law_corner, MOST_CORNERS, TOUCHING
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

    call start_path(position%state(:line%points), size(line%start), path, status)
    if (status /= FUGE_DONE) return
    do turn = 1, ITERATIONS_PER_ROW*(size(before) + 1)
      before = position%state
      call move_until_resisted(canonical, line%load_rate, position, status)
      if (status == FUGE_DONE) call find_rates(canonical, line, factor, position, status)
      if (status /= FUGE_DONE) return
      call position%keep_to_law(canonical)
      if (is_renewal_due(canonical, factor, position, turn)) then
        if (turn > 1) call certificate%add_end(position%parameter, position%force(:line%points), path)
        call renew_values(canonical, line, factor, position)
      end if
      if (turn == 1) call append_position(canonical, line, position, 0, path, status)
      if (status == FUGE_DONE) call append_changes(canonical, line, position, before, path, status)
      if (status == FUGE_DONE .and. all(position%state == before)) then
        call append_turn(canonical, line, position, path, status)
      end if
      if (status /= FUGE_DONE) return
      call certificate%add(position%parameter, position%force(:line%points), path)
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
    type(law_corner) :: reached(size(position%state))
    integer :: k
    real(dp) :: step, left

    left = line%last - position%parameter
    call find_next_event(canonical, position, left, step, reached)
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
    do k = 1, size(reached)
      if (reached(k)%stop_state /= FUGE_OPEN) call position%set_corner(k, reached(k))
    end do
  end subroutine go_to_next_event

  !> How far the next event is, at most `left`, and the points that come to a corner there: `reached` (n), no corner for
  !> the other points. Weakly active points move away from their corner.
  pure subroutine find_next_event(canonical, position, left, step, reached)
    type(canonical_problem), intent(in) :: canonical
    type(path_position), intent(in) :: position
    real(dp), intent(in) :: left
    real(dp), intent(out) :: step
    type(law_corner), intent(out) :: reached(:)
    type(law_corner) :: corners(MOST_CORNERS)
    real(dp) :: reach(size(reached)), value, rate
    integer :: i, k, number
    logical :: touching_only(size(reached))

    touching_only = has_touching_only(canonical)
    reach = left
    do k = 1, size(reached)
      if (touching_only(k)) then
        if (position%weakly_active(k) /= FUGE_OPEN) cycle
        if (position%state(k) == FUGE_OPEN) then
          call approach(position%gap(k), position%gap_rate(k), TOUCHING, reach(k), reached(k))
        else
          call approach(position%force(k), position%force_rate(k), TOUCHING, reach(k), reached(k))
        end if
        cycle
      end if
      call corners_of_state(canonical, k, position%state(k), corners, number)
      value = merge(position%force(k), position%gap(k), is_at_stop(position%state(k)))
      rate = merge(position%force_rate(k), position%gap_rate(k), is_at_stop(position%state(k)))
      do i = 1, number
        if (is_same(corners(i), position%corner(k))) cycle
        call approach(distance_to_corner(canonical, k, corners(i), position%state(k), value), &
                      corner_sense(corners(i))*rate, corners(i), reach(k), reached(k))
      end do
    end do
    step = minval(reach)
    where (reach > step) reached = law_corner()
  end subroutine find_next_event

  elemental function is_same(corner, other)
    type(law_corner), intent(in) :: corner, other
    logical :: is_same

    is_same = corner%stop_state == other%stop_state .and. corner%free_state == other%free_state
  end function is_same

  !> Where a distance >= 0 from a corner falls to zero before `reach`, lower that, and note the corner.
  pure subroutine approach(distance, rate, corner, reach, noted)
    real(dp), intent(in) :: distance, rate
    type(law_corner), intent(in) :: corner
    real(dp), intent(inout) :: reach
    type(law_corner), intent(inout) :: noted

    ! Not by a quotient that may overflow.
    if (.not. max(distance, 0.0_dp) < -rate*reach) return
    reach = max(distance, 0.0_dp)/abs(rate)
    noted = corner
  end subroutine approach

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
    call append_entry(path, position%parameter, point, position%state(:line%points), motion, rate, status)
  end subroutine append_position

end module fuge_parametric_pivoting
