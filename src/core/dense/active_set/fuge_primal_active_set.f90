!> The primal active-set method, which ends: the energy falls with every point that comes to a stop.
!>
!> From feasible forces step towards the solution of the working set until a force would reach the end of its range,
!> where it becomes tensile or its limit: that point leaves its stop. At the solution the point furthest on the wrong
!> side of its stop comes back to it, be it an open one beyond the stop or a limited one before it; when there is none,
!> the solution solves the problem (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23;
!> J. Nocedal, S. J. Wright, Numerical Optimization, 2006, section 16.5).
module fuge_primal_active_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_displacements, only: displacement_magnitude_at
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  use fuge_stops_and_limits, only: excess_over_range
  use fuge_working_set, only: working_set, SIGN_TOLERANCE
  implicit none
  private

  public :: run_primal_active_set

  !> Changes of the forces, and violations, below this fraction may be rounding.
  real(dp), parameter, public :: NOISE = 1.0e-11_dp
  !> A solution that comes again this many times, with the same locks, closes a circle.
  integer, parameter :: CIRCLE = 3
  !> In a circle, a gap beyond its stop by less than this fraction of all terms of the gap is rounding.
  real(dp), parameter :: MOST_ROUNDING = 1.0e-12_dp
  !> Unlike any state of a point.
  integer, parameter :: NO_STATE = huge(1)

  !> Where the method stands.
  type :: descent
    !> Forces in equilibrium and within their ranges, (n).
    real(dp), allocatable :: force(:)
    !> The point that has just come to a stop, 0 if none has, and the state that it had before.
    integer :: newest = 0, before = FUGE_OPEN
    !> Points that came by rounding: not again until the forces have changed, (n).
    logical, allocatable :: locked(:)
    !> Of steps that have not changed the forces.
    type(stall_counter) :: stalls
    !> Rounding has led nowhere, or may lead in a circle: more of it is allowed.
    logical :: lenient = .false.
  end type descent

  !> Solutions of sets within their ranges, each of less energy than the one before but for rounding: one that comes
  !> again shows that rounding leads in a circle (R. P. Brent, BIT 20, 1980, compares with one earlier state only).
  type :: circle_watch
    !> The states and locks that later ones are compared with, (n), and after how many solutions they are replaced.
    integer, allocatable :: state(:)
    logical, allocatable :: locked(:)
    integer :: solutions = 0, replaced_after = 1, repeats = 0
  end type circle_watch

