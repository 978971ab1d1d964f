!> C bindings, section "fields": fields under punches.
module fuge_c_punch_fields
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_field, only: give_field
  use fuge_c_punch, only: find_punch, punch_handle
  use fuge_c_types, only: report_to_c, require_pointer
  use fuge_field_of_punches, only: make_punch_field
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  function c_field_punch(source, young, poisson, plane_state, destination, message, length) &
    bind(c, name='fuge_field_punch') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: plane_state
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(punch_handle), pointer :: handle
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    call find_punch(source, handle, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call make_punch_field(handle%contact, young, poisson, int(plane_state), field, info)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_punch

end module fuge_c_punch_fields
