!> Records of whole and real numbers, each with the place where a file has it: what the cards of a deck say, until all
!> of them are known.
module fuge_number_records
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  use fuge_row_table, only: row_table
  implicit none
  private

  !> Record k: whole(:, k) and value(:, k), from line place(2, k) of file number place(1, k).
  type, public :: number_records
    integer :: count = 0
    integer, allocatable :: whole(:, :)
    real(dp), allocatable :: value(:, :)
    integer, allocatable :: place(:, :)
    type(row_table), private :: identities
  contains
    procedure :: append
    procedure :: append_named
    procedure :: find
  end type number_records

contains

  !> Add a record; all have as many numbers as the first one. `status` is not zero without memory.
  pure subroutine append(self, place, whole, value, status)
    class(number_records), intent(inout) :: self
    integer, intent(in) :: place(2), whole(:)
    real(dp), intent(in) :: value(:)
    integer, intent(inout) :: status

    if (.not. allocated(self%whole) .and. status == 0) &
      allocate (self%whole(size(whole), 0), self%value(size(value), 0), self%place(2, 0), stat=status)
    if (status == 0) call make_room(self%whole, self%count, status)
    if (status == 0) call make_room(self%value, self%count, status)
    if (status == 0) call make_room(self%place, self%count, status)
    if (status /= 0) return
    self%count = self%count + 1
    self%whole(:, self%count) = whole
    self%value(:, self%count) = value
    self%place(:, self%count) = place
  end subroutine append

  !> Add a record whose first whole number is its name; not `is_new` if there is one of this name, and nothing is added.
  !> Records are either all named or none.
  pure subroutine append_named(self, place, whole, value, is_new, status)
    class(number_records), intent(inout) :: self
    integer, intent(in) :: place(2), whole(:)
    real(dp), intent(in) :: value(:)
    logical, intent(out) :: is_new
    integer, intent(inout) :: status
    integer :: number

    is_new = .false.
    if (status == 0) call self%identities%number_of(whole(1), 0, number, status)
    if (status /= 0) return
    is_new = number > self%count
    if (is_new) call self%append(place, whole, value, status)
  end subroutine append_named

  !> The record of this name, 0 if there is none.
  pure function find(self, name) result(number)
    class(number_records), intent(in) :: self
    integer, intent(in) :: name
    integer :: number

    number = self%identities%find(name, 0)
  end function find

end module fuge_number_records
