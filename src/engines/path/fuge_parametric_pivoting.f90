!> Parametric pivoting: the course of a contact along a straight line of problems, without load steps.
!>
!> Gaps and resultants change linearly with a parameter. Between two events forces, gaps and motions are linear in it
!> too. An event is a parameter at which points come to a stop or leave it. Which points change when several could,
!> and how the next piece runs, follows from a small contact problem in the rates of the weakly active points. Where
!> no such rates exist, the motions that nothing resists jump.
module fuge_parametric_pivoting
  use fuge_block_pivoting, only: MAX_STALLS
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_displacements, only: add_elastic_displacement, rigid_displacement
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: solve_set
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_path_type, only: append_entry, fuge_path, start_path
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_unresisted_motions, only: find_unresisted_basis, without_unresisted
  implicit none
  private

  public :: follow_line, position_at

  !> Rates below this fraction of the largest are zero, and parameters that agree to it are one event.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-12_dp
  !> A resultant below this fraction of the largest is none in an unresisted motion.
  real(dp), parameter :: NO_LOAD = 1.0e-10_dp

  !> A line of loads: the reduced gaps grow by reduced_gap_rate (n) and the resultants by load_rate (m) per unit of the
  !> parameter, from those of the problem up to `last`. Parameters are as exact as parameter + origin.
  type, public :: load_line
    real(dp), allocatable :: reduced_gap_rate(:), load_rate(:)
    real(dp) :: last = 0.0_dp, origin = 0.0_dp
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
  end type path_position

