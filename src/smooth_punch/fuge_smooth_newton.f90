!> The ends of one interval of contact: Newton's method for its middle and half length.
!>
!> With g'(middle + half t) = sum_k a_k T_k(t) the pressure is without a singularity at both
!> ends if a_0 is the tilt, and its resultants are pi E* half a_1/4 and, about the middle,
!> pi E* half**2 a_2/8. The unknowns are changed relative to the half length and the load
!> compared by its logarithm: for x**2, x**4 and |x|**q one step is the answer.
module fuge_smooth_newton
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_slope_series, only: expand_slope, place_interval, slope_series
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_ends

  !> What the contact has to carry.
  type, public :: pressing
    !> 4 F/(pi E*), which half a_1 has to be; length.
    real(dp) :: load = 0.0_dp
    !> Tilt free under the moment; otherwise the tilt is 0.
    logical :: tilts = .false.
    !> Moment over force: where the resultant acts; length.
    real(dp) :: line = 0.0_dp
  end type pressing

  !> Highest degree of the series.
  integer, parameter, public :: DEGREES = 1024
  !> The same for steps that need not be exact.
  integer, parameter :: COARSE_DEGREES = 128
  integer, parameter :: MOST_STEPS = 60
  !> Steps one after the other that would leave the profile.
  integer, parameter :: MOST_CUTS = 5
  !> Largest change of the half length, in its logarithm, and of the middle, in half lengths.
  real(dp), parameter :: LONGEST_SCALING = 3.0_dp, LONGEST_MOVE = 1.0_dp
  !> The error is the square of the last step's; steps this small may be rounding.
  real(dp), parameter :: LAST_STEP = 1.0e-10_dp, ROUNDING_STEP = 1.0e-5_dp
  !> The series need not be exact before steps are this small.
  real(dp), parameter :: COARSE_STEP = 1.0e-2_dp, COARSE_GOAL = 1.0e-5_dp, FINE_GOAL = 0.1_dp*epsilon(1.0_dp)

  !> A step that there is not.
  real(dp), parameter :: UNSOLVABLE = 0.25_dp*huge(1.0_dp)

