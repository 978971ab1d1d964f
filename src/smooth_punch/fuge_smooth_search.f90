!> The search for the one interval in which a smooth punch touches.
!>
!> First from a guess: where the profile is lower than its lowest place plus 2 F/(pi E*),
!> which is the contact of a parabola. Newton's method goes on from there.
!>
!> If that does not end at an answer and the tilt is given, by exclusion. Let S hold the
!> contact, and p_S be the pressure that keeps S closed under the force, pulling where it
!> must. The inverse of the influence operator on S has no positive coefficients but on its
!> diagonal, so that p_S is at least the pressure of the answer wherever this touches: what
!> pulls is not in contact (R. Chandrasekaran, Opsearch 7, 1970, for matrices). So S, at first
!> the whole profile, shrinks to where p_S pushes, until Newton's method takes over; where
!> it falls into parts one of them holds the contact, if this is one interval. Then each
!> part is tried. With a free tilt there is no such order: then from many guesses.
module fuge_smooth_search
  use fuge_kinds, only: dp
  use fuge_smooth_assembly, only: make_contact
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_newton, only: find_ends, pressing, DEGREES
  use fuge_smooth_exclusion, only: pushing_parts
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_samples, only: sample_places
  use fuge_smooth_admissibility, only: check_signs, sign_violation
  use fuge_smooth_slope_series, only: compare_slope, expand_slope, place_interval, slope_series, FIRST_DEGREE
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_interval

  !> Why there is no answer, or that there is one.
  integer, parameter, public :: FOUND = 0, NOT_FOUND = 1, PULLS = 2, OVERLAPS = 3, AT_END = 4

  !> Course of a search: the contact, or why the best interval tried is none.
  type, public :: interval_search
    integer :: outcome = NOT_FOUND
    type(fuge_smooth_contact) :: contact
    type(sign_violation) :: violation
    !> The interval that was refused with the least violation.
    real(dp) :: refused(2) = 0.0_dp
    !> Series formed so far.
    integer :: steps = 0
  end type interval_search

  !> A violation of the signs below this is not one; or below so many estimated errors.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-10_dp, ERRORS = 10.0_dp
  !> Halvings on the way to the lowest place.
  integer, parameter :: HALVINGS = 60
  !> Of the search by exclusion: series, parts waiting, degree and precision of the series,
  !> the least shrinking that goes on.
  integer, parameter :: MOST_SERIES = 600, MOST_PARTS = 100, COARSE_DEGREES = 512
  real(dp), parameter :: COARSE_GOAL = 1.0e-6_dp, SHRINKING = 0.98_dp
  !> Newton's method is tried again when an interval is so much shorter.
  real(dp), parameter :: WORTH_A_TRY = 0.4_dp

