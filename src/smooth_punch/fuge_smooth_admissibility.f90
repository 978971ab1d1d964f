!> Admissibility of a contact in one interval: the pressure must not be negative, and the punch
!> must not penetrate the half-plane outside of the contact. The solution of the contact problem
!> is unique, so that an interval which meets both conditions is the solution, however it was
!> found.
module fuge_smooth_admissibility
  use fuge_chebyshev, only: chebyshev_points, chebyshev_values, second_to_first
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_samples, only: graded_distances, sample_positions, STEPS
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: check_admissibility

  !> How far a contact violates the sign conditions.
  type, public :: sign_violation
    !> The largest tensile pressure relative to the largest pressure, no unit, and its position.
    real(dp) :: tension = 0.0_dp, tension_position = 0.0_dp
    !> The deepest penetration relative to the magnitude of the gap there, no unit, and its position.
    real(dp) :: penetration = 0.0_dp, penetration_position = 0.0_dp
  end type sign_violation

  !> Points at which the pressure is sampled, for each coefficient.
  integer, parameter :: RESAMPLING = 4
  !> Samples between the neighbours of a local minimum, and how often they close in on it.
  integer, parameter :: REFINED_SAMPLES = 9, REFINEMENTS = 12
  !> Rounding errors of a gap, in units of the last place of its terms.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  !> The largest violations of the sign conditions by `contact`. Errors: those of the profile.
  subroutine check_admissibility(profile, contact, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    integer :: side

    call find_tension(contact, violation)
    do side = 1, 2
      call find_penetration(profile, contact, side, violation, info)
      if (info%failed()) return
    end do
  end subroutine check_admissibility

  !> Sample the pressure over the square root: it has the sign of the pressure, and at the ends the
  !> sign of the pressure close to them.
  pure subroutine find_tension(contact, violation)
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(inout) :: violation
    real(dp), allocatable :: scaled_pressure(:), t(:)
    integer :: n, k

    n = 16
    do while (n < RESAMPLING*size(contact%coefficients))
      n = 2*n
    end do
    allocate (scaled_pressure(0:n), t(0:n))
    scaled_pressure = chebyshev_values(second_to_first(contact%coefficients), n)
    t = chebyshev_points(n)
    k = minloc(scaled_pressure, 1) - 1
    violation%tension = max(0.0_dp, -scaled_pressure(k)/maxval(abs(scaled_pressure)))
    violation%tension_position = 0.5_dp*(contact%ends(1) + contact%ends(2)) + contact%half_width*t(k)
  end subroutine find_tension

  !> On side 1 (left) or 2 (right) of the contact: sample the gap over the whole profile, more
  !> densely close to the contact, and refine around a sample that may hide a lower minimum.
  subroutine find_penetration(profile, contact, side, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: side
    type(sign_violation), intent(inout) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: x(:)
    real(dp) :: penetration, position
    real(dp), allocatable :: gap(:), magnitude(:)
    integer :: k

    allocate (x, source=exterior_positions(profile, contact, side))
    if (size(x) == 0) return
    allocate (gap(size(x)), magnitude(size(x)))
    call exterior_gaps(profile, contact, x, gap, magnitude, info)
    if (info%failed()) return
    do k = 1, size(x)
      penetration = -gap(k)/magnitude(k)
      position = x(k)
      if (k > 1 .and. k < size(x)) then
        if (may_hide_minimum(gap(k - 1:k + 1))) call refine_minimum(profile, contact, x(k - 1), x(k + 1), &
                                                                    penetration, position, info)
        if (info%failed()) return
      end if
      if (penetration > violation%penetration) then
        violation%penetration = penetration
        violation%penetration_position = position
      end if
    end do
  end subroutine find_penetration

  !> Sampling positions on one side of the contact, from its end outwards.
  pure function exterior_positions(profile, contact, side) result(x)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: side
    real(dp), allocatable :: x(:)
    real(dp), allocatable :: near(:), far(:)
    real(dp) :: all_positions(0:STEPS), outwards, end_position, exterior_length

    end_position = contact%ends(side)
    outwards = real(2*side - 3, dp)
    exterior_length = merge(end_position - profile%lower, profile%upper - end_position, side == 1)
    allocate (x(0))
    if (.not. exterior_length > 0.0_dp) return
    allocate (near, source=graded_distances(contact%half_width, exterior_length))
    all_positions = sample_positions(profile)
    if (side == 1) all_positions = all_positions(STEPS:0:-1)
    allocate (far, source=pack((all_positions - end_position)*outwards, &
                               (all_positions - end_position)*outwards > 0.0_dp))
    deallocate (x)
    allocate (x(size(near) + size(far)))
    x = merged(near, far)
    x = max(profile%lower, min(profile%upper, end_position + outwards*x))
  end function exterior_positions

  !> The values of two ascending arrays in ascending order.
  pure function merged(first, second) result(both)
    real(dp), intent(in) :: first(:), second(:)
    real(dp) :: both(size(first) + size(second))
    logical :: from_first
    integer :: i, j, k

    i = 1
    j = 1
    do k = 1, size(both)
      from_first = j > size(second)
      if (i <= size(first) .and. j <= size(second)) from_first = first(i) < second(j)
      if (from_first) then
        both(k) = first(i)
        i = i + 1
      else
        both(k) = second(j)
        j = j + 1
      end if
    end do
  end function merged

  !> Gaps, where a negative one of rounding size counts as 0, and their magnitudes, with which
  !> they are compared.
  subroutine exterior_gaps(profile, contact, x, gap, magnitude, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), magnitude(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: initial(size(x)), slope(size(x)), rounding(size(x)), end_gap(size(x)), rise(size(x))

    gap = 0.0_dp
    magnitude = 1.0_dp
    call sample_profile(profile, x, initial, slope, info)
    if (info%failed()) return
    gap = contact%gap(x, initial)
    end_gap = merge(contact%end_gaps(1), contact%end_gaps(2), x <= contact%ends(1))
    rise = abs(initial - end_gap) + abs(contact%tilt)*max(contact%ends(1) - x, x - contact%ends(2), 0.0_dp)
    rounding = ROUNDINGS*epsilon(gap)*(abs(initial) + abs(end_gap) &
                                       + (abs(slope) + abs(contact%tilt))*(abs(x) + contact%half_width))
    where (gap < 0.0_dp) gap = min(0.0_dp, gap + rounding)
    ! The displacement is the difference of the gap and the rise.
    magnitude = max(rise + abs(gap), contact%force/contact%e_star)
  end subroutine exterior_gaps

  !> Is the middle one of three gaps the least, and may a gap between them be negative?
  pure function may_hide_minimum(gap) result(hides)
    real(dp), intent(in) :: gap(3)
    logical :: hides

    hides = gap(2) <= min(gap(1), gap(3)) .and. gap(2) <= max(gap(1), gap(3)) - gap(2)
  end function may_hide_minimum

  !> Close in on the least gap between two positions.
  subroutine refine_minimum(profile, contact, first, last, penetration, position, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: first, last
    real(dp), intent(inout) :: penetration, position
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(REFINED_SAMPLES), gap(REFINED_SAMPLES), magnitude(REFINED_SAMPLES), ends(2)
    integer :: k, round

    ends = [first, last]
    do round = 1, REFINEMENTS
      x = [(ends(1) + (ends(2) - ends(1))*(real(k, dp)/real(REFINED_SAMPLES + 1, dp)), k=1, REFINED_SAMPLES)]
      call exterior_gaps(profile, contact, x, gap, magnitude, info)
      if (info%failed()) return
      k = minloc(gap, 1)
      if (-gap(k)/magnitude(k) > penetration) then
        penetration = -gap(k)/magnitude(k)
        position = x(k)
      end if
      if (k < REFINED_SAMPLES) ends(2) = x(k + 1)
      if (k > 1) ends(1) = x(k - 1)
    end do
  end subroutine refine_minimum

end module fuge_smooth_admissibility
