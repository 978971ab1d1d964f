!> The search for the one interval in which a smooth punch touches.
!>
!> Newton's method starts from a guess: where the profile is lower than its lowest point plus
!> 2 F/(pi E*), which is the contact of a parabola.
!>
!> If that does not lead to the solution and the tilt is 0, the search goes on by exclusion. Let S
!> contain the contact, and let p_S be the pressure that keeps S closed under the force, tensile
!> where it must be. The inverse of the influence operator on S has no positive coefficients off
!> its diagonal, so that p_S is at least the pressure of the solution wherever that touches:
!> where p_S is tensile there is no contact (R. Chandrasekaran, Opsearch 7, 1970, for matrices).
!> So S, at first the whole profile, shrinks to where p_S is compressive, until Newton's method
!> converges. If S falls into parts, one of them contains the contact, provided that this is one
!> interval; then each part is tried. With a free tilt there is no such monotonicity, and Newton's
!> method starts from many intervals around the line of action.
module fuge_smooth_search
  use fuge_kinds, only: dp
  use fuge_smooth_admissibility, only: check_admissibility, sign_violation
  use fuge_smooth_assembly, only: assemble_contact
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_exclusion, only: compressive_parts
  use fuge_smooth_newton, only: find_ends, load_case, MAX_DEGREE
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_samples, only: sample_positions
  use fuge_smooth_slope_series, only: anchored_interval, expand_slope, measure_series_error, slope_series, FIRST_DEGREE
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_contact_interval

  !> Outcome of a search: found, or the reason why not.
  integer, parameter, public :: INTERVAL_FOUND = 0, INTERVAL_NOT_FOUND = 1, INTERVAL_IN_TENSION = 2, &
    INTERVAL_PENETRATED = 3, INTERVAL_AT_END = 4

  !> State of a search: the contact, or why the best interval tried is not the contact.
  type, public :: interval_search
    integer :: outcome = INTERVAL_NOT_FOUND
    type(fuge_smooth_contact) :: contact
    type(sign_violation) :: violation
    !> Ends of the interval that was refused with the least violation; length.
    real(dp) :: refused_ends(2) = 0.0_dp
    !> Series formed so far.
    integer :: steps = 0
  end type interval_search

  !> A violation of the sign conditions is accepted up to SIGN_TOLERANCE, or ERROR_FACTOR times the estimated error.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-10_dp, ERROR_FACTOR = 10.0_dp
  !> Halvings of the distance from a starting point.
  integer, parameter :: HALVINGS = 60
  !> At smaller distances their products leave the range of double precision.
  real(dp), parameter :: LEAST_DISTANCE = sqrt(tiny(1.0_dp))
  !> Search by exclusion: limits of the number of series and of pending parts, highest degree and
  !> tolerance of a series, and the ratio of lengths above which shrinking stops.
  integer, parameter :: MAX_SERIES = 600, MAX_PARTS = 100, COARSE_MAX_DEGREE = 512
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-6_dp, LAST_SHRINKING = 1.0_dp - 1.0e-6_dp
  !> Newton's method is tried again when the interval has shrunk by this ratio: while each step shrinks it
  !> much, and while each step shrinks it by less than the second ratio.
  real(dp), parameter :: FAST_RETRY = 0.4_dp, SLOW_RETRY = 0.98_dp

