!> C bindings, section "largest stresses".
module fuge_c_stress_peak
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_arrays, only: find_array
  use fuge_c_pressed_arrays, only: area_arrays, find_area, find_line, line_arrays
  use fuge_c_round, only: find_round => find_contact, round_handle
  use fuge_c_smooth, only: find_smooth => find_contact, smooth_handle
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_halfplane_peak_search, only: fuge_halfplane_peak, fuge_smooth_peak
  use fuge_halfspace_peak_search, only: fuge_halfspace_peak
  use fuge_round_peak_search, only: fuge_ring_peak, fuge_round_peak
  use fuge_status, only: fuge_info
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  !> struct fuge_stress_peak.
  type, bind(c) :: c_peak
    integer(c_int) :: location
    integer(c_int) :: reserved_int(7)
    real(c_double) :: value
    real(c_double) :: place(3), tensor(6)
    real(c_double) :: reserved(6)
  end type c_peak

contains

  !> Twelve arguments, as in the header: the cells, the body, the symmetry, the measure, the result, the message.
  function c_halfplane_peak(n, x, width, force, element, plane_state, poisson, symmetric, measure, destination, &
                            message, length) bind(c, name='fuge_halfplane_peak') result(status)
    integer(c_int), intent(in), value :: n, element, plane_state, symmetric, measure
    type(c_ptr), intent(in), value :: x, width, force, destination, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    call find_line(n, x, width, force, line, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call fuge_halfplane_peak(line%x, line%width, line%force, int(element), &
                                                      int(plane_state), poisson, int(measure), peak, info, &
                                                      symmetric /= 0)
    call give_peak(peak, destination, info)
    status = report_to_c(info, message, length)
  end function c_halfplane_peak

  function c_smooth_peak(source, plane_state, poisson, measure, destination, message, length) &
    bind(c, name='fuge_smooth_peak') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_int), intent(in), value :: plane_state, measure
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    call find_smooth(source, handle, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call fuge_smooth_peak(handle%contact, int(plane_state), poisson, int(measure), peak, info)
    call give_peak(peak, destination, info)
    status = report_to_c(info, message, length)
  end function c_smooth_peak

  !> Thirteen arguments, as in the header: the rectangles, the body, the symmetry, the measure, the result, the message.
  function c_halfspace_peak(n, x, y, width_x, width_y, force, poisson, symmetric_x, symmetric_y, measure, destination, &
                            message, length) bind(c, name='fuge_halfspace_peak') result(status)
    integer(c_int), intent(in), value :: n, symmetric_x, symmetric_y, measure
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, destination, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    call find_area(n, x, y, width_x, width_y, force, area, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call fuge_halfspace_peak(area%x, area%y, area%width_x, area%width_y, area%force, &
                                                      poisson, int(measure), peak, info, symmetric_x /= 0, &
                                                      symmetric_y /= 0)
    call give_peak(peak, destination, info)
    status = report_to_c(info, message, length)
  end function c_halfspace_peak

  function c_ring_peak(n, radius, force, poisson, measure, destination, message, length) &
    bind(c, name='fuge_ring_peak') result(status)
    integer(c_int), intent(in), value :: n, measure
    type(c_ptr), intent(in), value :: radius, force, destination, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), forces(:)
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'rings', info)
    call find_array(n + 1_c_int, radius, 'radius', radii, info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call fuge_ring_peak(radii, forces, poisson, int(measure), peak, info)
    call give_peak(peak, destination, info)
    status = report_to_c(info, message, length)
  end function c_ring_peak

  function c_round_peak(source, poisson, measure, destination, message, length) &
    bind(c, name='fuge_round_peak') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_int), intent(in), value :: measure
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info

    call find_round(source, handle, info)
    call require_pointer(destination, 'peak', info)
    if (.not. info%failed()) call fuge_round_peak(handle%contact, poisson, int(measure), peak, info)
    call give_peak(peak, destination, info)
    status = report_to_c(info, message, length)
  end function c_round_peak

  !> Fill the struct of C, unless there is an error.
  subroutine give_peak(peak, destination, info)
    type(fuge_stress_peak), intent(in) :: peak
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(in) :: info
    type(c_peak), pointer :: found

    if (info%failed()) return
    call c_f_pointer(destination, found)
    found%location = int(peak%location, c_int)
    found%reserved_int = 0_c_int
    found%value = peak%value
    found%place = peak%place
    found%tensor = peak%tensor
    found%reserved = 0.0_c_double
  end subroutine give_peak

end module fuge_c_stress_peak
