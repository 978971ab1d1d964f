!> The active set on the paper's problem, called from a matrix, gaps and a load.
module plain_runs
  use fuge_active_set, only: run_active_set
  use fuge_contact_factor, only: contact_factor
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_problem_type, only: fuge_problem, set_problem
  use fuge_scene, only: contact_scene, make_scene
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: run_plain

contains

  !> As `run_active_set`, with the contact set as a mask and one motion.
  subroutine run_plain(alpha, datum, gap, load, limit, monitor, factor, contact, force, gap_out, approach, iterations, &
                       status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, gap(:), load
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    logical, intent(inout) :: contact(:)
    real(dp), intent(out) :: force(:), gap_out(:), approach
    integer, intent(out) :: iterations, status
    type(fuge_problem) :: problem
    type(contact_scene) :: scene
    type(fuge_info) :: info
    integer :: side(size(gap))
    real(dp) :: motion(1)

    call set_problem(gap, load, problem, info)
    call make_scene(problem, scene, info)
    side = merge(1, 0, contact)
    call run_active_set(alpha, datum, scene, limit, monitor, factor, side, force, gap_out, motion, iterations, status)
    contact = side /= 0
    approach = motion(1)
  end subroutine run_plain

end module plain_runs
