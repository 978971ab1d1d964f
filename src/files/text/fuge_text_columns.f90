!> The columns of a line of text: what stands between blanks and tabs, or between blanks, tabs, commas and semicolons up
!> to a comment.
module fuge_text_columns
  implicit none
  private

  public :: after_blanks, begin_columns, find_column, next_column, next_name, separator_name, split_columns

  !> What follows a column.
  integer, parameter, public :: SEPARATOR_NONE = 0
  integer, parameter, public :: SEPARATOR_BLANK = 1
  integer, parameter, public :: SEPARATOR_COMMA = 2
  integer, parameter, public :: SEPARATOR_SEMICOLON = 3

  !> Kinds of characters; # and ! begin a comment.
  integer, parameter :: OTHER = 0, BLANK = 1, COMMA = 2, SEMICOLON = 3, COMMENT = 4

  !> Columns of a line that are looked at.
  integer, parameter :: MOST_COLUMNS = 6

  !> Where the columns are: column k is line(first(k):last(k)). `count` is MOST_COLUMNS if there are as many or more.
  type, public :: line_columns
    integer :: count = 0
    integer :: first(MOST_COLUMNS) = 1
    integer :: last(MOST_COLUMNS) = 0
  end type line_columns

contains

  !> Kind of a character.
  pure function kind_of(letter) result(letter_kind)
    character, intent(in) :: letter
    integer :: letter_kind

    ! By number: gfortran compares characters with a blank by a call of its library.
    select case (iachar(letter))
    case (9, 13, 32)
      letter_kind = BLANK
    case (iachar(','))
      letter_kind = COMMA
    case (iachar(';'))
      letter_kind = SEMICOLON
    case (iachar('#'), iachar('!'))
      letter_kind = COMMENT
    case default
      letter_kind = OTHER
    end select
  end function kind_of

  !> The first column between blanks from position `from` on: line(first:last), or last < first if there is none.
  pure subroutine find_column(line, from, first, last)
    character(len=*), intent(in) :: line
    integer, intent(in) :: from
    integer, intent(out) :: first, last

    first = after_blanks(line, from)
    last = first - 1
    do while (last < len(line))
      if (is_blank(line(last + 1:last + 1))) exit
      last = last + 1
    end do
  end subroutine find_column

  !> Position of the first character from `from` on that is not blank; len(line) + 1 if all are.
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

  !> Is the character a blank, a tab, or the carriage return of a Windows line end?
  pure function is_blank(letter)
    character, intent(in) :: letter
    logical :: is_blank

    is_blank = kind_of(letter) == BLANK
  end function is_blank

  !> Position of the first column of a line, len(line) + 1 if it has none: it is blank or a comment.
  pure function begin_columns(line) result(k)
    character(len=*), intent(in) :: line
    integer :: k

    k = next_text(line, 1)
  end function begin_columns

  !> The column that begins at position `k`, line(first:last), which is empty if a separator stands there.
  !>
  !> On return `separator` is what follows it, SEPARATOR_NONE at the end of the line or before a comment, and `k` the
  !> position of the next column, or len(line) + 1. After a comma or a semicolon there may be none.
  pure subroutine next_column(line, k, first, last, separator)
    character(len=*), intent(in) :: line
    integer, intent(inout) :: k
    integer, intent(out) :: first, last, separator
    integer :: letter_kind

    first = k
    letter_kind = OTHER
    do while (k <= len(line))
      letter_kind = kind_of(line(k:k))
      if (letter_kind /= OTHER .and. letter_kind /= COMMENT) exit
      k = k + 1
    end do
    last = k - 1
    k = next_text(line, k)
    separator = SEPARATOR_NONE
    if (k > len(line)) return
    separator = SEPARATOR_BLANK
    letter_kind = kind_of(line(k:k))
    if (letter_kind /= COMMA .and. letter_kind /= SEMICOLON) return
    separator = merge(SEPARATOR_COMMA, SEPARATOR_SEMICOLON, letter_kind == COMMA)
    k = next_text(line, k + 1)
  end subroutine next_column

  !> The next column as of `next_column`, but one between double quotes goes on to the second, with all between them.
  pure subroutine next_name(line, k, first, last, separator)
    character(len=*), intent(in) :: line
    integer, intent(inout) :: k
    integer, intent(out) :: first, last, separator
    integer :: begin, quote

    begin = k
    quote = 0
    if (k < len(line)) then
      if (line(k:k) == '"') quote = index(line(k + 1:), '"')
    end if
    k = k + quote
    call next_column(line, k, first, last, separator)
    first = begin
  end subroutine next_name

  !> Find the columns of a line, as `next_column` does.
  pure subroutine split_columns(line, columns)
    character(len=*), intent(in) :: line
    type(line_columns), intent(out) :: columns
    integer :: k, separator

    k = begin_columns(line)
    do while (k <= len(line) .and. columns%count < MOST_COLUMNS)
      columns%count = columns%count + 1
      call next_column(line, k, columns%first(columns%count), columns%last(columns%count), separator)
    end do
  end subroutine split_columns

  !> Position of the first character from `from` on that is neither blank nor in a comment; len(line) + 1 if there is
  !> none.
  pure function next_text(line, from) result(k)
    character(len=*), intent(in) :: line
    integer, intent(in) :: from
    integer :: k
    integer :: letter_kind

    do k = from, len(line)
      letter_kind = kind_of(line(k:k))
      if (letter_kind == BLANK) cycle
      if (letter_kind == COMMENT) exit
      return
    end do
    k = len(line) + 1
  end function next_text

  !> What stands between columns, for a message.
  pure function separator_name(separator) result(name)
    integer, intent(in) :: separator
    character(len=10) :: name

    name = 'blanks'
    if (separator == SEPARATOR_COMMA) name = 'commas'
    if (separator == SEPARATOR_SEMICOLON) name = 'semicolons'
  end function separator_name

end module fuge_text_columns
