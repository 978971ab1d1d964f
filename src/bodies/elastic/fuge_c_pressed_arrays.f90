!> C bindings of stresses: the arrays that describe the cells of a half-plane, and the rectangles of a half-space.
module fuge_c_pressed_arrays
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: require_count
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_area, find_grid, find_line

  !> Cells with their forces.
  type, public :: line_arrays
    real(c_double), pointer :: x(:) => null(), width(:) => null(), force(:) => null()
  end type line_arrays

  !> Rectangles with their forces.
  type, public :: area_arrays
    real(c_double), pointer :: x(:) => null(), y(:) => null(), width_x(:) => null(), width_y(:) => null()
    real(c_double), pointer :: force(:) => null()
  end type area_arrays

contains

  !> The arrays of `n` >= 1 cells. Errors: FUGE_ERR_SIZE, FUGE_ERR_POINTER.
  subroutine find_line(n, x, width, force, line, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: x, width, force
    type(line_arrays), intent(inout) :: line
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call find_array(n, x, 'x', line%x, info)
    call find_array(n, width, 'width', line%width, info)
    call find_array(n, force, 'force', line%force, info)
  end subroutine find_line

  !> The arrays of `n` >= 1 rectangles. Errors as for `find_line`. Eight arguments, those of the functions that call it.
  subroutine find_area(n, x, y, width_x, width_y, force, area, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: x, y, width_x, width_y, force
    type(area_arrays), intent(inout) :: area
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'rectangles', info)
    call find_array(n, x, 'x', area%x, info)
    call find_array(n, y, 'y', area%y, info)
    call find_array(n, width_x, 'width_x', area%width_x, info)
    call find_array(n, width_y, 'width_y', area%width_y, info)
    call find_array(n, force, 'force', area%force, info)
  end subroutine find_area

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

end module fuge_c_pressed_arrays
