!> Sums of products with 30 digits of their terms, and how far they are off.
!>
!> Each sum has four parts. All but the last start from a bias that is larger than all that will be added to them, so
!> that three additions show what rounding takes from them exactly (T. J. Dekker, Numerische Mathematik 18, 1971), and
!> goes to the next part. Products are split into four of which three are exact; the rounding of the fourth is below
!> 2**(-103) of the product. What is added to the last part is below 2**(-95) of the sum of the terms, so that its
!> roundings are negligible for up to 2**20 terms.
module fuge_cascaded_sums
  use fuge_compensated_sums, only: bias_above, upper_half
  use fuge_kinds, only: dp
  use fuge_rounding_bounds, only: raised, LEAST, UNIT_ROUNDOFF
  implicit none
  private

  !> The fraction of the sum of the terms that the rounding of products and of the last addition takes, and more than
  !> each term adds to it.
  real(dp), parameter :: FROM_PRODUCTS = 2.0_dp**(-102), FROM_SUMS = 2.0_dp**(-120)
  !> The second and the third part are below these fractions of the sum of the terms.
  real(dp), parameter :: SECOND_PART = 2.0_dp**(-23), THIRD_PART = 2.0_dp**(-46)

  !> Several sums, to which the same numbers of terms are added.
  type, public :: cascaded_sums
    real(dp), allocatable, private :: first(:), second(:), third(:), last(:), most(:)
    integer, private :: terms = 0
  contains
    procedure :: start
    procedure :: add
    procedure :: add_products
    procedure :: add_dot
    procedure :: finish
  end type cascaded_sums

contains

  !> Start sums of terms whose magnitudes together are at most `most` each. `stat` is not 0 without memory.
  pure subroutine start(self, most, stat)
    class(cascaded_sums), intent(inout) :: self
    real(dp), intent(in) :: most(:)
    integer, intent(out) :: stat
    integer :: k

    if (allocated(self%first)) deallocate (self%first, self%second, self%third, self%last, self%most)
    self%terms = 0
    allocate (self%first(size(most)), self%second(size(most)), self%third(size(most)), self%last(size(most)), &
              self%most(size(most)), stat=stat)
    if (stat /= 0) return
    self%most = most
    do k = 1, size(most)
      self%first(k) = bias_above(most(k))
      self%second(k) = bias_above(SECOND_PART*most(k))
      self%third(k) = bias_above(THIRD_PART*most(k))
    end do
    self%last = 0.0_dp
  end subroutine start

  !> Add one term to each sum.
  pure subroutine add(self, terms)
    class(cascaded_sums), intent(inout) :: self
    real(dp), intent(in) :: terms(:)
    integer :: k

    do k = 1, size(terms)
      call add_term(terms(k), self%first(k), self%second(k), self%third(k), self%last(k))
    end do
    self%terms = self%terms + 1
  end subroutine add

  !> Add factor column(k) to sum k.
  pure subroutine add_products(self, column, factor)
    class(cascaded_sums), intent(inout) :: self
    real(dp), intent(in), contiguous :: column(:)
    real(dp), intent(in) :: factor

    call add_column(size(column), column, factor, self%first, self%second, self%third, self%last)
    self%terms = self%terms + 1
  end subroutine add_products

  !> The arrays have an explicit shape and are different ones, so that the compiler can do several sums at once.
  pure subroutine add_column(n, column, factor, first, second, third, last)
    integer, intent(in) :: n
    real(dp), intent(in) :: column(n), factor
    real(dp), intent(inout) :: first(n), second(n), third(n), last(n)
    integer :: k

    do k = 1, n
      call add_product(column(k), factor, first(k), second(k), third(k), last(k))
    end do
  end subroutine add_column

  !> Add the terms of an inner product to sum `k`. The others count as having as many.
  pure subroutine add_dot(self, k, x, y)
    class(cascaded_sums), intent(inout) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: x(:), y(:)
    integer :: i

    do i = 1, size(x)
      call add_product(x(i), y(i), self%first(k), self%second(k), self%third(k), self%last(k))
    end do
    self%terms = self%terms + size(x)
  end subroutine add_dot

  !> The sums, and how far they are off at most.
  pure subroutine finish(self, sums, error)
    class(cascaded_sums), intent(in) :: self
    real(dp), intent(out) :: sums(:), error(:)
    real(dp) :: first, rest, second, sum, third
    integer :: k

    do k = 1, size(sums)
      first = self%first(k) - bias_above(self%most(k))
      second = self%second(k) - bias_above(SECOND_PART*self%most(k))
      third = self%third(k) - bias_above(THIRD_PART*self%most(k))
      ! Where the first parts cancel, their sum is exact.
      call add_exactly(first, second, sum, rest)
      call add_exactly(sum, rest + third, first, second)
      sums(k) = first + (second + self%last(k))
    end do
    error = raised(4.0_dp*UNIT_ROUNDOFF*abs(sums) &
                   + (FROM_PRODUCTS + real(self%terms + 8, dp)*FROM_SUMS)*self%most, 4) + LEAST
  end subroutine finish

  !> a + b = sum + rest (D. E. Knuth, The Art of Computer Programming 2, section 4.2.2).
  pure subroutine add_exactly(a, b, sum, rest)
    real(dp), intent(in) :: a, b
    real(dp), intent(out) :: sum, rest
    real(dp) :: back

    sum = a + b
    back = sum - a
    rest = (a - (sum - back)) + (b - back)
  end subroutine add_exactly

  !> Add `value` to a part that is larger; what rounding takes is left of `value`.
  pure subroutine take(value, part)
    real(dp), intent(inout) :: value, part
    real(dp) :: sum

    sum = part + value
    value = value - (sum - part)
    part = sum
  end subroutine take

  pure subroutine add_term(term, first, second, third, last)
    real(dp), intent(in) :: term
    real(dp), intent(inout) :: first, second, third, last
    real(dp) :: value

    value = term
    call take(value, first)
    call take(value, second)
    call take(value, third)
    last = last + value
  end subroutine add_term

  pure subroutine add_product(a, b, first, second, third, last)
    real(dp), intent(in) :: a, b
    real(dp), intent(inout) :: first, second, third, last
    real(dp) :: lower_a, lower_b, product, upper_a, upper_b

    upper_a = upper_half(a)
    upper_b = upper_half(b)
    lower_a = a - upper_a
    lower_b = b - upper_b
    call add_term(upper_a*upper_b, first, second, third, last)
    product = upper_a*lower_b
    call take(product, second)
    call take(product, third)
    last = last + product
    product = lower_a*upper_b
    call take(product, second)
    call take(product, third)
    last = last + product
    product = lower_a*lower_b
    call take(product, third)
    last = last + product
  end subroutine add_product

end module fuge_cascaded_sums
