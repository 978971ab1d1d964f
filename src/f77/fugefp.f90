!> FUGEFP: every event on the way from one general problem to another with other resultants and prescribed motions.
!> Arguments in doc/legacy.md; `alpha` is not copied.
subroutine fugefp(n, m, alpha, lda, gap, nstop, play, r, ldr, nheld, w, q, wend, maxe, &
                  ne, nstart, te, qe, rate, ipoint, istate, ncon, resid, msg, info)
  use fuge_f77_path, only: copy_events, follow_problem
  use fuge_f77_problem, only: check_dimensions, check_modes, check_room, prescribe_motions, set_general_problem
  use fuge_kinds, only: dp
  use fuge_path_type, only: fuge_path
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, m, lda, ldr, nstop(n), nheld(m), maxe
  real(dp), intent(in) :: alpha(lda, n), gap(n), play(n), r(ldr, m), w(m), q(m), wend(m)
  integer, intent(inout) :: ne, nstart(n), ipoint(maxe), istate(maxe), ncon(maxe)
  real(dp), intent(inout) :: te(maxe), qe(m, maxe), rate(m, maxe), resid
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_problem) :: problem
  type(fuge_path) :: path
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call check_modes(n, m, ldr, outcome)
  call check_room(maxe, 'MAXE', outcome)
  if (.not. outcome%failed()) call set_general_problem(gap, nstop, play, r, w, problem, outcome)
  if (.not. outcome%failed()) call prescribe_motions(nheld, q, problem, outcome)
  if (.not. outcome%failed()) call follow_problem(alpha, problem, wend, path, outcome)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  ne = path%entries
  nstart = path%start
  resid = outcome%residual
  call copy_events(path, te, qe, rate, ipoint, istate, ncon)
end subroutine fugefp
