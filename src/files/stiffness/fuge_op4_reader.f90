!> A matrix of a formatted file of Nastran's module OUTPUT4.
!>
!> Records: the header, NCOL NR FORM TYPE NAME FORMAT (4I8, 2A4, and the format of the values); for each column that
!> is not zero ICOL IROW NW (3I8); after the last one column NCOL + 1, with one value. A dense column has IROW > 0 and
!> the values from row IROW on. A sparse one has IROW = 0 and strings: the header IS = IROW + 65536 (L + 1), or L + 1
!> and IROW if NR is negative (BIGMAT), and the values from row IROW on. L and NW count words, of which a value has two
!> in double precision, TYPE = 2. The values end where a line without a decimal point begins, and their number is held
!> against L or NW, which some programs give in values.
module fuge_op4_reader
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE
  use fuge_stiffness_entries, only: no_memory, stiffness_entries
  use fuge_text_columns, only: line_columns, split_columns
  use fuge_text_numbers, only: lower_case, quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: is_op4_header, read_op4

  !> Width of a value if the header does not say.
  integer, parameter :: USUAL_WIDTH = 16
  integer, parameter :: HEADER_LENGTH = 32

  !> The matrix that is read, and where in it the reader is.
  type :: op4_state
    character(len=8) :: name = ''
    integer :: rows = 0, columns = 0
    !> Words of a value, and its width in characters.
    integer :: words = 1, width = USUAL_WIDTH
    !> It is the matrix of the caller, so that its entries are kept.
    logical :: kept = .false.
    !> Column and row of the next value.
    integer :: column = 0, row = 0
    !> Announced words and values read of the present string or dense column.
    integer :: announced = 0, found = 0
    logical :: ended = .false.
    integer :: status = 0
  end type op4_state

