!> C bindings, section "stresses of a half-plane": smooth punches.
module fuge_c_smooth_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_smooth, only: find_contact, smooth_handle
  use fuge_c_types, only: report_to_c, require_count, require_pointer
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
    call require_pointer(stress, 'stress', info)
    if (.not. info%failed()) then
      call c_f_pointer(stress, components, [3, int(points)])
      call fuge_smooth_stress(handle%contact, place, depth, components, info)
    end if
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
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) then
      call c_f_pointer(displacement, components, [2, int(points)])
      call fuge_smooth_displacement(handle%contact, young, poisson, int(plane_state), place, depth, components, info)
    end if
    status = report_to_c(info, message, length)
  end function c_smooth_displacement

  !> The arrays of points; neither may be NULL.
  subroutine find_points(points, px, pz, place, depth, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, pz
    real(c_double), pointer, intent(out) :: place(:), depth(:)
    type(fuge_info), intent(inout) :: info

    nullify (place, depth)
    call require_count(points, 0, 'points', 'points', info)
    call require_pointer(px, 'px', info)
    call require_pointer(pz, 'pz', info)
    if (info%failed()) return
    call c_f_pointer(px, place, [points])
    call c_f_pointer(pz, depth, [points])
  end subroutine find_points

end module fuge_c_smooth_stress
