!> Someone who watches a long solve and may end it.
module fuge_monitor_type
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CANCELLED
  implicit none
  private

  public :: tell_monitor

  !> Extend it; what the watcher needs to remember are components of the extension.
  type, abstract, public :: fuge_monitor
  contains
    procedure(report_progress), deferred :: progress
  end type fuge_monitor

  abstract interface
    !> Called once for each iteration. `iteration` grows from call to call of a solve;
    !> `residual` >= 0, no unit, tells how far it still is: the part of the artificials
    !> that is left for the tableau, the largest scaled violation for the others;
    !> `contacts` is the number of points taken for touching. `cancel` .true. ends the
    !> solve with FUGE_ERR_CANCELLED.
    subroutine report_progress(self, iteration, residual, contacts, cancel)
      import :: fuge_monitor, dp
      class(fuge_monitor), intent(inout) :: self
      integer, intent(in) :: iteration, contacts
      real(dp), intent(in) :: residual
      logical, intent(out) :: cancel
    end subroutine report_progress
  end interface

  !> Hands on to the caller's monitor, or to nobody, so that engines need not ask whether
  !> there is one; and goes on counting where one engine of a solve takes over from another.
  type, extends(fuge_monitor), public :: monitor_relay
    class(fuge_monitor), pointer :: listener => null()
    !> Iterations told so far.
    integer :: told = 0
  contains
    procedure :: progress => hand_on
  end type monitor_relay

contains

  subroutine hand_on(self, iteration, residual, contacts, cancel)
    class(monitor_relay), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    self%told = max(self%told + 1, iteration)
    cancel = .false.
    if (associated(self%listener)) call self%listener%progress(self%told, residual, contacts, cancel)
  end subroutine hand_on

  !> What an engine calls in each iteration, arguments as for `progress`: `status` is
  !> FUGE_DONE to go on or FUGE_ERR_CANCELLED.
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
