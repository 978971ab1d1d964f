!> The exchange of points of a line of cells that ranks may share: fuge_set_exchange looks beyond the cells of a rank.
module fuge_shared_exchange
  use fuge_kinds, only: dp
  use fuge_set_exchange, only: exchange_extrapolated
  use fuge_shared_rows, only: shared_rows
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: count_segments, exchange_in_line

  !> States of a cell, as a number that ranks exchange.
  real(dp), parameter :: OPEN = 0.0_dp, CONTACT_STATE = 1.0_dp, TENSILE_STATE = 2.0_dp, PENETRATING_STATE = 3.0_dp
  !> The exchange of a cell depends on those up to RUNS lengths of the longest run of wrong cells, and MORE, away: a run
  !> of penetrating cells by the tensile run beyond the segment beside it, that one by the run at the other end of its
  !> own segment, and each reaches about as far as it is long.
  integer, parameter :: RUNS = 5, MORE = 8

contains

  !> As exchange_extrapolated, where ranks may share the cells. Error: FUGE_ERR_MEMORY.
  subroutine exchange_in_line(rows, tensile, penetrating, measure, contact, info)
    type(shared_rows), intent(in) :: rows
    logical, intent(in) :: tensile(:), penetrating(:)
    real(dp), intent(in), contiguous :: measure(:)
    logical, intent(inout) :: contact(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: part(:)
    integer :: own(2), first(0:rows%members() - 1)

    if (rows%is_alone()) then
      call exchange_extrapolated(tensile, penetrating, measure, contact)
    else if (rows%everywhere(size(contact) == 0 .or. size(contact) == product(rows%cells))) then
      ! One rank has them all.
      call exchange_extrapolated(tensile, penetrating, measure, contact)
    else
      call fetch_neighbours(rows, tensile, penetrating, measure, contact, first, part, info)
      if (info%failed()) return
      own = rows%own()
      if (size(contact) > 0) call exchange_part(part, own(1) - first(rows%number()), contact, info)
      call rows%agree(info)
    end if
  end subroutine exchange_in_line

  !> `part`: states and measures, in turn, of the cells of this rank and of all those that decide on them; `first`
  !> (0:ranks - 1) the first of these cells for each rank.
  subroutine fetch_neighbours(rows, tensile, penetrating, measure, contact, first, part, info)
    type(shared_rows), intent(in) :: rows
    logical, intent(in) :: tensile(:), penetrating(:), contact(:)
    real(dp), intent(in), contiguous :: measure(:)
    integer, intent(out) :: first(0:)
    real(dp), allocatable, intent(out) :: part(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: values(:)
    integer :: last(0:size(first) - 1), k, r, reach, stat

    allocate (values(2*size(contact)), stat=stat)
    call require_memory(stat, 'the contact set of', size(contact), 'points', info)
    call rows%agree(info)
    first = 0
    if (stat /= 0 .or. info%failed()) return
    do k = 1, size(contact)
      values(2*k - 1) = merge(CONTACT_STATE, OPEN, contact(k))
      if (tensile(k)) values(2*k - 1) = TENSILE_STATE
      if (penetrating(k)) values(2*k - 1) = PENETRATING_STATE
      values(2*k) = measure(k)
    end do
    reach = max(longest_run(rows, tensile), longest_run(rows, penetrating))
    ! Not beyond the line, so that nothing overflows.
    reach = min(reach, (product(rows%cells) - MORE)/RUNS + 1)*RUNS + MORE
    do r = 0, size(first) - 1
      first(r) = max(rows%first(r) - reach, 1)
      last(r) = rows%first(r + 1) - 1
      last(r) = last(r) + min(reach, product(rows%cells) - last(r))
      if (rows%first(r + 1) == rows%first(r)) last(r) = first(r) - 1
    end do
    call rows%fetch(2, values, first, last, part, info)
  end subroutine fetch_neighbours

  !> Exchange the cells of `part`, and take from it those of this rank, which begin behind `before` others. Error:
  !> FUGE_ERR_MEMORY.
  pure subroutine exchange_part(part, before, contact, info)
    real(dp), intent(in), contiguous :: part(:)
    integer, intent(in) :: before
    logical, intent(inout) :: contact(:)
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: tensile(:), penetrating(:), all_contact(:)
    real(dp), allocatable :: measure(:)
    integer :: k, n, stat

    n = size(part)/2
    allocate (tensile(n), penetrating(n), all_contact(n), measure(n), stat=stat)
    call require_memory(stat, 'the contact set of', n, 'points', info)
    if (stat /= 0) return
    do k = 1, size(measure)
      associate (state => part(2*k - 1))
        tensile(k) = abs(state - TENSILE_STATE) <= 0.0_dp
        penetrating(k) = abs(state - PENETRATING_STATE) <= 0.0_dp
        all_contact(k) = tensile(k) .or. abs(state - CONTACT_STATE) <= 0.0_dp
      end associate
      measure(k) = part(2*k)
    end do
    call exchange_extrapolated(tensile, penetrating, measure, all_contact)
    contact = all_contact(before + 1:before + size(contact))
  end subroutine exchange_part

  !> The longest run of true cells, which may go over several ranks.
  function longest_run(rows, mask) result(longest)
    type(shared_rows), intent(in) :: rows
    logical, intent(in) :: mask(:)
    integer :: longest
    real(dp) :: runs(4, 0:rows%members() - 1), open_run
    integer :: r

    ! Of each rank: the longest run, that at the beginning, that at the end; 1 if they are all its cells.
    runs = 0.0_dp
    runs(:, rows%number()) = runs_of(mask)
    call sum_columns(rows, runs)
    longest = 0
    open_run = 0.0_dp
    do r = 0, ubound(runs, 2)
      longest = max(longest, int(runs(1, r)), int(open_run + runs(2, r)))
      if (runs(4, r) > 0.0_dp) then
        open_run = open_run + runs(2, r)
      else
        open_run = runs(3, r)
      end if
    end do
  end function longest_run

  pure function runs_of(mask) result(runs)
    logical, intent(in) :: mask(:)
    real(dp) :: runs(4)
    integer :: k, longest, run

    longest = 0
    run = 0
    do k = 1, size(mask)
      run = merge(run + 1, 0, mask(k))
      longest = max(longest, run)
    end do
    runs = real([longest, 0, run, merge(1, 0, all(mask))], dp)
    do k = 1, size(mask)
      if (.not. mask(k)) exit
      runs(2) = real(k, dp)
    end do
  end function runs_of

  !> Number of runs of cells in contact, which may go over several ranks.
  function count_segments(rows, contact) result(number)
    type(shared_rows), intent(in) :: rows
    logical, intent(in) :: contact(:)
    integer :: number
    real(dp) :: ends(4, 0:rows%members() - 1)
    integer :: n, r
    logical :: before

    n = size(contact)
    number = count(contact(2:n) .and. .not. contact(1:n - 1))
    if (n > 0) number = number + merge(1, 0, contact(1))
    if (rows%is_alone()) return
    ! Of each rank: the runs that begin in it; 1 if it has cells; 1 if the first, and the last one are in contact.
    ends = 0.0_dp
    if (n > 0) ends(:, rows%number()) = real([number, 1, merge(1, 0, contact(1)), merge(1, 0, contact(n))], dp)
    call sum_columns(rows, ends)
    number = 0
    before = .false.
    do r = 0, ubound(ends, 2)
      if (.not. ends(2, r) > 0.0_dp) cycle
      number = number + int(ends(1, r))
      if (before .and. ends(3, r) > 0.0_dp) number = number - 1
      before = ends(4, r) > 0.0_dp
    end do
  end function count_segments

  !> Sum the `columns` of all ranks, of which each has set its own.
  subroutine sum_columns(rows, columns)
    type(shared_rows), intent(in) :: rows
    real(dp), intent(inout), contiguous :: columns(:, :)
    real(dp) :: values(size(columns))

    values = reshape(columns, shape(values))
    call rows%add(values)
    columns = reshape(values, shape(columns))
  end subroutine sum_columns

end module fuge_shared_exchange
