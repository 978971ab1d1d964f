!> Smooth punches on an elastic half-plane, accurate to rounding with a few dozen coefficients.
!>
!> The ends of the contact are unknowns of their own, and the pressure is a Chebyshev series
!> times the square root of the distances from both ends. For a smooth profile this is a spectral
!> method: the error decreases faster than any power of the number of coefficients. See
!> doc/theory_punch.md, "Smooth punches".
module fuge_smooth_punch
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_4
  use fuge_elastic_moduli, only: check_e_star
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: fuge_info, report, FUGE_ERR_WIDTH, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_UNSUPPORTED, FUGE_WARN_NOT_UNIQUE
  implicit none
  private

  public :: fuge_solve_smooth_punch

  character(len=*), parameter :: OTHER_ENGINES = &
    ': use the half-plane operator on a grid, with FUGE_ITERATIVE or the active set'

contains

  !> Press a smooth punch into a half-plane under a force.
  !>
  !> `profile`: its initial gap; `e_star` > 0 as in `fuge_halfplane_matrix`, force per
  !> length squared; `force` >= 0 per unit depth; out: `contact`. With `moment`, the force times
  !> its distance from x = 0, the punch may tilt as well; without it the tilt is 0. With zero force
  !> the punch touches at its lowest point; if it may tilt, FUGE_WARN_NOT_UNIQUE.
  !>
  !> The contact is one interval within the profile. Tension is excluded by bounds of the pressure's
  !> series; so is penetration, by those of series of the gap beside the contact, for which a detail
  !> narrower than a 512th of the profile may be overlooked. info%iterations counts the series
  !> formed; info%residual is the certificate, from quadratures of the pressure.
  !> FUGE_WARN_RESIDUAL: the residual or the estimated error is above the default tolerance of
  !> `fuge_options`, as for a profile that is not smooth.
  !> Errors, `contact` untouched: FUGE_ERR_UNSUPPORTED if the contact is not one interval or
  !> reaches an end of the profile, with a message that names another engine; FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH unless lower < upper, FUGE_ERR_MODULUS,
  !> FUGE_ERR_NO_EQUILIBRIUM for force < 0 or a line of action outside of the profile,
  !> FUGE_ERR_CALLBACK for a profile that fails.
  subroutine fuge_solve_smooth_punch(profile, e_star, force, contact, info, moment)
    use fuge_smooth_newton, only: load_case
    use fuge_smooth_samples, only: lowest_position
    use fuge_smooth_search, only: find_contact_interval, interval_search, INTERVAL_FOUND
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, force
    type(fuge_smooth_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: moment
    type(interval_search) :: search
    type(load_case) :: load
    real(dp) :: position, gap

    load%free_tilt = present(moment)
    call check_data(profile, e_star, force, info)
    if (.not. info%failed() .and. load%free_tilt) call check_moment(profile, force, moment, load%line_of_action, info)
    if (info%failed()) return
    position = load%line_of_action
    if (.not. load%free_tilt .or. .not. force > 0.0_dp) call lowest_position(profile, position, gap, info)
    if (info%failed()) return
    if (.not. force > 0.0_dp) then
      contact = point_contact(position, gap, e_star)
      if (load%free_tilt) call report(info, FUGE_WARN_NOT_UNIQUE, 'without a force nothing resists a tilt: it is ' &
                                      //'returned as 0, others are possible')
      return
    end if

    load%reduced_force = 4.0_dp/PI*(force/e_star)
    call find_contact_interval(profile, e_star, load, position, search, info)
    info%iterations = search%steps
    if (info%failed()) return
    if (search%outcome /= INTERVAL_FOUND) then
      call report_outcome(profile, search, load, info)
      return
    end if
    search%contact%force = force
    if (load%free_tilt) search%contact%moment = moment
    call certify_search(profile, search, info)
    if (.not. info%failed()) contact = search%contact
  end subroutine fuge_solve_smooth_punch

  !> Refuse numbers that no engine can use, and a negative force.
  subroutine check_data(profile, e_star, force, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, force
    type(fuge_info), intent(inout) :: info

    call check_finite(profile%lower, 'lower', info)
    if (.not. info%failed()) call check_finite(profile%upper, 'upper', info)
    if (.not. info%failed()) call check_e_star(e_star, info)
    if (.not. info%failed()) call check_finite(force, 'force', info)
    if (info%failed()) return
    if (.not. profile%lower < profile%upper) then
      call report(info, FUGE_ERR_WIDTH, 'the profile goes from lower = '//text(profile%lower)//' to upper = ' &
                  //text(profile%upper)//': lower has to be less')
    else if (force < 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'force = '//text(force)//' is negative: contact can only push')
    else if (any(abs(exponent([e_star, profile%upper - profile%lower])) > LARGEST_EXPONENT_OF_4) &
             .or. exponent(max(abs(profile%lower), abs(profile%upper), force)) > LARGEST_EXPONENT_OF_4) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(e_star)//', force = '//text(force) &
                  //' or the position of the profile is out of range: choose other units')
    else if (force > 0.0_dp .and. exponent(force) - max(exponent(e_star), 0) < minexponent(force) + 1) then
      call report(info, FUGE_ERR_OVERFLOW, 'force = '//text(force)//' is too small beside e_star = '//text(e_star) &
                  //': their quotient leaves the range of double precision; choose a smaller unit of length')
    end if
  end subroutine check_data

  !> Refuse a moment without force, and a `line_of_action` outside of the profile, which is moment/force.
  subroutine check_moment(profile, force, moment, line_of_action, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: force, moment
    real(dp), intent(inout) :: line_of_action
    type(fuge_info), intent(inout) :: info

    call check_finite(moment, 'moment', info)
    if (info%failed()) return
    if (force > 0.0_dp) then
      if (exponent(moment) - exponent(force) < maxexponent(moment) - 2) then
        line_of_action = moment/force
      else
        line_of_action = sign(huge(line_of_action), moment)
      end if
      if (line_of_action > profile%lower .and. line_of_action < profile%upper) return
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the force acts at moment/force = '//text(line_of_action) &
                  //', not between the ends of the profile, '//text(profile%lower)//' and '//text(profile%upper))
    else if (abs(moment) > 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'moment = '//text(moment)//' without a force: contact can only push')
    end if
  end subroutine check_moment

  !> The contact without force: one point.
  pure function point_contact(position, gap, e_star) result(contact)
    real(dp), intent(in) :: position, gap, e_star
    type(fuge_smooth_contact) :: contact

    contact%ends = position
    contact%end_gaps = gap
    contact%approach = gap
    contact%e_star = e_star
  end function point_contact

  !> Certify the contact found; warn of a large residual or estimated error.
  subroutine certify_search(profile, search, info)
    use fuge_smooth_accuracy, only: report_accuracy
    use fuge_smooth_certificate, only: certify_contact
    use fuge_smooth_search, only: interval_search
    class(fuge_smooth_profile), intent(in) :: profile
    type(interval_search), intent(in) :: search
    type(fuge_info), intent(inout) :: info

    call certify_contact(profile, search%contact, info%residual, info)
    if (info%failed()) return
    call report_accuracy(max(search%contact%end_error, search%contact%pressure_error), &
                         max(search%violation%tension, search%violation%penetration), search%violation%undecided, &
                         rounding_of_ends(search%contact%ends), info)
  end subroutine certify_search

  !> The rounding of the ends over half the width between them.
  pure function rounding_of_ends(ends) result(rounding)
    real(dp), intent(in) :: ends(2)
    real(dp) :: rounding

    rounding = 1.0_dp
    if (ends(2) > ends(1)) rounding = epsilon(rounding)*maxval(abs(ends))/(0.5_dp*(ends(2) - ends(1)))
  end function rounding_of_ends

  !> Refuse: report why there is no single interval, and which engine to use.
  subroutine report_outcome(profile, search, load, info)
    use fuge_smooth_newton, only: load_case
    use fuge_smooth_search, only: interval_search, INTERVAL_IN_TENSION, INTERVAL_PENETRATED, INTERVAL_AT_END
    class(fuge_smooth_profile), intent(in) :: profile
    type(interval_search), intent(in) :: search
    type(load_case), intent(in) :: load
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason

    select case (search%outcome)
    case (INTERVAL_AT_END)
      reason = 'the contact reaches the end of the profile, x = ' &
               //text(merge(profile%lower, profile%upper, search%refused_ends(1) <= profile%lower)) &
               //', a corner if the punch ends there'
    case (INTERVAL_IN_TENSION)
      reason = 'the contact is not one interval: in '//interval_text(search%refused_ends) &
               //' the pressure would be tensile at x = '//text(search%violation%tension_position)
    case (INTERVAL_PENETRATED)
      reason = 'the contact is not one interval: outside of '//interval_text(search%refused_ends) &
               //' the punch would penetrate at x = '//text(search%violation%penetration_position)
    case default
      reason = 'no contact in one interval between the ends of the profile was found'
      if (load%reduced_force < epsilon(1.0_dp)*(profile%upper - profile%lower)) then
        call report(info, FUGE_ERR_UNSUPPORTED, 'no contact was found: force/e_star is so small that the contact is ' &
                    //'narrower than the rounding of its positions; put x = 0 where the punch touches')
        return
      end if
    end select
    if (load%free_tilt) then
      call report(info, FUGE_ERR_UNSUPPORTED, reason//': use a dense half-plane matrix with the active set')
    else
      call report(info, FUGE_ERR_UNSUPPORTED, reason//OTHER_ENGINES)
    end if
  end subroutine report_outcome

  pure function interval_text_length(ends) result(length)
    real(dp), intent(in) :: ends(2)
    integer :: length

    length = len(text(ends(1))) + len(' .. ') + len(text(ends(2)))
  end function interval_text_length

  !> An interval as text, from its ends.
  pure function interval_text(ends) result(string)
    real(dp), intent(in) :: ends(2)
    character(len=interval_text_length(ends)) :: string

    string = text(ends(1))//' .. '//text(ends(2))
  end function interval_text

end module fuge_smooth_punch
