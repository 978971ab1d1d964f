!> C bindings, section "stresses of a half-plane": cells.
module fuge_c_halfplane_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: report_to_c, require_count
  use fuge_halfplane_interior, only: fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_status, only: fuge_info
  implicit none
  private

  !> Cells with their forces, and points.
  type :: loaded_points
    real(c_double), pointer :: x(:) => null(), width(:) => null(), force(:) => null()
    real(c_double), pointer :: px(:) => null(), pz(:) => null()
  end type loaded_points

contains

  !> Twelve arguments, as in the header: the cells, the symmetry, the points, the stresses, the message.
  function c_halfplane_stress(n, x, width, force, element, symmetric, points, px, pz, stress, message, length) &
    bind(c, name='fuge_halfplane_stress') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, points
    type(c_ptr), intent(in), value :: x, width, force, px, pz, stress, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(loaded_points) :: model
    real(c_double), pointer :: components(:, :)
    type(fuge_info) :: info

    call find_arrays(n, x, width, force, points, px, pz, model, info)
    call find_array(3, points, stress, 'stress', components, info)
    if (.not. info%failed()) call fuge_halfplane_stress(model%x, model%width, model%force, int(element), model%px, &
                                                        model%pz, components, info, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_halfplane_stress

  !> Fifteen arguments, as in the header: the cells, the body, the symmetry, the points, the displacements, the message.
  function c_halfplane_displacement(n, x, width, force, element, young, poisson, plane_state, symmetric, points, px, &
                                    pz, displacement, message, length) &
    bind(c, name='fuge_halfplane_displacement') result(status)
    integer(c_int), intent(in), value :: n, element, plane_state, symmetric, points
    type(c_ptr), intent(in), value :: x, width, force, px, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(loaded_points) :: model
    real(c_double), pointer :: components(:, :)
    type(fuge_info) :: info

    call find_arrays(n, x, width, force, points, px, pz, model, info)
    call find_array(2, points, displacement, 'displacement', components, info)
    if (.not. info%failed()) call fuge_halfplane_displacement(model%x, model%width, model%force, int(element), young, &
                                                              poisson, int(plane_state), model%px, model%pz, &
                                                              components, info, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_halfplane_displacement

  !> The arrays behind pointers, none of which may be NULL. The arguments are nine, because each pointer has an array
  !> that it stands for.
  subroutine find_arrays(n, x, width, force, points, px, pz, model, info)
    integer(c_int), intent(in) :: n, points
    type(c_ptr), intent(in) :: x, width, force, px, pz
    type(loaded_points), intent(inout) :: model
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'cells', info)
    call require_count(points, 0, 'points', 'points', info)
    call find_array(n, x, 'x', model%x, info)
    call find_array(n, width, 'width', model%width, info)
    call find_array(n, force, 'force', model%force, info)
    call find_array(points, px, 'px', model%px, info)
    call find_array(points, pz, 'pz', model%pz, info)
  end subroutine find_arrays

end module fuge_c_halfplane_stress
