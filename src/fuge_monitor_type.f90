!> Someone who watches a long solve and may end it.
module fuge_monitor_type
  use fuge_kinds, only: dp
  implicit none
  private

  !> Extend it; what the watcher needs to remember are components of the extension.
  type, abstract, public :: fuge_monitor
  contains
    procedure(report_progress), deferred :: progress
  end type fuge_monitor

  abstract interface
    !> Called once for each iteration. `residual` is the largest scaled violation at
    !> this point of the solve, no unit, `contacts` the number of points taken for
    !> touching. `cancel` .true. ends the solve with FUGE_ERR_CANCELLED.
    subroutine report_progress(self, iteration, residual, contacts, cancel)
      import :: fuge_monitor, dp
      class(fuge_monitor), intent(inout) :: self
      integer, intent(in) :: iteration, contacts
      real(dp), intent(in) :: residual
      logical, intent(out) :: cancel
    end subroutine report_progress
  end interface

end module fuge_monitor_type
