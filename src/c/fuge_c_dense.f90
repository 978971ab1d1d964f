!> C bindings, section "one call".
module fuge_c_dense
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_operator, only: take_matrix
  use fuge_c_types, only: copy_string
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_solver_type, only: fuge_solve_dense
  use fuge_status, only: fuge_info, report, FUGE_ERR_POINTER, FUGE_ERR_MEMORY
  implicit none
  private

contains

  function c_solve_dense(n, alpha, lda, gap, load, force, gap_out, approach) &
    bind(c, name='fuge_solve_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, gap, force, gap_out, approach
    real(c_double), intent(in), value :: load
    integer(c_int) :: status
    real(c_double), allocatable :: f(:), c(:)
    real(c_double), pointer :: values(:), single
    real(c_double) :: v
    type(fuge_info) :: info

    status = FUGE_ERR_POINTER
    if (.not. (c_associated(force) .and. c_associated(gap_out) .and. c_associated(approach))) return
    call solve_beside(n, alpha, lda, gap, load, f, c, v, info)
    status = int(info%status, c_int)
    if (info%failed()) return
    call c_f_pointer(force, values, [n])
    values = f
    call c_f_pointer(gap_out, values, [n])
    values = c
    call c_f_pointer(approach, single)
    single = v
  end function c_solve_dense

  !> What `fuge_solve_dense` returns, with the message it has no place for.
  function c_check_dense(n, alpha, lda, gap, load, message, length) &
    bind(c, name='fuge_check_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, gap, message
    real(c_double), intent(in), value :: load
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), allocatable :: f(:), c(:)
    real(c_double) :: v
    type(fuge_info) :: info

    call solve_beside(n, alpha, lda, gap, load, f, c, v, info)
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_check_dense

  !> Solve into arrays of its own: the caller's may overlap.
  subroutine solve_beside(n, alpha, lda, gap, load, force, gap_out, approach, info)
    integer(c_int), intent(in) :: n, lda
    type(c_ptr), intent(in) :: alpha, gap
    real(c_double), intent(in) :: load
    real(c_double), allocatable, intent(out) :: force(:), gap_out(:)
    real(c_double), intent(out) :: approach
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    real(c_double), pointer :: initial(:)
    integer :: stat

    approach = 0.0_c_double
    call take_matrix(n, alpha, lda, operator, info)
    if (.not. info%failed() .and. .not. c_associated(gap)) call report(info, FUGE_ERR_POINTER, 'gap is NULL')
    if (info%failed()) return
    allocate (force(n), gap_out(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the answer')
      return
    end if
    call c_f_pointer(gap, initial, [n])
    call fuge_solve_dense(operator%alpha, initial, load, force, gap_out, approach, info)
  end subroutine solve_beside

end module fuge_c_dense
