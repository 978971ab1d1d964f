!> C bindings, section "load path".
module fuge_c_path
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_arrays, only: give
  use fuge_c_operator, only: find_operator, operator_handle
  use fuge_c_solver, only: find_solver, require_problem, solver_handle
  use fuge_c_types, only: report_to_c, report_to_handle, require_count, require_pointer
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_path_type, only: fuge_path
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Thirteen arguments, as in the header: the problem, an array for each component of an entry, the message.
  function c_load_path(operator, gap, load, capacity, parameter, motion, rate, point, state, contacts, entries, &
                       message, length) bind(c, name='fuge_load_path') result(status)
    type(c_ptr), intent(in), value :: operator, gap, parameter, motion, rate, point, state, contacts, entries, message
    real(c_double), intent(in), value :: load
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    real(c_double), pointer :: initial(:)
    type(fuge_path) :: path
    type(fuge_info) :: info

    call find_operator(operator, 'op', handle, info)
    call require_pointer(gap, 'gap', info)
    call require_pointer(entries, 'entries', info)
    call require_count(capacity, 0, 'capacity', 'entries that fit into the arrays', info)
    if (.not. info%failed()) then
      call c_f_pointer(gap, initial, [handle%operator%points()])
      call fuge_load_path(handle%operator, initial, load, path, info)
    end if
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call give_path(path, int(capacity), parameter, motion, rate, point, state, contacts)
    call give(path%entries, entries)
  end function c_load_path

  !> Ten arguments, as in the header: the end of the path, and an array for each component of an entry.
  function c_follow_path(solver, finish, capacity, parameter, motion, rate, point, state, contacts, entries) &
    bind(c, name='fuge_follow_path') result(status)
    type(c_ptr), intent(in), value :: solver, finish, parameter, motion, rate, point, state, contacts, entries
    integer(c_int), intent(in), value :: capacity
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(c_double), pointer :: values(:)
    type(fuge_path) :: path
    type(fuge_info) :: info

    call find_solver(solver, handle, info)
    call require_pointer(finish, 'finish', info)
    call require_pointer(entries, 'entries', info)
    call require_count(capacity, 0, 'capacity', 'entries that fit into the arrays', info)
    if (.not. info%failed()) call require_problem(handle, 'fuge_follow_path', info)
    if (.not. info%failed()) then
      call c_f_pointer(finish, values, [handle%problem%mode_count()])
      call fuge_follow_path(handle%operator%operator, handle%problem, values, path, info)
    end if
    status = report_to_handle(info, handle)
    if (info%failed()) return
    call give_path(path, int(capacity), parameter, motion, rate, point, state, contacts)
    call give(path%entries, entries)
  end function c_follow_path

  !> Copy the first entries of a path to the arrays that are not NULL; points count from 0.
  subroutine give_path(path, capacity, parameter, motion, rate, point, state, contacts)
    type(fuge_path), intent(in) :: path
    integer, intent(in) :: capacity
    type(c_ptr), intent(in) :: parameter, motion, rate, point, state, contacts
    integer :: last

    last = min(path%entries, capacity)
    call give(path%parameter(:last), parameter)
    call give(path%motion(:, :last), motion)
    call give(path%rate(:, :last), rate)
    call give(path%point(:last) - 1, point)
    call give(path%state(:last), state)
    call give(path%contacts(:last), contacts)
  end subroutine give_path

end module fuge_c_path
