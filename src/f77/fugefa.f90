!> FUGEFA: contact under a load of a grid of rectangles on a half-space, by FFT. Arguments in doc/legacy.md.
subroutine fugefa(nx, ny, hx, hy, estar, nelem, nbound, nthr, gap, f0, f, c, v0, info)
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution, set_problem
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: nx, ny, nelem, nbound, nthr
  real(dp), intent(in) :: hx, hy, estar, gap(*), f0
  real(dp), intent(inout) :: f(*), c(*), v0
  integer, intent(out) :: info
  type(fuge_halfspace_operator) :: surface
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_solver) :: solver
  type(fuge_info) :: outcome

  ! nx*ny may be no integer before the grid is checked.
  call surface%set(nx, ny, hx, hy, estar, outcome, nelem, nbound, nthr)
  if (.not. outcome%failed()) call set_problem(gap(:surface%points()), f0, problem, outcome)
  if (.not. outcome%failed()) call solver%solve(surface, problem, solution, outcome)
  info = outcome%status
  if (outcome%failed()) return
  f(:surface%points()) = solution%force
  c(:surface%points()) = solution%gap
  v0 = solution%motion(1)
end subroutine fugefa
