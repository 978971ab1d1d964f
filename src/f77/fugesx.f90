!> FUGESX: the contact problem of one translation, under a load or with its approach prescribed, with options, a report
!> and the message. Arguments in doc/legacy.md; `alpha` is not copied.
subroutine fugesx(n, alpha, lda, gap, nheld, f0, v0, method, tol, maxit, f, c, ncon, niter, resid, msg, info)
  use fuge_f77_problem, only: check_dimensions, set_options, set_translation, solve_matrix
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, lda, nheld, method, maxit
  real(dp), intent(in) :: alpha(lda, n), gap(n), tol
  real(dp), intent(inout) :: f0, v0, f(n), c(n), resid
  integer, intent(inout) :: ncon, niter
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_options) :: options
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_info) :: outcome

  call set_options(method, tol, maxit, options)
  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call set_translation(gap, nheld /= 0, f0, v0, problem, outcome)
  if (.not. outcome%failed()) call solve_matrix(alpha, problem, options, solution, outcome)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  f = solution%force
  c = solution%gap
  if (nheld == 0) v0 = solution%motion(1)
  if (nheld /= 0) f0 = sum(solution%force)
  ncon = outcome%contacts
  niter = outcome%iterations
  resid = outcome%residual
end subroutine fugesx
