!> C bindings, section "stresses of a half-plane": cells.
module fuge_c_halfplane_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_pressed_arrays, only: find_line, line_arrays
  use fuge_c_types, only: report_to_c, require_count
  use fuge_halfplane_interior, only: fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Twelve arguments, as in the header: the cells, the symmetry, the points, the stresses, the message.
  function c_halfplane_stress(n, x, width, force, element, symmetric, points, px, pz, stress, message, length) &
    bind(c, name='fuge_halfplane_stress') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, points
    type(c_ptr), intent(in), value :: x, width, force, px, pz, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    real(c_double), pointer :: along(:), down(:), components(:, :)
    type(fuge_info) :: info

    call find_line(n, x, width, force, line, info)
    call find_points(points, px, pz, along, down, info)
    call find_array(3, points, stress, 'stress', components, info)
    if (.not. info%failed()) call fuge_halfplane_stress(line%x, line%width, line%force, int(element), along, down, &
                                                        components, info, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_halfplane_stress

  !> Fifteen arguments, as in the header: the cells, the body, the symmetry, the points, the displacements, the message.
  function c_halfplane_displacement(n, x, width, force, element, young, poisson, plane_state, symmetric, points, px, &
                                    pz, displacement, message, length) &
    bind(c, name='fuge_halfplane_displacement') result(status)
    integer(c_int), intent(in), value :: n, element, plane_state, symmetric, points
    type(c_ptr), intent(in), value :: x, width, force, px, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    real(c_double), pointer :: along(:), down(:), components(:, :)
    type(fuge_info) :: info

    call find_line(n, x, width, force, line, info)
    call find_points(points, px, pz, along, down, info)
    call find_array(2, points, displacement, 'displacement', components, info)
    if (.not. info%failed()) call fuge_halfplane_displacement(line%x, line%width, line%force, int(element), young, &
                                                              poisson, int(plane_state), along, down, components, &
                                                              info, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_halfplane_displacement

  !> The coordinates of the points, along the surface and into the body.
  subroutine find_points(points, px, pz, along, down, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, pz
    real(c_double), pointer, intent(out) :: along(:), down(:)
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, px, 'px', along, info)
    call find_array(points, pz, 'pz', down, info)
  end subroutine find_points

end module fuge_c_halfplane_stress
