!> FUGEGX: general problems with rigid motions, free or prescribed, two stops and excluded points, with options, a
!> report and the message. Arguments in doc/legacy.md; `alpha` is not copied.
subroutine fugegx(n, m, alpha, lda, gap, nstop, play, r, ldr, nheld, w, q, method, tol, maxit, &
                  f, c, ncon, niter, resid, msg, info)
  use fuge_f77_problem, only: check_dimensions, check_modes, prescribe_motions, set_general_problem, set_options, &
    solve_matrix
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, m, lda, ldr, nstop(n), nheld(m), method, maxit
  real(dp), intent(in) :: alpha(lda, n), gap(n), play(n), r(ldr, m), tol
  real(dp), intent(inout) :: w(m), q(m), f(n), c(n), resid
  integer, intent(inout) :: ncon, niter
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_options) :: options
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_info) :: outcome

  call set_options(method, tol, maxit, options)
  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call check_modes(n, m, ldr, outcome)
  if (.not. outcome%failed()) call set_general_problem(gap, nstop, play, r, w, problem, outcome)
  if (.not. outcome%failed()) call prescribe_motions(nheld, q, problem, outcome)
  if (.not. outcome%failed()) call solve_matrix(alpha, problem, options, solution, outcome)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  f = solution%force
  c = solution%gap
  where (nheld == 0) q = solution%motion
  where (nheld /= 0) w = matmul(solution%force, problem%modes)
  ncon = outcome%contacts
  niter = outcome%iterations
  resid = outcome%residual
end subroutine fugegx
