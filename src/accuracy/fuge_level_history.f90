!> The grids of one call so far, and what they tell of the error of the last one.
!>
!> The error of the pressure is the share of the load that is in the wrong place, counted on the cells of the coarser
!> grid. Two grids and the order of convergence tell it, unless features are still missed or edges of the contact happen
!> to fall on borders of cells in one of both: so the difference before counts too. See doc/theory.md, "Contact to a
!> wanted error".
module fuge_level_history
  use fuge_kinds, only: dp
  use fuge_resolved_contact_type, only: fuge_level, fuge_resolved_contact
  implicit none
  private

  public :: area_difference, estimated_error, line_difference, next_growth, quick_number

  integer, parameter :: long = selected_int_kind(18)

  !> What is known beforehand of the errors of a kind of grids.
  type, public :: error_law
    !> Order of convergence, factor for what is not so regular, and another one until a third grid has confirmed the
    !> order.
    real(dp) :: order = 1.0_dp, safety = 1.0_dp, doubt = 1.0_dp
    !> How far the errors of two grids are alike: 1 if they fall regularly, 0 if they have nothing in common.
    real(dp) :: likeness = 1.0_dp
    !> Fewest grids that tell an error, and how many times finer than the one before a grid is at least and at most.
    integer :: fewest = 2
    real(dp) :: step = 1.4_dp, leap = 2.0_dp
  end type error_law

  !> Levels of all methods; differences and results of those of the last method only.
  type, public :: level_history
    type(fuge_level), allocatable :: levels(:)
    !> Of the levels that follow each other: difference of the pressures as share of the load, and growth.
    real(dp), allocatable :: differences(:), growth(:)
    !> Results of the levels of the last method.
    real(dp), allocatable :: approach(:), largest(:), size(:)
    type(error_law) :: law
    !> The error of the pressure of the last level is not believed to be less than this.
    real(dp) :: least_error = 0.0_dp
    integer(long), private :: start = 0
  contains
    procedure :: begin
    procedure :: change_method
    procedure :: add
    procedure :: pressure_error
    procedure :: give_errors
    procedure :: give_only_level
    procedure :: seconds
    procedure :: last_duration
  end type level_history

  !> Single values may agree by chance, those of two grids more often than those of three, and the approach, whose
  !> errors have either sign, most often, which takes factors of its own; and they are not better than rounding.
  real(dp), parameter :: OF_VALUES = 2.0_dp, OF_TWO_VALUES = 6.0_dp, OF_TWO_APPROACHES = 12.0_dp
  real(dp), parameter :: ROUNDING = 16.0_dp*epsilon(1.0_dp)
  !> The error that the difference before leads to is believed in this part, because it may have been one by chance; and
  !> the order is confirmed if the last one leads to no more than so many times that.
  real(dp), parameter :: PART_OF_EARLIER = 0.7_dp, CONFIRMED = 1.5_dp
  !> How many times finer a second grid is at least; errors are expected to be so much larger than predicted; and
  !> `least_error` falls with this order.
  real(dp), parameter :: SECOND_STEP = 1.5_dp, MARGIN = 1.2_dp, ORDER_OF_ENDS = 1.5_dp

