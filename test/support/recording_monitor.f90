!> A monitor that keeps all reports of a solve, and may cancel it.
module recording_monitor
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  implicit none
  private

  !> Reports that are kept; of more than these the last one replaces the one before.
  integer, parameter :: KEPT = 1000

  type, extends(fuge_monitor), public :: recorder
    !> Cancel in this call; 0 for never.
    integer :: cancel_at = 0
    integer :: calls = 0
    integer :: iteration(KEPT) = 0, contacts(KEPT) = 0
    real(dp) :: residual(KEPT) = -1.0_dp
  contains
    procedure :: progress
  end type recorder

contains

  subroutine progress(self, iteration, residual, contacts, cancel)
    class(recorder), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel
    integer :: place

    self%calls = self%calls + 1
    place = min(self%calls, KEPT)
    self%iteration(place) = iteration
    self%residual(place) = residual
    self%contacts(place) = contacts
    cancel = self%calls == self%cancel_at
  end subroutine progress

end module recording_monitor
