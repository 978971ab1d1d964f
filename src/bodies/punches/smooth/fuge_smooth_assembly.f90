!> Assembles the contact from the slope of the punch on the interval of contact.
module fuge_smooth_assembly
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_newton, only: load_case
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_slope_series, only: slope_series
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: assemble_contact

contains

  !> The contact on the interval of `series`.
  subroutine assemble_contact(profile, e_star, load, series, contact, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: e_star
    type(load_case), intent(in) :: load
    type(slope_series), intent(in) :: series
    type(fuge_smooth_contact), intent(out) :: contact
    type(fuge_info), intent(inout) :: info
    real(dp) :: gap(3), slope(3), x(3)

    associate (a => series%coefficients, anchor => series%interval%anchor, offset => series%interval%offset, &
               half_width => series%interval%half_width)
      contact%e_star = e_star
      contact%anchor = anchor
      contact%offset = offset
      contact%half_width = half_width
      contact%ends = anchor + [offset - half_width, offset + half_width]
      contact%ends = max(profile%lower, min(profile%upper, contact%ends))
      contact%force = 0.25_dp*PI*e_star*load%reduced_force
      contact%moment = contact%force*(anchor + (offset + 0.5_dp*half_width*a(3)/a(2)))
      if (load%free_tilt) contact%moment = contact%force*load%line_of_action
      if (load%free_tilt) contact%tilt = a(1)
      contact%coefficients = 0.5_dp*e_star*a(2:)
      contact%end_error = series%leading_error
      contact%pressure_error = series%series_error
      x = [contact%ends(1), anchor + offset, contact%ends(2)]
      call sample_profile(profile, x, gap, slope, info)
      contact%end_gaps = [gap(1), gap(3)]
      contact%datum = 2.0_dp*(profile%upper - profile%lower)
      contact%approach = gap(2) - contact%tilt*x(2) + middle_displacement(series, load, contact%datum)
    end associate
  end subroutine assemble_contact

  !> Displacement in the middle of the contact, half width h, where displacements vanish at the
  !> distance `datum`: for the pressure sum_k b_k T_k/sqrt(1 - t**2) it is
  !> (2 h/E*) [b_0 ln(2 datum/h) + sum_k b_k T_k(0)/k].
  pure function middle_displacement(series, load, datum) result(displacement)
    type(slope_series), intent(in) :: series
    type(load_case), intent(in) :: load
    real(dp), intent(in) :: datum
    real(dp) :: displacement
    real(dp) :: c(-1:size(series%coefficients)), alternating
    integer :: k

    ! c_k/E*, continued by zeros.
    c = 0.0_dp
    c(0:size(series%coefficients) - 2) = 0.5_dp*series%coefficients(2:)
    displacement = 0.0_dp
    alternating = 1.0_dp
    do k = 2, size(series%coefficients), 2
      alternating = -alternating
      displacement = displacement + alternating*(c(k) - c(k - 2))/(2.0_dp*real(k, dp))
    end do
    displacement = 0.5_dp*load%reduced_force*log(2.0_dp*datum/series%interval%half_width) &
                   + 2.0_dp*series%interval%half_width*displacement
  end function middle_displacement

end module fuge_smooth_assembly
