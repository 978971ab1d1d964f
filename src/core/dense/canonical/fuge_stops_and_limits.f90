!> The stops of points and the limits of their forces, as the dense engines need them.
module fuge_stops_and_limits
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  public :: excess_over_range

  type, public :: stops_and_limits
    !> Play, (n), length; huge where one-sided.
    real(dp), allocatable :: upper(:)
    !> Limits of the forces at both stops, (n), force, huge where there is none; not allocated without limits.
    real(dp), allocatable :: limit(:), limit_upper(:)
    !> Points that take no part in the contact, (n): their forces are limited to zero.
    logical, allocatable :: excluded(:)
  contains
    procedure :: set_stops
    procedure :: is_tied
    procedure :: has_limits
    procedure :: pushes
    procedure :: slack
    procedure :: force_bounds
    procedure :: force_range
    procedure :: next_state
    procedure :: keep_in_range
    procedure :: keep_beyond_stops
  end type stops_and_limits

contains

  !> Set the stops and limits of a checked problem. `stat` as from allocate.
  pure subroutine set_stops(self, problem, stat)
    class(stops_and_limits), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    integer, intent(out) :: stat
    integer :: n

    n = problem%points()
    allocate (self%upper(n), self%excluded(n), stat=stat)
    if (stat /= 0) return
    self%upper = huge(1.0_dp)
    self%excluded = .false.
    if (allocated(problem%gap_upper)) self%upper = min(problem%gap_upper, huge(1.0_dp))
    if (allocated(problem%excluded)) self%excluded = problem%excluded
    if (problem%has_limits()) call set_limits(self, problem, stat)
  end subroutine set_stops

  !> Set the limits of the forces, and exclude the points that they leave no force. `stat` as from allocate.
  pure subroutine set_limits(self, problem, stat)
    class(stops_and_limits), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    integer, intent(out) :: stat
    integer :: n

    n = size(self%upper)
    allocate (self%limit(n), self%limit_upper(n), stat=stat)
    if (stat /= 0) return
    self%limit = huge(1.0_dp)
    self%limit_upper = huge(1.0_dp)
    if (allocated(problem%limit)) self%limit = min(problem%limit, huge(1.0_dp))
    if (allocated(problem%limit_upper)) self%limit_upper = min(problem%limit_upper, huge(1.0_dp))
    ! A stop without force is none.
    where (.not. self%limit_upper > 0.0_dp) self%upper = huge(1.0_dp)
    where (.not. (self%limit > 0.0_dp .or. self%upper < huge(1.0_dp))) self%excluded = .true.
  end subroutine set_limits

  !> Points whose gap stays zero whatever their force, (n).
  pure function is_tied(self) result(tied)
    class(stops_and_limits), intent(in) :: self
    logical :: tied(size(self%upper))

    tied = self%upper <= 0.0_dp .and. .not. self%excluded
  end function is_tied

  !> Do forces have limits?
  pure function has_limits(self)
    class(stops_and_limits), intent(in) :: self
    logical :: has_limits

    has_limits = allocated(self%limit)
  end function has_limits

  !> Has the lower stop of point `k` a force?
  pure function pushes(self, k)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in) :: k
    logical :: pushes

    pushes = .true.
    if (allocated(self%limit)) pushes = self%limit(k) > 0.0_dp
  end function pushes

  !> How far point `k`, which is not at a stop, is from the nearest one that it may come to, length: negative for an
  !> open point beyond a stop, and for a limited one before its stop.
  pure function slack(self, k, state, gap) result(length)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in) :: k, state
    real(dp), intent(in) :: gap
    real(dp) :: length

    select case (state)
    case (FUGE_LIMITED_LOWER)
      length = -gap
    case (FUGE_LIMITED_UPPER)
      length = gap - self%upper(k)
    case default
      length = self%upper(k) - gap
      if (self%pushes(k)) length = min(length, gap)
    end select
  end function slack

  !> The least and the largest force of each point (n) at its stops, force; huge without a limit.
  pure subroutine force_bounds(self, least, most)
    class(stops_and_limits), intent(in) :: self
    real(dp), intent(out) :: least(:), most(:)

    least = -huge(1.0_dp)
    most = huge(1.0_dp)
    if (allocated(self%limit)) then
      least = -self%limit_upper
      most = self%limit
    end if
    where (self%upper >= huge(1.0_dp)) least = 0.0_dp
    where (self%excluded)
      least = 0.0_dp
      most = 0.0_dp
    end where
  end subroutine force_bounds

  !> The least and the largest force of each point (n) in the state that it has, `state` (n), force. Open points have
  !> none, limited ones that of their limit, tied ones either sign.
  pure subroutine force_range(self, state, least, most)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in), contiguous :: state(:)
    real(dp), intent(out), contiguous :: least(:), most(:)
    real(dp) :: limit, limit_upper
    integer :: k

    limit = huge(limit)
    limit_upper = huge(limit_upper)
    do k = 1, size(state)
      least(k) = 0.0_dp
      most(k) = 0.0_dp
      if (state(k) == FUGE_OPEN) cycle
      if (allocated(self%limit)) then
        limit = self%limit(k)
        limit_upper = self%limit_upper(k)
      end if
      select case (state(k))
      case (FUGE_AT_LOWER_STOP)
        most(k) = limit
        if (.not. self%upper(k) > 0.0_dp) least(k) = -limit_upper
      case (FUGE_AT_UPPER_STOP)
        least(k) = -limit_upper
      case (FUGE_LIMITED_LOWER)
        least(k) = limit
        most(k) = limit
      case (FUGE_LIMITED_UPPER)
        least(k) = -limit_upper
        most(k) = -limit_upper
      end select
    end do
  end subroutine force_range

  !> How far a force is beyond the nearer end of its range, force: negative within, -huge without an end.
  elemental function excess_over_range(force, least, most) result(excess)
    real(dp), intent(in) :: force, least, most
    real(dp) :: excess

    excess = -huge(excess)
    if (least > -huge(least)) excess = least - force
    if (most < huge(most)) excess = max(excess, force - most)
  end function excess_over_range

  !> The state of point `k` after the one whose conditions its `force` or its `gap` has violated.
  pure function next_state(self, k, state, force, gap) result(next)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in) :: k, state
    real(dp), intent(in) :: force, gap
    integer :: next
    logical :: is_tied

    is_tied = .not. self%upper(k) > 0.0_dp
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
      next = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, self%pushes(k) .and. gap < 0.5_dp*self%upper(k))
    end select
  end function next_state

  !> Take rounding out of forces (n): none is beyond the range of its state (n).
  pure subroutine keep_in_range(self, state, force)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in) :: state(:)
    real(dp), intent(inout) :: force(:)
    real(dp) :: least(size(state)), most(size(state))

    call self%force_range(state, least, most)
    force = min(max(force, least), most)
  end subroutine keep_in_range

  !> Take rounding out of gaps (n): open points (n) lie between their stops, limited ones beyond theirs.
  pure subroutine keep_beyond_stops(self, state, gap)
    class(stops_and_limits), intent(in) :: self
    integer, intent(in) :: state(:)
    real(dp), intent(inout) :: gap(:)
    integer :: k

    do k = 1, size(state)
      if (self%excluded(k)) cycle
      select case (state(k))
      case (FUGE_OPEN)
        gap(k) = min(gap(k), self%upper(k))
        if (gap(k) < 0.0_dp) gap(k) = merge(0.0_dp, gap(k), self%pushes(k))
      case (FUGE_LIMITED_LOWER)
        gap(k) = min(gap(k), 0.0_dp)
      case (FUGE_LIMITED_UPPER)
        gap(k) = max(gap(k), self%upper(k))
      end select
    end do
  end subroutine keep_beyond_stops

end module fuge_stops_and_limits
