!> FUGELP: every load, from none to the given one, at which a point comes into contact or leaves it. Arguments in
!> doc/legacy.md; `alpha` is not copied.
subroutine fugelp(n, alpha, lda, gap, f0, maxe, ne, fe, ve, rate, ipoint, istate, ncon, resid, msg, info)
  use fuge_f77_path, only: copy_events, follow_load
  use fuge_f77_problem, only: check_dimensions, check_room
  use fuge_kinds, only: dp
  use fuge_path_type, only: fuge_path
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, lda, maxe
  real(dp), intent(in) :: alpha(lda, n), gap(n), f0
  integer, intent(inout) :: ne, ipoint(maxe), istate(maxe), ncon(maxe)
  real(dp), intent(inout) :: fe(maxe), ve(1, maxe), rate(1, maxe), resid
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_path) :: path
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  call check_room(maxe, 'MAXE', outcome)
  if (.not. outcome%failed()) call follow_load(alpha, gap, f0, path, outcome)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  ne = path%entries
  resid = outcome%residual
  call copy_events(path, fe, ve, rate, ipoint, istate, ncon)
end subroutine fugelp
