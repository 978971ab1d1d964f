!> The slope of a punch on an interval as a Chebyshev series of just enough terms.
module fuge_smooth_slope_series
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points, chebyshev_sum, &
    chebyshev_values
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: expand_slope, compare_slope

  !> An interval: anchor + offset -+ half. The sum of the first two has more digits than one
  !> number where the interval is far from 0 compared with its length.
  type, public :: place_interval
    real(dp) :: anchor = 0.0_dp, offset = 0.0_dp, half = 0.0_dp
  end type place_interval

  !> g'(x) = sum_k a_k T_k(t) at x = anchor + offset + half t.
  type, public :: slope_series
    type(place_interval) :: interval
    !> a_0 .. a_n, n >= 3.
    real(dp), allocatable :: a(:)
    !> d_0 .. of the derivative by t.
    real(dp), allocatable :: d(:)
    !> Estimates of the error of the first coefficients, and of the whole sum; no unit.
    real(dp) :: first_error = 0.0_dp, sum_error = 0.0_dp
  end type slope_series

  !> Degree that is tried first; degrees are doubled.
  integer, parameter, public :: FIRST_DEGREE = 16
  !> From here on coefficients that no longer fall are taken for rounding, if they are
  !> this part of the largest.
  integer, parameter :: PLATEAU_DEGREE = 64
  real(dp), parameter :: PLATEAU_SIZE = 1.0e-7_dp, PLATEAU_RATIO = 0.7_dp

  !> Places of a comparison, beside those given.
  integer, parameter :: COMPARISONS = 61

contains

  !> `goal`: the part of the range of the slope that may be missing; rounding is the limit
  !> for less. `degrees`: the lowest and the highest one, powers of two, FIRST_DEGREE or more.
  !> Where the highest does not do the series is what it can be, and its errors say so.
  !> Errors: those of the profile.
  subroutine expand_slope(profile, interval, goal, degrees, series, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(place_interval), intent(in) :: interval
    real(dp), intent(in) :: goal
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
      call refine(profile, interval, n, slope, info)
      if (info%failed()) return
      if (allocated(a)) deallocate (a)
      allocate (a(n + 1))
      a = chebyshev_coefficients(slope)
      if (abs(interval%anchor) > interval%half) a = a + place_correction(interval, a)
      last_tail = tail
      tail = maxval(abs(a(3*n/4 + 2:)))
      range = maxval(slope) - minval(slope)
      noise = roundings(slope, interval)
      if (tail <= max(goal*range, noise) .or. n >= degrees(2)) exit
      if (n >= PLATEAU_DEGREE .and. tail <= PLATEAU_SIZE*range .and. tail > PLATEAU_RATIO*last_tail) exit
      n = 2*n
    end do
    call trim_series(a, max(noise, min(tail, goal*range)), series%a)
    allocate (series%d(size(series%a) - 1))
    series%d = chebyshev_derivative(series%a)
    series%first_error = noise + tail
    series%sum_error = noise + tail
    ! What is left out falls like a power of its number.
    if (tail > noise) series%sum_error = noise + 0.5_dp*real(n, dp)*tail
  end subroutine expand_slope

  !> How far the series is from the slope at places `x` of the profile within its interval,
  !> and at others between them; no unit.
  subroutine compare_slope(profile, series, x, difference, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(slope_series), intent(in) :: series
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: difference
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: t(:), places_there(:), gap(:), slope(:)
    integer :: k

    associate (interval => series%interval)
      allocate (t(size(x) + COMPARISONS))
      t(:size(x)) = ((x - interval%anchor) - interval%offset)/interval%half
      t(size(x) + 1:) = [(2.0_dp*(real(k, dp) - 0.4_dp)/real(COMPARISONS, dp) - 1.0_dp, k=1, COMPARISONS)]
      t = pack(t, abs(t) < 1.0_dp)
      allocate (places_there(size(t)), gap(size(t)), slope(size(t)))
      places_there = interval%anchor + (interval%offset + interval%half*t)
      places_there = max(profile%lower, min(profile%upper, places_there))
      call sample_profile(profile, places_there, gap, slope, info)
      difference = maxval(abs(slope - chebyshev_sum(series%a, ((places_there - interval%anchor) - interval%offset) &
                                                    /interval%half)))
    end associate
  end subroutine compare_slope

  !> Values at the points of degree n; every other one is there already.
  subroutine refine(profile, interval, n, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(place_interval), intent(in) :: interval
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
    ! The ends may be outside by a rounding.
    x = max(profile%lower, min(profile%upper, places(interval, n)))
    call sample_profile(profile, x(first:n:step), gap(first:n:step), values(first:n:step), info)
    all_slopes(first:n:step) = values(first:n:step)
    call move_alloc(all_slopes, slope)
  end subroutine refine

  !> The points of degree n, rounded to one number each.
  pure function places(interval, n) result(x)
    type(place_interval), intent(in) :: interval
    integer, intent(in) :: n
    real(dp) :: x(0:n)

    x = interval%anchor + (interval%offset + interval%half*chebyshev_points(n))
  end function places

  !> What the rounding of the places has done to the coefficients `a` of the slope, to first
  !> order: the distance lost times the derivative.
  pure function place_correction(interval, a) result(change)
    type(place_interval), intent(in) :: interval
    real(dp), intent(in) :: a(:)
    real(dp) :: change(size(a))
    real(dp) :: lost(size(a))
    integer :: n

    n = size(a) - 1
    lost = (interval%offset + interval%half*chebyshev_points(n)) - (places(interval, n) - interval%anchor)
    change = chebyshev_coefficients(lost/interval%half*chebyshev_values(chebyshev_derivative(a), n))
  end function place_correction

  !> What rounding does to a coefficient: of the slope itself, of the place within the
  !> interval, and of the anchor what the first order leaves.
  pure function roundings(slope, interval) result(noise)
    real(dp), intent(in) :: slope(:)
    type(place_interval), intent(in) :: interval
    real(dp) :: noise
    real(dp) :: range

    range = maxval(slope) - minval(slope)
    noise = epsilon(noise)*(2.0_dp*maxval(abs(slope)) + 2.0_dp*range*(1.0_dp + abs(interval%offset)/interval%half))
    noise = noise + real(size(slope), dp)*range*(epsilon(noise)*interval%anchor/interval%half)**2
  end function roundings

  !> Leave out the last coefficients, none of them above `least`.
  pure subroutine trim_series(a, least, trimmed)
    real(dp), intent(in) :: a(:), least
    real(dp), allocatable, intent(out) :: trimmed(:)
    integer :: terms

    terms = size(a)
    do while (terms > 4)
      if (abs(a(terms)) > least) exit
      terms = terms - 1
    end do
    allocate (trimmed, source=a(:terms))
  end subroutine trim_series

end module fuge_smooth_slope_series
