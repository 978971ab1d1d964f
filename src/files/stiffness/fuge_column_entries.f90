!> Files with one entry of a matrix on each line, in three or in five columns.
!>
!> Three, row, column and value: CalculiX (*FREQUENCY, SOLVER=MATRIXSTORAGE: one triangle, job.sti) and Abaqus
!> (*MATRIX OUTPUT, FORMAT=COORDINATE). Five, node, direction, node, direction and value: Abaqus
!> (FORMAT=MATRIX INPUT, which *MATRIX INPUT reads: the lower or the upper triangle, or both).
module fuge_column_entries
  use fuge_entry_numbers, only: is_comment, read_label, read_value
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_row_table, only: LARGEST_DIRECTION
  use fuge_status, only: fuge_info
  use fuge_stiffness_entries, only: no_memory, stiffness_entries
  use fuge_text_columns, only: line_columns, split_columns
  use fuge_text_numbers, only: lower_case, quoted
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: read_column_entries

contains

  !> Read all entries. The first one says how many columns there are; `entries%rows`, unless it is 0, is the number of
  !> rows that three columns may name.
  !> Errors: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  pure subroutine read_column_entries(file, entries, info)
    type(text_file), intent(inout) :: file
    type(stiffness_entries), intent(inout) :: entries
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer :: columns, status
    logical :: exists

    columns = 0
    status = 0
    do
      call file%advance(exists)
      if (.not. exists) exit
      call read_line(file%content(file%first:file%last), file%line, columns, entries, status, reason)
      if (status /= 0) call no_memory(file, info)
      if (allocated(reason)) call file%refuse(reason, info)
      if (info%failed()) return
    end do
  end subroutine read_column_entries

  !> Read the entry on line `number`, unless it has none.
  pure subroutine read_line(line, number, columns, entries, status, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    integer, intent(inout) :: columns, status
    type(stiffness_entries), intent(inout) :: entries
    character(len=:), allocatable, intent(out) :: reason
    type(line_columns) :: found

    if (is_comment(line)) return
    if (is_matrix_keyword(line)) return
    call split_columns(line, found)
    call check_columns(line, found%count, columns, reason)
    if (allocated(reason)) return
    if (columns == 3) then
      call read_numbered(line, found, number, entries, status, reason)
    else
      call read_named(line, found, number, entries, status, reason)
    end if
  end subroutine read_line

  !> Is the line a keyword of Abaqus that may stand above the entries, such as *MATRIX INPUT?
  pure function is_matrix_keyword(line) result(keyword)
    character(len=*), intent(in) :: line
    logical :: keyword
    character(len=7) :: word

    word = line
    keyword = lower_case(word) == '*matrix'
  end function is_matrix_keyword

  !> Refuse a line that has not as many columns as the first entry, whose number becomes `columns`.
  pure subroutine check_columns(line, found, columns, reason)
    character(len=*), intent(in) :: line
    integer, intent(in) :: found
    integer, intent(inout) :: columns
    character(len=:), allocatable, intent(out) :: reason

    if (found == columns) return
    if (columns == 0 .and. (found == 3 .or. found == 5)) then
      columns = found
    else if (line(1:1) == '*') then
      reason = quoted(line)//' is no entry of a matrix: give the file that *MATRIX OUTPUT writes'
    else if (columns == 0) then
      reason = 'an entry has 3 columns (row, column, value) or 5 (node, direction, node, direction, value), not ' &
        //trim(count_of(found))
    else
      reason = trim(count_of(found))//' column(s), but the first entry has '//text(columns)//': is the file cut off?'
    end if
  end subroutine check_columns

  pure function count_of(columns) result(words)
    integer, intent(in) :: columns
    character(len=12) :: words

    words = text(columns)
    if (columns > 5) words = '6 or more'
  end function count_of

  !> Read row, column and value.
  pure subroutine read_numbered(line, found, number, entries, status, reason)
    character(len=*), intent(in) :: line
    type(line_columns), intent(in) :: found
    integer, intent(in) :: number
    type(stiffness_entries), intent(inout) :: entries
    integer, intent(inout) :: status
    character(len=:), allocatable, intent(inout) :: reason
    integer :: row, column, most
    real(dp) :: value

    most = huge(1) - 1
    if (entries%rows > 0) most = entries%rows
    call read_label(line(found%first(1):found%last(1)), 'row', 1, most, row, reason)
    call read_label(line(found%first(2):found%last(2)), 'column', 1, most, column, reason)
    call read_value(line(found%first(3):found%last(3)), value, reason)
    if (.not. allocated(reason)) call entries%append(row, column, value, number, status)
  end subroutine read_numbered

  !> Read the names of row and column, and the value.
  pure subroutine read_named(line, found, number, entries, status, reason)
    character(len=*), intent(in) :: line
    type(line_columns), intent(in) :: found
    integer, intent(in) :: number
    type(stiffness_entries), intent(inout) :: entries
    integer, intent(inout) :: status
    character(len=:), allocatable, intent(inout) :: reason
    integer :: node(2), direction(2), number_of_name(2)
    integer :: k
    real(dp) :: value

    do k = 1, 2
      associate (first => found%first(2*k - 1:2*k), last => found%last(2*k - 1:2*k))
        ! Abaqus numbers its internal nodes below 0.
        call read_label(line(first(1):last(1)), 'node', -huge(1), huge(1), node(k), reason)
        call read_label(line(first(2):last(2)), 'direction', 0, LARGEST_DIRECTION, direction(k), reason)
      end associate
    end do
    call read_value(line(found%first(5):found%last(5)), value, reason)
    if (allocated(reason)) return
    do k = 1, 2
      if (status == 0) call entries%names%number_of(node(k), direction(k), number_of_name(k), status)
    end do
    if (status == 0) call entries%append(number_of_name(1), number_of_name(2), value, number, status)
  end subroutine read_named

end module fuge_column_entries
