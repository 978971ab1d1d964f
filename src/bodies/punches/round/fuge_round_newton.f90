!> The radius of a round contact under a given load or approach: Newton's method between two bounds.
!>
!> Logarithms are compared, so that a power of the radius takes one step. The derivatives are exact: with the radius a,
!> d load = 2 E* a chi'(a) da and d approach = chi'(a) da.
module fuge_round_newton
  use fuge_abel_transform, only: abel_transform, expand_transform
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_radius, measure_radius

  !> The given quantity: a load, an approach or the radius itself.
  integer, parameter, public :: GIVEN_LOAD = 1, GIVEN_APPROACH = 2, GIVEN_RADIUS = 3

  type, public :: round_target
    integer :: given = GIVEN_LOAD
    !> The square root of load/(2 E*), or the approach less the gap on the axis, or the radius; length.
    real(dp) :: length = 0.0_dp
  end type round_target

  !> Highest degree of the series, and that of series that need not be exact.
  integer, parameter, public :: MAX_DEGREE = 128
  integer, parameter :: COARSE_MAX_DEGREE = 64
  integer, parameter :: MAX_STEPS = 120
  !> Tolerance of the series until a step of the logarithm of the radius is below COARSE_STEP, and then.
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-6_dp, COARSE_STEP = 1.0e-2_dp
  real(dp), parameter, public :: FINE_TOLERANCE = 0.1_dp*epsilon(1.0_dp)
  !> Newton's method ends after a step this small: the error is its square. Smaller steps than the second may be
  !> rounding.
  real(dp), parameter :: LAST_STEP = 1.0e-10_dp, ROUNDING_STEP = 1.0e-5_dp
  !> The largest relative error of load or approach that rounding of the radius may leave.
  real(dp), parameter :: LARGEST_ERROR = 1.0e-6_dp

contains

  !> The logarithm of load or approach on `radius` over the one given, and its derivative by that of the radius. Where
  !> the punch would have to be pulled the logarithm is that of a tiny number. `lowest_degree` of the series, a power of
  !> two. Nine arguments: a function of the radius, of the target, and of how exact it has to be, with all its results.
  subroutine measure_radius(profile, target, radius, lowest_degree, fine, transform, excess, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(round_target), intent(in) :: target
    real(dp), intent(in) :: radius
    integer, intent(in) :: lowest_degree
    logical, intent(in) :: fine
    type(abel_transform), intent(out) :: transform
    real(dp), intent(out) :: excess, slope
    type(fuge_info), intent(inout) :: info
    real(dp) :: reached

    excess = log(tiny(1.0_dp))
    slope = 0.0_dp
    call expand_transform(profile, radius, merge(FINE_TOLERANCE, COARSE_TOLERANCE, fine), &
                          [lowest_degree, merge(MAX_DEGREE, max(lowest_degree, COARSE_MAX_DEGREE), fine)], transform, &
                          info)
    if (info%failed()) return
    if (target%given == GIVEN_LOAD) then
      reached = transform%thrust()
      if (.not. reached > 0.0_dp) return
      excess = 2.0_dp*log(radius/target%length) + log(reached)
    else
      reached = transform%depth()
      if (.not. reached > 0.0_dp) return
      excess = log(radius/target%length) + log(reached)
    end if
    slope = transform%rim_slope()/reached
  end subroutine measure_radius

  !> The radius between `bounds` (2), length, of which the first one carries too little or is 0, and the second one too
  !> much. `transform` is the one on the radius found, `error` the estimated relative error of the radius. `steps`
  !> counts the series formed. Errors: those of the profile. Nine arguments: the target, and the whole outcome.
  subroutine find_radius(profile, target, bounds, lowest_degree, transform, error, converged, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(round_target), intent(in) :: target
    real(dp), intent(in) :: bounds(2)
    integer, intent(in) :: lowest_degree
    type(abel_transform), intent(out) :: transform
    real(dp), intent(out) :: error
    logical, intent(out) :: converged
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    real(dp) :: radius, lower, upper, excess, slope, change, previous, size_now
    logical :: fine
    integer :: k

    converged = .false.
    error = 0.0_dp
    lower = bounds(1)
    upper = bounds(2)
    radius = upper
    previous = huge(previous)
    fine = .false.
    do k = 1, MAX_STEPS
      call measure_radius(profile, target, radius, lowest_degree, fine, transform, excess, slope, info)
      steps = steps + 1
      if (info%failed()) return
      if (excess > 0.0_dp) upper = radius
      if (excess < 0.0_dp) lower = radius
      change = 0.0_dp
      if (slope > 0.0_dp) change = -excess/slope
      ! Close to an edge of the profile the load changes much faster than the radius.
      size_now = max(abs(change), abs(excess))
      converged = fine .and. slope > 0.0_dp .and. size_now <= LARGEST_ERROR &
                  .and. (abs(change) <= 4.0_dp*epsilon(change) &
                         .or. (size_now <= ROUNDING_STEP .and. previous <= LAST_STEP))
      if (converged) exit
      if (fine) previous = size_now
      radius = next_radius(radius, lower, upper, change, slope > 0.0_dp)
      if (.not. radius > 0.0_dp) return
      if (abs(change) <= COARSE_STEP .and. slope > 0.0_dp) fine = .true.
      if (upper <= lower*(1.0_dp + 4.0_dp*epsilon(upper))) fine = .true.
    end do
    if (converged) error = size_now + transform%error/transform%rim_slope()
  end subroutine find_radius

  !> Newton's step where it stays between the bounds; otherwise between them, in the logarithm.
  pure function next_radius(radius, lower, upper, change, valid) result(next)
    real(dp), intent(in) :: radius, lower, upper, change
    logical, intent(in) :: valid
    real(dp) :: next

    next = radius
    if (valid .and. abs(change) < 100.0_dp) next = radius*exp(change)
    if (valid .and. next >= lower .and. next <= upper .and. next > 0.0_dp .and. abs(change) < 100.0_dp) return
    next = upper/16.0_dp
    if (lower > 0.0_dp) next = sqrt(lower)*sqrt(upper)
  end function next_radius

end module fuge_round_newton
