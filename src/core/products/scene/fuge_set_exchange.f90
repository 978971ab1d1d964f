!> The exchange step of the contact set search: which points leave and which join the contact
!> set, once the forces of the present set are known.
!>
!> Where the points are cells in a row, the exchange extrapolates to the true edge of contact.
!> Let a contact segment be solved up to x = b while the true edge is at x = a.
!> For a < b the pressure ((a^2 + b^2)/2 - x^2)/sqrt(b^2 - x^2) changes sign at about (a + b)/2:
!> twice as many cells must leave as are in tension. For a > b the gap beyond b is negative over
!> 3/2 of a - b: two of three penetrating cells must join (doc/theory.md). Near the edge the pressure times
!> sqrt(b - x), and the gap over sqrt(x - b), are linear, which locates their zeros between the middles of two
!> cells: a cell stays in contact as long as it would not be tensile, and joins if its middle is within the true edge.
module fuge_set_exchange
  use fuge_kinds, only: dp
  use fuge_marked_runs, only: next_run
  implicit none
  private

  public :: exchange, exchange_extrapolated

contains

  !> Every tensile point leaves the contact set, every penetrating point joins it. All (n).
  pure subroutine exchange(tensile, penetrating, contact)
    logical, intent(in) :: tensile(:), penetrating(:)
    logical, intent(inout) :: contact(:)

    contact = (contact .and. .not. tensile) .or. penetrating
  end subroutine exchange

  !> As `exchange`, but extrapolates to the true edge at the ends of contact segments, as derived
  !> above. At least one cell of each segment stays in contact.
  !>
  !> All (n); `measure`: at points in contact the force, positive where it pushes at its stop; at open points the
  !> distance from the stop, negative where they penetrate.
  pure subroutine exchange_extrapolated(tensile, penetrating, measure, contact)
    logical, intent(in) :: tensile(:), penetrating(:)
    real(dp), intent(in) :: measure(:)
    logical, intent(inout) :: contact(:)
    integer :: first, last

    call exchange(tensile, penetrating, contact)
    last = 0
    do
      call next_run(tensile, last + 1, first, last)
      if (first > size(tensile)) exit
      call extend_release(first, last, measure, contact)
    end do
    last = 0
    do
      call next_run(penetrating, last + 1, first, last)
      if (first > size(penetrating)) exit
      call shorten_joining(first, last, measure, contact)
    end do
  end subroutine exchange_extrapolated

  !> A tensile run at one end of a segment takes more cells with it, up to twice as many in all.
  pure subroutine extend_release(first, last, measure, contact)
    integer, intent(in) :: first, last
    real(dp), intent(in) :: measure(:)
    logical, intent(inout) :: contact(:)
    integer :: more, cells, k
    real(dp) :: beside
    logical :: contact_before, contact_after

    call find_neighbours(first, last, contact, contact_before, contact_after)
    if (contact_before .eqv. contact_after) return
    cells = last - first + 1
    if (contact_after) then
      beside = measure(last + 1)
      more = released(cells, weighted(measure(last), cells, 0.5_dp), weighted(beside, cells + 1, 0.5_dp)) - cells
    else
      beside = measure(first - 1)
      more = released(cells, weighted(measure(first), cells, 0.5_dp), weighted(beside, cells + 1, 0.5_dp)) - cells
    end if
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

  !> Of a penetrating run at one end of a segment the cells beyond the true edge stay open, but for the first one.
  pure subroutine shorten_joining(first, last, measure, contact)
    integer, intent(in) :: first, last
    real(dp), intent(in) :: measure(:)
    logical, intent(inout) :: contact(:)
    integer :: cells, joining
    real(dp) :: outer
    logical :: contact_before, contact_after

    call find_neighbours(first, last, contact, contact_before, contact_after)
    if (contact_before .eqv. contact_after) return
    cells = last - first + 1
    ! At the end of the row nothing tells how far the penetration would reach.
    outer = 0.0_dp
    if (contact_before) then
      if (last < size(contact)) outer = weighted(measure(last + 1), cells + 1, -0.5_dp)
      joining = joined(cells, weighted(measure(last), cells, -0.5_dp), outer)
      contact(first + joining:last) = .false.
    else
      if (first > 1) outer = weighted(measure(first - 1), cells + 1, -0.5_dp)
      joining = joined(cells, weighted(measure(first), cells, -0.5_dp), outer)
      contact(first:last - joining) = .false.
    end if
  end subroutine shorten_joining

  !> `value` in the cell `number` from the edge, times its distance from the edge to the power `exponent`.
  pure function weighted(value, number, exponent)
    real(dp), intent(in) :: value, exponent
    integer, intent(in) :: number
    real(dp) :: weighted

    weighted = value*(real(number, dp) - 0.5_dp)**exponent
  end function weighted

  !> How many cells leave where `cells` are tensile: `inside` < 0 is the weighted force of the last of them, `beside`
  !> that of the next cell, in compression; else only those that are tensile.
  pure function released(cells, inside, beside)
    integer, intent(in) :: cells
    real(dp), intent(in) :: inside, beside
    integer :: released

    released = cells
    if (inside < 0.0_dp .and. beside > 0.0_dp) released = ceiling(2.0_dp*zero_crossing(cells, inside, beside)) - 1
    released = max(released, cells)
  end function released

  !> How many cells join where `cells` penetrate: `inside` < 0 is the weighted gap of the last of them, `beside` that of
  !> the next cell.
  pure function joined(cells, inside, beside)
    integer, intent(in) :: cells
    real(dp), intent(in) :: inside, beside
    integer :: joined
    real(dp) :: reach

    reach = real(cells, dp) - 0.5_dp
    if (inside < 0.0_dp .and. beside > 0.0_dp) reach = zero_crossing(cells, inside, beside)
    joined = min(max(floor(2.0_dp/3.0_dp*reach + 0.5_dp), 1), cells)
  end function joined

  !> Distance from the edge, in cells, at which a linear function vanishes that is `inside` < 0 in the middle of the
  !> cell number `cells` and `beside` > 0 in that of the next one.
  pure function zero_crossing(cells, inside, beside) result(distance)
    integer, intent(in) :: cells
    real(dp), intent(in) :: inside, beside
    real(dp) :: distance

    ! Halved, a difference of large numbers does not overflow.
    distance = real(cells, dp) - 0.5_dp - 0.5_dp*inside/(0.5_dp*beside - 0.5_dp*inside)
  end function zero_crossing

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
