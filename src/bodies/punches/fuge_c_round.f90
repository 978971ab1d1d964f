!> C bindings, section "round punches".
module fuge_c_round
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_funptr, c_loc, c_associated, c_f_pointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_smooth, only: callback_profile, procedure_at
  use fuge_c_types, only: report_to_c, require_count, require_pointer, set_handle, take_handle
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_punch, only: fuge_solve_round_punch
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: fuge_info, report, require_memory
  implicit none
  private

  public :: find_contact

  !> Behind struct fuge_round.
  type, public :: round_handle
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info
  end type round_handle

  !> struct fuge_round_report.
  type, bind(c) :: c_report
    integer(c_int) :: iterations, coefficients
    integer(c_int) :: reserved_int(6)
    real(c_double) :: radius, load, approach, residual, radius_error, pressure_error
    real(c_double) :: reserved(8)
  end type c_report

contains

  !> Ten arguments, as in the header: the profile, the modulus, what is prescribed, the result, the message.
  function c_solve_round_punch(profile, user, reach, e_star, load, approach, radius, destination, message, length) &
    bind(c, name='fuge_solve_round_punch') result(status)
    type(c_funptr), intent(in), value :: profile
    type(c_ptr), intent(in), value :: user, load, approach, radius, destination, message
    real(c_double), intent(in), value :: reach, e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_profile) :: punch
    type(fuge_info) :: info

    call require_pointer(profile, 'profile', info)
    if (.not. info%failed()) then
      punch%upper = reach
      punch%user = user
      punch%profile => procedure_at(profile)
      call solve(punch, e_star, load, approach, radius, destination, info)
    end if
    status = report_to_c(info, message, length)
  end function c_solve_round_punch

  !> Twelve arguments, as in the header: the profile, the modulus, what is prescribed, the result, the message.
  function c_solve_round_powers(terms, coefficients, powers, starts, reach, e_star, load, approach, radius, &
                                destination, message, length) bind(c, name='fuge_solve_round_powers') result(status)
    integer(c_int), intent(in), value :: terms
    type(c_ptr), intent(in), value :: coefficients, powers, starts, load, approach, radius, destination, message
    real(c_double), intent(in), value :: reach, e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_power_profile) :: punch
    real(c_double), pointer :: factors(:), exponents(:), values(:)
    type(fuge_info) :: info

    call require_count(terms, 1, 'terms', 'powers', info)
    call find_array(terms, coefficients, 'coefficients', factors, info)
    call find_array(terms, powers, 'powers', exponents, info)
    if (.not. info%failed()) then
      punch%upper = reach
      punch%coefficients = factors
      punch%powers = exponents
      if (c_associated(starts)) then
        call c_f_pointer(starts, values, [terms])
        punch%starts = values
      end if
      call solve(punch, e_star, load, approach, radius, destination, info)
    end if
    status = report_to_c(info, message, length)
  end function c_solve_round_powers

  !> Solve for any profile; what is NULL is not prescribed.
  subroutine solve(punch, e_star, load, approach, radius, destination, info)
    class(fuge_smooth_profile), intent(in) :: punch
    real(dp), intent(in) :: e_star
    type(c_ptr), intent(in) :: load, approach, radius, destination
    type(fuge_info), intent(inout) :: info
    type(round_handle), pointer :: handle
    real(dp), pointer :: given_load, given_approach, given_radius
    integer :: stat

    call require_pointer(destination, 'contact', info)
    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the contact', info)
    if (stat /= 0) return
    ! An actual argument that is a null pointer is an absent one.
    nullify (given_load, given_approach, given_radius)
    if (c_associated(load)) call c_f_pointer(load, given_load)
    if (c_associated(approach)) call c_f_pointer(approach, given_approach)
    if (c_associated(radius)) call c_f_pointer(radius, given_radius)
    call fuge_solve_round_punch(punch, e_star, handle%contact, info, given_load, given_approach, given_radius)
    if (info%failed()) then
      deallocate (handle)
    else
      handle%info = info
      call set_handle(c_loc(handle), destination)
    end if
  end subroutine solve

  subroutine c_round_free(source) bind(c, name='fuge_round_free')
    type(c_ptr), intent(in), value :: source
    type(round_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_round_free

  function c_get_report(source, destination, message, length) bind(c, name='fuge_round_get_report') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    type(c_report), pointer :: summary
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_pointer(destination, 'report', info)
    if (.not. info%failed()) then
      call c_f_pointer(destination, summary)
      summary = report_of(handle)
    end if
    status = report_to_c(info, message, length)
  end function c_get_report

  pure function report_of(handle) result(summary)
    type(round_handle), intent(in) :: handle
    type(c_report) :: summary

    summary%iterations = int(handle%info%iterations, c_int)
    summary%coefficients = int(size(handle%contact%coefficients()), c_int)
    summary%radius = handle%contact%radius
    summary%load = handle%contact%load
    summary%approach = handle%contact%approach
    summary%residual = handle%info%residual
    summary%radius_error = handle%contact%radius_error
    summary%pressure_error = handle%contact%pressure_error
    summary%reserved_int = 0_c_int
    summary%reserved = 0.0_c_double
  end function report_of

  function c_get_pressure(source, number, r, pressure, message, length) &
    bind(c, name='fuge_round_get_pressure') result(status)
    type(c_ptr), intent(in), value :: source, r, pressure, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    real(c_double), pointer :: places(:)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_count(number, 0, 'count', 'places', info)
    call find_array(number, r, 'r', places, info)
    call require_pointer(pressure, 'pressure', info)
    if (.not. info%failed()) call check_finite(places, 'r', info)
    if (.not. info%failed()) call give(handle%contact%pressure(places), pressure)
    status = report_to_c(info, message, length)
  end function c_get_pressure

  function c_get_gap(source, number, r, initial_gap, gap, message, length) &
    bind(c, name='fuge_round_get_gap') result(status)
    type(c_ptr), intent(in), value :: source, r, initial_gap, gap, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(round_handle), pointer :: handle
    real(c_double), pointer :: places(:), initial(:)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_count(number, 0, 'count', 'places', info)
    call find_array(number, r, 'r', places, info)
    call find_array(number, initial_gap, 'initial_gap', initial, info)
    call require_pointer(gap, 'gap', info)
    if (.not. info%failed()) call check_finite(places, 'r', info)
    if (.not. info%failed()) call check_finite(initial, 'initial_gap', info)
    if (.not. info%failed()) call give(handle%contact%gap(places, initial), gap)
    status = report_to_c(info, message, length)
  end function c_get_gap

  !> The contact behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_contact(source, handle, info)
    type(c_ptr), intent(in) :: source
    type(round_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(source, 'contact', info)
    if (.not. info%failed()) call c_f_pointer(source, handle)
  end subroutine find_contact

end module fuge_c_round
