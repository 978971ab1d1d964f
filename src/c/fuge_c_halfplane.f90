!> C bindings, section "half-plane": analytic influence matrices.
module fuge_c_halfplane
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: copy_string
  use fuge_halfplane_influence, only: fuge_halfplane_matrix, check_halfplane
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER, FUGE_ERR_SIZE
  use fuge_number_text, only: text
  implicit none
  private

contains

  function c_halfplane_matrix(n, x, width, e_star, element, alpha, lda) &
    bind(c, name='fuge_halfplane_matrix') result(status)
    integer(c_int), intent(in), value :: n, element, lda
    type(c_ptr), intent(in), value :: x, width, alpha
    real(c_double), intent(in), value :: e_star
    integer(c_int) :: status

    status = fill(n, x, width, e_star, element, .false., alpha, lda)
  end function c_halfplane_matrix

  function c_halfplane_symmetric_matrix(n, x, width, e_star, element, alpha, lda) &
    bind(c, name='fuge_halfplane_symmetric_matrix') result(status)
    integer(c_int), intent(in), value :: n, element, lda
    type(c_ptr), intent(in), value :: x, width, alpha
    real(c_double), intent(in), value :: e_star
    integer(c_int) :: status

    status = fill(n, x, width, e_star, element, .true., alpha, lda)
  end function c_halfplane_symmetric_matrix

  !> Checks of the two above, with the message they have no place for.
  function c_check_halfplane(n, x, width, e_star, element, symmetric, message, length) &
    bind(c, name='fuge_check_halfplane') result(status)
    integer(c_int), intent(in), value :: n, element, symmetric
    type(c_ptr), intent(in), value :: x, width, message
    real(c_double), intent(in), value :: e_star
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:)
    type(fuge_info) :: info

    call take_cells(n, x, width, centre, breadth, info)
    if (.not. info%failed()) call check_halfplane(centre, breadth, e_star, int(element), symmetric /= 0, info)
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_check_halfplane

  function fill(n, x, width, e_star, element, symmetric, alpha, lda) result(status)
    integer(c_int), intent(in) :: n, element, lda
    type(c_ptr), intent(in) :: x, width, alpha
    real(c_double), intent(in) :: e_star
    logical, intent(in) :: symmetric
    integer(c_int) :: status
    real(c_double), pointer :: centre(:), breadth(:), matrix(:, :)
    type(fuge_info) :: info

    call take_cells(n, x, width, centre, breadth, info)
    if (.not. info%failed() .and. .not. c_associated(alpha)) call report(info, FUGE_ERR_POINTER, 'alpha is NULL')
    if (.not. info%failed() .and. lda < n) call report(info, FUGE_ERR_SIZE, 'lda < n')
    if (.not. info%failed()) then
      call c_f_pointer(alpha, matrix, [lda, n])
      call fuge_halfplane_matrix(centre, breadth, e_star, int(element), matrix, info, symmetric)
    end if
    status = int(info%status, c_int)
  end function fill

  subroutine take_cells(n, x, width, centre, breadth, info)
    integer(c_int), intent(in) :: n
    type(c_ptr), intent(in) :: x, width
    real(c_double), pointer, intent(out) :: centre(:), breadth(:)
    type(fuge_info), intent(inout) :: info

    nullify (centre, breadth)
    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//': at least one cell is needed')
    else if (.not. c_associated(x)) then
      call report(info, FUGE_ERR_POINTER, 'x is NULL')
    else if (.not. c_associated(width)) then
      call report(info, FUGE_ERR_POINTER, 'width is NULL')
    else
      call c_f_pointer(x, centre, [n])
      call c_f_pointer(width, breadth, [n])
    end if
  end subroutine take_cells

end module fuge_c_halfplane
