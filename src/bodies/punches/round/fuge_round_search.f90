!> The search for the disc in which a round punch touches.
!>
!> Load and approach grow with the radius where the pressure at the rim does. Newton's method starts from the whole
!> profile. If what it finds is not the contact, all radii at which the load or the approach passes the one given
!> are tried: there may be several for a profile with waves.
module fuge_round_search
  use fuge_abel_transform, only: abel_transform, expand_transform
  use fuge_kinds, only: dp
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_newton, only: find_radius, measure_radius, round_target, FINE_TOLERANCE, GIVEN_RADIUS, MAX_DEGREE
  use fuge_round_signs, only: check_signs, round_violation
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_samples, only: sample_positions
  use fuge_smooth_slope_series, only: measure_series_error, FIRST_DEGREE
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_disc

  !> Outcome of a search: found, or the reason why not.
  integer, parameter, public :: DISC_FOUND = 0, DISC_NOT_FOUND = 1, DISC_IN_TENSION = 2, DISC_PENETRATED = 3, &
    DISC_AT_RIM = 4

  !> State of a search: the contact, or why the best disc tried is not the contact.
  type, public :: disc_search
    integer :: outcome = DISC_NOT_FOUND
    type(fuge_round_contact) :: contact
    type(abel_transform) :: transform
    type(round_violation) :: violation
    !> Radius of the disc that was refused with the least violation; length.
    real(dp) :: refused_radius = 0.0_dp
    !> Series formed so far.
    integer :: steps = 0
  end type disc_search

  !> A violation of the sign conditions is accepted up to SIGN_TOLERANCE, or ERROR_FACTOR times the estimated error.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-10_dp, ERROR_FACTOR = 10.0_dp
  !> The largest estimated error of the pressure of a contact, relative to the mean pressure.
  real(dp), parameter :: LARGEST_ERROR = 1.0_dp
  !> Radii of the second search: EQUAL_STEPS equal steps, and HALVINGS halvings of the first one.
  integer, parameter :: EQUAL_STEPS = 64, HALVINGS = 40
  !> The degree of a series that has missed a detail is raised to this one.
  integer, parameter :: RAISED_DEGREE = 64

