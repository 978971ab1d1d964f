!> The corners of the law of a point, where it goes on from one step to the next: on one side the gap is that of a stop
!> and the force is free, on the other side the force is fixed and the gap is free.
!>
!> The fixed force is zero for an open point and a limit for one that gives way. Force and gap never grow together, so
!> at a corner both may change in one sense only, the same for both.
module fuge_law_corners
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_kinds, only: dp
  implicit none
  private

  public :: corner_sense, corners_of_state, distance_to_corner, fixed_force, fixed_gap, has_touching_only

  !> No step of a law has more corners than this.
  integer, parameter, public :: MOST_CORNERS = 2

  !> A corner: the state with the gap of a stop, and the one with a fixed force. Both are FUGE_OPEN for no corner.
  type, public :: law_corner
    integer :: stop_state = FUGE_OPEN, free_state = FUGE_OPEN
  end type law_corner

  !> The only corner of a one-sided point without a limit. Force and gap may grow from there on, and are zero there.
  type(law_corner), parameter, public :: TOUCHING = law_corner(FUGE_AT_LOWER_STOP, FUGE_OPEN)

contains

  !> The corners that point `k` may come to from its state; `number` of them.
  pure subroutine corners_of_state(canonical, k, state, corners, number)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k, state
    type(law_corner), intent(out) :: corners(MOST_CORNERS)
    integer, intent(out) :: number
    logical :: gives_way, slips, is_tied

    number = 0
    if (canonical%excluded(k)) return
    is_tied = .not. canonical%upper(k) > 0.0_dp
    gives_way = .false.
    slips = .false.
    if (canonical%has_limits()) then
      gives_way = canonical%limit(k) < huge(1.0_dp)
      slips = canonical%limit_upper(k) < huge(1.0_dp)
    end if
    select case (state)
    case (FUGE_AT_LOWER_STOP)
      if (.not. is_tied) call add(FUGE_AT_LOWER_STOP, FUGE_OPEN, corners, number)
      if (gives_way) call add(FUGE_AT_LOWER_STOP, FUGE_LIMITED_LOWER, corners, number)
      if (is_tied .and. slips) call add(FUGE_AT_LOWER_STOP, FUGE_LIMITED_UPPER, corners, number)
    case (FUGE_AT_UPPER_STOP)
      call add(FUGE_AT_UPPER_STOP, FUGE_OPEN, corners, number)
      if (slips) call add(FUGE_AT_UPPER_STOP, FUGE_LIMITED_UPPER, corners, number)
    case (FUGE_LIMITED_LOWER)
      call add(FUGE_AT_LOWER_STOP, FUGE_LIMITED_LOWER, corners, number)
    case (FUGE_LIMITED_UPPER)
      call add(merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, is_tied), FUGE_LIMITED_UPPER, corners, number)
    case default
      if (canonical%pushes(k)) call add(FUGE_AT_LOWER_STOP, FUGE_OPEN, corners, number)
      if (canonical%upper(k) < huge(1.0_dp)) call add(FUGE_AT_UPPER_STOP, FUGE_OPEN, corners, number)
    end select
  end subroutine corners_of_state

  !> Points (n) whose only corner is TOUCHING: most points of most problems, which need no search.
  pure function has_touching_only(canonical) result(only)
    type(canonical_problem), intent(in) :: canonical
    logical :: only(size(canonical%upper))

    only = canonical%upper >= huge(1.0_dp) .and. .not. canonical%excluded
    if (canonical%has_limits()) only = only .and. canonical%limit >= huge(1.0_dp)
  end function has_touching_only

  pure subroutine add(stop_state, free_state, corners, number)
    integer, intent(in) :: stop_state, free_state
    type(law_corner), intent(inout) :: corners(MOST_CORNERS)
    integer, intent(inout) :: number

    number = number + 1
    corners(number) = law_corner(stop_state, free_state)
  end subroutine add

  !> The sense, 1 or -1, in which force and gap may change at a corner; 0 for no corner.
  elemental function corner_sense(corner) result(sense)
    type(law_corner), intent(in) :: corner
    integer :: sense

    sense = corner%stop_state
    if (corner%free_state /= FUGE_OPEN) sense = -sign(1, corner%free_state)
  end function corner_sense

  !> The force of point `k` in a state whose force is fixed.
  pure function fixed_force(canonical, k, state) result(force)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k, state
    real(dp) :: force

    force = 0.0_dp
    if (state == FUGE_LIMITED_LOWER) force = canonical%limit(k)
    if (state == FUGE_LIMITED_UPPER) force = -canonical%limit_upper(k)
  end function fixed_force

  !> The gap of point `k` where `state` is on its own side of its stop: that of the stop.
  pure function fixed_gap(canonical, k, state) result(gap)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k, state
    real(dp) :: gap

    gap = 0.0_dp
    if (state < FUGE_OPEN) gap = canonical%upper(k)
  end function fixed_gap

  !> How far a point is from a corner of its state: a force at a stop, else a length; not negative but for rounding.
  pure function distance_to_corner(canonical, k, corner, state, value) result(distance)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k, state
    type(law_corner), intent(in) :: corner
    real(dp), intent(in) :: value
    real(dp) :: distance

    if (is_at_stop(state)) then
      distance = corner_sense(corner)*(value - fixed_force(canonical, k, corner%free_state))
    else
      distance = corner_sense(corner)*(value - fixed_gap(canonical, k, corner%stop_state))
    end if
  end function distance_to_corner

end module fuge_law_corners
