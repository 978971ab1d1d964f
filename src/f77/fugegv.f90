!> FUGEGV: general problems with rigid motions, two stops and excluded points. Arguments in
!> doc/legacy.md; `alpha` is not copied.
subroutine fugegv(n, m, alpha, lda, gap, nstop, play, r, ldr, w, f, c, q, info)
  use fuge_f77_problem, only: check_dimensions, check_modes, set_general_problem, solve_matrix
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, m, lda, ldr, nstop(n)
  real(dp), intent(in) :: alpha(lda, n), gap(n), play(n), r(ldr, m), w(m)
  real(dp), intent(inout) :: f(n), c(n), q(m)
  integer, intent(out) :: info
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call check_modes(n, m, ldr, outcome)
  if (.not. outcome%failed()) call set_general_problem(gap, nstop, play, r, w, problem, outcome)
  if (.not. outcome%failed()) call solve_matrix(alpha, problem, fuge_options(), solution, outcome)
  info = outcome%status
  if (outcome%failed()) return
  f = solution%force
  c = solution%gap
  q = solution%motion
end subroutine fugegv
