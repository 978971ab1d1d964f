!> C bindings, section "results": what the last solve found, and what is proved of it.
!>
!> A getter that fails leaves its message in the solver; one that succeeds leaves the message of
!> the solve, which may be a warning.
module fuge_c_results
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_arrays, only: give
  use fuge_c_solver, only: find_solver, solver_handle
  use fuge_c_types, only: give_info, give_message, report_failure, report_to_handle, require_pointer
  use fuge_number_text, only: text
  use fuge_problem_modes, only: resultants_of
  use fuge_problem_type, only: fuge_solution
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_proof_type, only: fuge_proof
  use fuge_solution_proof, only: fuge_prove
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, &
    FUGE_ERR_SIZE
  implicit none
  private

  public :: require_solution

contains

  function c_get_force(solver, force) bind(c, name='fuge_get_force') result(status)
    type(c_ptr), intent(in), value :: solver, force
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = find_solution(solver, force, 'force', handle)
    if (status == FUGE_DONE) call give(handle%solution%force, force)
  end function c_get_force

  function c_get_gap(solver, gap) bind(c, name='fuge_get_gap') result(status)
    type(c_ptr), intent(in), value :: solver, gap
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = find_solution(solver, gap, 'gap', handle)
    if (status == FUGE_DONE) call give(handle%solution%gap, gap)
  end function c_get_gap

  function c_get_states(solver, state) bind(c, name='fuge_get_states') result(status)
    type(c_ptr), intent(in), value :: solver, state
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = find_solution(solver, state, 'state', handle)
    if (status == FUGE_DONE) call give(handle%solution%state, state)
  end function c_get_states

  function c_get_motion(solver, motion) bind(c, name='fuge_get_motion') result(status)
    type(c_ptr), intent(in), value :: solver, motion
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = find_solution(solver, motion, 'motion', handle)
    if (status == FUGE_DONE) call give(handle%solution%motion, motion)
  end function c_get_motion

  !> Resultants of the contact forces found in all motions: equal to the loads up to
  !> rounding where free, the reaction where prescribed.
  function c_get_resultant(solver, resultant) bind(c, name='fuge_get_resultant') result(status)
    type(c_ptr), intent(in), value :: solver, resultant
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(point_space) :: space

    status = find_solution(solver, resultant, 'resultant', handle)
    if (status /= FUGE_DONE) return
    space = handle%operator%operator%ranks()
    call give(resultants_of(handle%problem, handle%solution%force, space), resultant)
  end function c_get_resultant

  !> First-order changes of the last solution with the gaps and all loads; either is NULL if none of it changes.
  function c_get_derivatives(solver, gap_change, load_change, force, gap, motion) &
    bind(c, name='fuge_get_derivatives') result(status)
    type(c_ptr), intent(in), value :: solver, gap_change, load_change, force, gap, motion
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(c_double), pointer :: loads(:)
    integer :: k

    status = find_solution(solver, force, 'force', handle)
    if (status /= FUGE_DONE) return
    associate (m => handle%problem%mode_count())
      if (c_associated(load_change)) then
        call c_f_pointer(load_change, loads, [m])
        status = differentiate(handle, gap_change, loads, force, gap, motion)
      else
        status = differentiate(handle, gap_change, [(0.0_c_double, k=1, m)], force, gap, motion)
      end if
    end associate
  end function c_get_derivatives

  function differentiate(handle, gap_change, load_change, force, gap, motion) result(status)
    type(solver_handle), pointer, intent(in) :: handle
    type(c_ptr), intent(in) :: gap_change, force, gap, motion
    real(c_double), intent(in) :: load_change(:)
    integer(c_int) :: status
    real(c_double), pointer :: values(:)
    real(c_double), allocatable :: direction(:)
    type(fuge_solution) :: change
    type(fuge_info) :: info
    integer :: stat

    allocate (direction(handle%operator%operator%points()), stat=stat)
    call require_memory(stat, 'the change of the gaps', info)
    if (stat == 0) then
      direction = 0.0_c_double
      if (c_associated(gap_change)) then
        call c_f_pointer(gap_change, values, [size(direction)])
        direction = values
      end if
      call handle%solver%derivative(handle%operator%operator, direction, load_change, change, info)
    end if
    status = report_failure(info, handle)
    if (info%failed()) return
    call give(change%force, force)
    call give(change%gap, gap)
    call give(change%motion, motion)
  end function differentiate

  !> Bounds of the error of the last solution, see `fuge_prove`. It does work of its own, so the message is its own too.
  function c_prove(solver, force_bound, gap_bound, motion_bound, proved) bind(c, name='fuge_prove') result(status)
    type(c_ptr), intent(in), value :: solver, force_bound, gap_bound, motion_bound, proved
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_proof) :: proof
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call require_solution(handle, info)
    if (.not. info%failed()) then
      call fuge_prove(handle%operator%operator, handle%problem, handle%solution, proof, info)
    end if
    status = report_to_handle(info, handle)
    if (info%failed()) return
    call give(proof%force_bound, force_bound)
    call give(proof%gap_bound, gap_bound)
    call give(proof%motion_bound, motion_bound)
    call give(merge(1, 0, proof%state_proved), proved)
  end function c_prove

  function c_get_info(solver, destination) bind(c, name='fuge_get_info') result(status)
    type(c_ptr), intent(in), value :: solver, destination
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_pointer(destination, 'info', info)
    if (.not. info%failed()) call require_solve(handle, info)
    if (.not. info%failed()) call give_info(handle%info, destination)
    status = report_failure(info, handle)
  end function c_get_info

  function c_get_history(solver, first, number, basis, z, available) &
    bind(c, name='fuge_get_history') result(status)
    type(c_ptr), intent(in), value :: solver, basis, z, available
    integer(c_int), intent(in), value :: first, number
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_pointer(available, 'available', info)
    if (number > 0) call require_pointer(basis, 'basis', info)
    if (number > 0) call require_pointer(z, 'z', info)
    if (.not. info%failed()) call require_solve(handle, info)
    if (.not. info%failed()) call check_steps(handle%solver%history%recorded(), int(first), int(number), info)
    status = report_failure(info, handle)
    if (info%failed()) return
    call give(handle%solver%history%recorded(), available)
    if (number > 0) call give_steps(handle, int(first), int(number), basis, z)
  end function c_get_history

  !> FUGE_ERR_SIZE unless `recorded` steps include the range.
  pure subroutine check_steps(recorded, first, number, info)
    integer, intent(in) :: recorded, first, number
    type(fuge_info), intent(inout) :: info

    if (first < 0 .or. number < 0 .or. number > recorded - max(0, min(first, recorded))) then
      call report(info, FUGE_ERR_SIZE, 'first = '//text(first)//' and count = '//text(number)//' reach beyond the ' &
                  //text(recorded)//' steps kept: ask for their number with count = 0, and keep them with ' &
                  //'options.keep_history')
    end if
  end subroutine check_steps

  !> FUGE_ERR_CALL_ORDER before the first solve.
  pure subroutine require_solve(handle, info)
    type(solver_handle), intent(in) :: handle
    type(fuge_info), intent(inout) :: info

    if (.not. handle%tried) call report(info, FUGE_ERR_CALL_ORDER, 'there has been no solve: call fuge_solve first')
  end subroutine require_solve

  subroutine give_steps(handle, first, number, basis, z)
    type(solver_handle), intent(in) :: handle
    integer, intent(in) :: first, number
    type(c_ptr), intent(in) :: basis, z
    integer(c_int), pointer :: columns(:, :)
    real(c_double), pointer :: sums(:)
    integer :: k

    associate (history => handle%solver%history)
      call c_f_pointer(basis, columns, [size(history%basis(0)), number])
      call c_f_pointer(z, sums, [number])
      do k = 1, number
        columns(:, k) = int(history%basis(first + k - 1), c_int)
        sums(k) = history%z(first + k - 1)
      end do
    end associate
  end subroutine give_steps

  function c_solver_message(solver, buffer, length) bind(c, name='fuge_solver_message') result(status)
    type(c_ptr), intent(in), value :: solver, buffer
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    status = give_message(info, handle, buffer, length)
  end function c_solver_message

  !> The solver with a solution to copy to `destination`. Otherwise its message says why there is none
  !> (FUGE_ERR_CALL_ORDER, FUGE_ERR_POINTER).
  function find_solution(solver, destination, name, handle) result(status)
    type(c_ptr), intent(in) :: solver, destination
    character(len=*), intent(in) :: name
    type(solver_handle), pointer, intent(out) :: handle
    integer(c_int) :: status
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_pointer(destination, name, info)
    if (.not. info%failed()) call require_solution(handle, info)
    status = report_failure(info, handle)
  end function find_solution

  !> FUGE_ERR_CALL_ORDER without a solution of the present problem.
  pure subroutine require_solution(handle, info)
    type(solver_handle), intent(in) :: handle
    type(fuge_info), intent(inout) :: info

    if (.not. handle%solved) call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution of the present problem: ' &
                                         //'call fuge_solve and look at its status')
  end subroutine require_solution

end module fuge_c_results
