!> What the hard tests expect of an answer; as in `expectations`, '' tells that it is so.
module hard_expectations
  use expectations, only: add_excess, add_words, REPORT_LENGTH, unexpected
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_options_type, only: FUGE_ACTIVE_SET, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, FUGE_DONE
  use hard_run, only: force_error, own_violation, solve_scene
  use hard_scenes, only: hard_scene
  implicit none
  private

  public :: unexpected_forces

  !> The engines that need the matrix.
  integer, parameter, public :: METHODS(2) = [FUGE_TABLEAU, FUGE_ACTIVE_SET]

contains

  !> Both engines find these forces, in few iterations, with small residuals by the library and by one_sided_reference.
  function unexpected_forces(scene, force, tolerance) result(report)
    type(hard_scene), intent(in) :: scene
    real(dp), intent(in) :: force(:), tolerance
    character(len=REPORT_LENGTH) :: report
    real(dp), parameter :: MOST_RESIDUAL = 1.0e-12_dp
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: k

    do k = 1, size(METHODS)
      call solve_scene(scene, METHODS(k), solution, info)
      report = unexpected(info, FUGE_DONE)
      if (.not. info%failed()) then
        call add_excess('residual', info%residual, MOST_RESIDUAL, report)
        call add_excess('violation', own_violation(scene, solution), MOST_RESIDUAL, report)
        call add_excess('error of the forces', force_error(scene, force, solution%force), tolerance, report)
        call add_excess('iterations', real(info%iterations, dp), real(3*(size(force) + 1), dp), report)
      end if
      if (report /= '') call add_words('method '//text(METHODS(k)), report)
      if (report /= '') return
    end do
  end function unexpected_forces

end module hard_expectations
