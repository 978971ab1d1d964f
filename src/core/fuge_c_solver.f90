!> C bindings, sections "one call" and "solver": life cycle, solve.
module fuge_c_solver
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_funptr, c_loc, c_size_t, c_associated, c_f_pointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_monitor, only: c_monitor
  use fuge_c_operator, only: find_matrix, find_operator, operator_handle
  use fuge_c_types, only: reporting_handle, options_at, report_to_c, report_to_handle, require_pointer, set_handle, &
    take_handle
  use fuge_load_cases_type, only: fuge_case_solutions
  use fuge_options_type, only: fuge_options, check_options
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver, fuge_solve_dense
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER
  implicit none
  private

  public :: find_solver, require_problem

  !> Behind struct fuge_solver.
  type, extends(reporting_handle), public :: solver_handle
    type(operator_handle), pointer :: operator => null()
    type(fuge_options) :: options
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    !> States and reports of the load cases, if these were the last solve.
    type(fuge_case_solutions) :: cases
    type(c_monitor) :: monitor
    !> Report of the last solve.
    type(fuge_info) :: info
    !> The solution belongs to the present problem.
    logical :: solved = .false.
    !> A solve has been tried, so that `info` means something.
    logical :: tried = .false.
  end type solver_handle

contains

  !> Ten arguments, as in the header: the matrix with its sizes, three results, the message.
  function c_solve_dense(n, alpha, lda, gap, load, force, gap_out, approach, message, length) &
    bind(c, name='fuge_solve_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, gap, force, gap_out, approach, message
    real(c_double), intent(in), value :: load
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: matrix(:, :), initial(:)
    real(c_double), allocatable :: f(:), c(:)
    real(c_double) :: v
    type(fuge_info) :: info
    integer :: stat

    call find_matrix(n, alpha, lda, matrix, info)
    call find_array(n, gap, 'gap', initial, info)
    call require_pointer(force, 'force', info)
    call require_pointer(gap_out, 'gap_out', info)
    call require_pointer(approach, 'approach', info)
    if (.not. info%failed()) then
      ! Arrays of the caller may overlap.
      allocate (f(n), c(n), stat=stat)
      call require_memory(stat, 'the forces and gaps', info)
    end if
    if (.not. info%failed()) call fuge_solve_dense(matrix, initial, load, f, c, v, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call give(f, force)
    call give(c, gap_out)
    call give(v, approach)
  end function c_solve_dense

  !> The options are checked here, so that the call with the error says so, and again by each
  !> `solve`, since a Fortran caller has no such constructor: five comparisons.
  function c_solver_new(operator, options, destination, message, length) bind(c, name='fuge_solver_new') result(status)
    type(c_ptr), intent(in), value :: operator, options, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    type(fuge_options) :: chosen
    type(fuge_info) :: info

    call find_operator(operator, 'op', handle, info)
    call require_pointer(destination, 's', info)
    if (.not. info%failed()) then
      chosen = options_at(options)
      call check_options(chosen, info)
    end if
    if (.not. info%failed()) call new_solver(handle, chosen, destination, info)
    status = report_to_c(info, message, length)
  end function c_solver_new

  !> Put a solver behind a handle at `destination`; FUGE_ERR_MEMORY.
  subroutine new_solver(operator, options, destination, info)
    type(operator_handle), pointer, intent(in) :: operator
    type(fuge_options), intent(in) :: options
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(solver_handle), pointer :: handle
    integer :: stat

    allocate (handle, stat=stat)
    call require_memory(stat, 'the solver', info)
    if (stat /= 0) return
    handle%options = options
    handle%operator => operator
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
    status = report_to_handle(info, handle)
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
      handle%cases = fuge_case_solutions()
    end if
    if (associated(handle)) then
      handle%info = info
      handle%tried = .true.
    end if
    status = report_to_handle(info, handle)
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
      handle%cases = fuge_case_solutions()
      call handle%solver%reset()
    end if
    status = report_to_handle(info, handle)
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

end module fuge_c_solver
