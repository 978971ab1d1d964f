!> FUGEHX: the influence matrix of cells on a half-plane. Arguments in doc/legacy.md.
subroutine fugehx(n, x, width, estar, nelem, nsym, alpha, lda, msg, info)
  use fuge_f77_problem, only: check_dimensions
  use fuge_halfplane_influence, only: fuge_halfplane_matrix
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, nelem, nsym, lda
  real(dp), intent(in) :: x(n), width(n), estar
  real(dp), intent(inout) :: alpha(lda, n)
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call fuge_halfplane_matrix(x, width, estar, nelem, alpha, outcome, nsym /= 0)
  info = outcome%status
  msg = outcome%message
end subroutine fugehx
