!> Sums of products with 30 digits of their terms, and how far they are off.
!>
!> Each sum has three parts. The first two start from a bias that is larger than all that will be added to them, so that
!> three additions show what rounding takes from them exactly (T. J. Dekker, Numerische Mathematik 18, 1971): that of the
!> first goes to the second, that of the second to the third. Products are split so that all but their last parts are
!> exact. The third part has n roundings of numbers below 2**(-51) of the sum of the terms, which bounds the error for up
!> to 2**20 terms.
module fuge_triple_sums
  use fuge_compensated_sums, only: bias_above, upper_half
  use fuge_kinds, only: dp
  use fuge_rounding_bounds, only: raised, LEAST, UNIT_ROUNDOFF
  implicit none
  private

  !> Each term adds this fraction of the sum of all to the error.
  real(dp), parameter :: LAST_PART = 2.0_dp**(-98)
  !> The second part is below this fraction of the sum of the terms.
  real(dp), parameter :: SECOND_PART = 2.0_dp**(-23)

  !> Several sums, to which the same numbers of terms are added.
  type, public :: triple_sums
    real(dp), allocatable, private :: high(:), low(:), rest(:), most(:)
    integer, private :: terms = 0
  contains
    procedure :: start
    procedure :: add
    procedure :: add_products
    procedure :: add_dot
    procedure :: finish
  end type triple_sums

contains

  !> Start sums of terms whose magnitudes together are at most `most` each. `stat` is not 0 without memory.
  pure subroutine start(self, most, stat)
    class(triple_sums), intent(inout) :: self
    real(dp), intent(in) :: most(:)
    integer, intent(out) :: stat
    integer :: k

    allocate (self%high(size(most)), self%low(size(most)), self%rest(size(most)), self%most(size(most)), stat=stat)
    if (stat /= 0) return
    self%most = most
    do k = 1, size(most)
      self%high(k) = bias_above(most(k))
      self%low(k) = bias_above(SECOND_PART*most(k))
    end do
    self%rest = 0.0_dp
  end subroutine start

  !> Add one term to each sum.
  pure subroutine add(self, terms)
    class(triple_sums), intent(inout) :: self
    real(dp), intent(in) :: terms(:)
    integer :: k

    do k = 1, size(terms)
      call add_term(terms(k), self%high(k), self%low(k), self%rest(k))
    end do
    self%terms = self%terms + 1
  end subroutine add

  !> Add factor column(k) to sum k.
  pure subroutine add_products(self, column, factor)
    class(triple_sums), intent(inout) :: self
    real(dp), intent(in), contiguous :: column(:)
    real(dp), intent(in) :: factor
    integer :: k

    do k = 1, size(column)
      call add_product(column(k), factor, self%high(k), self%low(k), self%rest(k))
    end do
    self%terms = self%terms + 1
  end subroutine add_products

  !> Add the terms of an inner product to sum `k`. The others count as having as many.
  pure subroutine add_dot(self, k, x, y)
    class(triple_sums), intent(inout) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: x(:), y(:)
    integer :: i

    do i = 1, size(x)
      call add_product(x(i), y(i), self%high(k), self%low(k), self%rest(k))
    end do
    self%terms = self%terms + size(x)
  end subroutine add_dot

  !> The sums, and how far they are off at most.
  pure subroutine finish(self, sums, error)
    class(triple_sums), intent(in) :: self
    real(dp), intent(out) :: sums(:), error(:)
    real(dp) :: first, second, sum, back
    integer :: k

    do k = 1, size(sums)
      first = self%high(k) - bias_above(self%most(k))
      second = self%low(k) - bias_above(SECOND_PART*self%most(k))
      sum = first + second
      back = sum - first
      sums(k) = sum + (((first - (sum - back)) + (second - back)) + self%rest(k))
    end do
    error = raised(2.0_dp*UNIT_ROUNDOFF*abs(sums) + real(self%terms + 8, dp)*LAST_PART*self%most, 3) + LEAST
  end subroutine finish

  pure subroutine add_term(value, high, low, rest)
    real(dp), intent(in) :: value
    real(dp), intent(inout) :: high, low, rest
    real(dp) :: sum

    sum = high + value
    call add_to_second(value - (sum - high), low, rest)
    high = sum
  end subroutine add_term

  !> a b, in parts of which all but the last are exact.
  pure subroutine add_product(a, b, high, low, rest)
    real(dp), intent(in) :: a, b
    real(dp), intent(inout) :: high, low, rest
    real(dp) :: lower_a, lower_b, upper_a, upper_b

    upper_a = upper_half(a)
    upper_b = upper_half(b)
    lower_a = a - upper_a
    lower_b = b - upper_b
    call add_term(upper_a*upper_b, high, low, rest)
    call add_to_second(upper_a*lower_b, low, rest)
    call add_to_second(lower_a*upper_b, low, rest)
    rest = rest + lower_a*lower_b
  end subroutine add_product

  pure subroutine add_to_second(value, low, rest)
    real(dp), intent(in) :: value
    real(dp), intent(inout) :: low, rest
    real(dp) :: sum

    sum = low + value
    rest = rest + (value - (sum - low))
    low = sum
  end subroutine add_to_second

end module fuge_triple_sums
