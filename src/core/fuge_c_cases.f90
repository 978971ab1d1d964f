!> C bindings, load cases of section "solver".
module fuge_c_cases
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_solver, only: find_solver, require_problem, solver_handle
  use fuge_c_types, only: give_info, report_failure, report_to_c, report_to_handle, require_count, require_pointer
  use fuge_case_envelope, only: fuge_envelope, fuge_find_envelope
  use fuge_cases_solution, only: fuge_solve_cases
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  implicit none
  private

contains

  function c_solve_cases(solver, cases, gap, resultant, force, gap_out, motion, statuses) &
    bind(c, name='fuge_solve_cases') result(status)
    type(c_ptr), intent(in), value :: solver, gap, resultant, force, gap_out, motion, statuses
    integer(c_int), intent(in), value :: cases
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_load_cases) :: data
    type(fuge_case_solutions) :: found
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    if (.not. info%failed()) call require_problem(handle, 'fuge_solve_cases', info)
    if (.not. info%failed()) then
      call copy_columns(handle%operator%operator%points(), int(cases), gap, 'gaps', data%gap, info)
      call copy_columns(handle%problem%mode_count(), int(cases), resultant, 'resultants', data%load, info)
    end if
    if (.not. info%failed()) then
      handle%solved = .false.
      handle%tried = .false.
      call fuge_solve_cases(handle%solver, handle%operator%operator, handle%problem, data, found, info, &
                            handle%options, handle%monitor)
    end if
    if (.not. info%failed()) then
      call give_solved(found, force, gap_out, motion)
      call give(found%report%status, statuses)
      call move_alloc(found%state, handle%cases%state)
      call move_alloc(found%report, handle%cases%report)
    end if
    status = report_to_handle(info, handle)
  end function c_solve_cases

  !> A copy of the columns behind an `address`, none for NULL. The results of a caller may overlap them. Error:
  !> FUGE_ERR_MEMORY.
  subroutine copy_columns(rows, cases, address, name, columns, info)
    integer, intent(in) :: rows, cases
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: name
    real(c_double), allocatable, intent(out) :: columns(:, :)
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:, :)
    integer :: stat

    if (info%failed() .or. .not. c_associated(address)) return
    call c_f_pointer(address, values, [rows, cases])
    allocate (columns(rows, cases), stat=stat)
    call require_memory(stat, 'the '//name//' of', cases, 'load cases', info)
    if (stat == 0) columns = values
  end subroutine copy_columns

  !> Copy the columns of the cases that have a solution.
  subroutine give_solved(found, force, gap, motion)
    type(fuge_case_solutions), intent(in) :: found
    type(c_ptr), intent(in) :: force, gap, motion

    call give_columns(found, found%force, force)
    call give_columns(found, found%gap, gap)
    call give_columns(found, found%motion, motion)
  end subroutine give_solved

  subroutine give_columns(found, values, destination)
    type(fuge_case_solutions), intent(in) :: found
    real(c_double), intent(in) :: values(:, :)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: columns(:, :)
    integer :: k

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, columns, shape(values))
    do k = 1, size(values, 2)
      if (.not. found%report(k)%failed()) columns(:, k) = values(:, k)
    end do
  end subroutine give_columns

  function c_get_case_states(solver, which, state) bind(c, name='fuge_get_case_states') result(status)
    type(c_ptr), intent(in), value :: solver, state
    integer(c_int), intent(in), value :: which
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_case(solver, which, handle, info)
    call require_pointer(state, 'state', info)
    if (.not. info%failed()) call give(handle%cases%state(:, which + 1), state)
    status = report_failure(info, handle)
  end function c_get_case_states

  function c_get_case_info(solver, which, destination) bind(c, name='fuge_get_case_info') result(status)
    type(c_ptr), intent(in), value :: solver, destination
    integer(c_int), intent(in), value :: which
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_case(solver, which, handle, info)
    call require_pointer(destination, 'info', info)
    if (.not. info%failed()) call give_info(handle%cases%report(which + 1), destination)
    status = report_failure(info, handle)
  end function c_get_case_info

  function c_case_message(solver, which, buffer, length) bind(c, name='fuge_case_message') result(status)
    type(c_ptr), intent(in), value :: solver, buffer
    integer(c_int), intent(in), value :: which
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_case(solver, which, handle, info)
    call require_pointer(buffer, 'message', info)
    status = report_failure(info, handle)
    if (info%failed()) return
    status = report_to_c(handle%cases%report(which + 1), buffer, length)
    ! That of the case is not the status of this call.
    status = FUGE_DONE
  end function c_case_message

  !> The solver with the load case `which`, from 0; FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine find_case(solver, which, handle, info)
    type(c_ptr), intent(in) :: solver
    integer(c_int), intent(in) :: which
    type(solver_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info
    integer :: cases

    call find_solver(solver, handle, info)
    if (info%failed()) return
    cases = 0
    if (allocated(handle%cases%report)) cases = size(handle%cases%report)
    if (cases < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there are no load cases: call fuge_solve_cases and look at its status')
    else if (which < 0 .or. which >= cases) then
      call report(info, FUGE_ERR_SIZE, 'which = '//text(int(which))//' is no load case: there are '//text(cases) &
                  //', which count from 0')
    end if
  end subroutine find_case

  !> Nine arguments, as in the header: the values with their sizes, four results, the message.
  function c_find_envelope(n, cases, values, smallest, largest, smallest_case, largest_case, message, length) &
    bind(c, name='fuge_find_envelope') result(status)
    integer(c_int), intent(in), value :: n, cases
    type(c_ptr), intent(in), value :: values, smallest, largest, smallest_case, largest_case, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: columns(:, :)
    type(fuge_envelope) :: envelope
    type(fuge_info) :: info

    call require_count(n, 0, 'n', 'rows', info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    call find_array(int(n), cases, values, 'values', columns, info)
    if (.not. info%failed()) call fuge_find_envelope(columns, envelope, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call give(envelope%smallest, smallest)
    call give(envelope%largest, largest)
    call give(envelope%smallest_case - 1, smallest_case)
    call give(envelope%largest_case - 1, largest_case)
  end function c_find_envelope

end module fuge_c_cases
