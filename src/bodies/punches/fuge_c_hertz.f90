!> C bindings, section "Hertz": the elliptic contact in closed form.
module fuge_c_hertz
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: give
  use fuge_c_types, only: report_to_c
  use fuge_hertz_theory, only: fuge_hertz_contact, fuge_hertz_ellipse
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Ten arguments, as in the header: the bodies, the results, the message.
  function c_hertz_ellipse(radius_x, radius_y, e_star, load, semi_axis_x, semi_axis_y, approach, peak_pressure, &
                           message, length) bind(c, name='fuge_hertz_ellipse') result(status)
    real(c_double), intent(in), value :: radius_x, radius_y, e_star, load
    type(c_ptr), intent(in), value :: semi_axis_x, semi_axis_y, approach, peak_pressure, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_hertz_contact) :: contact
    type(fuge_info) :: info

    call fuge_hertz_ellipse(radius_x, radius_y, e_star, load, contact, info)
    if (.not. info%failed()) then
      call give(contact%semi_axis_x, semi_axis_x)
      call give(contact%semi_axis_y, semi_axis_y)
      call give(contact%approach, approach)
      call give(contact%peak_pressure, peak_pressure)
    end if
    status = report_to_c(info, message, length)
  end function c_hertz_ellipse

end module fuge_c_hertz
