!> C bindings, section "operators": products by a function of the caller. What the library may know of the
!> operator beside its products, a grid above all, is set by `fuge_c_callback_grid`.
module fuge_c_callback
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_funptr, c_size_t, &
    c_f_procpointer
  use fuge_c_arrays, only: find_array
  use fuge_c_operator, only: find_operator, new_operator, operator_handle
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_UNSUPPORTED
  implicit none
  private

  public :: find_callback

  abstract interface
    !> fuge_apply of fuge_core.h: `output` from `input`, both n long; nonzero is a failure.
    function c_apply(n, input, output, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: input(*)
      real(c_double), intent(inout) :: output(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_apply
  end interface

  type, extends(fuge_operator), public :: callback_operator
    integer :: n = 0
    procedure(c_apply), pointer, nopass :: product => null()
    !> The preconditioner is one of these two, else that of `auxiliary`, or there is none.
    procedure(c_apply), pointer, nopass :: inverse => null()
    real(dp), allocatable :: diagonal(:)
    type(c_ptr) :: user = c_null_ptr
    !> The constant that the product leaves out of all coefficients, and the mean magnitude of the others; 0 if unknown.
    real(dp) :: left_out = 0.0_dp, mean_term = 0.0_dp
    !> Cells in each direction of the grid that the points are; 0 if they are none.
    integer :: cells(2) = 0
    !> The caller's operators of the cells twice as wide, and of the same cells on a similar body. The first makes
    !> the coarser grids if it is there, else the second does.
    type(operator_handle), pointer :: coarser => null(), auxiliary => null()
  contains
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => callback_magnitude
    procedure :: has_preconditioner
    procedure :: precondition
    procedure :: extends_sets
    procedure :: grid
    procedure :: free_rim
    procedure :: coarsen
    procedure :: kept_coarser
    procedure :: window
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

    call find_callback(operator, 'a preconditioner', callback, info)
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

    call find_callback(operator, 'a preconditioner', callback, info)
    if (.not. info%failed()) call find_array(callback%n, diagonal, 'diagonal', values, info)
    if (.not. info%failed()) then
      allocate (copy, source=values, stat=stat)
      call require_memory(stat, 'a copy of the diagonal', info)
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

  !> The callback operator behind a handle; FUGE_ERR_POINTER, FUGE_ERR_UNSUPPORTED for another. `what` it is to get.
  subroutine find_callback(operator, what, callback, info)
    type(c_ptr), intent(in) :: operator
    character(len=*), intent(in) :: what
    type(callback_operator), pointer, intent(out) :: callback
    type(fuge_info), intent(inout) :: info
    type(operator_handle), pointer :: handle

    nullify (callback)
    call find_operator(operator, 'op', handle, info)
    if (info%failed()) return
    select type (known => handle%operator)
    type is (callback_operator)
      callback => known
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'only an operator of fuge_operator_callback takes '//what//': a ' &
                  //'matrix needs none, and those of grids have their own')
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

  function datum(self)
    class(callback_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%left_out
  end function datum

  !> The largest displacement, or what the auxiliary operator knows; at least the mean of the terms.
  subroutine callback_magnitude(self, force, displacement, magnitude)
    class(callback_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    if (associated(self%auxiliary)) then
      call self%auxiliary%operator%magnitude(force, displacement, magnitude)
    else
      magnitude = maxval(abs(displacement))
    end if
    if (self%mean_term > 0.0_dp) magnitude = max(magnitude, self%mean_term*sum(abs(force)))
  end subroutine callback_magnitude

  function has_preconditioner(self) result(preconditioned)
    class(callback_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = associated(self%inverse) .or. allocated(self%diagonal) .or. associated(self%auxiliary)
  end function has_preconditioner

  subroutine precondition(self, displacement, force, status)
    class(callback_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    if (allocated(self%diagonal)) then
      force = displacement/self%diagonal
      status = FUGE_DONE
    else if (associated(self%inverse)) then
      call call_back(self%inverse, displacement, force, self%user, status)
    else
      call self%auxiliary%operator%precondition(displacement, force, status)
    end if
  end subroutine precondition

  !> On the cells of an area, unless the preconditioner is a diagonal, which takes each displacement for itself.
  function extends_sets(self) result(extends)
    class(callback_operator), intent(in) :: self
    logical :: extends

    extends = all(self%cells > 1) .and. .not. allocated(self%diagonal)
  end function extends_sets

  function grid(self) result(cells)
    class(callback_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%cells
  end function grid

  function free_rim(self) result(free)
    class(callback_operator), intent(in) :: self
    logical :: free(2)

    free = .false.
    if (associated(self%auxiliary)) free = self%auxiliary%operator%free_rim()
  end function free_rim

  !> None: those of the caller are kept.
  subroutine coarsen(self, levels, coarse)
    class(callback_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse

    if (associated(self%coarser) .or. .not. associated(self%auxiliary)) return
    call self%auxiliary%operator%coarsen(levels, coarse)
  end subroutine coarsen

  !> Each coarser operator of the caller knows the next one. There is no end of them only if two had the same cells,
  !> which `fuge_operator_set_coarser` refuses.
  recursive subroutine kept_coarser(self, levels, coarse)
    class(callback_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), pointer, intent(out) :: coarse

    nullify (coarse)
    if (levels < 1) return
    if (associated(self%coarser) .and. levels == 1) then
      coarse => self%coarser%operator
    else if (associated(self%coarser)) then
      call self%coarser%operator%kept_coarser(levels - 1, coarse)
    else if (associated(self%auxiliary)) then
      call self%auxiliary%operator%kept_coarser(levels, coarse)
    end if
  end subroutine kept_coarser

  !> A window of the auxiliary operator: its forces are only the start on the whole grid.
  subroutine window(self, first, last, part)
    class(callback_operator), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part

    if (associated(self%auxiliary)) call self%auxiliary%operator%window(first, last, part)
  end subroutine window

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
