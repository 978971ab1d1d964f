!> Pricing and ratio test: which column enters the basis of the tableau and which row leaves.
!>
!> The paper (section 3, step 2) asks for (a) no negative right-hand side, (b1) a negative entry in the last row, (b2)
!> no force in the basis together with its own gap, (b3) no artificial variable twice. Of the columns so admitted the
!> paper's tables take the lowest that drives an artificial out, else the lowest. Ties of the ratio test are broken
!> lexicographically, which keeps degenerate problems from cycling.
!>
!> Beyond the paper, a variable may be free of sign or have an upper bound (the play of a gap, the limit of a force):
!> `fuge_variable_bounds`. A column that reaches its own bound first leaves the basis unchanged.
!>
!> The tableau is scaled: its lengths and forces are of order 1, so that the tolerances here are relative to the data.
module fuge_pivot_rule
  use fuge_column_numbers, only: partner_column, is_artificial, stored_columns
  use fuge_kinds, only: dp
  use fuge_options_type, only: FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE
  use fuge_variable_bounds, only: variable_bounds
  implicit none
  private

  public :: select_pivot, select_for_equilibrium, leaving_row

  !> A last-row entry counts as negative below minus this fraction of its column.
  real(dp), parameter :: ENTRY_TOLERANCE = 1.0e-11_dp
  !> A pivot counts as positive above this fraction of its column.
  real(dp), parameter :: PIVOT_TOLERANCE = 1.0e-11_dp
  !> Right-hand sides that differ by less than this are tied.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-13_dp
  !> An infeasibility of the equilibrium rows below this is rounding; resultants are of order 1.
  real(dp), parameter :: BALANCE_TOLERANCE = 1.0e-10_dp
  !> Returned instead of a row: the column can enter without bound.
  integer, parameter, public :: NOTHING_LEAVES = -huge(1)

