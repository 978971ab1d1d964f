!> C bindings, section "load path".
module fuge_c_path
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_solver, only: take_solver, require_problem
  use fuge_c_types, only: operator_handle, solver_handle, copy_string, copy_reals, copy_integers
  use fuge_contact_path, only: fuge_follow_path, fuge_load_path
  use fuge_path_type, only: fuge_path
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER, FUGE_ERR_SIZE
  implicit none
  private

contains

  function c_load_path(operator, gap, load, capacity, loads, approach, stiffness, point, contacts, events, &
                       message, length) bind(c, name='fuge_load_path') result(status)
    type(c_ptr), intent(in), value :: operator, gap, loads, approach, stiffness, point, contacts, events, message
    real(c_double), intent(in), value :: load
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    real(c_double), pointer :: initial(:)
    integer(c_int), pointer :: number
    type(fuge_path) :: path
    type(fuge_info) :: info
    integer :: last

    if (.not. (c_associated(operator) .and. c_associated(gap) .and. c_associated(events))) then
      call report(info, FUGE_ERR_POINTER, 'operator, gap or events is NULL')
    else if (capacity < 0) then
      call report(info, FUGE_ERR_SIZE, 'capacity is negative: it is the length of the arrays')
    else
      call c_f_pointer(operator, handle)
      call c_f_pointer(gap, initial, [handle%operator%points()])
      call fuge_load_path(handle%operator, initial, load, path, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    ! The start, without load, is no event here.
    last = 1 + min(path%entries - 1, int(capacity))
    call copy_reals(path%parameter(2:last), loads)
    call copy_reals(path%motion(1, 2:last), approach)
    call copy_reals(1.0_c_double/path%rate(1, 2:last), stiffness)
    call copy_integers(merge(path%point(2:last), -path%point(2:last), path%state(2:last) /= 0), point)
    call copy_integers(path%contacts(2:last), contacts)
    call c_f_pointer(events, number)
    number = int(path%entries - 1, c_int)
  end function c_load_path

  function c_follow_path(solver, finish, capacity, parameter, motion, rate, point, state, contacts, entries, message, &
                         length) bind(c, name='fuge_follow_path') result(status)
    type(c_ptr), intent(in), value :: solver, finish, parameter, motion, rate, point, state, contacts, entries, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(solver_handle), pointer :: handle
    real(c_double), pointer :: values(:)
    integer(c_int), pointer :: number
    type(fuge_path) :: path
    type(fuge_info) :: info
    integer :: count

    call take_solver(solver, handle, info)
    if (.not. info%failed()) then
      if (.not. (c_associated(finish) .and. c_associated(entries))) then
        call report(info, FUGE_ERR_POINTER, 'finish or entries is NULL')
      else if (capacity < 0) then
        call report(info, FUGE_ERR_SIZE, 'capacity is negative: it is the length of the arrays')
      else
        call require_problem(handle, 'fuge_follow_path', info)
      end if
    end if
    if (.not. info%failed()) then
      call c_f_pointer(finish, values, [handle%problem%mode_count()])
      call fuge_follow_path(handle%operator%operator, handle%problem, values, path, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    count = min(path%entries, int(capacity))
    call copy_reals(path%parameter(:count), parameter)
    call copy_reals([path%motion(:, :count)], motion)
    call copy_reals([path%rate(:, :count)], rate)
    call copy_integers(path%point(:count), point)
    call copy_integers(path%state(:count), state)
    call copy_integers(path%contacts(:count), contacts)
    call c_f_pointer(entries, number)
    number = int(path%entries, c_int)
  end function c_follow_path

end module fuge_c_path
