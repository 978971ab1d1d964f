!> From the slope on the interval of contact to the contact.
module fuge_smooth_assembly
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_newton, only: pressing
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_slope_series, only: slope_series
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: make_contact


contains

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

end module fuge_smooth_assembly