contains

  !> From an interval to one that carries what it has to. `least`: the lowest degree of the
  !> series, a power of two up to DEGREES. `series`, if `found`: the slope on
  !> it, with its errors relative to a_1, the first one as a change of the interval in half
  !> lengths. `steps` counts the series formed.
  subroutine find_ends(profile, task, first, least, series, found, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(pressing), intent(in) :: task
    type(place_interval), intent(in) :: first
    integer, intent(in) :: least
    type(slope_series), intent(out) :: series
    logical, intent(out) :: found
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    real(dp) :: change(2), residual(2), size_now, size_before, step, step_before, goal, left
    type(place_interval) :: interval, start
    logical :: cut
    integer :: k, cuts, most

    found = .false.
    cuts = 0
    goal = COARSE_GOAL
    size_before = huge(size_before)
    step_before = huge(step_before)
    change = 0.0_dp
    step = huge(step)
    interval = first
    start = first
    do k = 1, MOST_STEPS
      most = merge(DEGREES, max(least, COARSE_DEGREES), goal <= FINE_GOAL)
      call expand_slope(profile, interval, goal, [least, most], series, info)
      steps = steps + 1
      if (info%failed()) return
      size_now = huge(size_now)
      if (series%a(2) > 0.0_dp) then
        residual = residual_of(series, task)
        size_now = maxval(abs(residual))
      end if
      if (too_far(size_now, size_before, change)) then
        if (k == 1 .or. maxval(abs(change)) < ROUNDING_STEP) return
        change = 0.5_dp*change
      else
        if (maxval(abs(change)) <= LAST_STEP .and. k > 1 .and. goal <= FINE_GOAL) exit
        start = interval
        size_before = size_now
        step_before = step
        change = newton_step(series, task, residual)
        step = maxval(abs(change))
        if (step >= UNSOLVABLE) return
        if (step <= COARSE_STEP .and. goal > FINE_GOAL) then
          goal = FINE_GOAL
          size_before = huge(size_before)
        end if
        if (step <= ROUNDING_STEP .and. step > 0.3_dp*step_before) exit
        change = [max(-LONGEST_MOVE, min(LONGEST_MOVE, change(1))), &
                  max(-LONGEST_SCALING, min(LONGEST_SCALING, change(2)))]
      end if
      call move(profile, start, change, interval, cut)
      if (.not. interval%half > 0.0_dp) return
      cuts = merge(cuts + 1, 0, cut)
      if (cuts > MOST_CUTS) return
    end do
    found = k <= MOST_STEPS
    if (.not. found) return
    ! What is left after the last step, at the rate of the steps.
    left = step*min(1.0_dp, step/step_before) &
           + series%first_error/series%a(2)*max(1.0_dp, sensitivity(series, task))
    series%first_error = left
    series%sum_error = left + series%sum_error/series%a(2)
  end subroutine find_ends

  !> Does a step make things worse, and not by rounding? No load is carried at all where a_1
  !> is not positive.
  pure function too_far(size_now, size_before, change)
    real(dp), intent(in) :: size_now, size_before, change(2)
    logical :: too_far

    too_far = size_now >= huge(size_now) &
              .or. (0.5_dp*size_now > size_before .and. maxval(abs(change)) >= ROUNDING_STEP)
  end function too_far

  !> An interval changed by a step; `cut` if that has to be shorter to stay in the profile.
  pure subroutine move(profile, start, change, interval, cut)
    class(fuge_smooth_profile), intent(in) :: profile
    type(place_interval), intent(in) :: start
    real(dp), intent(in) :: change(2)
    type(place_interval), intent(out) :: interval
    logical, intent(out) :: cut
    real(dp) :: left, right

    interval = start
    interval%half = start%half*exp(change(2))
    interval%offset = start%offset + min(start%half, interval%half)*change(1)
    left = interval%offset - interval%half
    right = interval%offset + interval%half
    cut = start%anchor + left < profile%lower .or. start%anchor + right > profile%upper
    if (.not. cut) return
    left = min(max(left, profile%lower - start%anchor), profile%upper - start%anchor)
    right = min(max(right, profile%lower - start%anchor), profile%upper - start%anchor)
    interval%offset = 0.5_dp*(left + right)
    interval%half = 0.5_dp*(right - left)
  end subroutine move

  !> Of the middle (tilt, or moment) and of the load; no unit.
  pure function residual_of(series, task) result(residual)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: residual(2)

    associate (a => series%a)
      residual(1) = a(1)/a(2)
      if (task%tilts) residual(1) = off_line(series, task) + 0.5_dp*a(3)/a(2)
      residual(2) = log(series%interval%half*a(2)/task%load)
    end associate
  end function residual_of

  !> Distance of the middle from where the force acts, in half lengths.
  pure function off_line(series, task) result(distance)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: distance

    distance = ((series%interval%anchor - task%line) + series%interval%offset)/series%interval%half
  end function off_line

  !> Derivatives of the residual by the middle over the half length, and by the logarithm
  !> of that: those of the a_k are d_k, and the coefficients of t sum_k d_k T_k.
  pure function jacobian(series, task) result(matrix)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: matrix(2, 2)
    real(dp) :: d(0:3), a_change(0:2, 2)

    d = 0.0_dp
    d(:min(4, size(series%d)) - 1) = series%d(:min(4, size(series%d)))
    a_change(:, 1) = d(:2)
    a_change(:, 2) = [0.5_dp*d(1), d(0) + 0.5_dp*d(2), 0.5_dp*(d(1) + d(3))]
    associate (a => series%a)
      if (task%tilts) then
        matrix(1, :) = 0.5_dp*(a_change(2, :)*a(2) - a(3)*a_change(1, :))/a(2)**2
        matrix(1, 1) = matrix(1, 1) + 1.0_dp
        matrix(1, 2) = matrix(1, 2) - off_line(series, task)
      else
        matrix(1, :) = (a_change(0, :)*a(2) - a(1)*a_change(1, :))/a(2)**2
      end if
      matrix(2, :) = a_change(1, :)/a(2)
      matrix(2, 2) = matrix(2, 2) + 1.0_dp
    end associate
  end function jacobian

  !> UNSOLVABLE where the matrix is singular.
  pure function newton_step(series, task, residual) result(change)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp), intent(in) :: residual(2)
    real(dp) :: change(2)
    real(dp) :: m(2, 2), determinant

    m = jacobian(series, task)
    determinant = m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)
    change = UNSOLVABLE
    if (abs(determinant) <= epsilon(determinant)*maxval(abs(m))**2) return
    change(1) = -(m(2, 2)*residual(1) - m(1, 2)*residual(2))/determinant
    change(2) = -(m(1, 1)*residual(2) - m(2, 1)*residual(1))/determinant
  end function newton_step

  !> Largest change for a unit residual.
  pure function sensitivity(series, task) result(largest)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: largest

    largest = maxval(abs(newton_step(series, task, [1.0_dp, 0.0_dp])) &
                     + abs(newton_step(series, task, [0.0_dp, 1.0_dp])))
  end function sensitivity

end module fuge_smooth_newton
