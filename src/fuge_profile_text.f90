!> The lines of a profile file: fields and numbers.
!>
!> Numbers are converted here, since a formatted read of each takes most of the time of a
!> long file. Up to 15 digits and powers of ten up to 22 are exact in double precision, so
!> that one multiplication or division rounds correctly (W. D. Clinger, How to read
!> floating point numbers accurately, 1990); the rest is left to the compiler's library.
module fuge_profile_text
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: read_point, read_number

  !> What a line is.
  integer, parameter, public :: LINE_EMPTY = 0
  integer, parameter, public :: LINE_POINT = 1
  integer, parameter, public :: LINE_WORDS = 2
  integer, parameter, public :: LINE_WRONG = 3

  !> What a field is.
  integer, parameter, public :: FIELD_NUMBER = 0
  integer, parameter, public :: FIELD_NOT_FINITE = 1
  integer, parameter, public :: FIELD_WORD = 2
  integer, parameter, public :: FIELD_WRONG = 3

  integer, parameter :: MOST_DIGITS = 18, EXACT_DIGITS = 15, EXACT_POWER = 22
  real(dp), parameter :: POWER_OF_TEN(0:EXACT_POWER) = [ &
    1.0e0_dp, 1.0e1_dp, 1.0e2_dp, 1.0e3_dp, 1.0e4_dp, 1.0e5_dp, 1.0e6_dp, 1.0e7_dp, 1.0e8_dp, 1.0e9_dp, 1.0e10_dp, &
    1.0e11_dp, 1.0e12_dp, 1.0e13_dp, 1.0e14_dp, 1.0e15_dp, 1.0e16_dp, 1.0e17_dp, 1.0e18_dp, 1.0e19_dp, 1.0e20_dp, &
    1.0e21_dp, 1.0e22_dp]
  !> Larger exponents are all the same to a double.
  integer, parameter :: EXPONENT_LIMIT = 100000
  !> As much of a field as a message quotes.
  integer, parameter :: QUOTE_LENGTH = 24

  !> A decimal number as it is written: digits * 10**exponent.
  type :: decimal
    integer(int64) :: digits = 0_int64
    integer :: count = 0
    integer :: exponent = 0
    logical :: negative = .false.
    !> All of its digits are in `digits`.
    logical :: complete = .true.
  end type decimal

