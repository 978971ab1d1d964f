!> The primal active-set method for forces with limits, and the exchanges of block pivoting for them.
!>
!> As `fuge_primal_active_set`, but a step may also end where a force reaches its limit: that point gives way from then
!> on. At the solution of a set the point furthest on the wrong side of its stop comes back to it, be it an open one
!> beyond the stop or a limited one before it (J. Nocedal, S. J. Wright, Numerical Optimization, 2006, section 16.5).
!> The energy falls with every point that comes back, so the method ends.
module fuge_limited_active_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_displacements, only: displacement_magnitude_at
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_primal_active_set, only: joined_stop, NOISE
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  use fuge_working_set, only: working_set, SIGN_TOLERANCE
  implicit none
  private

  public :: exchange_limited, keep_beyond_stops, keep_in_range, run_limited_active_set

  !> Where the method stands.
  type :: descent
    !> Forces in equilibrium and within their limits, (n).
    real(dp), allocatable :: force(:)
    !> The point that has just come back to a stop, 0 if none has, and the state that it had before.
    integer :: newest = 0, before = FUGE_OPEN
    !> Points that came back by rounding: not again until the forces have changed, (n).
    logical, allocatable :: locked(:)
    !> Steps in turn that have not changed the forces.
    integer :: stalls = 0
    !> Rounding has led nowhere, or may lead in a circle: more of it is allowed.
    logical :: lenient = .false.
  end type descent

  !> Solutions of sets within limits, each of less energy than the one before but for rounding: one that comes again
  !> shows that rounding leads in a circle (R. P. Brent, BIT 20, 1980, compares with one earlier state only).
  type :: circle_watch
    !> The states and locks that later ones are compared with, (n), and after how many solutions they are replaced.
    integer, allocatable :: state(:)
    logical, allocatable :: locked(:)
    integer :: solutions = 0, replaced_after = 1, repeats = 0
  end type circle_watch

  !> A solution that comes again this many times, with the same locks, closes a circle.
  integer, parameter :: CIRCLE = 3
  !> In a circle, a gap beyond its stop by less than this fraction of all terms of the gap is rounding.
  real(dp), parameter :: MOST_ROUNDING = 1.0e-12_dp
  !> Unlike any state of a point.
  integer, parameter :: NO_STATE = huge(1)

