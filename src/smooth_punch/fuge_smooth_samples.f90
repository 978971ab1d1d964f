!> The whole profile of a smooth punch at sample points, and its lowest places.
module fuge_smooth_samples
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: lowest_place, sample_places, near_places

  !> Equal steps from end to end: what is narrower may be overlooked.
  integer, parameter, public :: STEPS = 512
  !> Places beside an end of the contact: from this part of its half width, each farther
  !> away by this factor.
  real(dp), parameter :: NEAREST = 1.0e-2_dp, FACTOR = 1.15_dp

contains

  !> STEPS + 1 places from lower to upper.
  pure function sample_places(profile) result(x)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp) :: x(0:STEPS)
    integer :: k

    do k = 0, STEPS
      x(k) = profile%lower + (profile%upper - profile%lower)*(real(k, dp)/real(STEPS, dp))
    end do
    x(STEPS) = profile%upper
  end function sample_places

  !> Distances from an end of the contact, growing, up to `farthest`.
  pure function near_places(half, farthest) result(distance)
    real(dp), intent(in) :: half, farthest
    real(dp), allocatable :: distance(:)
    real(dp) :: ratio
    integer :: k, places

    ratio = farthest/(NEAREST*half)
    places = 0
    if (ratio > 1.0_dp) places = int(log(ratio)/log(FACTOR)) + 1
    allocate (distance(places))
    do k = 1, places
      distance(k) = min(farthest, NEAREST*half*FACTOR**(k - 1))
    end do
  end function near_places

  !> The place of the smallest gap: the best sample, then the zero of the slope beside it.
  subroutine lowest_place(profile, place, gap, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(out) :: place, gap
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(0:STEPS), gaps(0:STEPS), slopes(0:STEPS)
    integer :: k

    place = 0.0_dp
    gap = 0.0_dp
    x = sample_places(profile)
    call sample_profile(profile, x, gaps, slopes, info)
    if (info%failed()) return
    k = minloc(gaps, 1) - 1
    place = x(k)
    gap = gaps(k)
    if (slopes(k) > 0.0_dp .and. k > 0) then
      call halve(profile, x(k - 1), x(k), place, gap, info)
    else if (slopes(k) < 0.0_dp .and. k < STEPS) then
      call halve(profile, x(k), x(k + 1), place, gap, info)
    end if
  end subroutine lowest_place

  !> Where the slope changes its sign between two places; the better one of that and `place`.
  subroutine halve(profile, left, right, place, gap, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: left, right
    real(dp), intent(inout) :: place, gap
    type(fuge_info), intent(inout) :: info
    real(dp) :: low, high, middle(1), gap_there(1), slope(1)

    low = left
    high = right
    do
      middle = low + 0.5_dp*(high - low)
      if (.not. (middle(1) > low .and. middle(1) < high)) exit
      call sample_profile(profile, middle, gap_there, slope, info)
      if (info%failed()) return
      if (gap_there(1) <= gap) then
        gap = gap_there(1)
        place = middle(1)
      end if
      if (slope(1) > 0.0_dp) then
        high = middle(1)
      else
        low = middle(1)
      end if
    end do
  end subroutine halve

end module fuge_smooth_samples
