!> What all C bindings share: structs, handles, strings, arrays, and the messages.
module fuge_c_types
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_funptr, c_null_char, c_null_ptr, c_ptr, c_size_t, &
    c_associated, c_f_pointer
  use fuge_c_monitor, only: c_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, message_counting_from, report, FUGE_ERR_FILE, FUGE_ERR_POINTER, &
    FUGE_ERR_SIZE, FUGE_MESSAGE_LENGTH
  implicit none
  private

  public :: from_c, to_c, copy_string, copy_reals, copy_integers, from_c_string, from_zero
  public :: message_for_c, report_to_c, require_columns, require_count, require_path, require_pointer, set_handle, &
    take_handle

  !> struct fuge_options.
  type, bind(c), public :: c_options
    integer(c_int) :: method, pivot_rule, max_iterations, keep_history
    integer(c_int) :: reserved_int(4)
    real(c_double) :: tolerance
    real(c_double) :: reserved(7)
  end type c_options

  !> struct fuge_info.
  type, bind(c), public :: c_info
    integer(c_int) :: status, iterations, contacts, products, preconditionings
    integer(c_int) :: reserved_int(3)
    real(c_double) :: residual, force_error
    real(c_double) :: reserved(6)
  end type c_info

  !> Behind struct fuge_operator.
  type, public :: operator_handle
    class(fuge_operator), allocatable :: operator
  end type operator_handle

  !> Behind struct fuge_solver.
  type, public :: solver_handle
    type(operator_handle), pointer :: operator => null()
    type(fuge_options) :: options
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(c_monitor) :: monitor
    !> Report of the last solve.
    type(fuge_info) :: info
    !> Message of the last call that set, solved or failed.
    character(len=FUGE_MESSAGE_LENGTH) :: message = ''
    !> The solution belongs to the present problem.
    logical :: solved = .false.
    !> A solve has been tried, so that `info` means something.
    logical :: tried = .false.
  end type solver_handle

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

  pure function from_c(source) result(options)
    type(c_options), intent(in) :: source
    type(fuge_options) :: options

    options%method = int(source%method)
    options%pivot_rule = int(source%pivot_rule)
    options%max_iterations = int(source%max_iterations)
    options%keep_history = source%keep_history /= 0
    options%tolerance = source%tolerance
  end function from_c

  pure function to_c(source) result(info)
    type(fuge_info), intent(in) :: source
    type(c_info) :: info

    info%status = int(source%status, c_int)
    info%iterations = int(source%iterations, c_int)
    info%contacts = int(source%contacts, c_int)
    info%products = int(source%products, c_int)
    info%preconditionings = int(source%preconditionings, c_int)
    info%residual = source%residual
    info%force_error = source%force_error
    info%reserved_int = 0
    info%reserved = 0.0_c_double
  end function to_c

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

  !> Fill an array of C; NULL is left alone.
  subroutine copy_reals(values, destination)
    real(c_double), intent(in) :: values(:)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: array(:)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, [size(values)])
    array = values
  end subroutine copy_reals

  !> Copy to a C array of int; NULL is left alone.
  subroutine copy_integers(values, destination)
    integer, intent(in) :: values(:)
    type(c_ptr), intent(in) :: destination
    integer(c_int), pointer :: array(:)

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, array, [size(values)])
    array = int(values, c_int)
  end subroutine copy_integers

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
