!> Which points change sides after the forces of a contact set are known, where the
!> points are cells in a row.
!>
!> Pressed together as far as x = b, bodies that want to touch as far as a < b pull
!> beyond (a + b)/2, where the pressure ((a^2 + b^2)/2 - x^2)/sqrt(b^2 - x^2) changes its
!> sign: twice as many cells must leave as pull. For a > b the gap beyond b goes on
!> falling for half the way and is closed for one and a half: two cells in three that
!> penetrate must join.
module fuge_set_exchange
  implicit none
  private

  public :: exchange, exchange_in_row

  !> A run of so many cells is known well enough.
  integer, parameter :: LONG_RUN = 8

contains

  !> Every point that pulls leaves, every one that penetrates joins. All (n).
  pure subroutine exchange(pulls, penetrates, contact)
    logical, intent(in) :: pulls(:), penetrates(:)
    logical, intent(inout) :: contact(:)

    contact = (contact .and. .not. pulls) .or. penetrates
  end subroutine exchange

  !> The same with the foresight of the theory above, at the ends of each stretch of
  !> contact, of which one cell at least stays.
  pure subroutine exchange_in_row(pulls, penetrates, contact)
    logical, intent(in) :: pulls(:), penetrates(:)
    logical, intent(inout) :: contact(:)
    integer :: first, last

    call exchange(pulls, penetrates, contact)
    first = 1
    do
      call next_run(pulls, first, last)
      if (first > size(pulls)) exit
      call release_more(first, last, contact)
      first = last + 1
    end do
    first = 1
    do
      call next_run(penetrates, first, last)
      if (first > size(pulls)) exit
      call join_fewer(first, last, contact)
      first = last + 1
    end do
  end subroutine exchange_in_row

  !> The first run of true elements from `first` on; first > n if there is none.
  pure subroutine next_run(mask, first, last)
    logical, intent(in) :: mask(:)
    integer, intent(inout) :: first
    integer, intent(out) :: last

    do while (first <= size(mask))
      if (mask(first)) exit
      first = first + 1
    end do
    last = first
    do while (last < size(mask))
      if (.not. mask(last + 1)) exit
      last = last + 1
    end do
  end subroutine next_run

  !> A run that pulls at one end of a stretch takes as many cells with it; a short one
  !> two fewer, because the grid may make it too long by those.
  pure subroutine release_more(first, last, contact)
    integer, intent(in) :: first, last
    logical, intent(inout) :: contact(:)
    integer :: more, k
    logical :: touches_before, touches_after

    more = last - first + 1
    if (more < LONG_RUN) more = more - 2
    if (more < 1) return
    touches_before = .false.
    touches_after = .false.
    if (first > 1) touches_before = contact(first - 1)
    if (last < size(contact)) touches_after = contact(last + 1)
    if (touches_before .eqv. touches_after) return
    do k = 1, more
      if (touches_after) then
        if (last + k + 1 > size(contact)) exit
        ! The last cell of a stretch stays.
        if (.not. contact(last + k + 1)) exit
        contact(last + k) = .false.
      else
        if (first - k - 1 < 1) exit
        if (.not. contact(first - k - 1)) exit
        contact(first - k) = .false.
      end if
    end do
  end subroutine release_more

  !> Of a run that penetrates at one end of a stretch the far third stays open.
  pure subroutine join_fewer(first, last, contact)
    integer, intent(in) :: first, last
    logical, intent(inout) :: contact(:)
    integer :: few
    logical :: touches_before, touches_after

    few = (last - first + 1)/3
    touches_before = .false.
    touches_after = .false.
    if (first > 1) touches_before = contact(first - 1)
    if (last < size(contact)) touches_after = contact(last + 1)
    if (touches_before .eqv. touches_after) return
    if (touches_before) then
      contact(last - few + 1:last) = .false.
    else
      contact(first:first + few - 1) = .false.
    end if
  end subroutine join_fewer

end module fuge_set_exchange
