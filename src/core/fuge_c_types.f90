!> What all C bindings share: structs, handles, strings, and the messages.
module fuge_c_types
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_funptr, c_null_char, c_null_ptr, c_ptr, c_size_t, &
    c_associated, c_f_pointer
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_status, only: fuge_info, message_counting_from, report, FUGE_DONE, FUGE_ERR_FILE, &
    FUGE_ERR_POINTER, FUGE_ERR_SIZE, FUGE_MESSAGE_LENGTH
  implicit none
  private

  public :: copy_string, from_c_string, from_zero, give_info, options_at
  public :: give_message, report_failure, report_to_c, report_to_handle, set_handle, take_handle
  public :: require_columns, require_count, require_path, require_pointer

  !> struct fuge_options.
  type, bind(c), public :: c_options
    integer(c_int) :: method, pivot_rule, max_iterations, keep_history, threads
    integer(c_int) :: reserved_int(3)
    real(c_double) :: tolerance
    real(c_double) :: reserved(7)
  end type c_options

  !> struct fuge_info.
  type, bind(c) :: c_info
    integer(c_int) :: status, iterations, contacts, products, preconditionings
    integer(c_int) :: reserved_int(3)
    real(c_double) :: residual, force_error, energy
    real(c_double) :: reserved(5)
  end type c_info

  !> A handle of C that keeps a message. Handles are allocated and freed by their own types, because the address of a
  !> polymorphic object has no meaning in C.
  type, abstract, public :: reporting_handle
    !> Message of the last call that set data, did the work, or failed.
    character(len=FUGE_MESSAGE_LENGTH) :: message = ''
  end type reporting_handle

  !> Refuse NULL (FUGE_ERR_POINTER), unless an error is known already.
  interface require_pointer
    module procedure require_address
    module procedure require_function
  end interface require_pointer

  interface
    pure function c_strlen(string) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), intent(in), value :: string
      integer(c_size_t) :: length
    end function c_strlen
  end interface

