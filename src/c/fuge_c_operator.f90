!> C bindings, section "operators".
module fuge_c_operator
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_null_ptr, c_loc, c_associated, c_f_pointer
  use fuge_c_types, only: operator_handle, copy_string
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_POINTER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY
  use fuge_number_text, only: text
  implicit none
  private

  public :: take_matrix, hand_over

contains

  function c_operator_dense(n, alpha, lda, destination) bind(c, name='fuge_operator_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, destination
    integer(c_int) :: status
    type(fuge_dense_operator), allocatable :: matrix
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. c_associated(destination)) return
    allocate (matrix)
    call take_matrix(n, alpha, lda, matrix, info)
    call move_alloc(matrix, operator)
    status = int(info%status, c_int)
    if (.not. info%failed()) status = hand_over(operator, destination)
  end function c_operator_dense

  function c_operator_halfplane(n, spacing, e_star, element, boundary, destination) &
    bind(c, name='fuge_operator_halfplane') result(status)
    integer(c_int), intent(in), value :: n, element, boundary
    real(c_double), intent(in), value :: spacing, e_star
    type(c_ptr), intent(in), value :: destination
    integer(c_int) :: status
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. c_associated(destination)) return
    call make_halfplane(n, spacing, e_star, element, boundary, operator, info)
    status = int(info%status, c_int)
    if (.not. info%failed()) status = hand_over(operator, destination)
  end function c_operator_halfplane

  !> The same without the operator, and with the message it has no place for.
  function c_check_operator_halfplane(n, spacing, e_star, element, boundary, message, length) &
    bind(c, name='fuge_check_operator_halfplane') result(status)
    integer(c_int), intent(in), value :: n, element, boundary
    real(c_double), intent(in), value :: spacing, e_star
    type(c_ptr), intent(in), value :: message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    class(fuge_operator), allocatable :: operator
    type(fuge_info) :: info

    call make_halfplane(n, spacing, e_star, element, boundary, operator, info)
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_check_operator_halfplane

  subroutine make_halfplane(n, spacing, e_star, element, boundary, operator, info)
    integer(c_int), intent(in) :: n, element, boundary
    real(c_double), intent(in) :: spacing, e_star
    class(fuge_operator), allocatable, intent(out) :: operator
    type(fuge_info), intent(out) :: info
    type(fuge_halfplane_operator), allocatable :: surface

    allocate (surface)
    call surface%set(int(n), spacing, e_star, info, int(element), int(boundary))
    call move_alloc(surface, operator)
  end subroutine make_halfplane

  !> Put `operator` behind a handle at `destination`; FUGE_ERR_MEMORY.
  function hand_over(operator, destination) result(status)
    class(fuge_operator), allocatable, intent(inout) :: operator
    type(c_ptr), intent(in) :: destination
    integer(c_int) :: status
    type(operator_handle), pointer :: handle
    type(c_ptr), pointer :: slot
    integer :: stat

    status = FUGE_ERR_MEMORY
    allocate (handle, stat=stat)
    if (stat /= 0) return
    ! Moved, not copied: an operator may own what must not be shared.
    call move_alloc(operator, handle%operator)
    call c_f_pointer(destination, slot)
    slot = c_loc(handle)
    status = FUGE_DONE
  end function hand_over

  !> Point an operator to a C matrix, with all checks and their messages.
  subroutine take_matrix(n, alpha, lda, operator, info)
    integer(c_int), intent(in) :: n, lda
    type(c_ptr), intent(in) :: alpha
    type(fuge_dense_operator), intent(out) :: operator
    type(fuge_info), intent(out) :: info
    real(c_double), pointer :: matrix(:, :)

    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'n = '//text(int(n))//': at least one point is needed')
    else if (lda < n) then
      call report(info, FUGE_ERR_SIZE, 'lda = '//text(int(lda))//' is less than n = '//text(int(n)) &
                  //': it is the distance between columns, in doubles')
    else if (.not. c_associated(alpha)) then
      call report(info, FUGE_ERR_POINTER, 'alpha is NULL')
    else
      call c_f_pointer(alpha, matrix, [lda, n])
      call operator%set(matrix, info)
    end if
  end subroutine take_matrix

  subroutine c_operator_free(source) bind(c, name='fuge_operator_free')
    type(c_ptr), intent(in), value :: source
    type(operator_handle), pointer :: handle
    type(c_ptr), pointer :: slot

    if (.not. c_associated(source)) return
    call c_f_pointer(source, slot)
    if (.not. c_associated(slot)) return
    call c_f_pointer(slot, handle)
    ! Apart, because flang 22 would leak what an extension of fuge_operator has allocated.
    deallocate (handle%operator)
    deallocate (handle)
    slot = c_null_ptr
  end subroutine c_operator_free

end module fuge_c_operator
