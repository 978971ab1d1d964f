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
    logical :: basic(3*size(basis) - 1)
    real(dp) :: merit, best
    integer :: n, j, r

    n = size(basis) - 1
    basic = .false.
    basic(basis) = .true.
    column = 0
    row = 0
    best = 0.0_dp
    do j = 1, stored_columns(n, 1)
      if (basic(j)) cycle
      if (.not. improves(table(:, j))) cycle
      r = leaving_row(table, j)
      if (r == 0) cycle
      if (is_barred(basic, n, j, basis(r))) cycle
      merit = merit_of(table, basis, rule, j, r)
      if (column > 0 .and. merit <= best) cycle
      column = j
      row = r
      best = merit
      if (rule == FUGE_PAPER_RULE .and. merit > 0.0_dp) exit
    end do
  end subroutine select_pivot

  !> Condition (b1): a negative entry in the last row.
  pure function improves(column)
    real(dp), intent(in) :: column(:)
    logical :: improves
    integer :: last

    last = size(column)
    improves = column(last) < -ENTRY_TOLERANCE*maxval(abs(column(:last - 1)))
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

  !> What the rule prefers is larger; of equals the lowest column stays.
  pure function merit_of(table, basis, rule, column, row) result(merit)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: basis(:), rule, column, row
    real(dp) :: merit
    integer :: n

    n = size(basis) - 1
    select case (rule)
    case (FUGE_MOST_NEGATIVE)
      merit = -table(n + 2, column)
    case (FUGE_GREATEST_DECREASE)
      merit = -table(n + 2, column)*table(row, 2*n + 2)/table(row, column)
    case default
      merit = merge(1.0_dp, 0.0_dp, is_artificial(n, 1, basis(row)))
    end select
  end function merit_of

  !> Condition (a), the ratio test: the row whose variable reaches zero first as
  !> `column` enters; 0 if none does.
  pure function leaving_row(table, column) result(row)
    real(dp), intent(in) :: table(:, :)
    integer, intent(in) :: column
    integer :: row
    logical :: falls(size(table, 1) - 1)
    real(dp) :: step
    integer :: rows, last

    rows = size(table, 1) - 1
    last = size(table, 2)
    falls = table(:rows, column) > PIVOT_TOLERANCE*maxval(abs(table(:rows, column)))
    if (.not. any(falls)) then
      row = 0
      return
    end if
    step = huge(step)
    do row = 1, rows
      if (falls(row)) step = min(step, table(row, last)/table(row, column))
    end do
    falls = falls .and. table(:rows, last) - step*table(:rows, column) <= TIE_TOLERANCE
    row = first_true(falls)
    if (count(falls) > 1) row = lexicographic_least(table, column, falls)
  end function leaving_row

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
