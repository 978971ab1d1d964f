!> A list of integers that grows.
module fuge_integer_list
  use fuge_growing_arrays, only: make_room
  implicit none
  private

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

    call make_room(self%item, self%count, status)
    if (status /= 0) return
    self%count = self%count + 1
    self%item(self%count) = number
  end subroutine append

end module fuge_integer_list
