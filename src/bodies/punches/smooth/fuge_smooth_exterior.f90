!> Penetration beside a contact in one interval.
!>
!> With t = cosh(xi), distances from the middle of the contact in half widths, the gap beside the contact is a
!> smooth function of xi, also at the end. It is expanded in Chebyshev series on panels, which are halved
!> until a panel is clear of penetration or its series is as exact as the gap; then the series decides. A tail
!> that is the same on much shorter panels is noise of the profile, below which nothing can be decided.
module fuge_smooth_exterior
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_points
  use fuge_kinds, only: dp
  use fuge_series_minimum, only: find_minimum
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_penetration

  !> Penetration beside a contact, relative to the magnitude of the gap there; no unit.
  type, public :: exterior_violation
    !> The deepest one found, and its position, length.
    real(dp) :: penetration = 0.0_dp, position = 0.0_dp
    !> A bound for the penetration that may have been overlooked where the profile is too rough for a series.
    real(dp) :: undecided = 0.0_dp
  end type exterior_violation

  !> A side of the contact: its end, 1 to the right and -1 to the left, and the length to the end of the profile.
  type :: exterior_side
    real(dp) :: contact_end = 0.0_dp, outwards = 1.0_dp, length = 0.0_dp
  end type exterior_side

  !> Degree of the series of a panel, a power of two, and where its tail begins.
  integer, parameter :: DEGREE = 16, TAIL = 13
  !> Largest panel: change of xi, and length relative to that of the profile. Narrower details than 1/512 of
  !> the profile may be overlooked.
  real(dp), parameter :: MAX_ANGLE = 1.0_dp, MAX_LENGTH = 1.0_dp/32.0_dp
  !> Panels in all, and pending ones.
  integer, parameter :: MAX_PANELS = 4096, MAX_PENDING = 128
  !> A bound for the neglected terms of a series, in sums of its tail; the amplitude of noise and its largest value, in
  !> largest coefficients of the tail.
  real(dp), parameter :: BEYOND_TAIL = 4.0_dp, NOISE_OF_TAIL = 2.0_dp, LARGEST_OF_TAIL = 10.0_dp
  !> The tail of a panel counts as noise if short panels at both of its ends, SHORT_PART of its length, have at least
  !> NOISE_RATIO of it. A detail at one place, and a wave that the short panels resolve, are not noise.
  real(dp), parameter :: SHORT_PART = 1.0_dp/16.0_dp, NOISE_RATIO = 0.5_dp
  !> A gap is resolved to this fraction of its magnitude, or to its rounding.
  real(dp), parameter :: RESOLUTION = 1.0e-11_dp
  !> Rounding errors of a gap, in units of the last place of its terms.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  !> Find the deepest penetration on side 1 (left) or 2 (right) of the contact. Errors: those of the profile.
  subroutine find_penetration(profile, contact, number, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: number
    type(exterior_violation), intent(inout) :: violation
    type(fuge_info), intent(inout) :: info
    type(exterior_side) :: side
    real(dp) :: pending(2, MAX_PENDING), panel(2), middle
    logical :: decided
    integer :: waiting, panels

    side = side_of(profile, contact, number)
    if (.not. side%length > 0.0_dp) return
    pending(:, 1) = [0.0_dp, 2.0_dp*asinh(sqrt(0.5_dp*(side%length/contact%half_width)))]
    waiting = 1
    panels = 0
    do while (waiting > 0)
      panel = pending(:, waiting)
      waiting = waiting - 1
      middle = 0.5_dp*(panel(1) + panel(2))
      decided = .false.
      if (.not. is_too_long(profile, contact, side, panel)) then
        panels = panels + 1
        call examine_panel(profile, contact, side, panel, panels >= MAX_PANELS .or. waiting + 2 > MAX_PENDING, &
                           decided, violation, info)
        if (info%failed()) return
      end if
      if (decided .or. .not. (middle > panel(1) .and. middle < panel(2))) cycle
      ! The panel next to the contact comes first.
      pending(:, waiting + 1) = [middle, panel(2)]
      pending(:, waiting + 2) = [panel(1), middle]
      waiting = waiting + 2
    end do
  end subroutine find_penetration

  pure function side_of(profile, contact, number) result(side)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: number
    type(exterior_side) :: side

    side%contact_end = contact%ends(number)
    side%outwards = real(2*number - 3, dp)
    side%length = merge(side%contact_end - profile%lower, profile%upper - side%contact_end, number == 1)
  end function side_of

  !> Distance from the end of the contact at `xi`; length.
  pure function distance(contact, xi)
    class(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: xi
    real(dp) :: distance

    distance = contact%half_width*(2.0_dp*sinh(0.5_dp*xi)**2)
  end function distance

  pure function is_too_long(profile, contact, side, panel) result(too_long)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    type(exterior_side), intent(in) :: side
    real(dp), intent(in) :: panel(2)
    logical :: too_long

    too_long = panel(2) - panel(1) > MAX_ANGLE
    if (too_long) return
    too_long = min(side%length, distance(contact, panel(2))) - distance(contact, panel(1)) &
               > MAX_LENGTH*(profile%upper - profile%lower)
  end function is_too_long

  !> Look for penetration in one panel; `decided` unless it has to be halved. The `last` one is not.
  subroutine examine_panel(profile, contact, side, panel, last, decided, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    type(exterior_side), intent(in) :: side
    real(dp), intent(in) :: panel(2)
    logical, intent(in) :: last
    logical, intent(out) :: decided
    type(exterior_violation), intent(inout) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(0:DEGREE) :: x, gap, magnitude, rounding, a
    real(dp) :: allowance, neglected, noise, largest_noise, least, t

    x = positions(profile, contact, side, panel, chebyshev_points(DEGREE))
    call exterior_gaps(profile, contact, x, gap, magnitude, rounding, info)
    decided = .true.
    if (info%failed()) return
    a = chebyshev_coefficients(gap)
    noise = NOISE_OF_TAIL*maxval(abs(a(TAIL:)))
    neglected = BEYOND_TAIL*sum(abs(a(TAIL:)))
    largest_noise = LARGEST_OF_TAIL*maxval(abs(a(TAIL:)))
    call note_penetration(x, gap, magnitude, rounding + largest_noise, violation)
    allowance = max(RESOLUTION*minval(magnitude), maxval(rounding))
    if (a(0) - sum(abs(a(1:))) - neglected >= -allowance) return
    if (neglected > allowance .and. noise > maxval(rounding)) then
      decided = last
      if (.not. decided) call compare_noise(profile, contact, side, panel, NOISE_RATIO*noise, decided, info)
      if (info%failed() .or. .not. decided) return
      violation%undecided = max(violation%undecided, (noise - maxval(rounding))/minval(magnitude))
    end if
    call find_minimum(a, 0.0_dp, max(allowance, noise), least, t)
    x(:0) = positions(profile, contact, side, panel, [t])
    call exterior_gaps(profile, contact, x(:0), gap(:0), magnitude(:0), rounding(:0), info)
    if (info%failed()) return
    call note_penetration(x(:0), gap(:0), magnitude(:0), rounding(:0) + largest_noise, violation)
  end subroutine examine_panel

  !> Does the tail exceed `level`, length, in short panels at both ends of a panel?
  subroutine compare_noise(profile, contact, side, panel, level, exceeds, info)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    type(exterior_side), intent(in) :: side
    real(dp), intent(in) :: panel(2), level
    logical, intent(out) :: exceeds
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(0:DEGREE) :: gap, magnitude, rounding, a
    real(dp) :: length, short_panel(2)
    integer :: k

    length = SHORT_PART*(panel(2) - panel(1))
    exceeds = .true.
    do k = 1, 2
      short_panel = merge([panel(1), panel(1) + length], [panel(2) - length, panel(2)], k == 1)
      call exterior_gaps(profile, contact, positions(profile, contact, side, short_panel, chebyshev_points(DEGREE)), &
                         gap, magnitude, rounding, info)
      if (info%failed()) return
      a = chebyshev_coefficients(gap)
      exceeds = exceeds .and. NOISE_OF_TAIL*maxval(abs(a(TAIL:))) > level
    end do
  end subroutine compare_noise

  !> Positions at t, -1 to 1, on a panel; length.
  pure function positions(profile, contact, side, panel, t) result(x)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    type(exterior_side), intent(in) :: side
    real(dp), intent(in) :: panel(2), t(:)
    real(dp) :: x(size(t))
    integer :: k

    do k = 1, size(t)
      x(k) = distance(contact, 0.5_dp*(panel(1) + panel(2)) + 0.5_dp*(panel(2) - panel(1))*t(k))
    end do
    x = max(profile%lower, min(profile%upper, side%contact_end + side%outwards*x))
  end function positions

  !> Gaps, the magnitudes with which they are compared, and their rounding errors; length.
  subroutine exterior_gaps(profile, contact, x, gap, magnitude, rounding, info)
    class(fuge_smooth_profile), intent(in) :: profile
    class(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), magnitude(:), rounding(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: initial(size(x)), slope(size(x)), end_gap(size(x)), rise(size(x))

    gap = 0.0_dp
    magnitude = 1.0_dp
    rounding = 0.0_dp
    call sample_profile(profile, x, initial, slope, info)
    if (info%failed()) return
    gap = contact%gap(x, initial)
    end_gap = merge(contact%end_gaps(1), contact%end_gaps(2), x <= contact%ends(1))
    rise = abs(initial - end_gap) + abs(contact%tilt)*max(contact%ends(1) - x, x - contact%ends(2), 0.0_dp)
    rounding = ROUNDINGS*epsilon(gap)*(abs(initial) + abs(end_gap) &
                                       + (abs(slope) + abs(contact%tilt))*(abs(x) + contact%half_width))
    ! The displacement is the difference of the gap and the rise.
    magnitude = max(rise + abs(gap), contact%force/contact%e_star)
  end subroutine exterior_gaps

  !> Keep the deepest penetration, without its rounding, and its position.
  pure subroutine note_penetration(x, gap, magnitude, rounding, violation)
    real(dp), intent(in) :: x(:), gap(:), magnitude(:), rounding(:)
    type(exterior_violation), intent(inout) :: violation
    real(dp) :: penetration
    integer :: k

    do k = 1, size(x)
      penetration = -(gap(k) + rounding(k))/magnitude(k)
      if (penetration <= violation%penetration) cycle
      violation%penetration = penetration
      violation%position = x(k)
    end do
  end subroutine note_penetration

end module fuge_smooth_exterior
