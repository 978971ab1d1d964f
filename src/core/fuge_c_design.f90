!> C bindings, section "design": gradients of the last solution, and the gaps for a wanted pressure.
!>
!> They do work of their own, so the message is their own too.
module fuge_c_design
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_ptr, c_associated, c_f_pointer
  use fuge_adjoint_solution, only: fuge_solve_adjoint
  use fuge_c_arrays, only: find_array, give
  use fuge_c_results, only: require_solution
  use fuge_c_solver, only: find_solver, solver_handle
  use fuge_c_types, only: report_to_handle, require_pointer
  use fuge_gradients_type, only: fuge_gradients
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, require_memory
  use fuge_wanted_pressure, only: fuge_gap_for_pressure, fuge_wanted_contact
  implicit none
  private

contains

  !> The gradient over all data, see `fuge_solve_adjoint`. The arguments are thirteen, because each gradient may be left
  !> out.
  function c_get_gradients(solver, force_weight, gap_weight, motion_weight, gap, load, compliance, motion_stiffness, &
                           gap_upper, limit, limit_upper, log_modulus, at_kink) &
    bind(c, name='fuge_get_gradients') result(status)
    type(c_ptr), intent(in), value :: solver, force_weight, gap_weight, motion_weight, gap, load, compliance, &
      motion_stiffness, gap_upper, limit, limit_upper, log_modulus, at_kink
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_gradients) :: gradients
    type(fuge_info) :: info
    type(fuge_solution) :: weight

    call find_solver(solver, handle, info)
    if (.not. info%failed()) call require_solution(handle, info)
    if (.not. info%failed()) then
      call copy_values(force_weight, size(handle%solution%force), 'force_weight', weight%force, info)
      call copy_values(gap_weight, size(handle%solution%force), 'gap_weight', weight%gap, info)
      call copy_values(motion_weight, size(handle%solution%motion), 'motion_weight', weight%motion, info)
    end if
    if (.not. info%failed()) then
      call fuge_solve_adjoint(handle%solver, handle%operator%operator, handle%problem, handle%solution, weight, &
                              gradients, info)
    end if
    status = report_to_handle(info, handle)
    if (info%failed()) return
    call give(gradients%gap, gap)
    call give(gradients%load, load)
    call give(gradients%compliance, compliance)
    call give(gradients%motion_stiffness, motion_stiffness)
    call give_or_zero(gradients%gap_upper, size(gradients%gap), gap_upper)
    call give_or_zero(gradients%limit, size(gradients%gap), limit)
    call give_or_zero(gradients%limit_upper, size(gradients%gap), limit_upper)
    call give(gradients%log_modulus, log_modulus)
    call give(merge(1, 0, gradients%at_kink), at_kink)
  end function c_get_gradients

  !> A copy of `number` values behind an `address`, none for NULL. Error: FUGE_ERR_MEMORY.
  subroutine copy_values(address, number, name, copy, info)
    type(c_ptr), intent(in) :: address
    integer, intent(in) :: number
    character(len=*), intent(in) :: name
    real(dp), allocatable, intent(out) :: copy(:)
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:)
    integer :: stat

    if (info%failed() .or. .not. c_associated(address)) return
    call c_f_pointer(address, values, [number])
    allocate (copy, source=values, stat=stat)
    call require_memory(stat, name//' of', number, 'values', info)
  end subroutine copy_values

  !> Give `values`, or `number` zeros where not allocated.
  subroutine give_or_zero(values, number, destination)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: number
    type(c_ptr), intent(in) :: destination
    real(c_double), pointer :: copy(:)

    if (allocated(values)) then
      call give(values, destination)
    else if (c_associated(destination)) then
      call c_f_pointer(destination, copy, [number])
      copy = 0.0_c_double
    end if
  end subroutine give_or_zero

  !> The gaps for wanted forces: see `fuge_gap_for_pressure`.
  function c_gap_for_pressure(solver, force, clearance, gap, reached, resultant) &
    bind(c, name='fuge_gap_for_pressure') result(status)
    type(c_ptr), intent(in), value :: solver, force, gap, reached, resultant
    real(c_double), intent(in), value :: clearance
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    type(fuge_wanted_contact) :: wanted
    type(fuge_info) :: info
    real(c_double), pointer :: values(:)

    call find_solver(solver, handle, info)
    call require_pointer(gap, 'gap', info)
    if (.not. info%failed()) call find_array(handle%operator%operator%points(), force, 'force', values, info)
    if (.not. info%failed()) then
      call fuge_gap_for_pressure(handle%operator%operator, handle%problem, values, clearance, wanted, info)
    end if
    status = report_to_handle(info, handle)
    if (info%failed()) return
    call give(wanted%gap, gap)
    call give(wanted%force, reached)
    call give(wanted%resultant, resultant)
  end function c_gap_for_pressure

end module fuge_c_design
