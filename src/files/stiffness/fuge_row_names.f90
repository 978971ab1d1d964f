!> A file that names the rows of a matrix: a line node.direction for each row, as CalculiX writes it (.dof).
module fuge_row_names
  use fuge_entry_numbers, only: is_comment, read_label
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table, LARGEST_DIRECTION
  use fuge_status, only: fuge_info
  use fuge_stiffness_entries, only: no_memory
  use fuge_text_columns, only: line_columns, split_columns
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: read_row_names

contains

  !> Read the node and the direction of each row, from lines such as 17.3, or with a blank or a comma between them.
  !> Errors, `node` and `direction` unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_MEMORY.
  subroutine read_row_names(path, node, direction, info)
    character(len=*), intent(in) :: path
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    type(text_file) :: file
    type(row_table) :: names

    call file%load(path, info)
    if (.not. info%failed()) call read_names(file, names, info)
    if (info%failed()) return
    ! Copies, which end at the last row.
    node = names%node(:names%count)
    direction = names%direction(:names%count)
  end subroutine read_row_names

  pure subroutine read_names(file, names, info)
    type(text_file), intent(inout) :: file
    type(row_table), intent(inout) :: names
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer :: node, direction, number, rows, status
    logical :: exists

    do
      call file%advance(exists)
      if (.not. exists) exit
      if (is_comment(file%content(file%first:file%last))) cycle
      call read_name(file%content(file%first:file%last), node, direction, reason)
      rows = names%count
      if (.not. allocated(reason)) then
        call names%number_of(node, direction, number, status)
        if (status /= 0) then
          call no_memory(file, info)
          return
        end if
        if (number <= rows) reason = 'node '//text(node)//', direction '//text(direction)//' is the name of row ' &
          //text(number)//' already'
      end if
      if (.not. allocated(reason)) cycle
      call file%refuse(reason, info)
      return
    end do
    if (names%count == 0) &
      call file%refuse('the file names no row: a line like 17.3 (node.direction) is needed for each', info)
  end subroutine read_names

  !> Read node and direction from a line.
  pure subroutine read_name(line, node, direction, reason)
    character(len=*), intent(in) :: line
    integer, intent(out) :: node, direction
    character(len=:), allocatable, intent(out) :: reason
    type(line_columns) :: columns
    integer :: dot

    node = 0
    direction = 0
    call split_columns(line, columns)
    dot = index(line(columns%first(1):columns%last(1)), '.')
    if (columns%count == 1 .and. dot > 0) then
      dot = dot + columns%first(1) - 1
      call read_label(line(columns%first(1):dot - 1), 'node', -huge(1), huge(1), node, reason)
      call read_label(line(dot + 1:columns%last(1)), 'direction', 0, LARGEST_DIRECTION, direction, reason)
    else if (columns%count == 2) then
      call read_label(line(columns%first(1):columns%last(1)), 'node', -huge(1), huge(1), node, reason)
      call read_label(line(columns%first(2):columns%last(2)), 'direction', 0, LARGEST_DIRECTION, direction, reason)
    else
      reason = 'the node and the direction of one row are needed here, like 17.3'
    end if
  end subroutine read_name

end module fuge_row_names
