!> FUGEFX: contact of equal cells on a half-plane by FFT, under a load or with its approach prescribed, with options, a
!> report and the message. Arguments in doc/legacy.md.
subroutine fugefx(n, h, estar, nelem, nbound, nthr, gap, nheld, f0, v0, tol, maxit, f, c, ncon, niter, resid, msg, info)
  use fuge_f77_problem, only: set_options, set_translation
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options, FUGE_AUTO
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, nelem, nbound, nthr, nheld, maxit
  real(dp), intent(in) :: h, estar, gap(n), tol
  real(dp), intent(inout) :: f0, v0, f(n), c(n), resid
  integer, intent(inout) :: ncon, niter
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_halfplane_operator) :: surface
  type(fuge_options) :: options
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_solver) :: solver
  type(fuge_info) :: outcome

  call set_options(FUGE_AUTO, tol, maxit, options)
  options%threads = nthr
  call surface%set(n, h, estar, outcome, nelem, nbound)
  if (.not. outcome%failed()) call set_translation(gap, nheld /= 0, f0, v0, problem, outcome)
  if (.not. outcome%failed()) call solver%solve(surface, problem, solution, outcome, options)
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
end subroutine fugefx
