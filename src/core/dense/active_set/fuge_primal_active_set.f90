!> The primal active-set method, which ends: the energy falls with every point that joins.
!>
!> From feasible forces step towards the solution of the working set until a force would become tensile: that
!> point leaves. At the solution the point furthest beyond a stop joins; when there is none, the solution solves the
!> problem (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23).
module fuge_primal_active_set
  use fuge_blocking_step, only: is_tensile, step_to_blocking
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_point_space, only: point_space
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  use fuge_working_set, only: working_set, SIGN_TOLERANCE
  implicit none
  private

  public :: run_primal_active_set, joined_stop

  !> Changes of the forces, and violations, below this fraction may be rounding.
  real(dp), parameter, public :: NOISE = 1.0e-11_dp

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
    real(dp) :: force(size(solution%state)), previous(size(solution%state)), rounding(size(solution%state))
    logical :: locked(size(solution%state)), tied(size(solution%state)), lenient
    type(stall_counter) :: stalls
    integer :: newest

    tied = canonical%is_tied()
    call find_feasible_forces(canonical, solution, force)
    locked = .false.
    newest = 0
    call stalls%start(size(force))
    lenient = .false.
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
      rounding = tension_by_rounding(canonical, set, solution, lenient .or. stalls%has_stalled())
      previous = force
      if (any(is_tensile(solution%force, rounding, solution%state, tied))) then
        call step_to_blocking(solution%force, rounding, tied, solution%state, force, newest, locked, &
                              point_space())
      else
        force = solution%force
        if (newest > 0) locked = locked .and. locked(newest)
        newest = entering_point(canonical, set, solution, locked, stalls%has_stalled())
        if (newest > 0) then
          solution%state(newest) = joined_stop(solution%gap(newest), canonical%upper(newest))
        else if (lenient .or. .not. any(locked)) then
          return
        else
          ! The tension that locked the points out was above SIGN_TOLERANCE, yet rounding: of resultants near the edge
          ! of those that the contact can carry.
          lenient = .true.
          locked = .false.
        end if
      end if
      call stalls%spend()
      if (.not. maxval(abs(force - previous)) <= NOISE*maxval(abs(force))) call stalls%renew()
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
    end do
  end subroutine run_primal_active_set

  !> The stop that an open point with this gap is beyond.
  elemental function joined_stop(gap, upper) result(state)
    real(dp), intent(in) :: gap, upper
    integer :: state

    state = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, gap < 0.5_dp*upper)
  end function joined_stop

  !> Tension (n) that counts as rounding at a point that may alone resist a rigid mode; without that point the
  !> set would be wrong. Zero for one translation, which any point resists. Larger if `lenient`, where rounding has led
  !> nowhere or may lead in a circle.
  pure function tension_by_rounding(canonical, set, solution, lenient) result(rounding)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(in) :: solution
    logical, intent(in) :: lenient
    real(dp) :: rounding(size(solution%force))

    rounding = 0.0_dp
    if (canonical%plain) return
    rounding = max(merge(NOISE, SIGN_TOLERANCE, lenient)*canonical%force_scale(solution%force), set%zero_force)
  end function tension_by_rounding

  !> The open point furthest beyond a stop, 0 if there is none; where the search has `stalled`, the one of the least
  !> index, which ends circles (Y.-Y. Chang, R. W. Cottle, Mathematical Programming 18, 1980).
  pure function entering_point(canonical, set, solution, locked, stalled) result(point)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(in) :: solution
    logical, intent(in) :: locked(:), stalled
    integer :: point
    real(dp) :: beyond(size(locked))

    beyond = max(-solution%gap, solution%gap - canonical%upper)
    if (stalled) beyond = 1.0_dp
    point = maxloc(beyond, dim=1, mask=solution%state == FUGE_OPEN .and. set%violation > SIGN_TOLERANCE &
                   .and. .not. locked)
  end function entering_point

  !> Forces (n) in equilibrium that push at their stops, and the states that belong to them: for the plain problem the
  !> compressive forces of the solution, scaled to the load; else those known from the start.
  pure subroutine find_feasible_forces(canonical, solution, force)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(inout) :: solution
    real(dp), intent(out) :: force(:)

    if (canonical%plain) then
      force = max(solution%force, 0.0_dp)
      force = force*(canonical%load(1)/sum(force))
    else
      force = canonical%feasible_force
    end if
    solution%state = FUGE_OPEN
    where (force > 0.0_dp) solution%state = FUGE_AT_LOWER_STOP
    where (force < 0.0_dp) solution%state = FUGE_AT_UPPER_STOP
    where (canonical%is_tied()) solution%state = FUGE_AT_LOWER_STOP
  end subroutine find_feasible_forces

end module fuge_primal_active_set
