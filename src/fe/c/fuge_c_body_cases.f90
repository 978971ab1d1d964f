!> C bindings, section "condensation": load cases of a body.
module fuge_c_body_cases
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_associated, c_f_pointer
  use fuge_c_arrays, only: find_array, give
  use fuge_c_body, only: body_handle, find_condensed
  use fuge_c_types, only: report_to_handle, require_count, require_pointer
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_WARN_CASES
  implicit none
  private

contains

  function c_body_get_cases(body, cases, loads, displacement, resultant, statuses) &
    bind(c, name='fuge_body_get_cases') result(status)
    type(c_ptr), intent(in), value :: body, loads, displacement, resultant, statuses
    integer(c_int), intent(in), value :: cases
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: forces(:, :)
    real(c_double), allocatable :: no_gap(:)
    type(fuge_problem) :: problem
    type(fuge_load_cases) :: found
    type(fuge_info) :: info
    integer :: k

    call find_condensed(body, handle, info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    if (.not. info%failed()) then
      call find_array(handle%degrees, cases, loads, 'loads', forces, info)
      allocate (no_gap(size(handle%condensed%displacement)), source=0.0_c_double)
    end if
    if (.not. info%failed()) then
      ! Without a motion of the ground.
      allocate (problem%modes(size(no_gap), 0), problem%resultant(0))
      call handle%condensed%pose_cases(no_gap, forces, problem, found, info)
    end if
    if (.not. info%failed()) then
      do k = 1, int(cases)
        if (.not. found%refused(k)%failed()) cycle
        found%gap(:, k) = ieee_value(1.0_c_double, ieee_quiet_nan)
        if (allocated(found%load)) found%load(:, k) = ieee_value(1.0_c_double, ieee_quiet_nan)
      end do
      call give(found%gap, displacement)
      if (allocated(found%load)) call give(found%load, resultant)
      call give(found%refused%status, statuses)
      call sum_up(found%refused, info)
    end if
    status = report_to_handle(info, handle)
  end function c_body_get_cases

  !> FUGE_WARN_CASES if any case is refused.
  pure subroutine sum_up(refused, info)
    type(fuge_info), intent(in) :: refused(:)
    type(fuge_info), intent(inout) :: info
    integer :: first

    if (all(refused%status >= 0)) return
    first = findloc(refused%status < 0, .true., dim=1)
    call report(info, FUGE_WARN_CASES, text(count(refused%status < 0))//' of '//text(size(refused)) &
                //' load cases are refused; load case '//index_text(first)//': '//composed_message(refused(first)))
  end subroutine sum_up

  function c_body_recover_cases(body, cases, loads, force, motion, displacement, statuses) &
    bind(c, name='fuge_body_recover_cases') result(status)
    type(c_ptr), intent(in), value :: body, loads, force, motion, displacement, statuses
    integer(c_int), intent(in), value :: cases
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: forces(:, :), results(:, :)
    real(c_double), allocatable :: found(:, :)
    type(fuge_case_solutions) :: solutions
    type(fuge_info) :: info
    integer :: k, stat

    call find_condensed(body, handle, info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    if (.not. info%failed()) then
      call find_array(handle%degrees, cases, loads, 'loads', forces, info)
      call copy_solutions(handle, int(cases), force, motion, statuses, solutions, info)
      call find_array(handle%degrees, cases, displacement, 'displacement', results, info)
    end if
    if (.not. info%failed()) then
      allocate (found(handle%degrees, cases), stat=stat)
      call require_memory(stat, 'the displacements of', int(cases), 'load cases', info)
    end if
    if (.not. info%failed()) call handle%condensed%recover_cases(forces, solutions, found, info)
    if (.not. info%failed()) then
      do k = 1, int(cases)
        if (.not. solutions%report(k)%failed()) results(:, k) = found(:, k)
      end do
    end if
    status = report_to_handle(info, handle)
  end function c_body_recover_cases

  !> Forces, motions and statuses of `cases` cases; those without statuses have a solution. Errors: FUGE_ERR_POINTER,
  !> FUGE_ERR_MEMORY.
  subroutine copy_solutions(handle, cases, force, motion, statuses, solutions, info)
    type(body_handle), intent(in) :: handle
    integer, intent(in) :: cases
    type(c_ptr), intent(in) :: force, motion, statuses
    type(fuge_case_solutions), intent(out) :: solutions
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:, :)
    integer(c_int), pointer :: codes(:)
    integer :: m, n, stat

    n = size(handle%condensed%displacement)
    m = size(handle%condensed%resultant)
    call require_pointer(force, 'force', info)
    if (m > 0) call require_pointer(motion, 'motion', info)
    if (info%failed()) return
    allocate (solutions%force(n, cases), solutions%motion(m, cases), solutions%report(cases), stat=stat)
    call require_memory(stat, 'the solutions of', cases, 'load cases', info)
    if (stat /= 0) return
    call c_f_pointer(force, values, [n, cases])
    solutions%force = values
    if (m > 0) then
      call c_f_pointer(motion, values, [m, cases])
      solutions%motion = values
    end if
    if (.not. c_associated(statuses)) return
    call c_f_pointer(statuses, codes, [cases])
    solutions%report%status = int(codes)
  end subroutine copy_solutions

end module fuge_c_body_cases
