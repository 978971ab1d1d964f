!> Smooth punches on an elastic half-plane, to rounding with a few dozen coefficients.
!>
!> The ends of the contact are unknowns of their own, and the pressure is a Chebyshev
!> series times the square root of the distances from both: for a smooth profile the error
!> falls faster than any power of the number of coefficients. See doc/theory.md, "Smooth punches".
module fuge_smooth_punch
  use fuge_constants, only: PI, LARGEST_EXPONENT_OF_4
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_smooth_certificate, only: certify_contact
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_newton, only: pressing
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_samples, only: lowest_place
  use fuge_smooth_search, only: find_interval, interval_search, FOUND, PULLS, OVERLAPS, AT_END
  use fuge_status, only: fuge_info, report, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_UNSUPPORTED, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_RESIDUAL
  use fuge_number_text, only: text
  implicit none
  private

  public :: fuge_solve_smooth_punch

  type(fuge_options), parameter :: DEFAULTS = fuge_options()
  character(len=*), parameter :: OTHER_ENGINES = &
    ': use the half-plane operator on a grid, with FUGE_ITERATIVE or the active set'

contains

  pure function between_length(ends) result(length)
    real(dp), intent(in) :: ends(2)
    integer :: length

    length = len(text(ends(1))) + len(' .. ') + len(text(ends(2)))
  end function between_length

  pure function between(ends) result(words)
    real(dp), intent(in) :: ends(2)
    character(len=between_length(ends)) :: words

    words = text(ends(1))//' .. '//text(ends(2))
  end function between

  !> Press a smooth punch into a half-plane under a force.
  !>
  !> `profile`: its initial gap; `e_star` > 0 as in `fuge_halfplane_matrix`, force per
  !> length squared; `force` >= 0 per depth; out: `contact`. With `moment`, the force times
  !> its distance from x = 0, the punch may tilt as well; without, it only sinks. No force: it
  !> touches at its lowest place (any tilt will do: FUGE_WARN_NOT_UNIQUE if it may tilt).
  !>
  !> The contact is one interval within the profile: the answer is checked to push
  !> everywhere and to overlap nowhere, up to samples at a 512th of the profile.
  !> info%iterations counts the series formed, info%residual is the certificate, from
  !> quadratures of the pressure. FUGE_WARN_RESIDUAL: it or the estimated error are above the
  !> default tolerance of `fuge_options`, as for a profile that is not smooth.
  !> Errors, `contact` untouched: FUGE_ERR_UNSUPPORTED if the contact is not one interval or
  !> reaches an end of the profile, where the message says who can; FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH unless lower < upper, FUGE_ERR_MODULUS,
  !> FUGE_ERR_NO_EQUILIBRIUM for force < 0 or a resultant beside the profile,
  !> FUGE_ERR_CALLBACK for a profile that fails.
  subroutine fuge_solve_smooth_punch(profile, e_star, force, contact, info, moment)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, force
    type(fuge_smooth_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: moment
    type(interval_search) :: search
    type(pressing) :: task
    real(dp) :: place, gap

    task%tilts = present(moment)
    call check_numbers(profile, e_star, force, info)
    if (.not. info%failed() .and. task%tilts) call check_moment(profile, force, moment, task%line, info)
    if (info%failed()) return
    place = task%line
    if (.not. task%tilts .or. .not. force > 0.0_dp) call lowest_place(profile, place, gap, info)
    if (info%failed()) return
    if (.not. force > 0.0_dp) then
      contact = touching(place, gap, e_star)
      if (task%tilts) call report(info, FUGE_WARN_NOT_UNIQUE, &
                                  'without a force nothing holds the tilt: it is left at 0, others are possible')
      return
    end if

    task%load = 4.0_dp/PI*(force/e_star)
    call find_interval(profile, e_star, task, place, search, info)
    info%iterations = search%steps
    if (info%failed()) return
    if (search%outcome /= FOUND) then
      call refuse(profile, search, task%tilts, info)
      return
    end if
    search%contact%force = force
    if (task%tilts) search%contact%moment = moment
    call judge(profile, search, info)
    if (.not. info%failed()) contact = search%contact
  end subroutine fuge_solve_smooth_punch

  subroutine check_numbers(profile, e_star, force, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star, force
    type(fuge_info), intent(inout) :: info

    call check_finite([profile%lower], 'profile%lower', info)
    if (.not. info%failed()) call check_finite([profile%upper], 'profile%upper', info)
    if (.not. info%failed()) call check_finite([e_star], 'e_star', info)
    if (.not. info%failed()) call check_finite([force], 'force', info)
    if (info%failed()) return
    if (.not. profile%lower < profile%upper) then
      call report(info, FUGE_ERR_WIDTH, 'the profile goes from lower = '//text(profile%lower)//' to upper = ' &
                  //text(profile%upper)//': lower has to be less')
    else if (.not. e_star > 0.0_dp) then
      call report(info, FUGE_ERR_MODULUS, 'e_star = '//text(e_star) &
                  //' is not positive: it is E/(1 - nu^2) in plane strain')
    else if (force < 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'force = '//text(force)//' is negative: contact can only push')
    else if (any(abs(exponent([e_star, force, profile%upper - profile%lower])) > LARGEST_EXPONENT_OF_4) &
             .or. exponent(max(abs(profile%lower), abs(profile%upper))) > LARGEST_EXPONENT_OF_4) then
      call report(info, FUGE_ERR_OVERFLOW, 'e_star = '//text(e_star)//', force = '//text(force) &
                  //' or the profile''s place is out of range: choose other units')
    end if
  end subroutine check_numbers

  !> `line`: where the force acts.
  subroutine check_moment(profile, force, moment, line, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: force, moment
    real(dp), intent(inout) :: line
    type(fuge_info), intent(inout) :: info

    call check_finite([moment], 'moment', info)
    if (info%failed()) return
    if (force > 0.0_dp) then
      if (exponent(moment) - exponent(force) < maxexponent(moment) - 2) line = moment/force
      if (exponent(moment) - exponent(force) >= maxexponent(moment) - 2) line = sign(huge(line), moment)
      if (line > profile%lower .and. line < profile%upper) return
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the force acts at moment/force = '//text(line) &
                  //', not between the ends of the profile, '//text(profile%lower)//' and '//text(profile%upper))
    else if (abs(moment) > 0.0_dp) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'moment = '//text(moment)//' without a force: contact can only push')
    end if
  end subroutine check_moment

  !> Contact without a force.
  pure function touching(place, gap, e_star) result(contact)
    real(dp), intent(in) :: place, gap, e_star
    type(fuge_smooth_contact) :: contact

    contact%ends = place
    contact%end_gaps = gap
    contact%approach = gap
    contact%e_star = e_star
  end function touching

  !> Certificate and warnings.
  subroutine judge(profile, search, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(interval_search), intent(in) :: search
    type(fuge_info), intent(inout) :: info
    real(dp) :: worst

    call certify_contact(profile, search%contact, info%residual, info)
    if (info%failed()) return
    worst = max(search%contact%end_error, search%contact%pressure_error)
    info%residual = max(info%residual, search%violation%pull, search%violation%overlap)
    if (info%residual > DEFAULTS%tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the residual is '//text(info%residual)//', the estimated error ' &
                  //text(worst)//': the profile is not smooth in the contact, or its slope is not that of its gap')
    else if (worst > DEFAULTS%tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'the estimated error is '//text(worst) &
                  //': the profile is not smooth in the contact')
    end if
  end subroutine judge

  !> Who can solve it, and what is wrong here.
  subroutine refuse(profile, search, tilts, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(interval_search), intent(in) :: search
    logical, intent(in) :: tilts
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason

    select case (search%outcome)
    case (AT_END)
      reason = 'the contact reaches the end of the profile, x = ' &
               //text(merge(profile%lower, profile%upper, search%refused(1) <= profile%lower)) &
               //', a corner if the punch ends there'
    case (PULLS)
      reason = 'the contact is not one interval: in '//between(search%refused)//' pressure would pull at x = ' &
               //text(search%violation%pull_place)
    case (OVERLAPS)
      reason = 'the contact is not one interval: beside '//between(search%refused) &
               //' the bodies would overlap at x = '//text(search%violation%overlap_place)
    case default
      reason = 'no contact in one interval between the ends of the profile was found'
    end select
    if (tilts) then
      call report(info, FUGE_ERR_UNSUPPORTED, reason//': use a dense half-plane matrix with the active set')
    else
      call report(info, FUGE_ERR_UNSUPPORTED, reason//OTHER_ENGINES)
    end if
  end subroutine refuse

end module fuge_smooth_punch
