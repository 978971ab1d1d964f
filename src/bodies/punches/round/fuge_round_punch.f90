!> Round punches on an elastic half-space, accurate to rounding with a few coefficients.
!>
!> The axisymmetric twin of `fuge_smooth_punch`: the contact is a disc whose radius is the only unknown, and pressure,
!> approach and load follow from Abel's transform of the profile in closed form. See
!> doc/theory_punch.md, "Round punches".
module fuge_round_punch
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_elastic_moduli, only: check_e_star
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info, report, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_UNSUPPORTED, FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_solve_round_punch

  !> Rounding errors of a gap, in units of the last place.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  character(len=*), parameter :: OTHER_ENGINES = ': use rings, fuge_ring_matrix, with the active set'

contains

  !> Press a round punch into a half-space, along its axis.
  !>
  !> `profile`: its initial gap as a function of the distance r from the axis, from lower = 0 to upper; it may have a
  !> tip; `e_star` > 0 force per length squared; out: `contact`. Exactly one of `load` >= 0, force, `approach`,
  !> length, and `radius` >= 0 of the contact, length, is present. Without load, or up to the approach at which it
  !> touches, the radius is 0.
  !>
  !> The contact is a disc within the profile. Tension is excluded by bounds of series of the pressure; so is
  !> penetration, by those of series of the gap beside the contact, for which a detail narrower than a 512th of the
  !> profile may be overlooked. info%iterations counts the series formed; info%residual is the certificate.
  !> FUGE_WARN_RESIDUAL: the residual or the estimated error is above the default tolerance of `fuge_options`, as for
  !> a profile that is not smooth from the axis on; powers that are no integers, and edges, need a
  !> `fuge_power_profile`.
  !> Errors, `contact` untouched: FUGE_ERR_UNSUPPORTED if the contact is not one disc or reaches the end of the profile,
  !> with a message that names another engine; FUGE_ERR_OPTION unless one of the three is present;
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH unless lower = 0 < upper, or for a radius that is negative
  !> or beyond the profile, FUGE_ERR_MODULUS, FUGE_ERR_NO_EQUILIBRIUM for load < 0, FUGE_ERR_CALLBACK for a profile that
  !> fails.
  subroutine fuge_solve_round_punch(profile, e_star, contact, info, load, approach, radius)
    use fuge_round_newton, only: round_target, GIVEN_APPROACH, GIVEN_LOAD, GIVEN_RADIUS
    use fuge_round_search, only: disc_search, find_disc, DISC_FOUND
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(fuge_round_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: load, approach, radius
    type(disc_search) :: search
    type(round_target) :: target
    real(dp) :: axis_gap(1), axis_slope(1), given

    call check_profile(profile, e_star, info)
    if (info%failed()) return
    if (count([present(load), present(approach), present(radius)]) /= 1) then
      call report(info, FUGE_ERR_OPTION, 'of load, approach and radius one has to be given, and not ' &
                  //text(count([present(load), present(approach), present(radius)])))
      return
    end if
    if (present(load)) then
      given = load
      target%given = GIVEN_LOAD
    else if (present(approach)) then
      given = approach
      target%given = GIVEN_APPROACH
    else
      given = radius
      target%given = GIVEN_RADIUS
    end if
    call check_given(profile, given, target%given, info)
    if (info%failed()) return
    call sample_profile(profile, [0.0_dp], axis_gap, axis_slope, info)
    if (info%failed()) return

    target%length = given
    if (target%given == GIVEN_APPROACH) target%length = given - axis_gap(1)
    if (target%given == GIVEN_LOAD) target%length = sqrt(0.5_dp*given)/sqrt(e_star)
    if (.not. target%length > 0.0_dp) then
      call touch(profile, e_star, target%given, given, axis_gap(1), contact, info)
      return
    end if
    call find_disc(profile, e_star, target, axis_gap(1), search, info)
    info%iterations = search%steps
    if (info%failed()) return
    if (search%outcome /= DISC_FOUND) then
      call report_outcome(profile, search, info)
      return
    end if
    if (present(load)) search%contact%load = load
    if (present(approach)) search%contact%approach = approach
    call certify_search(profile, search, info)
    if (.not. info%failed()) contact = search%contact
  end subroutine fuge_solve_round_punch

  !> Refuse a profile or a modulus that cannot be used.
  subroutine check_profile(profile, e_star, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(fuge_info), intent(inout) :: info

    call check_finite(profile%lower, 'lower', info)
    if (.not. info%failed()) call check_finite(profile%upper, 'upper', info)
    if (.not. info%failed()) call check_e_star(e_star, info)
    if (info%failed()) return
    if (abs(profile%lower) > 0.0_dp .or. .not. profile%upper > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'the profile goes from lower = '//text(profile%lower)//' to upper = ' &
                  //text(profile%upper)//': a round one begins on the axis, lower = 0 < upper')
    else if (max(abs(exponent(e_star)), abs(exponent(profile%upper))) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(e_star)//' or upper = '//text(profile%upper) &
                  //' is out of range: choose other units')
    end if
  end subroutine check_profile

  !> Refuse a load, an approach or a radius that cannot be.
  subroutine check_given(profile, given, kind_given, info)
    use fuge_round_newton, only: GIVEN_LOAD, GIVEN_RADIUS
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: given
    integer, intent(in) :: kind_given
    type(fuge_info), intent(inout) :: info

    call check_finite(given, given_name(kind_given), info)
    if (info%failed()) return
    if (kind_given == GIVEN_LOAD .and. given < 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load = '//text(given)//' is negative: contact can only push')
    else if (kind_given == GIVEN_RADIUS .and. (given < 0.0_dp .or. given > profile%upper)) then
      call report(info, FUGE_ERR_WIDTH, 'radius = '//text(given)//' is not between 0 and the end of the profile, ' &
                  //text(profile%upper))
    else if (exponent(given) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, trim(given_name(kind_given))//' = '//text(given) &
                  //' is out of range: choose other units')
    else if (abs(given) > 0.0_dp .and. exponent(given) < least_exponent(kind_given)) then
      call report(info, FUGE_ERR_OVERFLOW, trim(given_name(kind_given))//' = '//text(given) &
                  //' is too small for double precision: choose smaller units')
    end if
  end subroutine check_given

  !> A load may be as small as its parts have all digits, because of it only roots are formed; of lengths also squares.
  pure function least_exponent(kind_given) result(least)
    use fuge_round_newton, only: GIVEN_LOAD
    integer, intent(in) :: kind_given
    integer :: least

    least = -LARGEST_EXPONENT_OF_2
    if (kind_given == GIVEN_LOAD) least = minexponent(1.0_dp)
  end function least_exponent

  pure function given_name(kind_given) result(name)
    integer, intent(in) :: kind_given
    character(len=8) :: name
    character(len=8), parameter :: NAMES(3) = [character(len=8) :: 'load', 'approach', 'radius']

    name = NAMES(kind_given)
  end function given_name

  !> The contact without load: the axis, or nothing. Refused if another part of the profile is lower.
  subroutine touch(profile, e_star, kind_given, given, axis_gap, contact, info)
    use fuge_round_newton, only: GIVEN_APPROACH
    use fuge_smooth_samples, only: lowest_position
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, given, axis_gap
    integer, intent(in) :: kind_given
    type(fuge_round_contact), intent(inout) :: contact
    type(fuge_info), intent(inout) :: info
    type(fuge_round_contact) :: without_load
    real(dp) :: position, gap, reached, end_gap(1), end_slope(1)

    call lowest_position(profile, position, gap, info)
    if (.not. info%failed()) call sample_profile(profile, [profile%upper], end_gap, end_slope, info)
    if (info%failed()) return
    reached = axis_gap
    if (kind_given == GIVEN_APPROACH) reached = given
    ! Samples and series have rounding errors relative to the height of the whole profile.
    if (gap < reached - ROUNDINGS*epsilon(gap)*max(abs(axis_gap), abs(gap), abs(end_gap(1)))) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'the punch touches first at r = '//text(position) &
                  //', not on its axis'//OTHER_ENGINES)
      return
    end if
    without_load%axis_gap = axis_gap
    without_load%approach = reached
    without_load%e_star = e_star
    contact = without_load
  end subroutine touch

  !> Certify the contact found; warn of a large residual or estimated error.
  subroutine certify_search(profile, search, info)
    use fuge_round_certificate, only: certify_round
    use fuge_round_search, only: disc_search
    use fuge_smooth_accuracy, only: report_accuracy
    class(fuge_smooth_profile), intent(in) :: profile
    type(disc_search), intent(in) :: search
    type(fuge_info), intent(inout) :: info

    call certify_round(profile, search%contact, search%transform, info%residual, info)
    if (info%failed()) return
    call report_accuracy(max(search%contact%radius_error, search%contact%pressure_error), &
                         max(search%violation%tension, search%violation%penetration), search%violation%undecided, &
                         0.0_dp, info)
  end subroutine certify_search

  !> Refuse: report why there is no single disc, and which engine to use.
  subroutine report_outcome(profile, search, info)
    use fuge_round_search, only: disc_search, DISC_AT_RIM, DISC_IN_TENSION, DISC_PENETRATED
    class(fuge_smooth_profile), intent(in) :: profile
    type(disc_search), intent(in) :: search
    type(fuge_info), intent(inout) :: info

    select case (search%outcome)
    case (DISC_AT_RIM)
      call report(info, FUGE_ERR_UNSUPPORTED, 'the contact reaches the end of the profile, r = '//text(profile%upper) &
                  //', an edge if the punch ends there'//OTHER_ENGINES)
    case (DISC_IN_TENSION)
      call report(info, FUGE_ERR_UNSUPPORTED, 'the contact is not a disc: in that of radius ' &
                  //text(search%refused_radius)//' the pressure would be tensile at r = ' &
                  //text(search%violation%tension_radius)//OTHER_ENGINES)
    case (DISC_PENETRATED)
      call report(info, FUGE_ERR_UNSUPPORTED, 'the contact is not a disc: outside of that of radius ' &
                  //text(search%refused_radius)//' the punch would penetrate at r = ' &
                  //text(search%violation%penetration_radius)//OTHER_ENGINES)
    case default
      call report(info, FUGE_ERR_UNSUPPORTED, 'no contact in one disc within the profile was found'//OTHER_ENGINES)
    end select
  end subroutine report_outcome

end module fuge_round_punch
