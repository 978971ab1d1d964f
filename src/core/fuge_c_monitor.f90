!> A progress callback of C as a monitor.
module fuge_c_monitor
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_funptr, c_associated, c_f_procpointer
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  implicit none
  private

  abstract interface
    !> fuge_progress of fuge_core.h.
    function c_progress(iteration, residual, contacts, user) bind(c) result(cancel)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: iteration, contacts
      real(c_double), intent(in), value :: residual
      type(c_ptr), intent(in), value :: user
      integer(c_int) :: cancel
    end function c_progress
  end interface

  type, extends(fuge_monitor), public :: c_monitor
    procedure(c_progress), pointer, nopass, private :: callback => null()
    type(c_ptr), private :: user = c_null_ptr
  contains
    procedure :: set
    procedure :: progress
  end type c_monitor

contains

  !> Call `callback` with `user` from now on; NULL for none.
  subroutine set(self, callback, user)
    class(c_monitor), intent(inout) :: self
    type(c_funptr), intent(in) :: callback
    type(c_ptr), intent(in) :: user
    procedure(c_progress), pointer :: found

    nullify (found)
    if (c_associated(callback)) call c_f_procpointer(callback, found)
    self%callback => found
    self%user = user
  end subroutine set

  subroutine progress(self, iteration, residual, contacts, cancel)
    class(c_monitor), intent(inout) :: self
    integer, intent(in) :: iteration, contacts
    real(dp), intent(in) :: residual
    logical, intent(out) :: cancel

    cancel = .false.
    if (associated(self%callback)) cancel = &
      self%callback(int(iteration, c_int), residual, int(contacts, c_int), self%user) /= 0
  end subroutine progress

end module fuge_c_monitor
