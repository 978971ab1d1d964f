!> The coarser grids of an operator, each of half the points of the one before.
module fuge_grids
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  type :: coarse_grid
    class(fuge_operator), allocatable :: operator
  end type coarse_grid

  !> coarse(k) has cells of 2**k times the width; none where the operator has none.
  type, public :: grid_family
    type(coarse_grid), allocatable :: coarse(:)
  contains
    procedure :: make
  end type grid_family

contains

  !> Coarsen as often as the operator can. Error: FUGE_ERR_MEMORY.
  subroutine make(self, operator, info)
    class(grid_family), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: next
    type(coarse_grid), allocatable :: found(:)
    integer :: k, number, stat

    ! As many as the points can be halved.
    allocate (found(digits(operator%points())), stat=stat)
    number = 0
    if (stat == 0) then
      call operator%coarsen(next)
      do while (allocated(next) .and. number < size(found))
        number = number + 1
        call move_alloc(next, found(number)%operator)
        call found(number)%operator%coarsen(next)
      end do
      if (allocated(self%coarse)) deallocate (self%coarse)
      allocate (self%coarse(number), stat=stat)
    end if
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the list of coarser grids')
      return
    end if
    do k = 1, number
      call move_alloc(found(k)%operator, self%coarse(k)%operator)
    end do
  end subroutine make

end module fuge_grids
