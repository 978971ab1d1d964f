!> C bindings, section "fields": fields under rings.
module fuge_c_rings_fields
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_field, only: give_field
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_field_of_rings, only: fuge_rings_field
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info
  implicit none
  private

contains

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

end module fuge_c_rings_fields