contains

  !> `start`: a place in the contact, such as the lowest one.
  subroutine find_interval(profile, e_star, task, start, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, start
    type(pressing), intent(in) :: task
    type(interval_search), intent(out) :: search
    type(fuge_info), intent(inout) :: info
    type(place_interval) :: first

    call guess(profile, task, start, first, info)
    if (info%failed()) return
    call try_interval(profile, e_star, task, first, search, info)
    if (info%failed() .or. search%outcome == FOUND) return
    if (task%tilts) then
      call try_many(profile, e_star, task, search, info)
    else
      call exclude(profile, e_star, task, search, info)
    end if
  end subroutine find_interval

  !> The interval around `start` in which the profile, turned to be level there if it tilts, is
  !> low.
  subroutine guess(profile, task, start, first, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(pressing), intent(in) :: task
    real(dp), intent(in) :: start
    type(place_interval), intent(out) :: first
    type(fuge_info), intent(inout) :: info
    real(dp) :: distance(HALVINGS + 1, 2), x(HALVINGS + 1), gap(HALVINGS + 1), slope(HALVINGS + 1), level(1), turn(1)
    real(dp) :: reach(2)
    integer :: side, k

    first%anchor = start
    call sample_profile(profile, [start], level, turn, info)
    if (info%failed()) return
    if (.not. task%tilts) turn = 0.0_dp
    distance(1, :) = [profile%lower - start, profile%upper - start]
    do k = 2, HALVINGS + 1
      distance(k, :) = 0.5_dp*distance(k - 1, :)
    end do
    do side = 1, 2
      x = max(profile%lower, min(profile%upper, start + distance(:, side)))
      call sample_profile(profile, x, gap, slope, info)
      if (info%failed()) return
      gap = gap - turn(1)*distance(:, side)
      reach(side) = distance(HALVINGS + 1, side)
      do k = HALVINGS, 1, -1
        if (gap(k) - level(1) <= 0.5_dp*task%load) reach(side) = distance(k, side)
      end do
    end do
    first%offset = 0.5_dp*(reach(1) + reach(2))
    first%half = 0.5_dp*(reach(2) - reach(1))
  end subroutine guess

  !> Newton's method from an interval; its end is the answer if the signs are right.
  subroutine try_interval(profile, e_star, task, first, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(pressing), intent(in) :: task
    type(place_interval), intent(in) :: first
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(slope_series) :: series
    type(sign_violation) :: violation
    type(fuge_smooth_contact) :: contact
    real(dp) :: allowed
    logical :: converged

    call find_resolved(profile, task, first, series, converged, search%steps, info)
    if (info%failed() .or. .not. converged) return
    call make_contact(profile, e_star, task, series, contact, info)
    if (info%failed()) return
    call check_signs(profile, contact, violation, info)
    if (info%failed()) return
    allowed = max(SIGN_TOLERANCE, ERRORS*contact%pressure_error)
    if (max(violation%pull, violation%overlap) <= allowed) then
      search%outcome = FOUND
      search%contact = contact
    else if (search%outcome /= NOT_FOUND) then
      ! The interval that comes closest is the one to be told of.
      if (max(violation%pull, violation%overlap) &
          >= max(search%violation%pull, search%violation%overlap)) return
    end if
    search%violation = violation
    search%refused = contact%ends
    if (search%outcome /= FOUND) search%outcome = merge(PULLS, OVERLAPS, violation%pull > violation%overlap)
  end subroutine try_interval

  !> Newton's method with a series that is held against the samples of the profile as well:
  !> what lies between few points would be overlooked. Where it differs the degree rises.
  subroutine find_resolved(profile, task, first, series, converged, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(pressing), intent(in) :: task
    type(place_interval), intent(in) :: first
    type(slope_series), intent(out) :: series
    logical, intent(out) :: converged
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    type(place_interval) :: start
    real(dp) :: difference
    integer :: least

    start = first
    least = FIRST_DEGREE
    do
      call find_ends(profile, task, start, least, series, converged, steps, info)
      if (info%failed() .or. .not. converged) return
      call compare_slope(profile, series, sample_places(profile), difference, info)
      difference = difference/series%a(2)
      if (info%failed() .or. difference <= max(SIGN_TOLERANCE, ERRORS*series%sum_error)) return
      if (least >= DEGREES) exit
      least = 8*least
      if (least > DEGREES) least = DEGREES
      start = series%interval
    end do
    series%sum_error = max(series%sum_error, difference)
  end subroutine find_resolved

  !> From intervals of all lengths around the line of action.
  subroutine try_many(profile, e_star, task, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(pressing), intent(in) :: task
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp) :: half, left, right
    integer :: k

    half = profile%upper - profile%lower
    do k = 1, HALVINGS
      left = max(profile%lower, task%line - half)
      right = min(profile%upper, task%line + half)
      call try_interval(profile, e_star, task, interval_of([left, right]), search, info)
      if (info%failed() .or. search%outcome == FOUND) return
      half = 0.5_dp*half
      if (half <= spacing(abs(task%line))) return
    end do
  end subroutine try_many

  !> Shrink, part and try until nothing is left.
  subroutine exclude(profile, e_star, task, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(pressing), intent(in) :: task
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp) :: waiting(2, MOST_PARTS), part(2)
    real(dp), allocatable :: pushing(:, :)
    integer :: parts
    logical :: whole

    waiting(:, 1) = [profile%lower, profile%upper]
    parts = 1
    whole = .true.
    do while (parts > 0)
      part = waiting(:, parts)
      parts = parts - 1
      call shrink(profile, e_star, task, part, pushing, search, info)
      if (info%failed() .or. search%outcome == FOUND .or. search%steps >= MOST_SERIES) return
      if (size(pushing, 2) > 1) then
        whole = .false.
        call add_parts(pushing, waiting, parts)
        cycle
      end if
      call try_interval(profile, e_star, task, interval_of(part), search, info)
      if (info%failed() .or. search%outcome == FOUND) return
      ! What is closed by pressure alone as far as an end of the profile is the answer.
      if (whole .and. (part(1) <= profile%lower .or. part(2) >= profile%upper)) then
        search%outcome = AT_END
        search%refused = part
      end if
    end do
  end subroutine exclude

  !> Shrink `part` as long as what pushes in it is one stretch and shorter: `pushing` at the
  !> end. On the way Newton's method is tried.
  subroutine shrink(profile, e_star, task, part, pushing, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(pressing), intent(in) :: task
    real(dp), intent(inout) :: part(2)
    real(dp), allocatable, intent(out) :: pushing(:, :)
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(slope_series) :: series
    real(dp) :: tried

    allocate (pushing(2, 0))
    tried = huge(tried)
    do while (search%steps < MOST_SERIES)
      if (part(2) - part(1) <= WORTH_A_TRY*tried) then
        tried = part(2) - part(1)
        call try_interval(profile, e_star, task, interval_of(part), search, info)
        if (info%failed() .or. search%outcome == FOUND) return
      end if
      call expand_slope(profile, interval_of(part), COARSE_GOAL, [FIRST_DEGREE, COARSE_DEGREES], series, info)
      search%steps = search%steps + 1
      if (info%failed()) return
      deallocate (pushing)
      allocate (pushing, source=pushing_parts(series, task, part))
      if (size(pushing, 2) /= 1) return
      if (pushing(2, 1) - pushing(1, 1) > SHRINKING*(part(2) - part(1))) return
      part = pushing(:, 1)
    end do
  end subroutine shrink

  pure function interval_of(ends) result(interval)
    real(dp), intent(in) :: ends(2)
    type(place_interval) :: interval

    interval%anchor = 0.5_dp*(ends(1) + ends(2))
    interval%half = 0.5_dp*(ends(2) - ends(1))
  end function interval_of

  !> The longest part last, to be tried first.
  pure subroutine add_parts(pushing, waiting, parts)
    real(dp), intent(in) :: pushing(:, :)
    real(dp), intent(inout) :: waiting(:, :)
    integer, intent(inout) :: parts
    integer :: k, longest

    longest = maxloc(pushing(2, :) - pushing(1, :), 1)
    do k = 1, size(pushing, 2)
      if (k == longest .or. parts >= size(waiting, 2) - 1) cycle
      parts = parts + 1
      waiting(:, parts) = pushing(:, k)
    end do
    parts = parts + 1
    waiting(:, parts) = pushing(:, longest)
  end subroutine add_parts

end module fuge_smooth_search
