!> FUGERB: displacements of the body of FUGECB under its load and the contact forces. Arguments in
!> doc/legacy.md.
subroutine fugerb(uplo, nd, kd, ab, ldab, nfix, ifix, ufix, p, m, z, ldz, n, nw, idof, dn, &
                  f, q, u, resid, msg, info)
  use fuge_body_type, only: fuge_body
  use fuge_f77_body, only: check_body_sizes, set_body, recover_band
  use fuge_f77_problem, only: check_dimensions
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  character(len=1), intent(in) :: uplo
  integer, intent(in) :: nd, kd, ldab, nfix, m, ldz, n, nw
  integer, intent(in) :: ifix(nfix), idof(nw, n)
  real(dp), intent(in) :: ab(ldab, nd), ufix(nfix), p(nd), z(ldz, m), dn(nw, n), f(n), q(m)
  real(dp), intent(inout) :: u(nd), resid
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_body) :: body
  type(fuge_info) :: outcome

  call check_body_sizes(nd, nfix, m, ldz, n, nw, outcome)
  if (.not. outcome%failed()) call check_dimensions(kd + 1, 'KD + 1', ldab, 'LDAB', outcome)
  if (.not. outcome%failed()) call set_body(ifix, ufix, p, z, idof, dn, body, outcome)
  if (.not. outcome%failed()) call recover_band(uplo, kd, ab, body, f, q, u, outcome)
  info = outcome%status
  msg = outcome%message
  if (.not. outcome%failed()) resid = outcome%residual
end subroutine fugerb
