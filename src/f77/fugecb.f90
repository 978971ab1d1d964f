!> FUGECB: influence matrix of the contact points of an elastic body whose stiffness matrix is in
!> LAPACK's symmetric band storage. Arguments in doc/legacy.md.
subroutine fugecb(uplo, nd, kd, ab, ldab, nfix, ifix, ufix, p, m, z, ldz, n, nw, idof, dn, &
                  alpha, lda, b, r, ldr, w, nheld, msg, info)
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condensed
  use fuge_f77_body, only: check_body_sizes, condense_band, copy_condensed, set_body
  use fuge_f77_problem, only: check_dimensions, check_modes
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  character(len=1), intent(in) :: uplo
  integer, intent(in) :: nd, kd, ldab, nfix, m, ldz, n, nw, lda, ldr
  integer, intent(in) :: ifix(nfix), idof(nw, n)
  real(dp), intent(in) :: ab(ldab, nd), ufix(nfix), p(nd), z(ldz, m), dn(nw, n)
  real(dp), intent(inout) :: alpha(lda, n), b(n), r(ldr, m), w(m)
  integer, intent(inout) :: nheld(m)
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_body) :: body
  type(fuge_condensed) :: condensed
  type(fuge_info) :: outcome

  call check_body_sizes(nd, nfix, m, ldz, n, nw, outcome)
  if (.not. outcome%failed()) call check_dimensions(kd + 1, 'KD + 1', ldab, 'LDAB', outcome)
  if (.not. outcome%failed()) call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call check_modes(n, m, ldr, outcome)
  if (.not. outcome%failed()) call set_body(ifix, ufix, p, z, idof, dn, body, outcome)
  if (.not. outcome%failed()) call condense_band(uplo, kd, ab, body, condensed, outcome)
  info = outcome%status
  msg = outcome%message
  if (.not. outcome%failed()) call copy_condensed(body, condensed, alpha, b, r, w, nheld)
end subroutine fugecb
