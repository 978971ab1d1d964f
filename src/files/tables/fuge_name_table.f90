!> Names, numbered as they come: a table with open addressing.
module fuge_name_table
  use, intrinsic :: iso_fortran_env, only: int64
  implicit none
  private

  !> Longest name that is kept.
  integer, parameter, public :: LONGEST_NAME = 104
  !> Number of slots at first, a power of two like all later ones.
  integer, parameter :: FIRST_SLOTS = 32
  !> Factor and modulus of the sum over the letters, a multiplicative congruential generator that does not overflow
  !> (S. K. Park, K. W. Miller, Communications of the ACM 31, 1988, page 1192).
  integer(int64), parameter :: FACTOR = 16807_int64, MODULUS = 2147483647_int64

  type, public :: name_table
    integer :: count = 0
    character(len=LONGEST_NAME), allocatable :: name(:)
    !> Number of the name in each slot, 0 if none; at most half are taken.
    integer, allocatable, private :: slot(:)
  contains
    procedure :: number_of
    procedure :: find
    procedure, private :: grow
    procedure, private :: slot_of
  end type name_table

contains

  !> The number of a name, a new one if the name is new. Without effect if `status` is not zero, which it becomes
  !> without memory.
  pure subroutine number_of(self, name, number, status)
    class(name_table), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(out) :: number
    integer, intent(inout) :: status
    integer :: slot
    logical :: full

    number = 0
    full = .not. allocated(self%slot)
    if (.not. full) full = self%count >= size(self%slot)/2
    if (full .and. status == 0) call self%grow(status)
    if (status /= 0) return
    slot = self%slot_of(name)
    number = self%slot(slot)
    if (number > 0) return
    self%count = self%count + 1
    number = self%count
    self%slot(slot) = number
    self%name(number) = name
  end subroutine number_of

  !> The number of a name, 0 if it is not known.
  pure function find(self, name) result(number)
    class(name_table), intent(in) :: self
    character(len=*), intent(in) :: name
    integer :: number

    number = 0
    if (allocated(self%slot)) number = self%slot(self%slot_of(name))
  end function find

  !> The slot of a name, or the free one where it belongs.
  pure function slot_of(self, name) result(slot)
    class(name_table), intent(in) :: self
    character(len=*), intent(in) :: name
    integer :: slot
    integer(int64) :: mixed
    integer :: k

    mixed = 1_int64
    do k = 1, len_trim(name)
      mixed = mod((mixed + int(iachar(name(k:k)), int64))*FACTOR, MODULUS)
    end do
    slot = int(iand(mixed, int(size(self%slot) - 1, int64))) + 1
    do while (self%slot(slot) > 0)
      if (self%name(self%slot(slot)) == name) return
      slot = modulo(slot, size(self%slot)) + 1
    end do
  end function slot_of

  !> Double the memory.
  pure subroutine grow(self, status)
    class(name_table), intent(inout) :: self
    integer, intent(inout) :: status
    character(len=LONGEST_NAME), allocatable :: name(:)
    integer, allocatable :: slot(:)
    integer :: k, slots

    slots = FIRST_SLOTS
    if (allocated(self%slot)) slots = 2*size(self%slot)
    allocate (name(slots/2), slot(slots), stat=status)
    if (status /= 0) return
    slot = 0
    if (self%count > 0) name(:self%count) = self%name(:self%count)
    call move_alloc(name, self%name)
    call move_alloc(slot, self%slot)
    do k = 1, self%count
      self%slot(self%slot_of(self%name(k))) = k
    end do
  end subroutine grow

end module fuge_name_table