contains

  !> Find the states from feasible forces. Arguments as for `run_primal_active_set`.
  subroutine run_limited_active_set(canonical, limit, monitor, set, factor, solution, iterations, status)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(working_set), intent(inout) :: set
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    integer, intent(inout) :: iterations
    integer, intent(out) :: status
    type(descent) :: now
    type(circle_watch) :: watch
    real(dp), dimension(size(solution%state)) :: least, most, previous, rounding
    logical :: outside(size(solution%state))

    call start_descent(canonical, solution%state, now)
    allocate (watch%state(size(least)), source=NO_STATE)
    allocate (watch%locked(size(least)), source=.false.)
    do
      call set%mark(canonical, solution%state)
      call factor%set(canonical, set%contact, status)
      if (status /= FUGE_DONE) return
      call set%solve(canonical, factor, solution)
      call set%refine(canonical, factor, factor%regularisation, solution)
      iterations = iterations + 1
      call set%measure(canonical, .true., solution)
      call tell_monitor(monitor, iterations, maxval(set%violation), count(solution%state /= FUGE_OPEN), status)
      if (status /= FUGE_DONE .or. all(set%violation <= SIGN_TOLERANCE)) return
      call canonical%force_range(solution%state, least, most)
      rounding = max(merge(NOISE, SIGN_TOLERANCE, now%lenient .or. now%stalls > size(least)) &
                     *canonical%force_scale(solution%force), set%zero_force)
      outside = set%contact .and. (least - solution%force > rounding .or. solution%force - most > rounding)
      previous = now%force
      if (any(outside)) then
        call step_to_limit(canonical, solution%force, least, most, outside, solution%state, now)
      else
        now%force = solution%force
        call watch_for_circle(solution%state, now%locked, watch)
        if (watch%repeats >= CIRCLE) then
          if (lacks_only_rounding(canonical, set, solution)) return
        end if
        call return_to_stop(canonical, set%violation, solution, now)
        if (now%newest == 0 .and. now%lenient) return
      end if
      now%stalls = merge(now%stalls + 1, 0, maxval(abs(now%force - previous)) <= NOISE*maxval(abs(now%force)))
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
    end do
  end subroutine run_limited_active_set

  !> Compare the solution of a set, its states and locks (n), with an earlier one.
  pure subroutine watch_for_circle(state, locked, watch)
    integer, intent(in) :: state(:)
    logical, intent(in) :: locked(:)
    type(circle_watch), intent(inout) :: watch
    logical :: again

    again = all(state == watch%state) .and. all(locked .eqv. watch%locked)
    if (again) watch%repeats = watch%repeats + 1
    watch%solutions = watch%solutions + 1
    if (watch%repeats > 0 .or. watch%solutions < watch%replaced_after) return
    watch%state = state
    watch%locked = locked
    watch%solutions = 0
    watch%replaced_after = 2*watch%replaced_after
  end subroutine watch_for_circle

  !> Are all gaps on the right side of their stops but for the rounding of their terms? The violations of `set` compare
  !> them with what is left where initial gaps and motions cancel.
  pure function lacks_only_rounding(canonical, set, solution) result(only)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(in) :: solution
    logical :: only
    real(dp) :: terms
    integer :: k

    only = .true.
    do k = 1, size(solution%state)
      if (set%contact(k) .or. canonical%excluded(k) .or. set%violation(k) <= SIGN_TOLERANCE) cycle
      terms = abs(set%reduced_gap(k)) + sum(abs(canonical%modes(k, :)*solution%motion)) &
              + displacement_magnitude_at(canonical%alpha, canonical%datum, abs(solution%force) > 0.0_dp, &
                                          solution%force, k)
      only = -canonical%slack(k, solution%state(k), solution%gap(k)) <= MOST_ROUNDING*terms
      if (.not. only) return
    end do
  end function lacks_only_rounding

  !> Start from the forces that are known to be in equilibrium, with the states (n) that belong to them.
  pure subroutine start_descent(canonical, state, now)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(out) :: state(:)
    type(descent), intent(out) :: now

    allocate (now%force, source=canonical%feasible_force)
    allocate (now%locked(size(state)), source=.false.)
    state = FUGE_OPEN
    where (now%force > 0.0_dp) state = FUGE_AT_LOWER_STOP
    where (now%force < 0.0_dp) state = FUGE_AT_UPPER_STOP
    where (canonical%is_tied()) state = FUGE_AT_LOWER_STOP
    where (now%force >= canonical%limit .and. state /= FUGE_OPEN) state = FUGE_LIMITED_LOWER
    where (now%force <= -canonical%limit_upper .and. state /= FUGE_OPEN) state = FUGE_LIMITED_UPPER
  end subroutine start_descent

  !> Go towards the `target` forces (n) until the first one reaches the end of its range, `least` to `most` (n): that
  !> point leaves its stop. `outside` (n) marks those whose target lies beyond. A point that has just come back and
  !> would leave at once came back by rounding and is locked.
  pure subroutine step_to_limit(canonical, target, least, most, outside, state, now)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: target(:), least(:), most(:)
    logical, intent(in) :: outside(:)
    integer, intent(inout) :: state(:)
    type(descent), intent(inout) :: now
    real(dp) :: fraction, step_length
    integer :: blocking, k

    if (returned_by_rounding(target, least, most, outside, now)) then
      now%locked(now%newest) = .true.
      state(now%newest) = now%before
      return
    end if
    step_length = 1.0_dp
    blocking = 0
    do k = 1, size(target)
      if (.not. outside(k)) cycle
      fraction = abs(nearest_in_range(target(k), least(k), most(k)) - now%force(k)) &
                 /max(abs(target(k) - now%force(k)), tiny(fraction))
      if (fraction >= step_length .and. blocking > 0) cycle
      step_length = min(fraction, 1.0_dp)
      blocking = k
    end do
    where (is_at_stop(state)) now%force = nearest_in_range(now%force + step_length*(target - now%force), least, most)
    now%force(blocking) = nearest_in_range(target(blocking), least(blocking), most(blocking))
    state(blocking) = next_state(canonical, blocking, state(blocking), target(blocking), 0.0_dp)
  end subroutine step_to_limit

  !> Has the newest point come back by rounding? Its target then lies beyond the end of the range where its force is.
  pure function returned_by_rounding(target, least, most, outside, now) result(by_rounding)
    real(dp), intent(in) :: target(:), least(:), most(:)
    logical, intent(in) :: outside(:)
    type(descent), intent(in) :: now
    logical :: by_rounding

    by_rounding = now%newest > 0
    if (by_rounding) by_rounding = outside(now%newest)
    if (.not. by_rounding) return
    associate (k => now%newest)
      by_rounding = abs(nearest_in_range(target(k), least(k), most(k)) - now%force(k)) <= 0.0_dp
    end associate
  end function returned_by_rounding

  !> At the solution of a set, the point furthest on the wrong side of its stop comes back to it; after many stalls the
  !> one of the least index, which ends circles. Where all such points are locked, they are tried once more with more
  !> rounding allowed.
  pure subroutine return_to_stop(canonical, violation, solution, now)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: violation(:)
    type(contact_solution), intent(inout) :: solution
    type(descent), intent(inout) :: now
    real(dp) :: wrong(size(violation))

    if (now%newest > 0) now%locked = now%locked .and. now%locked(now%newest)
    wrong = violation
    if (now%stalls > size(violation)) wrong = 1.0_dp
    now%newest = maxloc(wrong, dim=1, mask=violation > SIGN_TOLERANCE .and. .not. (is_at_stop(solution%state) &
                                                                                .or. now%locked))
    if (now%newest > 0) then
      now%before = solution%state(now%newest)
      solution%state(now%newest) = next_state(canonical, now%newest, now%before, 0.0_dp, solution%gap(now%newest))
    else if (any(now%locked)) then
      now%lenient = .true.
      now%locked = .false.
      now%newest = maxloc(wrong, dim=1, mask=violation > SIGN_TOLERANCE .and. .not. is_at_stop(solution%state))
      if (now%newest == 0) return
      now%before = solution%state(now%newest)
      solution%state(now%newest) = next_state(canonical, now%newest, now%before, 0.0_dp, solution%gap(now%newest))
    else
      now%lenient = .true.
    end if
  end subroutine return_to_stop

  !> The state of point `k` after the one whose conditions its `force` or its `gap` has violated.
  pure function next_state(canonical, k, state, force, gap) result(next)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k, state
    real(dp), intent(in) :: force, gap
    integer :: next
    logical :: is_tied

    is_tied = .not. canonical%upper(k) > 0.0_dp
    select case (state)
    case (FUGE_AT_LOWER_STOP)
      next = merge(FUGE_LIMITED_LOWER, merge(FUGE_LIMITED_UPPER, FUGE_OPEN, is_tied), force > 0.0_dp)
    case (FUGE_AT_UPPER_STOP)
      next = merge(FUGE_LIMITED_UPPER, FUGE_OPEN, force < 0.0_dp)
    case (FUGE_LIMITED_LOWER)
      next = FUGE_AT_LOWER_STOP
    case (FUGE_LIMITED_UPPER)
      next = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, is_tied)
    case default
      next = FUGE_AT_UPPER_STOP
      if (canonical%pushes(k)) next = joined_stop(gap, canonical%upper(k))
    end select
  end function next_state

  !> Block pivoting: every point that is `wrong` (n) goes to its next state.
  pure subroutine exchange_limited(canonical, wrong, solution)
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: wrong(:)
    type(contact_solution), intent(inout) :: solution
    integer :: k

    do k = 1, size(wrong)
      if (wrong(k)) solution%state(k) = next_state(canonical, k, solution%state(k), solution%force(k), solution%gap(k))
    end do
  end subroutine exchange_limited

  !> Take rounding out of forces (n): none is beyond the range of its state (n).
  pure subroutine keep_in_range(canonical, state, force)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp) :: least(size(state)), most(size(state))

    call canonical%force_range(state, least, most)
    force = nearest_in_range(force, least, most)
  end subroutine keep_in_range

  !> Take rounding out of the gaps: open points lie between their stops, limited ones beyond theirs.
  pure subroutine keep_beyond_stops(canonical, solution)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(inout) :: solution
    integer :: k

    do k = 1, size(solution%state)
      if (canonical%excluded(k)) cycle
      associate (gap => solution%gap(k), upper => canonical%upper(k))
        select case (solution%state(k))
        case (FUGE_OPEN)
          gap = min(gap, upper)
          if (canonical%pushes(k)) gap = max(gap, 0.0_dp)
        case (FUGE_LIMITED_LOWER)
          gap = min(gap, 0.0_dp)
        case (FUGE_LIMITED_UPPER)
          gap = max(gap, upper)
        end select
      end associate
    end do
  end subroutine keep_beyond_stops

  !> The value between `least` and `most` that is nearest.
  elemental function nearest_in_range(value, least, most) result(nearest)
    real(dp), intent(in) :: value, least, most
    real(dp) :: nearest

    nearest = min(max(value, least), most)
  end function nearest_in_range

end module fuge_limited_active_set
