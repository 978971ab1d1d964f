!> C bindings, sections "solves to a wanted error" and "resolved contacts".
module fuge_c_accuracy
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_positive_inf, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_double, c_ptr, c_size_t, c_null_char, c_null_ptr, c_funptr, &
    c_loc, c_associated, c_f_pointer, c_f_procpointer
  use fuge_area_accuracy, only: fuge_solve_area
  use fuge_c_arrays, only: find_array, give
  use fuge_c_layers, only: find_layers
  use fuge_c_types, only: report_to_c, require_pointer, set_handle, take_handle
  use fuge_gap_function_type, only: fuge_gap_function
  use fuge_kinds, only: dp
  use fuge_line_accuracy, only: fuge_solve_line
  use fuge_pressing_type, only: fuge_pressing
  use fuge_resolved_contact_type, only: fuge_resolved_contact
  use fuge_status, only: fuge_info, require_memory, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY
  implicit none
  private

  abstract interface
    !> fuge_gap_function of fuge_accuracy.h.
    function c_gap_function(n, x, y, gap, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: x(*), y(*)
      real(c_double), intent(inout) :: gap(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_gap_function
  end interface

  !> A gap that is a function of C.
  type, extends(fuge_gap_function) :: callback_gap
    procedure(c_gap_function), pointer, nopass :: callback => null()
    type(c_ptr) :: user = c_null_ptr
  contains
    procedure :: evaluate
  end type callback_gap

  !> Behind struct fuge_resolved.
  type :: resolved_handle
    type(fuge_resolved_contact) :: contact
  end type resolved_handle

  !> struct fuge_pressing.
  type, bind(c) :: c_pressing
    integer(c_int) :: boundary, most_cells, threads, layers, bonded
    integer(c_int) :: reserved_int(3)
    real(c_double) :: e_star, accuracy, most_seconds, e_star_other
    type(c_ptr) :: load, approach, moment, thickness, young, poisson
    real(c_double) :: reserved(8)
  end type c_pressing

  !> Characters of the sentence in a report, its NUL included.
  integer, parameter :: CHOICE_LENGTH = 256

  !> struct fuge_resolved_report.
  type, bind(c) :: c_report
    integer(c_int) :: nx = 0, ny = 0, levels = 0, intervals = 0, method = 0
    integer(c_int) :: at_rim(4) = 0
    integer(c_int) :: reserved_int(7) = 0
    real(c_double) :: load = 0.0_dp, approach = 0.0_dp, tilt = 0.0_dp, largest = 0.0_dp, size = 0.0_dp
    real(c_double) :: pressure_error = 0.0_dp, approach_error = 0.0_dp, largest_error = 0.0_dp, edge_error = 0.0_dp, &
      size_error = 0.0_dp
    real(c_double) :: reserved(6) = 0.0_dp
    character(kind=c_char) :: choice(CHOICE_LENGTH) = c_null_char
  end type c_report

contains

  function c_solve_line(gap, user, left, right, pressing, destination, message, length) &
    bind(c, name='fuge_solve_line') result(status)
    type(c_funptr), intent(in), value :: gap
    type(c_ptr), intent(in), value :: user, pressing, destination, message
    real(c_double), intent(in), value :: left, right
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_gap) :: initial
    type(fuge_pressing) :: given
    type(resolved_handle), pointer :: handle
    type(fuge_info) :: info

    call prepare(gap, user, pressing, destination, initial, given, handle, info)
    if (.not. info%failed()) call fuge_solve_line(initial, left, right, given, handle%contact, info)
    call give_contact(handle, destination, info)
    status = report_to_c(info, message, length)
  end function c_solve_line

  function c_solve_area(gap, user, lower, upper, pressing, destination, message, length) &
    bind(c, name='fuge_solve_area') result(status)
    type(c_funptr), intent(in), value :: gap
    type(c_ptr), intent(in), value :: user, lower, upper, pressing, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: low(:), high(:)
    type(callback_gap) :: initial
    type(fuge_pressing) :: given
    type(resolved_handle), pointer :: handle
    type(fuge_info) :: info

    call find_array(2_c_int, lower, 'lower', low, info)
    call find_array(2_c_int, upper, 'upper', high, info)
    call prepare(gap, user, pressing, destination, initial, given, handle, info)
    if (.not. info%failed()) call fuge_solve_area(initial, low, high, given, handle%contact, info)
    call give_contact(handle, destination, info)
    status = report_to_c(info, message, length)
  end function c_solve_area

  !> What both solves are given, and a new handle for what they find, null after an error. Eight arguments: those of C
  !> and what they become.
  subroutine prepare(gap, user, source, destination, initial, pressing, handle, info)
    type(c_funptr), intent(in) :: gap
    type(c_ptr), intent(in) :: user, source, destination
    type(callback_gap), intent(inout) :: initial
    type(fuge_pressing), intent(inout) :: pressing
    type(resolved_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info
    procedure(c_gap_function), pointer :: found
    integer :: stat

    nullify (handle)
    call require_pointer(gap, 'gap', info)
    call require_pointer(source, 'pressing', info)
    call require_pointer(destination, 'contact', info)
    if (info%failed()) return
    initial%user = user
    call c_f_procpointer(gap, found)
    initial%callback => found
    call read_pressing(source, pressing, info)
    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the contact', info)
  end subroutine prepare

  !> The struct fuge_pressing at an address that is not NULL. Its zeros are the defaults of the type.
  subroutine read_pressing(address, pressing, info)
    type(c_ptr), intent(in) :: address
    type(fuge_pressing), intent(inout) :: pressing
    type(fuge_info), intent(inout) :: info
    type(c_pressing), pointer :: source
    real(c_double) :: other

    call c_f_pointer(address, source)
    pressing%e_star = source%e_star
    call read_number(source%load, pressing%load)
    call read_number(source%approach, pressing%approach)
    call read_number(source%moment, pressing%moment)
    pressing%boundary = int(source%boundary)
    if (.not. is_zero(source%accuracy)) pressing%accuracy = source%accuracy
    pressing%most_cells = int(source%most_cells)
    if (.not. is_zero(source%most_seconds)) pressing%most_seconds = source%most_seconds
    pressing%threads = int(source%threads)
    if (source%layers == 0 .and. .not. c_associated(source%young)) return
    other = source%e_star_other
    if (is_zero(other)) other = ieee_value(other, ieee_positive_inf)
    allocate (pressing%layers)
    call find_layers(source%layers, source%thickness, source%young, source%poisson, source%bonded, other, &
                     pressing%layers, info)
  end subroutine read_pressing

  !> The number at an address; not allocated for NULL.
  subroutine read_number(address, number)
    type(c_ptr), intent(in) :: address
    real(dp), allocatable, intent(inout) :: number
    real(c_double), pointer :: value

    if (.not. c_associated(address)) return
    call c_f_pointer(address, value)
    number = value
  end subroutine read_number

  !> Is a member of a struct left at zero? Comparisons of NaN might trap.
  elemental logical function is_zero(number)
    real(c_double), intent(in) :: number

    is_zero = .false.
    if (.not. ieee_is_nan(number)) is_zero = abs(number) <= 0.0_c_double
  end function is_zero

  !> Give the handle to the caller, or after an error free it.
  subroutine give_contact(handle, destination, info)
    type(resolved_handle), pointer, intent(inout) :: handle
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(in) :: info

    if (.not. info%failed()) then
      call set_handle(c_loc(handle), destination)
    else if (associated(handle)) then
      deallocate (handle)
    end if
  end subroutine give_contact

  !> The callback gets copies, so that one which writes to x or y harms nobody; its results start as NaN, so that a
  !> value that it forgets is seen.
  subroutine evaluate(self, x, y, gap, status)
    class(callback_gap), intent(in) :: self
    real(dp), intent(in) :: x(:), y(:)
    real(dp), intent(out) :: gap(:)
    integer, intent(out) :: status
    real(c_double), allocatable :: values(:, :)
    integer :: stat

    allocate (values(size(x), 3), stat=stat)
    if (stat /= 0) then
      gap = 0.0_dp
      status = FUGE_ERR_MEMORY
      return
    end if
    values(:, 1) = x
    values(:, 2) = y
    values(:, 3) = ieee_value(0.0_dp, ieee_quiet_nan)
    status = int(self%callback(int(size(x), c_int), values(:, 1), values(:, 2), values(:, 3), self%user))
    gap = values(:, 3)
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine evaluate

  subroutine c_resolved_free(source) bind(c, name='fuge_resolved_free')
    type(c_ptr), intent(in), value :: source
    type(resolved_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_resolved_free

  function c_get_report(source, destination, message, length) bind(c, name='fuge_resolved_get_report') result(status)
    type(c_ptr), intent(in), value :: source, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(resolved_handle), pointer :: handle
    type(c_report), pointer :: summary
    type(fuge_info) :: info

    call find_resolved(source, handle, info)
    call require_pointer(destination, 'report', info)
    if (.not. info%failed()) then
      call c_f_pointer(destination, summary)
      summary = report_of(handle%contact)
    end if
    status = report_to_c(info, message, length)
  end function c_get_report

  !> A contact in the words of the header.
  pure function report_of(contact) result(summary)
    type(fuge_resolved_contact), intent(in) :: contact
    type(c_report) :: summary
    integer :: k

    summary = c_report()
    summary%nx = int(size(contact%x), c_int)
    summary%ny = int(size(contact%y), c_int)
    summary%levels = int(size(contact%levels), c_int)
    if (allocated(contact%edges)) summary%intervals = int(size(contact%edges, 2), c_int)
    summary%method = int(contact%method, c_int)
    summary%at_rim = merge(1_c_int, 0_c_int, contact%at_rim)
    summary%load = contact%load
    summary%approach = contact%approach
    summary%tilt = contact%tilt
    summary%largest = contact%largest
    summary%size = contact%size
    summary%pressure_error = contact%pressure_error
    summary%approach_error = contact%approach_error
    summary%largest_error = contact%largest_error
    summary%edge_error = contact%edge_error
    summary%size_error = contact%size_error
    if (.not. allocated(contact%choice)) return
    do k = 1, min(len_trim(contact%choice), CHOICE_LENGTH - 1)
      summary%choice(k) = contact%choice(k:k)
    end do
  end function report_of

  !> Ten arguments, as in the header: the contact, its arrays, the message.
  function c_get_cells(source, x, width_x, y, width_y, force, gap, edges, message, length) &
    bind(c, name='fuge_resolved_get_cells') result(status)
    type(c_ptr), intent(in), value :: source, x, width_x, y, width_y, force, gap, edges, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(resolved_handle), pointer :: handle
    type(fuge_info) :: info

    call find_resolved(source, handle, info)
    if (.not. info%failed()) then
      call give(handle%contact%x, x)
      call give(handle%contact%width_x, width_x)
      call give(handle%contact%y, y)
      call give(handle%contact%width_y, width_y)
      call give(handle%contact%force, force)
      call give(handle%contact%gap, gap)
      if (allocated(handle%contact%edges)) call give(handle%contact%edges, edges)
    end if
    status = report_to_c(info, message, length)
  end function c_get_cells

  function c_get_levels(source, cells, method, pressure_error, approach_error, seconds, message, length) &
    bind(c, name='fuge_resolved_get_levels') result(status)
    type(c_ptr), intent(in), value :: source, cells, method, pressure_error, approach_error, seconds, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(resolved_handle), pointer :: handle
    type(fuge_info) :: info

    call find_resolved(source, handle, info)
    if (.not. info%failed()) then
      call give(handle%contact%levels%cells, cells)
      call give(handle%contact%levels%method, method)
      call give(handle%contact%levels%pressure_error, pressure_error)
      call give(handle%contact%levels%approach_error, approach_error)
      call give(handle%contact%levels%seconds, seconds)
    end if
    status = report_to_c(info, message, length)
  end function c_get_levels

  !> The contact behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_resolved(source, handle, info)
    type(c_ptr), intent(in) :: source
    type(resolved_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(source, 'contact', info)
    if (.not. info%failed()) call c_f_pointer(source, handle)
  end subroutine find_resolved

end module fuge_c_accuracy
