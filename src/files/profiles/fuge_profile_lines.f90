!> One line of a profile file: two numbers, a comment or a header.
module fuge_profile_lines
  use fuge_kinds, only: dp
  use fuge_text_columns, only: begin_columns, next_column
  use fuge_text_fields, only: describe_field, read_number, FIELD_NUMBER, FIELD_WORD
  implicit none
  private

  public :: read_point

  !> Kinds of lines.
  integer, parameter, public :: LINE_EMPTY = 0
  integer, parameter, public :: LINE_POINT = 1
  integer, parameter, public :: LINE_WORDS = 2
  integer, parameter, public :: LINE_WRONG = 3

contains

  !> Read two numbers from a line, separated by blanks, tabs, a comma or a semicolon.
  !>
  !> `kind` is LINE_POINT with `x` and `z`, LINE_EMPTY (blank, or a comment that begins
  !> with # or !), LINE_WORDS (both fields are words, as in a header) or LINE_WRONG; `reason`
  !> is allocated for the last two. A comment may follow the numbers.
  pure subroutine read_point(line, kind, x, z, reason)
    character(len=*), intent(in) :: line
    integer, intent(out) :: kind
    real(dp), intent(out) :: x, z
    character(len=:), allocatable, intent(out) :: reason
    integer :: first(2), last(2), fields, of_x, of_z

    x = 0.0_dp
    z = 0.0_dp
    kind = LINE_EMPTY
    call find_columns(line, first, last, fields)
    if (fields == 0) return
    call read_number(line(first(1):last(1)), of_x, x)
    of_z = of_x
    if (fields > 1) call read_number(line(first(2):last(2)), of_z, z)
    if (of_x == FIELD_NUMBER .and. of_z == FIELD_NUMBER .and. fields == 2) then
      kind = LINE_POINT
    else if (of_x == FIELD_WORD .and. of_z == FIELD_WORD) then
      kind = LINE_WORDS
      call explain_column(line(first(1):last(1)), of_x, reason)
    else
      kind = LINE_WRONG
      if (of_x /= FIELD_NUMBER) then
        call explain_column(line(first(1):last(1)), of_x, reason)
      else if (fields == 1) then
        reason = 'only one column: x and z are needed'
      else if (of_z /= FIELD_NUMBER) then
        call explain_column(line(first(2):last(2)), of_z, reason)
      else
        reason = 'more than two columns: x and z are needed, with a decimal point and not a comma'
      end if
    end if
  end subroutine read_point

  !> The first two fields, line(first(k):last(k)); `fields` is 3 if there are more.
  pure subroutine find_columns(line, first, last, fields)
    character(len=*), intent(in) :: line
    integer, intent(out) :: first(2), last(2), fields
    integer :: from, k, separator, to

    first = 1
    last = 0
    fields = 0
    k = begin_columns(line)
    do while (k <= len(line))
      call next_column(line, k, from, to, separator)
      fields = fields + 1
      if (fields > 2) exit
      first(fields) = from
      last(fields) = to
    end do
  end subroutine find_columns

  !> Why a column is not a number; `kind` as `read_number` returns it.
  pure subroutine explain_column(field, kind, reason)
    character(len=*), intent(in) :: field
    integer, intent(in) :: kind
    character(len=:), allocatable, intent(out) :: reason

    if (len(field) == 0) then
      reason = 'an empty column: x and z are needed'
    else
      reason = describe_field(field, kind)
    end if
  end subroutine explain_column

end module fuge_profile_lines
