!> C bindings, section "stresses of a half-space": at points under rectangles.
module fuge_c_halfspace_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_pressed_arrays, only: area_arrays, find_area
  use fuge_c_types, only: report_to_c, require_count
  use fuge_halfspace_interior, only: fuge_halfspace_displacement, fuge_halfspace_stress
  use fuge_status, only: fuge_info
  implicit none
  private

  !> Coordinates of points.
  type :: point_arrays
    real(c_double), pointer :: x(:) => null(), y(:) => null(), z(:) => null()
  end type point_arrays

contains

  !> Sixteen arguments, as in the header: the rectangles, the symmetry, the points, the stresses, the message.
  function c_halfspace_stress(n, x, y, width_x, width_y, force, poisson, symmetric_x, symmetric_y, points, px, py, pz, &
                              stress, message, length) bind(c, name='fuge_halfspace_stress') result(status)
    integer(c_int), intent(in), value :: n, symmetric_x, symmetric_y, points
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, px, py, pz, stress, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(point_arrays) :: point
    real(c_double), pointer :: found(:, :)
    type(fuge_info) :: info

    call find_area(n, x, y, width_x, width_y, force, area, info)
    call find_points(points, px, py, pz, point, info)
    call find_array(6, points, stress, 'stress', found, info)
    if (.not. info%failed()) call fuge_halfspace_stress(area%x, area%y, area%width_x, area%width_y, area%force, &
                                                        poisson, point%x, point%y, point%z, found, info, &
                                                        symmetric_x /= 0, symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_halfspace_stress

  !> Seventeen arguments, as in the header: the rectangles, the body, the symmetry, the points, the displacements, the
  !> message.
  function c_halfspace_displacement(n, x, y, width_x, width_y, force, young, poisson, symmetric_x, symmetric_y, &
                                    points, px, py, pz, displacement, message, length) &
    bind(c, name='fuge_halfspace_displacement') result(status)
    integer(c_int), intent(in), value :: n, symmetric_x, symmetric_y, points
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, px, py, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(point_arrays) :: point
    real(c_double), pointer :: found(:, :)
    type(fuge_info) :: info

    call find_area(n, x, y, width_x, width_y, force, area, info)
    call find_points(points, px, py, pz, point, info)
    call find_array(3, points, displacement, 'displacement', found, info)
    if (.not. info%failed()) call fuge_halfspace_displacement(area%x, area%y, area%width_x, area%width_y, &
                                                              area%force, young, poisson, point%x, point%y, point%z, &
                                                              found, info, symmetric_x /= 0, symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_halfspace_displacement

  !> The arrays of the points.
  subroutine find_points(points, px, py, pz, point, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, py, pz
    type(point_arrays), intent(inout) :: point
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, px, 'px', point%x, info)
    call find_array(points, py, 'py', point%y, info)
    call find_array(points, pz, 'pz', point%z, info)
  end subroutine find_points

end module fuge_c_halfspace_stress
