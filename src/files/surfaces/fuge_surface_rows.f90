!> Lines of a text file with the same number of columns, from which heights are read.
module fuge_surface_rows
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info
  use fuge_surface_heights, only: read_height, NOT_MEASURED
  use fuge_text_columns, only: begin_columns, next_column, separator_name, SEPARATOR_BLANK, SEPARATOR_NONE
  use fuge_text_numbers, only: read_number, KIND_WORD
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: advance_to_row, count_rows, find_first_row, read_row, refuse_unmeasured

  !> The form of all rows, taken from the first one.
  type, public :: row_form
    integer :: columns = 0
    !> What stands between the columns.
    integer :: separator = SEPARATOR_NONE
  end type row_form

  !> Where a row is.
  type :: row_position
    type(row_form) :: form
    integer :: line = 0
    integer(int64) :: first = 1_int64
    integer(int64) :: last = -1_int64
  end type row_position

contains

  !> Begin the file again and advance to its first row, of which `form` is the form.
  !>
  !> Before it blank lines, comments, and lines of words are skipped: those without a number, and those that begin with
  !> a word and have fewer columns than the first row. A line with as many columns may be a damaged row, so it is taken
  !> for the first one, and refused when it is read.
  !> Error: FUGE_ERR_FILE without a row, or if a line is too long.
  pure subroutine find_first_row(file, form, info)
    type(text_file), intent(inout) :: file
    type(row_form), intent(out) :: form
    type(fuge_info), intent(inout) :: info
    type(row_position) :: doubtful
    logical :: exists, words, begins_with_word

    call file%rewind()
    do
      call advance_to_row(file, exists, info)
      if (info%failed()) return
      if (.not. exists) exit
      call find_form(file%content(file%first:file%last), form, words, begins_with_word)
      if (words) cycle
      if (.not. begins_with_word) exit
      if (form%columns > doubtful%form%columns) doubtful = row_position(form, file%line, file%first, file%last)
    end do
    if (doubtful%form%columns > 0 .and. (.not. exists .or. doubtful%form%columns >= form%columns)) then
      form = doubtful%form
      file%line = doubtful%line
      file%first = doubtful%first
      file%last = doubtful%last
    else if (.not. exists) then
      call file%refuse('the file has no row of numbers', info)
    end if
  end subroutine find_first_row

  !> Advance to the next line that is not blank or a comment; `exists` is false at the end of the file.
  pure subroutine advance_to_row(file, exists, info)
    type(text_file), intent(inout) :: file
    logical, intent(out) :: exists
    type(fuge_info), intent(inout) :: info

    do
      call file%advance(exists)
      if (.not. exists) return
      if (file%last - file%first >= huge(1) - 2) then
        call file%refuse('the line is too long', info)
        return
      end if
      if (begin_columns(file%content(file%first:file%last)) <= file%last - file%first + 1_int64) return
    end do
  end subroutine advance_to_row

  !> Number of rows from the first one on.
  pure subroutine count_rows(file, rows, info)
    type(text_file), intent(inout) :: file
    integer, intent(out) :: rows
    type(fuge_info), intent(inout) :: info
    type(row_form) :: form
    logical :: exists

    rows = 0
    call find_first_row(file, form, info)
    exists = .true.
    do while (exists .and. .not. info%failed())
      rows = rows + 1
      call advance_to_row(file, exists, info)
    end do
  end subroutine count_rows

  !> The form of a row; `words`: none of its columns is a number or a height that was not measured; `begins_with_word`:
  !> the first one is neither.
  pure subroutine find_form(line, form, words, begins_with_word)
    character(len=*), intent(in) :: line
    type(row_form), intent(out) :: form
    logical, intent(out) :: words, begins_with_word
    character(len=:), allocatable :: reason
    real(dp) :: value
    integer :: k, first, last, separator, kind

    words = .true.
    begins_with_word = .false.
    k = begin_columns(line)
    do while (k <= len(line))
      call next_column(line, k, first, last, separator)
      form%columns = form%columns + 1
      if (form%columns == 1) form%separator = separator
      call read_number(line(first:last), kind, value)
      words = words .and. kind == KIND_WORD
      if (words) call read_height(line(first:last), value, reason)
      words = words .and. allocated(reason)
      if (allocated(reason)) deallocate (reason)
      if (form%columns == 1) begins_with_word = words
    end do
  end subroutine find_form

  !> Read a row of the given form, `values` (form%columns); `reason` is allocated if that fails.
  !>
  !> `unmeasured` is the first column whose value is NOT_MEASURED, 0 if there is none.
  pure subroutine read_row(line, form, values, unmeasured, reason)
    character(len=*), intent(in) :: line
    type(row_form), intent(in) :: form
    real(dp), intent(inout) :: values(:)
    integer, intent(out) :: unmeasured
    character(len=:), allocatable, intent(inout) :: reason
    integer :: k, first, last, separator, column

    unmeasured = 0
    column = 0
    separator = SEPARATOR_NONE
    k = begin_columns(line)
    do while (k <= len(line))
      call next_column(line, k, first, last, separator)
      column = column + 1
      if (column > form%columns) cycle
      call read_height(line(first:last), values(column), reason)
      if (separator /= form%separator .and. separator /= SEPARATOR_NONE) then
        call explain_separators(form, separator, reason)
      end if
      if (allocated(reason)) return
      if (unmeasured == 0 .and. .not. values(column) < NOT_MEASURED) unmeasured = column
    end do
    if (column == form%columns - 1 .and. separator > SEPARATOR_BLANK) then
      ! Nothing after the last separator.
      column = form%columns
      values(column) = NOT_MEASURED
      if (unmeasured == 0) unmeasured = column
    end if
    if (column /= form%columns) reason = text(column)//' value(s), but the first row has '//text(form%columns)
  end subroutine read_row

  !> Say why a row with two kinds of separators is refused: the commas may be decimal ones.
  pure subroutine explain_separators(form, separator, reason)
    type(row_form), intent(in) :: form
    integer, intent(in) :: separator
    character(len=:), allocatable, intent(inout) :: reason

    if (form%columns == 1) return
    reason = 'columns are separated by '//trim(separator_name(form%separator))//' and by ' &
             //trim(separator_name(separator))//': numbers need a decimal point, not a comma'
  end subroutine explain_separators

  !> Refuse a row because of a point that was not measured (FUGE_ERR_FILE).
  pure subroutine refuse_unmeasured(file, column, info)
    type(text_file), intent(in) :: file
    integer, intent(in) :: column
    type(fuge_info), intent(inout) :: info

    call file%refuse('column '//text(column)//' has no height, the point was not measured: let such points be filled', &
                     info)
  end subroutine refuse_unmeasured

end module fuge_surface_rows
