!> The paper's tableau and its Phase I (Fischer, Hoyer, Melosh, section 3).
!>
!> Rows 1..n are equation (9), rows n+1..n+m the equilibrium (11) in each free motion, the last row is the objective z,
!> the sum of the artificial variables. Columns are numbered as in `fuge_column_numbers`; those of the artificials are
!> never stored, only the vector of basis columns. One more column holds the right-hand side.
!>
!> Beyond the paper, motions and the forces of tied points are free of sign, a play is an upper bound of c_k and a limit
!> one of f_k. Every point is described from the corner of its law that it was last at (`fuge_variable_bounds`): at the
!> upper stop its variables are complemented, d - c for c and -f for f, at a limit they are u - f for f and -c for c. So
!> no bounded variable is ever negative, and every variable outside of the basis is zero.
!>
!> Lengths and forces are scaled by powers of two, which changes no digit and makes every comparison relative to the
!> data.
module fuge_paper_tableau
  use fuge_canonical_problem, only: canonical_problem
  use fuge_column_numbers, only: artificial_column, force_column, gap_column, rigid_column, is_artificial, is_force, &
    partner_column
  use fuge_contact_states, only: is_at_stop, FUGE_OPEN
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_options_type, only: fuge_options
  use fuge_pivot_rule, only: select_pivot, select_for_equilibrium
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_variable_bounds, only: variable_bounds
  implicit none
  private

  public :: run_phase_one

  !> A limit beyond this power of two, as a multiple of the forces that cause displacements of the size of the problem,
  !> counts as none: to describe a force from there would cost its digits.
  integer, parameter :: FAR_EXPONENT = 30

  type, public :: paper_tableau
    !> Entries of the tableau with its right-hand side and last row, scaled, (n+m+1, 2n+m+1).
    real(dp), allocatable :: table(:, :)
    !> Column number in the basis for each row, (n+m).
    integer, allocatable :: basis(:)
    !> The constant added to every gap: for the paper's problem to keep right-hand sides and v_0 non-negative, otherwise
    !> to count gaps from the lowest; length.
    real(dp) :: shift = 0.0_dp
    !> A scaled length times 2**length_exponent is the caller's; forces likewise.
    integer :: length_exponent = 0
    integer :: force_exponent = 0
    !> Bounds of the variables.
    type(variable_bounds), private :: bounds
    !> The equilibrium rows are met, and no sign may change any more.
    logical, private :: signs_fixed = .false.
  contains
    generic :: start => start_plain, start_canonical
    procedure :: choose
    procedure :: pivot
    procedure :: finished
    procedure :: balanced
    procedure :: states
    procedure :: z
    procedure :: remaining
    procedure :: entry_at
    procedure, private :: start_plain, start_canonical
  end type paper_tableau