contains

  !> Two numbers of one line, separated by blanks, tabs, a comma or a semicolon.
  !>
  !> `kind` is LINE_POINT with `x` and `z`, LINE_EMPTY (blank, or a comment that begins
  !> with # or !), LINE_WORDS (both fields are words, a header perhaps) or LINE_WRONG;
  !> `reason` is allocated for the last two. A comment may follow the numbers.
  pure subroutine read_point(line, kind, x, z, reason)
    character(len=*), intent(in) :: line
    integer, intent(out) :: kind
    real(dp), intent(out) :: x, z
    character(len=:), allocatable, intent(out) :: reason
    integer :: first(2), last(2), fields, of_x, of_z

    x = 0.0_dp
    z = 0.0_dp
    kind = LINE_EMPTY
    call split(line, first, last, fields)
    if (fields == 0) return
    call read_number(line(first(1):last(1)), of_x, x)
    of_z = of_x
    if (fields > 1) call read_number(line(first(2):last(2)), of_z, z)
    if (of_x == FIELD_NUMBER .and. of_z == FIELD_NUMBER .and. fields == 2) then
      kind = LINE_POINT
    else if (of_x == FIELD_WORD .and. of_z == FIELD_WORD) then
      kind = LINE_WORDS
      reason = describe(line(first(1):last(1)), of_x)
    else
      kind = LINE_WRONG
      if (of_x /= FIELD_NUMBER) then
        reason = describe(line(first(1):last(1)), of_x)
      else if (fields == 1) then
        reason = 'only one column, x and z are needed'
      else if (of_z /= FIELD_NUMBER) then
        reason = describe(line(first(2):last(2)), of_z)
      else
        reason = 'more than two columns, x and z are needed (the decimal sign is the point)'
      end if
    end if
  end subroutine read_point

  !> Where the first two fields stand; `fields` is 3 if there are more.
  pure subroutine split(line, first, last, fields)
    character(len=*), intent(in) :: line
    integer, intent(out) :: first(2), last(2), fields
    integer :: k, start

    first = 1
    last = 0
    fields = 0
    k = after_blanks(line, 1)
    do while (k <= len(line))
      if (line(k:k) == '#' .or. line(k:k) == '!') exit
      fields = fields + 1
      if (fields > 2) exit
      start = k
      do while (k <= len(line))
        if (is_blank(line(k:k)) .or. is_separator(line(k:k))) exit
        k = k + 1
      end do
      first(fields) = start
      last(fields) = k - 1
      k = after_blanks(line, k)
      if (k > len(line)) exit
      if (is_separator(line(k:k))) k = after_blanks(line, k + 1)
    end do
  end subroutine split

  pure function after_blanks(line, from) result(k)
    character(len=*), intent(in) :: line
    integer, intent(in) :: from
    integer :: k

    k = from
    do while (k <= len(line))
      if (.not. is_blank(line(k:k))) exit
      k = k + 1
    end do
  end function after_blanks

  !> Blank, tab, or the carriage return of a Windows line end.
  elemental function is_blank(letter)
    character, intent(in) :: letter
    logical :: is_blank

    is_blank = letter == ' ' .or. letter == achar(9) .or. letter == achar(13)
  end function is_blank

  elemental function is_separator(letter)
    character, intent(in) :: letter
    logical :: is_separator

    is_separator = letter == ',' .or. letter == ';'
  end function is_separator

  !> A number with a decimal point and an exponent after d, D, e or E.
  !>
  !> `kind` is one of the FIELD_ numbers; `value` is 0 unless it is FIELD_NUMBER. Numbers
  !> too small for a double are 0, those from 1e308 on count as infinite.
  pure subroutine read_number(field, kind, value)
    character(len=*), intent(in) :: field
    integer, intent(out) :: kind
    real(dp), intent(out) :: value
    type(decimal) :: number
    integer :: status

    value = 0.0_dp
    call read_decimal(field, number, kind)
    if (kind /= FIELD_NUMBER .or. number%digits == 0_int64) return
    if (number%exponent + number%count > 308) then
      kind = FIELD_NOT_FINITE
    else if (number%exponent + number%count < -330) then
      return
    else if (number%complete .and. number%count <= EXACT_DIGITS .and. abs(number%exponent) <= EXACT_POWER) then
      if (number%exponent < 0) then
        value = real(number%digits, dp)/POWER_OF_TEN(-number%exponent)
      else
        value = real(number%digits, dp)*POWER_OF_TEN(number%exponent)
      end if
      if (number%negative) value = -value
    else
      read (field, *, iostat=status) value
      if (status /= 0) kind = FIELD_WRONG
    end if
  end subroutine read_number

  pure subroutine read_decimal(field, number, kind)
    character(len=*), intent(in) :: field
    type(decimal), intent(out) :: number
    integer, intent(out) :: kind
    integer :: k, seen

    k = 1
    if (len(field) > 0) then
      number%negative = field(1:1) == '-'
      if (number%negative .or. field(1:1) == '+') k = 2
    end if
    seen = 0
    call take_digits(field, k, number, seen)
    if (letter_at(field, k) == '.') then
      k = k + 1
      number%exponent = number%exponent - count_digits(field, k)
      call take_digits(field, k, number, seen)
    end if
    if (seen == 0) then
      kind = kind_of_word(field)
      return
    end if
    kind = FIELD_NUMBER
    if (scan(letter_at(field, k), 'eEdD') > 0) call take_exponent(field, k, number)
    if (k <= len(field)) kind = FIELD_WRONG
  end subroutine read_decimal

  !> The digits at `k`; `seen` counts them, leading zeros included.
  pure subroutine take_digits(field, k, number, seen)
    character(len=*), intent(in) :: field
    integer, intent(inout) :: k, seen
    type(decimal), intent(inout) :: number
    integer :: digit

    do while (k <= len(field))
      digit = iachar(field(k:k)) - iachar('0')
      if (digit < 0 .or. digit > 9) exit
      seen = seen + 1
      k = k + 1
      if (number%count == MOST_DIGITS) then
        ! Dropped here, but it holds a place.
        number%complete = .false.
        number%exponent = number%exponent + 1
      else if (digit > 0 .or. number%count > 0) then
        number%digits = 10_int64*number%digits + int(digit, int64)
        number%count = number%count + 1
      end if
    end do
  end subroutine take_digits

  pure function count_digits(field, from) result(digits)
    character(len=*), intent(in) :: field
    integer, intent(in) :: from
    integer :: digits

    digits = verify(field(from:), '0123456789') - 1
    if (digits < 0) digits = len(field) - from + 1
  end function count_digits

  !> An exponent at `k`, which stays where no digits follow.
  pure subroutine take_exponent(field, k, number)
    character(len=*), intent(in) :: field
    integer, intent(inout) :: k
    type(decimal), intent(inout) :: number
    integer :: j, power
    logical :: negative

    j = k + 1
    negative = letter_at(field, j) == '-'
    if (negative .or. letter_at(field, j) == '+') j = j + 1
    if (count_digits(field, j) == 0) return
    power = 0
    do while (scan(letter_at(field, j), '0123456789') > 0)
      power = min(10*power + iachar(field(j:j)) - iachar('0'), EXPONENT_LIMIT)
      j = j + 1
    end do
    k = j
    number%exponent = number%exponent + merge(-power, power, negative)
  end subroutine take_exponent

  !> A blank beyond the end.
  pure function letter_at(field, k) result(letter)
    character(len=*), intent(in) :: field
    integer, intent(in) :: k
    character :: letter

    letter = ' '
    if (k <= len(field)) letter = field(k:k)
  end function letter_at

  !> NaN and infinity as languages write them; a word begins with a letter or a quote.
  pure function kind_of_word(field) result(kind)
    character(len=*), intent(in) :: field
    integer :: kind
    character(len=8) :: word
    integer :: k

    word = field
    if (scan(letter_at(field, 1), '+-') > 0) word = field(2:)
    do k = 1, len(word)
      if (word(k:k) >= 'A' .and. word(k:k) <= 'Z') word(k:k) = achar(iachar(word(k:k)) + 32)
    end do
    if (word == 'inf' .or. word == 'infinity' .or. word == 'nan' .or. word(1:4) == 'nan(') then
      kind = FIELD_NOT_FINITE
    else if (scan(letter_at(field, 1), '0123456789+-.* ') > 0) then
      kind = FIELD_WRONG
    else
      kind = FIELD_WORD
    end if
  end function kind_of_word

  pure function describe(field, kind) result(reason)
    character(len=*), intent(in) :: field
    integer, intent(in) :: kind
    character(len=:), allocatable :: reason
    integer :: k

    if (len(field) == 0) then
      reason = 'an empty column, x and z are needed'
      return
    end if
    reason = field(:min(len(field), QUOTE_LENGTH))
    do k = 1, len(reason)
      if (iachar(reason(k:k)) < 32 .or. iachar(reason(k:k)) > 126) reason(k:k) = '?'
    end do
    if (len(field) > QUOTE_LENGTH) reason = reason//'..'
    if (kind == FIELD_NOT_FINITE) then
      reason = '"'//reason//'" is not a finite number'
    else
      reason = '"'//reason//'" is not a number'
    end if
  end function describe

end module fuge_profile_text
