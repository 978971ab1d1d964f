!> The progress of the iteration, for the caller's monitor, which may cancel.
module fuge_iteration_progress
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE
  implicit none
  private

  public :: tell_progress

contains

  !> Tell the monitor the number of the iteration, info%iterations, how large the residual of `iterate` is relative to
  !> its lengths, and the size of the contact set that it was evaluated for. Error: FUGE_ERR_CANCELLED, on all ranks if
  !> one of them cancels.
  subroutine tell_progress(scene, iterate, monitor, info)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_info), intent(inout) :: info
    real(dp) :: relative
    integer :: contacts, status

    relative = 0.0_dp
    if (iterate%lengths%residual_norm > 0.0_dp) then
      relative = iterate%lengths%residual_norm/max(iterate%lengths%least_magnitude, iterate%lengths%residual_norm)
    end if
    contacts = iterate%segments%points
    call tell_monitor(monitor, info%iterations, relative, contacts, status)
    if (status /= FUGE_DONE) call report(info, status, fuge_status_text(status))
    call scene%rows%agree(info)
  end subroutine tell_progress

end module fuge_iteration_progress
