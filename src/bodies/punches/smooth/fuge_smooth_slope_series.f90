!> The slope of a punch on an interval as a Chebyshev series with as many terms as its accuracy needs.
module fuge_smooth_slope_series
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points, chebyshev_sum, &
    chebyshev_values
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: expand_slope, measure_series_error

  !> The interval with the ends anchor + offset -+ half_width; length. The middle is a sum of two numbers,
  !> because one number has too few digits for a narrow interval far from 0.
  type, public :: anchored_interval
    real(dp) :: anchor = 0.0_dp, offset = 0.0_dp, half_width = 0.0_dp
  end type anchored_interval

  !> g'(x) = sum_k a_k T_k(t) at x = anchor + offset + half_width t.
  type, public :: slope_series
    type(anchored_interval) :: interval
    !> Coefficients a_0 .. a_n, n >= 3; no unit.
    real(dp), allocatable :: coefficients(:)
    !> Coefficients d_0 .. d_(n-1) of the derivative by t.
    real(dp), allocatable :: derivative(:)
    !> Estimated errors of the leading coefficients, and of the whole sum; no unit.
    real(dp) :: leading_error = 0.0_dp, series_error = 0.0_dp
  end type slope_series

  !> The first degree tried; degrees are doubled.
  integer, parameter, public :: FIRST_DEGREE = 16
  !> From this degree on a tail below this fraction of the range of the slope counts as rounding if
  !> doubling the degree has not reduced it below this ratio.
  integer, parameter :: PLATEAU_DEGREE = 64
  real(dp), parameter :: PLATEAU_SIZE = 1.0e-7_dp, PLATEAU_RATIO = 0.7_dp

  !> Positions of a comparison in addition to the samples.
  integer, parameter :: CHECK_POINTS = 61

