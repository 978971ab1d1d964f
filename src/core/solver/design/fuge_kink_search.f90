!> Points on the border between two states: there the solution has a kink, and more than one derivative.
!>
!> The solution is a piecewise linear function of gaps and loads, one piece for each set of states. A point that touches
!> without force, or has a force that is just at its limit, is weakly active: to one side of the data it touches, to the
!> other it is open.
module fuge_kink_search
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, &
    FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_point_law, only: point_law
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_WARN_KINK
  implicit none
  private

  public :: mark_kinks, warn_of_kinks

  !> Forces and lengths below this many of their errors count as zero.
  real(dp), parameter :: ERRORS = 4.0_dp

contains

  !> Mark the points on the border between two states, `at_kink` (n), as far as the errors of `solution` tell: `info` is
  !> the report of its solve, `displacement` (n) the displacements by the forces, length.
  subroutine mark_kinks(problem, solution, displacement, space, info, at_kink)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: displacement(:)
    type(point_space), intent(in) :: space
    type(fuge_info), intent(in) :: info
    logical, intent(out) :: at_kink(:)
    real(dp) :: little_gap(size(at_kink))
    real(dp) :: little_force
    integer :: j

    little_force = min(ERRORS*max(info%force_error, epsilon(1.0_dp)), 1.0_dp)*space%largest(maxval(abs(solution%force)))
    ! The residual is that of the gap equation, relative to its terms, and smaller than the error of the forces.
    little_gap = abs(problem%gap) + space%largest(maxval(abs(displacement)))
    do j = 1, size(solution%motion)
      if (allocated(problem%modes)) then
        little_gap = little_gap + abs(problem%modes(:, lbound(problem%modes, 2) + j - 1)*solution%motion(j))
      else
        little_gap = little_gap + abs(solution%motion(j))
      end if
    end do
    little_gap = min(ERRORS*max(info%residual, epsilon(1.0_dp)), 1.0_dp)*little_gap
    if (.not. (allocated(problem%gap_upper) .or. allocated(problem%excluded) .or. problem%has_limits())) then
      at_kink = merge(solution%gap <= little_gap, solution%force <= little_force, solution%state == FUGE_OPEN)
      return
    end if
    call mark_by_law(problem, solution%state, solution%force, solution%gap, little_force, little_gap, at_kink)
  end subroutine mark_kinks

  !> Mark points with laws of their own, (n) each.
  pure subroutine mark_by_law(problem, state, force, gap, little_force, little_gap, at_kink)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:), gap(:), little_force, little_gap(:)
    logical, intent(out) :: at_kink(:)
    integer :: k

    do k = 1, size(at_kink)
      at_kink(k) = is_on_border(problem%law(k), state(k), force(k), gap(k), little_force, little_gap(k))
    end do
  end subroutine mark_by_law

  !> Would a small change of `force` or `gap` bring the point to another state? Not where that changes nothing, because
  !> the point has no force in either.
  pure function is_on_border(law, state, force, gap, little_force, little_gap) result(on_border)
    type(point_law), intent(in) :: law
    integer, intent(in) :: state
    real(dp), intent(in) :: force, gap, little_force, little_gap
    logical :: on_border
    logical :: pushes, pulls

    pushes = law%limit > 0.0_dp
    pulls = law%play < huge(gap) .and. law%limit_upper > 0.0_dp
    select case (state)
    case (FUGE_AT_LOWER_STOP)
      on_border = law%limit - force <= little_force
      ! A tied point pulls at its lower stop.
      if (law%play > 0.0_dp) then
        on_border = on_border .or. force <= little_force
      else
        on_border = on_border .or. force + law%limit_upper <= little_force
      end if
    case (FUGE_AT_UPPER_STOP)
      on_border = -force <= little_force .or. law%limit_upper + force <= little_force
    case (FUGE_LIMITED_LOWER)
      on_border = pushes .and. -gap <= little_gap
    case (FUGE_LIMITED_UPPER)
      on_border = pulls .and. gap - law%play <= little_gap
    case default
      on_border = (pushes .and. gap <= little_gap) .or. (pulls .and. law%play - gap <= little_gap)
    end select
  end function is_on_border

  !> Warn of points at a kink, unless there is a warning already.
  subroutine warn_of_kinks(at_kink, space, info)
    logical, intent(in) :: at_kink(:)
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: first
    integer :: k, number

    number = space%total_count(count(at_kink))
    if (number < 1 .or. info%status /= FUGE_DONE) return
    first = ''
    do k = size(at_kink), 1, -1
      if (at_kink(k) .and. space%is_alone()) first = ', first point '//index_text(k)//','
    end do
    call report(info, FUGE_WARN_KINK, text(number)//' point(s)'//first//' lie on the border between two states, as ' &
                //'one that touches without force: the objective has a kink, and this gradient is that of one of its ' &
                //'sides')
  end subroutine warn_of_kinks

end module fuge_kink_search
