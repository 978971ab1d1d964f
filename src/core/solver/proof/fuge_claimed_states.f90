!> What the states of a solution say: which forces are known, which gaps, and the ranges of the others.
module fuge_claimed_states
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_point_law, only: point_law
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: claim_point, state_by_law, state_of

  !> The claim about a point: its gap is that of a stop, and its force within a range, or its force is known, and its
  !> gap within a range. Infinite ends are huge.
  type, public :: point_claim
    logical :: at_stop = .false.
    !> The gap at the stop, or the force.
    real(dp) :: known = 0.0_dp
    !> The range of the force, or of the gap. Ends belong to neighbouring states.
    real(dp) :: least = -huge(1.0_dp), most = huge(1.0_dp)
  end type point_claim

contains

  !> The state of point `k` that the solution says, if it has states; else the one that is next to its force.
  pure function state_of(problem, solution, k) result(state)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: k
    integer :: state
    type(point_law) :: law
    real(dp) :: force

    if (allocated(solution%state)) then
      if (size(solution%state) == size(solution%force)) then
        state = solution%state(lbound(solution%state, 1) + k - 1)
        return
      end if
    end if
    law = problem%law(k)
    force = solution%force(lbound(solution%force, 1) + k - 1)
    state = FUGE_OPEN
    if (force > 0.0_dp) then
      state = merge(FUGE_LIMITED_LOWER, FUGE_AT_LOWER_STOP, force >= law%limit)
    else if (force < 0.0_dp) then
      state = merge(FUGE_LIMITED_UPPER, FUGE_AT_UPPER_STOP, -force >= law%limit_upper)
    end if
    state = state_by_law(law, state)
  end function state_of

  !> A state that the `law` has, `state` if it does: no stop without a play, no limit that is infinite, and no stop or
  !> limit of a point that cannot have a force.
  pure function state_by_law(law, state) result(possible)
    type(point_law), intent(in) :: law
    integer, intent(in) :: state
    integer :: possible

    possible = state
    if (possible < FUGE_LIMITED_UPPER .or. possible > FUGE_LIMITED_LOWER) possible = FUGE_OPEN
    if (possible == FUGE_LIMITED_LOWER .and. .not. law%limit < huge(1.0_dp)) possible = FUGE_AT_LOWER_STOP
    if (possible == FUGE_LIMITED_UPPER .and. .not. law%limit_upper < huge(1.0_dp)) possible = FUGE_AT_UPPER_STOP
    if (possible < 0 .and. .not. law%play < huge(1.0_dp)) possible = FUGE_OPEN
    if (possible == FUGE_AT_UPPER_STOP .and. .not. law%play > 0.0_dp) possible = FUGE_AT_LOWER_STOP
    ! Beyond a stop that takes no force a point is open, as in a solve; a tied one is limited below it.
    if (possible == FUGE_LIMITED_UPPER .and. .not. law%limit_upper > 0.0_dp) possible = FUGE_OPEN
    if (any(possible == [FUGE_OPEN, FUGE_LIMITED_LOWER]) .and. .not. law%limit > 0.0_dp) &
      possible = merge(FUGE_OPEN, FUGE_LIMITED_LOWER, law%play > 0.0_dp)
    ! A point that cannot have a force is open, as in a solve, whatever its gap.
    if (.not. max(law%limit, law%limit_upper) > 0.0_dp) possible = FUGE_OPEN
  end function state_by_law

  !> The claim that a point has `state`, which its `law` has.
  pure function claim_point(law, state) result(claim)
    type(point_law), intent(in) :: law
    integer, intent(in) :: state
    type(point_claim) :: claim

    if (is_at_stop(state)) then
      claim = claim_stop(law, state)
    else if (state == FUGE_LIMITED_LOWER) then
      claim = point_claim(.false., law%limit, -huge(1.0_dp), 0.0_dp)
    else if (state == FUGE_LIMITED_UPPER) then
      claim = point_claim(.false., -law%limit_upper, law%play, huge(1.0_dp))
    else
      claim = point_claim(.false., 0.0_dp, 0.0_dp, law%play)
      ! Where a stop takes no force, a point without one may be anywhere beyond it.
      if (.not. law%limit > 0.0_dp) claim%least = -huge(1.0_dp)
      if (.not. law%limit_upper > 0.0_dp) claim%most = huge(1.0_dp)
    end if
  end function claim_point

  !> The claim that a point is at the lower or the upper stop, as `state` says.
  pure function claim_stop(law, state) result(claim)
    type(point_law), intent(in) :: law
    integer, intent(in) :: state
    type(point_claim) :: claim

    claim%at_stop = .true.
    claim%least = 0.0_dp
    claim%most = 0.0_dp
    if (state > 0 .or. .not. law%play > 0.0_dp) claim%most = law%limit
    if (state < 0 .or. .not. law%play > 0.0_dp) claim%least = -law%limit_upper
    if (state < 0) claim%known = law%play
  end function claim_stop

end module fuge_claimed_states