contains

  !> Expand the slope of `profile` on `interval`.
  !>
  !> `tolerance`: size of the tail allowed, relative to the range of the slope; the limit is rounding.
  !> `degrees`: the lowest and the highest degree, powers of two, FIRST_DEGREE or more. If the
  !> highest does not suffice, the errors of `series` say so.
  !> Errors: those of the profile.
  subroutine expand_slope(profile, interval, tolerance, degrees, series, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(anchored_interval), intent(in) :: interval
    real(dp), intent(in) :: tolerance
    integer, intent(in) :: degrees(2)
    type(slope_series), intent(out) :: series
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: slope(:), a(:)
    real(dp) :: tail, last_tail, noise, range
    integer :: n

    series%interval = interval
    tail = huge(tail)
    n = degrees(1)
    do
      call resample(profile, interval, n, slope, info)
      if (info%failed()) return
      if (allocated(a)) deallocate (a)
      allocate (a(n + 1))
      a = chebyshev_coefficients(slope)
      if (abs(interval%anchor) > interval%half_width) a = a + node_correction(interval, a)
      last_tail = tail
      tail = maxval(abs(a(3*n/4 + 2:)))
      range = maxval(slope) - minval(slope)
      noise = rounding_noise(slope, interval)
      if (tail <= max(tolerance*range, noise) .or. n >= degrees(2)) exit
      if (n >= PLATEAU_DEGREE .and. tail <= PLATEAU_SIZE*range .and. tail > PLATEAU_RATIO*last_tail) exit
      n = 2*n
    end do
    call truncate_series(a, max(noise, min(tail, tolerance*range)), series%coefficients)
    allocate (series%derivative(size(series%coefficients) - 1))
    series%derivative = chebyshev_derivative(series%coefficients)
    series%leading_error = noise + tail
    series%series_error = noise + tail
    ! The coefficients beyond the tail decay algebraically.
    if (tail > noise) series%series_error = noise + 0.5_dp*real(n, dp)*tail
  end subroutine expand_slope

  !> Largest difference of the series from the slope of `profile`, no unit: at those of the positions `x`
  !> that lie in the interval, and at others between them.
  subroutine measure_series_error(profile, series, x, difference, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(slope_series), intent(in) :: series
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: difference
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: t(:), positions(:), gap(:), slope(:)
    integer :: k

    associate (interval => series%interval)
      allocate (t(size(x) + CHECK_POINTS))
      t(:size(x)) = ((x - interval%anchor) - interval%offset)/interval%half_width
      t(size(x) + 1:) = [(2.0_dp*(real(k, dp) - 0.4_dp)/real(CHECK_POINTS, dp) - 1.0_dp, k=1, CHECK_POINTS)]
      t = pack(t, abs(t) < 1.0_dp)
      allocate (positions(size(t)), gap(size(t)), slope(size(t)))
      positions = interval%anchor + (interval%offset + interval%half_width*t)
      positions = max(profile%lower, min(profile%upper, positions))
      call sample_profile(profile, positions, gap, slope, info)
      t = ((positions - interval%anchor) - interval%offset)/interval%half_width
      difference = maxval(abs(slope - chebyshev_sum(series%coefficients, t)))
    end associate
  end subroutine measure_series_error

  !> Slopes at the nodes of degree n; on entry `slope` has those of degree n/2, or is not allocated.
  subroutine resample(profile, interval, n, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(anchored_interval), intent(in) :: interval
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: slope(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: all_slopes(:)
    real(dp) :: x(0:n), gap(0:n), values(0:n)
    integer :: first, step

    allocate (all_slopes(0:n))
    all_slopes = 0.0_dp
    first = 0
    step = 1
    if (allocated(slope)) then
      all_slopes(0:n:2) = slope
      first = 1
      step = 2
    end if
    ! By rounding the ends may lie outside of the profile.
    x = max(profile%lower, min(profile%upper, nodes(interval, n)))
    call sample_profile(profile, x(first:n:step), gap(first:n:step), values(first:n:step), info)
    all_slopes(first:n:step) = values(first:n:step)
    call move_alloc(all_slopes, slope)
  end subroutine resample

  !> The nodes of degree n, each rounded to one number; length.
  pure function nodes(interval, n) result(x)
    type(anchored_interval), intent(in) :: interval
    integer, intent(in) :: n
    real(dp) :: x(0:n)

    x = interval%anchor + (interval%offset + interval%half_width*chebyshev_points(n))
  end function nodes

  !> Correction of the coefficients `a` for the rounding of the nodes, to first order: the distance
  !> lost by rounding times the derivative.
  pure function node_correction(interval, a) result(change)
    type(anchored_interval), intent(in) :: interval
    real(dp), intent(in) :: a(:)
    real(dp) :: change(size(a))
    real(dp) :: lost_digits(size(a))
    integer :: n

    n = size(a) - 1
    lost_digits = (interval%offset + interval%half_width*chebyshev_points(n)) - (nodes(interval, n) - interval%anchor)
    change = chebyshev_coefficients(lost_digits/interval%half_width*chebyshev_values(chebyshev_derivative(a), n))
  end function node_correction

  !> Rounding error of a coefficient: by rounding of the slope and of the position within the interval,
  !> and by what the first-order correction for rounding of the anchor leaves.
  pure function rounding_noise(slope, interval) result(noise)
    real(dp), intent(in) :: slope(:)
    type(anchored_interval), intent(in) :: interval
    real(dp) :: noise
    real(dp) :: range

    range = maxval(slope) - minval(slope)
    noise = epsilon(noise) &
            *(2.0_dp*maxval(abs(slope)) + 2.0_dp*range*(1.0_dp + abs(interval%offset)/interval%half_width))
    noise = noise + real(size(slope), dp)*range*(epsilon(noise)*interval%anchor/interval%half_width)**2
  end function rounding_noise

  !> Drop the last coefficients, none of which exceeds `threshold`; at least 4 remain.
  pure subroutine truncate_series(a, threshold, truncated)
    real(dp), intent(in) :: a(:), threshold
    real(dp), allocatable, intent(out) :: truncated(:)
    integer :: terms

    terms = size(a)
    do while (terms > 4)
      if (abs(a(terms)) > threshold) exit
      terms = terms - 1
    end do
    allocate (truncated, source=a(:terms))
  end subroutine truncate_series

end module fuge_smooth_slope_series
