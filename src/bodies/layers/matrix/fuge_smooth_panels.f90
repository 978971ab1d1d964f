!> Intervals in panels for quadrature of a function that is smooth over a length near some places and, away from them,
!> over the distance from them.
module fuge_smooth_panels
  use fuge_kinds, only: dp
  implicit none
  private

  public :: divide, nodes_needed

  !> Panels at most.
  integer, parameter, public :: PANELS = 200
  !> Nodes of a rule of Gauss and Legendre at most, and decimal digits that it is to give.
  integer, parameter, public :: MOST_NODES = 10
  real(dp), parameter :: WANTED_DIGITS = 16.0_dp

contains

  !> The panels from `ends(1, k)` to `ends(2, k)`, k = 1 .. `count`, of the interval from `low` to `high`: none is
  !> longer than `smooth`, or than its distance from the nearest of the `places` where that is larger.
  pure subroutine divide(low, high, places, smooth, ends, count)
    real(dp), intent(in) :: low, high, places(:), smooth
    real(dp), intent(out) :: ends(2, PANELS)
    integer, intent(out) :: count
    real(dp) :: middle
    integer :: k

    count = 1
    ends(:, 1) = [low, high]
    k = 1
    do while (k <= count)
      if (ends(2, k) - ends(1, k) > smooth_length(ends(:, k), places, smooth) .and. count < PANELS) then
        middle = dividing_place(ends(:, k), places)
        count = count + 1
        ends(:, count) = [middle, ends(2, k)]
        ends(2, k) = middle
      else
        k = k + 1
      end if
    end do
  end subroutine divide

  !> The length over which the function is smooth on a panel.
  pure function smooth_length(ends, places, smooth) result(length)
    real(dp), intent(in) :: ends(2), places(:), smooth
    real(dp) :: length

    length = max(smooth, minval(max(places - ends(2), ends(1) - places)))
  end function smooth_length

  !> Where to divide a panel: at a place that is well inside, or in the middle.
  pure function dividing_place(ends, places) result(middle)
    real(dp), intent(in) :: ends(2), places(:)
    real(dp) :: middle
    integer :: k

    middle = 0.5_dp*(ends(1) + ends(2))
    do k = 1, size(places)
      if (abs(places(k) - 0.5_dp*(ends(1) + ends(2))) < 0.4_dp*(ends(2) - ends(1))) middle = places(k)
    end do
  end function dividing_place

  !> How many nodes a rule needs on a panel of these `ends`.
  pure function nodes_needed(ends, places, smooth) result(nodes)
    real(dp), intent(in) :: ends(2), places(:), smooth
    integer :: nodes
    real(dp) :: ratio

    ratio = smooth_length(ends, places, smooth)/max(ends(2) - ends(1), tiny(ratio))
    nodes = min(MOST_NODES, max(2, ceiling(0.5_dp*WANTED_DIGITS/log10(4.0_dp*min(max(ratio, 1.0_dp), 1.0e9_dp)))))
  end function nodes_needed

end module fuge_smooth_panels
