!> C bindings, section "edges of contact".
module fuge_c_edges
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: copy_string, copy_reals, copy_integers
  use fuge_edge_refinement, only: fuge_contact_edges, fuge_interval
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER, FUGE_ERR_SIZE
  use fuge_number_text, only: text
  implicit none
  private

contains

  function c_contact_edges(n, x, width, force, element, symmetric, capacity, left, right, left_kind, right_kind, &
                           number, message, length) bind(c, name='fuge_contact_edges') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, capacity
    type(c_ptr), intent(in), value :: x, width, force, left, right, left_kind, right_kind, number, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:), push(:)
    integer(c_int), pointer :: found
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    integer :: count

    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//': at least one cell is needed')
    else if (capacity < 0) then
      call report(info, FUGE_ERR_SIZE, 'capacity is negative: it is the length of the arrays')
    else if (.not. (c_associated(x) .and. c_associated(width) .and. c_associated(force))) then
      call report(info, FUGE_ERR_POINTER, 'x, width or force is NULL')
    else if (.not. c_associated(number)) then
      call report(info, FUGE_ERR_POINTER, 'count is NULL')
    else
      call c_f_pointer(x, centre, [n])
      call c_f_pointer(width, breadth, [n])
      call c_f_pointer(force, push, [n])
      call fuge_contact_edges(centre, breadth, push, int(element), intervals, info, symmetric /= 0)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    count = min(size(intervals), int(capacity))
    call copy_reals(intervals(:count)%left, left)
    call copy_reals(intervals(:count)%right, right)
    call copy_integers(intervals(:count)%left_kind, left_kind)
    call copy_integers(intervals(:count)%right_kind, right_kind)
    call c_f_pointer(number, found)
    found = int(size(intervals), c_int)
  end function c_contact_edges

end module fuge_c_edges
