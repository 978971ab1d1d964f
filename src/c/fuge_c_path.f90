!> C bindings, section "load path".
module fuge_c_path
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_solver, only: find_solver, report_to_solver, require_problem
  use fuge_c_types, only: operator_handle, solver_handle, copy_integers, copy_reals, report_to_c, require_count, &
    require_pointer
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_path_type, only: fuge_path
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Twelve arguments, as in the header: the scene, an array for each part of an event, the message.
  function c_load_path(operator, gap, load, capacity, loads, approach, stiffness, point, contacts, events, &
                       message, length) bind(c, name='fuge_load_path') result(status)
    type(c_ptr), intent(in), value :: operator, gap, loads, approach, stiffness, point, contacts, events, message
    real(c_double), intent(in), value :: load
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    real(c_double), pointer :: initial(:)
    type(fuge_path) :: path
    type(fuge_info) :: info
    integer :: last

    call require_pointer(operator, 'op', info)
    call require_pointer(gap, 'gap', info)
    call require_pointer(events, 'events', info)
    call require_count(capacity, 0, 'capacity', 'elements of each array', info)
    if (.not. info%failed()) then
      call c_f_pointer(operator, handle)
      call c_f_pointer(gap, initial, [handle%operator%points()])
      call fuge_load_path(handle%operator, initial, load, path, info)
    end if
    status = report_to_c(info, message, length)
    if (info%failed()) return
    ! The start, without load, is no event here.
    last = 1 + min(path%entries - 1, int(capacity))
    call copy_reals(path%parameter(2:last), loads)
    call copy_reals(path%motion(1, 2:last), approach)
    call copy_reals(1.0_c_double/path%rate(1, 2:last), stiffness)
    call copy_integers(merge(path%point(2:last), -path%point(2:last), path%state(2:last) /= 0), point)
    call copy_integers(path%contacts(2:last), contacts)
    call copy_integers([path%entries - 1], events)
  end function c_load_path

  !> Ten arguments, as in the header: the end of the path, and an array for each part of an entry.
  function c_follow_path(solver, finish, capacity, parameter, motion, rate, point, state, contacts, entries) &
    bind(c, name='fuge_follow_path') result(status)
    type(c_ptr), intent(in), value :: solver, finish, parameter, motion, rate, point, state, contacts, entries
    integer(c_int), intent(in), value :: capacity
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(c_double), pointer :: values(:)
    type(fuge_path) :: path
    type(fuge_info) :: info
    integer :: count

    call find_solver(solver, handle, info)
    call require_pointer(finish, 'finish', info)
    call require_pointer(entries, 'entries', info)
    call require_count(capacity, 0, 'capacity', 'entries that fit into the arrays', info)
    if (.not. info%failed()) call require_problem(handle, 'fuge_follow_path', info)
    if (.not. info%failed()) then
      call c_f_pointer(finish, values, [handle%problem%mode_count()])
      call fuge_follow_path(handle%operator%operator, handle%problem, values, path, info)
    end if
    status = report_to_solver(info, handle)
    if (info%failed()) return
    count = min(path%entries, int(capacity))
    call copy_reals(path%parameter(:count), parameter)
    call copy_reals([path%motion(:, :count)], motion)
    call copy_reals([path%rate(:, :count)], rate)
    call copy_integers(path%point(:count), point)
    call copy_integers(path%state(:count), state)
    call copy_integers(path%contacts(:count), contacts)
    call copy_integers([path%entries], entries)
  end function c_follow_path

end module fuge_c_path
