!> C bindings, section "smooth punches".
module fuge_c_smooth
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_null_ptr, c_funptr, c_loc, c_associated, &
    c_f_pointer, c_f_procpointer
  use fuge_c_types, only: copy_string, copy_reals
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_MEMORY, FUGE_ERR_POINTER, &
    FUGE_ERR_SIZE
  implicit none
  private

  abstract interface
    !> fuge_smooth_profile of fuge_smooth.h.
    function c_profile(n, x, gap, slope, user) bind(c) result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout) :: gap(*), slope(*)
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: status
    end function c_profile
  end interface

  type, extends(fuge_smooth_profile) :: callback_profile
    procedure(c_profile), pointer, nopass :: at_places => null()
    type(c_ptr) :: user = c_null_ptr
  contains
    procedure :: evaluate
  end type callback_profile

  !> Behind struct fuge_smooth.
  type :: smooth_handle
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

  function c_solve_smooth_punch(profile, user, lower, upper, e_star, force, moment, destination, message, length) &
    bind(c, name='fuge_solve_smooth_punch') result(status)
    type(c_funptr), intent(in), value :: profile
    type(c_ptr), intent(in), value :: user, moment, destination, message
    real(c_double), intent(in), value :: lower, upper, e_star, force
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(callback_profile) :: punch
    type(smooth_handle), pointer :: handle
    type(c_ptr), pointer :: slot
    real(c_double), pointer :: turning
    type(fuge_info) :: info
    integer :: stat

    stat = 0
    nullify (handle)
    if (.not. (c_associated(profile) .and. c_associated(destination))) then
      call report(info, FUGE_ERR_POINTER, 'profile or contact is NULL')
    else
      allocate (handle, stat=stat)
      if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the contact')
    end if
    if (.not. info%failed()) then
      punch%lower = lower
      punch%upper = upper
      punch%user = user
      punch%at_places => procedure_at(profile)
      if (c_associated(moment)) then
        call c_f_pointer(moment, turning)
        call fuge_solve_smooth_punch(punch, e_star, force, handle%contact, info, turning)
      else
        call fuge_solve_smooth_punch(punch, e_star, force, handle%contact, info)
      end if
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (.not. associated(handle)) return
    if (info%failed()) then
      deallocate (handle)
    else
      handle%info = info
      call c_f_pointer(destination, slot)
      slot = c_loc(handle)
    end if
  end function c_solve_smooth_punch

  function procedure_at(address) result(found)
    type(c_funptr), intent(in) :: address
    procedure(c_profile), pointer :: found

    call c_f_procpointer(address, found)
  end function procedure_at

  !> Copies are given away, so that a callback which writes to x harms nobody; results
  !> start as NaN, so that one it forgets is seen.
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
    status = int(self%at_places(int(size(x), c_int), values(:, 1), values(:, 2), values(:, 3), self%user))
    gap = values(:, 2)
    slope = values(:, 3)
    if (status < 0) status = FUGE_ERR_CALLBACK
  end subroutine evaluate

  subroutine c_smooth_free(source) bind(c, name='fuge_smooth_free')
    type(c_ptr), intent(in), value :: source
    type(smooth_handle), pointer :: handle
    type(c_ptr), pointer :: slot

    if (.not. c_associated(source)) return
    call c_f_pointer(source, slot)
    if (.not. c_associated(slot)) return
    call c_f_pointer(slot, handle)
    deallocate (handle)
    slot = c_null_ptr
  end subroutine c_smooth_free

  function c_get_report(source, destination) bind(c, name='fuge_smooth_get_report') result(status)
    type(c_ptr), intent(in), value :: source, destination
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    type(c_report), pointer :: answer

    status = FUGE_ERR_POINTER
    if (.not. (c_associated(source) .and. c_associated(destination))) return
    call c_f_pointer(source, handle)
    call c_f_pointer(destination, answer)
    status = FUGE_DONE
    answer%iterations = int(handle%info%iterations, c_int)
    answer%coefficients = 0_c_int
    if (allocated(handle%contact%coefficients)) answer%coefficients = int(size(handle%contact%coefficients), c_int)
    answer%left = handle%contact%ends(1)
    answer%right = handle%contact%ends(2)
    answer%half_width = handle%contact%half_width
    answer%force = handle%contact%force
    answer%moment = handle%contact%moment
    answer%approach = handle%contact%approach
    answer%tilt = handle%contact%tilt
    answer%residual = handle%info%residual
    answer%end_error = handle%contact%end_error
    answer%pressure_error = handle%contact%pressure_error
    answer%reserved_int = 0_c_int
    answer%reserved = 0.0_c_double
  end function c_get_report

  function c_get_pressure(source, number, x, pressure) bind(c, name='fuge_smooth_get_pressure') result(status)
    type(c_ptr), intent(in), value :: source, x, pressure
    integer(c_int), intent(in), value :: number
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: places(:)

    status = status_of(number, c_associated(source) .and. c_associated(x) .and. c_associated(pressure))
    if (status /= FUGE_DONE) return
    call c_f_pointer(source, handle)
    call c_f_pointer(x, places, [number])
    call copy_reals(handle%contact%pressure(places), pressure)
  end function c_get_pressure

  function c_get_gap(source, number, x, initial_gap, gap) bind(c, name='fuge_smooth_get_gap') result(status)
    type(c_ptr), intent(in), value :: source, x, initial_gap, gap
    integer(c_int), intent(in), value :: number
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle
    real(c_double), pointer :: places(:), initial(:)

    status = status_of(number, c_associated(source) .and. c_associated(x) .and. c_associated(initial_gap) &
                       .and. c_associated(gap))
    if (status /= FUGE_DONE) return
    call c_f_pointer(source, handle)
    call c_f_pointer(x, places, [number])
    call c_f_pointer(initial_gap, initial, [number])
    call copy_reals(handle%contact%gap(places, initial), gap)
  end function c_get_gap

  function c_get_coefficients(source, capacity, coefficients) bind(c, name='fuge_smooth_get_coefficients') &
    result(status)
    type(c_ptr), intent(in), value :: source, coefficients
    integer(c_int), intent(in), value :: capacity
    integer(c_int) :: status
    type(smooth_handle), pointer :: handle

    status = status_of(capacity, c_associated(source) .and. c_associated(coefficients))
    if (status /= FUGE_DONE) return
    call c_f_pointer(source, handle)
    if (.not. allocated(handle%contact%coefficients)) return
    call copy_reals(handle%contact%coefficients(:min(int(capacity), size(handle%contact%coefficients))), coefficients)
  end function c_get_coefficients

  pure function status_of(number, all_there) result(status)
    integer(c_int), intent(in) :: number
    logical, intent(in) :: all_there
    integer(c_int) :: status

    status = FUGE_DONE
    if (.not. all_there) status = FUGE_ERR_POINTER
    if (number < 0) status = FUGE_ERR_SIZE
  end function status_of

end module fuge_c_smooth
