!> A position on a line of loads: the values there, their rates from there on, and which of them are zero.
module fuge_path_position
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_law_corners, only: corner_sense, corners_of_state, distance_to_corner, fixed_force, fixed_gap, &
    has_touching_only, law_corner, MOST_CORNERS, TOUCHING
  use fuge_problem_type, only: fuge_problem
  use fuge_spring_matrix, only: find_spring_motions
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: given_motions, gaps_to_close, largest_force_of_body, largest_forces, load_at, position_at

  !> Forces below this fraction of the largest one of the body, and lengths below this fraction of their terms, are
  !> zero.
  real(dp), parameter, public :: ROUNDING = 1.0e-14_dp
  !> The same where the contact set is well conditioned, and values are not solved for anew at each event. Where it is
  !> not, as between close points of a beam, gaps of this size may be real.
  real(dp), parameter, public :: ROUNDING_OF_SUMS = 1.0e-12_dp

  !> A value that a step has reached is as exact as the step times its rate and this.
  real(dp), parameter :: LAST_DIGITS = 8.0_dp*epsilon(1.0_dp)

  !> A line of loads: the reduced gaps grow by reduced_gap_rate (n) and the resultants by load_rate (m) per unit of the
  !> parameter, from those of the problem up to `last`. Parameters are as exact as parameter + origin.
  type, public :: load_line
    real(dp), allocatable :: reduced_gap_rate(:), load_rate(:)
    real(dp) :: last = 0.0_dp, origin = 0.0_dp
    !> The caller's resultants, where prescribed the motions, at the start and their rates, (all modes).
    real(dp), allocatable :: start(:), rate(:)
    !> Taken out of the gaps of the problem, and so of its translation; length.
    real(dp) :: gap_datum = 0.0_dp
    !> The largest coefficient of alpha, length per force.
    real(dp) :: flexibility = 0.0_dp
    !> The points of the caller; behind them come those of springs on motions.
    integer :: points = 0
    !> The problem of the caller and the one with points for springs on motions; not allocated without such springs.
    type(fuge_problem), allocatable :: given, extended
  end type load_line

  !> Values at a parameter, and their rates from there on.
  type, public :: path_position
    real(dp) :: parameter = 0.0_dp
    !> State of each point, (n).
    integer, allocatable :: state(:)
    !> A weakly active point is at a corner of its law, as at a stop without force, where it may stay or not: `corner`
    !> (n), and its stop, weakly_active (n), which is FUGE_OPEN for all other points.
    integer, allocatable :: weakly_active(:)
    type(law_corner), allocatable :: corner(:)
    !> Forces and gaps (n), motions (m) and their rates.
    real(dp), allocatable :: force(:), gap(:), motion(:), force_rate(:), gap_rate(:), motion_rate(:)
    !> An orthonormal basis of the motions that the points at their stops do not resist, (m, any number).
    real(dp), allocatable :: unresisted(:, :)
    !> The fraction up to which values count as zero: ROUNDING or ROUNDING_OF_SUMS.
    real(dp) :: rounding = ROUNDING
    !> The rates are those with which the position was reached.
    logical :: has_rates = .false.
  contains
    procedure :: mark_weakly_active
    procedure :: sense
    procedure :: set_corner
    procedure :: keep_to_law
  end type path_position

