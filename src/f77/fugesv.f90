!> FUGESV: the contact problem of one translation under a load. Arguments in doc/legacy.md;
!> `alpha` is not copied.
subroutine fugesv(n, alpha, lda, gap, f0, f, c, v0, info)
  use fuge_f77_problem, only: check_dimensions
  use fuge_kinds, only: dp
  use fuge_solver_type, only: fuge_solve_dense
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, lda
  real(dp), intent(in) :: alpha(lda, n), gap(n), f0
  real(dp), intent(inout) :: f(n), c(n), v0
  integer, intent(out) :: info
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call fuge_solve_dense(alpha, gap, f0, f, c, v0, outcome)
  info = outcome%status
end subroutine fugesv
