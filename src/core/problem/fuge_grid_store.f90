!> The coarser grids that an operator keeps for its solves.
module fuge_grid_store
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_null_ptr, c_ptr
  use fuge_operator_type, only: fuge_operator
  implicit none
  private

  !> One of them, unallocated before it is made.
  type :: stored_grid
    class(fuge_operator), allocatable :: operator
  end type stored_grid

  !> Element k of `grid` has cells 2**k times as wide as the finest grid. Made when they are first needed; the
  !> store of a coarser grid refers to those of the finest one, whose store owns them.
  type, public :: grid_store
    type(stored_grid), pointer :: grid(:) => null()
    !> Doublings of the width from the finest grid to this one.
    integer :: level = 0
    !> Address of the variable that owns the grids.
    type(c_ptr), private :: owner = c_null_ptr
  contains
    procedure :: create
    procedure :: refer_to
    procedure :: position_of
    procedure :: move_from
    procedure :: clear
    final :: destroy
  end type grid_store

contains

  !> Room for `count` coarser grids; without memory none are kept.
  subroutine create(self, count)
    class(grid_store), intent(inout), target :: self
    integer, intent(in) :: count
    integer :: stat

    call self%clear()
    allocate (self%grid(count), stat=stat)
    if (stat == 0) self%owner = c_loc(self%level)
  end subroutine create

  !> Refer to the grids of `finest`, of which number `level` has this store.
  subroutine refer_to(self, finest, level)
    class(grid_store), intent(inout) :: self
    class(grid_store), intent(in) :: finest
    integer, intent(in) :: level

    call self%clear()
    self%grid => finest%grid
    self%level = level
  end subroutine refer_to

  !> The number in `grid` of cells 2**levels times as wide as those of this grid; 0 if there is no room for it.
  pure function position_of(self, levels) result(k)
    class(grid_store), intent(in) :: self
    integer, intent(in) :: levels
    integer :: k

    k = 0
    if (.not. associated(self%grid) .or. levels < 1) return
    if (levels <= size(self%grid) - self%level) k = self%level + levels
  end function position_of

  !> Move the grids from `source`, which has none afterwards.
  subroutine move_from(self, source)
    class(grid_store), intent(inout), target :: self, source

    call self%clear()
    if (.not. c_associated(source%owner, c_loc(source%level))) return
    self%grid => source%grid
    self%level = source%level
    self%owner = c_loc(self%level)
    source%owner = c_null_ptr
    nullify (source%grid)
  end subroutine move_from

  !> Destroy the grids if this variable owns them; a bitwise copy, and a coarser grid, does not.
  subroutine clear(self)
    class(grid_store), intent(inout), target :: self
    integer :: k

    if (c_associated(self%owner)) then
      if (c_associated(self%owner, c_loc(self%level))) then
        do k = 1, size(self%grid)
          call free_operator(self%grid(k)%operator)
        end do
        deallocate (self%grid)
      end if
    end if
    nullify (self%grid)
    self%owner = c_null_ptr
    self%level = 0
  end subroutine clear

  impure elemental subroutine destroy(self)
    type(grid_store), intent(inout) :: self

    call self%clear()
  end subroutine destroy

  !> A procedure of its own, because gfortran 12 does not compile it with bounds checks for an element of an array.
  subroutine free_operator(operator)
    class(fuge_operator), allocatable, intent(inout) :: operator

    if (allocated(operator)) deallocate (operator)
  end subroutine free_operator

end module fuge_grid_store
