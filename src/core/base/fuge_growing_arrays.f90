!> Arrays that grow: lists whose length is known only at their end.
!>
!> The owner counts the entries in use; the array may be longer. Each call does nothing unless `stat` is zero, so that
!> several can follow each other. Without memory `stat` is not zero, and the array is as before.
module fuge_growing_arrays
  use fuge_kinds, only: dp
  implicit none
  private

  public :: make_room, resize

  !> Entries that the first allocation has room for.
  integer, parameter :: FIRST_LENGTH = 64

  !> Make room for one more entry after the first `count`: a full array becomes twice as long, so that n entries cost of
  !> the order of n copies in all.
  interface make_room
    module procedure make_room_for_integer
    module procedure make_room_for_real
    module procedure make_room_for_integer_column
    module procedure make_room_for_real_column
  end interface make_room

  !> Change the length of an array, and keep the entries that fit. A matrix, which has to be allocated, keeps its rows
  !> and changes the number of its columns.
  interface resize
    module procedure resize_integers
    module procedure resize_reals
    module procedure resize_integer_columns
    module procedure resize_real_columns
  end interface resize

contains

  pure subroutine make_room_for_integer(list, count, stat)
    integer, allocatable, intent(inout) :: list(:)
    integer, intent(in) :: count
    integer, intent(inout) :: stat
    integer :: room

    room = 0
    if (allocated(list)) room = size(list)
    if (count >= room) call resize(list, twice(room), stat)
  end subroutine make_room_for_integer

  pure subroutine make_room_for_real(list, count, stat)
    real(dp), allocatable, intent(inout) :: list(:)
    integer, intent(in) :: count
    integer, intent(inout) :: stat
    integer :: room

    room = 0
    if (allocated(list)) room = size(list)
    if (count >= room) call resize(list, twice(room), stat)
  end subroutine make_room_for_real

  pure subroutine make_room_for_integer_column(matrix, count, stat)
    integer, allocatable, intent(inout) :: matrix(:, :)
    integer, intent(in) :: count
    integer, intent(inout) :: stat

    if (count >= size(matrix, 2)) call resize(matrix, twice(size(matrix, 2)), stat)
  end subroutine make_room_for_integer_column

  pure subroutine make_room_for_real_column(matrix, count, stat)
    real(dp), allocatable, intent(inout) :: matrix(:, :)
    integer, intent(in) :: count
    integer, intent(inout) :: stat

    if (count >= size(matrix, 2)) call resize(matrix, twice(size(matrix, 2)), stat)
  end subroutine make_room_for_real_column

  !> The length that a full array gets; -1 if there is none.
  pure function twice(length) result(longer)
    integer, intent(in) :: length
    integer :: longer

    longer = -1
    if (length <= shiftr(huge(length), 1)) longer = max(2*length, FIRST_LENGTH)
  end function twice

  pure subroutine resize_integers(list, length, stat)
    integer, allocatable, intent(inout) :: list(:)
    integer, intent(in) :: length
    integer, intent(inout) :: stat
    integer, allocatable :: resized(:)
    integer :: kept

    call check_length(length, stat)
    if (stat == 0) allocate (resized(length), stat=stat)
    if (stat /= 0) return
    if (allocated(list)) then
      kept = min(size(list), length)
      resized(:kept) = list(:kept)
    end if
    call move_alloc(resized, list)
  end subroutine resize_integers

  pure subroutine resize_reals(list, length, stat)
    real(dp), allocatable, intent(inout) :: list(:)
    integer, intent(in) :: length
    integer, intent(inout) :: stat
    real(dp), allocatable :: resized(:)
    integer :: kept

    call check_length(length, stat)
    if (stat == 0) allocate (resized(length), stat=stat)
    if (stat /= 0) return
    if (allocated(list)) then
      kept = min(size(list), length)
      resized(:kept) = list(:kept)
    end if
    call move_alloc(resized, list)
  end subroutine resize_reals

  pure subroutine resize_integer_columns(matrix, columns, stat)
    integer, allocatable, intent(inout) :: matrix(:, :)
    integer, intent(in) :: columns
    integer, intent(inout) :: stat
    integer, allocatable :: resized(:, :)
    integer :: kept

    call check_length(columns, stat)
    if (stat == 0) allocate (resized(size(matrix, 1), columns), stat=stat)
    if (stat /= 0) return
    kept = min(size(matrix, 2), columns)
    resized(:, :kept) = matrix(:, :kept)
    call move_alloc(resized, matrix)
  end subroutine resize_integer_columns

  pure subroutine resize_real_columns(matrix, columns, stat)
    real(dp), allocatable, intent(inout) :: matrix(:, :)
    integer, intent(in) :: columns
    integer, intent(inout) :: stat
    real(dp), allocatable :: resized(:, :)
    integer :: kept

    call check_length(columns, stat)
    if (stat == 0) allocate (resized(size(matrix, 1), columns), stat=stat)
    if (stat /= 0) return
    kept = min(size(matrix, 2), columns)
    resized(:, :kept) = matrix(:, :kept)
    call move_alloc(resized, matrix)
  end subroutine resize_real_columns

  !> A negative length is one that no integer can count.
  pure subroutine check_length(length, stat)
    integer, intent(in) :: length
    integer, intent(inout) :: stat

    if (stat == 0 .and. length < 0) stat = 1
  end subroutine check_length

end module fuge_growing_arrays