contains

  !> Find the contact of `profile` under `load`; `start` is a position in it, such as that of the lowest
  !> point. Errors: those of the profile.
  subroutine find_contact_interval(profile, e_star, load, start, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, start
    type(load_case), intent(in) :: load
    type(interval_search), intent(out) :: search
    type(fuge_info), intent(inout) :: info
    type(anchored_interval) :: first
    integer :: k

    do k = 1, 2
      call guess_interval(profile, load, start, k == 2, first, info)
      if (info%failed()) return
      call try_interval(profile, e_star, load, first, search, info)
      if (info%failed() .or. search%outcome == INTERVAL_FOUND) return
    end do
    if (load%free_tilt) then
      call search_around_line(profile, e_star, load, search, info)
    else
      call search_by_exclusion(profile, e_star, load, search, info)
    end if
  end subroutine find_contact_interval

  !> The interval around `start` in which the profile is low; with a free tilt it is first turned to
  !> have the slope 0 at `start`. Its reach to either side is the whole one divided by a power of two, unless
  !> `refined`: that is too coarse for a steep profile.
  subroutine guess_interval(profile, load, start, refined, first, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(load_case), intent(in) :: load
    real(dp), intent(in) :: start
    logical, intent(in) :: refined
    type(anchored_interval), intent(out) :: first
    type(fuge_info), intent(inout) :: info
    real(dp) :: distances(HALVINGS + 1), level(1), tilt(1), reach(2), farthest
    integer :: side, j, k

    first%anchor = start
    call sample_profile(profile, [start], level, tilt, info)
    if (info%failed()) return
    if (.not. load%free_tilt) tilt = 0.0_dp
    level = level + 0.5_dp*load%reduced_force
    do side = 1, 2
      farthest = merge(profile%lower, profile%upper, side == 1) - start
      do
        distances = farthest*[(0.5_dp**j, j=0, HALVINGS)]
        call farthest_below(profile, start, level(1), tilt(1), distances, k, info)
        if (info%failed()) return
        farthest = distances(k)
        ! Below the last distance too, the contact under a tiny force may lie.
        if (k <= HALVINGS .or. abs(farthest) < LEAST_DISTANCE) exit
      end do
      reach(side) = farthest
      if (k == 1 .or. .not. refined) cycle
      ! Between this distance and the next one.
      distances = distances(k)*[(2.0_dp - real(j, dp)/real(HALVINGS, dp), j=0, HALVINGS)]
      call farthest_below(profile, start, level(1), tilt(1), distances, k, info)
      if (info%failed()) return
      reach(side) = distances(k)
    end do
    first%offset = 0.5_dp*(reach(1) + reach(2))
    first%half_width = 0.5_dp*(reach(2) - reach(1))
  end subroutine guess_interval

  !> The first of the `distances` from `start`, from far to near, at which the gap less the tilt is not above
  !> `level`, or the last one: its number k.
  subroutine farthest_below(profile, start, level, tilt, distances, k, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: start, level, tilt, distances(:)
    integer, intent(out) :: k
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(size(distances)), gap(size(distances)), slope(size(distances))

    k = size(distances)
    x = max(profile%lower, min(profile%upper, start + distances))
    call sample_profile(profile, x, gap, slope, info)
    if (info%failed()) return
    do k = 1, size(distances) - 1
      if (gap(k) - tilt*distances(k) <= level) return
    end do
  end subroutine farthest_below

  !> Newton's method from an interval; where it converges is the contact if that is admissible.
  subroutine try_interval(profile, e_star, load, first, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(load_case), intent(in) :: load
    type(anchored_interval), intent(in) :: first
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(slope_series) :: series
    type(sign_violation) :: violation
    type(fuge_smooth_contact) :: contact
    real(dp) :: allowed_violation
    logical :: converged

    call solve_resolved(profile, load, first, series, converged, search%steps, info)
    if (info%failed() .or. .not. converged) return
    call assemble_contact(profile, e_star, load, series, contact, info)
    if (info%failed()) return
    call check_admissibility(profile, contact, violation, info)
    if (info%failed()) return
    allowed_violation = max(SIGN_TOLERANCE, ERROR_FACTOR*contact%pressure_error)
    if (max(violation%tension, violation%penetration) <= allowed_violation) then
      search%outcome = INTERVAL_FOUND
      search%contact = contact
    else if (search%outcome /= INTERVAL_NOT_FOUND) then
      ! The interval with the least violation is the one to be reported.
      if (max(violation%tension, violation%penetration) &
          >= max(search%violation%tension, search%violation%penetration)) return
    end if
    search%violation = violation
    search%refused_ends = contact%ends
    if (search%outcome /= INTERVAL_FOUND) search%outcome = merge(INTERVAL_IN_TENSION, INTERVAL_PENETRATED, &
                                                                 violation%tension > violation%penetration)
  end subroutine try_interval

  !> Newton's method with a series that is also compared with samples of the whole profile, because few
  !> nodes may miss a detail between them. Where the series differs, its degree is raised.
  subroutine solve_resolved(profile, load, first, series, converged, steps, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(load_case), intent(in) :: load
    type(anchored_interval), intent(in) :: first
    type(slope_series), intent(out) :: series
    logical, intent(out) :: converged
    integer, intent(inout) :: steps
    type(fuge_info), intent(inout) :: info
    type(anchored_interval) :: start
    real(dp) :: difference
    integer :: lowest_degree

    start = first
    lowest_degree = FIRST_DEGREE
    do
      call find_ends(profile, load, start, lowest_degree, series, converged, steps, info)
      if (info%failed() .or. .not. converged) return
      call measure_series_error(profile, series, sample_positions(profile), difference, info)
      difference = difference/series%coefficients(2)
      if (info%failed() .or. difference <= max(SIGN_TOLERANCE, ERROR_FACTOR*series%series_error)) return
      if (lowest_degree >= MAX_DEGREE) exit
      lowest_degree = 8*lowest_degree
      if (lowest_degree > MAX_DEGREE) lowest_degree = MAX_DEGREE
      start = series%interval
    end do
    series%series_error = max(series%series_error, difference)
  end subroutine solve_resolved

  !> Newton's method from intervals of all lengths around the line of action.
  subroutine search_around_line(profile, e_star, load, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(load_case), intent(in) :: load
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp) :: half_width, left, right
    integer :: k

    half_width = profile%upper - profile%lower
    do k = 1, HALVINGS
      left = max(profile%lower, load%line_of_action - half_width)
      right = min(profile%upper, load%line_of_action + half_width)
      call try_interval(profile, e_star, load, interval_between([left, right]), search, info)
      if (info%failed() .or. search%outcome == INTERVAL_FOUND) return
      half_width = 0.5_dp*half_width
      if (half_width <= spacing(abs(load%line_of_action))) return
    end do
  end subroutine search_around_line

  !> Search by exclusion: shrink the interval, split it and try its parts until none is left.
  subroutine search_by_exclusion(profile, e_star, load, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(load_case), intent(in) :: load
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    real(dp) :: pending_parts(2, MAX_PARTS), part(2)
    real(dp), allocatable :: compressive(:, :)
    integer :: parts
    logical :: unsplit

    pending_parts(:, 1) = [profile%lower, profile%upper]
    parts = 1
    unsplit = .true.
    do while (parts > 0)
      part = pending_parts(:, parts)
      parts = parts - 1
      call shrink_part(profile, e_star, load, part, compressive, search, info)
      if (info%failed() .or. search%outcome == INTERVAL_FOUND .or. search%steps >= MAX_SERIES) return
      if (size(compressive, 2) > 1) then
        unsplit = .false.
        call add_parts(compressive, pending_parts, parts)
        cycle
      end if
      call try_interval(profile, e_star, load, interval_between(part), search, info)
      if (info%failed() .or. search%outcome == INTERVAL_FOUND) return
      ! An interval that compressive pressure closes up to an end of the profile is the contact.
      if (unsplit .and. is_closed(part, compressive) &
          .and. (part(1) <= profile%lower .or. part(2) >= profile%upper)) then
        search%outcome = INTERVAL_AT_END
        search%refused_ends = part
      end if
    end do
  end subroutine search_by_exclusion

  !> Shrink `part` to where the pressure that closes it is compressive, as long as that is one shorter
  !> interval; `compressive` has these intervals at the end, and equals `part` if nothing of it is tensile.
  !> On the way Newton's method is tried, once shrinking is slow too.
  subroutine shrink_part(profile, e_star, load, part, compressive, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(load_case), intent(in) :: load
    real(dp), intent(inout) :: part(2)
    real(dp), allocatable, intent(out) :: compressive(:, :)
    type(interval_search), intent(inout) :: search
    type(fuge_info), intent(inout) :: info
    type(slope_series) :: series
    real(dp) :: last_tried, retry_ratio

    allocate (compressive(2, 0))
    last_tried = huge(last_tried)
    retry_ratio = FAST_RETRY
    do while (search%steps < MAX_SERIES)
      if (part(2) - part(1) <= retry_ratio*last_tried) then
        last_tried = part(2) - part(1)
        call try_interval(profile, e_star, load, interval_between(part), search, info)
        if (info%failed() .or. search%outcome == INTERVAL_FOUND) return
      end if
      call expand_slope(profile, interval_between(part), COARSE_TOLERANCE, [FIRST_DEGREE, COARSE_MAX_DEGREE], series, &
                        info)
      search%steps = search%steps + 1
      if (info%failed()) return
      deallocate (compressive)
      allocate (compressive, source=compressive_parts(series, load, part))
      if (size(compressive, 2) /= 1) return
      if (compressive(2, 1) - compressive(1, 1) > LAST_SHRINKING*(part(2) - part(1))) return
      retry_ratio = FAST_RETRY
      if (compressive(2, 1) - compressive(1, 1) > SLOW_RETRY*(part(2) - part(1))) retry_ratio = SLOW_RETRY
      part = compressive(:, 1)
    end do
  end subroutine shrink_part

  !> Is a part compressive as a whole?
  pure function is_closed(part, compressive)
    real(dp), intent(in) :: part(2), compressive(:, :)
    logical :: is_closed

    is_closed = .false.
    if (size(compressive, 2) == 1) is_closed = compressive(1, 1) <= part(1) .and. compressive(2, 1) >= part(2)
  end function is_closed

  !> The interval with these ends.
  pure function interval_between(ends) result(interval)
    real(dp), intent(in) :: ends(2)
    type(anchored_interval) :: interval

    interval%anchor = 0.5_dp*(ends(1) + ends(2))
    interval%half_width = 0.5_dp*(ends(2) - ends(1))
  end function interval_between

  !> Add parts to the pending ones, the longest one last, because the last one is tried first.
  pure subroutine add_parts(compressive, pending_parts, parts)
    real(dp), intent(in) :: compressive(:, :)
    real(dp), intent(inout) :: pending_parts(:, :)
    integer, intent(inout) :: parts
    integer :: k, longest

    longest = maxloc(compressive(2, :) - compressive(1, :), 1)
    do k = 1, size(compressive, 2)
      if (k == longest .or. parts >= size(pending_parts, 2) - 1) cycle
      parts = parts + 1
      pending_parts(:, parts) = compressive(:, k)
    end do
    parts = parts + 1
    pending_parts(:, parts) = compressive(:, longest)
  end subroutine add_parts

end module fuge_smooth_search
