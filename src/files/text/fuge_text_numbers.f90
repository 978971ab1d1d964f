!> Numbers in text, and text in messages.
!>
!> Numbers are converted here, because formatted reads would take most of the time for a long
!> file. So would C's strtod, which takes two to three times as long for 17 digits: it rounds only those few numbers
!> that lie too near to half-way between two doubles, or have large exponents.
module fuge_text_numbers
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_decimal_rounding, only: round_decimal, MOST_DIGITS
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  implicit none
  private

  public :: describe_text, lower_case, quoted, read_number, read_whole

  !> Kinds of text, as of a column of a file.
  integer, parameter, public :: KIND_NUMBER = 0
  integer, parameter, public :: KIND_NOT_FINITE = 1
  integer, parameter, public :: KIND_WORD = 2
  integer, parameter, public :: KIND_WRONG = 3

  !> The largest double, 1.79..e308, has 309 digits before the point, of which these are the
  !> first. Numbers with a smaller decimal exponent than the least double, 4.9e-324, are 0.
  integer, parameter :: LARGEST_PLACES = 309, LEAST_PLACES = -323
  integer(int64), parameter :: LARGEST_DIGITS = 179769313486231570_int64
  !> Digits that can decide: a point half-way between two doubles has at most 768.
  integer, parameter :: DECISIVE_DIGITS = 800
  !> Room for an exponent after them: e-1123 and a null character.
  integer, parameter :: EXPONENT_LENGTH = 8
  !> Larger exponents are cut to this one, which overflows or vanishes in any case.
  integer, parameter :: EXPONENT_LIMIT = 100000
  integer, parameter :: BLANK = iachar(' '), MINUS = iachar('-'), PLUS = iachar('+'), POINT = iachar('.')
  !> Number of characters of a text that messages quote.
  integer, parameter :: QUOTE_LENGTH = 24

  !> A decimal number: digits * 10**exponent.
  type :: decimal
    integer(int64) :: digits = 0_int64
    !> Number of significant digits in `digits`.
    integer :: count = 0
    integer :: exponent = 0
    logical :: negative = .false.
    !> `digits` has all digits of the number.
    logical :: complete = .true.
  end type decimal

  interface
    !> The double nearest to the number that `number` begins with, which ends with a null character; with a null pointer
    !> C does not say where that number ends.
    pure function strtod(number, no_end) bind(c, name='strtod') result(value)
      import :: c_char, c_double, c_ptr
      character(kind=c_char), intent(in) :: number(*)
      type(c_ptr), intent(in), value :: no_end
      real(c_double) :: value
    end function strtod
  end interface

