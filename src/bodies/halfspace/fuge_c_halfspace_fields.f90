!> C bindings, section "fields": fields in half-spaces.
module fuge_c_halfspace_fields
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_field, only: give_field
  use fuge_c_pressed_arrays, only: area_arrays, find_area, find_grid
  use fuge_c_types, only: report_to_c, require_pointer
  use fuge_field_of_halfspace, only: fuge_halfspace_field
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Thirteen arguments, as in the header: the rectangles, the body, the field, the message.
  function c_field_halfspace(n, x, y, width_x, width_y, force, symmetric_x, symmetric_y, young, poisson, destination, &
                             message, length) bind(c, name='fuge_field_halfspace') result(status)
    integer(c_int), intent(in), value :: n, symmetric_x, symmetric_y
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(fuge_halfspace_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_area(n, x, y, width_x, width_y, force, area, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set_rectangles(area%x, area%y, area%width_x, area%width_y, area%force, young, &
                                                      poisson, info, symmetric_x /= 0, symmetric_y /= 0)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_halfspace

  !> Eleven arguments, as in the header: the grid, the body, the field, the message.
  function c_field_halfspace_grid(nx, ny, spacing_x, spacing_y, force, boundary, young, poisson, destination, message, &
                                  length) bind(c, name='fuge_field_halfspace_grid') result(status)
    integer(c_int), intent(in), value :: nx, ny, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y, young, poisson
    type(c_ptr), intent(in), value :: force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_halfspace_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_grid(nx, ny, force, forces, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set_grid(int(nx), int(ny), spacing_x, spacing_y, forces, int(boundary), young, &
                                                poisson, info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_halfspace_grid

end module fuge_c_halfspace_fields
