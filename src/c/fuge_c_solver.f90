!> C bindings, section "solver": life cycle, solve.
module fuge_c_solver
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_null_ptr, c_funptr, c_loc, c_associated, &
    c_f_pointer
  use fuge_c_types, only: c_options, operator_handle, solver_handle, from_c
  use fuge_options_type, only: fuge_options, check_options
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_POINTER, FUGE_ERR_MEMORY, &
    FUGE_ERR_CALL_ORDER
  implicit none
  private

  public :: take_solver, answer, require_problem

contains

  function c_solver_new(operator, options, destination) bind(c, name='fuge_solver_new') result(status)
    type(c_ptr), intent(in), value :: operator, options, destination
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(c_options), pointer :: wanted
    type(c_ptr), pointer :: slot
    type(fuge_options) :: chosen
    type(fuge_info) :: info
    integer :: stat

    status = FUGE_ERR_POINTER
    if (.not. (c_associated(operator) .and. c_associated(destination))) return
    if (c_associated(options)) then
      call c_f_pointer(options, wanted)
      chosen = from_c(wanted)
    end if
    call check_options(chosen, info)
    status = int(info%status, c_int)
    if (info%failed()) return
    status = FUGE_ERR_MEMORY
    allocate (handle, stat=stat)
    if (stat /= 0) return
    handle%options = chosen
    call c_f_pointer(operator, handle%operator)
    call c_f_pointer(destination, slot)
    slot = c_loc(handle)
    status = FUGE_DONE
  end function c_solver_new

  subroutine c_solver_free(source) bind(c, name='fuge_solver_free')
    type(c_ptr), intent(in), value :: source
    type(solver_handle), pointer :: handle
    type(c_ptr), pointer :: slot

    if (.not. c_associated(source)) return
    call c_f_pointer(source, slot)
    if (.not. c_associated(slot)) return
    call c_f_pointer(slot, handle)
    deallocate (handle)
    slot = c_null_ptr
  end subroutine c_solver_free

  function c_set_progress(solver, progress, user) bind(c, name='fuge_set_progress') result(status)
    type(c_ptr), intent(in), value :: solver, user
    type(c_funptr), intent(in), value :: progress
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed()) call handle%monitor%set(progress, user)
    status = answer(handle, info)
  end function c_set_progress

  function c_solve(solver) bind(c, name='fuge_solve') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed()) call require_problem(handle, 'fuge_solve', info)
    if (.not. info%failed()) then
      call handle%solver%solve(handle%operator%operator, handle%problem, handle%solution, info, handle%options, &
                               handle%monitor)
      handle%solved = .not. info%failed()
    end if
    if (associated(handle)) then
      handle%info = info
      handle%tried = .true.
    end if
    status = answer(handle, info)
  end function c_solve

  !> FUGE_ERR_CALL_ORDER unless gaps and motions are set.
  subroutine require_problem(handle, caller, info)
    type(solver_handle), intent(in) :: handle
    character(len=*), intent(in) :: caller
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(handle%problem%gap)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the gaps are not known: call fuge_set_gap before '//caller)
    else if (.not. (allocated(handle%problem%resultant) .or. allocated(handle%problem%prescribed))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the load is not known: call fuge_set_load, fuge_set_approach or ' &
                  //'fuge_set_modes before '//caller)
    end if
  end subroutine require_problem

  !> Forget answers and history; operator, options and problem stay.
  function c_reset(solver) bind(c, name='fuge_reset') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed()) then
      handle%solved = .false.
      handle%tried = .false.
      call handle%solver%reset()
    end if
    status = answer(handle, info)
  end function c_reset

  !> The object behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine take_solver(solver, handle, info)
    type(c_ptr), intent(in) :: solver
    type(solver_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    if (c_associated(solver)) then
      call c_f_pointer(solver, handle)
    else
      call report(info, FUGE_ERR_POINTER, 'the solver is NULL')
    end if
  end subroutine take_solver

  !> The status to return; its message stays with the handle.
  function answer(handle, info) result(status)
    type(solver_handle), pointer, intent(in) :: handle
    type(fuge_info), intent(in) :: info
    integer(c_int) :: status

    if (associated(handle)) handle%message = info%message
    status = int(info%status, c_int)
  end function answer

end module fuge_c_solver
