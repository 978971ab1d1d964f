!> Resultants that no contact forces can carry, in words.
module fuge_equilibrium_report
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_orthogonal_modes, only: mode_change
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: report_no_equilibrium

contains

  !> Name the resultant that no contact forces can carry (FUGE_ERR_NO_EQUILIBRIUM).
  !>
  !> `free` (m) the positions of the free modes of the problem, which `change` made orthogonal; `remainder` (m) the
  !> motion in these that proves it. `excluded` (n) and `has_play`, whether there are points with play or tied ones, are
  !> those of this rank.
  subroutine report_no_equilibrium(problem, free, change, excluded, has_play, remainder, space, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    type(mode_change), intent(in) :: change
    logical, intent(in) :: excluded(:), has_play
    real(dp), intent(in) :: remainder(:)
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    real(dp) :: motion(size(remainder))
    integer :: worst

    if (problem%has_limits()) then
      call report_limits(problem, free, change, remainder, info)
    else if (.not. allocated(problem%modes)) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'resultant '//text(problem%resultant(1))//' is negative: contact ' &
                  //'forces can only push, so it must be >= 0')
    else
      call report_line_of_action(problem, free, excluded, has_play, [1, 2], space, info)
      if (.not. info%failed()) call report_line_of_action(problem, free, excluded, has_play, [2, 1], space, info)
      if (info%failed()) return
      associate (w => problem%resultant(free))
        motion = change%given_motion(remainder)
        worst = maxloc(change%contributions(remainder), dim=1)
        call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'no forces that push give the resultant '//text(w(worst)) &
                    //' in motion '//index_text(free(worst)) &
                    //' together with the others: moving along it by ' &
                    //text(motion(worst))//' closes no contact, but the resultants do work')
      end associate
    end if
  end subroutine report_no_equilibrium

  !> The same where forces have limits: all of them together do not carry the resultant.
  subroutine report_limits(problem, free, change, remainder, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    type(mode_change), intent(in) :: change
    real(dp), intent(in) :: remainder(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: motion(size(remainder))
    integer :: worst

    worst = 1
    motion = remainder
    if (allocated(problem%modes)) then
      motion = change%given_motion(remainder)
      worst = maxloc(change%contributions(remainder), dim=1)
    end if
    call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'no forces within their limits give the resultant ' &
                //text(problem%resultant(free(worst)))//' in motion '//index_text(free(worst)) &
                //' together with the others: moving along it by '//text(motion(worst)) &
                //', all forces at their limits do less work than the resultants')
  end subroutine report_limits

  !> With one translation and one tilt, the `pair` of positions among the free modes, report the line of action if it
  !> lies outside of the contact points. Not for points with play or tied ones, which carry any line of action.
  subroutine report_line_of_action(problem, free, excluded, has_play, pair, space, info)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:), pair(2)
    logical, intent(in) :: excluded(:), has_play
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    real(dp) :: extremes(4), x
    integer :: k

    if (size(free) /= 2) return
    if (space%anywhere(has_play)) return
    associate (w => problem%resultant(free), unit => problem%modes(:, free(pair(1))), translation => pair(1), &
               tilt => pair(2))
      extremes(1:2) = [-minval(unit), maxval(unit)]
      call space%raise(extremes(1:2))
      if (.not. (-extremes(1) > 0.0_dp .and. extremes(2) <= -extremes(1) .and. w(translation) > 0.0_dp)) return
      extremes(3:4) = -huge(x)
      do k = 1, size(unit)
        if (excluded(k)) cycle
        x = problem%modes(k, free(tilt))/unit(k)
        extremes(3:4) = max(extremes(3:4), [-x, x])
      end do
      call space%raise(extremes(3:4))
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the line of action passes at '//text(w(tilt)/w(translation)) &
                  //', but the points reach from '//text(-extremes(3))//' to ' &
                  //text(extremes(4))//' only: move the load between them')
    end associate
  end subroutine report_line_of_action

end module fuge_equilibrium_report
