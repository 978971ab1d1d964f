!> A decimal number with any number of digits rounded to the nearest double, exactly.
!>
!> An estimate is held against the points half-way to its neighbours, in whole numbers of any length. This takes
!> microseconds; `fuge_decimal_rounding` deals with most numbers in less.
module fuge_exact_rounding
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: round_exactly

  !> Digits that can decide: a point half-way between two doubles has at most 768.
  integer, parameter, public :: DECISIVE_DIGITS = 800

  !> A limb of a whole number has nine digits; 10**(800 + 324) and 2**1074 times 18 digits fit.
  integer(int64), parameter :: BASE = 10_int64**9
  integer, parameter :: LIMBS = 160

  !> A whole number, the least limb first.
  type :: whole
    integer(int64) :: limb(LIMBS) = 0_int64
    integer :: used = 0
  end type whole

  !> Doubles are mantissa * 2**power; all mantissas have 53 bits but those of the least power.
  integer, parameter :: LEAST_POWER = -1074, BITS = 53
  integer(int64), parameter :: LARGEST_MANTISSA = 2_int64**BITS

contains

  !> The double nearest to 0.`digits` * 10**`places`, the even one if two are.
  !>
  !> `digits`: 1 to DECISIVE_DIGITS digits, the first one not 0. `places`: from -400 to 309; the number is not above the
  !> largest double.
  pure function round_exactly(digits, places) result(value)
    character(len=*), intent(in) :: digits
    integer, intent(in) :: places
    real(dp) :: value
    integer(int64) :: mantissa
    integer :: power

    call estimate(digits, places, mantissa, power)
    do
      if (is_above(digits, places, mantissa, power)) then
        mantissa = mantissa + 1_int64
        if (mantissa == LARGEST_MANTISSA) then
          mantissa = mantissa/2_int64
          power = power + 1
        end if
      else if (is_below(digits, places, mantissa, power)) then
        if (is_least_of_its_power(mantissa, power)) then
          mantissa = LARGEST_MANTISSA
          power = power - 1
        end if
        mantissa = mantissa - 1_int64
      else
        exit
      end if
    end do
    value = scale(real(mantissa, dp), power)
  end function round_exactly

  !> A double near the number.
  pure subroutine estimate(digits, places, mantissa, power)
    character(len=*), intent(in) :: digits
    integer, intent(in) :: places
    integer(int64), intent(out) :: mantissa
    integer, intent(out) :: power
    real(dp) :: value
    integer :: k, leading, total

    leading = min(len(digits), 15)
    value = 0.0_dp
    do k = 1, leading
      value = 10.0_dp*value + real(digit_of(digits(k:k)), dp)
    end do
    ! The power of two is kept apart, so that nothing overflows or vanishes.
    total = 0
    do k = 1, abs(places - leading)
      value = merge(10.0_dp*value, value/10.0_dp, places > leading)
      total = total + exponent(value)
      value = fraction(value)
    end do
    total = total + exponent(value)
    power = max(total - BITS, LEAST_POWER)
    mantissa = int(scale(fraction(value), total - power), int64)
  end subroutine estimate

  !> Is the mantissa the least one that has all bits, and is there a smaller power?
  pure function is_least_of_its_power(mantissa, power) result(least)
    integer(int64), intent(in) :: mantissa
    integer, intent(in) :: power
    logical :: least

    least = mantissa == LARGEST_MANTISSA/2_int64 .and. power > LEAST_POWER
  end function is_least_of_its_power

  !> Does the number round to a double above this one?
  pure function is_above(digits, places, mantissa, power) result(above)
    character(len=*), intent(in) :: digits
    integer, intent(in) :: places, power
    integer(int64), intent(in) :: mantissa
    logical :: above
    integer :: difference

    difference = compare_with(digits, places, 2_int64*mantissa + 1_int64, power - 1)
    above = difference > 0 .or. (difference == 0 .and. btest(mantissa, 0))
  end function is_above

  !> Does the number round to a double below this one?
  pure function is_below(digits, places, mantissa, power) result(below)
    character(len=*), intent(in) :: digits
    integer, intent(in) :: places, power
    integer(int64), intent(in) :: mantissa
    logical :: below
    integer :: difference

    below = mantissa > 0_int64
    if (.not. below) return
    if (is_least_of_its_power(mantissa, power)) then
      ! Doubles lie closer together below it.
      difference = compare_with(digits, places, 4_int64*mantissa - 1_int64, power - 2)
    else
      difference = compare_with(digits, places, 2_int64*mantissa - 1_int64, power - 1)
    end if
    below = difference < 0 .or. (difference == 0 .and. btest(mantissa, 0))
  end function is_below

  !> The sign of 0.`digits` * 10**`places` - `factor` * 2**`power`.
  pure function compare_with(digits, places, factor, power) result(difference)
    character(len=*), intent(in) :: digits
    integer, intent(in) :: places, power
    integer(int64), intent(in) :: factor
    integer :: difference
    type(whole) :: left, right
    integer :: tens

    tens = places - len(digits)
    left = whole_of(digits)
    right%limb(:3) = [mod(factor, BASE), mod(factor/BASE, BASE), factor/BASE**2]
    right%used = 3
    call multiply_by_power(left, 10, tens)
    call multiply_by_power(left, 2, -power)
    call multiply_by_power(right, 10, -tens)
    call multiply_by_power(right, 2, power)
    difference = compare(left, right)
  end function compare_with

  !> The whole number with these digits.
  pure function whole_of(digits) result(number)
    character(len=*), intent(in) :: digits
    type(whole) :: number
    integer :: k, first, last

    last = len(digits)
    do while (last > 0)
      first = max(1, last - 8)
      number%used = number%used + 1
      do k = first, last
        number%limb(number%used) = 10_int64*number%limb(number%used) + int(digit_of(digits(k:k)), int64)
      end do
      last = first - 1
    end do
  end function whole_of

  pure function digit_of(letter) result(digit)
    character, intent(in) :: letter
    integer :: digit

    digit = iachar(letter) - iachar('0')
  end function digit_of

  !> Multiply by 2 or 10 to a power; nothing is done for a negative power.
  pure subroutine multiply_by_power(number, factor, power)
    type(whole), intent(inout) :: number
    integer, intent(in) :: factor, power
    integer :: left, step

    ! Nine tens, or 29 twos, at a time.
    left = power
    do while (left > 0)
      step = min(left, merge(9, 29, factor == 10))
      call multiply(number, int(factor, int64)**step)
      left = left - step
    end do
  end subroutine multiply_by_power

  !> Multiply by a factor up to BASE.
  pure subroutine multiply(number, factor)
    type(whole), intent(inout) :: number
    integer(int64), intent(in) :: factor
    integer(int64) :: carry
    integer :: k

    carry = 0_int64
    do k = 1, number%used
      carry = carry + factor*number%limb(k)
      number%limb(k) = mod(carry, BASE)
      carry = carry/BASE
    end do
    if (carry == 0_int64) return
    number%used = number%used + 1
    number%limb(number%used) = carry
  end subroutine multiply

  !> The sign of a - b.
  pure function compare(a, b) result(difference)
    type(whole), intent(in) :: a, b
    integer :: difference
    integer :: k

    difference = 0
    do k = max(a%used, b%used), 1, -1
      if (a%limb(k) == b%limb(k)) cycle
      difference = merge(1, -1, a%limb(k) > b%limb(k))
      return
    end do
  end function compare

end module fuge_exact_rounding
