!> C bindings, section "one call".
module fuge_c_dense
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_operator, only: take_matrix
  use fuge_c_types, only: copy_string
  use fuge_dense, only: fuge_dense_operator
  use fuge_problem_type, only: fuge_problem, check_problem, set_problem
  use fuge_solver_type, only: fuge_solve_dense, check_solvable
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
    type(fuge_info) :: info

    if (.not. (c_associated(gap) .and. c_associated(force) .and. c_associated(gap_out) &
               .and. c_associated(approach))) then
      status = FUGE_ERR_POINTER
      return
    end if
    call solve_into(n, alpha, lda, gap, load, force, gap_out, approach, info)
    status = int(info%status, c_int)
  end function c_solve_dense

  !> Solve beside the caller's arrays, which may overlap, and copy at the end.
  subroutine solve_into(n, alpha, lda, gap, load, force, gap_out, approach, info)
    integer(c_int), intent(in) :: n, lda
    type(c_ptr), intent(in) :: alpha, gap, force, gap_out, approach
    real(c_double), intent(in) :: load
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    real(c_double), pointer :: initial(:), values(:), single
    real(c_double), allocatable :: f(:), c(:)
    real(c_double) :: v
    integer :: stat

    call take_matrix(n, alpha, lda, operator, info)
    if (info%failed()) return
    allocate (f(n), c(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the answer')
      return
    end if
    call c_f_pointer(gap, initial, [n])
    call fuge_solve_dense(operator%alpha, initial, load, f, c, v, info)
    if (info%failed()) return
    call c_f_pointer(force, values, [n])
    values = f
    call c_f_pointer(gap_out, values, [n])
    values = c
    call c_f_pointer(approach, single)
    single = v
  end subroutine solve_into

  !> Checks of the data, with the message that `fuge_solve_dense` has no place for.
  function c_check_dense(n, alpha, lda, gap, load, message, length) &
    bind(c, name='fuge_check_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, gap, message
    real(c_double), intent(in), value :: load
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    real(c_double), pointer :: values(:)

    call take_matrix(n, alpha, lda, operator, info)
    if (.not. info%failed() .and. .not. c_associated(gap)) call report(info, FUGE_ERR_POINTER, 'gap is NULL')
    if (.not. info%failed()) then
      call c_f_pointer(gap, values, [n])
      call set_problem(values, load, problem, info)
      if (.not. info%failed()) call check_problem(problem, int(n), info)
      if (.not. info%failed() .and. load > 0.0_c_double) call check_solvable(operator%alpha, load, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_check_dense

end module fuge_c_dense
