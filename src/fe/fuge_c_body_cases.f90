!> C bindings, section "condensation": load cases of a body.
module fuge_c_body_cases
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_body, only: body_handle, find_body, find_condensed
  use fuge_c_types, only: report_failure, report_to_c, report_to_handle, require_count, require_pointer
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE, &
    FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_WARN_CASES
  implicit none
  private

contains

  function c_body_get_cases(body, cases, loads, supports, displacement, resultant, statuses) &
    bind(c, name='fuge_body_get_cases') result(status)
    type(c_ptr), intent(in), value :: body, loads, supports, displacement, resultant, statuses
    integer(c_int), intent(in), value :: cases
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: forces(:, :), displaced(:, :)
    real(c_double), allocatable :: no_gap(:)
    type(fuge_problem) :: problem
    type(fuge_load_cases) :: found
    type(fuge_info) :: info
    integer :: k, stat

    call find_condensed(body, handle, info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    if (.not. info%failed()) then
      call find_array(handle%degrees, cases, loads, 'loads', forces, info)
      call find_supports(handle, cases, supports, displaced)
      ! Without a motion of the ground.
      associate (n => size(handle%condensed%displacement))
        allocate (no_gap(n), problem%modes(n, 0), problem%resultant(0), stat=stat)
        call require_memory(stat, 'the gaps of', n, 'contact points', info)
      end associate
    end if
    if (.not. info%failed()) then
      no_gap = 0.0_c_double
      call handle%condensed%pose_cases(no_gap, forces, problem, found, info, displaced)
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
      call move_alloc(found%refused, handle%case_reports)
    end if
    status = report_to_handle(info, handle)
  end function c_body_get_cases

  !> Displacements of the supports in each case; nowhere if the caller gives none.
  subroutine find_supports(handle, cases, address, displaced)
    type(body_handle), intent(in) :: handle
    integer(c_int), intent(in) :: cases
    type(c_ptr), intent(in) :: address
    real(c_double), pointer, intent(out) :: displaced(:, :)
    integer :: fixed

    nullify (displaced)
    if (.not. c_associated(address)) return
    fixed = 0
    if (allocated(handle%body%fixed)) fixed = size(handle%body%fixed)
    call c_f_pointer(address, displaced, [fixed, int(cases)])
  end subroutine find_supports

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

  function c_body_recover_cases(body, cases, loads, supports, force, motion, displacement, statuses) &
    bind(c, name='fuge_body_recover_cases') result(status)
    type(c_ptr), intent(in), value :: body, loads, supports, force, motion, displacement, statuses
    integer(c_int), intent(in), value :: cases
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    real(c_double), pointer :: displaced(:, :), forces(:, :), results(:, :)
    type(fuge_case_solutions) :: solutions
    type(fuge_info) :: info

    call find_condensed(body, handle, info)
    call require_count(cases, 1, 'cases', 'load cases', info)
    if (.not. info%failed()) then
      call find_array(handle%degrees, cases, loads, 'loads', forces, info)
      call copy_solutions(handle, int(cases), force, motion, statuses, solutions, info)
      call find_supports(handle, cases, supports, displaced)
      call find_array(handle%degrees, cases, displacement, 'displacement', results, info)
    end if
    if (.not. info%failed()) call handle%condensed%recover_cases(forces, solutions, results, info, displaced)
    if (.not. info%failed()) call move_alloc(solutions%report, handle%case_reports)
    status = report_to_handle(info, handle)
  end function c_body_recover_cases

  function c_body_case_message(body, which, buffer, length) bind(c, name='fuge_body_case_message') result(status)
    type(c_ptr), intent(in), value :: body, buffer
    integer(c_int), intent(in), value :: which
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(body, handle, info)
    call require_pointer(buffer, 'message', info)
    if (.not. info%failed()) then
      if (.not. allocated(handle%case_reports)) then
        call report(info, FUGE_ERR_CALL_ORDER, 'there are no load cases: call fuge_body_get_cases first')
      else if (which < 0 .or. which >= size(handle%case_reports)) then
        call report(info, FUGE_ERR_SIZE, 'which = '//text(int(which))//' is no load case: there are ' &
                    //text(size(handle%case_reports))//', which count from 0')
      end if
    end if
    status = report_failure(info, handle)
    if (info%failed()) return
    status = report_to_c(handle%case_reports(which + 1), buffer, length)
    ! That of the case is not the status of this call.
    status = FUGE_DONE
  end function c_body_case_message

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