contains

  !> The position at the start of a line, from a solution without its datums; `solution%gap` as it follows from the
  !> forces. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine position_at(canonical, line, solution, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(contact_solution), intent(in) :: solution
    type(path_position), intent(out) :: position
    integer, intent(out) :: status
    integer :: m, n, stat

    n = size(solution%state)
    m = size(solution%motion)
    allocate (position%state(n), position%weakly_active(n), position%corner(n), position%force(n), position%gap(n), &
              position%motion(m), position%force_rate(n), position%gap_rate(n), position%motion_rate(m), &
              position%unresisted(m, 0), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    position%state = solution%state
    position%force = solution%force
    position%gap = solution%gap
    position%motion = solution%motion
    position%force_rate = 0.0_dp
    position%gap_rate = 0.0_dp
    position%motion_rate = 0.0_dp
    call position%mark_weakly_active(canonical, line, 0.0_dp)
  end subroutine position_at

  !> Mark the points that are at a corner of their law, by the values at the position, to which the last `step` with the
  !> present rates has led.
  pure subroutine mark_weakly_active(self, canonical, line, step)
    class(path_position), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    real(dp), intent(in) :: step
    type(law_corner) :: corners(MOST_CORNERS)
    real(dp) :: largest(0:size(canonical%modes, 2)), distance, least
    integer :: i, k, number
    logical :: touching_only(size(self%state))

    touching_only = has_touching_only(canonical)
    largest = largest_forces(canonical, self%force)
    self%weakly_active = FUGE_OPEN
    self%corner = law_corner()
    do k = 1, size(self%state)
      if (touching_only(k)) then
        if (self%state(k) == FUGE_OPEN) then
          if (self%gap(k) <= gap_rounding(self, canonical, line, k, step)) call self%set_corner(k, TOUCHING)
        else
          if (self%force(k) <= force_rounding(self, canonical, largest, k, step)) call self%set_corner(k, TOUCHING)
        end if
        cycle
      end if
      call corners_of_state(canonical, k, self%state(k), corners, number)
      least = huge(least)
      do i = 1, number
        distance = distance_to_corner(canonical, k, corners(i), self%state(k), &
                                      merge(self%force(k), self%gap(k), is_at_stop(self%state(k))))
        if (distance >= least) cycle
        if (is_at_stop(self%state(k))) then
          if (distance > force_rounding(self, canonical, largest, k, step)) cycle
        else
          if (distance > gap_rounding(self, canonical, line, k, step)) cycle
        end if
        least = distance
        call self%set_corner(k, corners(i))
      end do
    end do
  end subroutine mark_weakly_active

  !> Forces at point `k` that differ by less are the same; `largest` as from `largest_forces`.
  pure function force_rounding(self, canonical, largest, k, step) result(rounding)
    class(path_position), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: largest(0:), step
    integer, intent(in) :: k
    real(dp) :: rounding

    rounding = max(self%rounding*largest_force_of_body(canonical, largest, k), &
                   LAST_DIGITS*step*abs(self%force_rate(k)))
  end function force_rounding

  !> Gaps at point `k` that differ by less are the same.
  pure function gap_rounding(self, canonical, line, k, step) result(rounding)
    class(path_position), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    integer, intent(in) :: k
    real(dp), intent(in) :: step
    real(dp) :: rounding
    real(dp) :: data_rounding, magnitude
    integer :: j

    magnitude = abs(canonical%gap(k) + self%parameter*line%reduced_gap_rate(k))
    do j = 1, size(self%motion)
      magnitude = magnitude + abs(canonical%modes(k, j)*self%motion(j))
    end do
    ! The caller's gaps are rounded, whatever is left of them here.
    data_rounding = 2.0_dp*epsilon(data_rounding)*(abs(canonical%gap(k) + line%gap_datum) + abs(line%gap_datum))
    rounding = max(self%rounding*magnitude, data_rounding, LAST_DIGITS*step*abs(self%gap_rate(k)))
  end function gap_rounding

  !> Put point `k` at a corner of its law.
  pure subroutine set_corner(self, k, corner)
    class(path_position), intent(inout) :: self
    integer, intent(in) :: k
    type(law_corner), intent(in) :: corner

    self%corner(k) = corner
    self%weakly_active(k) = corner%stop_state
  end subroutine set_corner

  !> The gaps of points at stops are those of the stops, and forces that are fixed have no rounding.
  pure subroutine keep_to_law(self, canonical)
    class(path_position), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer :: k

    do k = 1, size(self%state)
      if (self%state(k) == FUGE_OPEN) then
        self%force(k) = 0.0_dp
      else if (is_at_stop(self%state(k))) then
        self%gap(k) = fixed_gap(canonical, k, self%state(k))
      else
        self%force(k) = fixed_force(canonical, k, self%state(k))
      end if
    end do
  end subroutine keep_to_law

  !> The sense in which force and gap of each point (n) may change, 1 or -1; 0 where it is not weakly active.
  pure function sense(self)
    class(path_position), intent(in) :: self
    integer :: sense(size(self%corner))

    sense = corner_sense(self%corner)
  end function sense

  !> The largest magnitude of `force` (n): at number 0 that of all points, behind it that of the points that each mode
  !> moves, (0:m), for `largest_force_of_body`.
  pure function largest_forces(canonical, force) result(largest)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: force(:)
    real(dp) :: largest(0:size(canonical%modes, 2))
    integer :: j

    largest(0) = maxval(abs(force))
    do j = 1, size(canonical%modes, 2)
      largest(j) = maxval(abs(force), mask=abs(canonical%modes(:, j)) > 0.0_dp)
    end do
  end function largest_forces

  !> The largest force among the points that some mode moves together with point `k`; among all points where no mode
  !> does. `largest` (0:m) as from `largest_forces`.
  pure function largest_force_of_body(canonical, largest, k) result(force)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: largest(0:)
    integer, intent(in) :: k
    real(dp) :: force
    integer :: j

    force = largest(0)
    ! A translation of all points makes them one body.
    if (canonical%has_translation .or. .not. any(abs(canonical%modes(k, :)) > 0.0_dp)) return
    force = 0.0_dp
    do j = 1, ubound(largest, 1)
      if (abs(canonical%modes(k, j)) > 0.0_dp) force = max(force, largest(j))
    end do
  end function largest_force_of_body

  !> The resultants at a parameter, (m).
  pure function load_at(canonical, line, parameter) result(load)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    real(dp), intent(in) :: parameter
    real(dp) :: load(size(canonical%load))

    load = canonical%load + parameter*line%load_rate
  end function load_at

  !> The gaps that displacements close at the position, (n): at the upper stop the play stays open.
  pure function gaps_to_close(canonical, line, position) result(gap)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    real(dp) :: gap(size(position%state))

    gap = canonical%gap + position%parameter*line%reduced_gap_rate
    where (position%state == FUGE_AT_UPPER_STOP) gap = gap - canonical%upper
  end function gaps_to_close

  !> The motions of the position and their rates in the caller's modes, (all modes).
  subroutine given_motions(canonical, line, position, motion, rate)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    real(dp), intent(out) :: motion(:), rate(:)
    real(dp) :: free_motion(size(position%motion)), free_rate(size(position%motion)), load(size(position%motion))

    free_motion = position%motion
    free_rate = position%motion_rate
    if (canonical%has_translation) then
      load = load_at(canonical, line, position%parameter)
      free_motion(1) = free_motion(1) + line%gap_datum + canonical%datum*load(1)
      free_rate(1) = free_rate(1) + canonical%datum*line%load_rate(1)
    end if
    call canonical%to_given_modes(line%start + position%parameter*line%rate, free_motion, motion)
    call canonical%to_given_modes(line%rate, free_rate, rate)
    if (.not. allocated(line%extended)) return
    call find_spring_motions(line%given, line%extended, position%force, motion)
    call find_spring_motions(line%given, line%extended, position%force_rate, rate)
  end subroutine given_motions

end module fuge_path_position
