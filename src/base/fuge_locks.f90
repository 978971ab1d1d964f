!> What only one thread of the process may do at a time.
module fuge_locks
  use, intrinsic :: iso_c_binding, only: c_int
  implicit none
  private

  public :: lock, unlock

  !> Plans of FFTW are made.
  integer(c_int), parameter, public :: LOCK_PLANNER = 0
  !> Files are opened and closed: Fortran refuses to open one that another unit, and so
  !> another thread, has open.
  integer(c_int), parameter, public :: LOCK_FILES = 1

  interface
    !> Wait until no other thread holds the lock `which`, and hold it.
    subroutine lock(which) bind(c, name='fuge_lock')
      import :: c_int
      integer(c_int), intent(in), value :: which
    end subroutine lock

    subroutine unlock(which) bind(c, name='fuge_unlock')
      import :: c_int
      integer(c_int), intent(in), value :: which
    end subroutine unlock
  end interface

end module fuge_locks
