!> One hard scene solved by one engine, and how far the answer is off.
module hard_run
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, fuge_solver
  use hard_reference, only: length_of, violation
  use hard_scenes, only: hard_scene
  implicit none
  private

  public :: solve_scene, solve_again, force_error, gap_error, own_violation

contains

  !> `method` as in fuge_options; the tableau takes the paper's rule.
  subroutine solve_scene(scene, method, solution, info)
    type(hard_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solve_again(solver, scene, method, solution, info)
  end subroutine solve_scene

  !> The same with a solver that may have solved something else before.
  subroutine solve_again(solver, scene, method, solution, info)
    type(fuge_solver), intent(inout) :: solver
    type(hard_scene), intent(in) :: scene
    integer, intent(in) :: method
    type(fuge_solution), intent(out) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    real(dp), allocatable, target :: alpha(:, :)

    ! The operator points to the matrix.
    allocate (alpha, source=scene%alpha)
    call operator%set(alpha, info)
    if (info%failed()) return
    allocate (problem%gap, source=scene%gap)
    allocate (problem%resultant, source=[scene%load])
    call solver%solve(operator, problem, solution, info, fuge_options(method))
  end subroutine solve_again

  !> Largest difference of forces, as a part of the load.
  pure function force_error(scene, expected, found) result(error)
    type(hard_scene), intent(in) :: scene
    real(dp), intent(in) :: expected(:), found(:)
    real(dp) :: error

    error = maxval(abs(found - expected))/scene%load
  end function force_error

  !> Largest error of the gaps against the known ones, as a part of the lengths; that of
  !> the approach beyond what its own rounding makes.
  pure function gap_error(scene, solution) result(error)
    type(hard_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: error, length, approach

    length = length_of(scene%alpha, scene%gap, scene%load)
    approach = max(0.0_dp, abs(solution%motion(1) - scene%approach) - 4.0_dp*epsilon(error)*abs(scene%approach))
    error = max(maxval(abs(solution%gap - scene%opening)), approach)/length
  end function gap_error

  !> Equations (9) to (11), without the library's certificate.
  pure function own_violation(scene, solution) result(worst)
    type(hard_scene), intent(in) :: scene
    type(fuge_solution), intent(in) :: solution
    real(dp) :: worst

    worst = violation(scene%alpha, scene%gap, scene%load, solution%force, solution%gap, solution%motion(1))
  end function own_violation

end module hard_run
