!> C bindings, section "stresses of a half-space": at points under rectangles.
module fuge_c_halfspace_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_halfspace_stresses, only: fuge_halfspace_displacement, fuge_halfspace_stress
  use fuge_status, only: fuge_info
  implicit none
  private

  !> The arrays of C that all calls take.
  type :: c_arrays
    real(c_double), pointer :: x(:) => null(), y(:) => null(), width_x(:) => null(), width_y(:) => null()
    real(c_double), pointer :: force(:) => null(), px(:) => null(), py(:) => null(), pz(:) => null()
  end type c_arrays

contains

  !> Fourteen arguments, as in the header: the rectangles, the points, the stresses, the message.
  function c_halfspace_stress(n, x, y, width_x, width_y, force, poisson, points, px, py, pz, stress, message, length) &
    bind(c, name='fuge_halfspace_stress') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, px, py, pz, stress, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = c_halfspace_symmetric_stress(n, x, y, width_x, width_y, force, poisson, 0_c_int, 0_c_int, points, px, py, &
                                          pz, stress, message, length)
  end function c_halfspace_stress

  !> Sixteen arguments, as in the header: the rectangles, the symmetry, the points, the stresses, the message.
  function c_halfspace_symmetric_stress(n, x, y, width_x, width_y, force, poisson, symmetric_x, symmetric_y, points, &
                                        px, py, pz, stress, message, length) &
    bind(c, name='fuge_halfspace_symmetric_stress') result(status)
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
    call require_pointer(stress, 'stress', info)
    if (.not. info%failed()) then
      call c_f_pointer(stress, found, [6, int(points)])
      call fuge_halfspace_stress(arrays%x, arrays%y, arrays%width_x, arrays%width_y, arrays%force, poisson, arrays%px, &
                                 arrays%py, arrays%pz, found, info, symmetric_x /= 0, symmetric_y /= 0)
    end if
    status = report_to_c(info, message, length)
  end function c_halfspace_symmetric_stress

  !> Fifteen arguments, as in the header: the rectangles, the body, the points, the displacements, the message.
  function c_halfspace_displacement(n, x, y, width_x, width_y, force, young, poisson, points, px, py, pz, &
                                    displacement, message, length) &
    bind(c, name='fuge_halfspace_displacement') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, force, px, py, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = c_halfspace_symmetric_displacement(n, x, y, width_x, width_y, force, young, poisson, 0_c_int, 0_c_int, &
                                                points, px, py, pz, displacement, message, length)
  end function c_halfspace_displacement

  !> Seventeen arguments, as in the header: the rectangles, the body, the symmetry, the points, the displacements, the
  !> message.
  function c_halfspace_symmetric_displacement(n, x, y, width_x, width_y, force, young, poisson, symmetric_x, &
                                              symmetric_y, points, px, py, pz, displacement, message, length) &
    bind(c, name='fuge_halfspace_symmetric_displacement') result(status)
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
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) then
      call c_f_pointer(displacement, found, [3, int(points)])
      call fuge_halfspace_displacement(arrays%x, arrays%y, arrays%width_x, arrays%width_y, arrays%force, young, &
                                       poisson, arrays%px, arrays%py, arrays%pz, found, info, symmetric_x /= 0, &
                                       symmetric_y /= 0)
    end if
    status = report_to_c(info, message, length)
  end function c_halfspace_symmetric_displacement

  !> The arrays of `n` rectangles. Eight arguments, those of the functions that call it.
  subroutine find_rectangles(n, x, y, width_x, width_y, force, arrays, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: x, y, width_x, width_y, force
    type(c_arrays), intent(inout) :: arrays
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'rectangles', info)
    call find_values(n, x, 'x', arrays%x, info)
    call find_values(n, y, 'y', arrays%y, info)
    call find_values(n, width_x, 'width_x', arrays%width_x, info)
    call find_values(n, width_y, 'width_y', arrays%width_y, info)
    call find_values(n, force, 'force', arrays%force, info)
  end subroutine find_rectangles

  !> The arrays of the points.
  subroutine find_points(points, px, py, pz, arrays, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: px, py, pz
    type(c_arrays), intent(inout) :: arrays
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_values(points, px, 'px', arrays%px, info)
    call find_values(points, py, 'py', arrays%py, info)
    call find_values(points, pz, 'pz', arrays%pz, info)
  end subroutine find_points

  !> An array of C of `n` values; unless an error is known already, NULL is one (FUGE_ERR_POINTER).
  subroutine find_values(n, address, name, values, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), pointer, intent(inout) :: values(:)
    type(fuge_info), intent(inout) :: info

    call require_pointer(address, name, info)
    if (.not. info%failed()) call c_f_pointer(address, values, [n])
  end subroutine find_values

end module fuge_c_halfspace_stress
