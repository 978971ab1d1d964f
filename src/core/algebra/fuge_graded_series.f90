!> A function of many consecutive integers from few of its values: of distances from a place, or of numbers of waves,
!> which is the smoother the larger its argument.
module fuge_graded_series
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_points
  use fuge_kinds, only: dp
  implicit none
  private

  !> Up to this argument each value is kept.
  integer, parameter :: BEGIN = 32
  !> Degree of the series on each interval from a to 2 a: a function that is analytic at all complex numbers x with
  !> |x - a| < 0.6 a for each real a >= BEGIN is interpolated to rounding.
  integer, parameter :: DEGREE = 32

  type, abstract, public :: graded_function
  contains
    procedure(evaluate_at), deferred :: evaluate
  end type graded_function

  abstract interface
    !> The `values` at `x`, of the same size.
    subroutine evaluate_at(self, x, values)
      import :: graded_function, dp
      class(graded_function), intent(in) :: self
      real(dp), intent(in), contiguous :: x(:)
      real(dp), intent(out), contiguous :: values(:)
    end subroutine evaluate_at
  end interface

  !> Build it of a function, then take its values.
  type, public :: graded_series
    private
    integer :: last = 0
    real(dp) :: direct(0:BEGIN) = 0.0_dp
    !> Coefficients on the intervals: (0:DEGREE, j).
    real(dp), allocatable :: coefficient(:, :)
  contains
    procedure :: build
    procedure :: set_first
    procedure :: value_at
  end type graded_series

contains

  !> Take the values of `f` at 1 .. `last`, and at 0 where `from_zero`. `stat` as in an allocate statement.
  subroutine build(self, f, from_zero, last, stat)
    class(graded_series), intent(inout) :: self
    class(graded_function), intent(in) :: f
    logical, intent(in) :: from_zero
    integer, intent(in) :: last
    integer, intent(out) :: stat
    real(dp) :: ends(2), values(0:DEGREE)
    integer :: count, first, j, k

    self%last = last
    first = merge(0, 1, from_zero)
    k = min(last, BEGIN)
    if (k >= first) call f%evaluate([(real(j, dp), j=first, k)], self%direct(first:k))
    count = 0
    do while (last > BEGIN*2.0_dp**count)
      count = count + 1
    end do
    if (allocated(self%coefficient)) deallocate (self%coefficient)
    allocate (self%coefficient(0:DEGREE, count), stat=stat)
    if (stat /= 0) return
    do j = 1, count
      ends = interval(self, j)
      call f%evaluate(ends(1) + 0.5_dp*(ends(2) - ends(1))*(1.0_dp + chebyshev_points(DEGREE)), values)
      self%coefficient(:, j) = chebyshev_coefficients(values)
    end do
  end subroutine build

  !> The ends of interval `j`: from BEGIN 2**(j - 1) to twice that, or the last argument.
  pure function interval(self, j) result(ends)
    class(graded_series), intent(in) :: self
    integer, intent(in) :: j
    real(dp) :: ends(2)

    ends = real(BEGIN, dp)*2.0_dp**[j - 1, j]
    ends(2) = min(ends(2), real(self%last, dp))
  end function interval

  !> Let the value at 0 be `first`.
  subroutine set_first(self, first)
    class(graded_series), intent(inout) :: self
    real(dp), intent(in) :: first

    self%direct(0) = first
  end subroutine set_first

  !> The value at `k`, 0 .. last.
  elemental function value_at(self, k) result(value)
    class(graded_series), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: value
    real(dp) :: after, ends(2), next, now, t
    integer :: j, m

    if (k <= BEGIN) then
      value = self%direct(k)
      return
    end if
    ! Interval j has the numbers from BEGIN 2**(j - 1) + 1 on.
    j = exponent(real(k - 1, dp)) - exponent(real(BEGIN, dp)) + 1
    ends = interval(self, j)
    t = (2.0_dp*real(k, dp) - (ends(1) + ends(2)))/(ends(2) - ends(1))
    next = 0.0_dp
    after = 0.0_dp
    do m = DEGREE, 1, -1
      now = self%coefficient(m, j) + 2.0_dp*t*next - after
      after = next
      next = now
    end do
    value = self%coefficient(0, j) + t*next - after
  end function value_at

end module fuge_graded_series
