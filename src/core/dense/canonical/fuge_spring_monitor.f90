!> Reports of an engine that takes springs on motions for points, with the contact points only.
module fuge_spring_monitor
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  implicit none
  private

  type, extends(fuge_monitor), public :: spring_monitor
    !> Who gets the reports.
    class(fuge_monitor), pointer :: listener => null()
    !> Number of the points that stand for springs, which are always in contact.
    integer :: springs = 0
  contains
    procedure :: progress
  end type spring_monitor

contains

  !> As for `fuge_monitor`.
  subroutine progress(self, iteration, residual, contacts, cancel)
    class(spring_monitor), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    cancel = .false.
    if (associated(self%listener)) then
      call self%listener%progress(iteration, residual, max(contacts - self%springs, 0), cancel)
    end if
  end subroutine progress

end module fuge_spring_monitor
