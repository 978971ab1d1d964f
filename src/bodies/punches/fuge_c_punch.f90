!> C bindings, sections "smooth punches", "round punches" and "contacts of punches".
module fuge_c_punch
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_null_ptr, c_funptr, c_loc, c_associated, &
    c_f_pointer, c_f_procpointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_types, only: report_to_c, require_count, require_pointer, set_handle, take_handle
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_punch_contact_type, only: punch_contact
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_punch, only: fuge_solve_round_punch
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_status, only: fuge_info, require_memory, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY
  implicit none
  private

  public :: find_punch

  abstract interface
    !> fuge_smooth_profile of fuge_punches.h.
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

  !> Behind struct fuge_punch.
  type, public :: punch_handle
    class(punch_contact), allocatable :: contact
    type(fuge_info) :: info
  end type punch_handle

  !> struct fuge_punch_report.
  type, bind(c) :: c_report
    integer(c_int) :: iterations = 0, coefficients = 0
    integer(c_int) :: reserved_int(6) = 0
    real(c_double) :: left = 0.0_dp, right = 0.0_dp, half_width = 0.0_dp, force = 0.0_dp, moment = 0.0_dp
    real(c_double) :: approach = 0.0_dp, tilt = 0.0_dp
    real(c_double) :: residual = 0.0_dp, end_error = 0.0_dp, pressure_error = 0.0_dp
    real(c_double) :: reserved(8) = 0.0_dp
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
    type(fuge_smooth_contact), allocatable :: smooth
    class(punch_contact), allocatable :: contact
    real(c_double), pointer :: prescribed
    type(fuge_info) :: info

    call require_pointer(profile, 'profile', info)
    call require_pointer(destination, 'contact', info)
    if (.not. info%failed()) then
      punch = callback_of(profile, user, lower, upper)
      ! An actual argument that is a null pointer is an absent one.
      nullify (prescribed)
      if (c_associated(moment)) call c_f_pointer(moment, prescribed)
      allocate (smooth)
      call fuge_solve_smooth_punch(punch, e_star, force, smooth, info, prescribed)
      call move_alloc(smooth, contact)
    end if
    call give_contact(contact, destination, info)
    status = report_to_c(info, message, length)
  end function c_solve_smooth_punch

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
    if (.not. info%failed()) punch = callback_of(profile, user, 0.0_dp, reach)
    call solve_round(punch, e_star, load, approach, radius, destination, info)
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
    end if
    call solve_round(punch, e_star, load, approach, radius, destination, info)
    status = report_to_c(info, message, length)
  end function c_solve_round_powers

  !> Solve for any round profile, unless an error is known already; what is NULL is not prescribed.
  subroutine solve_round(punch, e_star, load, approach, radius, destination, info)
    class(fuge_smooth_profile), intent(in) :: punch
    real(dp), intent(in) :: e_star
    type(c_ptr), intent(in) :: load, approach, radius, destination
    type(fuge_info), intent(inout) :: info
    type(fuge_round_contact), allocatable :: round
    class(punch_contact), allocatable :: contact
    real(dp), pointer :: given_load, given_approach, given_radius

    call require_pointer(destination, 'contact', info)
    if (info%failed()) return
    ! An actual argument that is a null pointer is an absent one.
    nullify (given_load, given_approach, given_radius)
    if (c_associated(load)) call c_f_pointer(load, given_load)
    if (c_associated(approach)) call c_f_pointer(approach, given_approach)
    if (c_associated(radius)) call c_f_pointer(radius, given_radius)
    allocate (round)
    call fuge_solve_round_punch(punch, e_star, round, info, given_load, given_approach, given_radius)
    call move_alloc(round, contact)
    call give_contact(contact, destination, info)
  end subroutine solve_round

  !> Put a contact behind a handle at `destination`, unless the solve failed; FUGE_ERR_MEMORY.
  subroutine give_contact(contact, destination, info)
    class(punch_contact), allocatable, intent(inout) :: contact
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(punch_handle), pointer :: handle
    integer :: stat

    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the contact', info)
    if (stat /= 0) return
    handle%info = info
    call move_alloc(contact, handle%contact)
    call set_handle(c_loc(handle), destination)
  end subroutine give_contact

  !> A function of C as the profile from `lower` to `upper`.
  function callback_of(profile, user, lower, upper) result(punch)
    type(c_funptr), intent(in) :: profile
    type(c_ptr), intent(in) :: user
    real(dp), intent(in) :: lower, upper
    type(callback_profile) :: punch
    procedure(c_profile), pointer :: found

    punch%lower = lower
    punch%upper = upper
    punch%user = user
    call c_f_procpointer(profile, found)
    punch%profile => found
  end function callback_of

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

  subroutine c_punch_free(source) bind(c, name='fuge_punch_free')
    type(c_ptr), intent(in), value :: source
    type(punch_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    ! Apart, because flang 22 would leak what an extension has allocated.
    if (allocated(handle%contact)) deallocate (handle%contact)
    deallocate (handle)
  end subroutine c_punch_free

  function c_get_report(source, destination, message, length) bind(c, name='fuge_punch_get_report') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(punch_handle), pointer :: handle
    type(c_report), pointer :: summary
    type(fuge_info) :: info

    call find_punch(source, handle, info)
    call require_pointer(destination, 'report', info)
    if (.not. info%failed()) then
      call c_f_pointer(destination, summary)
      summary = report_of(handle)
    end if
    status = report_to_c(info, message, length)
  end function c_get_report

  !> A contact in the words of the header: a disc reaches from -radius to radius.
  pure function report_of(handle) result(summary)
    type(punch_handle), intent(in) :: handle
    type(c_report) :: summary

    summary = c_report()
    summary%iterations = int(handle%info%iterations, c_int)
    summary%coefficients = int(size(coefficients_of(handle%contact)), c_int)
    summary%approach = handle%contact%approach
    summary%residual = handle%info%residual
    summary%pressure_error = handle%contact%pressure_error
    select type (contact => handle%contact)
    type is (fuge_smooth_contact)
      summary%left = contact%ends(1)
      summary%right = contact%ends(2)
      summary%half_width = contact%half_width
      summary%force = contact%force
      summary%moment = contact%moment
      summary%tilt = contact%tilt
      summary%end_error = contact%end_error
    type is (fuge_round_contact)
      summary%left = -contact%radius
      summary%right = contact%radius
      summary%half_width = contact%radius
      summary%force = contact%load
      summary%end_error = contact%radius_error
    end select
  end function report_of

  !> Coefficients of the series of a contact; none without force.
  pure function coefficients_of(contact) result(coefficients)
    class(punch_contact), intent(in) :: contact
    real(dp), allocatable :: coefficients(:)

    select type (contact)
    type is (fuge_smooth_contact)
      if (allocated(contact%coefficients)) coefficients = contact%coefficients
    type is (fuge_round_contact)
      coefficients = contact%coefficients()
    end select
    if (.not. allocated(coefficients)) allocate (coefficients(0))
  end function coefficients_of

  function c_get_pressure(source, number, x, pressure, message, length) &
    bind(c, name='fuge_punch_get_pressure') result(status)
    type(c_ptr), intent(in), value :: source, x, pressure, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(punch_handle), pointer :: handle
    real(c_double), pointer :: places(:)
    type(fuge_info) :: info

    call find_punch(source, handle, info)
    call require_count(number, 0, 'count', 'places', info)
    call find_array(number, x, 'x', places, info)
    call require_pointer(pressure, 'pressure', info)
    if (.not. info%failed()) call check_finite(places, 'x', info)
    if (.not. info%failed()) call give(handle%contact%pressure(places), pressure)
    status = report_to_c(info, message, length)
  end function c_get_pressure

  function c_get_gap(source, number, x, initial_gap, gap, message, length) &
    bind(c, name='fuge_punch_get_gap') result(status)
    type(c_ptr), intent(in), value :: source, x, initial_gap, gap, message
    integer(c_int), intent(in), value :: number
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(punch_handle), pointer :: handle
    real(c_double), pointer :: places(:), initial(:)
    type(fuge_info) :: info

    call find_punch(source, handle, info)
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
    bind(c, name='fuge_punch_get_coefficients') result(status)
    type(c_ptr), intent(in), value :: source, coefficients, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(punch_handle), pointer :: handle
    real(dp), allocatable :: values(:)
    type(fuge_info) :: info

    call find_punch(source, handle, info)
    call require_count(capacity, 0, 'capacity', 'elements of coefficients', info)
    call require_pointer(coefficients, 'coefficients', info)
    if (.not. info%failed()) then
      values = coefficients_of(handle%contact)
      call give(values(:min(int(capacity), size(values))), coefficients)
    end if
    status = report_to_c(info, message, length)
  end function c_get_coefficients

  !> The contact behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_punch(source, handle, info)
    type(c_ptr), intent(in) :: source
    type(punch_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(source, 'contact', info)
    if (.not. info%failed()) call c_f_pointer(source, handle)
  end subroutine find_punch

end module fuge_c_punch
