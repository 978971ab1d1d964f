!> C bindings, section "fields": fields in bodies of layers.
module fuge_c_field_layers
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_field, only: give_field
  use fuge_c_layers, only: find_layers
  use fuge_c_pressed_arrays, only: area_arrays, find_area, find_grid, find_line, line_arrays
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_field_of_layers, only: fuge_layered_area_field, fuge_layered_line_field
  use fuge_field_type, only: fuge_field
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> The layers below a contact, whatever the other body is; an error is reported unless one is known already.
  subroutine find_body(layers, thickness, young, poisson, bonded, body, info)
    integer(c_int), intent(in) :: layers, bonded
    type(c_ptr), intent(in) :: thickness, young, poisson
    type(fuge_layered_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed()) call find_layers(layers, thickness, young, poisson, bonded, &
                                              ieee_value(1.0_c_double, ieee_positive_inf), body, info)
  end subroutine find_body

  !> Fourteen arguments, as in the header: the layers, the cells, the field, the message.
  function c_field_layered_line(layers, thickness, young, poisson, bonded, n, x, width, force, element, symmetric, &
                                destination, message, length) bind(c, name='fuge_field_layered_line') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, symmetric
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, width, force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(line_arrays) :: line
    type(fuge_layered_body) :: body
    type(fuge_layered_line_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_line(n, x, width, force, line, info)
    call require_pointer(destination, 'field', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call made%set_cells(body, line%x, line%width, line%force, int(element), info, &
                                                 symmetric /= 0)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_layered_line

  !> Thirteen arguments, as in the header: the layers, the grid, the field, the message.
  function c_field_layered_line_grid(layers, thickness, young, poisson, bonded, n, spacing, force, element, boundary, &
                                     destination, message, length) bind(c, name='fuge_field_layered_line_grid') &
    result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, boundary
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_layered_body) :: body
    type(fuge_layered_line_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call require_count(n, 1, 'n', 'cells', info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(destination, 'field', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call made%set_grid(body, spacing, forces, int(element), int(boundary), info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_layered_line_grid

  !> Sixteen arguments, as in the header: the layers, the rectangles, the field, the message.
  function c_field_layered_area(layers, thickness, young, poisson, bonded, n, x, y, width_x, width_y, force, &
                                symmetric_x, symmetric_y, destination, message, length) &
    bind(c, name='fuge_field_layered_area') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, symmetric_x, symmetric_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, y, width_x, width_y, force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(area_arrays) :: area
    type(fuge_layered_body) :: body
    type(fuge_layered_area_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_area(n, x, y, width_x, width_y, force, area, info)
    call require_pointer(destination, 'field', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call made%set_rectangles(body, area%x, area%y, area%width_x, area%width_y, area%force, &
                                                      info, symmetric_x /= 0, symmetric_y /= 0)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_layered_area

  !> Fourteen arguments, as in the header: the layers, the grid, the field, the message.
  function c_field_layered_area_grid(layers, thickness, young, poisson, bonded, nx, ny, spacing_x, spacing_y, force, &
                                     boundary, destination, message, length) &
    bind(c, name='fuge_field_layered_area_grid') result(status)
    integer(c_int), intent(in), value :: layers, bonded, nx, ny, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: forces(:)
    type(fuge_layered_body) :: body
    type(fuge_layered_area_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_grid(nx, ny, force, forces, info)
    call require_pointer(destination, 'field', info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) call made%set_grid(body, int(nx), int(ny), spacing_x, spacing_y, forces, int(boundary), &
                                                info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_layered_area_grid

end module fuge_c_field_layers
