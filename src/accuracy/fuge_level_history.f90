!> The grids of one call so far, and what they tell of the error of the last one.
!>
!> The error of the pressure is the share of the load that is in the wrong place, counted on the cells of the coarser
!> grid. The difference of two grids is nearly the error of the coarser one, unless features are still missed or edges
!> of the contact happen to fall on borders of cells in one of both: so the difference before counts too. See
!> doc/theory.md, "Contact to a wanted error".
module fuge_level_history
  use fuge_kinds, only: dp
  use fuge_resolved_contact_type, only: fuge_level, fuge_resolved_contact
  implicit none
  private

  public :: area_difference, estimated_error, line_difference, next_growth

  integer, parameter :: long = selected_int_kind(18)

  !> Levels of all methods; differences and results of those of the last method only.
  type, public :: level_history
    type(fuge_level), allocatable :: levels(:)
    !> Of the levels that follow each other: difference of the pressures as share of the load, and growth.
    real(dp), allocatable :: differences(:), growth(:)
    !> Results of the levels of the last method.
    real(dp), allocatable :: approach(:), largest(:), size(:)
    !> Factor of all errors, and order of convergence, as in `estimated_error`.
    real(dp) :: safety = 1.0_dp, order = 1.5_dp
    !> The error of the pressure of the last level is not believed to be less than this.
    real(dp) :: least_error = 0.0_dp
    integer(long), private :: start = 0
  contains
    procedure :: begin
    procedure :: change_method
    procedure :: expect
    procedure :: add
    procedure :: pressure_error
    procedure :: give_errors
    procedure :: give_only_level
    procedure :: seconds
    procedure :: last_duration
  end type level_history

  !> Orders of the pressure where the gap is smooth, and where it jumps or a body ends.
  real(dp), parameter, public :: SMOOTH_ORDER = 1.5_dp, ORDER_AT_JUMPS = 0.5_dp
  !> Single values may agree by chance, which takes a factor of its own; and they are not better than rounding.
  real(dp), parameter :: OF_VALUES = 2.0_dp, ROUNDING = 16.0_dp*epsilon(1.0_dp)
  !> How many times finer the next grid is.
  real(dp), parameter :: SMALL_STEP = 1.5_dp, STEP = 2.0_dp, LONG_STEP = 4.0_dp
  !> The small one is enough if the error has to fall by no more than this.
  real(dp), parameter :: SMALL_NEED = 1.3_dp

