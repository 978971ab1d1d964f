!> Sampling positions along the profile of a smooth punch, and its lowest point.
module fuge_smooth_samples
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: lowest_position, sample_positions

  !> Equal steps from end to end of a profile. Narrower details may be overlooked.
  integer, parameter, public :: STEPS = 512

contains

  !> STEPS + 1 equidistant positions from lower to upper; length.
  pure function sample_positions(profile) result(x)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp) :: x(0:STEPS)
    integer :: k

    do k = 0, STEPS
      x(k) = profile%lower + (profile%upper - profile%lower)*(real(k, dp)/real(STEPS, dp))
    end do
    x(STEPS) = profile%upper
  end function sample_positions

  !> The position of the smallest gap, and that gap: of all samples, the zero of the slope beside the lowest one, and
  !> zeros of the slope between other samples that may be lower. Errors: those of the profile.
  subroutine lowest_position(profile, position, gap, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(out) :: position, gap
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(0:STEPS), gaps(0:STEPS), slopes(0:STEPS)
    integer :: k

    position = 0.0_dp
    gap = 0.0_dp
    x = sample_positions(profile)
    call sample_profile(profile, x, gaps, slopes, info)
    if (info%failed()) return
    k = minloc(gaps, 1) - 1
    position = x(k)
    gap = gaps(k)
    if (slopes(k) > 0.0_dp .and. k > 0) then
      call bisect_slope(profile, x(k - 1), x(k), position, gap, info)
    else if (slopes(k) < 0.0_dp .and. k < STEPS) then
      call bisect_slope(profile, x(k), x(k + 1), position, gap, info)
    end if
    if (info%failed()) return
    do k = 1, STEPS
      if (slopes(k - 1) > 0.0_dp .or. slopes(k) < 0.0_dp) cycle
      ! The tangents at both samples bound a convex profile from below.
      if (max(gaps(k - 1) + slopes(k - 1)*(x(k) - x(k - 1)), gaps(k) - slopes(k)*(x(k) - x(k - 1))) >= gap) cycle
      call bisect_slope(profile, x(k - 1), x(k), position, gap, info)
      if (info%failed()) return
    end do
  end subroutine lowest_position

  !> Bisect for the change of sign of the slope between two positions; `position` is the lowest point met.
  subroutine bisect_slope(profile, left, right, position, gap, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: left, right
    real(dp), intent(inout) :: position, gap
    type(fuge_info), intent(inout) :: info
    real(dp) :: low, high, middle(1), middle_gap(1), slope(1)

    low = left
    high = right
    do
      middle = low + 0.5_dp*(high - low)
      if (.not. (middle(1) > low .and. middle(1) < high)) exit
      call sample_profile(profile, middle, middle_gap, slope, info)
      if (info%failed()) return
      if (middle_gap(1) <= gap) then
        gap = middle_gap(1)
        position = middle(1)
      end if
      if (slope(1) > 0.0_dp) then
        high = middle(1)
      else
        low = middle(1)
      end if
    end do
  end subroutine bisect_slope

end module fuge_smooth_samples
