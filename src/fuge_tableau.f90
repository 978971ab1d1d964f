!> The paper's tableau and its Phase I (Fischer, Hoyer, Melosh, section 3).
!>
!> Rows 1..n are equation (9), row n+1 is the equilibrium (11), row n+2 is the
!> objective z, the sum of the artificial variables. Columns are numbered as in
!> `fuge_numbering`; those of the artificials are never stored, only the vector
!> of basis columns. One more column holds the right-hand side.
!>
!> Lengths and forces are scaled by powers of two, which changes no digit and
!> lets every comparison be relative to the data.
module fuge_tableau
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_numbering, only: artificial_column, force_column, gap_column, rigid_column, is_artificial, is_force
  use fuge_pivot_rule, only: select_pivot
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: run_phase_one

  type, public :: paper_tableau
    !> Rows and columns as above, scaled, (n+2, 2n+2).
    real(dp), allocatable :: table(:, :)
    !> Column number in the basis for each row, (n+1).
    integer, allocatable :: basis(:)
    !> What was added to every gap to keep right-hand sides and v_0 non-negative, length.
    real(dp) :: shift = 0.0_dp
    !> A scaled length times 2**length_exponent is the caller's; forces likewise.
    integer :: length_exponent = 0
    integer :: force_exponent = 0
  contains
    procedure :: start
    procedure :: choose
    procedure :: pivot
    procedure :: finished
    procedure :: contact_set
    procedure :: z
    procedure :: remaining
    procedure :: entry_at
  end type paper_tableau

