!> Is a contact in one interval the answer? The pressure must not pull, and the punch must
!> not pass into the half-plane beside the contact. The contact problem has one answer,
!> so that an interval which meets both is it, however it was found.
module fuge_smooth_admissibility
  use fuge_chebyshev, only: chebyshev_points, chebyshev_values, second_to_first
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_samples, only: near_places, sample_places, STEPS
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: check_signs

  !> How far a contact is from the sign conditions.
  type, public :: sign_violation
    !> The deepest pull relative to the highest pressure, and its place.
    real(dp) :: pull = 0.0_dp, pull_place = 0.0_dp
    !> The deepest overlap relative to the terms of the gap there, and its place.
    real(dp) :: overlap = 0.0_dp, overlap_place = 0.0_dp
  end type sign_violation

  !> Points of the pressure for each coefficient.
  integer, parameter :: DENSITY = 4
  !> Samples between the neighbours of a low one, and how often these close in on it.
  integer, parameter :: CLOSER_SAMPLES = 9, ZOOMS = 12
  !> Roundings that the terms of a gap may be off by.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  subroutine check_signs(profile, contact, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    integer :: side

    call find_pull(contact, violation)
    do side = 1, 2
      call find_overlap(profile, contact, side, violation, info)
      if (info%failed()) return
    end do
  end subroutine check_signs

  !> p over the root, which has the sign of the pressure and at the ends that of its first
  !> term, at many points.
  pure subroutine find_pull(contact, violation)
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(inout) :: violation
    real(dp), allocatable :: part(:), t(:)
    integer :: n, k

    n = 16
    do while (n < DENSITY*size(contact%coefficients))
      n = 2*n
    end do
    allocate (part(0:n), t(0:n))
    part = chebyshev_values(second_to_first(contact%coefficients), n)
    t = chebyshev_points(n)
    k = minloc(part, 1) - 1
    violation%pull = max(0.0_dp, -part(k)/maxval(abs(part)))
    violation%pull_place = 0.5_dp*(contact%ends(1) + contact%ends(2)) + contact%half_width*t(k)
  end subroutine find_pull

  !> On side 1, the left, or 2 of the contact: the samples of the whole profile and others
  !> close to the contact; where a low one may hide a lower place, more.
  subroutine find_overlap(profile, contact, side, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: side
    type(sign_violation), intent(inout) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: x(:)
    real(dp) :: overlap, place
    real(dp), allocatable :: gap(:), size_of_terms(:)
    integer :: k

    allocate (x, source=places_beside(profile, contact, side))
    if (size(x) == 0) return
    allocate (gap(size(x)), size_of_terms(size(x)))
    call gaps_beside(profile, contact, x, gap, size_of_terms, info)
    if (info%failed()) return
    do k = 1, size(x)
      overlap = -gap(k)/size_of_terms(k)
      place = x(k)
      if (k > 1 .and. k < size(x)) then
        if (may_hide(gap(k - 1:k + 1))) call zoom(profile, contact, x(k - 1), x(k + 1), overlap, place, info)
        if (info%failed()) return
      end if
      if (overlap > violation%overlap) then
        violation%overlap = overlap
        violation%overlap_place = place
      end if
    end do
  end subroutine find_overlap

  !> Outwards from the end of the contact.
  pure function places_beside(profile, contact, side) result(x)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: side
    real(dp), allocatable :: x(:)
    real(dp), allocatable :: near(:), far(:)
    real(dp) :: all_places(0:STEPS), outwards, end_place, room
    integer :: i, j, k

    end_place = contact%ends(side)
    outwards = real(2*side - 3, dp)
    room = merge(end_place - profile%lower, profile%upper - end_place, side == 1)
    allocate (x(0))
    if (.not. room > 0.0_dp) return
    allocate (near, source=near_places(contact%half_width, room))
    all_places = sample_places(profile)
    if (side == 1) all_places = all_places(STEPS:0:-1)
    allocate (far, source=pack((all_places - end_place)*outwards, (all_places - end_place)*outwards > 0.0_dp))
    deallocate (x)
    allocate (x(size(near) + size(far)))
    ! Both are in order: merge them.
    i = 1
    j = 1
    do k = 1, size(x)
      if (j > size(far)) then
        x(k) = near(i)
        i = i + 1
      else if (i > size(near)) then
        x(k) = far(j)
        j = j + 1
      else if (near(i) < far(j)) then
        x(k) = near(i)
        i = i + 1
      else
        x(k) = far(j)
        j = j + 1
      end if
    end do
    x = max(profile%lower, min(profile%upper, end_place + outwards*x))
  end function places_beside

  !> Gaps, less than nothing by rounding taken as 0, and the size of their terms, which is
  !> what they are compared with.
  subroutine gaps_beside(profile, contact, x, gap, size_of_terms, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), size_of_terms(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: initial(size(x)), slope(size(x)), rounding(size(x)), end_gap(size(x)), rise(size(x))

    gap = 0.0_dp
    size_of_terms = 1.0_dp
    call sample_profile(profile, x, initial, slope, info)
    if (info%failed()) return
    gap = contact%gap(x, initial)
    end_gap = merge(contact%end_gaps(1), contact%end_gaps(2), x <= contact%ends(1))
    rise = abs(initial - end_gap) + abs(contact%tilt)*max(contact%ends(1) - x, x - contact%ends(2), 0.0_dp)
    rounding = ROUNDINGS*epsilon(gap)*(abs(initial) + abs(end_gap) &
                                       + (abs(slope) + abs(contact%tilt))*(abs(x) + contact%half_width))
    where (gap < 0.0_dp) gap = min(0.0_dp, gap + rounding)
    ! The displacement is the difference of the gap and the rise.
    size_of_terms = max(rise + abs(gap), contact%force/contact%e_star)
  end subroutine gaps_beside

  !> Is the middle one of three gaps the least, and could one between them be negative?
  pure function may_hide(gap) result(hide)
    real(dp), intent(in) :: gap(3)
    logical :: hide

    hide = gap(2) <= min(gap(1), gap(3)) .and. gap(2) <= max(gap(1), gap(3)) - gap(2)
  end function may_hide

  !> Close in on the least gap between two places.
  subroutine zoom(profile, contact, first, last, overlap, place, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: first, last
    real(dp), intent(inout) :: overlap, place
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(CLOSER_SAMPLES), gap(CLOSER_SAMPLES), size_of_terms(CLOSER_SAMPLES), ends(2)
    integer :: k, round

    ends = [first, last]
    do round = 1, ZOOMS
      x = [(ends(1) + (ends(2) - ends(1))*(real(k, dp)/real(CLOSER_SAMPLES + 1, dp)), k=1, CLOSER_SAMPLES)]
      call gaps_beside(profile, contact, x, gap, size_of_terms, info)
      if (info%failed()) return
      k = minloc(gap, 1)
      if (-gap(k)/size_of_terms(k) > overlap) then
        overlap = -gap(k)/size_of_terms(k)
        place = x(k)
      end if
      if (k < CLOSER_SAMPLES) ends(2) = x(k + 1)
      if (k > 1) ends(1) = x(k - 1)
    end do
  end subroutine zoom

end module fuge_smooth_admissibility