contains

  !> Start the clock.
  subroutine begin(self)
    class(level_history), intent(inout) :: self

    call system_clock(self%start)
    allocate (self%levels(0))
    call self%change_method(1.0_dp)
  end subroutine begin

  !> Begin with another kind of grids; `safety` as in `estimated_error`.
  subroutine change_method(self, safety)
    class(level_history), intent(inout) :: self
    real(dp), intent(in) :: safety

    call self%expect(safety, SMOOTH_ORDER)
    self%least_error = 0.0_dp
    self%differences = [real(dp) ::]
    self%growth = [real(dp) ::]
    self%approach = [real(dp) ::]
    self%largest = [real(dp) ::]
    self%size = [real(dp) ::]
  end subroutine change_method

  !> Take errors to be as regular as this: `safety` and `order` as in `estimated_error`.
  pure subroutine expect(self, safety, order)
    class(level_history), intent(inout) :: self
    real(dp), intent(in) :: safety, order

    self%safety = safety
    self%order = order
  end subroutine expect

  !> Note a level: its cells, its method and its results, and if it follows one of the same method the `difference` from
  !> it, as share of the load, and how many times finer it is.
  subroutine add(self, cells, method, approach, largest, size, difference, growth)
    class(level_history), intent(inout) :: self
    integer, intent(in) :: cells, method
    real(dp), intent(in) :: approach, largest, size
    real(dp), intent(in), optional :: difference, growth
    type(fuge_level) :: level

    self%approach = [self%approach, approach]
    self%largest = [self%largest, largest]
    self%size = [self%size, size]
    if (present(difference)) then
      self%differences = [self%differences, difference]
      self%growth = [self%growth, growth]
    end if
    level%cells = cells
    level%method = method
    level%pressure_error = min(1.0_dp, self%pressure_error())
    level%approach_error = error_of(self, self%approach)
    level%seconds = self%seconds()
    self%levels = [self%levels, level]
  end subroutine add

  !> The estimated error of the pressure of the last level; huge before three of a method.
  pure function pressure_error(self) result(error)
    class(level_history), intent(in) :: self
    real(dp) :: error

    error = max(self%least_error, estimated_error(self%differences, self%growth, self%safety, self%order))
  end function pressure_error

  !> The estimated error of the last of the `values` of the levels of the last method.
  pure function error_of(self, values) result(error)
    class(level_history), intent(in) :: self
    real(dp), intent(in) :: values(:)
    real(dp) :: error

    error = huge(error)
    if (size(values) < 3) return
    error = estimated_error(abs(values(2:) - values(:size(values) - 1)), self%growth, OF_VALUES*self%safety, self%order)
    error = max(error, ROUNDING*abs(values(size(values))))
  end function error_of

  !> Levels and errors of the results, for the caller.
  pure subroutine give_errors(self, contact)
    class(level_history), intent(in) :: self
    type(fuge_resolved_contact), intent(inout) :: contact

    contact%levels = self%levels
    contact%pressure_error = min(1.0_dp, self%pressure_error())
    contact%approach_error = error_of(self, self%approach)
    contact%largest_error = error_of(self, self%largest)
    contact%size_error = error_of(self, self%size)
  end subroutine give_errors

  !> Note a series of `terms` terms, whose errors `contact` knows, and give it as the only level.
  subroutine give_only_level(self, terms, contact)
    class(level_history), intent(inout) :: self
    integer, intent(in) :: terms
    type(fuge_resolved_contact), intent(inout) :: contact

    call self%add(terms, contact%method, contact%approach, contact%largest, contact%size)
    contact%levels = self%levels
    contact%levels%pressure_error = contact%pressure_error
    contact%levels%approach_error = contact%approach_error
  end subroutine give_only_level

  !> Time since `begin`.
  function seconds(self)
    class(level_history), intent(in) :: self
    real(dp) :: seconds
    integer(long) :: now, rate

    call system_clock(now, rate)
    seconds = real(now - self%start, dp)/real(rate, dp)
  end function seconds

  !> How long the last level took; seconds.
  pure function last_duration(self) result(duration)
    class(level_history), intent(in) :: self
    real(dp) :: duration

    duration = 0.0_dp
    associate (n => size(self%levels))
      if (n > 0) duration = self%levels(n)%seconds
      if (n > 1) duration = duration - self%levels(n - 1)%seconds
    end associate
  end function last_duration

  !> How many times finer the next grid of equal cells should be for an error of `accuracy`, at most `largest` times: a
  !> little for the last step, because of the estimate that it gives only a share in proportion to it is believed; else
  !> much, as far as errors fall regularly.
  pure function next_growth(history, accuracy, largest) result(growth)
    type(level_history), intent(in) :: history
    real(dp), intent(in) :: accuracy, largest
    real(dp) :: growth
    real(dp) :: needed
    integer :: k

    k = size(history%differences)
    growth = min(STEP, largest)
    if (k < 2) return
    needed = history%pressure_error()/accuracy
    if (needed <= SMALL_NEED) then
      growth = min(SMALL_STEP, largest)
    else if (needed > LONG_STEP**2 .and. history%differences(k)*history%growth(k) <= history%differences(k - 1)) then
      growth = min(LONG_STEP, largest)
    end if
  end function next_growth

  !> The estimated error of the last grid. `differences` (k) are those between grids that follow each other, `growth`
  !> (k) > 1 how many times finer, in one direction, the second of each two is; huge for fewer than two differences.
  !>
  !> A difference is taken for the error of the coarser grid, which falls at least in proportion to the width of the
  !> cells, as where a surface has a kink; from the difference before, which may have caught what the last one has not,
  !> with the power `order`. `safety` is the factor for all that is not so regular.
  pure function estimated_error(differences, growth, safety, order) result(error)
    real(dp), intent(in) :: differences(:), growth(:), safety, order
    real(dp) :: error
    integer :: k

    error = huge(error)
    k = size(differences)
    if (k < 2) return
    error = safety*max(differences(k)/growth(k), differences(k - 1)/(growth(k - 1)*growth(k))**order)
  end function estimated_error

  !> The force on a line that one grid has elsewhere than a finer one, counted on the cells of the coarser one. `border`
  !> (n + 1) and `fine_border` (m + 1) ascending from the same left to the same right end, length; `force` (n) and
  !> `fine_force` (m).
  pure function line_difference(border, force, fine_border, fine_force) result(difference)
    real(dp), intent(in) :: border(:), force(:), fine_border(:), fine_force(:)
    real(dp) :: difference
    real(dp) :: upto(size(border)), fine_upto(size(fine_border))
    integer :: j, k

    fine_upto(1) = 0.0_dp
    do j = 1, size(fine_force)
      fine_upto(j + 1) = fine_upto(j) + fine_force(j)
    end do
    j = 1
    do k = 1, size(border)
      do while (j < size(fine_force))
        if (fine_border(j + 1) > border(k)) exit
        j = j + 1
      end do
      upto(k) = force_upto(border(k), j, fine_border, fine_upto)
    end do
    difference = 0.5_dp*sum(abs(upto(2:) - upto(:size(force)) - force))
  end function line_difference

  !> The force left of `x`, which lies in cell `j`, from those left of the borders.
  !>
  !> Graded cells make the force smooth over the number of the cell, where it is not so over the place: both are cubics
  !> through the four nearest borders, over the same parameter.
  pure function force_upto(x, j, border, upto) result(force)
    real(dp), intent(in) :: x, border(:), upto(:)
    integer, intent(in) :: j
    real(dp) :: force
    integer, parameter :: BISECTIONS = 40
    !> Borders that are nearer, in widths of the cell, are the same.
    real(dp), parameter :: SAME_PLACE = 1.0e-9_dp
    real(dp) :: low, high, middle
    integer :: first, k

    force = upto(j)
    if (x - border(j) <= SAME_PLACE*(border(j + 1) - border(j))) return
    first = min(max(j - 1, 1), size(border) - 3)
    low = real(j - first, dp)
    high = low + 1.0_dp
    if (first >= 1) then
      do k = 1, BISECTIONS
        middle = 0.5_dp*(low + high)
        if (cubic(border(first:first + 3), middle) < x) then
          low = middle
        else
          high = middle
        end if
      end do
      force = cubic(upto(first:first + 3), low)
    else
      force = upto(j) + (upto(j + 1) - upto(j))*((x - border(j))/(border(j + 1) - border(j)))
    end if
    force = min(max(force, upto(j)), upto(j + 1))
  end function force_upto

  !> The cubic through `values` at 0, 1, 2 and 3.
  pure function cubic(values, t) result(value)
    real(dp), intent(in) :: values(4), t
    real(dp) :: value

    value = values(1)*((1.0_dp - t)*(2.0_dp - t)*(3.0_dp - t)/6.0_dp) + values(2)*(t*(2.0_dp - t)*(3.0_dp - t)/2.0_dp) &
            + values(3)*(t*(t - 1.0_dp)*(3.0_dp - t)/2.0_dp) + values(4)*(t*(t - 1.0_dp)*(t - 2.0_dp)/6.0_dp)
  end function cubic

  !> The same for grids of equal cells on one rectangle: `force` (nx, ny) and `fine_force` (mx, my), mx >= nx, my >= ny.
  pure function area_difference(force, fine_force) result(difference)
    real(dp), intent(in) :: force(:, :), fine_force(:, :)
    real(dp) :: difference
    real(dp), allocatable :: rows(:, :), row(:)
    integer :: i, j

    allocate (rows(size(force, 1), size(fine_force, 2)), row(size(force, 2)))
    do j = 1, size(fine_force, 2)
      rows(:, j) = on_wider_cells(fine_force(:, j), size(force, 1))
    end do
    difference = 0.0_dp
    do i = 1, size(force, 1)
      row = on_wider_cells(rows(i, :), size(force, 2))
      difference = difference + sum(abs(row - force(i, :)))
    end do
    difference = 0.5_dp*difference
  end function area_difference

  !> Sums of `values` over `n` equal cells along the same length, of which none is narrower; shares where one of the
  !> narrower cells lies in two.
  pure function on_wider_cells(values, n) result(sums)
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: n
    real(dp) :: sums(n)
    real(dp) :: share
    integer :: first, last, k

    sums = 0.0_dp
    do k = 1, size(values)
      ! Cells 0 to n - 1 at both ends of the narrower cell, in whole numbers.
      first = int((int(k - 1, long)*n)/size(values))
      last = int((int(k, long)*n - 1)/size(values))
      share = 1.0_dp
      if (last > first) share = real(int(last, long)*size(values) - int(k - 1, long)*n, dp)/real(n, dp)
      sums(first + 1) = sums(first + 1) + share*values(k)
      if (last > first) sums(last + 1) = sums(last + 1) + (1.0_dp - share)*values(k)
    end do
  end function on_wider_cells

end module fuge_level_history
