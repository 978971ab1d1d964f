!> C bindings, section "stresses in layers": at points.
module fuge_c_layer_points
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_layer_stress, only: find_body, find_sides
  use fuge_c_pressed_arrays, only: area_arrays, find_area, find_line, line_arrays
  use fuge_c_types, only: report_to_c, require_count
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_halfplane_interior, only: fuge_layered_halfplane_displacement, fuge_layered_halfplane_stress
  use fuge_layered_halfspace_interior, only: fuge_layered_halfspace_displacement, fuge_layered_halfspace_stress
  use fuge_status, only: fuge_info
  implicit none
  private

  !> Points, their sides of interfaces, and the results there; `y` of an area only.
  type :: point_arrays
    real(c_double), pointer :: x(:) => null(), y(:) => null(), z(:) => null(), found(:, :) => null()
    logical, allocatable :: below(:)
  end type point_arrays

contains

  !> Eighteen arguments, as in the header: the layers, the cells, the points, the stresses, the message.
  function c_layered_halfplane_stress(layers, thickness, young, poisson, bonded, n, x, width, force, element, &
                                      symmetric, points, px, pz, below, stress, message, length) &
    bind(c, name='fuge_layered_halfplane_stress') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, symmetric, points
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, width, force, px, pz, below, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    type(point_arrays) :: point
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_line(n, x, width, force, line, info)
    call find_points(points, px, pz, below, point, info)
    call find_array(3, points, stress, 'stress', point%found, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfplane_stress(body, line%x, line%width, line%force, int(element), &
                                                                point%x, point%z, point%found, info, point%below, &
                                                                symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_stress

  !> Eighteen arguments, as in the header: the layers, the cells, the points, the displacements, the message.
  function c_layered_halfplane_displacement(layers, thickness, young, poisson, bonded, n, x, width, force, element, &
                                            symmetric, points, px, pz, below, displacement, message, length) &
    bind(c, name='fuge_layered_halfplane_displacement') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, symmetric, points
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, width, force, px, pz, below, displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    type(point_arrays) :: point
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_line(n, x, width, force, line, info)
    call find_points(points, px, pz, below, point, info)
    call find_array(2, points, displacement, 'displacement', point%found, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfplane_displacement(body, line%x, line%width, line%force, &
                                                                      int(element), point%x, point%z, point%found, &
                                                                      info, point%below, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_displacement

  !> Twenty-one arguments, as in the header: the layers, the rectangles, the points, the stresses, the message.
  function c_layered_halfspace_stress(layers, thickness, young, poisson, bonded, n, x, y, width_x, width_y, force, &
                                      symmetric_x, symmetric_y, points, px, py, pz, below, stress, message, length) &
    bind(c, name='fuge_layered_halfspace_stress') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, symmetric_x, symmetric_y, points
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, y, width_x, width_y, force, px, py, pz, below, &
      stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(point_arrays) :: point
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_area(n, x, y, width_x, width_y, force, area, info)
    call find_points(points, px, pz, below, point, info)
    call find_array(points, py, 'py', point%y, info)
    call find_array(6, points, stress, 'stress', point%found, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfspace_stress(body, area%x, area%y, area%width_x, area%width_y, &
                                                                area%force, point%x, point%y, point%z, point%found, &
                                                                info, point%below, symmetric_x /= 0, symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_stress

  !> Twenty-one arguments, as in the header: the layers, the rectangles, the points, the displacements, the message.
  function c_layered_halfspace_displacement(layers, thickness, young, poisson, bonded, n, x, y, width_x, width_y, &
                                            force, symmetric_x, symmetric_y, points, px, py, pz, below, displacement, &
                                            message, length) &
    bind(c, name='fuge_layered_halfspace_displacement') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, symmetric_x, symmetric_y, points
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, y, width_x, width_y, force, px, py, pz, below, &
      displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(point_arrays) :: point
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_area(n, x, y, width_x, width_y, force, area, info)
    call find_points(points, px, pz, below, point, info)
    call find_array(points, py, 'py', point%y, info)
    call find_array(3, points, displacement, 'displacement', point%found, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call fuge_layered_halfspace_displacement(body, area%x, area%y, area%width_x, &
                                                                      area%width_y, area%force, point%x, point%y, &
                                                                      point%z, point%found, info, point%below, &
                                                                      symmetric_x /= 0, symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_displacement

  !> Coordinates along x and z, and sides of interfaces.
  subroutine find_points(points, px, pz, below, point, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, pz, below
    type(point_arrays), intent(inout) :: point
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, px, 'px', point%x, info)
    call find_array(points, pz, 'pz', point%z, info)
    call find_sides(points, below, point%below, info)
  end subroutine find_points

end module fuge_c_layer_points