contains

  !> The options in a struct of C, the defaults if there is none.
  function options_at(address) result(options)
    type(c_ptr), intent(in) :: address
    type(fuge_options) :: options
    type(c_options), pointer :: source

    if (.not. c_associated(address)) return
    call c_f_pointer(address, source)
    options%method = int(source%method)
    options%pivot_rule = int(source%pivot_rule)
    options%max_iterations = int(source%max_iterations)
    options%keep_history = source%keep_history /= 0
    options%threads = int(source%threads)
    options%tolerance = source%tolerance
  end function options_at

  !> Fill the struct of C behind `destination`, which is not NULL.
  subroutine give_info(info, destination)
    type(fuge_info), intent(in) :: info
    type(c_ptr), intent(in) :: destination
    type(c_info), pointer :: copy

    call c_f_pointer(destination, copy)
    copy%status = int(info%status, c_int)
    copy%iterations = int(info%iterations, c_int)
    copy%contacts = int(info%contacts, c_int)
    copy%products = int(info%products, c_int)
    copy%preconditionings = int(info%preconditionings, c_int)
    copy%residual = info%residual
    copy%force_error = info%force_error
    copy%energy = info%energy
    copy%reserved_int = 0
    copy%reserved = 0.0_c_double
  end subroutine give_info

  !> The message as C counts: indices from 0.
  pure function message_for_c(info) result(message)
    type(fuge_info), intent(in) :: info
    character(len=FUGE_MESSAGE_LENGTH) :: message

    message = message_counting_from(0, info)
  end function message_for_c

  !> Leave the message in the buffer of a caller; the status to return.
  function report_to_c(info, buffer, length) result(status)
    type(fuge_info), intent(in) :: info
    type(c_ptr), intent(in) :: buffer
    integer(c_size_t), intent(in) :: length
    integer(c_int) :: status

    call copy_string(message_for_c(info), buffer, length)
    status = int(info%status, c_int)
  end function report_to_c

  !> Keep the message in the handle, unless that is a null pointer and so absent; the status to return.
  function report_to_handle(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    class(reporting_handle), intent(inout), optional :: handle
    integer(c_int) :: status

    if (present(handle)) handle%message = message_for_c(info)
    status = int(info%status, c_int)
  end function report_to_handle

  !> As `report_to_handle` for a getter: one that succeeds leaves the message as it is, which may be a warning.
  function report_failure(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    class(reporting_handle), intent(inout), optional :: handle
    integer(c_int) :: status

    status = FUGE_DONE
    if (info%failed()) status = report_to_handle(info, handle)
  end function report_failure

  !> Copy the message of a handle, absent after an error, to the buffer of a caller, which may not be NULL; the status
  !> to return.
  function give_message(info, handle, buffer, length) result(status)
    type(fuge_info), intent(inout) :: info
    class(reporting_handle), intent(in), optional :: handle
    type(c_ptr), intent(in) :: buffer
    integer(c_size_t), intent(in) :: length
    integer(c_int) :: status

    call require_pointer(buffer, 'message', info)
    if (.not. info%failed()) call copy_string(handle%message, buffer, length)
    status = int(info%status, c_int)
  end function give_message

  pure subroutine require_address(address, name, info)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (.not. c_associated(address)) call report(info, FUGE_ERR_POINTER, name//' is NULL')
  end subroutine require_address

  pure subroutine require_function(address, name, info)
    type(c_funptr), intent(in) :: address
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (.not. c_associated(address)) call report(info, FUGE_ERR_POINTER, name//' is NULL')
  end subroutine require_function

  !> Refuse a number of elements below `least` (FUGE_ERR_SIZE), unless an error is known already.
  pure subroutine require_count(number, least, name, meaning, info)
    integer(c_int), intent(in) :: number
    integer, intent(in) :: least
    character(len=*), intent(in) :: name, meaning
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. number >= least) return
    call report(info, FUGE_ERR_SIZE, name//' = '//text(int(number))//', the number of '//meaning//', has to be ' &
                //text(least)//' or more')
  end subroutine require_count

  !> Refuse a number of compressed columns whose array of beginnings, one more, has more elements than
  !> an integer counts (FUGE_ERR_SIZE), unless an error is known already.
  pure subroutine require_columns(number, name, info)
    integer(c_int), intent(in) :: number
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. number < huge(number)) return
    call report(info, FUGE_ERR_SIZE, name//' = '//text(int(number))//' is too large: there can be '//text(huge(1) - 1) &
                //' columns')
  end subroutine require_columns

  !> Give a new handle to the caller: *destination = address.
  subroutine set_handle(address, destination)
    type(c_ptr), intent(in) :: address, destination
    type(c_ptr), pointer :: handle

    call c_f_pointer(destination, handle)
    handle = address
  end subroutine set_handle

  !> Take a handle from the caller, to free what is behind it: *source becomes NULL. NULL if there
  !> is none, or `source` itself is NULL.
  function take_handle(source) result(address)
    type(c_ptr), intent(in) :: source
    type(c_ptr) :: address
    type(c_ptr), pointer :: handle

    address = c_null_ptr
    if (.not. c_associated(source)) return
    call c_f_pointer(source, handle)
    address = handle
    handle = c_null_ptr
  end function take_handle

  !> Copy a message into a C buffer of `length` bytes: cut if need be, always
  !> ended by NUL. A NULL buffer or length 0 is left alone. In C the length has no sign: one that is
  !> negative here is more than any message needs.
  subroutine copy_string(message, buffer, length)
    character(len=*), intent(in) :: message
    type(c_ptr), intent(in) :: buffer
    integer(c_size_t), intent(in) :: length
    character(kind=c_char), pointer :: bytes(:)
    integer :: k, last

    if (.not. c_associated(buffer) .or. length == 0) return
    last = len_trim(message)
    if (length > 0) last = int(min(int(last, c_size_t), length - 1))
    call c_f_pointer(buffer, bytes, [last + 1])
    do k = 1, last
      bytes(k) = message(k:k)
    end do
    bytes(last + 1) = c_null_char
  end subroutine copy_string

  !> Refuse NULL and a path that ends in a blank, which Fortran would take for another file.
  subroutine require_path(path, info)
    type(c_ptr), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    call require_pointer(path, 'path', info)
    if (.not. info%failed()) call refuse_last_blank(from_c_string(path), info)
  end subroutine require_path

  pure subroutine refuse_last_blank(path, info)
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    if (len_trim(path) == 0 .or. len_trim(path) == len(path)) return
    call report(info, FUGE_ERR_FILE, 'the path "'//path//'" ends in a blank: choose a path without it')
  end subroutine refuse_last_blank

  !> A string of C, ended by NUL.
  function from_c_string(source) result(string)
    type(c_ptr), intent(in) :: source
    character(len=c_strlen(source)) :: string
    character(kind=c_char), pointer :: bytes(:)
    integer :: k

    call c_f_pointer(source, bytes, [len(string)])
    do k = 1, len(string)
      string(k:k) = bytes(k)
    end do
  end function from_c_string

  !> Degrees of freedom counted from 0 as Fortran counts them; too large ones stay so.
  elemental function from_zero(number) result(dof)
    integer(c_int), intent(in) :: number
    integer :: dof

    dof = min(int(number), huge(dof) - 1) + 1
  end function from_zero

end module fuge_c_types
