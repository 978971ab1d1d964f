!> C bindings, section "rings": round bodies on the half-space with the dense engines.
module fuge_c_rings
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_operator, only: find_matrix
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_ring_influence, only: fuge_ring_displacement, fuge_ring_matrix
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

contains

  function c_ring_matrix(n, radius, e_star, element, alpha, lda, message, length) &
    bind(c, name='fuge_ring_matrix') result(status)
    integer(c_int), intent(in), value :: n, element, lda
    type(c_ptr), intent(in), value :: radius, alpha, message
    real(c_double), intent(in), value :: e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), matrix(:, :)
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    if (.not. info%failed()) call find_array(n + 1_c_int, radius, 'radius', radii, info)
    if (.not. info%failed()) call fuge_ring_matrix(radii, e_star, int(element), matrix, info)
    status = report_to_c(info, message, length)
  end function c_ring_matrix

  !> Nine arguments, as in the header: the rings, the places, the message.
  function c_ring_displacement(n, radius, force, e_star, number, place, displacement, message, length) &
    bind(c, name='fuge_ring_displacement') result(status)
    integer(c_int), intent(in), value :: n, number
    type(c_ptr), intent(in), value :: radius, force, place, displacement, message
    real(c_double), intent(in), value :: e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), forces(:), places(:)
    real(c_double), allocatable :: found(:)
    type(fuge_info) :: info
    integer :: stat

    call require_count(n, 1, 'n', 'rings', info)
    call require_count(number, 0, 'count', 'places', info)
    if (.not. info%failed()) call find_array(n + 1_c_int, radius, 'radius', radii, info)
    call find_array(n, force, 'force', forces, info)
    call find_array(number, place, 'place', places, info)
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) then
      allocate (found(number), stat=stat)
      call require_memory(stat, 'the displacements', info)
    end if
    if (.not. info%failed()) call fuge_ring_displacement(radii, forces, e_star, places, found, info)
    if (.not. info%failed()) call give(found, displacement)
    status = report_to_c(info, message, length)
  end function c_ring_displacement

end module fuge_c_rings