contains

  !> Set up the tableau of Bild 3, the paper's problem, with the artificial basis; step 1 is done.
  !>
  !> `alpha` (at least n rows, n columns) length per force, `gap` (n) length, `load` > 0 force. Error: FUGE_ERR_MEMORY.
  pure subroutine start_plain(self, alpha, gap, load, status)
    class(paper_tableau), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    integer, intent(out) :: status
    integer :: n

    n = size(gap)
    call allocate_table(self, n, 1, n, status)
    if (status /= FUGE_DONE) return
    call set_datum_and_scales(self, alpha, gap, load)
    call fill(self, alpha, 0.0_dp)
    associate (t => self%table, force => self%force_exponent, length => self%length_exponent)
      t(:n, rigid_column(n, 1)) = 1.0_dp
      t(n + 1, :n) = 1.0_dp
      t(:n, 2*n + 2) = scale(gap, -length) + scale(self%shift, -length)
      t(n + 1, 2*n + 2) = scale(load, -force)
    end associate
    ! With the shift every sign is fixed from the start.
    self%signs_fixed = .true.
    call subtract_rows_from_last(self)
  end subroutine start_plain

  !> Set up the tableau of a canonical problem, with its matrix; step 1 is done. Error: FUGE_ERR_MEMORY.
  pure subroutine start_canonical(self, canonical, status)
    class(paper_tableau), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(out) :: status
    real(dp) :: softest
    integer :: n, m, j

    n = size(canonical%gap)
    m = size(canonical%load)
    if (canonical%plain) then
      call self%start_plain(canonical%alpha, canonical%gap, canonical%load(1), status)
      return
    end if
    call allocate_table(self, n, m, n + m, status)
    if (status /= FUGE_DONE) return
    call set_general_scales(self, canonical, softest)
    call fill(self, canonical%alpha, canonical%datum)
    associate (t => self%table, force => self%force_exponent, length => self%length_exponent)
      do j = 1, m
        t(:n, rigid_column(n, j)) = canonical%modes(:, j)
        t(n + j, :n) = canonical%modes(:, j)
      end do
      t(:n, 2*n + m + 1) = scale(canonical%gap + self%shift, -length)
      t(n + 1:n + m, 2*n + m + 1) = scale(canonical%load, -force)
    end associate
    call set_bounds(self, canonical, softest)
    if (canonical%has_limits()) call start_from_corners(self, canonical)
    self%signs_fixed = .false.
    call turn_negative_rows(self, n + m)
    if (m == 0) call fix_signs(self)
    call subtract_rows_from_last(self)
  end subroutine start_canonical

  pure subroutine allocate_table(self, n, m, ties, status)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: n, m, ties
    integer, intent(out) :: status
    integer :: k, stat

    if (allocated(self%table)) deallocate (self%table)
    if (allocated(self%basis)) deallocate (self%basis)
    allocate (self%table(n + m + 1, 2*n + m + 1), self%basis(n + m), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (status == FUGE_DONE) call self%bounds%set(n, m, ties, status)
    if (status /= FUGE_DONE) return
    self%basis = artificial_column(n, m, [(k, k=1, n + m)])
  end subroutine allocate_table

  !> Fill the columns of forces and gaps in the gap rows; all else is zero.
  pure subroutine fill(self, alpha, datum)
    class(paper_tableau), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :), datum
    integer :: n, k

    n = self%bounds%n
    self%table = 0.0_dp
    do k = 1, n
      self%table(:n, force_column(k)) = -scale(alpha(:n, k) - datum, self%force_exponent - self%length_exponent)
      self%table(k, gap_column(n, k)) = 1.0_dp
    end do
  end subroutine fill

  !> The datum shift and the powers of two.
  !>
  !> v_0 F_0 = F.(a + b) + F.alpha F, and F.alpha F >= F_0**2 min(alpha) because no force is negative: so this shift
  !> makes v_0, and every right-hand side after the first pivot, non-negative for any datum of alpha and of the gaps.
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

  !> The powers of two where motions have no sign. No shift is needed for signs, but gaps are counted from the lowest,
  !> because a large datum would cost digits. `softest` is the largest coefficient of alpha without its datum.
  pure subroutine set_general_scales(self, canonical, softest)
    class(paper_tableau), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(out) :: softest
    real(dp) :: load, length
    integer :: n

    n = size(canonical%gap)
    self%shift = 0.0_dp
    if (canonical%has_translation) self%shift = -minval(canonical%gap, mask=.not. canonical%excluded)
    load = 0.0_dp
    if (size(canonical%load) > 0) load = maxval(abs(canonical%load))
    softest = maxval(abs(canonical%alpha(:n, :) - canonical%datum))
    length = max(maxval(abs(canonical%gap + self%shift), mask=.not. canonical%excluded), load*softest)
    self%length_exponent = exponent(length)
    self%force_exponent = exponent(load)
    if (.not. load > 0.0_dp) self%force_exponent = self%length_exponent - exponent(softest)
  end subroutine set_general_scales

  !> The force of a tied point is free and its gap fixed; an excluded point has a free gap and no force. The force of a
  !> point with play may have either sign until the equilibrium rows are met, unless there are limits.
  pure subroutine set_bounds(self, canonical, softest)
    class(paper_tableau), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: softest
    real(dp) :: play, limit_lower, limit_upper
    integer :: k

    limit_lower = huge(limit_lower)
    limit_upper = huge(limit_upper)
    associate (bounds => self%bounds, n => self%bounds%n)
      bounds%free(rigid_column(n, [(k, k=1, bounds%m)])) = .true.
      do k = 1, n
        if (canonical%has_limits()) then
          limit_lower = scaled_limit(self, canonical%limit(k), softest)
          limit_upper = scaled_limit(self, canonical%limit_upper(k), softest)
        end if
        play = huge(play)
        if (canonical%upper(k) <= 0.0_dp) then
          play = 0.0_dp
        else if (exponent(canonical%upper(k)) - self%length_exponent < maxexponent(1.0_dp)) then
          if (canonical%upper(k) < huge(play)) play = scale(canonical%upper(k), -self%length_exponent)
        end if
        if (canonical%excluded(k)) then
          bounds%free(gap_column(n, k)) = .true.
          bounds%fixed(force_column(k)) = .true.
        else if (canonical%upper(k) <= 0.0_dp .and. min(limit_lower, limit_upper) >= huge(play)) then
          bounds%free(force_column(k)) = .true.
          bounds%fixed(gap_column(n, k)) = .true.
        else
          bounds%free(force_column(k)) = play < huge(play) .and. .not. canonical%has_limits()
          call bounds%set_law(k, play, limit_lower, limit_upper)
        end if
      end do
    end associate
  end subroutine set_bounds

  !> A limit in the tableau's unit; huge if the force will not come near it.
  pure function scaled_limit(self, limit, softest)
    class(paper_tableau), intent(in) :: self
    real(dp), intent(in) :: limit, softest
    real(dp) :: scaled_limit

    scaled_limit = 0.0_dp
    if (.not. limit > 0.0_dp) return
    scaled_limit = huge(limit)
    if (limit >= huge(limit) .or. exponent(limit) - self%force_exponent >= maxexponent(limit)) return
    if (softest > 0.0_dp .and. exponent(limit) + exponent(softest) - self%length_exponent > FAR_EXPONENT) return
    scaled_limit = scale(limit, -self%force_exponent)
  end function scaled_limit

  !> With limits no force changes its sign: each starts at the stop to which the known forces in equilibrium press the
  !> point, so that the equilibrium rows can be met by forces from zero to their limits. A tied point starts at the
  !> nearer one of its limits, so that its force has a sign too.
  pure subroutine start_from_corners(self, canonical)
    class(paper_tableau), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer :: k

    associate (bounds => self%bounds, n => self%bounds%n)
      do k = 1, n
        ! One-sided points, excluded ones and tied ones without limits.
        if (bounds%upper(k) >= huge(1.0_dp)) cycle
        if (canonical%upper(k) <= 0.0_dp) then
          if (canonical%limit(k) > canonical%limit_upper(k)) call complement(self, gap_column(n, k))
          call complement(self, force_column(k))
        else if (canonical%feasible_force(k) < 0.0_dp .or. .not. canonical%pushes(k)) then
          call complement(self, gap_column(n, k))
        end if
      end do
    end associate
  end subroutine start_from_corners

  !> Of the first `rows`, those whose artificial variable would be negative are negated.
  pure subroutine turn_negative_rows(self, rows)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: rows
    integer :: i, last

    last = size(self%table, 2)
    do i = 1, rows
      if (.not. (is_artificial(self%bounds%n, self%bounds%m, self%basis(i)) .and. self%table(i, last) < 0.0_dp)) cycle
      self%table(i, :) = -self%table(i, :)
      if (i <= self%bounds%n) self%bounds%sign(i) = -self%bounds%sign(i)
    end do
  end subroutine turn_negative_rows

  !> Once the equilibrium rows are met: points whose force pulls are at their upper stop, and from here on no sign may
  !> change. This basis is the first one for the breaking of ties, which lower a force at its limit and raise others.
  pure subroutine fix_signs(self)
    class(paper_tableau), intent(inout) :: self
    integer :: i, n

    n = self%bounds%n
    do i = n + 1, size(self%basis)
      if (.not. self%bounds%free(self%basis(i))) cycle
      if (self%bounds%upper_bound(partner_column(n, self%basis(i))) >= huge(1.0_dp)) cycle
      if (self%table(i, size(self%table, 2)) < 0.0_dp) call complement(self, partner_column(n, self%basis(i)))
    end do
    where (self%bounds%upper < huge(1.0_dp)) self%bounds%free(:n) = .false.
    associate (first => self%basis(n + 1:), values => self%table(n + 1:size(self%basis), size(self%table, 2)))
      self%bounds%first(n + 1:) = first
      self%bounds%sign(n + 1:) = merge(-1.0_dp, 1.0_dp, values > 0.5_dp*self%bounds%upper_bound(first))
    end associate
    self%signs_fixed = .true.
  end subroutine fix_signs

  !> Describe a point from the corner of its law where the variable in `column`, its gap or its force, is at its bound:
  !> that variable is counted from there, and its partner changes its sign too.
  pure subroutine complement(self, column)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: column
    integer :: i, last, rows

    last = size(self%table, 2)
    rows = size(self%basis)
    associate (t => self%table, bounds => self%bounds, partner => partner_column(self%bounds%n, column))
      t(:rows, last) = t(:rows, last) - bounds%upper_bound(column)*t(:rows, column)
      t(:rows, column) = -t(:rows, column)
      t(:rows, partner) = -t(:rows, partner)
      do i = 1, rows
        if (self%basis(i) == column .or. self%basis(i) == partner) t(i, :) = -t(i, :)
      end do
      where (bounds%first == column .or. bounds%first == partner) bounds%sign = -bounds%sign
      call bounds%turn_corner(column)
    end associate
  end subroutine complement

  !> Step 1: the last row is minus the sum of the rows whose variable is artificial.
  !>
  !> Recomputed after every pivot instead of being eliminated with the other rows: the same row in exact arithmetic, but
  !> rounding does not accumulate in it.
  pure subroutine subtract_rows_from_last(self)
    class(paper_tableau), intent(inout) :: self
    real(dp) :: weight(size(self%basis))
    integer :: rows, j

    rows = size(self%basis)
    weight = merge(1.0_dp, 0.0_dp, is_artificial(self%bounds%n, self%bounds%m, self%basis))
    do j = 1, size(self%table, 2)
      self%table(rows + 1, j) = -dot_product(weight, self%table(:rows, j))
    end do
  end subroutine subtract_rows_from_last

  !> Choose the next pivot. The artificials of the equilibrium rows always leave first, in the paper's problem for F_1:
  !> doc/theory.md says what goes wrong otherwise. `column` = 0: none is admissible. `row` as `pivot` takes it.
  pure subroutine choose(self, rule, column, row)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: rule
    integer, intent(out) :: column, row

    if (self%balanced()) then
      call select_pivot(self%table, self%basis, self%bounds, rule, column, row)
    else
      call select_for_equilibrium(self%table, self%basis, self%bounds, column, row)
    end if
  end subroutine choose

  !> Step 2: bring `column` into the basis in `row`, or in -`row` if the variable there leaves at its upper bound; with
  !> 0 the variable in `column` goes from one bound to the other.
  pure subroutine pivot(self, column, row)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: column, row

    if (row > 0) then
      call eliminate(self, column, row)
    else if (row < 0) then
      call complement(self, self%basis(-row))
      call eliminate(self, column, -row)
    else
      call complement(self, column)
    end if
    if (.not. self%signs_fixed) then
      if (self%balanced()) call fix_signs(self)
      ! In the equilibrium rows the ratio test leaves nothing negative but rounding.
      call turn_negative_rows(self, self%bounds%n)
    end if
    call clear_rounding(self)
    call subtract_rows_from_last(self)
  end subroutine pivot

  !> Gauss-Jordan elimination.
  pure subroutine eliminate(self, column, row)
    class(paper_tableau), intent(inout) :: self
    integer, intent(in) :: column, row
    real(dp) :: entering(size(self%basis)), factor
    integer :: j, rows

    rows = size(self%basis)
    entering = self%table(:rows, column)
    do j = 1, size(self%table, 2)
      factor = self%table(row, j)/entering(row)
      if (abs(factor) > 0.0_dp) self%table(:rows, j) = self%table(:rows, j) - factor*entering
      self%table(row, j) = factor
    end do
    ! These entries are exact by definition; elimination would leave rounding in them.
    self%table(:rows, column) = 0.0_dp
    self%table(row, column) = 1.0_dp
    self%basis(row) = column
  end subroutine eliminate

  !> Move right-hand sides that rounding has put below zero or above their upper bound back to it.
  pure subroutine clear_rounding(self)
    class(paper_tableau), intent(inout) :: self
    integer :: i

    associate (right => self%table(:, size(self%table, 2)), bounds => self%bounds)
      do i = 1, size(self%basis)
        if (.not. bounds%free(self%basis(i))) right(i) = min(max(right(i), 0.0_dp), bounds%upper_bound(self%basis(i)))
      end do
    end associate
  end subroutine clear_rounding

  !> True when no artificial variable is left in the basis.
  pure function finished(self)
    class(paper_tableau), intent(in) :: self
    logical :: finished

    finished = .not. any(is_artificial(self%bounds%n, self%bounds%m, self%basis))
  end function finished

  !> True when no artificial variable is left in the equilibrium rows.
  pure function balanced(self)
    class(paper_tableau), intent(in) :: self
    logical :: balanced

    balanced = .not. any(is_artificial(self%bounds%n, self%bounds%m, self%basis(self%bounds%n + 1:)))
  end function balanced

  !> State of every point, (n): at a stop if its force is in the basis, else limited or open as at its corner.
  pure function states(self) result(state)
    class(paper_tableau), intent(in) :: self
    integer :: state(self%bounds%n)
    integer :: i

    state = merge(FUGE_OPEN, self%bounds%corner, is_at_stop(self%bounds%corner))
    do i = 1, size(self%basis)
      if (is_force(self%bounds%n, self%basis(i))) state(self%basis(i)) = self%bounds%touching_state(self%basis(i))
    end do
  end function states

  !> Sum of the artificial variables, in the caller's units.
  pure function z(self)
    class(paper_tableau), intent(in) :: self
    real(dp) :: z

    ! A difference, so that zero has no sign.
    z = 0.0_dp - self%entry_at(size(self%table, 1), size(self%table, 2))
  end function z

  !> Sum of the scaled artificial variables, >= 0, in which forces and lengths weigh alike.
  pure function remaining(self)
    class(paper_tableau), intent(in) :: self
    real(dp) :: remaining

    remaining = 0.0_dp - self%table(size(self%table, 1), size(self%table, 2))
  end function remaining

  !> An entry in the caller's units, as the paper prints it; row n+m+1 is the z row,
  !> column 2n+m+1 the right-hand side. Variables are those of the corner of each point.
  pure function entry_at(self, row, column) result(value)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: row, column
    real(dp) :: value
    integer :: i

    if (row <= size(self%basis)) then
      value = in_units(self, row, column)
    else
      ! Before the equilibrium rows are met the z row adds rows of different units.
      value = 0.0_dp
      do i = 1, size(self%basis)
        if (is_artificial(self%bounds%n, self%bounds%m, self%basis(i))) value = value - in_units(self, i, column)
      end do
    end if
  end function entry_at

  pure function in_units(self, row, column) result(value)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: row, column
    real(dp) :: value
    integer :: power

    power = unit_exponent(self, self%basis(row))
    if (column < size(self%table, 2)) power = power - unit_exponent(self, column)
    value = scale(self%table(row, column), power)
  end function in_units

  !> Unit of a variable, as a power of two; `column` is its column number.
  pure function unit_exponent(self, column) result(power)
    class(paper_tableau), intent(in) :: self
    integer, intent(in) :: column
    integer :: power

    associate (n => self%bounds%n, m => self%bounds%m)
      if (is_force(n, column) .or. column >= artificial_column(n, m, n + 1)) then
        power = self%force_exponent
      else
        power = self%length_exponent
      end if
    end associate
  end function unit_exponent

  !> Phase I from the artificial basis to the contact set.
  !>
  !> `canonical` with its matrix; of the `options` the pivot rule and whether to keep the history count.
  !> `state` (n) on return; `pivots` counts, at most `max_pivots`. Rounding can leave an artificial without an
  !> admissible column: the set found so far is then returned, as it is with FUGE_ERR_ITERATION_LIMIT. Other
  !> errors: FUGE_ERR_NO_EQUILIBRIUM if no forces carry the resultants, FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED by
  !> `monitor`, which hears of each pivot.
  subroutine run_phase_one(canonical, options, max_pivots, monitor, history, state, pivots, status)
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    integer, intent(in) :: max_pivots
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    integer, intent(out) :: state(:), pivots, status
    type(paper_tableau) :: tableau
    real(dp) :: start
    integer :: column, row

    pivots = 0
    start = 1.0_dp
    state = FUGE_OPEN
    call tableau%start(canonical, status)
    if (status == FUGE_DONE .and. options%keep_history) call history%start(size(tableau%basis), status)
    do while (status == FUGE_DONE)
      if (options%keep_history) call history%record(tableau%basis, tableau%z(), status)
      if (pivots == 0 .and. tableau%remaining() > 0.0_dp) start = tableau%remaining()
      if (pivots > 0 .and. status == FUGE_DONE) call tell_monitor(monitor, pivots, tableau%remaining()/start, &
                                                                  count(tableau%states() /= FUGE_OPEN), status)
      if (tableau%finished() .or. status /= FUGE_DONE) exit
      call tableau%choose(options%pivot_rule, column, row)
      if (column == 0) then
        if (.not. tableau%balanced()) status = FUGE_ERR_NO_EQUILIBRIUM
        exit
      end if
      if (pivots == max_pivots) then
        status = FUGE_ERR_ITERATION_LIMIT
      else
        call tableau%pivot(column, row)
        pivots = pivots + 1
      end if
    end do
    if (allocated(tableau%basis)) state = tableau%states()
  end subroutine run_phase_one

end module fuge_paper_tableau
