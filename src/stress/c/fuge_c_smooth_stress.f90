!> C bindings, section "stresses of a half-plane": smooth punches.
module fuge_c_smooth_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_smooth, only: find_contact, smooth_handle
  use fuge_c_types, only: report_to_c, require_count
  use fuge_smooth_interior, only: fuge_smooth_displacement, fuge_smooth_stress
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  function c_smooth_stress(source, points, px, pz, stress, message, length) &
    bind(c, name='fuge_smooth_stress') result(status)
    type(c_ptr), intent(in), value :: source, px, pz, stress, message
    integer(c_int), intent(in), value :: points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: place(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call find_points(points, px, pz, place, depth, info)
    call find_array(3, points, stress, 'stress', components, info)
    if (.not. info%failed()) call fuge_smooth_stress(handle%contact, place, depth, components, info)
    status = report_to_c(info, message, length)
  end function c_smooth_stress

  !> Ten arguments, as in the header: the contact, the body, the points, the message.
  function c_smooth_displacement(source, young, poisson, plane_state, points, px, pz, displacement, message, length) &
    bind(c, name='fuge_smooth_displacement') result(status)
    type(c_ptr), intent(in), value :: source, px, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: plane_state, points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: place(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call find_points(points, px, pz, place, depth, info)
    call find_array(2, points, displacement, 'displacement', components, info)
    if (.not. info%failed()) call fuge_smooth_displacement(handle%contact, young, poisson, int(plane_state), place, &
                                                           depth, components, info)
    status = report_to_c(info, message, length)
  end function c_smooth_displacement

  !> The arrays of points; neither may be NULL.
  subroutine find_points(points, px, pz, place, depth, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, pz
    real(c_double), pointer, intent(out) :: place(:), depth(:)
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, px, 'px', place, info)
    call find_array(points, pz, 'pz', depth, info)
  end subroutine find_points

end module fuge_c_smooth_stress
