!> The rates of a contact at a position on a line of loads, and its values solved for anew.
!>
!> Points within a step of their law stay on it: at a stop, open, or at a limit. On which side of their corner the
!> weakly active points are on the next piece is a contact problem in the rates. It is solved by block pivoting on
!> them; if that stalls, the active-set engine solves it, which ends.
module fuge_path_rates
  use fuge_block_pivoting, only: run_block_pivoting
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_AT_LOWER_STOP, FUGE_OPEN
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp, xp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_law_corners, only: corner_sense, law_corner
  use fuge_monitor_type, only: monitor_relay
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_path_equations, only: correct, open_gaps
  use fuge_path_factor, only: path_factor
  use fuge_path_position, only: gaps_to_close, largest_force_of_body, largest_forces, load_at, load_line, &
    path_position, ROUNDING, ROUNDING_OF_SUMS
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  use fuge_unresisted_motions, only: find_unresisted_basis, is_resisted, without_unresisted
  implicit none
  private

  public :: find_rates, renew_values

  !> Block exchanges in a row without a new minimum of wrong points, before the active-set engine takes over.
  integer, parameter :: MAX_STALLS = 3

contains

  !> States and rates of the piece that begins at the position. `status`: that of a factor or of the active-set engine.
  subroutine find_rates(canonical, line, factor, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    logical :: wrong(size(position%state))
    type(stall_counter) :: stalls

    call follow_last_rates(position)
    call stalls%start(MAX_STALLS)
    do
      call solve_for_rates(canonical, line, factor, position, status)
      if (status /= FUGE_DONE) return
      call find_wrong(canonical, line, position, wrong)
      if (.not. any(wrong)) exit
      call stalls%spend()
      call stalls%renew_if_fewer(count(wrong))
      if (stalls%has_stalled()) then
        call solve_rate_problem(canonical, line, factor, position, status)
        if (status /= FUGE_DONE) return
        exit
      end if
      where (wrong) position%state = other_side(position%corner, position%state)
    end do
    call open_gaps(canonical, line%flexibility, factor, position%state, line%reduced_gap_rate, position%force_rate, &
                   position%motion_rate, position%gap_rate)
    where (is_at_stop(position%state) .or. canonical%excluded) position%gap_rate = 0.0_dp
    position%has_rates = .true.
    position%rounding = merge(ROUNDING, ROUNDING_OF_SUMS, factor%needs_refinement(canonical))
  end subroutine find_rates

  !> The state on the other side of a corner.
  elemental function other_side(corner, state) result(other)
    type(law_corner), intent(in) :: corner
    integer, intent(in) :: state
    integer :: other

    other = merge(corner%free_state, corner%stop_state, is_at_stop(state))
  end function other_side

  !> A first guess: weakly active points go on as they came. Without rates yet all of them are at their stops.
  pure subroutine follow_last_rates(position)
    type(path_position), intent(inout) :: position
    integer :: k

    do k = 1, size(position%state)
      associate (state => position%state(k), corner => position%corner(k))
        if (position%weakly_active(k) == FUGE_OPEN) cycle
        if (is_at_stop(state)) then
          if (position%has_rates .and. corner_sense(corner)*position%force_rate(k) < 0.0_dp) state = corner%free_state
        else
          if (position%has_rates .and. corner_sense(corner)*position%gap_rate(k) >= 0.0_dp) cycle
          state = corner%stop_state
        end if
      end associate
    end do
  end subroutine follow_last_rates

  !> Rates of forces and motions with the present states, by a factor of the points at a stop. `status`: that of the
  !> factor.
  subroutine solve_for_rates(canonical, line, factor, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    logical :: contact(size(position%state))

    contact = is_at_stop(position%state)
    call factor%set(canonical, contact, status)
    if (status /= FUGE_DONE) return
    call factor%solve(canonical, line%reduced_gap_rate, line%load_rate, position%force_rate, position%motion_rate)
    if (canonical%has_translation .and. size(position%motion) == 1 .and. any(contact)) then
      deallocate (position%unresisted)
      allocate (position%unresisted(1, 0))
    else
      call find_unresisted_basis(canonical%modes, contact, position%unresisted)
    end if
    if (is_resisted(line%load_rate, position%unresisted)) then
      position%motion_rate = without_unresisted(position%motion_rate, position%unresisted)
    end if
    if (factor%needs_refinement(canonical)) then
      call correct(canonical, line%flexibility, factor, line%reduced_gap_rate, line%load_rate, position%state, &
                   position%unresisted, position%force_rate, position%motion_rate)
    end if
    call clear_small_forces(line, line%reduced_gap_rate, line%load_rate, contact, position%force_rate)
  end subroutine solve_for_rates

  !> Without a load all forces may be rounding: those at stops, `contact` (n), that displace no point by more than the
  !> rounding of the gaps become zero.
  pure subroutine clear_small_forces(line, gap, load, contact, force)
    type(load_line), intent(in) :: line
    real(dp), intent(in) :: gap(:), load(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: force(:)

    if (any(abs(load) > 0.0_dp)) return
    where (contact .and. abs(force)*line%flexibility <= ROUNDING*maxval(abs(gap))) force = 0.0_dp
  end subroutine clear_small_forces

  !> Solve anew for the forces and motions of the set of the factor at the position, except for motions that nothing
  !> resists, and compute the gaps.
  subroutine renew_values(canonical, line, factor, position)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_factor), intent(in) :: factor
    type(path_position), intent(inout) :: position
    real(dp) :: gap(size(position%state))

    gap = gaps_to_close(canonical, line, position)
    call correct(canonical, line%flexibility, factor, gap, load_at(canonical, line, position%parameter), &
                 position%state, position%unresisted, position%force, position%motion)
    call clear_small_forces(line, canonical%gap + position%parameter*line%reduced_gap_rate, &
                            load_at(canonical, line, position%parameter), is_at_stop(position%state), &
                            position%force)
    call open_gaps(canonical, line%flexibility, factor, position%state, gap, position%force, position%motion, &
                   position%gap)
    call position%keep_to_law(canonical)
  end subroutine renew_values

  !> Weakly active points whose force or gap would change in the wrong sense.
  pure subroutine find_wrong(canonical, line, position, wrong)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    logical, intent(out) :: wrong(:)
    real(dp) :: largest(0:size(canonical%modes, 2)), rate, magnitude
    integer :: k

    wrong = .false.
    largest = 0.0_dp
    if (any(position%weakly_active /= FUGE_OPEN .and. is_at_stop(position%state))) then
      largest = largest_forces(canonical, position%force_rate)
    end if
    do k = 1, size(wrong)
      if (position%weakly_active(k) == FUGE_OPEN) cycle
      if (is_at_stop(position%state(k))) then
        wrong(k) = corner_sense(position%corner(k))*position%force_rate(k) &
                   < -ROUNDING*largest_force_of_body(canonical, largest, k)
      else
        call gap_rate_at(canonical, line, position, k, rate, magnitude)
        wrong(k) = corner_sense(position%corner(k))*rate < -ROUNDING*magnitude
      end if
    end do
  end subroutine find_wrong

  !> The rate of the gap at one point, and the size of its terms.
  pure subroutine gap_rate_at(canonical, line, position, point, rate, magnitude)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    integer, intent(in) :: point
    real(dp), intent(out) :: rate, magnitude
    real(xp) :: total, term
    integer :: j

    total = real(line%reduced_gap_rate(point), xp)
    magnitude = real(abs(total), dp)
    do j = 1, size(position%motion)
      term = real(canonical%modes(point, j), xp)*real(position%motion_rate(j), xp)
      total = total - term
      magnitude = magnitude + real(abs(term), dp)
    end do
    do j = 1, size(position%state)
      if (.not. is_at_stop(position%state(j))) cycle
      term = (real(canonical%alpha(point, j), xp) - real(canonical%datum, xp))*real(position%force_rate(j), xp)
      total = total + term
      magnitude = magnitude + real(abs(term), dp)
    end do
    rate = real(total, dp)
  end subroutine gap_rate_at

  !> The contact problem in the rates, by the active-set engine: points within their stop are tied, weakly active ones
  !> one-sided, all others excluded.
  subroutine solve_rate_problem(canonical, line, factor, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    type(canonical_problem) :: rates
    type(contact_solution) :: solution
    type(kkt_factor) :: own_factor
    type(monitor_relay) :: no_monitor
    real(dp), allocatable, target :: mirrored_alpha(:, :)
    real(dp) :: remainder(size(position%motion)), sense(size(position%state))
    logical :: pulls(size(position%state)), wrong(size(position%state))
    integer :: n, sets, stat

    n = size(position%state)
    rates = canonical
    allocate (solution%force(n), solution%gap(n), solution%motion(size(position%motion)), solution%state(n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    ! A point whose force may only fall becomes one at the lower stop in a mirror.
    sense = merge(-1.0_dp, 1.0_dp, position%sense() < 0)
    if (rates%has_limits()) deallocate (rates%limit, rates%limit_upper)
    rates%plain = .false.
    rates%gap = sense*line%reduced_gap_rate
    rates%load = line%load_rate
    pulls = is_at_stop(position%state) .and. position%weakly_active == FUGE_OPEN
    rates%upper = merge(0.0_dp, huge(1.0_dp), pulls)
    rates%excluded = .not. is_at_stop(position%state) .and. position%weakly_active == FUGE_OPEN
    solution%state = merge(FUGE_AT_LOWER_STOP, FUGE_OPEN, is_at_stop(position%state))
    if (any(sense < 0.0_dp)) then
      call mirror(canonical, sense, mirrored_alpha, rates, status)
      if (status /= FUGE_DONE) return
    end if
    if (.not. allocated(rates%feasible_force)) allocate (rates%feasible_force(n))
    rates%feasible_force = 0.0_dp
    if (size(remainder) > 0) then
      call find_equilibrium(rates%modes, rates%load, merge(-huge(1.0_dp), 0.0_dp, pulls), &
                            merge(0.0_dp, huge(1.0_dp), rates%excluded), rates%feasible_force, remainder)
    end if
    call run_block_pivoting(rates, ITERATIONS_PER_ROW*(n + 1), no_monitor, own_factor, solution, sets, status)
    if (status /= FUGE_DONE) return
    where (position%weakly_active /= FUGE_OPEN)
      position%state = merge(position%corner%free_state, position%corner%stop_state, solution%state == FUGE_OPEN)
    end where
    call solve_for_rates(canonical, line, factor, position, status)
    if (status /= FUGE_DONE) return
    call find_wrong(canonical, line, position, wrong)
    if (.not. any(wrong)) return
    ! The motions that nothing resists must not stand still here, because points without force are in their way.
    if (canonical%has_translation) then
      solution%motion(1) = solution%motion(1) - rates%datum*line%load_rate(1)
      if (.not. rates%has_translation) solution%motion(1) = solution%motion(1) - canonical%datum*line%load_rate(1)
    end if
    position%force_rate = sense*solution%force
    position%motion_rate = solution%motion
  end subroutine solve_rate_problem

  !> Turn the senses of force and gap round at the points where `sense` (n) is -1. `alpha` is the matrix then, which
  !> `rates` points to. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine mirror(canonical, sense, alpha, rates, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: sense(:)
    real(dp), allocatable, target, intent(out) :: alpha(:, :)
    type(canonical_problem), intent(inout) :: rates
    integer, intent(out) :: status
    integer :: j, stat

    allocate (alpha(size(sense), size(sense)), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    do j = 1, size(sense)
      alpha(:, j) = sense*canonical%alpha(:size(sense), j)*sense(j)
    end do
    rates%alpha => alpha
    ! The translation does not move these points alike any more.
    rates%datum = 0.0_dp
    rates%has_translation = .false.
    rates%modes = spread(sense, 2, size(canonical%modes, 2))*canonical%modes
  end subroutine mirror

end module fuge_path_rates