contains

  !> Find the contact of `profile`, whose gap on the axis is `axis_gap`, length. Errors: those of the profile.
  subroutine find_disc(profile, e_star, target, axis_gap, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, axis_gap
    type(round_target), intent(in) :: target
    type(disc_search), intent(out) :: search
    type(fuge_info), intent(inout) :: info
    type(abel_transform) :: transform
    real(dp) :: excess, slope

    if (target%given == GIVEN_RADIUS) then
      call try_disc(profile, e_star, target, axis_gap, [0.0_dp, target%length], search, info)
      return
    end if
    call measure_radius(profile, target, profile%upper, FIRST_DEGREE, .false., transform, excess, slope, info)
    search%steps = 1
    if (info%failed()) return
    if (excess >= 0.0_dp) then
      call try_disc(profile, e_star, target, axis_gap, [0.0_dp, profile%upper], search, info)
      if (info%failed() .or. search%outcome == DISC_FOUND) return
    end if
    call try_all_radii(profile, e_star, target, axis_gap, search, info)
    if (info%failed() .or. search%outcome == DISC_FOUND) return
    if (excess < 0.0_dp .and. search%outcome == DISC_NOT_FOUND) search%outcome = DISC_AT_RIM
  end subroutine find_disc

  !> Try each pair of neighbouring radii between which load or approach passes the one given upwards.
  subroutine try_all_radii(profile, e_star, target, axis_gap, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, axis_gap
    type(round_target), intent(in) :: target
    type(disc_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(abel_transform) :: transform
    real(dp) :: radius(0:EQUAL_STEPS + HALVINGS), excess, previous, slope
    integer :: k

    radius(0) = 0.0_dp
    do k = 1, HALVINGS
      radius(k) = profile%upper/real(EQUAL_STEPS, dp)*0.5_dp**(HALVINGS + 1 - k)
    end do
    do k = 1, EQUAL_STEPS
      radius(HALVINGS + k) = profile%upper*(real(k, dp)/real(EQUAL_STEPS, dp))
    end do
    previous = -1.0_dp
    do k = 1, ubound(radius, 1)
      call measure_radius(profile, target, radius(k), FIRST_DEGREE, .false., transform, excess, slope, info)
      search%steps = search%steps + 1
      if (info%failed()) return
      if (previous < 0.0_dp .and. excess >= 0.0_dp) then
        call try_disc(profile, e_star, target, axis_gap, radius(k - 1:k), search, info)
        if (info%failed() .or. search%outcome == DISC_FOUND) return
      end if
      previous = excess
    end do
  end subroutine try_all_radii

  !> Find the radius between `bounds` (2), length; it is that of the contact if the signs are right.
  subroutine try_disc(profile, e_star, target, axis_gap, bounds, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, axis_gap, bounds(2)
    type(round_target), intent(in) :: target
    type(disc_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(abel_transform) :: transform
    type(fuge_round_contact) :: contact
    type(round_violation) :: violation
    real(dp) :: radius_error, worst
    logical :: converged

    call solve_resolved(profile, target, bounds, transform, radius_error, converged, search%steps, info)
    if (info%failed() .or. .not. converged) return
    if (.not. transform%thrust() > 0.0_dp) then
      if (search%outcome == DISC_NOT_FOUND .and. transform%thrust() < 0.0_dp) search%outcome = DISC_IN_TENSION
      search%refused_radius = transform%radius
      return
    end if
    call contact%set(transform, axis_gap, e_star)
    contact%radius_error = radius_error
    contact%pressure_error = contact%pressure_error + radius_error
    if (.not. contact%pressure_error <= LARGEST_ERROR) return
    call check_signs(profile, contact, transform, violation, info)
    if (info%failed()) return
    worst = max(violation%tension, violation%penetration)
    if (worst <= max(SIGN_TOLERANCE, ERROR_FACTOR*contact%pressure_error)) then
      search%outcome = DISC_FOUND
      search%contact = contact
      search%transform = transform
    else
      ! The disc with the least violation is the one to be reported.
      if (search%outcome /= DISC_NOT_FOUND &
          .and. worst >= max(search%violation%tension, search%violation%penetration)) return
      search%outcome = merge(DISC_IN_TENSION, DISC_PENETRATED, violation%tension > violation%penetration)
      search%refused_radius = contact%radius
    end if
    search%violation = violation
  end subroutine try_disc

  !> The radius with a series that is also compared with samples of the whole profile, because few nodes may miss a
  !> detail between them. Where the series differs, its degree is raised.
  subroutine solve_resolved(profile, target, bounds, transform, error, converged, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(round_target), intent(in) :: target
    real(dp), intent(in) :: bounds(2)
    type(abel_transform), intent(out) :: transform
    real(dp), intent(out) :: error
    logical, intent(out) :: converged
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    real(dp) :: difference
    integer :: degree

    degree = FIRST_DEGREE
    do
      if (target%given == GIVEN_RADIUS) then
        call expand_transform(profile, bounds(2), FINE_TOLERANCE, [degree, MAX_DEGREE], transform, info)
        steps = steps + 1
        converged = .true.
        error = 0.0_dp
      else
        call find_radius(profile, target, bounds, degree, transform, error, converged, steps, info)
      end if
      if (info%failed() .or. .not. converged .or. size(transform%coefficients) == 0) return
      call measure_series_error(profile, transform%slope, sample_positions(profile), difference, info)
      if (info%failed()) return
      if (difference <= max(SIGN_TOLERANCE*transform%rim_slope(), ERROR_FACTOR*transform%error)) return
      if (degree >= RAISED_DEGREE) exit
      degree = RAISED_DEGREE
    end do
    transform%error = max(transform%error, difference)
  end subroutine solve_resolved

end module fuge_round_search
