!> The solution of a contact problem whose influence matrix is known, and what warnings become.
module problem_solution
  use, intrinsic :: iso_fortran_env, only: error_unit
  use fuge_core, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_options, fuge_problem, fuge_proof, &
    fuge_prove, fuge_solution, fuge_solver
  use number_words, only: number_text
  use progress_log, only: progress
  implicit none
  private

  public :: prove, solve, take_warning, warn

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

  !> Bound the error of a solution. What is not proved is a warning; that points are on the border of two states is a
  !> remark, the message of a solve without a warning.
  subroutine prove(alpha, problem, solution, proof, log, info)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: of_proof

    call operator%set(alpha, of_proof)
    if (.not. of_proof%failed()) call fuge_prove(operator, problem, solution, proof, of_proof)
    if (of_proof%failed()) then
      info = of_proof
      return
    end if
    call log%say('the proof is done')
    if (of_proof%status == 0 .and. len_trim(of_proof%message) > 0) then
      write (error_unit, '(2a)') 'fuge: note: ', trim(of_proof%message)
      if (info%status == 0) info%message = of_proof%message
    end if
    call take_warning(of_proof, info)
  end subroutine prove

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
