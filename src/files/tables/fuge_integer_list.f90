!> A list of integers that grows.
module fuge_integer_list
  implicit none
  private

  integer, parameter :: FIRST_ROOM = 64

  !> The integers item(1 : count).
  type, public :: integer_list
    integer :: count = 0
    integer, allocatable :: item(:)
  contains
    procedure :: append
  end type integer_list

contains

  !> Add a number. `status` is not zero without memory.
  pure subroutine append(self, number, status)
    class(integer_list), intent(inout) :: self
    integer, intent(in) :: number
    integer, intent(inout) :: status
    integer, allocatable :: longer(:)
    integer :: room

    if (status /= 0) return
    room = 0
    if (allocated(self%item)) room = size(self%item)
    if (self%count == room) then
      status = 1
      if (room > shiftr(huge(1), 1)) return
      allocate (longer(max(2*room, FIRST_ROOM)), stat=status)
      if (status /= 0) return
      if (room > 0) longer(:room) = self%item
      call move_alloc(longer, self%item)
    end if
    self%count = self%count + 1
    self%item(self%count) = number
  end subroutine append

end module fuge_integer_list
