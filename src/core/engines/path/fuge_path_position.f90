!> A position on a line of loads: the values there, their rates from there on, and which of them are zero.
module fuge_path_position
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
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
  end type load_line

  !> Values at a parameter, and their rates from there on.
  type, public :: path_position
    real(dp) :: parameter = 0.0_dp
    !> State of each point, (n). A weakly active point has no force at a stop, where it may stay or not: weakly_active
    !> (n) is the state of that stop, and FUGE_OPEN for all other points.
    integer, allocatable :: state(:), weakly_active(:)
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
    allocate (position%state(n), position%weakly_active(n), position%force(n), position%gap(n), position%motion(m), &
              position%force_rate(n), position%gap_rate(n), position%motion_rate(m), position%unresisted(m, 0), &
              stat=stat)
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

  !> Mark the points that are at a stop without force, by the values at the position, to which the last `step` with the
  !> present rates has led.
  pure subroutine mark_weakly_active(self, canonical, line, step)
    class(path_position), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    real(dp), intent(in) :: step
    real(dp), parameter :: LAST_DIGITS = 8.0_dp*epsilon(1.0_dp)
    real(dp) :: data_rounding, largest(0:size(canonical%modes, 2)), magnitude
    integer :: j, k

    largest = largest_forces(canonical, self%force)
    self%weakly_active = FUGE_OPEN
    do k = 1, size(self%state)
      if (canonical%excluded(k) .or. .not. canonical%upper(k) > 0.0_dp) cycle
      associate (state => self%state(k), gap => self%gap(k), upper => canonical%upper(k))
        if (state /= FUGE_OPEN) then
          if (state*self%force(k) <= max(self%rounding*largest_force_of_body(canonical, largest, k), &
                                         LAST_DIGITS*step*abs(self%force_rate(k)))) self%weakly_active(k) = state
          cycle
        end if
        magnitude = abs(canonical%gap(k) + self%parameter*line%reduced_gap_rate(k))
        do j = 1, size(self%motion)
          magnitude = magnitude + abs(canonical%modes(k, j)*self%motion(j))
        end do
        ! The caller's gaps are rounded, whatever is left of them here.
        data_rounding = 2.0_dp*epsilon(data_rounding)*(abs(canonical%gap(k) + line%gap_datum) + abs(line%gap_datum))
        if (min(gap, upper - gap) <= max(self%rounding*magnitude, data_rounding, &
                                         LAST_DIGITS*step*abs(self%gap_rate(k)))) then
          self%weakly_active(k) = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, gap <= upper - gap)
        end if
      end associate
    end do
  end subroutine mark_weakly_active

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
    where (position%state < FUGE_OPEN) gap = gap - canonical%upper
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
  end subroutine given_motions

end module fuge_path_position
