!> C bindings, section "stresses of round bodies".
module fuge_c_round_stress
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_round, only: find_contact, round_handle
  use fuge_c_types, only: report_to_c, require_count
  use fuge_ring_interior, only: fuge_ring_interior_displacement, fuge_ring_stress
  use fuge_round_interior, only: fuge_round_displacement, fuge_round_stress
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Ten arguments, as in the header: the rings, the body, the points, the message.
  function c_ring_stress(n, radius, force, poisson, points, pr, pz, stress, message, length) &
    bind(c, name='fuge_ring_stress') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: radius, force, pr, pz, stress, message
    real(c_double), intent(in), value :: poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), forces(:), distance(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_rings(n, radius, force, radii, forces, info)
    call find_points(points, pr, pz, stress, 'stress', 4, distance, depth, components, info)
    if (.not. info%failed()) call fuge_ring_stress(radii, forces, poisson, distance, depth, components, info)
    status = report_to_c(info, message, length)
  end function c_ring_stress

  !> Eleven arguments, as in the header: the rings, the body, the points, the message.
  function c_ring_interior_displacement(n, radius, force, young, poisson, points, pr, pz, displacement, message, &
                                        length) &
    bind(c, name='fuge_ring_interior_displacement') result(status)
    integer(c_int), intent(in), value :: n, points
    type(c_ptr), intent(in), value :: radius, force, pr, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), forces(:), distance(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_rings(n, radius, force, radii, forces, info)
    call find_points(points, pr, pz, displacement, 'displacement', 2, distance, depth, components, info)
    if (.not. info%failed()) &
      call fuge_ring_interior_displacement(radii, forces, young, poisson, distance, depth, components, info)
    status = report_to_c(info, message, length)
  end function c_ring_interior_displacement

  function c_round_stress(source, poisson, points, pr, pz, stress, message, length) &
    bind(c, name='fuge_round_stress') result(status)
    type(c_ptr), intent(in), value :: source, pr, pz, stress, message
    real(c_double), intent(in), value :: poisson
    integer(c_int), intent(in), value :: points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    real(c_double), pointer :: distance(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call find_points(points, pr, pz, stress, 'stress', 4, distance, depth, components, info)
    if (.not. info%failed()) call fuge_round_stress(handle%contact, poisson, distance, depth, components, info)
    status = report_to_c(info, message, length)
  end function c_round_stress

  !> Nine arguments, as in the header: the contact, the body, the points, the message.
  function c_round_displacement(source, young, poisson, points, pr, pz, displacement, message, length) &
    bind(c, name='fuge_round_displacement') result(status)
    type(c_ptr), intent(in), value :: source, pr, pz, displacement, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: points
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    real(c_double), pointer :: distance(:), depth(:), components(:, :)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call find_points(points, pr, pz, displacement, 'displacement', 2, distance, depth, components, info)
    if (.not. info%failed()) &
      call fuge_round_displacement(handle%contact, young, poisson, distance, depth, components, info)
    status = report_to_c(info, message, length)
  end function c_round_displacement

  !> The arrays of rings, neither of which may be NULL.
  subroutine find_rings(n, radius, force, radii, forces, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: radius, force
    real(c_double), pointer, intent(out) :: radii(:), forces(:)
    type(fuge_info), intent(inout) :: info

    call require_count(n, 1, 'n', 'rings', info)
    call find_array(n + 1_c_int, radius, 'radius', radii, info)
    call find_array(n, force, 'force', forces, info)
  end subroutine find_rings

  !> The arrays of points and of the result, `name`, none of which may be NULL. Ten arguments: three arrays and what
  !> becomes of them.
  subroutine find_points(points, pr, pz, found, name, rows, distance, depth, components, info)
    integer(c_int), intent(in) :: points
    type(c_ptr), intent(in) :: pr, pz, found
    character(len=*), intent(in) :: name
    integer, intent(in) :: rows
    real(c_double), pointer, intent(out) :: distance(:), depth(:), components(:, :)
    type(fuge_info), intent(inout) :: info

    call require_count(points, 0, 'points', 'points', info)
    call find_array(points, pr, 'pr', distance, info)
    call find_array(points, pz, 'pz', depth, info)
    call find_array(rows, points, found, name, components, info)
  end subroutine find_points

end module fuge_c_round_stress
