!> Solves a hard scene by one engine, and measures the errors of the answer.
module hard_run
  use fuge_kinds, only: dp
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  use general_reference, only: solve_with
  use hard_scenes, only: hard_scene
  use one_sided_reference, only: length_of, violation
  implicit none
  private

  public :: solve_scene, solve_scene_with, force_error, gap_error, own_violation

contains

  !> Solve with a new solver. `method` as in fuge_options; the tableau uses the paper's pivot rule.
  subroutine solve_scene(scene, method, solution, info)
    type(hard_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solve_scene_with(solver, scene, method, solution, info)
  end subroutine solve_scene

  !> Solve with a solver that may have solved other scenes before.
  subroutine solve_scene_with(solver, scene, method, solution, info)
    type(fuge_solver), intent(inout) :: solver
    type(hard_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: problem

    allocate (problem%gap, source=scene%gap)
    allocate (problem%resultant, source=[scene%load])
    call solve_with(solver, scene%alpha, problem, solution, info, fuge_options(method))
  end subroutine solve_scene_with

  !> Largest difference of forces, relative to the load.
  pure function force_error(scene, expected, found) result(error)
    type(hard_scene), intent(in) :: scene
    real(dp), intent(in) :: expected(:), found(:)
    real(dp) :: error

    error = maxval(abs(found - expected))/scene%load
  end function force_error

  !> Largest error of gaps and approach, relative to the lengths; the rounding of the approach itself is not counted.
  pure function gap_error(scene, solution) result(error)
    type(hard_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error, length, approach

    length = length_of(scene%alpha, scene%gap, scene%load)
    approach = max(0.0_dp, abs(solution%motion(1) - scene%approach) - 4.0_dp*epsilon(error)*abs(scene%approach))
    error = max(maxval(abs(solution%gap - scene%opening)), approach)/length
  end function gap_error

  !> Largest residual of equations (9) to (11), computed without the library's certificate.
  pure function own_violation(scene, solution) result(worst)
    type(hard_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: worst

    worst = violation(scene%alpha, scene%gap, scene%load, solution%force, solution%gap, solution%motion(1))
  end function own_violation

end module hard_run
