!> First solves by several threads: an operator, a new solver and a solve, in elapsed time, and the forces found.
module bench_team
  use bench_problems, only: bench_problem, contact_problem
  use bench_surfaces, only: bench_surface, set_operator
  use bench_transforms, only: forget_wisdom
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, &
    fuge_operator, fuge_options, fuge_problem, fuge_solution, fuge_solver
  implicit none
  private

  public :: solve_area, solve_line, solve_matrix

contains

  !> A surface; `watch` counts one run more.
  subroutine solve_area(surface, options, watch, force, info)
    type(bench_surface), intent(in) :: surface
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: contact

    contact = surface%contact()
    call forget_wisdom()
    call watch%start()
    call set_operator(surface, operator)
    call solve(operator, contact, options, force, info)
    call watch%stop()
  end subroutine solve_area

  !> Equal cells of a half-plane.
  subroutine solve_line(problem, options, watch, force, info)
    type(bench_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: contact

    contact = contact_problem(problem)
    call forget_wisdom()
    call watch%start()
    call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element, problem%boundary)
    if (.not. info%failed()) call solve(operator, contact, options, force, info)
    call watch%stop()
  end subroutine solve_line

  !> A given matrix.
  subroutine solve_matrix(problem, options, watch, force, info)
    type(bench_problem), intent(in), target :: problem
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact

    contact = contact_problem(problem)
    call watch%start()
    call operator%set(problem%alpha, info)
    if (.not. info%failed()) call solve(operator, contact, options, force, info)
    call watch%stop()
  end subroutine solve_matrix

  subroutine solve(operator, contact, options, force, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: contact
    type(fuge_options), intent(in) :: options
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution

    call solver%solve(operator, contact, solution, info, options)
    if (.not. info%failed()) call move_alloc(solution%force, force)
  end subroutine solve

end module bench_team