contains

  !> Find the contact set from the forces and states of `solution`.
  !>
  !> `set` belongs to the problem. On return `solution%state` is the set, with its `factor`, forces, gaps
  !> and motion. `iterations` grows by the sets tried, to at most `limit`. Errors as for `run_block_pivoting`.
  subroutine run_primal_active_set(canonical, limit, monitor, set, factor, solution, iterations, status)
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
    logical :: outside(size(solution%state)), stuck

    call start_descent(canonical, solution, now)
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
      rounding = excess_by_rounding(canonical, set, solution, now%lenient .or. now%stalls%has_stalled())
      outside = set%contact .and. excess_over_range(solution%force, least, most) > rounding
      previous = now%force
      if (any(outside)) then
        call step_to_end_of_range(canonical, solution%force, least, most, outside, solution%state, now)
      else
        now%force = solution%force
        call watch_for_circle(solution%state, now%locked, watch)
        if (watch%repeats >= CIRCLE) then
          if (lacks_only_rounding(canonical, set, solution)) return
        end if
        call return_to_stop(canonical, set%violation, solution, now, stuck)
        if (stuck) return
      end if
      call now%stalls%spend()
      if (.not. maxval(abs(now%force - previous)) <= NOISE*maxval(abs(now%force))) call now%stalls%renew()
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
    end do
  end subroutine run_primal_active_set

  !> Start from forces (n) in equilibrium and within their limits, with the states that belong to them: for the plain
  !> problem the compressive forces of the solution, scaled to the load; else those known from the start.
  pure subroutine start_descent(canonical, solution, now)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(inout) :: solution
    type(descent), intent(out) :: now

    if (canonical%plain) then
      now%force = max(solution%force, 0.0_dp)
      now%force = now%force*(canonical%load(1)/sum(now%force))
    else
      now%force = canonical%feasible_force
    end if
    allocate (now%locked(size(now%force)), source=.false.)
    call now%stalls%start(size(now%force))
    associate (state => solution%state)
      state = FUGE_OPEN
      where (now%force > 0.0_dp) state = FUGE_AT_LOWER_STOP
      where (now%force < 0.0_dp) state = FUGE_AT_UPPER_STOP
      where (canonical%is_tied()) state = FUGE_AT_LOWER_STOP
      if (.not. canonical%has_limits()) return
      where (now%force >= canonical%limit .and. state /= FUGE_OPEN) state = FUGE_LIMITED_LOWER
      where (now%force <= -canonical%limit_upper .and. state /= FUGE_OPEN) state = FUGE_LIMITED_UPPER
    end associate
  end subroutine start_descent

  !> How far beyond the end of its range a force counts as rounding, (n), at a point that may alone resist a rigid mode;
  !> without that point the set would be wrong. Zero for one translation, which any point resists. Larger if `lenient`,
  !> where rounding has led nowhere or may lead in a circle.
  pure function excess_by_rounding(canonical, set, solution, lenient) result(rounding)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(in) :: solution
    logical, intent(in) :: lenient
    real(dp) :: rounding(size(solution%force))

    rounding = 0.0_dp
    if (canonical%plain) return
    rounding = max(merge(NOISE, SIGN_TOLERANCE, lenient)*canonical%force_scale(solution%force), set%zero_force)
  end function excess_by_rounding

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

  !> Go towards the `target` forces (n) until the first one reaches the end of its range, `least` to `most` (n): that
  !> point leaves its stop. `outside` (n) marks those whose target lies beyond. A point that has just come and
  !> would leave at once came by rounding and is locked.
  pure subroutine step_to_end_of_range(canonical, target, least, most, outside, state, now)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: target(:), least(:), most(:)
    logical, intent(in) :: outside(:)
    integer, intent(inout) :: state(:)
    type(descent), intent(inout) :: now
    real(dp) :: fraction, step_length
    integer :: blocking, k

    if (came_by_rounding(target, least, most, outside, now)) then
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
    state(blocking) = canonical%next_state(blocking, state(blocking), target(blocking), 0.0_dp)
  end subroutine step_to_end_of_range

  !> Has the newest point come by rounding? Its target then lies beyond the end of the range where its force is.
  pure function came_by_rounding(target, least, most, outside, now) result(by_rounding)
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
  end function came_by_rounding

  !> At the solution of a set, the point furthest on the wrong side of its stop comes back to it; after many stalls the
  !> one of the least index, which ends circles (Y.-Y. Chang, R. W. Cottle, Mathematical Programming 18, 1980). Where
  !> all such points are locked, the excess that locked them was above SIGN_TOLERANCE, yet rounding, of resultants near
  !> the edge of those that the contact can carry: they are unlocked once with more rounding allowed; then it is
  !> `stuck`.
  pure subroutine return_to_stop(canonical, violation, solution, now, stuck)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: violation(:)
    type(contact_solution), intent(inout) :: solution
    type(descent), intent(inout) :: now
    logical, intent(out) :: stuck
    real(dp) :: beyond(size(violation))
    integer :: k

    stuck = .false.
    if (now%newest > 0) now%locked = now%locked .and. now%locked(now%newest)
    do k = 1, size(beyond)
      beyond(k) = -canonical%slack(k, solution%state(k), solution%gap(k))
    end do
    if (now%stalls%has_stalled()) beyond = 1.0_dp
    now%newest = maxloc(beyond, dim=1, mask=violation > SIGN_TOLERANCE .and. .not. (is_at_stop(solution%state) &
                                                                                 .or. now%locked))
    if (now%newest > 0) then
      now%before = solution%state(now%newest)
      solution%state(now%newest) = canonical%next_state(now%newest, now%before, 0.0_dp, solution%gap(now%newest))
    else
      stuck = now%lenient .or. .not. any(now%locked)
      now%lenient = .true.
      now%locked = .false.
    end if
  end subroutine return_to_stop

  !> The value between `least` and `most` that is nearest.
  elemental function nearest_in_range(value, least, most) result(nearest)
    real(dp), intent(in) :: value, least, most
    real(dp) :: nearest

    nearest = min(max(value, least), most)
  end function nearest_in_range

end module fuge_primal_active_set
