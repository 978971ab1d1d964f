!> Rows of a stiffness matrix that a file names by node and direction: from a name to its number, and in order.
module fuge_row_table
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_growing_arrays, only: resize
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  implicit none
  private

  !> Largest direction: a node may have 1 to 6 for displacements and rotations, and more for other quantities.
  integer, parameter, public :: LARGEST_DIRECTION = 9999
  !> Number of slots at first, a power of two like all later ones.
  integer, parameter :: FIRST_SLOTS = 64
  !> Slots of a block, 16, as a power of two.
  integer, parameter :: BLOCK_BITS = 4
  !> An odd factor that spreads the blocks over the slots (D. E. Knuth, The Art of Computer Programming,
  !> volume 3, section 6.4: 2**32 over the golden ratio).
  integer(int64), parameter :: SPREAD = 2654435761_int64

  !> Names of rows, numbered as they came: a table with open addressing.
  type, public :: row_table
    integer :: count = 0
    integer, allocatable :: node(:), direction(:)
    !> Number of the row in each slot, 0 if none; at most half are taken.
    integer, allocatable, private :: slot(:)
  contains
    procedure :: number_of
    procedure :: find
    procedure :: sort
    procedure :: move_to
    procedure, private :: grow
    procedure, private :: slot_of
  end type row_table

contains

  !> The number of a row, a new one if the name is new. `status` is not zero without memory.
  pure subroutine number_of(self, node, direction, number, status)
    class(row_table), intent(inout) :: self
    integer, intent(in) :: node, direction
    integer, intent(out) :: number, status
    integer :: slot
    logical :: full

    status = 0
    number = 0
    full = .not. allocated(self%slot)
    if (.not. full) full = self%count >= size(self%slot)/2
    if (full) call self%grow(status)
    if (status /= 0) return
    slot = self%slot_of(node, direction)
    number = self%slot(slot)
    if (number > 0) return
    self%count = self%count + 1
    number = self%count
    self%slot(slot) = number
    self%node(number) = node
    self%direction(number) = direction
  end subroutine number_of

  !> The number of a row, 0 if the name is not known.
  pure function find(self, node, direction) result(number)
    class(row_table), intent(in) :: self
    integer, intent(in) :: node, direction
    integer :: number

    number = 0
    if (allocated(self%slot)) number = self%slot(self%slot_of(node, direction))
  end function find

  !> The slot of a name, or the free one where it belongs.
  pure function slot_of(self, node, direction) result(slot)
    class(row_table), intent(in) :: self
    integer, intent(in) :: node, direction
    integer :: slot
    integer(int64) :: key, mixed
    integer :: number

    ! Neighbouring nodes and the directions of a node share a block of slots, and so a line of the cache.
    key = abs(4_int64*int(node, int64) + int(direction, int64))
    mixed = shiftr(key, BLOCK_BITS)*SPREAD
    mixed = ieor(mixed, shiftr(mixed, 15))
    slot = int(iand(shiftl(mixed, BLOCK_BITS) + iand(key, shiftl(1_int64, BLOCK_BITS) - 1_int64), &
                     int(size(self%slot) - 1, int64))) + 1
    do
      number = self%slot(slot)
      if (number == 0) return
      if (self%node(number) == node .and. self%direction(number) == direction) return
      slot = slot + 1
      if (slot > size(self%slot)) slot = 1
    end do
  end function slot_of

  !> Move the names to another table; nothing is copied.
  pure subroutine move_to(self, other)
    class(row_table), intent(inout) :: self
    type(row_table), intent(inout) :: other

    other%count = self%count
    call move_alloc(self%node, other%node)
    call move_alloc(self%direction, other%direction)
    call move_alloc(self%slot, other%slot)
  end subroutine move_to

  !> Double the memory.
  pure subroutine grow(self, status)
    class(row_table), intent(inout) :: self
    integer, intent(out) :: status
    integer, allocatable :: slot(:)
    integer :: k, slots

    slots = FIRST_SLOTS
    status = 1
    if (allocated(self%slot)) then
      if (size(self%slot) >= shiftr(huge(1), 1)) return
      slots = 2*size(self%slot)
    end if
    allocate (slot(slots), stat=status)
    call resize(self%node, slots/2, status)
    call resize(self%direction, slots/2, status)
    if (status /= 0) return
    slot = 0
    call move_alloc(slot, self%slot)
    do k = 1, self%count
      self%slot(self%slot_of(self%node(k), self%direction(k))) = k
    end do
  end subroutine grow

  !> The rows by nodes, those of a node by directions: row k of the table becomes row `new_row(k)`, and `node` and
  !> `direction` are those of the sorted rows. `status` is not zero without memory.
  pure subroutine sort(self, new_row, node, direction, status)
    class(row_table), intent(in) :: self
    integer, allocatable, intent(out) :: new_row(:), node(:), direction(:)
    integer, intent(out) :: status
    real(dp), allocatable :: key(:)
    integer, allocatable :: order(:)
    integer :: k, n

    n = self%count
    allocate (new_row(n), node(n), direction(n), order(n), key(n), stat=status)
    if (status /= 0) return
    do k = 1, n
      order(k) = k
      ! Exact: below 2**45.
      key(k) = real(self%node(k), dp)*real(LARGEST_DIRECTION + 1, dp) + real(self%direction(k), dp)
    end do
    call heap_sort(key, order)
    do k = 1, n
      new_row(order(k)) = k
      node(k) = self%node(order(k))
      direction(k) = self%direction(order(k))
    end do
  end subroutine sort

end module fuge_row_table
