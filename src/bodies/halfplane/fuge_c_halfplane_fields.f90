!> C bindings, section "fields": fields in half-planes.
module fuge_c_halfplane_fields
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_field, only: give_field
  use fuge_c_pressed_arrays, only: find_line, line_arrays
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_field_of_halfplane, only: fuge_halfplane_field
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Twelve arguments, as in the header: the cells, the body, the field, the message.
  function c_field_halfplane(n, x, width, force, element, symmetric, young, poisson, plane_state, destination, &
                             message, length) bind(c, name='fuge_field_halfplane') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, plane_state
    type(c_ptr), intent(in), value :: x, width, force, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    type(fuge_halfplane_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_line(n, x, width, force, line, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set_cells(line%x, line%width, line%force, int(element), young, poisson, &
                                                 int(plane_state), info, symmetric /= 0)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_halfplane

  !> Eleven arguments, as in the header: the grid, the body, the field, the message.
  function c_field_halfplane_grid(n, spacing, force, element, boundary, young, poisson, plane_state, destination, &
                                  message, length) bind(c, name='fuge_field_halfplane_grid') result(status)
    integer(c_int), intent(in), value :: n, element, boundary, plane_state
    real(c_double), intent(in), value :: spacing, young, poisson
    type(c_ptr), intent(in), value :: force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_halfplane_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call require_count(n, 1, 'n', 'cells', info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set_grid(spacing, forces, int(element), int(boundary), young, poisson, &
                                                int(plane_state), info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_halfplane_grid

end module fuge_c_halfplane_fields
