!> C bindings, section "results": what the last solve found.
module fuge_c_results
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_solver, only: take_solver
  use fuge_c_types, only: c_info, solver_handle, to_c, copy_string, copy_reals
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_POINTER, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, &
    FUGE_ERR_MEMORY
  implicit none
  private

contains

  function c_get_force(solver, force) bind(c, name='fuge_get_force') result(status)
    type(c_ptr), intent(in), value :: solver, force
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = ready(solver, force, handle)
    if (status == FUGE_DONE) call copy_out(handle%solution%force, force)
  end function c_get_force

  function c_get_gap(solver, gap) bind(c, name='fuge_get_gap') result(status)
    type(c_ptr), intent(in), value :: solver, gap
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = ready(solver, gap, handle)
    if (status == FUGE_DONE) call copy_out(handle%solution%gap, gap)
  end function c_get_gap

  function c_get_rigid(solver, q) bind(c, name='fuge_get_motion') result(status)
    type(c_ptr), intent(in), value :: solver, q
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = ready(solver, q, handle)
    if (status == FUGE_DONE) call copy_out(handle%solution%motion, q)
  end function c_get_rigid

  !> Resultants of the contact forces found in all motions: equal to the loads up to
  !> rounding where free, the reaction where prescribed.
  function c_get_resultant(solver, w) bind(c, name='fuge_get_resultant') result(status)
    type(c_ptr), intent(in), value :: solver, w
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = ready(solver, w, handle)
    if (status /= FUGE_DONE) return
    associate (problem => handle%problem, force => handle%solution%force)
      if (allocated(problem%modes)) then
        call copy_out(matmul(force, problem%modes), w)
      else
        call copy_out([sum(force)], w)
      end if
    end associate
  end function c_get_resultant

  !> First-order changes of the last solution with one load, see `derivative` of
  !> `fuge_solver`.
  function c_get_derivative(solver, gap_change, load_change, force, gap, motion) &
    bind(c, name='fuge_get_derivative') result(status)
    type(c_ptr), intent(in), value :: solver, gap_change, force, gap, motion
    real(c_double), intent(in), value :: load_change
    integer(c_int) :: status
    type(solver_handle), pointer :: handle

    status = ready(solver, force, handle)
    if (status == FUGE_DONE) status = differentiate(handle, gap_change, [load_change], force, gap, motion)
  end function c_get_derivative

  !> The same with all loads; NULL for none that changes.
  function c_get_derivatives(solver, gap_change, load_change, force, gap, motion) &
    bind(c, name='fuge_get_derivatives') result(status)
    type(c_ptr), intent(in), value :: solver, gap_change, load_change, force, gap, motion
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(c_double), pointer :: loads(:)
    integer :: k

    status = ready(solver, force, handle)
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
    type(solver_handle), intent(inout) :: handle
    type(c_ptr), intent(in) :: gap_change, force, gap, motion
    real(c_double), intent(in) :: load_change(:)
    integer(c_int) :: status
    real(c_double), pointer :: values(:)
    real(c_double), allocatable :: direction(:)
    type(fuge_solution) :: change
    type(fuge_info) :: info
    integer :: stat

    allocate (direction(handle%operator%operator%points()), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the change of the gaps')
    else
      direction = 0.0_c_double
      if (c_associated(gap_change)) then
        call c_f_pointer(gap_change, values, [size(direction)])
        direction = values
      end if
      call handle%solver%derivative(handle%operator%operator, direction, load_change, change, info)
    end if
    status = int(info%status, c_int)
    if (info%failed()) then
      handle%message = info%message
      return
    end if
    call copy_out(change%force, force)
    call copy_reals(change%gap, gap)
    call copy_reals(change%motion, motion)
  end function differentiate

  function c_get_info(solver, destination) bind(c, name='fuge_get_info') result(status)
    type(c_ptr), intent(in), value :: solver, destination
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(c_info), pointer :: target_info
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed()) then
      if (.not. c_associated(destination)) then
        call report(info, FUGE_ERR_POINTER, 'info is NULL')
      else if (.not. handle%tried) then
        call report(info, FUGE_ERR_CALL_ORDER, 'nothing is solved yet: call fuge_solve first')
      else
        call c_f_pointer(destination, target_info)
        target_info = to_c(handle%info)
      end if
      if (info%failed()) handle%message = info%message
    end if
    status = int(info%status, c_int)
  end function c_get_info

  function c_get_history(solver, first, number, basis, z, available) &
    bind(c, name='fuge_get_history') result(status)
    type(c_ptr), intent(in), value :: solver, basis, z, available
    integer(c_int), intent(in), value :: first, number
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info
    integer(c_int), pointer :: steps

    call take_solver(solver, handle, info)
    status = int(info%status, c_int)
    if (info%failed()) return
    associate (history => handle%solver%history)
      if (.not. handle%tried) then
        call report(info, FUGE_ERR_CALL_ORDER, 'nothing is solved yet: call fuge_solve first')
      else if (.not. c_associated(available) .or. &
               (number > 0 .and. .not. (c_associated(basis) .and. c_associated(z)))) then
        call report(info, FUGE_ERR_POINTER, 'available is NULL, or basis or z is with count > 0')
      else if (first < 0 .or. number < 0 .or. number > history%recorded() - max(0, min(first, history%recorded()))) then
        call report(info, FUGE_ERR_SIZE, 'first and count reach beyond the steps kept: ask for them with count = 0, ' &
                    //'and keep them with options.keep_history')
      else
        call c_f_pointer(available, steps)
        steps = int(history%recorded(), c_int)
        if (number > 0) call copy_steps(handle, int(first), int(number), basis, z)
      end if
    end associate
    if (info%failed()) handle%message = info%message
    status = int(info%status, c_int)
  end function c_get_history

  subroutine copy_steps(handle, first, number, basis, z)
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
  end subroutine copy_steps

  function c_last_message(solver, buffer, length) bind(c, name='fuge_solver_message') result(status)
    type(c_ptr), intent(in), value :: solver, buffer
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed() .and. .not. c_associated(buffer)) info%status = FUGE_ERR_POINTER
    if (.not. info%failed()) call copy_string(handle%message, buffer, length)
    status = int(info%status, c_int)
  end function c_last_message

  !> FUGE_DONE if there is an answer to copy and a place to put it.
  function ready(solver, destination, handle) result(status)
    type(c_ptr), intent(in) :: solver, destination
    type(solver_handle), pointer, intent(out) :: handle
    integer(c_int) :: status
    type(fuge_info) :: info

    call take_solver(solver, handle, info)
    if (.not. info%failed()) then
      if (.not. c_associated(destination)) then
        call report(info, FUGE_ERR_POINTER, 'the array for the result is NULL')
      else if (.not. handle%solved) then
        call report(info, FUGE_ERR_CALL_ORDER, 'there is no answer for the present problem: ' &
                    //'call fuge_solve and look at its status')
      end if
      if (info%failed()) handle%message = info%message
    end if
    status = int(info%status, c_int)
  end function ready

  subroutine copy_out(values, destination)
    real(c_double), intent(in) :: values(:)
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: array(:)

    call c_f_pointer(destination, array, [size(values)])
    array = values
  end subroutine copy_out

end module fuge_c_results
