!> The search for the one interval in which a smooth punch touches.
!>
!> First from a guess: where the profile is lower than its lowest place plus 2 F/(pi E*),
!> which is the contact of a parabola. Newton's method goes on from there.
!>
!> If that does not end at an answer and the tilt is given, by exclusion. Let S hold the contact, and p_S be the
!> pressure that keeps S closed under the force, pulling where it must. The inverse of
!> the influence operator on S has no positive coefficients but on its diagonal, so
!> that p_S is at least the pressure of the answer wherever this touches: what pulls is
!> not in contact (R. Chandrasekaran, Opsearch 7, 1970, for matrices). So S, at first the
!> whole profile, shrinks to where p_S pushes, until Newton's method takes over; where
!> it falls into parts one of them holds the contact, if this is one interval. Then each
!> part is tried. With a free tilt there is no such order: then from many guesses.
module fuge_smooth_search
  use fuge_chebyshev, only: chebyshev_points, chebyshev_values
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_ends, only: find_ends, pressing, DEGREES
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_signs, only: check_signs, sign_violation
  use fuge_smooth_samples, only: sample_places
  use fuge_smooth_slope, only: compare_slope, expand_slope, place_interval, slope_series, FIRST_DEGREE
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

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> A violation of the signs below this is not one; or below so many estimated errors.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-10_dp, ERRORS = 10.0_dp
  !> Halvings on the way to the lowest place.
  integer, parameter :: HALVINGS = 60
  !> Of the search by exclusion: series, parts waiting, degree and precision of the series,
  !> points for each degree, the least shrinking that goes on.
  integer, parameter :: MOST_SERIES = 600, MOST_PARTS = 100, COARSE_DEGREES = 512, DENSITY = 4
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
      x = start + distance(:, side)
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

  !> The contact on the interval of `series`.
  subroutine make_contact(profile, e_star, task, series, contact, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(pressing), intent(in) :: task
    type(slope_series), intent(in) :: series
    type(fuge_smooth_contact), intent(out) :: contact
    type(fuge_info), intent(inout) :: info
    real(dp) :: gap(3), slope(3), x(3)

    associate (a => series%a, anchor => series%interval%anchor, offset => series%interval%offset, &
               half => series%interval%half)
      contact%e_star = e_star
      contact%anchor = anchor
      contact%offset = offset
      contact%half_width = half
      contact%ends = anchor + [offset - half, offset + half]
      contact%ends = max(profile%lower, min(profile%upper, contact%ends))
      contact%force = 0.25_dp*PI*e_star*task%load
      contact%moment = contact%force*(anchor + (offset + 0.5_dp*half*a(3)/a(2)))
      if (task%tilts) contact%moment = contact%force*task%line
      if (task%tilts) contact%tilt = a(1)
      contact%coefficients = 0.5_dp*e_star*a(2:)
      contact%end_error = series%first_error
      contact%pressure_error = series%sum_error
      x = [contact%ends(1), anchor + offset, contact%ends(2)]
      call sample_profile(profile, x, gap, slope, info)
      contact%end_gaps = [gap(1), gap(3)]
      contact%approach = gap(2) - contact%tilt*x(2) &
                         + middle_displacement(series, task, 2.0_dp*(profile%upper - profile%lower))
    end associate
  end subroutine make_contact

  !> Displacement in the middle of the contact: with the pressure sum_k b_k T_k over the
  !> root it is (2 half/E*) [b_0 ln(2 datum/half) + sum_k b_k T_k(0)/k].
  pure function middle_displacement(series, task, datum) result(displacement)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp), intent(in) :: datum
    real(dp) :: displacement
    real(dp) :: c(-1:size(series%a)), side
    integer :: k

    ! c_k/E*, continued by zeros.
    c = 0.0_dp
    c(0:size(series%a) - 2) = 0.5_dp*series%a(2:)
    displacement = 0.0_dp
    side = 1.0_dp
    do k = 2, size(series%a), 2
      side = -side
      displacement = displacement + side*(c(k) - c(k - 2))/(2.0_dp*real(k, dp))
    end do
    displacement = 0.5_dp*task%load*log(2.0_dp*datum/series%interval%half) &
                   + 2.0_dp*series%interval%half*displacement
  end function middle_displacement

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
    type(slope_series) :: series
    real(dp) :: waiting(2, MOST_PARTS), part(2), tried
    real(dp), allocatable :: pushing(:, :)
    integer :: parts
    logical :: whole

    waiting(:, 1) = [profile%lower, profile%upper]
    parts = 1
    whole = .true.
    do while (parts > 0)
      part = waiting(:, parts)
      parts = parts - 1
      tried = huge(tried)
      do while (search%steps < MOST_SERIES)
        if (part(2) - part(1) <= WORTH_A_TRY*tried) then
          tried = part(2) - part(1)
          call try_interval(profile, e_star, task, interval_of(part), search, info)
          if (info%failed() .or. search%outcome == FOUND) return
        end if
        call expand_slope(profile, interval_of(part), COARSE_GOAL, [FIRST_DEGREE, COARSE_DEGREES], &
                          series, info)
        search%steps = search%steps + 1
        if (info%failed()) return
        pushing = pushing_parts(series, task, part)
        if (size(pushing, 2) /= 1) exit
        if (pushing(2, 1) - pushing(1, 1) > SHRINKING*(part(2) - part(1))) exit
        part = pushing(:, 1)
      end do
      if (search%steps >= MOST_SERIES) return
      if (size(pushing, 2) > 1) then
        whole = .false.
        call add_parts(pushing, waiting, parts)
      else
        call try_interval(profile, e_star, task, interval_of(part), search, info)
        if (info%failed() .or. search%outcome == FOUND) return
        ! What is closed by pressure alone as far as an end of the profile is the answer.
        if (whole .and. (part(1) <= profile%lower .or. part(2) >= profile%upper)) then
          search%outcome = AT_END
          search%refused = part
        end if
      end if
    end do
  end subroutine exclude

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

  !> The stretches in which the pressure that keeps the whole interval, with these
  !> `ends`, pushes, wider by a point of the sampling.
  pure function pushing_parts(series, task, ends) result(stretches)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp), intent(in) :: ends(2)
    real(dp), allocatable :: stretches(:, :)
    real(dp), allocatable :: x(:), push(:)
    logical, allocatable :: pushes(:)
    integer :: n, k, found

    n = 64
    do while (n < DENSITY*size(series%a))
      n = 2*n
    end do
    allocate (x(0:n), push(0:n), pushes(-1:n + 1))
    x = series%interval%anchor + (series%interval%offset + series%interval%half*chebyshev_points(n))
    x(0) = ends(2)
    x(n) = ends(1)
    push = chebyshev_values(closed_pressure(series, task), n)
    pushes = .false.
    pushes(0:n) = push > 0.0_dp
    allocate (stretches(2, count(pushes(0:n) .and. .not. pushes(-1:n - 1))))
    found = size(stretches, 2) + 1
    do k = 0, n
      if (.not. pushes(k)) cycle
      ! x falls from point to point.
      if (.not. pushes(k - 1)) then
        found = found - 1
        stretches(2, found) = x(max(0, k - 1))
      end if
      if (.not. pushes(k + 1)) stretches(1, found) = x(min(n, k + 1))
    end do
  end function pushing_parts

  !> p/E* times sqrt(1 - t**2), in T_k, for the force and no tilt: b_0 carries the force, and
  !> -4 b_(k+1) = a_k - a_(k+2), twice a_0 for k = 0.
  pure function closed_pressure(series, task) result(b)
    type(slope_series), intent(in) :: series
    type(pressing), intent(in) :: task
    real(dp) :: b(0:size(series%a))
    real(dp) :: a(0:size(series%a) + 1)

    a = 0.0_dp
    a(:size(series%a) - 1) = series%a
    a(0) = 2.0_dp*a(0)
    b(0) = 0.25_dp*task%load/series%interval%half
    b(1:) = -0.25_dp*(a(:size(series%a) - 1) - a(2:))
  end function closed_pressure

end module fuge_smooth_search
