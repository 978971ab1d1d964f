!> The solution of a contact problem whose influence matrix is known, and what warnings become.
module problem_solution
  use, intrinsic :: iso_fortran_env, only: error_unit
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, fuge_solver
  use number_words, only: number_text
  use progress_log, only: progress
  implicit none
  private

  public :: solve, take_warning, warn

contains

  subroutine solve(alpha, problem, options, solution, log, info)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    type(fuge_solution), intent(inout) :: solution
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver

    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info, options)
    if (info%failed()) return
    call log%say('contact is solved: '//number_text(info%contacts)//' of '//number_text(size(solution%force)) &
                 //' points, '//number_text(info%iterations)//' contact sets')
    call warn(info)
  end subroutine solve

  !> A warning of one step is a warning of the solve, unless that has one already.
  subroutine take_warning(step, info)
    type(fuge_info), intent(in) :: step
    type(fuge_info), intent(inout) :: info

    call warn(step)
    if (info%status /= 0 .or. step%status == 0) return
    info%status = step%status
    info%message = step%message
  end subroutine take_warning

  subroutine warn(info)
    type(fuge_info), intent(in) :: info

    if (info%status > 0) write (error_unit, '(2a)') 'fuge: warning: ', trim(info%message)
  end subroutine warn

end module problem_solution
