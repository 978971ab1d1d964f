!> C bindings, section "half-plane": analytic influence matrices, and cells for them.
module fuge_c_halfplane
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_operator, only: find_matrix
  use fuge_c_types, only: report_to_c
  use fuge_cell_grading, only: fuge_graded_cells
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_number_text, only: text
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

end module fuge_c_halfplane
