!> The ends of one interval of contact: Newton's method for its middle and its half width h.
!>
!> With g'(middle + h t) = sum_k a_k T_k(t) the pressure is not singular at either end if a_0 is the
!> tilt; then its resultant is pi E* h a_1/4 and its moment about the middle pi E* h**2 a_2/8. The
!> unknowns are the middle relative to h and the logarithm of h, and the force is compared by its
!> logarithm: for x**2, x**4 and |x|**q one step gives the solution.
module fuge_smooth_newton
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_slope_series, only: expand_slope, anchored_interval, slope_series
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_ends

  !> The load on the contact.
  type, public :: load_case
    !> 4 F/(pi E*), to which h a_1 must be equal; length.
    real(dp) :: reduced_force = 0.0_dp
    !> Is the tilt free under a moment? Otherwise the tilt is 0.
    logical :: free_tilt = .false.
    !> Moment over force: the position where the resultant acts; length.
    real(dp) :: line_of_action = 0.0_dp
  end type load_case

  !> Highest degree of the series.
  integer, parameter, public :: MAX_DEGREE = 1024
  !> Highest degree for steps that need not be exact.
  integer, parameter :: COARSE_MAX_DEGREE = 128
  integer, parameter :: MAX_STEPS = 60
  !> Consecutive steps shortened because they would leave the profile.
  integer, parameter :: MAX_SHORTENINGS = 5
  !> Largest change of the logarithm of the half width, and of the middle in half widths.
  real(dp), parameter :: MAX_SCALING = 3.0_dp, MAX_SHIFT = 1.0_dp
  !> Newton's method ends after a step this small: the error is its square.
  real(dp), parameter :: LAST_STEP = 1.0e-10_dp
  !> Smaller steps may consist of rounding.
  real(dp), parameter :: ROUNDING_STEP = 1.0e-5_dp
  !> Until a step is this small the series need not be exact.
  real(dp), parameter :: COARSE_STEP = 1.0e-2_dp
  !> Tolerance of the series before and after such a step.
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-5_dp, FINE_TOLERANCE = 0.1_dp*epsilon(1.0_dp)
  !> Marks that Newton's step does not exist, because the Jacobian is singular.
  real(dp), parameter :: UNSOLVABLE = 0.25_dp*huge(1.0_dp)

