!> C bindings, section "half-space": influence matrices of rectangles, and grids of them.
module fuge_c_halfspace
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_operator, only: find_matrix, new_operator
  use fuge_c_types, only: report_to_c, require_pointer
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_influence, only: fuge_halfspace_matrix
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info
  implicit none
  private

contains

  !> Thirteen arguments, as in the header: the rectangles, the symmetry, the matrix, the message.
  function c_halfspace_matrix(n, x, y, width_x, width_y, e_star, element, symmetric_x, symmetric_y, alpha, lda, &
                              message, length) bind(c, name='fuge_halfspace_matrix') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric_x, symmetric_y, lda
    type(c_ptr), intent(in), value :: x, y, width_x, width_y, alpha, message
    real(c_double), intent(in), value :: e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre_x(:), centre_y(:), breadth_x(:), breadth_y(:), matrix(:, :)
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    call find_array(n, x, 'x', centre_x, info)
    call find_array(n, y, 'y', centre_y, info)
    call find_array(n, width_x, 'width_x', breadth_x, info)
    call find_array(n, width_y, 'width_y', breadth_y, info)
    if (.not. info%failed()) call fuge_halfspace_matrix(centre_x, centre_y, breadth_x, breadth_y, e_star, &
                                                        int(element), matrix, info, symmetric_x /= 0, symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_halfspace_matrix

  !> Ten arguments, as in the header: the grid, the operator, the message.
  function c_operator_halfspace(nx, ny, spacing_x, spacing_y, e_star, element, boundary, destination, message, length) &
    bind(c, name='fuge_operator_halfspace') result(status)
    integer(c_int), intent(in), value :: nx, ny, element, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y, e_star
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_halfspace_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    allocate (surface)
    call require_pointer(destination, 'op', info)
    if (.not. info%failed()) call surface%set(int(nx), int(ny), spacing_x, spacing_y, e_star, info, int(element), &
                                              int(boundary))
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_halfspace

end module fuge_c_halfspace
