!> C bindings, section "smooth punches".
module fuge_c_smooth
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_null_ptr, c_funptr, c_loc, c_associated, &
    c_f_pointer, c_f_procpointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_types, only: report_to_c, require_count, require_pointer, set_handle, take_handle
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY
  implicit none
  private

  public :: find_contact, procedure_at

  abstract interface
    !> fuge_smooth_profile of fuge_punch.h.
    function c_profile(n, x, gap, slope, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout) :: gap(*), slope(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_profile
  end interface

  !> A profile that is a function of C.
  type, extends(fuge_smooth_profile), public :: callback_profile
    procedure(c_profile), pointer, nopass :: profile => null()
    type(c_ptr) :: user = c_null_ptr
  contains
    procedure :: evaluate
  end type callback_profile

  !> Behind struct fuge_smooth.
  type, public :: smooth_handle
    type(fuge_smooth_contact) :: contact
    type(fuge_info) :: info
  end type smooth_handle

  !> struct fuge_smooth_report.
  type, bind(c) :: c_report
    integer(c_int) :: iterations, coefficients
    integer(c_int) :: reserved_int(6)
    real(c_double) :: left, right, half_width, force, moment, approach, tilt, residual, end_error, pressure_error
    real(c_double) :: reserved(8)
  end type c_report

contains

  !> Ten arguments, as in the header: the profile, the other data of the problem, the result, the message.
  function c_solve_smooth_punch(profile, user, lower, upper, e_star, force, moment, destination, message, length) &
    bind(c, name='fuge_solve_smooth_punch') result(status)
    type(c_funptr), intent(in), value :: profile
    type(c_ptr), intent(in), value :: user, moment, destination, message
    real(c_double), intent(in), value :: lower, upper, e_star, force
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_profile) :: punch
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: prescribed
    type(fuge_info) :: info
    integer :: stat

    nullify (handle, prescribed)
    call require_pointer(profile, 'profile', info)
    call require_pointer(destination, 'contact', info)
    if (.not. info%failed()) then
      allocate (handle, stat=stat)
      call require_memory(stat, 'the contact', info)
    end if
    if (.not. info%failed()) then
      punch%lower = lower
      punch%upper = upper
      punch%user = user
      punch%profile => procedure_at(profile)
      ! An actual argument that is a null pointer is an absent one.
      if (c_associated(moment)) call c_f_pointer(moment, prescribed)
      call fuge_solve_smooth_punch(punch, e_star, force, handle%contact, info, prescribed)
      if (info%failed()) then
        deallocate (handle)
      else
        handle%info = info
        call set_handle(c_loc(handle), destination)
      end if
    end if
    status = report_to_c(info, message, length)
  end function c_solve_smooth_punch

  function procedure_at(address) result(found)
    type(c_funptr), intent(in) :: address
    procedure(c_profile), pointer :: found

    call c_f_procpointer(address, found)
  end function procedure_at

  !> The callback gets a copy, so that one which writes to x harms nobody; its results start as NaN,
  !> so that a value that it forgets is seen.
  subroutine evaluate(self, x, gap, slope, status)
    class(callback_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(c_double), allocatable :: values(:, :)
    integer :: stat

    allocate (values(size(x), 3), stat=stat)
    if (stat /= 0) then
      gap = 0.0_dp
      slope = 0.0_dp
      status = FUGE_ERR_MEMORY
      return
    end if
    values = ieee_value(0.0_dp, ieee_quiet_nan)
    values(:, 1) = x
    status = int(self%profile(int(size(x), c_int), values(:, 1), values(:, 2), values(:, 3), self%user))
    gap = values(:, 2)
    slope = values(:, 3)
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine evaluate

  subroutine c_smooth_free(source) bind(c, name='fuge_smooth_free')
    type(c_ptr), intent(in), value :: source
    type(smooth_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_smooth_free

  function c_get_report(source, destination, message, length) bind(c, name='fuge_smooth_get_report') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
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
    type(smooth_handle), intent(in) :: handle
    type(c_report) :: summary

    summary%iterations = int(handle%info%iterations, c_int)
    summary%coefficients = 0_c_int
    if (allocated(handle%contact%coefficients)) summary%coefficients = int(size(handle%contact%coefficients), c_int)
    summary%left = handle%contact%ends(1)
    summary%right = handle%contact%ends(2)
    summary%half_width = handle%contact%half_width
    summary%force = handle%contact%force
    summary%moment = handle%contact%moment
    summary%approach = handle%contact%approach
    summary%tilt = handle%contact%tilt
    summary%residual = handle%info%residual
    summary%end_error = handle%contact%end_error
    summary%pressure_error = handle%contact%pressure_error
    summary%reserved_int = 0_c_int
    summary%reserved = 0.0_c_double
  end function report_of

  function c_get_pressure(source, number, x, pressure, message, length) &
    bind(c, name='fuge_smooth_get_pressure') result(status)
    type(c_ptr), intent(in), value :: source, x, pressure, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: places(:)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_count(number, 0, 'count', 'places', info)
    call find_array(number, x, 'x', places, info)
    call require_pointer(pressure, 'pressure', info)
    if (.not. info%failed()) call check_finite(places, 'x', info)
    if (.not. info%failed()) call give(handle%contact%pressure(places), pressure)
    status = report_to_c(info, message, length)
  end function c_get_pressure

  function c_get_gap(source, number, x, initial_gap, gap, message, length) &
    bind(c, name='fuge_smooth_get_gap') result(status)
    type(c_ptr), intent(in), value :: source, x, initial_gap, gap, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: places(:), initial(:)
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_count(number, 0, 'count', 'places', info)
    call find_array(number, x, 'x', places, info)
    call find_array(number, initial_gap, 'initial_gap', initial, info)
    call require_pointer(gap, 'gap', info)
    if (.not. info%failed()) call check_finite(places, 'x', info)
    if (.not. info%failed()) call check_finite(initial, 'initial_gap', info)
    if (.not. info%failed()) call give(handle%contact%gap(places, initial), gap)
    status = report_to_c(info, message, length)
  end function c_get_gap

  function c_get_coefficients(source, capacity, coefficients, message, length) &
    bind(c, name='fuge_smooth_get_coefficients') result(status)
    type(c_ptr), intent(in), value :: source, coefficients, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    type(fuge_info) :: info

    call find_contact(source, handle, info)
    call require_count(capacity, 0, 'capacity', 'elements of coefficients', info)
    call require_pointer(coefficients, 'coefficients', info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    if (.not. allocated(handle%contact%coefficients)) return
    call give(handle%contact%coefficients(:min(int(capacity), size(handle%contact%coefficients))), coefficients)
  end function c_get_coefficients

  !> The contact behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_contact(source, handle, info)
    type(c_ptr), intent(in) :: source
    type(smooth_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(source, 'contact', info)
    if (.not. info%failed()) call c_f_pointer(source, handle)
  end subroutine find_contact

end module fuge_c_smooth
