!> Numbers as text, for messages.
!>
!> An index goes into a message as `index_text(k)`, any other number (a size, a count, a value, a
!> line of a file) as `text(k)`.
!>
!> The length of each result is known before the call, because gfortran keeps the length of
!> a deferred-length result (`len=:`) in a variable that all threads share.
module fuge_number_text
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: index_text, text

  !> Stands before an index in the text that `report` is given. No file name or other text of a
  !> caller can hold it: in C it ends a string.
  character, parameter, public :: INDEX_MARK = achar(0)

  !> An integer, or a real number to about six digits, without blanks.
  interface text
    module procedure text_integer
    module procedure text_real
  end interface text

contains

  !> Digit by digit, not by an internal write: see `real_string`.
  pure function integer_string(value) result(string)
    integer, intent(in) :: value
    character(len=12) :: string
    integer :: first, rest

    string = ''
    first = len(string)
    ! The negative number always exists.
    rest = merge(value, -value, value < 0)
    do
      string(first:first) = achar(iachar('0') - mod(rest, 10))
      rest = rest/10
      if (rest == 0) exit
      first = first - 1
    end do
    if (value < 0) then
      first = first - 1
      string(first:first) = '-'
    end if
    string = string(first:)
  end function integer_string

  pure function text_integer(value) result(string)
    integer, intent(in) :: value
    character(len=len_trim(integer_string(value))) :: string

    string = integer_string(value)
  end function text_integer

  !> An index for a message: the number of a point, row, degree of freedom or mode, which counts
  !> from 1 here and from 0 in C. `fuge_status` turns the marked number into the caller's.
  pure function index_text(value) result(string)
    integer, intent(in) :: value
    character(len=len_trim(integer_string(value)) + 1) :: string

    string = INDEX_MARK//integer_string(value)
  end function index_text

  !> A real number to six digits or so. Not by an internal write: gfortran's run-time library keeps internal units in
  !> the list through which `open` walks in another thread.
  pure function real_string(value) result(string)
    real(dp), intent(in) :: value
    character(len=24) :: string

    ! Asked first, because a comparison with NaN may trap.
    if (ieee_is_nan(value)) then
      string = 'NaN'
      return
    else if (.not. ieee_is_finite(value)) then
      string = 'Infinity'
    else if (abs(value) >= 1.0e-3_dp .and. abs(value) < 1.0e5_dp) then
      string = fixed_string(abs(value))
    else
      string = exponent_string(abs(value))
    end if
    if (sign(1.0_dp, value) < 0.0_dp) string = '-'//trim(string)
  end function real_string

  !> Six digits after the decimal point, of a value below 1e5.
  pure function fixed_string(value) result(string)
    real(dp), intent(in) :: value
    character(len=24) :: string
    integer(int64) :: millionths

    ! As a double, because flang cannot round wider numbers.
    millionths = nint(real(real(value, xp)*1.0e6_xp, dp), int64)
    string = trim(integer_string(int(millionths/1000000_int64)))//'.' &
             //last_digits(int(mod(millionths, 1000000_int64)), 6)
  end function fixed_string

  !> One digit, five digits after the decimal point, and the exponent.
  pure function exponent_string(value) result(string)
    real(dp), intent(in) :: value
    character(len=24) :: string
    integer :: digits, power

    digits = 0
    power = 0
    if (value > 0.0_dp) then
      power = floor(log10(value))
      digits = six_digits(value, power)
      ! The logarithm may be rounded to the next power of ten, and so may the digits.
      if (digits < 100000) power = power - 1
      if (digits >= 1000000) power = power + 1
      digits = min(six_digits(value, power), 999999)
    end if
    string = trim(integer_string(digits/100000))//'.'//last_digits(mod(digits, 100000), 5)//'E' &
             //merge('-', '+', power < 0)//last_digits(abs(power), 3)
  end function exponent_string

  !> value/10**(power - 5), rounded. In two factors, which stay in range.
  pure function six_digits(value, power) result(digits)
    real(dp), intent(in) :: value
    integer, intent(in) :: power
    integer :: digits
    integer :: half

    half = (5 - power)/2
    digits = nint(real((real(value, xp)*10.0_xp**half)*10.0_xp**(5 - power - half), dp))
  end function six_digits

  !> The last `count` decimal digits of a number that is not negative.
  pure function last_digits(number, count) result(digits)
    integer, intent(in) :: number, count
    character(len=count) :: digits
    integer :: k, rest

    rest = number
    do k = count, 1, -1
      digits(k:k) = achar(iachar('0') + mod(rest, 10))
      rest = rest/10
    end do
  end function last_digits

  pure function text_real(value) result(string)
    real(dp), intent(in) :: value
    character(len=len_trim(real_string(value))) :: string

    string = real_string(value)
  end function text_real

end module fuge_number_text
