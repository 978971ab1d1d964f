!> The progress monitor: it follows a long solve and may cancel it.
module fuge_monitor_type
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CANCELLED
  implicit none
  private

  public :: tell_monitor

  !> Extend it; components of the extension hold what the monitor needs to remember.
  type, abstract, public :: fuge_monitor
  contains
    procedure(report_progress), deferred :: progress
  end type fuge_monitor

  abstract interface
    !> Called once for each iteration, and now and then while the iterative engine takes long to
    !> estimate the error of the forces. `iteration` grows from call to call of a solve;
    !> `residual` >= 0, no unit, is how far the solution still is: for the tableau the sum of
    !> the artificial variables relative to its start, for the other engines the largest
    !> scaled violation; `contacts` is the number of points in contact for now. `cancel`
    !> .true. ends the solve with FUGE_ERR_CANCELLED.
    subroutine report_progress(self, iteration, residual, contacts, cancel)
      import :: fuge_monitor, dp
      class(fuge_monitor), intent(inout) :: self
      integer, intent(in) :: iteration, contacts
      real(dp), intent(in) :: residual
      logical, intent(out) :: cancel
    end subroutine report_progress
  end interface

  !> Passes reports on to the caller's monitor if there is one, so that engines need not ask;
  !> and goes on counting where one engine of a solve takes over from another.
  type, extends(fuge_monitor), public :: monitor_relay
    !> The caller's monitor; null for none.
    class(fuge_monitor), pointer :: listener => null()
    !> Number of the last iteration reported.
    integer :: reported = 0
  contains
    procedure :: progress => relay_progress
  end type monitor_relay

contains

  subroutine relay_progress(self, iteration, residual, contacts, cancel)
    class(monitor_relay), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    self%reported = max(self%reported + 1, iteration)
    cancel = .false.
    if (associated(self%listener)) call self%listener%progress(self%reported, residual, contacts, cancel)
  end subroutine relay_progress

  !> Report one iteration of an engine; arguments as for `progress`. `status` is FUGE_DONE to
  !> go on, or FUGE_ERR_CANCELLED.
  subroutine tell_monitor(monitor, iteration, residual, contacts, status)
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    integer, intent(out) :: status
    logical :: cancel

    call monitor%progress(iteration, residual, contacts, cancel)
    status = merge(FUGE_ERR_CANCELLED, FUGE_DONE, cancel)
  end subroutine tell_monitor

end module fuge_monitor_type
