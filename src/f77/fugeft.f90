!> FUGEFT: contact under a load of equal cells on a half-plane, by FFT. Arguments in doc/legacy.md.
subroutine fugeft(n, h, estar, nelem, nbound, nthr, gap, f0, f, c, v0, info)
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution, set_problem
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, nelem, nbound, nthr
  real(dp), intent(in) :: h, estar, gap(n), f0
  real(dp), intent(inout) :: f(n), c(n), v0
  integer, intent(out) :: info
  type(fuge_halfplane_operator) :: surface
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_solver) :: solver
  type(fuge_info) :: outcome

  call surface%set(n, h, estar, outcome, nelem, nbound, nthr)
  if (.not. outcome%failed()) call set_problem(gap, f0, problem, outcome)
  if (.not. outcome%failed()) call solver%solve(surface, problem, solution, outcome)
  info = outcome%status
  if (outcome%failed()) return
  f = solution%force
  c = solution%gap
  v0 = solution%motion(1)
end subroutine fugeft
