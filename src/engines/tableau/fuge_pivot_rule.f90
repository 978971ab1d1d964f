!> Which column enters the tableau's basis and which row leaves: pure selection.
!>
!> The paper (section 3, step 2) asks for (a) no negative right-hand side, (b1) a
!> negative entry in the last row, (b2) no force beside its own gap, (b3) no
!> artificial twice. Of the columns so admitted its tables take the lowest that
!> drives an artificial out, else the lowest. Ties of the ratio test are decided
!> lexicographically, which keeps degenerate problems from cycling.
!>
!> Beyond the paper, a variable may be free of sign, or have an upper limit (the play of
!> a gap): `fuge_variable_bounds`. A column that reaches its own limit leaves the basis as
!> it is.
!>
!> The tableau is scaled: its lengths and forces are of order 1, so that small
!> numbers here are relative to the data.
module fuge_pivot_rule
  use fuge_kinds, only: dp
  use fuge_column_numbers, only: partner_column, is_artificial, stored_columns
  use fuge_options_type, only: FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE
  use fuge_variable_bounds, only: variable_limits
  implicit none
  private

  public :: select_pivot, select_for_equilibrium, leaving_row

  !> A last-row entry is negative below this part of its column.
  real(dp), parameter :: ENTRY_TOLERANCE = 1.0e-11_dp
  !> A pivot is positive above this part of its column.
  real(dp), parameter :: PIVOT_TOLERANCE = 1.0e-11_dp
  !> Right-hand sides that differ by less are tied.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-13_dp
  !> What is left of resultants of order 1 below this is rounding.
  real(dp), parameter :: BALANCE_TOLERANCE = 1.0e-10_dp
  !> Instead of a row: the column can enter without end.
  integer, parameter, public :: NOTHING_LEAVES = -huge(1)

