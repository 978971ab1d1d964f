!> C bindings, sections "half-plane", with analytic influence matrices and cells for them, and "edges of contact".
module fuge_c_halfplane
  use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_operator, only: find_matrix, new_operator
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_cell_grading, only: fuge_graded_cells
  use fuge_edge_refinement, only: fuge_contact_edges, fuge_interval
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE
  implicit none
  private

contains

  !> Ten arguments, as in the header: the cells, the symmetry, the matrix, the message.
  function c_halfplane_matrix(n, x, width, e_star, element, symmetric, alpha, lda, message, length) &
    bind(c, name='fuge_halfplane_matrix') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, lda
    type(c_ptr), intent(in), value :: x, width, alpha, message
    real(c_double), intent(in), value :: e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:), matrix(:, :)
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    call find_array(n, x, 'x', centre, info)
    call find_array(n, width, 'width', breadth, info)
    if (.not. info%failed()) &
      call fuge_halfplane_matrix(centre, breadth, e_star, int(element), matrix, info, symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_halfplane_matrix

  function c_operator_halfplane(n, spacing, e_star, element, boundary, destination, message, length) &
    bind(c, name='fuge_operator_halfplane') result(status)
    integer(c_int), intent(in), value :: n, element, boundary
    real(c_double), intent(in), value :: spacing, e_star
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_halfplane_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    allocate (surface)
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) call surface%set(int(n), spacing, e_star, info, int(element), int(boundary))
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_halfplane

  !> Eleven arguments, as in the header: the interval and its ends, the cells, the message.
  function c_graded_cells(left, right, left_end, right_end, left_beyond, right_beyond, n, x, width, message, length) &
    bind(c, name='fuge_graded_cells') result(status)
    real(c_double), intent(in), value :: left, right
    integer(c_int), intent(in), value :: left_end, right_end, left_beyond, right_beyond, n
    type(c_ptr), intent(in), value :: x, width, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info
    real(c_double), pointer :: centre(:), breadth(:)

    if (n < 1) call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//': at least one cell is needed')
    call find_array(n, x, 'x', centre, info)
    call find_array(n, width, 'width', breadth, info)
    if (.not. info%failed()) call fuge_graded_cells(left, right, int([left_end, right_end]), &
                                                    int([left_beyond, right_beyond]), centre, breadth, info)
    status = report_to_c(info, message, length)
  end function c_graded_cells

  !> Eighteen arguments, as in the header: cells, forces and their law, an array for each component of an interval, the
  !> message.
  function c_contact_edges(n, x, width, force, state, compliance, element, symmetric, capacity, left, right, &
                           left_error, right_error, left_kind, right_kind, number, message, length) &
    bind(c, name='fuge_contact_edges') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric, capacity
    type(c_ptr), intent(in), value :: x, width, force, state, compliance, left, right, left_error, right_error
    type(c_ptr), intent(in), value :: left_kind, right_kind, number, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:), forces(:), compliances(:)
    integer(c_int), pointer :: states(:)
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    integer :: count

    call require_count(n, 1, 'n', 'cells', info)
    call require_count(capacity, 0, 'capacity', 'elements of each array', info)
    call find_array(n, x, 'x', centre, info)
    call find_array(n, width, 'width', breadth, info)
    call find_array(n, force, 'force', forces, info)
    call require_pointer(number, 'count', info)
    ! Null: without states, without compliances.
    nullify (states, compliances)
    if (c_associated(state)) call find_array(n, state, 'state', states, info)
    if (c_associated(compliance)) call find_array(n, compliance, 'compliance', compliances, info)
    if (.not. info%failed()) call fuge_contact_edges(centre, breadth, forces, int(element), intervals, info, &
                                                     symmetric /= 0, states, compliances)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    count = min(size(intervals), int(capacity))
    call give(intervals(:count)%left, left)
    call give(intervals(:count)%right, right)
    call give(intervals(:count)%left_error, left_error)
    call give(intervals(:count)%right_error, right_error)
    call give(intervals(:count)%left_kind, left_kind)
    call give(intervals(:count)%right_kind, right_kind)
    call give(size(intervals), number)
  end function c_contact_edges

end module fuge_c_halfplane
