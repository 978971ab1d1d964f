!> Sums of products with 24 digits of their terms, for residuals that cancel.
!>
!> Each sum is a pair, a high part that starts from a `bias` larger than all that will be added, and a low part that
!> collects what the high part rounds away. Beside the bias no term is the larger one, so that three additions show the
!> rounding of the high part exactly (T. J. Dekker, Numerische Mathematik 18, 1971). Products are split so that their
!> leading part is exact, that of the first 26 bits of each factor; the rest, smaller by 2**26, goes to the low part.
module fuge_compensated_sums
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_column, add_terms, add_two_columns, bias_above, compensated_dot, compensated_sum, &
    difference_rounding, upper_half

  integer, parameter :: int64 = selected_int_kind(18)
  !> The bits of a real that its upper half keeps.
  integer(int64), parameter :: UPPER_BITS = not(ishft(1_int64, 27) - 1_int64)

contains

  !> Three times a power of two, so large that sums up to `most` do not change the exponent of what is added to it.
  pure function bias_above(most) result(bias)
    real(dp), intent(in) :: most
    real(dp) :: bias

    bias = 3.0_dp*scale(1.0_dp, min(exponent(most) + 1, maxexponent(most) - 2))
  end function bias_above

  !> A value with the lower 27 bits of its 53 taken off, towards zero.
  elemental function upper_half(value) result(upper)
    real(dp), intent(in) :: value
    real(dp) :: upper

    upper = transfer(iand(transfer(value, UPPER_BITS), UPPER_BITS), upper)
  end function upper_half

  !> The rounding error of `difference` = a - b: the exact difference is the sum of both (D. E. Knuth, The Art of
  !> Computer Programming 2, section 4.2.2).
  elemental function difference_rounding(a, b, difference) result(rounding)
    real(dp), intent(in) :: a, b, difference
    real(dp) :: rounding
    real(dp) :: from_b

    from_b = a - difference
    rounding = (a - (difference + from_b)) + (from_b - b)
  end function difference_rounding

  !> high + low := high + low + factor column, all of one length.
  pure subroutine add_column(column, factor, high, low)
    real(dp), intent(in), contiguous :: column(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: high(:), low(:)
    real(dp) :: factor_upper, factor_rest, upper, product, sum, rest
    integer :: i

    factor_upper = upper_half(factor)
    factor_rest = factor - factor_upper
    do i = 1, size(column)
      upper = transfer(iand(transfer(column(i), UPPER_BITS), UPPER_BITS), upper)
      product = upper*factor_upper
      rest = upper*factor_rest + (column(i) - upper)*factor
      sum = high(i) + product
      low(i) = low(i) + ((product - (sum - high(i))) + rest)
      high(i) = sum
    end do
  end subroutine add_column

  !> As `add_column` for two columns and their factors, in one pass over the sums.
  pure subroutine add_two_columns(first, second, factors, high, low)
    real(dp), intent(in), contiguous :: first(:), second(:)
    real(dp), intent(in) :: factors(2)
    real(dp), intent(inout), contiguous :: high(:), low(:)
    real(dp) :: factor_upper(2), factor_rest(2), upper(2), product(2), sum(2), rest
    integer :: i

    factor_upper = upper_half(factors)
    factor_rest = factors - factor_upper
    do i = 1, size(first)
      upper(1) = transfer(iand(transfer(first(i), UPPER_BITS), UPPER_BITS), upper(1))
      upper(2) = transfer(iand(transfer(second(i), UPPER_BITS), UPPER_BITS), upper(2))
      product(1) = upper(1)*factor_upper(1)
      product(2) = upper(2)*factor_upper(2)
      rest = (upper(1)*factor_rest(1) + (first(i) - upper(1))*factors(1)) &
             + (upper(2)*factor_rest(2) + (second(i) - upper(2))*factors(2))
      sum(1) = high(i) + product(1)
      sum(2) = sum(1) + product(2)
      low(i) = low(i) + (((product(1) - (sum(1) - high(i))) + (product(2) - (sum(2) - sum(1)))) + rest)
      high(i) = sum(2)
    end do
  end subroutine add_two_columns

  !> high + low := high + low + terms.
  pure subroutine add_terms(terms, high, low)
    real(dp), intent(in), contiguous :: terms(:)
    real(dp), intent(inout), contiguous :: high(:), low(:)
    real(dp) :: sum
    integer :: i

    do i = 1, size(terms)
      sum = high(i) + terms(i)
      low(i) = low(i) + (terms(i) - (sum - high(i)))
      high(i) = sum
    end do
  end subroutine add_terms

  !> start - x.y, rounded once but for 2**(-78) of its terms.
  pure function compensated_dot(start, x, y) result(difference)
    real(dp), intent(in) :: start
    real(dp), intent(in), contiguous :: x(:), y(:)
    real(dp) :: difference
    real(dp) :: high, low, upper_x, upper_y, product, sum, back
    integer :: i

    high = start
    low = 0.0_dp
    do i = 1, size(x)
      upper_x = upper_half(x(i))
      upper_y = upper_half(y(i))
      product = -upper_x*upper_y
      low = low - (upper_x*(y(i) - upper_y) + (x(i) - upper_x)*y(i))
      sum = high + product
      back = sum - high
      low = low + ((high - (sum - back)) + (product - back))
      high = sum
    end do
    difference = high + low
  end function compensated_dot

  !> The sum of values, off by at most the unit roundoff u of itself and 2 (n u)**2 of the sum of their magnitudes.
  pure function compensated_sum(values) result(total)
    real(dp), intent(in) :: values(:)
    real(dp) :: total
    real(dp) :: back, low, sum
    integer :: k

    total = 0.0_dp
    low = 0.0_dp
    do k = 1, size(values)
      sum = total + values(k)
      back = sum - total
      low = low + ((total - (sum - back)) + (values(k) - back))
      total = sum
    end do
    total = total + low
  end function compensated_sum

end module fuge_compensated_sums