contains

  !> Does the line begin with four whole numbers of eight columns, and a name?
  pure function is_op4_header(line) result(header)
    character(len=*), intent(in) :: line
    logical :: header
    character(len=:), allocatable :: reason
    integer :: k, number

    header = len_trim(line) > HEADER_LENGTH
    if (.not. header) return
    do k = 1, 4
      call read_fixed(line, k, number, reason)
    end do
    header = .not. allocated(reason) .and. verify(lower_case(line(HEADER_LENGTH + 1:HEADER_LENGTH + 1)), &
                                                  'abcdefghijklmnopqrstuvwxyz') == 0
  end function is_op4_header

  !> The whole number in the k-th eight characters of a line.
  pure subroutine read_fixed(line, k, number, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: k
    integer, intent(out) :: number
    character(len=:), allocatable, intent(inout) :: reason

    character(len=8) :: string

    string = adjustl(line(8*k - 7:8*k))
    call read_label(trim(string), 'number', -huge(1), huge(1), number, reason)
  end subroutine read_fixed

  !> Read all entries of the matrix called `name`, or of the only one if it is blank. Zeros are left out.
  !> Errors: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  pure subroutine read_op4(file, name, entries, info)
    type(text_file), intent(inout) :: file
    character(len=*), intent(in) :: name
    type(stiffness_entries), intent(inout) :: entries
    type(fuge_info), intent(inout) :: info
    type(op4_state) :: state
    character(len=:), allocatable :: reason
    character(len=8) :: seen
    logical :: exists, found

    found = .false.
    seen = ''
    do
      call next_line(file, exists)
      if (.not. exists) exit
      call read_header(file%content(file%first:file%last), state, reason)
      if (allocated(reason)) exit
      if (found .and. len_trim(name) > 0) return
      if (found) reason = 'the file holds the matrices '//quoted(trim(seen))//' and '//quoted(trim(state%name)) &
        //': pass the name of the one to read'
      state%kept = len_trim(name) == 0 .or. lower_case(state%name) == lower_case(name)
      found = found .or. state%kept
      seen = state%name
      if (state%kept .and. .not. allocated(reason)) call check_form(state, entries, reason)
      if (allocated(reason)) exit
      call read_columns(file, state, entries, info)
      if (info%failed()) return
    end do
    if (allocated(reason)) then
      call file%refuse(reason, info)
    else if (.not. found) then
      if (seen == '') then
        call report(info, FUGE_ERR_FILE, file%name//' has no matrix')
      else
        call report(info, FUGE_ERR_FILE, file%name//' has no matrix '//quoted(name)//', but '//quoted(trim(seen)))
      end if
    end if
  end subroutine read_op4

  !> Advance to the next line that is not blank.
  pure subroutine next_line(file, exists)
    type(text_file), intent(inout) :: file
    logical, intent(out) :: exists

    do
      call file%advance(exists)
      if (.not. exists) return
      if (verify(file%content(file%first:file%last), ' '//achar(9)//achar(13)) > 0) return
    end do
  end subroutine next_line

  pure subroutine read_header(line, state, reason)
    character(len=*), intent(in) :: line
    type(op4_state), intent(inout) :: state
    character(len=:), allocatable, intent(out) :: reason
    integer :: number_type
    type(op4_state) :: fresh

    if (.not. is_op4_header(line)) then
      reason = 'the header of a matrix is needed here: columns, rows, form, type (4I8) and name'
      return
    end if
    state = fresh
    call read_fixed(line, 1, state%columns, reason)
    call read_fixed(line, 2, state%rows, reason)
    call read_fixed(line, 4, number_type, reason)
    state%rows = abs(state%rows)
    state%name = line(HEADER_LENGTH + 1:min(len(line), HEADER_LENGTH + 8))
    if (scan(state%name, achar(13)) > 0) state%name(scan(state%name, achar(13)):) = ''
    if (number_type == 2 .or. number_type == 4) state%words = 2
    if (number_type < 1 .or. number_type > 2) state%words = -state%words
    if (len(line) > HEADER_LENGTH + 8) call read_width(line(HEADER_LENGTH + 9:), state%width)
  end subroutine read_header

  !> The width in a format such as 1P,3E23.16; unchanged if there is none.
  pure subroutine read_width(format, width)
    character(len=*), intent(in) :: format
    integer, intent(inout) :: width
    character(len=:), allocatable :: reason
    integer :: first, length, found

    first = scan(format, 'EeDdGg') + 1
    if (first == 1) return
    length = verify(format(first:)//' ', '0123456789') - 1
    call read_label(format(first:first + length - 1), 'width', 8, 64, found, reason)
    if (.not. allocated(reason)) width = found
  end subroutine read_width

  !> Refuse a matrix that is complex or not square, or of another size than its names say.
  pure subroutine check_form(state, entries, reason)
    type(op4_state), intent(in) :: state
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(inout) :: reason

    if (state%words < 0) then
      reason = 'the matrix '//quoted(trim(state%name))//' is not real: a stiffness matrix has the type 1 or 2'
    else if (state%columns < 1 .or. state%rows /= state%columns) then
      reason = 'the matrix '//quoted(trim(state%name))//' is '//text(state%rows)//' x '//text(state%columns) &
        //': a stiffness matrix is square'
    else if (entries%rows > 0 .and. entries%rows /= state%columns) then
      reason = 'the matrix '//quoted(trim(state%name))//' has '//text(state%columns)//' rows, but ' &
        //text(entries%rows)//' are named'
    end if
    entries%rows = state%columns
  end subroutine check_form

  !> Read the columns of a matrix, up to and with the column after the last one.
  pure subroutine read_columns(file, state, entries, info)
    type(text_file), intent(inout) :: file
    type(op4_state), intent(inout) :: state
    type(stiffness_entries), intent(inout) :: entries
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    logical :: exists

    do
      call next_line(file, exists)
      if (.not. exists) then
        if (state%ended) return
        call file%refuse('the file ends in or before column '//text(min(state%column + 1, state%columns))//' of ' &
                         //text(state%columns)//', and without the column after the last one: is it cut off?', info)
        return
      end if
      if (index(file%content(file%first:file%last), '.') > 0) then
        call read_values(file%content(file%first:file%last), file%line, state, entries, reason)
        if (state%ended .and. .not. allocated(reason)) return
      else
        call end_run(state, reason)
        if (.not. allocated(reason)) call begin_run(file%content(file%first:file%last), state, reason)
      end if
      if (allocated(reason)) call file%refuse(reason, info)
      if (state%status /= 0) call no_memory(file, info)
      if (info%failed()) return
    end do
  end subroutine read_columns

  !> Has the string, or the dense column, as many values as announced?
  pure subroutine end_run(state, reason)
    type(op4_state), intent(in) :: state
    character(len=:), allocatable, intent(out) :: reason

    if (state%found == state%announced .or. state%found*abs(state%words) == state%announced) return
    reason = 'column '//text(state%column)//' has '//text(state%found)//' values above this line, but ' &
      //text(state%announced)//' words of '//text(abs(state%words))//' for each value are announced'
  end subroutine end_run

  !> The header of a column, three numbers, or of a string, one or two.
  pure subroutine begin_run(line, state, reason)
    character(len=*), intent(in) :: line
    type(op4_state), intent(inout) :: state
    character(len=:), allocatable, intent(inout) :: reason
    type(line_columns) :: found
    integer :: k, number(3)

    call split_columns(line, found)
    if (found%count < 1 .or. found%count > 3) then
      reason = 'values with a decimal point, or the header of a column or of a string are needed here'
      return
    end if
    number = 0
    do k = 1, found%count
      call read_label(line(found%first(k):found%last(k)), 'number', 0, huge(1), number(k), reason)
    end do
    if (allocated(reason)) return
    state%found = 0
    select case (found%count)
    case (1)
      state%announced = max(number(1)/65536 - 1, 0)
      state%row = modulo(number(1), 65536)
    case (2)
      state%announced = max(number(1) - 1, 0)
      state%row = number(2)
    case (3)
      call begin_column(number, state, reason)
      return
    end select
    if (state%column == 0) then
      reason = 'a string before the first column'
    else if (state%row < 1 .or. state%row > state%rows) then
      reason = 'row '//text(state%row)//' is outside 1 .. '//text(state%rows)
    end if
  end subroutine begin_run

  !> Column, first row or 0, and number of words.
  pure subroutine begin_column(number, state, reason)
    integer, intent(in) :: number(3)
    type(op4_state), intent(inout) :: state
    character(len=:), allocatable, intent(inout) :: reason

    if (number(1) <= state%column .or. number(1) > state%columns + 1) then
      reason = 'column '//text(number(1))//' after column '//text(state%column)//': columns ascend, up to ' &
        //text(state%columns + 1)//' after the last one'
      return
    end if
    state%column = number(1)
    state%row = number(2)
    state%announced = merge(number(3), 0, state%row > 0)
    state%ended = state%column == state%columns + 1
    if (state%row > state%rows) reason = 'row '//text(state%row)//' is outside 1 .. '//text(state%rows)
  end subroutine begin_column

  !> The values of a line, each of the width that the header gives.
  pure subroutine read_values(line, number, state, entries, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    type(op4_state), intent(inout) :: state
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(out) :: reason
    integer :: begin, finish, last
    real(dp) :: value

    if (state%ended) return
    if (state%column == 0 .or. state%row == 0) then
      reason = 'values before the header of their column or string'
      return
    end if
    last = len_trim(line)
    if (line(last:last) == achar(13)) last = last - 1
    do begin = 1, last, state%width
      finish = min(begin + state%width - 1, last)
      call read_padded(line(begin:finish), value, reason)
      if (.not. allocated(reason) .and. state%kept .and. state%row > state%rows) &
        reason = 'row '//text(state%row)//' is outside 1 .. '//text(state%rows)
      if (allocated(reason)) return
      if (state%kept .and. abs(value) > 0.0_dp) &
        call entries%append(state%row, state%column, value, number, state%status)
      if (state%status /= 0) return
      state%row = state%row + 1
      state%found = state%found + 1
    end do
  end subroutine read_values

  !> A value with blanks before or after it.
  pure subroutine read_padded(string, value, reason)
    character(len=*), intent(in) :: string
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    integer :: first

    first = max(verify(string, ' '), 1)
    call read_value(string(first:len_trim(string)), value, reason)
  end subroutine read_padded

end module fuge_op4_reader
