!> C bindings, section "solver": life cycle, solve.
module fuge_c_solver
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_funptr, c_loc, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: c_options, solver_handle, from_c, message_for_c, report_to_c, require_pointer, set_handle, &
    take_handle
  use fuge_options_type, only: fuge_options, check_options
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER
  implicit none
  private

  public :: find_solver, report_to_solver, require_problem

contains

  !> The options are checked here, so that the call with the error says so, and again by each
  !> `solve`, since a Fortran caller has no such constructor: four comparisons.
  function c_solver_new(operator, options, destination, message, length) bind(c, name='fuge_solver_new') result(status)
    type(c_ptr), intent(in), value :: operator, options, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(c_options), pointer :: options_of_c
    type(fuge_options) :: options_of_solver
    type(fuge_info) :: info

    call require_pointer(operator, 'op', info)
    call require_pointer(destination, 's', info)
    if (.not. info%failed()) then
      if (c_associated(options)) then
        call c_f_pointer(options, options_of_c)
        options_of_solver = from_c(options_of_c)
      end if
      call check_options(options_of_solver, info)
    end if
    if (.not. info%failed()) call new_solver(operator, options_of_solver, destination, info)
    status = report_to_c(info, message, length)
  end function c_solver_new

  !> Put a solver behind a handle at `destination`; FUGE_ERR_MEMORY.
  subroutine new_solver(operator, options, destination, info)
    type(c_ptr), intent(in) :: operator, destination
    type(fuge_options), intent(in) :: options
    type(fuge_info), intent(inout) :: info
    type(solver_handle), pointer :: handle
    integer :: stat

    allocate (handle, stat=stat)
    call require_memory(stat, 'the solver', info)
    if (stat /= 0) return
    handle%options = options
    call c_f_pointer(operator, handle%operator)
    call set_handle(c_loc(handle), destination)
  end subroutine new_solver

  subroutine c_solver_free(source) bind(c, name='fuge_solver_free')
    type(c_ptr), intent(in), value :: source
    type(solver_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_solver_free

  function c_set_progress(solver, progress, user) bind(c, name='fuge_set_progress') result(status)
    type(c_ptr), intent(in), value :: solver, user
    type(c_funptr), intent(in), value :: progress
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call handle%monitor%set(progress, user)
    status = report_to_solver(info, handle)
  end function c_set_progress

  function c_solve(solver) bind(c, name='fuge_solve') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info
    type(point_space) :: space

    call find_solver(solver, handle, info)
    if (associated(handle)) then
      if (.not. info%failed()) call require_problem(handle, 'fuge_solve', info)
      space = handle%operator%operator%ranks()
      call space%agree(info)
    end if
    if (.not. info%failed()) then
      call handle%solver%solve(handle%operator%operator, handle%problem, handle%solution, info, handle%options, &
                               handle%monitor)
      handle%solved = .not. info%failed()
    end if
    if (associated(handle)) then
      handle%info = info
      handle%tried = .true.
    end if
    status = report_to_solver(info, handle)
  end function c_solve

  !> FUGE_ERR_CALL_ORDER unless gaps and motions are set.
  subroutine require_problem(handle, caller, info)
    type(solver_handle), intent(in) :: handle
    character(len=*), intent(in) :: caller
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(handle%problem%gap)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the gaps are not set: call fuge_set_gap before '//caller)
    else if (.not. (allocated(handle%problem%resultant) .or. allocated(handle%problem%prescribed))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the motions are not set: call fuge_set_load, fuge_set_approach or ' &
                  //'fuge_set_modes before '//caller)
    end if
  end subroutine require_problem

  !> Forget solutions and history; operator, options and problem stay.
  function c_reset(solver) bind(c, name='fuge_reset') result(status)
    type(c_ptr), intent(in), value :: solver
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) then
      handle%solved = .false.
      handle%tried = .false.
      call handle%solver%reset()
    end if
    status = report_to_solver(info, handle)
  end function c_reset

  !> The solver behind a handle; FUGE_ERR_POINTER for NULL.
  subroutine find_solver(solver, handle, info)
    type(c_ptr), intent(in) :: solver
    type(solver_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(solver, 's', info)
    if (.not. info%failed()) call c_f_pointer(solver, handle)
  end subroutine find_solver

  !> Leave the message in the solver. The result is the status to return.
  function report_to_solver(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    type(solver_handle), pointer, intent(in) :: handle
    integer(c_int) :: status

    if (associated(handle)) handle%message = message_for_c(info)
    status = int(info%status, c_int)
  end function report_to_solver

end module fuge_c_solver