contains

  !> Set up the tableau of Bild 3 with the artificial basis, step 1 done.
  !>
  !> `alpha` (at least n rows, n columns) length per force, `gap` (n) length,
  !> `load` > 0 force. Error: FUGE_ERR_MEMORY.
  pure subroutine start(self, alpha, gap, load, status)
    class(paper_tableau), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    integer, intent(out) :: status
    integer :: n, k, j, stat

    n = size(gap)
    if (allocated(self%table)) deallocate (self%table)
    if (allocated(self%basis)) deallocate (self%basis)
    allocate (self%table(n + 2, 2*n + 2), self%basis(n + 1), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    call set_datum_and_scales(self, alpha, gap, load)
    associate (t => self%table, force => self%force_exponent, length => self%length_exponent)
      t = 0.0_dp
      do j = 1, n
        t(:n, force_column(j)) = -scale(alpha(:n, j), force - length)
        t(n + 1, force_column(j)) = 1.0_dp
      end do
      do k = 1, n
        t(k, gap_column(n, k)) = 1.0_dp
      end do
      t(:n, rigid_column(n, 1)) = 1.0_dp
      t(:n, 2*n + 2) = scale(gap, -length) + scale(self%shift, -length)
      t(n + 1, 2*n + 2) = scale(load, -force)
    end associate
    self%basis = artificial_column(n, 1, [(k, k=1, n + 1)])
    call subtract_rows_from_last(self)
  end subroutine start

  !> The datum shift and the powers of two.
  !>
  !> v_0 F_0 = F.(a + b) + F.alpha F, and F.alpha F >= F_0**2 min(alpha) because no
  !> force is negative: so this shift makes v_0, and every right-hand side after
  !> the first pivot, non-negative for any datum of alpha and of the gaps.
  pure subroutine set_datum_and_scales(self, alpha, gap, load)
    class(paper_tableau), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    real(dp) :: lowest
    integer :: n

    n = size(gap)
    self%force_exponent = exponent(load)
    lowest = minval(gap) + load*minval(alpha(:n, :))
    self%shift = max(0.0_dp, -lowest)
    self%length_exponent = exponent(max(maxval(abs(gap + self%shift)), load*maxval(abs(alpha(:n, :)))))
  end subroutine set_datum_and_scales

  !> Step 1: the last row is minus the sum of the rows whose variable is artificial.
  !>
  !> Done afresh after every pivot instead of carrying the row along: the same row
  !> in exact arithmetic, but rounding cannot gather in it.
  pure subroutine subtract_rows_from_last(self)
    class(paper_tableau), intent(inout) :: self
    real(dp) :: weight(size(self%basis))
    integer :: n, j

    n = size(self%basis) - 1
    weight = merge(1.0_dp, 0.0_dp, is_artificial(n, 1, self%basis))
    do j = 1, size(self%table, 2)
      self%table(n + 2, j) = -dot_product(weight, self%table(:n + 1, j))
    end do
  end subroutine subtract_rows_from_last

  !> The next pivot. The equilibrium row is always first, against F_1: see
  !> doc/theory.md for what goes wrong otherwise. `column` = 0: none is admissible.
  pure subroutine choose(self, rule, column, row)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: rule
    integer, intent(out) :: column, row
    integer :: n

    n = size(self%basis) - 1
    if (is_artificial(n, 1, self%basis(n + 1))) then
      column = force_column(1)
      row = n + 1
    else
      call select_pivot(self%table, self%basis, rule, column, row)
    end if
  end subroutine choose

  !> Step 2: bring `column` into the basis in `row` by Gauss-Jordan elimination.
  pure subroutine pivot(self, column, row)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: column, row
    real(dp) :: entering(size(self%basis)), factor
    integer :: j, n

    n = size(self%basis) - 1
    entering = self%table(:n + 1, column)
    do j = 1, size(self%table, 2)
      factor = self%table(row, j)/entering(row)
      if (abs(factor) > 0.0_dp) self%table(:n + 1, j) = self%table(:n + 1, j) - factor*entering
      self%table(row, j) = factor
    end do
    ! Exact by definition; elimination would leave rounding here.
    self%table(:n + 1, column) = 0.0_dp
    self%table(row, column) = 1.0_dp
    self%table(:n + 1, 2*n + 2) = max(self%table(:n + 1, 2*n + 2), 0.0_dp)
    self%basis(row) = column
    call subtract_rows_from_last(self)
  end subroutine pivot

  !> True when no artificial variable is left in the basis.
  pure function finished(self)
    class(paper_tableau), intent(in) :: self
    logical :: finished

    finished = .not. any(is_artificial(size(self%basis) - 1, 1, self%basis))
  end function finished

  !> The points whose force is in the basis, (n).
  pure function contact_set(self) result(contact)
    class(paper_tableau), intent(in) :: self
    logical :: contact(size(self%basis) - 1)
    integer :: i

    contact = .false.
    do i = 1, size(self%basis)
      if (is_force(size(contact), self%basis(i))) contact(self%basis(i)) = .true.
    end do
  end function contact_set

  !> Sum of the artificial variables, in the caller's units.
  pure function z(self)
    class(paper_tableau), intent(in) :: self
    real(dp) :: z

    ! A difference, so that zero has no sign.
    z = 0.0_dp - self%entry_at(size(self%table, 1), size(self%table, 2))
  end function z

  !> The same as z scaled, >= 0: forces and lengths weigh alike in it.
  pure function remaining(self)
    class(paper_tableau), intent(in) :: self
    real(dp) :: remaining

    associate (n => size(self%basis) - 1)
      remaining = 0.0_dp - self%table(n + 2, 2*n + 2)
    end associate
  end function remaining

  !> An entry in the caller's units, as the paper prints it; row n+2 is the z row,
  !> column 2n+2 the right-hand side.
  pure function entry_at(self, row, column) result(value)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: row, column
    real(dp) :: value
    integer :: n, i

    n = size(self%basis) - 1
    if (row <= n + 1) then
      value = unscaled(self, row, column)
    else
      ! The z row adds rows of different units before the equilibrium has been met.
      value = 0.0_dp
      do i = 1, n + 1
        if (is_artificial(n, 1, self%basis(i))) value = value - unscaled(self, i, column)
      end do
    end if
  end function entry_at

  pure function unscaled(self, row, column) result(value)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: row, column
    real(dp) :: value
    integer :: power

    power = unit_exponent(self, self%basis(row))
    if (column < size(self%table, 2)) power = power - unit_exponent(self, column)
    value = scale(self%table(row, column), power)
  end function unscaled

  !> Unit of a variable, as a power of two; `column` is its column number.
  pure function unit_exponent(self, column) result(power)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: column
    integer :: power
    integer :: n

    n = size(self%basis) - 1
    if (is_force(n, column) .or. column == artificial_column(n, 1, n + 1)) then
      power = self%force_exponent
    else
      power = self%length_exponent
    end if
  end function unit_exponent

  !> Phase I from the artificial basis to the contact set.
  !>
  !> `contact` (n) marks the points whose force ends in the basis; `pivots` counts.
  !> The history is started and filled if `keep_history`. Rounding can leave an
  !> artificial without an admissible column: the set found so far is then returned,
  !> as it is with FUGE_ERR_ITERATION_LIMIT. Other errors: FUGE_ERR_MEMORY,
  !> FUGE_ERR_CANCELLED by `monitor`, which hears of each pivot.
  subroutine run_phase_one(alpha, gap, load, rule, max_pivots, keep_history, monitor, history, contact, pivots, status)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    integer, intent(in) :: rule, max_pivots
    logical, intent(in) :: keep_history
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    logical, intent(out) :: contact(:)
    integer, intent(out) :: pivots, status
    type(paper_tableau) :: tableau
    real(dp) :: start
    integer :: column, row

    pivots = 0
    start = 1.0_dp
    contact = .false.
    call tableau%start(alpha, gap, load, status)
    if (status == FUGE_DONE .and. keep_history) call history%start(size(gap) + 1, status)
    do while (status == FUGE_DONE)
      if (keep_history) call history%record(tableau%basis, tableau%z(), status)
      if (pivots == 0) start = tableau%remaining()
      if (pivots > 0 .and. status == FUGE_DONE) call tell_monitor(monitor, pivots, tableau%remaining()/start, &
                                                                  count(is_force(size(gap), tableau%basis)), status)
      if (tableau%finished() .or. status /= FUGE_DONE) exit
      call tableau%choose(rule, column, row)
      if (column == 0) exit
      if (pivots == max_pivots) then
        status = FUGE_ERR_ITERATION_LIMIT
      else
        call tableau%pivot(column, row)
        pivots = pivots + 1
      end if
    end do
    if (allocated(tableau%basis)) contact = tableau%contact_set()
  end subroutine run_phase_one

end module fuge_tableau
