!> The pass of the certificate that judges all points: equations (9) and (10) of the paper, violations relative to the
!> data.
module fuge_certificate_judgement
  use fuge_certificate_passes, only: certificate_pass, law, tile_lengths, upper_stop, TILE
  use fuge_data_scales, only: is_loaded, largest_of_body
  use fuge_kinds, only: dp
  use fuge_load_balance, only: ROUNDINGS
  use fuge_point_law, only: point_law
  use fuge_relative_size, only: relative
  implicit none
  private

  public :: judge_points

contains

  !> Found: the largest violations of equation (9), of signs and of complementarity.
  subroutine judge_points(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    type(tile_lengths) :: at
    real(dp) :: violations(3)
    integer :: finish, start
    logical :: simple

    simple = .not. (associated(pass%excluded) .or. associated(pass%gap_upper) .or. allocated(pass%by_mode) &
                    .or. has_limits(pass))
    violations = 0.0_dp
    do start = first, last, TILE
      finish = min(start + TILE - 1, last)
      call pass%find_lengths(start, finish, at)
      call judge_gaps(pass, start, finish, at, violations(1))
      if (simple) then
        call judge_one_stop(pass, start, finish, at, violations(2:3))
      else
        call judge_contact(pass, start, finish, at, violations(2:3))
      end if
    end do
    found(:3) = violations
  end subroutine judge_points

  !> Raise `violations`, of signs and of complementarity, to those of the points `first` .. `last`, with lengths `at`.
  pure subroutine judge_contact(pass, first, last, at, violations)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    type(tile_lengths), intent(in) :: at
    real(dp), intent(inout) :: violations(2)
    real(dp) :: body_force, rounding
    logical :: excludes, limited
    integer :: i

    excludes = associated(pass%excluded)
    limited = has_limits(pass)
    rounding = 0.0_dp
    body_force = pass%largest_force
    do i = first, last
      if (excludes) then
        if (.not. pass%included(i)) then
          call raise_to(violations(1), abs(pass%force(i)), pass%largest_force)
          cycle
        end if
      end if
      if (allocated(pass%by_mode)) call find_force_of_body(pass, i, body_force, rounding)
      if (limited) then
        call judge_law(law(pass, i), pass%force(i), pass%gap_under_load(i), body_force, &
                       at%magnitude(i - first + 1), rounding, violations)
      else
        call judge_stops(pass%force(i), pass%gap_under_load(i), upper_stop(pass, i), body_force, &
                         at%magnitude(i - first + 1), rounding, violations)
      end if
    end do
  end subroutine judge_contact

  !> As `judge_contact`, where all points have one stop and belong to one body.
  pure subroutine judge_one_stop(pass, first, last, at, violations)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    type(tile_lengths), intent(in) :: at
    real(dp), intent(inout) :: violations(2)
    real(dp) :: force, gap
    integer :: i

    do i = first, last
      force = pass%force(i)
      gap = pass%gap_under_load(i)
      if (.not. gap >= 0.0_dp) call raise_to(violations(1), -gap, at%magnitude(i - first + 1))
      if (abs(force) <= 0.0_dp) cycle
      if (force < 0.0_dp) call raise_to(violations(1), -force, pass%largest_force)
      if (.not. may_exceed(violations(2), abs(gap), at%magnitude(i - first + 1))) cycle
      violations(2) = max(violations(2), min(relative(abs(force), pass%largest_force), &
                                             relative(abs(gap), at%magnitude(i - first + 1))))
    end do
  end subroutine judge_one_stop

  !> Raise `violation` to those of equation (9) at the points `first` .. `last`, with lengths `at`.
  pure subroutine judge_gaps(pass, first, last, at, violation)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    type(tile_lengths), intent(in) :: at
    real(dp), intent(inout) :: violation
    real(dp) :: excess, reference_gap, reference_magnitude, rounding, shared_error
    integer :: i, k

    shared_error = pass%shared_error
    reference_gap = abs(pass%reference_gap)
    reference_magnitude = pass%reference_magnitude
    do i = 1, last - first + 1
      k = first + i - 1
      ! max may ignore a NaN, which must not pass for small.
      if (.not. abs(at%error(i)) <= huge(violation)) violation = huge(violation)
      ! Half a unit in the last place each, of the gaps and of the motions, and as much for their sum.
      rounding = abs(pass%gap(k)) + reference_gap + at%rigid_magnitude(i)
      excess = max(abs(at%error(i) - shared_error) - 2.0_dp*epsilon(excess)*rounding, 0.0_dp)
      call raise_to(violation, excess, at%magnitude(i) + reference_magnitude)
    end do
  end subroutine judge_gaps

  !> The largest force of the body of point `k`, and what of the forces there may be `rounding`.
  pure subroutine find_force_of_body(pass, k, body_force, rounding)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(dp), intent(out) :: body_force, rounding

    body_force = largest_of_body(pass%modes, pass%by_mode(size(pass%modes, 2) + 1:), k)
    if (.not. body_force > 0.0_dp) body_force = pass%largest_force
    ! Beside the largest force, smaller ones of other bodies may be rounding, but for those that carry a load.
    rounding = 0.0_dp
    if (body_force < pass%largest_force) then
      if (.not. is_loaded(pass%modes, pass%resultants, k)) rounding = ROUNDINGS*epsilon(rounding)*pass%largest_force
    end if
  end subroutine find_force_of_body

  !> Raise `violations`, of signs and of complementarity, to those of equation (10) at both stops. Forces are compared
  !> with `force_scale`, lengths with `length_scale`.
  pure subroutine judge_stops(force, gap, upper, force_scale, length_scale, rounding, violations)
    real(dp), intent(in) :: force, gap, upper, force_scale, length_scale, rounding
    real(dp), intent(inout) :: violations(2)
    real(dp) :: stop_distance

    call raise_to(violations(1), -gap, length_scale)
    if (upper < huge(upper)) then
      call raise_to(violations(1), gap - upper, length_scale)
    else
      call raise_to(violations(1), max(-force - rounding, 0.0_dp), force_scale)
    end if
    stop_distance = gap
    if (force < 0.0_dp .and. upper < huge(upper)) stop_distance = gap - upper
    if (abs(force) <= rounding) return
    if (may_exceed(violations(2), abs(stop_distance), length_scale)) then
      violations(2) = max(violations(2), min(relative(abs(force) - rounding, force_scale), &
                                             relative(abs(stop_distance), length_scale)))
    end if
  end subroutine judge_stops

  !> As `judge_stops`, for a point with limits of its forces. `noise` as in `point_law`.
  pure subroutine judge_law(law, force, gap, force_scale, length_scale, noise, violations)
    type(point_law), intent(in) :: law
    real(dp), intent(in) :: force, gap, force_scale, length_scale, noise
    real(dp), intent(inout) :: violations(2)

    violations(1) = max(violations(1), relative(max(force - law%most_force() - noise, &
                                                    law%least_force() - force - noise, 0.0_dp), force_scale))
    violations(2) = max(violations(2), law%distance(force, gap, force_scale, length_scale, noise))
  end subroutine judge_law

  !> Raise `violation` to `value` relative to `measure`. Few values do, and only they are divided.
  pure subroutine raise_to(violation, value, measure)
    real(dp), intent(inout) :: violation
    real(dp), intent(in) :: value, measure

    if (may_exceed(violation, value, measure)) violation = max(violation, relative(value, measure))
  end subroutine raise_to

  !> May `value` relative to `measure` exceed `violation`?
  pure function may_exceed(violation, value, measure)
    real(dp), intent(in) :: violation, value, measure
    logical :: may_exceed

    may_exceed = .true.
    ! The product must not overflow; a NaN may exceed anything.
    if (violation < 1.0_dp) may_exceed = .not. value <= violation*measure
  end function may_exceed

  !> Do forces have limits?
  pure function has_limits(pass)
    class(certificate_pass), intent(in) :: pass
    logical :: has_limits

    has_limits = associated(pass%limit) .or. associated(pass%limit_upper)
  end function has_limits

end module fuge_certificate_judgement