contains

  !> The next pivot by `rule`; `column` = 0 when no column is admissible.
  !>
  !> `table` (n+m+1, 2n+m+1) is the tableau with the z row last and the right-hand side in the last column, `basis`
  !> (n+m) the column number of each row. `row` is negative if its variable leaves at its upper bound, and 0 if none
  !> leaves because `column` reaches its own bound.
  pure subroutine select_pivot(table, basis, bounds, rule, column, row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), rule
    type(variable_bounds), intent(in) :: bounds
    integer, intent(out) :: column, row
    logical :: basic(size(bounds%free)), artificial(size(basis)), bounded(size(basis)), tied(0:size(basis))
    real(dp) :: entering(size(table, 1)), upper_bound(size(basis)), step, price, best
    integer :: j, r, last, sense

    last = size(table, 1)
    basic = .false.
    basic(basis) = .true.
    artificial = is_artificial(bounds%n, bounds%m, basis)
    bounded = .not. bounds%free(basis)
    upper_bound = bounds%upper_bound(basis)
    column = 0
    row = 0
    best = 0.0_dp
    do j = 1, stored_columns(bounds%n, bounds%m)
      if (basic(j) .or. bounds%fixed(j)) cycle
      sense = improving_sense(table(:, j), artificial, bounds%free(j))
      if (sense == 0) cycle
      entering = real(sense, dp)*table(:, j)
      call ratio_test(entering(:last - 1), table(:last - 1, size(table, 2)), bounded, upper_bound, &
                      bounds%upper_bound(j), step, tied)
      if (.not. any(tied)) cycle
      ! Breaking ties is expensive, so skip a column that cannot win.
      if (column > 0 .and. price_of(rule, entering(last), step, any(tied(1:) .and. artificial)) <= best) cycle
      r = break_tie(table, entering(:last - 1), bounds, tied)
      if (keeps_partner(basic, bounds%n, j, basis, r)) cycle
      price = price_of(rule, entering(last), step, drives_out(artificial, r))
      if (column > 0 .and. price <= best) cycle
      column = j
      row = r
      best = price
      if (rule == FUGE_PAPER_RULE .and. price > 0.0_dp) exit
    end do
  end subroutine select_pivot

  !> The next pivot as long as an artificial is left in the equilibrium rows.
  !>
  !> Looks at these rows alone, by least column numbers (R. G. Bland, Mathematics of Operations Research 2, 1977), which
  !> cannot cycle; for the paper's problem that is F_1. A force that reaches its own limit as early as any other goes
  !> there, which brings the equilibrium nearer. An artificial left at zero is exchanged for the largest entry of its
  !> row.
  !>
  !> Arguments as for `select_pivot`; `column` = 0 if no forces can carry the resultant.
  pure subroutine select_for_equilibrium(table, basis, bounds, column, row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:)
    type(variable_bounds), intent(in) :: bounds
    integer, intent(out) :: column, row
    real(dp) :: entries(bounds%m + 1), right(bounds%m), step
    logical :: basic(size(bounds%free)), artificial(bounds%m), tied(0:bounds%m)
    integer :: j, n, sense

    n = bounds%n
    basic = .false.
    basic(basis) = .true.
    artificial = is_artificial(n, bounds%m, basis(n + 1:))
    right = table(n + 1:n + bounds%m, size(table, 2))
    row = 0
    do column = 1, n
      if (basic(column) .or. bounds%fixed(column)) cycle
      entries(:bounds%m) = table(n + 1:n + bounds%m, column)
      entries(bounds%m + 1) = -sum(entries(:bounds%m), mask=artificial)
      ! Rounding of an elimination: two such columns would go in and out for ever.
      if (abs(entries(bounds%m + 1)) <= ENTRY_TOLERANCE*sum(abs(entries(:bounds%m)))) cycle
      sense = improving_sense(entries, artificial, bounds%free(column))
      if (sense == 0) cycle
      call ratio_test(sense*entries(:bounds%m), right, .not. bounds%free(basis(n + 1:)), &
                      bounds%upper_bound(basis(n + 1:)), bounds%upper_bound(column), step, tied)
      if (.not. any(tied)) cycle
      if (tied(0)) return
      j = minloc(basis(n + 1:), dim=1, mask=tied(1:))
      row = sign(n + j, merge(1, -1, sense*entries(j) > 0.0_dp))
      return
    end do
    column = 0
    if (sum(right, mask=artificial) > BALANCE_TOLERANCE) return
    row = n + first_true(artificial)
    entries(1) = 0.0_dp
    do j = 1, n
      if (basic(j) .or. bounds%fixed(j) .or. abs(table(row, j)) <= entries(1)) cycle
      column = j
      entries(1) = abs(table(row, j))
    end do
  end subroutine select_for_equilibrium

  !> Condition (b1), a negative entry in the last row. That entry is minus the sum over the rows of the artificials, and
  !> is compared with the terms of the sum. 1, or -1 for a free variable that has to decrease; 0 if z would not
  !> decrease.
  pure function improving_sense(column, artificial, free) result(sense)
    real(dp), intent(in) :: column(:)
    logical, intent(in) :: artificial(:), free
    integer :: sense
    real(dp) :: rounding
    integer :: last

    last = size(column)
    rounding = ENTRY_TOLERANCE*sum(abs(column(:last - 1)), mask=artificial)
    sense = 0
    if (column(last) < -rounding) sense = 1
    if (free .and. column(last) > rounding) sense = -1
  end function improving_sense

  !> Condition (b2) is violated: the partner would stay in the basis, or leave it at its upper bound.
  pure function keeps_partner(basic, n, column, basis, row)
    logical, intent(in) :: basic(:)
    integer, intent(in) :: n, column, basis(:), row
    logical :: keeps_partner
    integer :: partner

    partner = partner_column(n, column)
    keeps_partner = .false.
    if (partner > 0) keeps_partner = basic(partner)
    if (keeps_partner .and. row > 0) keeps_partner = basis(row) /= partner
  end function keeps_partner

  pure function drives_out(artificial, row)
    logical, intent(in) :: artificial(:)
    integer, intent(in) :: row
    logical :: drives_out

    drives_out = .false.
    if (row > 0) drives_out = artificial(row)
  end function drives_out

  !> The price of a column: the rule takes the largest, the lowest column of equals. `entry` is that of the last row,
  !> `step` how far the column can enter, `artificial` whether it drives an artificial out.
  pure function price_of(rule, entry, step, artificial) result(price)
    integer, intent(in) :: rule
    real(dp), intent(in) :: entry, step
    logical, intent(in) :: artificial
    real(dp) :: price

    select case (rule)
    case (FUGE_MOST_NEGATIVE)
      price = -entry
    case (FUGE_GREATEST_DECREASE)
      price = -entry*step
    case default
      price = merge(1.0_dp, 0.0_dp, artificial)
    end select
  end function price_of

  !> Condition (a): the row whose variable first reaches a bound as `column` enters, in the convention of `row` in
  !> `select_pivot`, or NOTHING_LEAVES.
  pure function leaving_row(table, basis, bounds, column) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), column
    type(variable_bounds), intent(in) :: bounds
    integer :: row
    logical :: tied(0:size(basis))
    real(dp) :: step

    call ratio_test(table(:size(basis), column), table(:size(basis), size(table, 2)), .not. bounds%free(basis), &
                    bounds%upper_bound(basis), bounds%upper_bound(column), step, tied)
    row = NOTHING_LEAVES
    if (any(tied)) row = break_tie(table, table(:size(basis), column), bounds, tied)
  end function leaving_row

  !> How far a column can enter, and what stops it there: rows, or at index 0 its own bound; nothing if it can enter
  !> without bound.
  !>
  !> `entering` the entries of the column, `right` the right-hand sides, `bounded` the rows of variables that must not
  !> become negative, `upper_bound` their largest values, `own_bound` that of the column.
  pure subroutine ratio_test(entering, right, bounded, upper_bound, own_bound, step, tied)
    real(dp), intent(in) :: entering(:), right(:), upper_bound(:), own_bound
    logical, intent(in) :: bounded(:)
    real(dp), intent(out) :: step
    logical, intent(out) :: tied(0:)
    real(dp) :: smallest
    integer :: i

    smallest = PIVOT_TOLERANCE*maxval(abs(entering))
    step = own_bound
    do i = 1, size(entering)
      tied(i) = bounded(i) .and. (entering(i) > smallest .or. (entering(i) < -smallest &
                                                               .and. upper_bound(i) < huge(step)))
      if (tied(i)) step = min(step, distance_to_bound(entering(i), right(i), upper_bound(i))/abs(entering(i)))
    end do
    tied(0) = own_bound < huge(step)
    if (tied(0)) tied(0) = own_bound - step <= TIE_TOLERANCE
    do i = 1, size(entering)
      if (tied(i)) tied(i) = distance_to_bound(entering(i), right(i), upper_bound(i)) &
        - step*abs(entering(i)) <= TIE_TOLERANCE
    end do
  end subroutine ratio_test

  !> How far the value `right` is from the bound that it approaches.
  pure function distance_to_bound(entry, right, upper_bound) result(distance)
    real(dp), intent(in) :: entry, right, upper_bound
    real(dp) :: distance

    distance = right
    if (entry < 0.0_dp) distance = upper_bound - right
  end function distance_to_bound

  !> The tied row that leaves, in the convention of `row` in `select_pivot`.
  pure function break_tie(table, entering, bounds, tied) result(row)
    real(dp), intent(in) :: table(:, :), entering(:)
    type(variable_bounds), intent(in) :: bounds
    logical, intent(in) :: tied(0:)
    integer :: row

    row = first_true(tied) - 1
    if (count(tied) > 1) row = lexicographic_least(table, entering, bounds, tied)
    if (row > 0) then
      if (entering(row) < 0.0_dp) row = -row
    end if
  end function break_tie

  !> Of the tied rows the one whose row of the inverse basis, divided by its pivot, is lexicographically least: as if
  !> the value of the first basis in row k had been perturbed by epsilon^k. At index 0, the bound of the column
  !> itself, nothing was perturbed.
  !>
  !> The inverse basis, relative to the first one, stands in the columns of the first one. In the paper's problem the
  !> column of F_1 is not needed: two rows that agree in all others cannot both belong to a regular basis with F_0 > 0.
  pure function lexicographic_least(table, entering, bounds, tied) result(row)
    real(dp), intent(in) :: table(:, :), entering(:)
    type(variable_bounds), intent(in) :: bounds
    logical, intent(in) :: tied(0:)
    integer :: row
    logical :: candidate(0:size(entering))
    real(dp) :: perturbation(0:size(entering)), pivot(0:size(entering)), least
    integer :: i, k

    candidate = tied
    pivot(0) = 1.0_dp
    pivot(1:) = entering
    perturbation(0) = 0.0_dp
    do k = 1, size(bounds%first)
      perturbation(1:) = bounds%sign(k)*table(:size(entering), bounds%first(k))
      least = huge(least)
      do i = 0, size(entering)
        if (candidate(i)) least = min(least, perturbation(i)/pivot(i))
      end do
      do i = 0, size(entering)
        if (candidate(i)) candidate(i) = sign(1.0_dp, pivot(i))*(perturbation(i) - least*pivot(i)) &
          <= TIE_TOLERANCE*max(1.0_dp, abs(least*pivot(i)))
      end do
      if (count(candidate) == 1) exit
    end do
    row = first_true(candidate) - 1
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
