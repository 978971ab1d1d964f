!> One line of a profile file: two numbers, a comment or a header.
module fuge_profile_lines
  use fuge_kinds, only: dp
  use fuge_text_columns, only: line_columns, split_columns
  use fuge_text_numbers, only: describe_text, read_number, KIND_NUMBER, KIND_WORD
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
  !> with # or !), LINE_WORDS (both columns are words, as in a header) or LINE_WRONG; `reason`
  !> is allocated for the last two. A comment may follow the numbers.
  pure subroutine read_point(line, kind, x, z, reason)
    character(len=*), intent(in) :: line
    integer, intent(out) :: kind
    real(dp), intent(out) :: x, z
    character(len=:), allocatable, intent(out) :: reason
    type(line_columns) :: columns
    integer :: of_x, of_z

    x = 0.0_dp
    z = 0.0_dp
    kind = LINE_EMPTY
    call split_columns(line, columns)
    if (columns%count == 0) return
    call read_number(line(columns%first(1):columns%last(1)), of_x, x)
    of_z = of_x
    if (columns%count > 1) call read_number(line(columns%first(2):columns%last(2)), of_z, z)
    if (of_x == KIND_NUMBER .and. of_z == KIND_NUMBER .and. columns%count == 2) then
      kind = LINE_POINT
    else if (of_x == KIND_WORD .and. of_z == KIND_WORD) then
      kind = LINE_WORDS
      call explain_column(line(columns%first(1):columns%last(1)), of_x, reason)
    else
      kind = LINE_WRONG
      if (of_x /= KIND_NUMBER) then
        call explain_column(line(columns%first(1):columns%last(1)), of_x, reason)
      else if (columns%count == 1) then
        reason = 'only one column: x and z are needed'
      else if (of_z /= KIND_NUMBER) then
        call explain_column(line(columns%first(2):columns%last(2)), of_z, reason)
      else
        reason = 'more than two columns: x and z are needed, with a decimal point and not a comma'
      end if
    end if
  end subroutine read_point

  !> Why a column is not a number; `kind` as `read_number` returns it.
  pure subroutine explain_column(string, kind, reason)
    character(len=*), intent(in) :: string
    integer, intent(in) :: kind
    character(len=:), allocatable, intent(out) :: reason

    if (len(string) == 0) then
      reason = 'an empty column: x and z are needed'
    else
      reason = describe_text(string, kind)
    end if
  end subroutine explain_column

end module fuge_profile_lines
