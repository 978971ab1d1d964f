!> The level of the forces on a surface that equal forces do not displace, such as a periodic one.
!>
!> Where no free motion takes them up, and no point gives way, equal forces may be added, within their limits, to those
!> of a solution in which all gaps are closed. Such a solution is on the verge: the stops leave the mean gap no room,
!> and beyond them no forces without limits hold the motions.
module fuge_force_level
  use fuge_complete_contact, only: equal_forces_displace_nothing
  use fuge_contact_states, only: FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_engine_messages, only: idle_forces
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_law, only: point_law
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_WARN_NOT_UNIQUE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: explain_by_force_level, judge_force_level

  !> The resultant of equal forces in a mode is rounding below this fraction of its terms.
  real(dp), parameter :: NO_RESULTANT = 1.0e-12_dp
  !> A mean counts as zero below this many units in the last place of the largest gap or play, times the root of the
  !> number of points.
  real(dp), parameter :: ROUNDINGS = 4.0_dp
  !> Equal forces up to this fraction of the largest force are none.
  real(dp), parameter :: NO_FORCE = 1.0e-12_dp

  !> The room that the stops leave the mean gap; lengths. Displacements have the mean 0 here, so that the mean gap is
  !> that of the initial ones less the prescribed motions. It is between 0 and the mean play, and where all points are
  !> in contact it is the mean of their stops.
  type :: gap_room
    !> How far the mean gap is beyond the stops, negative where they leave it room.
    real(dp) :: beyond = 0.0_dp
    !> The largest length when the prescribed motions are taken out of the gaps, and the rounding of the mean.
    real(dp) :: largest = 0.0_dp, rounding = 0.0_dp
    !> All points are in contact, and the mean gap is not the mean of their stops.
    logical :: contradicts = .false.
  end type gap_room