contains

  !> The position at the start of a line, from a solution without its datums; `solution%gap` as it follows from the
  !> forces. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine position_at(canonical, solution, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    type(path_position), intent(out) :: position
    integer, intent(out) :: status
    real(dp) :: magnitude(size(solution%state))
    integer :: j, m, n, stat

    n = size(solution%state)
    m = size(solution%motion)
    allocate (position%state(n), position%weakly_active(n), position%force(n), position%gap(n), position%motion(m), &
              position%force_rate(n), position%gap_rate(n), position%motion_rate(m), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    position%state = solution%state
    position%force = solution%force
    position%gap = solution%gap
    position%motion = solution%motion
    magnitude = abs(canonical%gap)
    do j = 1, m
      magnitude = magnitude + abs(canonical%modes(:, j)*solution%motion(j))
    end do
    associate (state => solution%state, force => solution%force, gap => solution%gap, upper => canonical%upper)
      position%weakly_active = FUGE_OPEN
      where (state /= FUGE_OPEN .and. upper > 0.0_dp)
        where (abs(force) <= TIE_TOLERANCE*maxval(abs(force))) position%weakly_active = state
      end where
      where (state == FUGE_OPEN .and. .not. canonical%excluded)
        where (upper - gap <= TIE_TOLERANCE*magnitude) position%weakly_active = FUGE_AT_UPPER_STOP
        where (gap <= TIE_TOLERANCE*magnitude) position%weakly_active = FUGE_AT_LOWER_STOP
      end where
    end associate
  end subroutine position_at

  !> Follow the line from the position to its end, or as far as equilibrium reaches.
  !>
  !> `canonical` with its matrix. `position` and `path` are left where the path ended. `status`: that of a factor,
  !> FUGE_ERR_MEMORY, FUGE_ERR_NO_EQUILIBRIUM beyond position%parameter, FUGE_ERR_ITERATION_LIMIT after more events than
  !> 50 for each point.
  subroutine follow_line(canonical, line, position, path, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(inout) :: position
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status
    type(kkt_factor) :: factor
    integer :: before(size(position%state))
    real(dp) :: step
    integer :: turn

    call start_path(position%state, size(position%motion), path, status)
    if (status /= FUGE_DONE) return
    do turn = 1, ITERATIONS_PER_ROW*(size(before) + 1)
      before = position%state
      call move_until_resisted(canonical, line%load_rate, position, status)
      if (status == FUGE_DONE) call find_rates(canonical, line, factor, position, status)
      if (status == FUGE_DONE .and. turn == 1) call append_position(path, position, 0, status)
      if (status == FUGE_DONE) call append_changes(path, position, before, status)
      if (status /= FUGE_DONE) return
      call find_next_event(canonical, line, position, step)
      if (.not. position%parameter + step < line%last - tie_width(line, line%last)) return
      call advance(canonical, line, factor, step, position)
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine follow_line

  !> Parameters near this one that differ by less are one event.
  pure function tie_width(line, parameter) result(width)
    type(load_line), intent(in) :: line
    real(dp), intent(in) :: parameter
    real(dp) :: width

    width = TIE_TOLERANCE*(parameter + line%origin)
  end function tie_width

  !> Where the points with force do not resist all motions, and the weakly active ones cannot carry the change of the
  !> load, move the bodies at constant forces until they can.
  subroutine move_until_resisted(canonical, load_rate, position, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: load_rate(:)
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    real(dp) :: force(size(position%state)), motion(size(load_rate))
    logical :: loaded(size(position%state))
    integer :: turn

    status = FUGE_DONE
    if (size(load_rate) < 1) return
    do turn = 1, ITERATIONS_PER_ROW*(size(loaded) + 1)
      loaded = position%state /= FUGE_OPEN .and. position%weakly_active == FUGE_OPEN
      call find_unresisted_basis(canonical%modes, loaded, position%unresisted)
      if (size(position%unresisted, 2) < 1) return
      call find_equilibrium(canonical%modes, load_rate, loaded .or. position%weakly_active > FUGE_OPEN, &
                            loaded .or. position%weakly_active < FUGE_OPEN, force, motion)
      if (.not. any(abs(motion) > 0.0_dp)) return
      call move_to_stop(canonical, motion, loaded, position, status)
      if (status /= FUGE_DONE) return
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine move_until_resisted

  !> Move along `direction` (m) as far as the stops allow. `status`: FUGE_DONE, or FUGE_ERR_NO_EQUILIBRIUM if no stop
  !> is reached.
  subroutine move_to_stop(canonical, direction, loaded, position, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: direction(:)
    logical, intent(in) :: loaded(:)
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    real(dp) :: closing(size(loaded)), reach(size(loaded)), least

    closing = rigid_displacement(canonical%modes, direction)
    where (loaded .or. canonical%excluded) closing = 0.0_dp
    where (abs(closing) <= TIE_TOLERANCE*maxval(abs(closing))) closing = 0.0_dp
    ! A point that seems to move into the stop where it is does so by rounding.
    where (closing*real(position%weakly_active, dp) > 0.0_dp) closing = 0.0_dp
    reach = huge(least)
    where (closing > 0.0_dp) reach = max(position%gap, 0.0_dp)/closing
    where (closing < 0.0_dp .and. canonical%upper < huge(least))
      reach = max(canonical%upper - position%gap, 0.0_dp)/abs(closing)
    end where
    least = minval(reach)
    status = merge(FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, least < huge(least))
    if (status /= FUGE_DONE) return
    position%motion = position%motion + least*direction
    where (abs(closing) > 0.0_dp)
      position%gap = position%gap - least*closing
      position%state = FUGE_OPEN
      position%force = 0.0_dp
      position%weakly_active = FUGE_OPEN
    end where
    where (reach <= least*(1.0_dp + TIE_TOLERANCE))
      position%weakly_active = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, closing > 0.0_dp)
    end where
  end subroutine move_to_stop

  !> The rates per unit of the parameter. Points with force stay at their stop, open ones stay open; the rates of the
  !> weakly active points satisfy a contact problem, solved by block pivoting with single exchanges as the fallback.
  subroutine find_rates(canonical, line, factor, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(kkt_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    logical :: wrong(size(position%state))
    integer :: trial, fewest_wrong, stalls_left

    where (position%weakly_active /= FUGE_OPEN) position%state = position%weakly_active
    fewest_wrong = huge(fewest_wrong)
    stalls_left = MAX_STALLS
    do trial = 1, ITERATIONS_PER_ROW*(count(position%weakly_active /= FUGE_OPEN) + 1)
      call solve_for_rates(canonical, line, factor, position, status)
      if (status /= FUGE_DONE) return
      wrong = position%weakly_active /= FUGE_OPEN .and. merge(is_falling(position%weakly_active*position%force_rate), &
                                                          is_falling(position%weakly_active*position%gap_rate), &
                                                          position%state /= FUGE_OPEN)
      if (.not. any(wrong)) return
      stalls_left = stalls_left - 1
      if (count(wrong) < fewest_wrong) stalls_left = MAX_STALLS
      fewest_wrong = min(fewest_wrong, count(wrong))
      if (stalls_left < 0) call keep_first(wrong)
      where (wrong) position%state = merge(FUGE_OPEN, position%weakly_active, position%state /= FUGE_OPEN)
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine find_rates

  !> The rates with the present states, by a factor of the points at a stop. `status`: that of the factor.
  subroutine solve_for_rates(canonical, line, factor, position, status)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(kkt_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status

    call factor%set(canonical, position%state /= FUGE_OPEN, status)
    if (status /= FUGE_DONE) return
    call solve_set(factor, canonical%datum, line%reduced_gap_rate, line%load_rate, position%force_rate, &
                   position%motion_rate)
    call find_unresisted_basis(canonical%modes, position%state /= FUGE_OPEN, position%unresisted)
    if (is_balanced(line%load_rate, position%unresisted)) then
      position%motion_rate = without_unresisted(position%motion_rate, position%unresisted)
    end if
    position%gap_rate = line%reduced_gap_rate - rigid_displacement(canonical%modes, position%motion_rate)
    call add_elastic_displacement(canonical%alpha, canonical%datum, position%state /= FUGE_OPEN, position%force_rate, &
                                  position%gap_rate)
    where (position%state /= FUGE_OPEN .or. canonical%excluded) position%gap_rate = 0.0_dp
  end subroutine solve_for_rates

  !> Is the resultant in the unresisted motions no more than rounding?
  pure function is_balanced(load_rate, unresisted) result(balanced)
    real(dp), intent(in) :: load_rate(:), unresisted(:, :)
    logical :: balanced

    balanced = .true.
    if (size(unresisted, 2) < 1) return
    balanced = maxval(abs(matmul(load_rate, unresisted))) <= NO_LOAD*maxval(abs(load_rate))
  end function is_balanced

  pure function is_falling(rate) result(falling)
    real(dp), intent(in) :: rate(:)
    logical :: falling(size(rate))

    falling = rate < -TIE_TOLERANCE*maxval(abs(rate))
  end function is_falling

  !> Only the true element of least index stays true.
  pure subroutine keep_first(mask)
    logical, intent(inout) :: mask(:)
    integer :: k

    do k = 1, size(mask)
      if (.not. mask(k)) cycle
      mask(k + 1:) = .false.
      return
    end do
  end subroutine keep_first

  !> How far the next event is, and the points that may change at it.
  subroutine find_next_event(canonical, line, position, step)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(inout) :: position
    real(dp), intent(out) :: step
    real(dp) :: reach(size(position%state))
    logical :: open(size(position%state)), reached(size(position%state))

    reach = huge(step)
    open = position%state == FUGE_OPEN .and. .not. canonical%excluded
    where (position%state /= FUGE_OPEN .and. canonical%upper > 0.0_dp)
      where (is_falling(position%state*position%force_rate)) reach = max(position%state*position%force, &
          0.0_dp)/abs(position%force_rate)
    end where
    where (open .and. is_falling(position%gap_rate)) reach = max(position%gap, 0.0_dp)/abs(position%gap_rate)
    where (open .and. is_falling(-position%gap_rate) .and. canonical%upper < huge(step))
      reach = max(canonical%upper - position%gap, 0.0_dp)/abs(position%gap_rate)
    end where
    step = minval(reach)
    reached = reach < huge(step)
    associate (width => tie_width(line, position%parameter + step))
      if (step < huge(step)) reached = reached .and. reach - step <= width
      ! Points of an event that is no more than rounding away belong to this one too.
      if (step > width) position%weakly_active = FUGE_OPEN
    end associate
    where (reached)
      position%weakly_active = merge(position%state, merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, &
                                                           position%gap_rate < 0.0_dp), &
                                 position%state /= FUGE_OPEN)
    end where
  end subroutine find_next_event

  !> Advance along the line and solve anew for the values there, except for motions that nothing resists.
  subroutine advance(canonical, line, factor, step, position)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(kkt_factor), intent(in) :: factor
    real(dp), intent(in) :: step
    type(path_position), intent(inout) :: position
    real(dp) :: residual(size(position%state)), correction(size(position%state))
    real(dp) :: missing(size(position%motion)), shift(size(position%motion))

    position%parameter = position%parameter + step
    where (position%state == FUGE_OPEN) position%force = 0.0_dp
    position%force = position%force + step*position%force_rate
    position%motion = position%motion + step*position%motion_rate
    missing = canonical%load + position%parameter*line%load_rate - matmul(position%force, canonical%modes)
    residual = gaps_at(canonical, line, position)
    where (position%state < FUGE_OPEN) residual = residual - canonical%upper
    call solve_set(factor, canonical%datum, residual, missing, correction, shift)
    position%force = position%force + correction
    position%motion = position%motion + without_unresisted(shift, position%unresisted)
    position%gap = gaps_at(canonical, line, position)
    where (position%state /= FUGE_OPEN) position%gap = merge(0.0_dp, canonical%upper, position%state > FUGE_OPEN)
  end subroutine advance

  !> c = g + A f - R q, (n).
  pure function gaps_at(canonical, line, position) result(gap)
    type(canonical_problem), intent(in) :: canonical
    type(load_line), intent(in) :: line
    type(path_position), intent(in) :: position
    real(dp) :: gap(size(position%state))

    gap = canonical%gap + position%parameter*line%reduced_gap_rate - rigid_displacement(canonical%modes, &
        position%motion)
    call add_elastic_displacement(canonical%alpha, canonical%datum, position%state /= FUGE_OPEN, position%force, gap)
  end function gaps_at

  !> Append an entry for each point whose state has changed.
  subroutine append_changes(path, position, before, status)
    type(fuge_path), intent(inout) :: path
    type(path_position), intent(in) :: position
    integer, intent(in) :: before(:)
    integer, intent(out) :: status
    integer :: k

    status = FUGE_DONE
    do k = 1, size(before)
      if (position%state(k) /= before(k)) call append_position(path, position, k, status)
      if (status /= FUGE_DONE) return
    end do
  end subroutine append_changes

  subroutine append_position(path, position, point, status)
    type(fuge_path), intent(inout) :: path
    type(path_position), intent(in) :: position
    integer, intent(in) :: point
    integer, intent(out) :: status

    call append_entry(path, position%parameter, point, position%state, position%motion, position%motion_rate, status)
  end subroutine append_position

end module fuge_parametric_pivoting
