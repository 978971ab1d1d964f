!> The exchange step of the contact set search: which points leave and which join the contact
!> set, once the forces of the present set are known.
!>
!> Where the points are cells in a row, the exchange extrapolates to the true edge of contact.
!> Let a contact segment be solved up to x = b while the true edge is at x = a.
!> For a < b the pressure ((a^2 + b^2)/2 - x^2)/sqrt(b^2 - x^2) changes sign at about (a + b)/2:
!> twice as many cells must leave as are in tension. For a > b the gap beyond b is negative over
!> 3/2 of a - b: two of three penetrating cells must join (doc/theory.md).
module fuge_set_exchange
  implicit none
  private

  public :: exchange, exchange_extrapolated

  !> Runs of at least this many cells locate the edge well enough to extrapolate in full.
  integer, parameter :: LONG_RUN = 8

contains

  !> Every tensile point leaves the contact set, every penetrating point joins it. All (n).
  pure subroutine exchange(tensile, penetrating, contact)
    logical, intent(in) :: tensile(:), penetrating(:)
    logical, intent(inout) :: contact(:)

    contact = (contact .and. .not. tensile) .or. penetrating
  end subroutine exchange

  !> As `exchange`, but extrapolates to the true edge at the ends of contact segments, as derived
  !> above. At least one cell of each segment stays in contact. All (n).
  pure subroutine exchange_extrapolated(tensile, penetrating, contact)
    logical, intent(in) :: tensile(:), penetrating(:)
    logical, intent(inout) :: contact(:)
    integer :: first, last

    call exchange(tensile, penetrating, contact)
    first = 1
    do
      call next_run(tensile, first, last)
      if (first > size(tensile)) exit
      call extend_release(first, last, contact)
      first = last + 1
    end do
    first = 1
    do
      call next_run(penetrating, first, last)
      if (first > size(penetrating)) exit
      call shorten_joining(first, last, contact)
      first = last + 1
    end do
  end subroutine exchange_extrapolated

  !> The next run of true elements at or after `first`; first > n if there is none.
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

  !> A tensile run at one end of a segment takes as many cells again with it; a short run takes
  !> two fewer, because the grid alone may make it longer by two.
  pure subroutine extend_release(first, last, contact)
    integer, intent(in) :: first, last
    logical, intent(inout) :: contact(:)
    integer :: more, k
    logical :: contact_before, contact_after

    more = last - first + 1
    if (more < LONG_RUN) more = more - 2
    if (more < 1) return
    call find_neighbours(first, last, contact, contact_before, contact_after)
    if (contact_before .eqv. contact_after) return
    do k = 1, more
      if (contact_after) then
        if (last + k + 1 > size(contact)) exit
        ! The last cell of a segment stays.
        if (.not. contact(last + k + 1)) exit
        contact(last + k) = .false.
      else
        if (first - k - 1 < 1) exit
        if (.not. contact(first - k - 1)) exit
        contact(first - k) = .false.
      end if
    end do
  end subroutine extend_release

  !> The far third of a penetrating run at one end of a segment stays open.
  pure subroutine shorten_joining(first, last, contact)
    integer, intent(in) :: first, last
    logical, intent(inout) :: contact(:)
    integer :: third
    logical :: contact_before, contact_after

    third = (last - first + 1)/3
    call find_neighbours(first, last, contact, contact_before, contact_after)
    if (contact_before .eqv. contact_after) return
    if (contact_before) then
      contact(last - third + 1:last) = .false.
    else
      contact(first:first + third - 1) = .false.
    end if
  end subroutine shorten_joining

  !> Are the points before `first` and after `last` in contact?
  pure subroutine find_neighbours(first, last, contact, contact_before, contact_after)
    integer, intent(in) :: first, last
    logical, intent(in) :: contact(:)
    logical, intent(out) :: contact_before, contact_after

    contact_before = .false.
    contact_after = .false.
    if (first > 1) contact_before = contact(first - 1)
    if (last < size(contact)) contact_after = contact(last + 1)
  end subroutine find_neighbours

end module fuge_set_exchange
