!> Signs of a round contact: pressure in it and gaps beside it are not negative.
!>
!> The answer of the contact problem is unique, so a disc that meets both conditions is the answer, however it
!> was found. Where chi' is not negative the pressure cannot be; otherwise the pressure over its root is expanded in
!> Chebyshev series on panels, which are halved until they decide. Beside the contact, r = cosh(xi) times
!> the radius, the gap is examined by `fuge_smooth_exterior`, unless (r g')' is nowhere negative: then no gap can be.
module fuge_round_signs
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points
  use fuge_abel_transform, only: abel_transform
  use fuge_kinds, only: dp
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_newton, only: FINE_TOLERANCE
  use fuge_series_minimum, only: find_minimum
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_exterior, only: exterior_violation, find_penetration
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_samples, only: sample_positions
  use fuge_smooth_slope_series, only: anchored_interval, expand_slope, measure_series_error, slope_series, FIRST_DEGREE
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: check_signs

  !> How far a contact violates the sign conditions.
  type, public :: round_violation
    !> The largest tensile pressure over the mean pressure, no unit, and its radius, length.
    real(dp) :: tension = 0.0_dp, tension_radius = 0.0_dp
    !> The deepest penetration relative to the magnitude of the gap there, no unit, and its radius, length.
    real(dp) :: penetration = 0.0_dp, penetration_radius = 0.0_dp
    !> A bound for the penetration that may have been overlooked; no unit.
    real(dp) :: undecided = 0.0_dp
  end type round_violation

  !> A round contact as the examination of the gaps beside it sees it: their right side.
  type, extends(fuge_smooth_contact) :: exterior_view
    type(fuge_round_contact) :: round
  contains
    procedure :: gaps_at => round_gaps
  end type exterior_view

  !> Signs are resolved to this fraction of the mean pressure, and of the slope at the rim.
  real(dp), parameter :: RESOLUTION = 1.0e-11_dp
  !> Degree of the series of a panel, a power of two, where its tail begins, and a bound for its neglected terms in
  !> sums of its tail.
  integer, parameter :: DEGREE = 16, TAIL = 13
  real(dp), parameter :: BEYOND_TAIL = 4.0_dp
  !> Width of the smallest panel over the radius, and closest distance from the axis over it.
  real(dp), parameter :: LEAST_PANEL = 1.0e-9_dp, CLOSEST = 1.0e-12_dp
  integer, parameter :: MAX_PENDING = 64, MAX_DEGREE = 256

contains

  !> The largest violations of the sign conditions by `contact`, whose transform is `transform`. Errors: those of
  !> the profile.
  subroutine check_signs(profile, contact, transform, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    type(round_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    type(exterior_view) :: view
    type(exterior_violation) :: exterior
    logical :: decided

    if (.not. slopes_are_positive(transform)) call find_tension(contact, transform, violation)
    call rises_everywhere(profile, transform, decided, info)
    if (info%failed() .or. decided) return
    view%round = contact
    view%ends = [-contact%radius, contact%radius]
    view%half_width = contact%radius
    view%end_gaps = contact%axis_gap + contact%radius*transform%depth()
    view%e_star = contact%e_star
    view%force = contact%load/contact%radius
    call find_penetration(profile, view, 2, exterior, info)
    if (info%failed()) return
    violation%penetration = exterior%penetration
    violation%penetration_radius = exterior%position
    violation%undecided = max(violation%undecided, exterior%undecided)
  end subroutine check_signs

  !> Is chi' nowhere negative in the contact?
  pure function slopes_are_positive(transform) result(positive)
    type(abel_transform), intent(in) :: transform
    logical :: positive
    real(dp) :: least, place

    positive = .not. (any(transform%factors < 0.0_dp) .or. any(transform%edges%factor < 0.0_dp))
    if (.not. positive .or. size(transform%coefficients) == 0) return
    call find_minimum(transform%coefficients, 0.0_dp, RESOLUTION*transform%thrust(), least, place)
    positive = least >= -RESOLUTION*transform%thrust()
  end function slopes_are_positive

  !> Is (r g')' known to be nowhere negative on the whole profile? Then chi grows everywhere.
  subroutine rises_everywhere(profile, transform, rises, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(abel_transform), intent(in) :: transform
    logical, intent(out) :: rises
    type(fuge_info), intent(inout) :: info
    type(slope_series) :: series
    real(dp), allocatable :: q(:)
    real(dp) :: difference, least, place, allowed
    integer :: n

    select type (profile)
    class is (fuge_power_profile)
      rises = all(profile%coefficients >= 0.0_dp)
      return
    end select
    rises = .false.
    call expand_slope(profile, anchored_interval(0.0_dp, 0.5_dp*profile%upper, 0.5_dp*profile%upper), FINE_TOLERANCE, &
                      [FIRST_DEGREE, MAX_DEGREE], series, info)
    if (info%failed()) return
    allowed = RESOLUTION*transform%rim_slope()
    n = size(series%coefficients)
    if (.not. real(n, dp)**2*series%series_error <= allowed) return
    call measure_series_error(profile, series, sample_positions(profile), difference, info)
    if (info%failed() .or. .not. real(n, dp)**2*difference <= 10.0_dp*allowed) return
    allocate (q, source=derivative_of_product(series%coefficients))
    call find_minimum(q, 0.0_dp, allowed, least, place)
    rises = least >= -allowed .and. 4.0_dp*epsilon(allowed)*real(n, dp)*maxval(abs(q)) <= allowed
  end subroutine rises_everywhere

  !> Coefficients of ((1 + x) sum_k a_k T_k)', the derivative of r g'.
  pure function derivative_of_product(a) result(derivative)
    real(dp), intent(in) :: a(0:)
    real(dp) :: derivative(0:size(a) - 1)
    real(dp) :: product(0:size(a))
    integer :: n

    n = size(a) - 1
    product(:n) = a
    product(n + 1) = 0.0_dp
    product(1) = product(1) + 0.5_dp*a(0)
    product(1:) = product(1:) + 0.5_dp*a
    product(:n - 1) = product(:n - 1) + 0.5_dp*a(1:)
    derivative = chebyshev_derivative(product)
  end function derivative_of_product

  !> The least pressure over its root, panel by panel from the axis to the rim.
  subroutine find_tension(contact, transform, violation)
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    type(round_violation), intent(inout) :: violation
    real(dp) :: pending(2, MAX_PENDING), panel(2), middle
    logical :: decided
    integer :: waiting

    pending(:, 1) = [0.0_dp, 1.0_dp]
    waiting = 1
    do while (waiting > 0)
      panel = pending(:, waiting)
      waiting = waiting - 1
      middle = 0.5_dp*(panel(1) + panel(2))
      call examine_panel(contact, transform, panel, &
                         panel(2) - panel(1) <= LEAST_PANEL .or. waiting + 2 > MAX_PENDING, decided, violation)
      if (decided) cycle
      pending(:, waiting + 1) = [panel(1), middle]
      pending(:, waiting + 2) = [middle, panel(2)]
      waiting = waiting + 2
    end do
  end subroutine find_tension

  !> Look for tension in one panel, in fractions of the radius; `decided` unless it has to be halved. The `last` one is
  !> not.
  subroutine examine_panel(contact, transform, panel, last, decided, violation)
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: panel(2)
    logical, intent(in) :: last
    logical, intent(out) :: decided
    type(round_violation), intent(inout) :: violation
    real(dp) :: fraction(0:DEGREE), value(0:DEGREE), a(0:DEGREE), neglected, least(1), place(1), t

    fraction = panel(1) + (panel(2) - panel(1))*(0.5_dp + 0.5_dp*chebyshev_points(DEGREE))
    value = shape_values(contact, transform, fraction)
    call note_tension(contact, fraction, value, violation)
    a = chebyshev_coefficients(value)
    neglected = BEYOND_TAIL*sum(abs(a(TAIL:)))
    decided = a(0) - sum(abs(a(1:))) - neglected >= -RESOLUTION .or. last .or. violation%tension > 1.0_dp
    if (decided) return
    decided = neglected <= RESOLUTION
    if (.not. decided) return
    call find_minimum(a, 0.0_dp, RESOLUTION, least(1), t)
    place = panel(1) + (panel(2) - panel(1))*(0.5_dp + 0.5_dp*t)
    call note_tension(contact, place, shape_values(contact, transform, place), violation)
  end subroutine examine_panel

  !> Pressure over the mean pressure and over sqrt(1 - fraction**2); finite at the rim.
  pure function shape_values(contact, transform, fraction) result(value)
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: fraction(:)
    real(dp) :: value(size(fraction))
    real(dp) :: clipped(size(fraction))

    clipped = max(CLOSEST, fraction)
    value = contact%pressure(clipped*contact%radius)/contact%e_star
    where (clipped < 1.0_dp)
      value = value/sqrt((1.0_dp - clipped)*(1.0_dp + clipped))
    else where
      value = transform%rim_slope()/acos(-1.0_dp)
    end where
    value = value*acos(-1.0_dp)/(2.0_dp*transform%thrust())
  end function shape_values

  pure subroutine note_tension(contact, fraction, value, violation)
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: fraction(:), value(:)
    type(round_violation), intent(inout) :: violation
    integer :: k

    k = minloc(value, 1)
    if (-value(k) <= violation%tension) return
    violation%tension = -value(k)
    violation%tension_radius = fraction(k)*contact%radius
  end subroutine note_tension

  pure function round_gaps(self, places, initial_gap) result(gap)
    class(exterior_view), intent(in) :: self
    real(dp), intent(in) :: places(:), initial_gap(:)
    real(dp) :: gap(size(places))

    gap = self%round%gap(places, initial_gap)
  end function round_gaps

end module fuge_round_signs
