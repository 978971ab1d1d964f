!> Bounds of the tableau's variables: which are free of sign, which have an upper bound, and the order in which ties
!> are broken.
!>
!> The law of a point is a staircase, and every point is described from one of its corners, by two variables that are
!> zero there, never negative, and never both positive:
!>
!>     corner                 at            force variable   at most   gap variable   at most
!>     FUGE_LIMITED_LOWER     f = u, c = 0  u - f            u         -c             infinite
!>     FUGE_AT_LOWER_STOP     f = 0, c = 0  f                u         c              d
!>     FUGE_AT_UPPER_STOP     f = 0, c = d  -f               l         d - c          d
!>     FUGE_LIMITED_UPPER     f = -l, c = d l + f            l         c - d          infinite
!>
!> A variable that reaches its bound leads to the next corner: the force to the one across it, the gap likewise, and
!> both variables change their signs. The force of a tied point with limits runs over both inner corners at once, from 0
!> to u + l. Where the lower stop has no force, d - c has no bound.
module fuge_variable_bounds
  use fuge_column_numbers, only: gap_column, is_force, is_gap, point_of, stored_columns
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  type, public :: variable_bounds
    !> Number of points and of free modes.
    integer :: n = 0, m = 0
    !> The corner of each point, (n), by the state next to it.
    integer, allocatable :: corner(:)
    !> Bounds of the gap and of the force of each point as described from its corner, (n), in the tableau's units; huge
    !> where there is none.
    real(dp), allocatable :: upper(:), limit(:)
    !> Variables of either sign, which may enter in both senses and never leave, (3n+2m).
    logical, allocatable :: free(:)
    !> Variables fixed at zero, which never enter, (3n+2m).
    logical, allocatable :: fixed(:)
    !> Columns of the first basis in equilibrium, with the sign in which the tableau has them: gaps instead of
    !> their artificials, then forces, (n+m). The paper's problem needs only the gaps, (n).
    integer, allocatable :: first(:)
    real(dp), allocatable :: sign(:)
    !> Play d of each point and the limits u and l of its forces, (n), in the tableau's units.
    real(dp), allocatable, private :: play(:), limit_lower(:), limit_upper(:)
  contains
    procedure :: set
    procedure :: set_law
    procedure :: turn_corner
    procedure :: touching_state
    procedure :: upper_bound
  end type variable_bounds

contains

  !> The bounds of the paper's problem: nothing is negative, nothing has an upper bound. `ties` is the number of
  !> columns that break ties. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine set(self, n, m, ties, status)
    class(variable_bounds), intent(inout) :: self
    integer, intent(in) :: n, m, ties
    integer, intent(out) :: status
    integer :: k, stat

    if (allocated(self%upper)) deallocate (self%corner, self%upper, self%limit, self%free, self%fixed, self%first, &
                                           self%sign, self%play, self%limit_lower, self%limit_upper)
    self%n = n
    self%m = m
    allocate (self%corner(n), self%upper(n), self%limit(n), self%free(stored_columns(n, m) + n + m), &
              self%fixed(stored_columns(n, m) + n + m), self%first(ties), self%sign(ties), self%play(n), &
              self%limit_lower(n), self%limit_upper(n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    self%corner = FUGE_AT_LOWER_STOP
    self%upper = huge(1.0_dp)
    self%limit = huge(1.0_dp)
    self%play = huge(1.0_dp)
    self%limit_lower = huge(1.0_dp)
    self%limit_upper = huge(1.0_dp)
    self%free = .false.
    self%fixed = .false.
    self%first = 0
    self%first(:n) = gap_column(n, [(k, k=1, n)])
    self%sign = 1.0_dp
  end subroutine set

  !> Set the play d of a point and the limits u and l of its forces at both stops, in the tableau's units, huge where
  !> there is none. The point is at its lower stop without force.
  pure subroutine set_law(self, point, play, limit_lower, limit_upper)
    class(variable_bounds), intent(inout) :: self
    integer, intent(in) :: point
    real(dp), intent(in) :: play, limit_lower, limit_upper

    self%play(point) = play
    self%limit_lower(point) = limit_lower
    self%limit_upper(point) = limit_upper
    self%corner(point) = FUGE_AT_LOWER_STOP
    call set_bounds_of_corner(self, point)
  end subroutine set_law

  !> Go to the corner where the variable in `column`, a gap or a force, is at its bound.
  pure subroutine turn_corner(self, column)
    class(variable_bounds), intent(inout) :: self
    integer, intent(in) :: column

    associate (point => point_of(self%n, column))
      if (is_force(self%n, column)) then
        self%corner(point) = corner_across_force(self%corner(point), .not. self%play(point) > 0.0_dp)
      else
        self%corner(point) = merge(FUGE_AT_UPPER_STOP, FUGE_AT_LOWER_STOP, self%corner(point) == FUGE_AT_LOWER_STOP)
      end if
      call set_bounds_of_corner(self, point)
    end associate
  end subroutine turn_corner

  !> The corner across the range of the force; the inner ones of a `tied` point are passed over.
  elemental function corner_across_force(corner, tied) result(across)
    integer, intent(in) :: corner
    logical, intent(in) :: tied
    integer :: across

    select case (corner)
    case (FUGE_LIMITED_LOWER)
      across = merge(FUGE_LIMITED_UPPER, FUGE_AT_LOWER_STOP, tied)
    case (FUGE_AT_LOWER_STOP)
      across = FUGE_LIMITED_LOWER
    case (FUGE_AT_UPPER_STOP)
      across = FUGE_LIMITED_UPPER
    case default
      across = merge(FUGE_LIMITED_LOWER, FUGE_AT_UPPER_STOP, tied)
    end select
  end function corner_across_force

  !> The bounds that the variables of a point have at its corner.
  pure subroutine set_bounds_of_corner(self, point)
    class(variable_bounds), intent(inout) :: self
    integer, intent(in) :: point

    associate (corner => self%corner(point), limit_lower => self%limit_lower(point), &
               limit_upper => self%limit_upper(point))
      self%upper(point) = huge(1.0_dp)
      if (is_at_stop(corner)) self%upper(point) = self%play(point)
      if (corner == FUGE_AT_UPPER_STOP .and. .not. limit_lower > 0.0_dp) self%upper(point) = huge(1.0_dp)
      self%limit(point) = merge(limit_lower, limit_upper, corner > 0)
      if (self%play(point) > 0.0_dp .or. is_at_stop(corner)) return
      self%limit(point) = huge(1.0_dp)
      if (max(limit_lower, limit_upper) < 0.5_dp*huge(1.0_dp)) self%limit(point) = limit_lower + limit_upper
    end associate
  end subroutine set_bounds_of_corner

  !> The state of a point that touches next to its corner; a tied one is at its lower stop.
  elemental function touching_state(self, point) result(state)
    class(variable_bounds), intent(in) :: self
    integer, intent(in) :: point
    integer :: state

    state = FUGE_AT_LOWER_STOP
    if (self%corner(point) < 0 .and. self%play(point) > 0.0_dp) state = FUGE_AT_UPPER_STOP
  end function touching_state

  !> The largest value of the variable in `column`; huge if it has no upper bound.
  elemental function upper_bound(self, column) result(largest)
    class(variable_bounds), intent(in) :: self
    integer, intent(in) :: column
    real(dp) :: largest

    largest = huge(largest)
    if (is_force(self%n, column)) largest = self%limit(column)
    if (is_gap(self%n, column)) largest = self%upper(column - self%n)
  end function upper_bound

end module fuge_variable_bounds
