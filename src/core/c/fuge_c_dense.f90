!> C bindings, section "one call".
module fuge_c_dense
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_f_pointer
  use fuge_c_operator, only: find_matrix
  use fuge_c_types, only: copy_reals, report_to_c, require_pointer
  use fuge_solver_type, only: fuge_solve_dense
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

contains

  !> Ten arguments, as in the header: the matrix with its sizes, three results, the message.
  function c_solve_dense(n, alpha, lda, gap, load, force, gap_out, approach, message, length) &
    bind(c, name='fuge_solve_dense') result(status)
    integer(c_int), intent(in), value :: n, lda
    type(c_ptr), intent(in), value :: alpha, gap, force, gap_out, approach, message
    real(c_double), intent(in), value :: load
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: matrix(:, :), initial(:)
    real(c_double), allocatable :: f(:), c(:)
    real(c_double) :: v
    type(fuge_info) :: info
    integer :: stat

    call find_matrix(n, alpha, lda, matrix, info)
    call require_pointer(gap, 'gap', info)
    call require_pointer(force, 'force', info)
    call require_pointer(gap_out, 'gap_out', info)
    call require_pointer(approach, 'approach', info)
    if (.not. info%failed()) then
      call c_f_pointer(gap, initial, [n])
      ! Arrays of the caller may overlap.
      allocate (f(n), c(n), stat=stat)
      call require_memory(stat, 'the forces and gaps', info)
    end if
    if (.not. info%failed()) call fuge_solve_dense(matrix, initial, load, f, c, v, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call copy_reals(f, force)
    call copy_reals(c, gap_out)
    call copy_reals([v], approach)
  end function c_solve_dense

end module fuge_c_dense