contains

  pure function quoted_length(string) result(length)
    character(len=*), intent(in) :: string
    integer :: length

    length = min(len(string), QUOTE_LENGTH) + merge(4, 2, len(string) > QUOTE_LENGTH)
  end function quoted_length

  pure function description(kind) result(words)
    integer, intent(in) :: kind
    character(len=24) :: words

    words = ' is not a number'
    if (kind == KIND_NOT_FINITE) words = ' is not a finite number'
  end function description

  !> Text for a message: its beginning in quotes, unprintable characters as ?, quotes as '.
  pure function quoted(string) result(quote)
    character(len=*), intent(in) :: string
    character(len=quoted_length(string)) :: quote
    integer :: k

    quote = '"'//string(:min(len(string), QUOTE_LENGTH))
    if (len(string) > QUOTE_LENGTH) quote(QUOTE_LENGTH + 2:) = '..'
    do k = 2, len(quote) - 1
      if (iachar(quote(k:k)) < 32 .or. iachar(quote(k:k)) > 126) quote(k:k) = '?'
      if (quote(k:k) == '"') quote(k:k) = ''''
    end do
    quote(len(quote):) = '"'
  end function quoted

  !> Why text is not a number; `kind` as `read_number` returns it.
  pure function describe_text(string, kind) result(reason)
    character(len=*), intent(in) :: string
    integer, intent(in) :: kind
    character(len=len_trim(description(kind)) + quoted_length(string)) :: reason

    reason = quoted(string)//description(kind)
  end function describe_text

  !> Convert a number, which may have a decimal point and an exponent after d, D, e or E.
  !>
  !> `kind` is one of the KIND_ constants; `value` is 0 unless it is KIND_NUMBER. Numbers too
  !> small for a double are 0, numbers too large are KIND_NOT_FINITE.
  pure subroutine read_number(string, kind, value)
    character(len=*), intent(in) :: string
    integer, intent(out) :: kind
    real(dp), intent(out) :: value
    type(decimal) :: number
    logical :: certain

    value = 0.0_dp
    call read_decimal(string, number, kind)
    if (kind /= KIND_NUMBER) return
    if (overflows(number)) then
      kind = KIND_NOT_FINITE
      return
    end if
    certain = number%digits == 0_int64 .or. number%exponent + number%count < LEAST_PLACES
    if (.not. certain) call round_first_digits(number, value, certain)
    if (.not. certain) call round_all_digits(string, number%exponent + number%count, value)
    if (number%negative) value = -value
  end subroutine read_number

  !> Round a number by its first digits; not `certain` if they do not decide.
  pure subroutine round_first_digits(number, value, certain)
    type(decimal), intent(in) :: number
    real(dp), intent(out) :: value
    logical, intent(out) :: certain
    real(dp) :: upper

    call round_decimal(number%digits, number%exponent, value, certain)
    if (number%complete .or. .not. certain) return
    ! The others make it larger, by less than one in the last of these.
    call round_decimal(number%digits + 1_int64, number%exponent, upper, certain)
    certain = certain .and. .not. upper > value
  end subroutine round_first_digits

  !> Round a number with all its digits: 0.d1d2d3.. * 10**`places`, where d1 is the first digit that is not 0.
  !>
  !> C reads it as a whole number with an exponent, since in some locales the decimal point is a comma.
  pure subroutine round_all_digits(string, places, value)
    character(len=*), intent(in) :: string
    integer, intent(in) :: places
    real(dp), intent(out) :: value
    character(len=DECISIVE_DIGITS + EXPONENT_LENGTH) :: whole
    integer :: k, used

    used = 0
    do k = 1, len(string)
      if (string(k:k) == '.') cycle
      if (used == 0 .and. (string(k:k) == '+' .or. string(k:k) == '-' .or. string(k:k) == '0')) cycle
      if (string(k:k) < '0' .or. string(k:k) > '9') exit
      if (used < DECISIVE_DIGITS) then
        used = used + 1
        whole(used:used) = string(k:k)
      else if (string(k:k) /= '0') then
        ! No point half-way between two doubles has as many digits: the number is above it.
        whole(used:used) = '1'
      end if
    end do
    whole(used + 1:) = 'e'//text(places - used)//c_null_char
    value = strtod(whole, c_null_ptr)
  end subroutine round_all_digits

  !> Is the number larger than the largest double?
  pure function overflows(number) result(beyond)
    type(decimal), intent(in) :: number
    logical :: beyond
    integer :: places

    places = number%exponent + number%count
    if (number%digits == 0_int64) places = 0
    beyond = places > LARGEST_PLACES
    if (places == LARGEST_PLACES) beyond = number%digits*10_int64**(MOST_DIGITS - number%count) > LARGEST_DIGITS
  end function overflows

  !> Parse a number without rounding; `kind` as in `read_number`.
  pure subroutine read_decimal(string, number, kind)
    character(len=*), intent(in) :: string
    type(decimal), intent(out) :: number
    integer, intent(out) :: kind
    integer :: first, k, seen

    k = 1
    number%negative = code_at(string, 1) == MINUS
    if (number%negative .or. code_at(string, 1) == PLUS) k = 2
    seen = 0
    call read_digits(string, k, number, seen)
    if (code_at(string, k) == POINT) then
      first = k + 1
      k = first
      call read_digits(string, k, number, seen)
      number%exponent = number%exponent - (k - first)
    end if
    if (seen == 0) then
      kind = kind_of_word(string)
      return
    end if
    kind = KIND_NUMBER
    if (k > len(string)) return
    select case (string(k:k))
    case ('e', 'E', 'd', 'D')
      call read_exponent(string, k, number)
    case default
      kind = KIND_WRONG
    end select
    if (k <= len(string)) kind = KIND_WRONG
  end subroutine read_decimal

  !> Append the digits from position `k` on to the number; `seen` counts them, leading zeros
  !> included. On return `k` is the position after them.
  pure subroutine read_digits(string, k, number, seen)
    character(len=*), intent(in) :: string
    integer, intent(inout) :: k, seen
    type(decimal), intent(inout) :: number
    integer :: digit

    do while (k <= len(string))
      digit = iachar(string(k:k)) - iachar('0')
      if (digit < 0 .or. digit > 9) exit
      seen = seen + 1
      k = k + 1
      if (number%count == MOST_DIGITS) then
        ! The digit is dropped, but not its place.
        number%complete = .false.
        number%exponent = number%exponent + 1
      else if (digit > 0 .or. number%count > 0) then
        number%digits = 10_int64*number%digits + int(digit, int64)
        number%count = number%count + 1
      end if
    end do
  end subroutine read_digits

  !> Add the exponent whose letter is at position `k`; if no digits follow, `k` is unchanged.
  pure subroutine read_exponent(string, k, number)
    character(len=*), intent(in) :: string
    integer, intent(inout) :: k
    type(decimal), intent(inout) :: number
    integer :: digit, first, j, power
    logical :: negative

    first = k + 1
    negative = code_at(string, first) == MINUS
    if (negative .or. code_at(string, first) == PLUS) first = first + 1
    power = 0
    do j = first, len(string)
      digit = iachar(string(j:j)) - iachar('0')
      if (digit < 0 .or. digit > 9) exit
      power = min(10*power + digit, EXPONENT_LIMIT)
    end do
    if (j == first) return
    k = j
    number%exponent = number%exponent + merge(-power, power, negative)
  end subroutine read_exponent

  !> The code of the character at position `k`, that of a blank beyond the end.
  pure function code_at(string, k) result(code)
    character(len=*), intent(in) :: string
    integer, intent(in) :: k
    integer :: code

    code = BLANK
    if (k <= len(string)) code = iachar(string(k:k))
  end function code_at

  !> The character at position `k`, a blank beyond the end.
  pure function character_at(string, k) result(letter)
    character(len=*), intent(in) :: string
    integer, intent(in) :: k
    character :: letter

    letter = ' '
    if (k <= len(string)) letter = string(k:k)
  end function character_at

  !> Kind of a text without digits: NaN or infinity as usually written, a word, which begins with
  !> a letter or a quote, or something else.
  pure function kind_of_word(string) result(kind)
    character(len=*), intent(in) :: string
    integer :: kind
    character(len=8) :: word

    word = string
    if (scan(character_at(string, 1), '+-') > 0) word = string(2:)
    word = lower_case(word)
    if (word == 'inf' .or. word == 'infinity' .or. word == 'nan' .or. word(1:4) == 'nan(') then
      kind = KIND_NOT_FINITE
    else if (scan(character_at(string, 1), '0123456789+-.* ') > 0) then
      kind = KIND_WRONG
    else
      kind = KIND_WORD
    end if
  end function kind_of_word

  !> The string with its letters in lower case.
  pure function lower_case(string) result(lower)
    character(len=*), intent(in) :: string
    character(len=len(string)) :: lower
    integer :: k

    lower = string
    do k = 1, len(string)
      if (string(k:k) >= 'A' .and. string(k:k) <= 'Z') lower(k:k) = achar(iachar(string(k:k)) + 32)
    end do
  end function lower_case

  !> Convert a whole number: digits, optionally with a sign.
  !>
  !> `kind` is KIND_NUMBER, or another one with `value` 0. Numbers beyond 10**18 are reduced to
  !> it.
  pure subroutine read_whole(string, kind, value)
    character(len=*), intent(in) :: string
    integer, intent(out) :: kind
    integer(int64), intent(out) :: value
    type(decimal) :: number
    integer :: k, seen

    value = 0_int64
    k = 1
    if (scan(character_at(string, 1), '+-') > 0) k = 2
    seen = 0
    call read_digits(string, k, number, seen)
    kind = KIND_NUMBER
    if (seen == 0) then
      kind = kind_of_word(string)
    else if (k <= len(string)) then
      kind = KIND_WRONG
    end if
    if (kind /= KIND_NUMBER) return
    value = number%digits
    if (number%exponent > 0) value = 10_int64**MOST_DIGITS
    if (string(1:1) == '-') value = -value
  end subroutine read_whole

end module fuge_text_numbers