contains

  !> Start the clock.
  subroutine begin(self)
    class(level_history), intent(inout) :: self

    call system_clock(self%start)
    allocate (self%levels(0))
    call self%change_method(error_law())
  end subroutine begin

  !> Begin with another kind of grids.
  subroutine change_method(self, law)
    class(level_history), intent(inout) :: self
    type(error_law), intent(in) :: law

    self%law = law
    self%least_error = 0.0_dp
    self%differences = [real(dp) ::]
    self%growth = [real(dp) ::]
    self%approach = [real(dp) ::]
    self%largest = [real(dp) ::]
    self%size = [real(dp) ::]
  end subroutine change_method

  !> Note a level: its cells, its method, how many times finer it is than the one before of the same method, 1 if it is
  !> the first one, the `difference` between these two as share of the load, and its results.
  subroutine add(self, cells, method, growth, difference, approach, largest, size)
    class(level_history), intent(inout) :: self
    integer, intent(in) :: cells, method
    real(dp), intent(in) :: growth, difference, approach, largest, size
    type(fuge_level) :: level

    if (growth > 1.0_dp) self%differences = [self%differences, difference]
    if (growth > 1.0_dp) self%growth = [self%growth, growth]
    self%approach = [self%approach, approach]
    self%largest = [self%largest, largest]
    self%size = [self%size, size]
    level%cells = cells
    level%method = method
    level%pressure_error = min(1.0_dp, self%pressure_error())
    level%approach_error = error_of(self, self%approach, OF_TWO_APPROACHES)
    level%seconds = self%seconds()
    self%levels = [self%levels, level]
  end subroutine add

  !> The estimated error of the pressure of the last level; huge before there are enough of a method.
  pure function pressure_error(self) result(error)
    class(level_history), intent(in) :: self
    real(dp) :: error

    error = max(self%least_error, estimated_error(self%differences, self%growth, self%law))
  end function pressure_error

  !> The estimated error of the last of the `values` of the levels of the last method; `of_two` is the factor if there
  !> are only two.
  pure function error_of(self, values, of_two) result(error)
    class(level_history), intent(in) :: self
    real(dp), intent(in) :: values(:), of_two
    real(dp) :: error

    error = huge(error)
    if (size(values) < self%law%fewest) return
    error = merge(of_two/self%law%doubt, OF_VALUES, size(values) < 3) &
            *estimated_error(abs(values(2:) - values(:size(values) - 1)), self%growth, self%law)
    error = max(error, ROUNDING*abs(values(size(values))))
  end function error_of

  !> Levels and errors of the results, for the caller.
  pure subroutine give_errors(self, contact)
    class(level_history), intent(in) :: self
    type(fuge_resolved_contact), intent(inout) :: contact

    contact%levels = self%levels
    contact%pressure_error = min(1.0_dp, self%pressure_error())
    contact%approach_error = error_of(self, self%approach, OF_TWO_APPROACHES)
    contact%largest_error = error_of(self, self%largest, OF_TWO_VALUES)
    contact%size_error = error_of(self, self%size, OF_TWO_VALUES)
  end subroutine give_errors

  !> Note a series of `terms` terms, whose errors `contact` knows, and give it as the only level.
  subroutine give_only_level(self, terms, contact)
    class(level_history), intent(inout) :: self
    integer, intent(in) :: terms
    type(fuge_resolved_contact), intent(inout) :: contact

    call self%add(terms, contact%method, 1.0_dp, 0.0_dp, contact%approach, contact%largest, contact%size)
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

  !> How many times finer the next grid should be for an error of `accuracy`, as the error of the last one tells, of the
  !> first one `least_error`: as far as the law lets it leap, and at most `largest` times.
  pure function next_growth(history, accuracy, largest) result(growth)
    type(level_history), intent(in) :: history
    real(dp), intent(in) :: accuracy, largest
    real(dp) :: growth
    real(dp) :: error

    error = history%pressure_error()
    if (size(history%differences) == 0) then
      growth = max(SECOND_STEP, (MARGIN*history%least_error/accuracy)**(1.0_dp/ORDER_OF_ENDS))
    else if (error < huge(error)) then
      growth = max(history%law%step, (MARGIN*error/accuracy)**(1.0_dp/history%law%order))
    else
      growth = history%law%leap
    end if
    growth = min(growth, history%law%leap, largest)
  end function next_growth

  !> A number of cells, `n` or a little more, whose Fourier transforms are quick: a power of two times one up to 16.
  pure function quick_number(n) result(number)
    integer, intent(in) :: n
    integer :: number
    integer :: part

    part = 2**max(0, exponent(real(n, dp)) - 4)
    number = part*((n + part - 1)/part)
  end function quick_number

  !> The estimated error of the last grid. `differences` (k) are those between grids that follow each other, `growth`
  !> (k) > 1 how many times finer, in one direction, the second of each two is; huge for fewer grids than law%fewest.
  !>
  !> After Richardson an error that falls with a power of the width is a part of the difference that it made. From the
  !> difference before, which may have caught what the last one has not, the error is taken to fall with the same power.
  pure function estimated_error(differences, growth, law) result(error)
    real(dp), intent(in) :: differences(:), growth(:)
    type(error_law), intent(in) :: law
    real(dp) :: error
    real(dp) :: earlier, factor
    integer :: k

    error = huge(error)
    k = size(differences)
    if (k < 1 .or. k + 1 < law%fewest) return
    error = differences(k)/(growth(k)**law%order - law%likeness)
    factor = law%safety*law%doubt
    if (k > 1) then
      earlier = differences(k - 1)/((growth(k - 1)**law%order - law%likeness)*growth(k)**law%order)
      if (error <= CONFIRMED*earlier) factor = law%safety
      error = max(error, PART_OF_EARLIER*earlier)
    end if
    error = factor*error
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
    integer, parameter :: MOST_STEPS = 40
    !> Places that are nearer, in widths of the cell, are the same.
    real(dp), parameter :: SAME_PLACE = 1.0e-11_dp
    real(dp) :: low, high, t, off
    integer :: first, k

    associate (width => border(j + 1) - border(j))
      force = upto(j)
      if (x - border(j) <= SAME_PLACE*width) return
      t = (x - border(j))/width
      force = upto(j) + (upto(j + 1) - upto(j))*t
      if (size(border) < 4) return
      first = min(max(j - 1, 1), size(border) - 3)
      low = real(j - first, dp)
      high = low + 1.0_dp
      t = low + t
      ! The place is nearly linear: each step divides the error by ten or so, and the interval stays a bracket.
      do k = 1, MOST_STEPS
        off = (x - cubic(border(first:first + 3), t))/width
        if (abs(off) <= SAME_PLACE) exit
        if (off > 0.0_dp) low = t
        if (off < 0.0_dp) high = t
        t = t + off
        if (.not. (t > low .and. t < high)) t = 0.5_dp*(low + high)
      end do
      force = min(max(cubic(upto(first:first + 3), t), upto(j)), upto(j + 1))
    end associate
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
