!> C bindings, section "stresses of a half-space": at points under rectangles.
module fuge_c_halfspace_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count
  use fuge_halfspace_interior, only: fuge_halfspace_displacement, fuge_halfspace_stress
  use fuge_status, only: fuge_info
  implicit none
  private

  !> The arrays of C that all calls take.
  type :: c_arrays
    real(c_double), pointer :: x(:) => null(), y(:) => null(), width_x(:) => null(), width_y(:) => null()
    real(c_double), pointer :: force(:) => null(), px(:) => null(), py(:) => null(), pz(:) => null()
  end type c_arrays

contains

  !> Sixteen arguments, as in the header: the rectangles, the symmetry, the points, the stresses, the message.
  function c_halfspace_stress(n, x, y, width_x, width_y, force, poisson, symmetric_x, symmetric_y, points, px, py, pz, &
                              stress, message, length) bind(c, name='fuge_halfspace_stress') result(status)
    integer(c_int), intent(in), value :: n, symmetric_x, symmetric_y, points
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, px, py, pz, stress, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(c_arrays) :: arrays
    real(c_double), pointer :: found(:, :)
    type(fuge_info) :: info

    call find_rectangles(n, x, y, width_x, width_y, force, arrays, info)
    call find_points(points, px, py, pz, arrays, info)
    call find_array(6, points, stress, 'stress', found, info)
    if (.not. info%failed()) call fuge_halfspace_stress(arrays%x, arrays%y, arrays%width_x, arrays%width_y, &
                                                        arrays%force, poisson, arrays%px, arrays%py, arrays%pz, found, &
                                                        info, symmetric_x /= 0, symmetric_y /= 0)
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
    type(c_arrays) :: arrays
    real(c_double), pointer :: found(:, :)
    type(fuge_info) :: info

    call find_rectangles(n, x, y, width_x, width_y, force, arrays, info)
    call find_points(points, px, py, pz, arrays, info)
    call find_array(3, points, displacement, 'displacement', found, info)
    if (.not. info%failed()) call fuge_halfspace_displacement(arrays%x, arrays%y, arrays%width_x, arrays%width_y, &
                                                              arrays%force, young, poisson, arrays%px, arrays%py, &
                                                              arrays%pz, found, info, symmetric_x /= 0, &
                                                              symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_halfspace_displacement

  !> The arrays of `n` rectangles. Eight arguments, those of the functions that call it.
  subroutine find_rectangles(n, x, y, width_x, width_y, force, arrays, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: x, y, width_x, width_y, force
    type(c_arrays), intent(inout) :: arrays
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'rectangles', info)
    call find_array(n, x, 'x', arrays%x, info)
    call find_array(n, y, 'y', arrays%y, info)
    call find_array(n, width_x, 'width_x', arrays%width_x, info)
    call find_array(n, width_y, 'width_y', arrays%width_y, info)
    call find_array(n, force, 'force', arrays%force, info)
  end subroutine find_rectangles

  !> The arrays of the points.
  subroutine find_points(points, px, py, pz, arrays, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, py, pz
    type(c_arrays), intent(inout) :: arrays
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, px, 'px', arrays%px, info)
    call find_array(points, py, 'py', arrays%py, info)
    call find_array(points, pz, 'pz', arrays%pz, info)
  end subroutine find_points

end module fuge_c_halfspace_stress
