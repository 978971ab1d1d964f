!> C bindings, section "layers".
module fuge_c_layers
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_operator, only: find_matrix, new_operator
  use fuge_c_types, only: report_to_c, require_count, require_pointer
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_matrices, only: fuge_layered_halfplane_matrix, fuge_layered_halfspace_matrix, &
    fuge_layered_ring_matrix
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_layers

contains

  !> Thirteen arguments, as in the header: the cells, the layers, the other body, the boundary, the message.
  function c_operator_layered_halfplane(n, spacing, layers, thickness, young, poisson, bonded, e_star_other, element, &
                                        boundary, destination, message, length) &
    bind(c, name='fuge_operator_layered_halfplane') result(status)
    integer(c_int), intent(in), value :: n, layers, bonded, element, boundary
    real(c_double), intent(in), value :: spacing, e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_halfplane_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    allocate (surface)
    call require_pointer(destination, 'op', info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call surface%set(int(n), spacing, body%e_star(), info, int(element), int(boundary), &
                                              body=body%surface())
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_layered_halfplane

  !> Fifteen arguments, as in the header: the cells, the layers, the other body, the boundary, the message.
  function c_operator_layered_halfspace(nx, ny, spacing_x, spacing_y, layers, thickness, young, poisson, bonded, &
                                        e_star_other, element, boundary, destination, message, length) &
    bind(c, name='fuge_operator_layered_halfspace') result(status)
    integer(c_int), intent(in), value :: nx, ny, layers, bonded, element, boundary
    real(c_double), intent(in), value :: spacing_x, spacing_y, e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_halfspace_operator), allocatable :: surface
    class(fuge_operator), allocatable :: operator
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    allocate (surface)
    call require_pointer(destination, 'op', info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call surface%set(int(nx), int(ny), spacing_x, spacing_y, body%e_star(), info, &
                                              int(element), int(boundary), body=body%surface())
    call move_alloc(surface, operator)
    call new_operator(operator, destination, info)
    status = report_to_c(info, message, length)
  end function c_operator_layered_halfspace

  !> Fifteen arguments, as in the header: the layers, the other body, the cells, the symmetry, the matrix, the message.
  function c_layered_halfplane_matrix(layers, thickness, young, poisson, bonded, e_star_other, n, x, width, element, &
                                      symmetric, alpha, lda, message, length) &
    bind(c, name='fuge_layered_halfplane_matrix') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, symmetric, lda
    real(c_double), intent(in), value :: e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, width, alpha, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:), matrix(:, :)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    call find_array(n, x, 'x', centre, info)
    call find_array(n, width, 'width', breadth, info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call fuge_layered_halfplane_matrix(body, centre, breadth, int(element), matrix, info, &
                                                                symmetric /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfplane_matrix

  !> Eighteen arguments, as in the header: the layers, the other body, the rectangles, the symmetry, the matrix, the
  !> message.
  function c_layered_halfspace_matrix(layers, thickness, young, poisson, bonded, e_star_other, n, x, y, width_x, &
                                      width_y, element, symmetric_x, symmetric_y, alpha, lda, message, length) &
    bind(c, name='fuge_layered_halfspace_matrix') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, element, symmetric_x, symmetric_y, lda
    real(c_double), intent(in), value :: e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, x, y, width_x, width_y, alpha, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre_x(:), centre_y(:), breadth_x(:), breadth_y(:), matrix(:, :)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    call find_array(n, x, 'x', centre_x, info)
    call find_array(n, y, 'y', centre_y, info)
    call find_array(n, width_x, 'width_x', breadth_x, info)
    call find_array(n, width_y, 'width_y', breadth_y, info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call fuge_layered_halfspace_matrix(body, centre_x, centre_y, breadth_x, breadth_y, &
                                                                int(element), matrix, info, symmetric_x /= 0, &
                                                                symmetric_y /= 0)
    status = report_to_c(info, message, length)
  end function c_layered_halfspace_matrix

  !> Twelve arguments, as in the header: the layers, the other body, the rings, the matrix, the message.
  function c_layered_ring_matrix(layers, thickness, young, poisson, bonded, e_star_other, n, radius, alpha, lda, &
                                 message, length) bind(c, name='fuge_layered_ring_matrix') result(status)
    integer(c_int), intent(in), value :: layers, bonded, n, lda
    real(c_double), intent(in), value :: e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, radius, alpha, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: radii(:), matrix(:, :)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call find_matrix(n, alpha, lda, matrix, info)
    call require_room_for_one_more(n, 'n', 'rings have one radius more', info)
    if (.not. info%failed()) call find_array(n + 1, radius, 'radius', radii, info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call fuge_layered_ring_matrix(body, radii, matrix, info)
    status = report_to_c(info, message, length)
  end function c_layered_ring_matrix

  !> Eleven arguments, as in the header: the layers, the other body, the waves, the message.
  function c_layered_waves(layers, thickness, young, poisson, bonded, e_star_other, waves, q, compliance, message, &
                           length) bind(c, name='fuge_layered_waves') result(status)
    integer(c_int), intent(in), value :: layers, bonded, waves
    real(c_double), intent(in), value :: e_star_other
    type(c_ptr), intent(in), value :: thickness, young, poisson, q, compliance, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: wave_numbers(:), results(:)
    type(fuge_layered_body) :: body
    type(fuge_info) :: info

    call require_count(waves, 0, 'waves', 'waves', info)
    call find_array(waves, q, 'q', wave_numbers, info)
    call find_array(waves, compliance, 'compliance', results, info)
    call find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    if (.not. info%failed()) call body%find_compliances(wave_numbers, results, info)
    status = report_to_c(info, message, length)
  end function c_layered_waves

  !> The layers behind these arguments. Eight arguments, those of the header.
  subroutine find_layers(layers, thickness, young, poisson, bonded, e_star_other, body, info)
    integer(c_int), intent(in) :: layers, bonded
    type(c_ptr), intent(in) :: thickness, young, poisson
    real(c_double), intent(in) :: e_star_other
    type(fuge_layered_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: moduli(:), ratios(:), thicknesses(:)
    real(c_double), target :: none(0)
    logical, allocatable :: joined(:)
    integer :: stat

    call require_count(layers, 0, 'layers', 'layers', info)
    call require_room_for_one_more(layers, 'layers', 'young and poisson have one value more', info)
    thicknesses => none
    if (layers > 0) call find_array(layers, thickness, 'thickness', thicknesses, info)
    if (.not. info%failed()) then
      call find_array(layers + 1, young, 'young', moduli, info)
      call find_array(layers + 1, poisson, 'poisson', ratios, info)
    end if
    if (.not. info%failed() .and. all(bonded /= [0, 1])) call report(info, FUGE_ERR_OPTION, 'bonded is ' &
      //text(int(bonded))//': take 1 for bonded interfaces, or 0 for those that slide')
    if (info%failed()) return
    allocate (joined(layers), stat=stat)
    call require_memory(stat, '', int(layers), 'layers', info)
    if (stat /= 0) return
    joined = bonded /= 0
    call body%set(thicknesses, moduli, ratios, info, joined, e_star_other)
  end subroutine find_layers

  !> Refuse a number that is the largest integer where an array has one element more, because of what `reason` says
  !> (FUGE_ERR_SIZE), unless an error is known already.
  pure subroutine require_room_for_one_more(number, name, reason, info)
    integer(c_int), intent(in) :: number
    character(len=*), intent(in) :: name, reason
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. number < huge(number)) return
    call report(info, FUGE_ERR_SIZE, name//' = '//text(int(number))//' is too large: '//reason//' than that')
  end subroutine require_room_for_one_more

end module fuge_c_layers
