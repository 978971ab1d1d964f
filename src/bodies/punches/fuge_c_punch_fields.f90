!> C bindings, section "fields": fields under punches.
module fuge_c_punch_fields
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_size_t
  use fuge_c_field, only: give_field
  use fuge_c_round, only: find_round => find_contact, round_handle
  use fuge_c_smooth, only: find_smooth => find_contact, smooth_handle
  use fuge_c_types, only: report_to_c, require_pointer
  use fuge_field_of_punches, only: fuge_round_punch_field, fuge_smooth_punch_field
  use fuge_field_type, only: fuge_field
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  function c_field_smooth(source, young, poisson, plane_state, destination, message, length) &
    bind(c, name='fuge_field_smooth') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_int), intent(in), value :: plane_state
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    type(fuge_smooth_punch_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_smooth(source, handle, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set(handle%contact, young, poisson, int(plane_state), info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_smooth

  function c_field_round(source, young, poisson, destination, message, length) bind(c, name='fuge_field_round') &
    result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    real(c_double), intent(in), value :: young, poisson
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    type(fuge_round_punch_field), allocatable :: made
    class(fuge_field), allocatable :: field
    type(fuge_info) :: info

    allocate (made)
    call find_round(source, handle, info)
    call require_pointer(destination, 'field', info)
    if (.not. info%failed()) call made%set(handle%contact, young, poisson, info)
    call move_alloc(made, field)
    call give_field(field, destination, info)
    status = report_to_c(info, message, length)
  end function c_field_round

end module fuge_c_punch_fields
