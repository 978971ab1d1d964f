!> A decimal number rounded to the nearest double.
!>
!> Up to 15 digits and powers of ten up to 22 are exact in double precision, so that one
!> multiplication or division rounds correctly (W. D. Clinger, How to read floating point
!> numbers accurately, 1990). Otherwise the number is computed with twice the digits, as a sum of
!> two doubles (T. J. Dekker, A floating-point technique for extending the available precision,
!> 1971), which suffices for rounding unless it lies too near to half-way between two doubles.
module fuge_decimal_rounding
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: round_decimal

  !> Number of decimal digits that fit in a 64-bit integer.
  integer, parameter, public :: MOST_DIGITS = 18

  integer(int64), parameter :: EXACT_DIGITS = 10_int64**15
  integer, parameter :: EXACT_POWER = 22
  real(dp), parameter :: POWER_OF_TEN(0:EXACT_POWER) = [ &
    1.0e0_dp, 1.0e1_dp, 1.0e2_dp, 1.0e3_dp, 1.0e4_dp, 1.0e5_dp, 1.0e6_dp, 1.0e7_dp, 1.0e8_dp, 1.0e9_dp, 1.0e10_dp, &
    1.0e11_dp, 1.0e12_dp, 1.0e13_dp, 1.0e14_dp, 1.0e15_dp, 1.0e16_dp, 1.0e17_dp, 1.0e18_dp, 1.0e19_dp, 1.0e20_dp, &
    1.0e21_dp, 1.0e22_dp]
  !> Largest power of ten, in up to four factors, each with a relative error below 2**-103.
  integer, parameter :: LARGEST_POWER = 4*EXACT_POWER
  !> Bound on the relative error of the sum of two doubles.
  real(dp), parameter :: ERROR_BOUND = 2.0_dp**(-98)

contains

  !> `value` = `digits` 10**`exponent`, rounded; `digits` from 0 to 10**18.
  !>
  !> If this arithmetic is not accurate enough, `certain` is false and `value` must not be used.
  pure subroutine round_decimal(digits, exponent, value, certain)
    integer(int64), intent(in) :: digits
    integer, intent(in) :: exponent
    real(dp), intent(out) :: value
    logical, intent(out) :: certain
    real(dp) :: rest

    value = real(digits, dp)
    certain = .true.
    if (digits <= EXACT_DIGITS .and. abs(exponent) <= EXACT_POWER) then
      if (exponent < 0) then
        value = value/POWER_OF_TEN(-exponent)
      else
        value = value*POWER_OF_TEN(exponent)
      end if
      return
    end if
    certain = abs(exponent) <= LARGEST_POWER
    if (.not. certain) return
    rest = real(digits - int(value, int64), dp)
    call multiply_by_power(exponent, value, rest)
    certain = .not. value + (rest + ERROR_BOUND*value) > value + (rest - ERROR_BOUND*value)
  end subroutine round_decimal

  !> Multiply value + rest by a power of ten; |rest| stays below half a unit in the last place.
  pure subroutine multiply_by_power(power, value, rest)
    integer, intent(in) :: power
    real(dp), intent(inout) :: value, rest
    real(dp) :: factor, first, second, product, low
    integer :: left

    left = abs(power)
    do while (left > 0)
      factor = POWER_OF_TEN(min(left, EXACT_POWER))
      left = left - min(left, EXACT_POWER)
      if (power < 0) then
        first = value/factor
        call multiply_exactly(first, factor, product, low)
        second = ((value - product) - low + rest)/factor
      else
        call multiply_exactly(value, factor, first, low)
        second = low + rest*factor
      end if
      value = first + second
      rest = second - (value - first)
    end do
  end subroutine multiply_by_power

  !> a*b = product + rest, exactly. All products but the last are exact, so that fused
  !> multiply-add operations do not change the result.
  pure subroutine multiply_exactly(a, b, product, rest)
    real(dp), intent(in) :: a, b
    real(dp), intent(out) :: product, rest
    real(dp) :: upper_a, upper_b, lower_a, lower_b, partial

    upper_a = upper_half(a)
    lower_a = a - upper_a
    upper_b = upper_half(b)
    lower_b = b - upper_b
    partial = upper_a*upper_b + upper_a*lower_b
    rest = upper_a*lower_b - (partial - upper_a*upper_b)
    product = partial + lower_a*upper_b
    rest = rest + (lower_a*upper_b - (product - partial)) + lower_a*lower_b
  end subroutine multiply_exactly

  !> a with its first 26 bits only; products of two such numbers are exact.
  pure function upper_half(a) result(upper)
    real(dp), intent(in) :: a
    real(dp) :: upper

    upper = transfer(iand(transfer(a, 0_int64), not(134217727_int64)), a)
  end function upper_half

end module fuge_decimal_rounding
