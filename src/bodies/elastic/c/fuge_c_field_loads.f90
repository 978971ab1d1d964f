!> C bindings, section "fields": fields in half-planes and half-spaces, and under punches.
module fuge_c_field_loads
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_field, only: give_field
  use fuge_c_pressed_arrays, only: area_arrays, find_area, find_line, line_arrays
  use fuge_c_round, only: find_round => find_contact, round_handle
  use fuge_c_smooth, only: find_smooth => find_contact, smooth_handle
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_field_of_halfplane, only: fuge_halfplane_field
  use fuge_field_of_halfspace, only: fuge_halfspace_field
  use fuge_field_of_punches, only: fuge_round_punch_field, fuge_smooth_punch_field
  use fuge_field_of_rings, only: fuge_rings_field
  use fuge_field_type, only: fuge_field
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_grid

contains

  !> Twelve arguments, as in the header: the cells, the body, the field, the message.
  function c_field_halfplane(n, x, width, force, element, symmetric, young, poisson, plane_state, destination, message, &
                             length) bind(c, name='fuge_field_halfplane') result(status)
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

  !> The forces of nx x ny cells; FUGE_ERR_SIZE, FUGE_ERR_POINTER.
  subroutine find_grid(nx, ny, force, forces, info)
    integer(c_int), intent(in) :: nx, ny
    type(c_ptr), intent(in) :: force
    real(c_double), pointer, intent(out) :: forces(:)
    type(fuge_info), intent(inout) :: info

    nullify (forces)
    call require_count(nx, 1, 'nx', 'cells along x', info)
    call require_count(ny, 1, 'ny', 'cells along y', info)
    if (info%failed()) return
    if (nx > huge(nx)/ny) then
      call report(info, FUGE_ERR_SIZE, text(int(nx))//' x '//text(int(ny))//' cells are more than an integer counts')
    else
      call find_array(nx*ny, force, 'force', forces, info)
    end if
  end subroutine find_grid

  function c_field_rings(n, radius, force, young, poisson, destination, message, length) &
    bind(c, name='fuge_field_rings') result(status)
    integer(c_int), intent(in), value :: n
    type(c_ptr), intent(in), value :: radius, force, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), forces(:)
    type(fuge_rings_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call require_count(n, 1, 'n', 'rings', info)
    call find_array(n + 1_c_int, radius, 'radius', radii, info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set(radii, forces, young, poisson, info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_rings

  function c_field_smooth(source, young, poisson, plane_state, destination, message, length) &
    bind(c, name='fuge_field_smooth') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: plane_state
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    type(fuge_smooth_punch_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_smooth(source, handle, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set(handle%contact, young, poisson, int(plane_state), info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_smooth

  function c_field_round(source, young, poisson, destination, message, length) bind(c, name='fuge_field_round') &
    result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    type(fuge_round_punch_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_round(source, handle, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set(handle%contact, young, poisson, info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_round

end module fuge_c_field_loads
