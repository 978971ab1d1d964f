!> C bindings, section "stresses on grids".
module fuge_c_stress_grid
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid, fuge_halfplane_stress_grid
  use fuge_halfspace_depths, only: fuge_halfspace_displacement_grid, fuge_halfspace_stress_grid
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE
  implicit none
  private

  public :: cells_of, find_arrays, require_grid

  !> Forces of the cells, depths, and a result (component, cell, depth).
  type, public :: grid_arrays
    real(c_double), pointer :: force(:) => null(), depth(:) => null(), found(:, :, :) => null()
  end type grid_arrays

contains

  !> Ten arguments, as in the header: the cells, the depths, the message.
  function c_halfplane_stress_grid(n, spacing, force, element, boundary, depths, depth, stress, message, length) &
    bind(c, name='fuge_halfplane_stress_grid') result(status)
    integer(c_int), intent(in), value :: n, element, boundary, depths
    real(c_double), intent(in), value :: spacing
    type(c_ptr), intent(in), value :: force, depth, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call find_arrays(int(n), force, depths, depth, stress, 'stress', 3, arrays, info)
    if (.not. info%failed()) call fuge_halfplane_stress_grid(spacing, arrays%force, int(element), int(boundary), &
                                                             arrays%depth, arrays%found, info)
    status = report_to_c(info, message, length)
  end function c_halfplane_stress_grid

  !> Thirteen arguments, as in the header: the cells, the body, the depths, the message.
  function c_halfplane_displacement_grid(n, spacing, force, element, boundary, young, poisson, plane_state, depths, &
                                         depth, displacement, message, length) &
    bind(c, name='fuge_halfplane_displacement_grid') result(status)
    integer(c_int), intent(in), value :: n, element, boundary, plane_state, depths
    real(c_double), intent(in), value :: spacing, young, poisson
    type(c_ptr), intent(in), value :: force, depth, displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call find_arrays(int(n), force, depths, depth, displacement, 'displacement', 2, arrays, info)
    if (.not. info%failed()) call fuge_halfplane_displacement_grid(spacing, arrays%force, int(element), int(boundary), &
                                                                   young, poisson, int(plane_state), arrays%depth, &
                                                                   arrays%found, info)
    status = report_to_c(info, message, length)
  end function c_halfplane_displacement_grid

  !> Twelve arguments, as in the header: the grid, the depths, the message.
  function c_halfspace_stress_grid(nx, ny, spacing_x, spacing_y, force, boundary, poisson, depths, depth, stress, &
                                   message, length) &
    bind(c, name='fuge_halfspace_stress_grid') result(status)
    integer(c_int), intent(in), value :: nx, ny, boundary, depths
    real(c_double), intent(in), value :: spacing_x, spacing_y, poisson
    type(c_ptr), intent(in), value :: force, depth, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_info) :: info

    call require_grid(nx, ny, info)
    call find_arrays(cells_of(nx, ny, info), force, depths, depth, stress, 'stress', 6, arrays, info)
    if (.not. info%failed()) call fuge_halfspace_stress_grid(int(nx), int(ny), spacing_x, spacing_y, arrays%force, &
                                                             int(boundary), poisson, arrays%depth, arrays%found, info)
    status = report_to_c(info, message, length)
  end function c_halfspace_stress_grid

  !> Thirteen arguments, as in the header: the grid, the body, the depths, the message.
  function c_halfspace_displacement_grid(nx, ny, spacing_x, spacing_y, force, boundary, young, poisson, depths, depth, &
                                         displacement, message, length) &
    bind(c, name='fuge_halfspace_displacement_grid') result(status)
    integer(c_int), intent(in), value :: nx, ny, boundary, depths
    real(c_double), intent(in), value :: spacing_x, spacing_y, young, poisson
    type(c_ptr), intent(in), value :: force, depth, displacement, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(grid_arrays) :: arrays
    type(fuge_info) :: info

    call require_grid(nx, ny, info)
    call find_arrays(cells_of(nx, ny, info), force, depths, depth, displacement, 'displacement', 3, arrays, info)
    if (.not. info%failed()) call fuge_halfspace_displacement_grid(int(nx), int(ny), spacing_x, spacing_y, &
                                                                   arrays%force, int(boundary), young, poisson, &
                                                                   arrays%depth, arrays%found, info)
    status = report_to_c(info, message, length)
  end function c_halfspace_displacement_grid

  !> Refuse numbers of cells that are not positive, or whose product no integer holds (FUGE_ERR_SIZE).
  pure subroutine require_grid(nx, ny, info)
    integer(c_int), intent(in) :: nx, ny
    type(fuge_info), intent(inout) :: info

    call require_count(nx, 1, 'nx', 'cells along x', info)
    call require_count(ny, 1, 'ny', 'cells along y', info)
    if (info%failed()) return
    if (ny > huge(1)/nx) call report(info, FUGE_ERR_SIZE, 'nx = '//text(int(nx))//' times ny = '//text(int(ny)) &
                                     //' is more than the largest integer, '//text(huge(1))//': use a coarser grid')
  end subroutine require_grid

  !> nx*ny, unless that is an error.
  pure function cells_of(nx, ny, info) result(cells)
    integer(c_int), intent(in) :: nx, ny
    type(fuge_info), intent(in) :: info
    integer :: cells

    cells = 0
    if (.not. info%failed()) cells = int(nx)*int(ny)
  end function cells_of

  !> The arrays behind pointers, none of which may be NULL; `cells` is valid unless an error is known already. The
  !> arguments are nine, because each pointer has an array that it stands for.
  subroutine find_arrays(cells, force, depths, depth, destination, name, components, arrays, info)
    integer, intent(in) :: cells, components
    integer(c_int), intent(in) :: depths
    type(c_ptr), intent(in) :: force, depth, destination
    character(len=*), intent(in) :: name
    type(grid_arrays), intent(inout) :: arrays
    type(fuge_info), intent(inout) :: info

    call require_count(depths, 0, 'depths', 'depths', info)
    call find_array(int(cells, c_int), force, 'force', arrays%force, info)
    call find_array(depths, depth, 'depth', arrays%depth, info)
    call require_pointer(destination, name, info)
    if (.not. info%failed()) call c_f_pointer(destination, arrays%found, [components, cells, int(depths)])
  end subroutine find_arrays

end module fuge_c_stress_grid
