!> Locks for what only one thread of the process may do at a time, and numbers that are unique in it.
module fuge_locks
  use, intrinsic :: iso_c_binding, only: c_int, c_long_long
  implicit none
  private

  public :: lock, new_stamp, unlock

  !> Calls of the planner of FFTW, which is not thread-safe.
  integer(c_int), parameter, public :: LOCK_PLANNER = 0
  !> Internal write statements: gfortran's run-time library keeps their units in the list through which `open` walks.
  integer(c_int), parameter, public :: LOCK_UNITS = 1

  !> The coarser grids that an operator keeps and its solvers share.
  integer(c_int), parameter, public :: LOCK_GRIDS = 2
  !> Buffers that an operator keeps and its products share; held for a moment only.
  integer(c_int), parameter, public :: LOCK_BUFFERS = 4
  !> Kernels that operators compute when they are first needed, perhaps while the grids are locked.
  integer(c_int), parameter, public :: LOCK_KERNELS = 5

  interface
    !> Wait until no other thread holds the lock `which`, then acquire it.
    subroutine lock(which) bind(c, name='fuge_lock')
      import :: c_int
      integer(c_int), intent(in), value :: which
    end subroutine lock

    !> Release the lock `which`.
    subroutine unlock(which) bind(c, name='fuge_unlock')
      import :: c_int
      integer(c_int), intent(in), value :: which
    end subroutine unlock

    !> A number that no earlier call in this process has returned, from 1 on: it tells states of an object apart, which
    !> an address cannot, because memory is used again.
    function new_stamp() result(stamp) bind(c, name='fuge_new_stamp')
      import :: c_long_long
      integer(c_long_long) :: stamp
    end function new_stamp
  end interface

end module fuge_locks