contains

  !> Warn where equal forces may be added to those of a solution (FUGE_WARN_NOT_UNIQUE), and refuse motions that leave
  !> the mean gap beyond the stops by more than `tolerance` of the lengths (FUGE_ERR_NO_EQUILIBRIUM): what an engine
  !> returns then are equal forces as large as rounding lets them become.
  !>
  !> Errors also: those of equal_forces_displace_nothing.
  subroutine judge_force_level(operator, problem, solution, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    type(gap_room) :: room

    space = operator%ranks()
    if (.not. equal_forces_are_idle(problem, space)) return
    call find_room(problem, solution%state, space, room)
    if (.not. (room%beyond >= 0.0_dp .or. room%contradicts)) return
    if (problem%has_limits()) then
      if (.not. level_has_room(problem, solution, max(tolerance*room%largest, room%rounding), space)) return
    end if
    if (.not. equal_forces_displace_nothing(operator, info)) return
    if (room%contradicts .and. .not. room%beyond >= 0.0_dp) then
      ! Only forces large enough to lose the mean gap in their rounding can close all gaps.
      info%force_error = 1.0_dp
    else if (room%beyond > max(tolerance*room%largest, room%rounding)) then
      info%force_error = 0.0_dp
      call report_beyond(room%beyond, operator%grid(), info)
    else
      info%force_error = 1.0_dp
      call report(info, FUGE_WARN_NOT_UNIQUE, 'all points are at their stops, and '//idle_forces(operator%grid()) &
                  //': they may be added to the forces, which are one of many possible; gaps and motions are unique')
    end if
  end subroutine judge_force_level

  !> Where an engine has found that there is no solution (FUGE_ERR_NOT_DEFINITE), and the motions leave the mean gap
  !> beyond the stops by more than `tolerance` of the lengths, name that cause (FUGE_ERR_NO_EQUILIBRIUM). Forces have no
  !> limits. `info` keeps its error otherwise.
  subroutine explain_by_force_level(operator, problem, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: trial
    type(point_space) :: space
    type(gap_room) :: room

    ! Without any motion there is none to change.
    if (info%status /= FUGE_ERR_NOT_DEFINITE .or. problem%mode_count() < 1) return
    space = operator%ranks()
    if (.not. equal_forces_are_idle(problem, space)) return
    call find_room(problem, spread(FUGE_OPEN, 1, problem%points()), space, room)
    if (.not. room%beyond > max(tolerance*room%largest, room%rounding)) return
    trial%products = info%products
    if (equal_forces_displace_nothing(operator, trial)) call report_beyond(room%beyond, operator%grid(), info)
    info%products = trial%products
  end subroutine explain_by_force_level

  !> No forces bring the mean gap between the stops, beyond which it is by a length (FUGE_ERR_NO_EQUILIBRIUM). `cells`
  !> as for `idle_forces`.
  pure subroutine report_beyond(beyond, cells, info)
    real(dp), intent(in) :: beyond
    integer, intent(in) :: cells(2)
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_NO_EQUILIBRIUM, idle_forces(cells)//', so no forces bring the mean gap between the ' &
                //'stops, beyond which it is by '//text(beyond)//': prescribe other motions, or resultants, or ' &
                //'change the gaps')
  end subroutine report_beyond

  !> Do all points take part, does none give way on a spring, and have equal forces no resultant in any free mode, none
  !> of which is a translation?
  function equal_forces_are_idle(problem, space) result(idle)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    logical :: idle
    logical :: free(problem%mode_count()), take_part
    real(dp) :: sums(2*problem%mode_count())
    integer :: j, k, m

    m = problem%mode_count()
    free = .true.
    if (allocated(problem%prescribed)) free = .not. problem%prescribed
    idle = allocated(problem%modes) .or. .not. any(free)
    if (.not. idle) return
    take_part = .true.
    if (allocated(problem%excluded)) take_part = .not. any(problem%excluded)
    if (allocated(problem%compliance)) take_part = take_part .and. .not. any(problem%compliance > 0.0_dp)
    if (problem%has_limits()) then
      take_part = take_part .and. all([(has_force(law_at(problem, k)), k=1, problem%points())])
    end if
    idle = space%everywhere(take_part)
    if (.not. (idle .and. any(free))) return
    do j = 1, m
      associate (mode => problem%modes(:, lbound(problem%modes, 2) + j - 1))
        sums(j) = sum(mode)
        sums(m + j) = sum(abs(mode))
      end associate
    end do
    call space%add(sums)
    idle = all(abs(sums(:m)) <= NO_RESULTANT*sums(m + 1:) .or. .not. free)
  end function equal_forces_are_idle

  !> The law of point `k`, whose upper stop is none without a force there.
  pure function law_at(problem, k) result(law)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    type(point_law) :: law

    law = problem%law(k)
    if (.not. law%limit_upper > 0.0_dp) law%play = huge(law%play)
  end function law_at

  pure function has_force(law)
    type(point_law), intent(in) :: law
    logical :: has_force

    has_force = law%most_force() > law%least_force()
  end function has_force

  !> The `room` of the mean gap in a solution with these states of the points, (n).
  subroutine find_room(problem, state, space, room)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    type(point_space), intent(in) :: space
    type(gap_room), intent(out) :: room
    type(point_law) :: law
    real(dp) :: extremes(2), gap, motion(problem%mode_count()), sums(3)
    logical :: complete, two_sided
    integer :: k, points

    motion = problem%prescribed_motion()
    extremes = 0.0_dp
    sums = 0.0_dp
    two_sided = .true.
    do k = 1, size(state)
      law = law_at(problem, k)
      gap = gap_less_motions(problem, motion, k)
      sums(1) = sums(1) + gap
      extremes = max(extremes, [abs(gap), abs(problem%gap(lbound(problem%gap, 1) + k - 1))])
      two_sided = two_sided .and. law%play < huge(gap)
      if (.not. law%play < huge(gap)) cycle
      extremes = max(extremes, law%play)
      sums(2) = sums(2) + law%play
      if (state(k) <= FUGE_AT_UPPER_STOP) sums(3) = sums(3) + law%play
    end do
    call space%raise(extremes)
    call space%add(sums)
    two_sided = space%everywhere(two_sided)
    complete = space%everywhere(all(state /= FUGE_OPEN))
    points = space%total_count(size(state))
    sums = sums/real(points, dp)
    room%largest = extremes(1)
    room%rounding = ROUNDINGS*epsilon(gap)*max(extremes(1), extremes(2))*sqrt(real(points, dp))
    room%beyond = -sums(1)
    if (two_sided) room%beyond = max(room%beyond, sums(1) - sums(2))
    room%contradicts = complete .and. abs(sums(1) - sums(3)) > room%rounding
    if (complete .and. .not. room%contradicts) room%beyond = max(room%beyond, 0.0_dp)
    ! A mean just within the stops may be one at them.
    if (room%beyond >= -room%rounding) room%beyond = max(room%beyond, 0.0_dp)
  end subroutine find_room

  !> The gap of point `k` less the displacement by the prescribed motions, `motion` (m).
  pure function gap_less_motions(problem, motion, k) result(gap)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:)
    integer, intent(in) :: k
    real(dp) :: gap

    gap = problem%gap(lbound(problem%gap, 1) + k - 1)
    if (allocated(problem%modes)) then
      gap = gap - dot_product(problem%modes(lbound(problem%modes, 1) + k - 1, :), motion)
    else
      gap = gap - sum(motion)
    end if
  end function gap_less_motions

  !> Have all forces room within their limits for equal ones, because no point has given way by more than `length`?
  function level_has_room(problem, solution, length, space) result(has_room)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: length
    type(point_space), intent(in) :: space
    logical :: has_room
    type(point_law) :: law
    real(dp) :: largest, rooms(2)
    logical :: gives_way
    integer :: k

    rooms = huge(rooms)
    gives_way = .false.
    do k = 1, size(solution%force)
      law = law_at(problem, k)
      associate (force => solution%force(k), gap => solution%gap(k))
        gives_way = gives_way .or. gap < -length .or. gap > law%play + length
        ! A tied point is at both stops.
        if (law%play > 0.0_dp .and. gap > 0.5_dp*law%play) law%limit = 0.0_dp
        if (law%play > 0.0_dp .and. .not. gap > 0.5_dp*law%play) law%limit_upper = 0.0_dp
        rooms = min(rooms, [law%limit - force, law%limit_upper + force])
      end associate
    end do
    largest = space%largest(maxval(abs(solution%force)))
    rooms = [space%least(rooms(1)), space%least(rooms(2))]
    has_room = space%everywhere(.not. gives_way) .and. maxval(rooms) > NO_FORCE*largest
  end function level_has_room

end module fuge_force_level
