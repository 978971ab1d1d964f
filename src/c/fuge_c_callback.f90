!> C bindings, section "operators": products by a function of the caller.
module fuge_c_callback
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_funptr, c_associated, c_f_pointer, &
    c_f_procpointer
  use fuge_c_operator, only: hand_over
  use fuge_c_types, only: operator_handle
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED, FUGE_ERR_CALLBACK
  implicit none
  private

  abstract interface
    !> fuge_apply of fuge.h: `made` from `given`, both n long; nonzero is a failure.
    function c_apply(n, given, made, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: given(*)
      real(c_double), intent(inout) :: made(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_apply
  end interface

  type, extends(fuge_operator) :: callback_operator
    integer :: n = 0
    procedure(c_apply), pointer, nopass :: product => null()
    !> One of these two, or none, makes the preconditioner.
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

  function c_operator_callback(n, product, user, destination) bind(c, name='fuge_operator_callback') result(status)
    integer(c_int), intent(in), value :: n
    type(c_funptr), intent(in), value :: product
    type(c_ptr), intent(in), value :: user, destination
    integer(c_int) :: status
    type(callback_operator), allocatable :: callback
    class(fuge_operator), allocatable :: operator

    if (n < 1) then
      status = FUGE_ERR_SIZE
    else if (.not. (c_associated(product) .and. c_associated(destination))) then
      status = FUGE_ERR_POINTER
    else
      allocate (callback)
      callback%n = int(n)
      callback%product => procedure_at(product)
      callback%user = user
      call move_alloc(callback, operator)
      status = hand_over(operator, destination)
    end if
  end function c_operator_callback

  function c_set_preconditioner(operator, inverse) bind(c, name='fuge_operator_set_preconditioner') result(status)
    type(c_ptr), intent(in), value :: operator
    type(c_funptr), intent(in), value :: inverse
    integer(c_int) :: status
    type(callback_operator), pointer :: found

    call take_callback(operator, found, status)
    if (status == FUGE_DONE .and. .not. c_associated(inverse)) status = FUGE_ERR_POINTER
    if (status /= FUGE_DONE) return
    found%inverse => procedure_at(inverse)
    if (allocated(found%diagonal)) deallocate (found%diagonal)
  end function c_set_preconditioner

  function c_set_diagonal(operator, diagonal) bind(c, name='fuge_operator_set_diagonal') result(status)
    type(c_ptr), intent(in), value :: operator, diagonal
    integer(c_int) :: status
    type(callback_operator), pointer :: found
    real(c_double), pointer :: values(:)
    real(dp), allocatable :: copy(:)
    integer :: stat

    call take_callback(operator, found, status)
    if (status == FUGE_DONE .and. .not. c_associated(diagonal)) status = FUGE_ERR_POINTER
    if (status /= FUGE_DONE) return
    call c_f_pointer(diagonal, values, [found%n])
    status = int(status_of_diagonal(values), c_int)
    if (status /= FUGE_DONE) return
    allocate (copy, source=values, stat=stat)
    if (stat /= 0) then
      status = FUGE_ERR_MEMORY
      return
    end if
    call move_alloc(copy, found%diagonal)
    nullify (found%inverse)
  end function c_set_diagonal

  pure function status_of_diagonal(values) result(status)
    real(dp), intent(in) :: values(:)
    integer :: status
    type(fuge_info) :: info

    call check_finite(values, 'diagonal', info)
    status = info%status
    ! One over a subnormal number may be infinite.
    if (status == FUGE_DONE .and. any(values < tiny(values))) status = FUGE_ERR_NOT_DEFINITE
  end function status_of_diagonal

  !> The callback operator behind a handle; FUGE_ERR_POINTER, FUGE_ERR_UNSUPPORTED for another.
  subroutine take_callback(operator, found, status)
    type(c_ptr), intent(in) :: operator
    type(callback_operator), pointer, intent(out) :: found
    integer(c_int), intent(out) :: status
    type(operator_handle), pointer :: handle

    nullify (found)
    status = FUGE_ERR_POINTER
    if (.not. c_associated(operator)) return
    call c_f_pointer(operator, handle)
    status = FUGE_ERR_UNSUPPORTED
    select type (known => handle%operator)
    type is (callback_operator)
      found => known
      status = FUGE_DONE
    end select
  end subroutine take_callback

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

  !> A copy is given away, so that a callback which writes to it harms nobody, and the
  !> result starts as NaN, so that a value it forgets is seen by `fuge_operator_products`.
  !> `status`: what C returned if that is positive, FUGE_ERR_CALLBACK if it is negative
  !> and would be taken for a code of this library.
  subroutine call_back(callback, given, made, user, status)
    procedure(c_apply), pointer, intent(in) :: callback
    real(dp), intent(in) :: given(:)
    real(dp), intent(out) :: made(:)
    type(c_ptr), intent(in) :: user
    integer, intent(out) :: status
    real(c_double), allocatable :: copy(:)
    integer :: stat

    made = ieee_value(made, ieee_quiet_nan)
    allocate (copy, source=given, stat=stat)
    if (stat /= 0) then
      status = FUGE_ERR_MEMORY
      return
    end if
    status = int(callback(int(size(copy), c_int), copy, made, user))
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine call_back

end module fuge_c_callback
