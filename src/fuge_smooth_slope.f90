!> The slope of a punch on an interval as a Chebyshev series of just enough terms.
module fuge_smooth_slope
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: expand_slope

  !> g'(middle + half t) = sum_k a_k T_k(t).
  type, public :: slope_series
    real(dp) :: middle = 0.0_dp, half = 0.0_dp
    !> a_0 .. a_n, n >= 3.
    real(dp), allocatable :: a(:)
    !> d_0 .. of the derivative by t.
    real(dp), allocatable :: d(:)
    !> Estimates of the error of the first coefficients, and of the whole sum; no unit.
    real(dp) :: first_error = 0.0_dp, sum_error = 0.0_dp
  end type slope_series

  !> Degree that is tried first; degrees are doubled.
  integer, parameter :: FIRST_DEGREE = 16
  !> From here on coefficients that no longer fall are taken for rounding, if they are
  !> this part of the largest.
  integer, parameter :: PLATEAU_DEGREE = 64
  real(dp), parameter :: PLATEAU_SIZE = 1.0e-7_dp, PLATEAU_RATIO = 0.7_dp

contains

  !> `goal`: the part of the range of the slope that may be missing; rounding is the limit
  !> for less. `degrees`: the highest degree, a power of two. Where that does not do the
  !> series is what it can be, and its errors say so. Errors: those of the profile.
  subroutine expand_slope(profile, middle, half, goal, degrees, series, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: middle, half, goal
    integer, intent(in) :: degrees
    type(slope_series), intent(out) :: series
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: slope(:), a(:)
    real(dp) :: tail, last_tail, noise, range
    integer :: n

    series%middle = middle
    series%half = half
    tail = huge(tail)
    n = FIRST_DEGREE
    do
      call refine(profile, middle, half, n, slope, info)
      if (info%failed()) return
      if (allocated(a)) deallocate (a)
      allocate (a(n + 1))
      a = chebyshev_coefficients(slope)
      last_tail = tail
      tail = maxval(abs(a(3*n/4 + 2:)))
      range = maxval(slope) - minval(slope)
      noise = roundings(slope, middle, half, range)
      if (tail <= max(goal*range, noise) .or. n >= degrees) exit
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

  !> Values at the points of degree n; every other one is there already.
  subroutine refine(profile, middle, half, n, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: middle, half
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: slope(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: all_slopes(:)
    real(dp) :: t(0:n)
    integer :: first, step

    t = chebyshev_points(n)
    allocate (all_slopes(0:n))
    first = 0
    step = 1
    if (n > FIRST_DEGREE) then
      all_slopes(0:n:2) = slope
      first = 1
      step = 2
    end if
    call slopes_at(profile, middle + half*t(first:n:step), all_slopes(first:n:step), info)
    call move_alloc(all_slopes, slope)
  end subroutine refine

  subroutine slopes_at(profile, x, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: slope(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: gap(size(x)), values(size(x))

    ! The ends may be outside by a rounding.
    call sample_profile(profile, max(profile%lower, min(profile%upper, x)), gap, values, info)
    slope = values
  end subroutine slopes_at

  !> What rounding does to a coefficient: of the slope itself, and of the place.
  pure function roundings(slope, middle, half, range) result(noise)
    real(dp), intent(in) :: slope(:), middle, half, range
    real(dp) :: noise

    noise = epsilon(noise)*(2.0_dp*maxval(abs(slope)) + range*abs(middle)/half)
  end function roundings

  !> Leave out the last coefficients, none of them above `least`.
  pure subroutine trim_series(a, least, trimmed)
    real(dp), intent(in) :: a(:), least
    real(dp), allocatable, intent(out) :: trimmed(:)
    integer :: terms

    terms = size(a)
    do while (terms > 4)
      if (abs(a(terms)) > 0.25_dp*least) exit
      terms = terms - 1
    end do
    allocate (trimmed, source=a(:terms))
  end subroutine trim_series

end module fuge_smooth_slope