contains

  !> The next pivot by `rule`; `column` = 0 when no column is admissible.
  !>
  !> `table` (n+m+1, 2n+m+1) is the tableau with the z row last and the right-hand
  !> side in the last column, `basis` (n+m) the column number of each row. `row` is
  !> negative if its variable leaves at its upper limit, and 0 if none leaves because
  !> `column` reaches its own.
  pure subroutine select_pivot(table, basis, limits, rule, column, row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), rule
    type(variable_limits), intent(in) :: limits
    integer, intent(out) :: column, row
    logical :: basic(size(limits%free)), artificial(size(basis)), held(size(basis)), tied(0:size(basis))
    real(dp) :: entering(size(table, 1)), room(size(basis)), step, merit, best
    integer :: j, r, last, way

    last = size(table, 1)
    basic = .false.
    basic(basis) = .true.
    artificial = is_artificial(limits%n, limits%m, basis)
    held = .not. limits%free(basis)
    room = limits%room(basis)
    column = 0
    row = 0
    best = 0.0_dp
    do j = 1, stored_columns(limits%n, limits%m)
      if (basic(j) .or. limits%fixed(j)) cycle
      way = improving_way(table(:, j), artificial, limits%free(j))
      if (way == 0) cycle
      entering = real(way, dp)*table(:, j)
      call ratio_test(entering(:last - 1), table(:last - 1, size(table, 2)), held, room, limits%room(j), step, tied)
      if (.not. any(tied)) cycle
      ! Before ties are decided, which is dear: can this column win at all?
      if (column > 0 .and. merit_of(rule, entering(last), step, any(tied(1:) .and. artificial)) <= best) cycle
      r = decide(table, entering(:last - 1), limits, tied)
      if (is_barred(basic, limits%n, j, basis, r)) cycle
      merit = merit_of(rule, entering(last), step, drives_out(artificial, r))
      if (column > 0 .and. merit <= best) cycle
      column = j
      row = r
      best = merit
      if (rule == FUGE_PAPER_RULE .and. merit > 0.0_dp) exit
    end do
  end subroutine select_pivot

  !> The next pivot as long as an artificial is left in the equilibrium rows, on these rows
  !> alone: the simplex method by least column numbers (R. G. Bland, Mathematics of
  !> Operations Research 2, 1977), which cannot cycle; for the paper's problem, F_1. An
  !> artificial that is left at zero goes against the largest entry of its row.
  !>
  !> Arguments as above; `column` = 0 if no forces can carry the resultant.
  pure subroutine select_for_equilibrium(table, basis, limits, column, row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:)
    type(variable_limits), intent(in) :: limits
    integer, intent(out) :: column, row
    real(dp) :: part(limits%m + 1), rest(limits%m), free_room(limits%m), step
    logical :: basic(size(limits%free)), artificial(limits%m), tied(0:limits%m)
    integer :: j, n, way

    n = limits%n
    basic = .false.
    basic(basis) = .true.
    artificial = is_artificial(n, limits%m, basis(n + 1:))
    rest = table(n + 1:n + limits%m, size(table, 2))
    free_room = huge(free_room)
    row = 0
    do column = 1, n
      if (basic(column) .or. limits%fixed(column)) cycle
      part(:limits%m) = table(n + 1:n + limits%m, column)
      part(limits%m + 1) = -sum(part(:limits%m), mask=artificial)
      way = improving_way(part, artificial, limits%free(column))
      if (way == 0) cycle
      call ratio_test(way*part(:limits%m), rest, .not. limits%free(basis(n + 1:)), free_room, huge(step), step, tied)
      if (.not. any(tied)) cycle
      row = n + minloc(basis(n + 1:), dim=1, mask=tied(1:))
      return
    end do
    column = 0
    if (sum(rest, mask=artificial) > BALANCE_TOLERANCE) return
    row = n + first_true(artificial)
    part(1) = 0.0_dp
    do j = 1, n
      if (basic(j) .or. limits%fixed(j) .or. abs(table(row, j)) <= part(1)) cycle
      column = j
      part(1) = abs(table(row, j))
    end do
  end subroutine select_for_equilibrium

  !> Condition (b1): a negative entry in the last row, which is minus the sum over the
  !> rows of the artificials: compared with what that sum is made of. 1, or -1 for a
  !> free variable that has to fall; 0 if z would not.
  pure function improving_way(column, artificial, free) result(way)
    real(dp), intent(in) :: column(:)
    logical, intent(in) :: artificial(:), free
    integer :: way
    real(dp) :: rounding
    integer :: last

    last = size(column)
    rounding = ENTRY_TOLERANCE*sum(abs(column(:last - 1)), mask=artificial)
    way = 0
    if (column(last) < -rounding) way = 1
    if (free .and. column(last) > rounding) way = -1
  end function improving_way

  !> Condition (b2): the partner would stay in the basis, or leave it for its upper limit.
  pure function is_barred(basic, n, column, basis, row)
    logical, intent(in) :: basic(:)
    integer, intent(in) :: n, column, basis(:), row
    logical :: is_barred
    integer :: partner

    partner = partner_column(n, column)
    is_barred = .false.
    if (partner > 0) is_barred = basic(partner)
    if (is_barred .and. row > 0) is_barred = basis(row) /= partner
  end function is_barred

  pure function drives_out(artificial, row)
    logical, intent(in) :: artificial(:)
    integer, intent(in) :: row
    logical :: drives_out

    drives_out = .false.
    if (row > 0) drives_out = artificial(row)
  end function drives_out

  !> What the rule prefers is larger; of equals the lowest column stays. `entry` is that
  !> of the last row, `step` how far the column can enter, `artificial` whether it
  !> drives an artificial out.
  pure function merit_of(rule, entry, step, artificial) result(merit)
    integer, intent(in) :: rule
    real(dp), intent(in) :: entry, step
    logical, intent(in) :: artificial
    real(dp) :: merit

    select case (rule)
    case (FUGE_MOST_NEGATIVE)
      merit = -entry
    case (FUGE_GREATEST_DECREASE)
      merit = -entry*step
    case default
      merit = merge(1.0_dp, 0.0_dp, artificial)
    end select
  end function merit_of

  !> Condition (a): the row whose variable first reaches a limit as `column` enters, or one
  !> of the other values of `row` above.
  pure function leaving_row(table, basis, limits, column) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), column
    type(variable_limits), intent(in) :: limits
    integer :: row
    logical :: tied(0:size(basis))
    real(dp) :: step

    call ratio_test(table(:size(basis), column), table(:size(basis), size(table, 2)), .not. limits%free(basis), &
                    limits%room(basis), limits%room(column), step, tied)
    row = NOTHING_LEAVES
    if (any(tied)) row = decide(table, table(:size(basis), column), limits, tied)
  end function leaving_row

  !> How far a column can enter, and what stops it there: rows, or in place 0 its own
  !> limit `own_room`; none if it can enter without end.
  !>
  !> `entering` its entries, `rest` the right-hand sides, `held` the rows of variables that
  !> must not turn negative, `room` how far they may rise.
  pure subroutine ratio_test(entering, rest, held, room, own_room, step, tied)
    real(dp), intent(in) :: entering(:), rest(:), room(:), own_room
    logical, intent(in) :: held(:)
    real(dp), intent(out) :: step
    logical, intent(out) :: tied(0:)
    real(dp) :: smallest
    integer :: i

    smallest = PIVOT_TOLERANCE*maxval(abs(entering))
    step = own_room
    do i = 1, size(entering)
      tied(i) = held(i) .and. (entering(i) > smallest .or. (entering(i) < -smallest .and. room(i) < huge(step)))
      if (tied(i)) step = min(step, way_left(entering(i), rest(i), room(i))/abs(entering(i)))
    end do
    tied(0) = own_room < huge(step)
    if (tied(0)) tied(0) = own_room - step <= TIE_TOLERANCE
    do i = 1, size(entering)
      if (tied(i)) tied(i) = way_left(entering(i), rest(i), room(i)) - step*abs(entering(i)) <= TIE_TOLERANCE
    end do
  end subroutine ratio_test

  !> From the value `rest` to the limit that it approaches.
  pure function way_left(entry, rest, room) result(way)
    real(dp), intent(in) :: entry, rest, room
    real(dp) :: way

    way = rest
    if (entry < 0.0_dp) way = room - rest
  end function way_left

  !> The one of the tied rows that leaves, in the convention of `row` above.
  pure function decide(table, entering, limits, tied) result(row)
    real(dp), intent(in) :: table(:, :), entering(:)
    type(variable_limits), intent(in) :: limits
    logical, intent(in) :: tied(0:)
    integer :: row

    row = first_true(tied) - 1
    if (count(tied) > 1) row = lexicographic_least(table, entering, limits, tied)
    if (row > 0) then
      if (entering(row) < 0.0_dp) row = -row
    end if
  end function decide

  !> Of tied rows the one whose row of the inverse basis, divided by its pivot, is
  !> lexicographically least: as if the value of the first basis in row k had been raised
  !> by epsilon^k. In place 0, the limit of the column itself, nothing was raised.
  !>
  !> The inverse basis, in terms of the first one, stands in the columns of the latter.
  !> In the paper's problem that of F_1 is not needed: two rows that agree in all others
  !> cannot both belong to a regular basis with F_0 > 0.
  pure function lexicographic_least(table, entering, limits, tied) result(row)
    real(dp), intent(in) :: table(:, :), entering(:)
    type(variable_limits), intent(in) :: limits
    logical, intent(in) :: tied(0:)
    integer :: row
    logical :: left(0:size(entering))
    real(dp) :: raised(0:size(entering)), pivot(0:size(entering)), least
    integer :: i, k

    left = tied
    pivot(0) = 1.0_dp
    pivot(1:) = entering
    raised(0) = 0.0_dp
    do k = 1, size(limits%first)
      raised(1:) = limits%sign(k)*table(:size(entering), limits%first(k))
      least = huge(least)
      do i = 0, size(entering)
        if (left(i)) least = min(least, raised(i)/pivot(i))
      end do
      do i = 0, size(entering)
        if (left(i)) left(i) = sign(1.0_dp, pivot(i))*(raised(i) - least*pivot(i)) &
          <= TIE_TOLERANCE*max(1.0_dp, abs(least*pivot(i)))
      end do
      if (count(left) == 1) exit
    end do
    row = first_true(left) - 1
  end function lexicographic_least

  pure function first_true(mask) result(first)
    logical, intent(in) :: mask(:)
    integer :: first

    do first = 1, size(mask)
      if (mask(first)) return
    end do
    first = 0
  end function first_true

end module fuge_pivot_rule
