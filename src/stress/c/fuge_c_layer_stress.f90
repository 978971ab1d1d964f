!> C bindings, section "stresses in layers".
module fuge_c_layer_stress
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_layers, only: find_layers
  use fuge_c_stress_grid, only: cells_of, find_arrays, grid_arrays, require_grid
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_displacement_grid, fuge_layered_halfplane_stress_grid
  use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_displacement_grid, fuge_layered_halfspace_stress_grid
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_body, find_sides

contains

  !> Sixteen arguments, as in the header: the layers, the cells, the depths, the message.
  function c_layered_halfplane_stress_grid(layers, thickness, young, poisson, bonded, n, spacing, force, element, &
                                           boundary, depths, depth, below, stress, message, length) &
    bind(c, name='fuge_layered_halfplane_stress_grid') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, boundary, depths
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, depth, below, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    logical, allocatable :: lower(:)

    call require_count(n, 1, 'n', 'cells', info)
    call find_arrays(int(n), force, depths, depth, stress, 'stress', 3, arrays, info)
    call find_sides(depths, below, lower, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) then
      call fuge_layered_halfplane_stress_grid(body, spacing, arrays%force, int(element), int(boundary), arrays%depth, &
                                              arrays%found, info, lower)
    end if
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_stress_grid

  !> Sixteen arguments, as in the header: the layers, the cells, the depths, the message.
  function c_layered_halfplane_displacement_grid(layers, thickness, young, poisson, bonded, n, spacing, force, &
                                                 element, boundary, depths, depth, below, displacement, message, &
                                                 length) &
    bind(c, name='fuge_layered_halfplane_displacement_grid') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, boundary, depths
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, depth, below, displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    logical, allocatable :: lower(:)

    call require_count(n, 1, 'n', 'cells', info)
    call find_arrays(int(n), force, depths, depth, displacement, 'displacement', 2, arrays, info)
    call find_sides(depths, below, lower, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) then
      call fuge_layered_halfplane_displacement_grid(body, spacing, arrays%force, int(element), int(boundary), &
                                                    arrays%depth, arrays%found, info, lower)
    end if
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_displacement_grid

  !> Seventeen arguments, as in the header: the layers, the grid, the depths, the message.
  function c_layered_halfspace_stress_grid(layers, thickness, young, poisson, bonded, nx, ny, spacing_x, &
                                           spacing_y, force, boundary, depths, depth, below, stress, message, &
                                           length) &
    bind(c, name='fuge_layered_halfspace_stress_grid') result(status)
    integer(c_int), intent(in), value :: layers, bonded, nx, ny, boundary, depths
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, depth, below, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    logical, allocatable :: lower(:)

    call require_grid(nx, ny, info)
    call find_arrays(cells_of(nx, ny, info), force, depths, depth, stress, 'stress', 6, arrays, info)
    call find_sides(depths, below, lower, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) then
      call fuge_layered_halfspace_stress_grid(body, int(nx), int(ny), spacing_x, spacing_y, arrays%force, &
                                              int(boundary), arrays%depth, arrays%found, info, lower)
    end if
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_stress_grid

  !> Seventeen arguments, as in the header: the layers, the grid, the depths, the message.
  function c_layered_halfspace_displacement_grid(layers, thickness, young, poisson, bonded, nx, ny, spacing_x, &
                                                 spacing_y, force, boundary, depths, depth, below, displacement, &
                                                 message, length) &
    bind(c, name='fuge_layered_halfspace_displacement_grid') result(status)
    integer(c_int), intent(in), value :: layers, bonded, nx, ny, boundary, depths
    real(c_double), intent(in), value :: spacing_x, spacing_y
    type(c_ptr), intent(in), value :: thickness, young, poisson, force, depth, below, displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    logical, allocatable :: lower(:)

    call require_grid(nx, ny, info)
    call find_arrays(cells_of(nx, ny, info), force, depths, depth, displacement, 'displacement', 3, arrays, info)
    call find_sides(depths, below, lower, info)
    call find_body(layers, thickness, young, poisson, bonded, body, info)
    if (.not. info%failed()) then
      call fuge_layered_halfspace_displacement_grid(body, int(nx), int(ny), spacing_x, spacing_y, arrays%force, &
                                                    int(boundary), arrays%depth, arrays%found, info, lower)
    end if
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_displacement_grid

  !> The layers; the other body does not matter.
  subroutine find_body(layers, thickness, young, poisson, bonded, body, info)
    integer(c_int), intent(in) :: layers, bonded
    type(c_ptr), intent(in) :: thickness, young, poisson
    type(fuge_layered_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed()) call find_layers(layers, thickness, young, poisson, bonded, &
                                              ieee_value(1.0_c_double, ieee_positive_inf), body, info)
  end subroutine find_body

  !> The sides of interfaces, all above unless `below` is given. FUGE_ERR_MEMORY.
  subroutine find_sides(depths, below, lower, info)
    integer(c_int), intent(in) :: depths
    type(c_ptr), intent(in) :: below
    logical, allocatable, intent(out) :: lower(:)
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: given(:)
    integer :: stat

    if (info%failed()) return
    allocate (lower(depths), stat=stat)
    call require_memory(stat, '', int(depths), 'depths', info)
    if (stat /= 0) return
    lower = .false.
    if (.not. c_associated(below)) return
    call c_f_pointer(below, given, [depths])
    lower = given /= 0
  end subroutine find_sides

end module fuge_c_layer_stress
