!> C bindings, section "operators": products by a function of the caller.
module fuge_c_callback
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_funptr, c_size_t, c_f_pointer, &
    c_f_procpointer
  use fuge_c_operator, only: new_operator
  use fuge_c_types, only: operator_handle, report_to_c, require_count, require_pointer
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_UNSUPPORTED
  implicit none
  private

  abstract interface
    !> fuge_apply of fuge.h: `output` from `input`, both n long; nonzero is a failure.
    function c_apply(n, input, output, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: input(*)
      real(c_double), intent(inout) :: output(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_apply
  end interface

  type, extends(fuge_operator) :: callback_operator
    integer :: n = 0
    procedure(c_apply), pointer, nopass :: product => null()
    !> The preconditioner is one of these two, or there is none.
    procedure(c_apply), pointer, nopass :: inverse => null()
    real(dp), allocatable :: diagonal(:)
    type(c_ptr) :: user = c_null_ptr
  contains
    procedure :: points
    procedure :: apply
    procedure :: has_preconditioner
    procedure :: precondition
  end type callback_operator

contains

  function c_operator_callback(n, product, user, destination, message, length) &
    bind(c, name='fuge_operator_callback') result(status)
    integer(c_int), intent(in), value :: n
    type(c_funptr), intent(in), value :: product
    type(c_ptr), intent(in), value :: user, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), allocatable :: callback
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    call require_count(n, 1, 'n', 'contact points', info)
    call require_pointer(product, 'apply', info)
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) then
      allocate (callback)
      callback%n = int(n)
      callback%product => procedure_at(product)
      callback%user = user
      call move_alloc(callback, operator)
      call new_operator(operator, destination, info)
    end if
    status = report_to_c(info, message, length)
  end function c_operator_callback

  function c_set_preconditioner(operator, inverse, message, length) &
    bind(c, name='fuge_operator_set_preconditioner') result(status)
    type(c_ptr), intent(in), value :: operator, message
    type(c_funptr), intent(in), value :: inverse
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    type(fuge_info) :: info

    call find_callback(operator, callback, info)
    call require_pointer(inverse, 'preconditioner', info)
    if (.not. info%failed()) then
      callback%inverse => procedure_at(inverse)
      if (allocated(callback%diagonal)) deallocate (callback%diagonal)
    end if
    status = report_to_c(info, message, length)
  end function c_set_preconditioner

  function c_set_diagonal(operator, diagonal, message, length) &
    bind(c, name='fuge_operator_set_diagonal') result(status)
    type(c_ptr), intent(in), value :: operator, diagonal, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_operator), pointer :: callback
    real(c_double), pointer :: values(:)
    real(dp), allocatable :: copy(:)
    type(fuge_info) :: info
    integer :: stat

    call find_callback(operator, callback, info)
    call require_pointer(diagonal, 'diagonal', info)
    if (.not. info%failed()) then
      call c_f_pointer(diagonal, values, [callback%n])
      allocate (copy, source=values, stat=stat)
      if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of the diagonal')
    end if
    if (.not. info%failed()) call check_diagonal(copy, info)
    if (.not. info%failed()) then
      call move_alloc(copy, callback%diagonal)
      nullify (callback%inverse)
    end if
    status = report_to_c(info, message, length)
  end function c_set_diagonal

  pure subroutine check_diagonal(values, info)
    real(dp), intent(in) :: values(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_finite(values, 'diagonal', info)
    if (info%failed()) return
    do k = 1, size(values)
      ! One over a subnormal number may be infinite.
      if (values(k) >= tiny(values)) cycle
      call report(info, FUGE_ERR_NOT_DEFINITE, 'diagonal('//index_text(k)//') = '//text(values(k)) &
                  //' is not positive: a force moves its own point in its own direction')
      return
    end do
  end subroutine check_diagonal

  !> The callback operator behind a handle; FUGE_ERR_POINTER, FUGE_ERR_UNSUPPORTED for another.
  subroutine find_callback(operator, callback, info)
    type(c_ptr), intent(in) :: operator
    type(callback_operator), pointer, intent(out) :: callback
    type(fuge_info), intent(inout) :: info
    type(operator_handle), pointer :: handle

    nullify (callback)
    call require_pointer(operator, 'op', info)
    if (info%failed()) return
    call c_f_pointer(operator, handle)
    select type (known => handle%operator)
    type is (callback_operator)
      callback => known
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'only an operator of fuge_operator_callback takes a preconditioner: a ' &
                  //'matrix needs none, and fuge_operator_halfplane has its own')
    end select
  end subroutine find_callback

  function procedure_at(address) result(found)
    type(c_funptr), intent(in) :: address
    procedure(c_apply), pointer :: found

    call c_f_procpointer(address, found)
  end function procedure_at

  pure function points(self) result(n)
    class(callback_operator), intent(in) :: self
    integer :: n

    n = self%n
  end function points

  subroutine apply(self, force, displacement, status)
    class(callback_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call call_back(self%product, force, displacement, self%user, status)
  end subroutine apply

  function has_preconditioner(self) result(preconditioned)
    class(callback_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = associated(self%inverse) .or. allocated(self%diagonal)
  end function has_preconditioner

  subroutine precondition(self, displacement, force, status)
    class(callback_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    if (allocated(self%diagonal)) then
      force = displacement/self%diagonal
      status = FUGE_DONE
    else
      call call_back(self%inverse, displacement, force, self%user, status)
    end if
  end subroutine precondition

  !> The callback gets a copy, so that one which writes to its input harms nobody. The output starts
  !> as NaN, so that `fuge_operator_products` sees a value that the callback forgets.
  !> `status`: what C returned if that is positive, FUGE_ERR_CALLBACK if it is negative
  !> and would be taken for a code of this library.
  subroutine call_back(callback, input, output, user, status)
    procedure(c_apply), pointer, intent(in) :: callback
    real(dp), intent(in) :: input(:)
    real(dp), intent(out) :: output(:)
    type(c_ptr), intent(in) :: user
    integer, intent(out) :: status
    real(c_double), allocatable :: copy(:)
    integer :: stat

    output = ieee_value(output, ieee_quiet_nan)
    allocate (copy, source=input, stat=stat)
    if (stat /= 0) then
      status = FUGE_ERR_MEMORY
      return
    end if
    status = int(callback(int(size(copy), c_int), copy, output, user))
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine call_back

end module fuge_c_callback
