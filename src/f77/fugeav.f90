!> FUGEAV: the contact problem of one prescribed translation. Arguments in doc/legacy.md; `alpha`
!> is not copied.
subroutine fugeav(n, alpha, lda, gap, v0, f, c, f0, info)
  use fuge_f77_problem, only: check_dimensions, set_translation, solve_matrix
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, lda
  real(dp), intent(in) :: alpha(lda, n), gap(n), v0
  real(dp), intent(inout) :: f(n), c(n), f0
  integer, intent(out) :: info
  type(fuge_problem) :: problem
  type(fuge_solution) :: solution
  type(fuge_info) :: outcome

  call check_dimensions(n, 'N', lda, 'LDA', outcome)
  if (.not. outcome%failed()) call set_translation(gap, .true., 0.0_dp, v0, problem, outcome)
  if (.not. outcome%failed()) call solve_matrix(alpha, problem, fuge_options(), solution, outcome)
  info = outcome%status
  if (outcome%failed()) return
  f = solution%force
  c = solution%gap
  f0 = sum(solution%force)
end subroutine fugeav
