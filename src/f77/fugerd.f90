!> FUGERD: displacements of the body of FUGECD under its load and the contact forces. Arguments in
!> doc/legacy.md.
subroutine fugerd(nd, s, lds, nfix, ifix, ufix, p, m, z, ldz, n, nw, idof, dn, &
                  f, q, u, resid, msg, info)
  use fuge_body_type, only: fuge_body
  use fuge_f77_body, only: check_body_sizes, set_body, recover_dense
  use fuge_f77_problem, only: check_dimensions
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: nd, lds, nfix, m, ldz, n, nw
  integer, intent(in) :: ifix(nfix), idof(nw, n)
  real(dp), intent(in) :: s(lds, nd), ufix(nfix), p(nd), z(ldz, m), dn(nw, n), f(n), q(m)
  real(dp), intent(inout) :: u(nd), resid
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_body) :: body
  type(fuge_info) :: outcome

  call check_body_sizes(nd, nfix, m, ldz, n, nw, outcome)
  if (.not. outcome%failed()) call check_dimensions(nd, 'ND', lds, 'LDS', outcome)
  if (.not. outcome%failed()) call set_body(ifix, ufix, p, z, idof, dn, body, outcome)
  if (.not. outcome%failed()) call recover_dense(s, body, f, q, u, outcome)
  info = outcome%status
  msg = outcome%message
  if (.not. outcome%failed()) resid = outcome%residual
end subroutine fugerd
