!> The level of the forces on a surface that equal forces do not displace, such as a periodic one.
!>
!> Where no free motion takes them up, equal forces may be added to those of a solution in which all gaps are closed.
!> Such a solution is on the verge: the stops leave the mean gap no room, and beyond them no forces hold the motions.
module fuge_force_level
  use fuge_canonical_problem, only: canonical_problem
  use fuge_complete_contact, only: equal_forces_displace_nothing
  use fuge_contact_states, only: FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_WARN_NOT_UNIQUE, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: explain_by_force_level, judge_force_level

  !> The resultant of equal forces in a mode is rounding below this fraction of its terms.
  real(dp), parameter :: NO_RESULTANT = 1.0e-12_dp
  !> A mean counts as zero below this many units in the last place of the largest gap or play, times the root of the
  !> number of points.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

contains

  !> Warn where equal forces may be added to those of a solution (FUGE_WARN_NOT_UNIQUE), and refuse motions that leave
  !> the mean gap beyond the stops by more than `tolerance` of the lengths (FUGE_ERR_NO_EQUILIBRIUM): what an engine
  !> returns then are equal forces as large as rounding lets them become.
  !>
  !> `canonical` that of the problem with the initial `gap` (n), `state` (n) of its solution. Errors also: those of
  !> equal_forces_displace_nothing.
  subroutine judge_force_level(operator, canonical, gap, state, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), tolerance
    integer, intent(in) :: state(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: beyond, largest, rounding
    logical :: contradicts

    if (canonical%plain .or. canonical%has_translation) return
    if (.not. equal_forces_have_no_resultant(canonical)) return
    call find_room(canonical, gap, state, beyond, largest, rounding, contradicts)
    if (.not. (beyond >= 0.0_dp .or. contradicts)) return
    if (.not. equal_forces_displace_nothing(operator, info)) return
    if (contradicts .and. .not. beyond >= 0.0_dp) then
      ! Only forces large enough to lose the mean gap in their rounding can close all gaps.
      info%force_error = 1.0_dp
    else if (beyond > max(tolerance*largest, rounding)) then
      info%force_error = 0.0_dp
      call report_beyond(beyond, info)
    else
      call report(info, FUGE_WARN_NOT_UNIQUE, 'all points are at their stops, and equal forces displace nothing ' &
                  //'(a periodic surface): they may be added to the forces, which are one of many possible; gaps ' &
                  //'and motions are unique')
    end if
  end subroutine judge_force_level

  !> Where an engine has found that there is no solution (FUGE_ERR_NOT_DEFINITE), and the motions leave the mean gap
  !> beyond the stops by more than `tolerance` of the lengths, name that cause (FUGE_ERR_NO_EQUILIBRIUM).
  !>
  !> Arguments as for `judge_force_level`; `info` keeps its error otherwise.
  subroutine explain_by_force_level(operator, canonical, gap, tolerance, info)
    class(fuge_operator), intent(in) :: operator
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), tolerance
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: trial
    real(dp) :: beyond, largest, rounding
    logical :: contradicts

    ! Without any motion there is none to change.
    if (info%status /= FUGE_ERR_NOT_DEFINITE .or. canonical%mode_count() < 1) return
    if (canonical%plain .or. canonical%has_translation) return
    if (.not. equal_forces_have_no_resultant(canonical)) return
    call find_room(canonical, gap, spread(FUGE_OPEN, 1, size(gap)), beyond, largest, rounding, contradicts)
    if (.not. beyond > max(tolerance*largest, rounding)) return
    trial%products = info%products
    if (equal_forces_displace_nothing(operator, trial)) call report_beyond(beyond, info)
    info%products = trial%products
  end subroutine explain_by_force_level

  !> No forces bring the mean gap between the stops, beyond which it is by a length (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine report_beyond(beyond, info)
    real(dp), intent(in) :: beyond
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'equal forces displace nothing (a periodic surface), so no forces ' &
                //'bring the mean gap between the stops, beyond which it is by '//text(beyond) &
                //': prescribe other motions, or resultants, or change the gaps')
  end subroutine report_beyond

  !> Do all points take part, and have equal forces on them no resultant in any free mode, none of which is a
  !> translation?
  function equal_forces_have_no_resultant(canonical) result(none)
    type(canonical_problem), intent(in) :: canonical
    logical :: none
    real(dp) :: sums(2*size(canonical%load))
    integer :: j, m

    none = .false.
    if (canonical%space%anywhere(any(canonical%excluded))) return
    m = size(canonical%load)
    do j = 1, m
      sums(j) = sum(canonical%modes(:, j))
      sums(m + j) = sum(abs(canonical%modes(:, j)))
    end do
    call canonical%space%add(sums)
    none = all(abs(sums(:m)) <= NO_RESULTANT*sums(m + 1:))
  end function equal_forces_have_no_resultant

  !> How far the mean gap is `beyond` the stops, negative where they leave it room; the `largest` length that remains
  !> when the prescribed motions are taken out of the gaps, and the `rounding` of the mean. All points in contact
  !> contradict a mean gap that is not the mean of their stops.
  !>
  !> Displacements have the mean 0 here, so that the mean gap is that of the initial ones less the prescribed motions.
  !> It is between 0 and the mean play, and where all points are in contact it is the mean of their stops.
  subroutine find_room(canonical, gap, state, beyond, largest, rounding, contradicts)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:)
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: beyond, largest, rounding
    logical, intent(out) :: contradicts
    real(dp) :: extremes(2), sums(3)
    logical :: complete, two_sided
    integer :: points

    associate (upper => canonical%upper, space => canonical%space)
      points = space%total_count(size(gap))
      two_sided = space%everywhere(all(upper < huge(1.0_dp)))
      complete = space%everywhere(all(state /= FUGE_OPEN))
      extremes = max(maxval(abs(canonical%gap)), maxval(upper, mask=upper < huge(1.0_dp)))
      extremes(2) = max(extremes(2), maxval(abs(gap)))
      call space%raise(extremes)
      largest = extremes(1)
      sums = [sum(canonical%gap), sum(upper, mask=upper < huge(1.0_dp)), sum(upper, mask=state == FUGE_AT_UPPER_STOP)]
      call space%add(sums)
    end associate
    sums = sums/real(points, dp)
    rounding = ROUNDINGS*epsilon(rounding)*extremes(2)*sqrt(real(points, dp))
    beyond = -sums(1)
    if (two_sided) beyond = max(beyond, sums(1) - sums(2))
    contradicts = complete .and. abs(sums(1) - sums(3)) > rounding
    if (complete .and. .not. contradicts) beyond = max(beyond, 0.0_dp)
    ! A mean just within the stops may be one at them.
    if (beyond >= -rounding) beyond = max(beyond, 0.0_dp)
  end subroutine find_room

end module fuge_force_level
