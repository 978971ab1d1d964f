!> Which column enters the tableau's basis and which row leaves: pure selection.
!>
!> The paper (section 3, step 2) asks for (a) no negative right-hand side, (b1) a
!> negative entry in the last row, (b2) no force beside its own gap, (b3) no
!> artificial twice. Of the columns so admitted its tables take the lowest that
!> drives an artificial out, else the lowest. Ties of the ratio test are decided
!> lexicographically, which keeps degenerate problems from cycling.
!>
!> The tableau is scaled: its lengths and forces are of order 1, so that small
!> numbers here are relative to the data.
module fuge_pivot_rule
  use fuge_kinds, only: dp
  use fuge_numbering, only: partner_column, is_artificial, stored_columns, gap_column
  use fuge_options_type, only: FUGE_PAPER_RULE, FUGE_MOST_NEGATIVE, FUGE_GREATEST_DECREASE
  implicit none
  private

  public :: select_pivot, leaving_row

  !> A last-row entry is negative below this part of its column.
  real(dp), parameter :: ENTRY_TOLERANCE = 1.0e-11_dp
  !> A pivot is positive above this part of its column.
  real(dp), parameter :: PIVOT_TOLERANCE = 1.0e-11_dp
  !> Right-hand sides that differ by less are tied.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-13_dp

contains

  !> The next pivot by `rule`; `column` = 0 when no column is admissible.
  !>
  !> `table` (n+2, 2n+2) is the tableau with the z row last and the right-hand
  !> side in the last column, `basis` (n+1) the column number of each row.
  pure subroutine select_pivot(table, basis, rule, column, row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), rule
    integer, intent(out) :: column, row
    logical :: basic(3*size(basis) - 1), artificial(size(basis)), tied(size(basis))
    real(dp) :: step, merit, best
    integer :: n, j, r

    n = size(basis) - 1
    basic = .false.
    basic(basis) = .true.
    artificial = is_artificial(n, 1, basis)
    column = 0
    row = 0
    best = 0.0_dp
    do j = 1, stored_columns(n, 1)
      if (basic(j)) cycle
      if (.not. improves(table(:, j), artificial)) cycle
      call ratio_test(table, j, step, tied)
      if (.not. any(tied)) cycle
      ! Before ties are decided, which is dear: can this column win at all?
      if (column > 0 .and. merit_of(rule, table(n + 2, j), step, any(tied .and. artificial)) <= best) cycle
      r = decide(table, j, tied)
      if (is_barred(basic, n, j, basis(r))) cycle
      merit = merit_of(rule, table(n + 2, j), step, artificial(r))
      if (column > 0 .and. merit <= best) cycle
      column = j
      row = r
      best = merit
      if (rule == FUGE_PAPER_RULE .and. merit > 0.0_dp) exit
    end do
  end subroutine select_pivot

  !> Condition (b1): a negative entry in the last row, which is minus the sum over the
  !> rows of the artificials: compared with what that sum is made of.
  pure function improves(column, artificial)
    real(dp), intent(in) :: column(:)
    logical, intent(in) :: artificial(:)
    logical :: improves
    integer :: last

    last = size(column)
    improves = column(last) < -ENTRY_TOLERANCE*sum(abs(column(:last - 1)), mask=artificial)
  end function improves

  !> Condition (b2): the partner would stay in the basis.
  pure function is_barred(basic, n, column, leaving)
    logical, intent(in) :: basic(:)
    integer, intent(in) :: n, column, leaving
    logical :: is_barred
    integer :: partner

    partner = partner_column(n, column)
    is_barred = .false.
    if (partner > 0) is_barred = basic(partner) .and. leaving /= partner
  end function is_barred

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

  !> Condition (a): the row whose variable reaches zero first as `column` enters; 0 if
  !> none does.
  pure function leaving_row(table, column) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: column
    integer :: row
    logical :: tied(size(table, 1) - 1)
    real(dp) :: step

    call ratio_test(table, column, step, tied)
    row = decide(table, column, tied)
  end function leaving_row

  !> How far `column` can enter, and the rows (n+1) that stop it there; none if it can
  !> enter without end.
  pure subroutine ratio_test(table, column, step, tied)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: column
    real(dp), intent(out) :: step
    logical, intent(out) :: tied(:)
    integer :: i, rows, last

    rows = size(tied)
    last = size(table, 2)
    tied = table(:rows, column) > PIVOT_TOLERANCE*maxval(abs(table(:rows, column)))
    step = huge(step)
    do i = 1, rows
      if (tied(i)) step = min(step, table(i, last)/table(i, column))
    end do
    do i = 1, rows
      if (tied(i)) tied(i) = table(i, last) - step*table(i, column) <= TIE_TOLERANCE
    end do
  end subroutine ratio_test

  pure function decide(table, column, tied) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: column
    logical, intent(in) :: tied(:)
    integer :: row

    row = first_true(tied)
    if (count(tied) > 1) row = lexicographic_least(table, column, tied)
  end function decide

  !> Of tied rows the one whose row of the inverse basis, divided by its pivot, is
  !> lexicographically least: as if gap k had been raised by epsilon^k.
  !>
  !> The inverse basis stands in the gap columns. The column of the equilibrium
  !> artificial is not stored, and not needed: two rows that agree in all others
  !> cannot both belong to a regular basis with F_0 > 0.
  pure function lexicographic_least(table, column, tied) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: column
    logical, intent(in) :: tied(:)
    integer :: row
    logical :: left(size(tied))
    real(dp) :: least
    integer :: i, k, n

    n = size(tied) - 1
    left = tied
    do k = 1, n
      least = huge(least)
      do i = 1, n + 1
        if (left(i)) least = min(least, table(i, gap_column(n, k))/table(i, column))
      end do
      do i = 1, n + 1
        if (left(i)) left(i) = table(i, gap_column(n, k)) - least*table(i, column) &
          <= TIE_TOLERANCE*max(1.0_dp, abs(least*table(i, column)))
      end do
      if (count(left) == 1) exit
    end do
    row = first_true(left)
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