contains

  !> Newton's method from the interval `first` to one that carries `load`.
  !>
  !> `lowest_degree` of the series is a power of two up to MAX_DEGREE. If `converged`, `series` is the
  !> slope on the interval found; its errors are then relative to a_1, and `leading_error` is that
  !> of the interval in half widths. `steps` counts the series formed. Errors: those of the profile.
  subroutine find_ends(profile, load, first, lowest_degree, series, converged, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(load_case), intent(in) :: load
    type(anchored_interval), intent(in) :: first
    integer, intent(in) :: lowest_degree
    type(slope_series), intent(out) :: series
    logical, intent(out) :: converged
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    real(dp) :: change(2), residual(2), residual_size, previous_size, step, previous_step, tolerance
    type(anchored_interval) :: interval, start
    logical :: shortened
    integer :: k, shortenings, degree_limit

    converged = .false.
    shortenings = 0
    tolerance = COARSE_TOLERANCE
    previous_size = huge(previous_size)
    previous_step = huge(previous_step)
    change = 0.0_dp
    step = huge(step)
    interval = first
    start = first
    do k = 1, MAX_STEPS
      degree_limit = merge(MAX_DEGREE, max(lowest_degree, COARSE_MAX_DEGREE), tolerance <= FINE_TOLERANCE)
      call expand_slope(profile, interval, tolerance, [lowest_degree, degree_limit], series, info)
      steps = steps + 1
      if (info%failed()) return
      residual_size = huge(residual_size)
      if (series%coefficients(2) > 0.0_dp) then
        residual = newton_residual(series, load)
        residual_size = maxval(abs(residual))
      end if
      if (is_worse(residual_size, previous_size, change)) then
        if (k == 1 .or. maxval(abs(change)) < ROUNDING_STEP) return
        change = 0.5_dp*change
      else
        if (maxval(abs(change)) <= LAST_STEP .and. k > 1 .and. tolerance <= FINE_TOLERANCE) exit
        start = interval
        previous_size = residual_size
        previous_step = step
        change = newton_step(series, load, residual)
        step = maxval(abs(change))
        if (step >= UNSOLVABLE) return
        if (step <= COARSE_STEP .and. tolerance > FINE_TOLERANCE) then
          tolerance = FINE_TOLERANCE
          previous_size = huge(previous_size)
        end if
        if (step <= ROUNDING_STEP .and. step > 0.3_dp*previous_step) exit
        change = [max(-MAX_SHIFT, min(MAX_SHIFT, change(1))), &
                  max(-MAX_SCALING, min(MAX_SCALING, change(2)))]
      end if
      call apply_step(profile, start, change, interval, shortened)
      if (.not. interval%half_width > 0.0_dp) return
      shortenings = merge(shortenings + 1, 0, shortened)
      if (shortenings > MAX_SHORTENINGS) return
    end do
    converged = k <= MAX_STEPS
    if (converged) call add_step_error(load, step, previous_step, series)
  end subroutine find_ends

  !> Make the errors of `series` relative to a_1, and add the error that remains after the last step, at
  !> the rate of convergence of the last two.
  pure subroutine add_step_error(load, step, previous_step, series)
    type(load_case), intent(in) :: load
    real(dp), intent(in) :: step, previous_step
    type(slope_series), intent(inout) :: series
    real(dp) :: remaining

    remaining = step*min(1.0_dp, step/previous_step) &
                + series%leading_error/series%coefficients(2)*max(1.0_dp, sensitivity(series, load))
    series%leading_error = remaining
    series%series_error = remaining + series%series_error/series%coefficients(2)
  end subroutine add_step_error

  !> Has a step increased the residual by more than rounding? The residual is huge where a_1 is not
  !> positive, because such an interval carries no force.
  pure function is_worse(residual_size, previous_size, change)
    real(dp), intent(in) :: residual_size, previous_size, change(2)
    logical :: is_worse

    is_worse = residual_size >= huge(residual_size) &
              .or. (0.5_dp*residual_size > previous_size .and. maxval(abs(change)) >= ROUNDING_STEP)
  end function is_worse

  !> Change `start` by a step; `shortened` if the whole step would leave the profile.
  pure subroutine apply_step(profile, start, change, interval, shortened)
    class(fuge_smooth_profile), intent(in) :: profile
    type(anchored_interval), intent(in) :: start
    real(dp), intent(in) :: change(2)
    type(anchored_interval), intent(out) :: interval
    logical, intent(out) :: shortened
    real(dp) :: left, right

    interval = start
    interval%half_width = start%half_width*exp(change(2))
    interval%offset = start%offset + min(start%half_width, interval%half_width)*change(1)
    left = interval%offset - interval%half_width
    right = interval%offset + interval%half_width
    shortened = start%anchor + left < profile%lower .or. start%anchor + right > profile%upper
    if (.not. shortened) return
    left = min(max(left, profile%lower - start%anchor), profile%upper - start%anchor)
    right = min(max(right, profile%lower - start%anchor), profile%upper - start%anchor)
    interval%offset = 0.5_dp*(left + right)
    interval%half_width = 0.5_dp*(right - left)
  end subroutine apply_step

  !> Residuals of the middle (tilt, or moment) and of the force; no unit.
  pure function newton_residual(series, load) result(residual)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp) :: residual(2)

    associate (a => series%coefficients)
      residual(1) = a(1)/a(2)
      if (load%free_tilt) residual(1) = eccentricity(series, load) + 0.5_dp*a(3)/a(2)
      residual(2) = log(series%interval%half_width*a(2)/load%reduced_force)
    end associate
  end function newton_residual

  !> Distance of the middle from the line of action, in half widths.
  pure function eccentricity(series, load)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp) :: eccentricity

    eccentricity = ((series%interval%anchor - load%line_of_action) + series%interval%offset)/series%interval%half_width
  end function eccentricity

  !> Derivatives of the residual by the middle over the half width, and by the logarithm of the half
  !> width: those of a_k are d_k, and the coefficients of t sum_k d_k T_k.
  pure function jacobian(series, load) result(matrix)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp) :: matrix(2, 2)
    real(dp) :: d(0:3), a_change(0:2, 2)

    d = 0.0_dp
    d(:min(4, size(series%derivative)) - 1) = series%derivative(:min(4, size(series%derivative)))
    a_change(:, 1) = d(:2)
    a_change(:, 2) = [0.5_dp*d(1), d(0) + 0.5_dp*d(2), 0.5_dp*(d(1) + d(3))]
    associate (a => series%coefficients)
      if (load%free_tilt) then
        matrix(1, :) = 0.5_dp*(a_change(2, :) - a(3)/a(2)*a_change(1, :))/a(2)
        matrix(1, 1) = matrix(1, 1) + 1.0_dp
        matrix(1, 2) = matrix(1, 2) - eccentricity(series, load)
      else
        matrix(1, :) = (a_change(0, :) - a(1)/a(2)*a_change(1, :))/a(2)
      end if
      matrix(2, :) = a_change(1, :)/a(2)
      matrix(2, 2) = matrix(2, 2) + 1.0_dp
    end associate
  end function jacobian

  !> Newton's step; UNSOLVABLE where the Jacobian is singular.
  pure function newton_step(series, load, residual) result(change)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp), intent(in) :: residual(2)
    real(dp) :: change(2)
    real(dp) :: m(2, 2), determinant

    m = jacobian(series, load)
    determinant = m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)
    change = UNSOLVABLE
    if (abs(determinant) <= epsilon(determinant)*maxval(abs(m))**2) return
    change(1) = -(m(2, 2)*residual(1) - m(1, 2)*residual(2))/determinant
    change(2) = -(m(1, 1)*residual(2) - m(2, 1)*residual(1))/determinant
  end function newton_step

  !> The largest step that a residual of size 1 causes.
  pure function sensitivity(series, load) result(largest)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp) :: largest

    largest = maxval(abs(newton_step(series, load, [1.0_dp, 0.0_dp])) &
                     + abs(newton_step(series, load, [0.0_dp, 1.0_dp])))
  end function sensitivity

end module fuge_smooth_newton
