!> Matrix Market files: read a matrix into a dense array or into compressed columns.
!>
!> Real and integer matrices in coordinate or array format, general or symmetric. A symmetric
!> file holds the lower triangle; the matrix returned has both. The format does not say what
!> repeated entries of a coordinate file mean; they are added, like contributions of finite
!> elements. Comments and blank lines may follow anywhere after the first line; each entry has a
!> line of its own.
module fuge_matrix_market_reader
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_compressed_columns, only: compress_columns, compressed_columns, matrix_triplets, sum_overflows
  use fuge_kinds, only: dp
  use fuge_matrix_market_lines, only: is_skipped, matrix_layout, read_banner, read_entry, read_sizes, read_value
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_matrix, fuge_read_sparse

  !> Least number of bytes of an entry, its line feed included.
  integer(int64), parameter :: SHORTEST_ENTRY = 6_int64, SHORTEST_VALUE = 2_int64

  !> With up to this many columns, or positions of a dense matrix, a file is read however few entries it has.
  integer(int64), parameter :: EMPTY_ROOM = 10000000_int64

  !> A Matrix Market file that is read entry by entry.
  type :: matrix_file
    type(text_file) :: file
    type(matrix_layout) :: layout
    !> Number of entries read.
    integer(int64) :: count = 0_int64
    !> The last entry read.
    integer :: row = 0
    integer :: column = 1
    real(dp) :: value = 0.0_dp
  end type matrix_file

contains

  !> Read a matrix from a Matrix Market file into a dense array.
  !>
  !> `matrix` (rows, columns) is allocated afresh, with zeros where a coordinate file has no
  !> entry, in the unit of the file.
  !> Errors, `matrix` unchanged: FUGE_ERR_FILE with file, line and reason, also for 10^7 positions and more of which
  !> most rows or columns have no entry; FUGE_ERR_MEMORY.
  subroutine fuge_read_matrix(path, matrix, info)
    character(len=*), intent(in) :: path
    real(dp), allocatable, intent(inout) :: matrix(:, :)
    type(fuge_info), intent(out) :: info
    type(matrix_file) :: source
    real(dp), allocatable :: entries(:, :)
    integer :: status

    call open_matrix(path, source, info)
    if (.not. info%failed()) call check_room(source, real(source%layout%rows, dp)*real(source%layout%columns, dp), &
                                             real(source%layout%entries, dp)**2, info)
    if (info%failed()) return
    allocate (entries(source%layout%rows, source%layout%columns), stat=status)
    if (status /= 0) then
      call report(info, FUGE_ERR_MEMORY, source%file%name//': no memory for a dense matrix of ' &
                  //text(source%layout%rows)//' x '//text(source%layout%columns)//': read it with fuge_read_sparse')
      return
    end if
    call read_dense(source, entries, info)
    if (.not. info%failed()) call move_alloc(entries, matrix)
  end subroutine fuge_read_matrix

  !> Read a matrix from a Matrix Market file into compressed columns.
  !>
  !> Column j has the rows `row`(k) and the values `value`(k), k = `column`(j) ..
  !> `column`(j + 1) - 1, rows ascending, each once; `column` has one element more than the
  !> matrix has columns. Zeros of an array file are left out, those of a coordinate file kept.
  !> The three arrays are allocated afresh.
  !> Errors, outputs unchanged: FUGE_ERR_FILE with file, line and reason, also for more than 10^7 rows or columns with
  !> entries for less than a tenth of them; FUGE_ERR_MEMORY.
  subroutine fuge_read_sparse(path, rows, column, row, value, info)
    character(len=*), intent(in) :: path
    integer, intent(inout) :: rows
    integer, allocatable, intent(inout) :: column(:), row(:)
    real(dp), allocatable, intent(inout) :: value(:)
    type(fuge_info), intent(out) :: info
    type(matrix_file) :: source
    type(matrix_triplets) :: triplets
    type(compressed_columns) :: matrix
    integer :: overflow, status

    call open_matrix(path, source, info)
    if (.not. info%failed()) call check_room(source, real(max(source%layout%rows, source%layout%columns), dp), &
                                             10.0_dp*real(source%layout%entries, dp), info)
    if (info%failed()) return
    call triplets%reserve(entries_of_both_triangles(source%layout), status)
    if (status == 0) then
      call read_triplets(source, triplets, info)
      if (info%failed()) return
      deallocate (source%file%content)
      call compress_columns(triplets, source%layout%rows, source%layout%columns, matrix, overflow, status)
    end if
    if (status /= 0) then
      call report(info, FUGE_ERR_MEMORY, source%file%name//': no memory for the entries of a matrix of ' &
                  //text(source%layout%rows)//' x '//text(source%layout%columns))
    else if (overflow > 0) then
      call report(info, FUGE_ERR_FILE, source%file%name//': '//overflow_reason(matrix%row(overflow), &
                                                                               count(matrix%column <= overflow)))
    end if
    if (info%failed()) return
    rows = source%layout%rows
    call move_alloc(matrix%column, column)
    call move_alloc(matrix%row, row)
    call move_alloc(matrix%value, value)
  end subroutine fuge_read_sparse

  pure function reason_length(row, column) result(length)
    integer, intent(in) :: row, column
    integer :: length

    length = len('the sum of the entries for (, ) is out of range') + len(text(row)) + len(text(column))
  end function reason_length

  !> Why entries of the same position are refused.
  pure function overflow_reason(row, column) result(reason)
    integer, intent(in) :: row, column
    character(len=reason_length(row, column)) :: reason

    reason = 'the sum of the entries for ('//text(row)//', '//text(column)//') is out of range'
  end function overflow_reason

  !> Load a file and read its banner and sizes.
  subroutine open_matrix(path, source, info)
    character(len=*), intent(in) :: path
    type(matrix_file), intent(inout) :: source
    type(fuge_info), intent(inout) :: info

    call source%file%load(path, info)
    if (.not. info%failed()) call read_header(source, info)
  end subroutine open_matrix

  !> Read banner and sizes; refuse a file that is too short for its number of entries.
  subroutine read_header(source, info)
    type(matrix_file), intent(inout) :: source
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    logical :: exists

    call source%file%advance(exists)
    if (.not. exists) then
      call report(info, FUGE_ERR_FILE, source%file%name//' is empty, or not a regular file')
      return
    end if
    call read_banner(source%file%content(source%file%first:source%file%last), source%layout, reason)
    if (.not. allocated(reason)) then
      call next_line(source, exists)
      if (exists) then
        call read_sizes(source%file%content(source%file%first:source%file%last), source%layout, reason)
      else
        reason = 'the file ends before the line with the sizes'
      end if
    end if
    if (allocated(reason)) then
      call source%file%refuse(reason, info)
    else
      call check_length(source, info)
    end if
  end subroutine read_header

  !> Refuse a file that cannot hold as many entries as it announces, before memory for them is
  !> allocated.
  pure subroutine check_length(source, info)
    type(matrix_file), intent(inout) :: source
    type(fuge_info), intent(inout) :: info
    integer(int64) :: bytes
    logical :: exists

    bytes = len(source%file%content, kind=int64) - source%file%last
    bytes = bytes/merge(SHORTEST_ENTRY, SHORTEST_VALUE, source%layout%coordinate)
    if (source%layout%entries <= bytes + 1_int64) return
    ! Count the lines for the message.
    do
      call next_line(source, exists)
      if (.not. exists) exit
      source%count = source%count + 1_int64
    end do
    call refuse_end(source, info)
  end subroutine check_length

  !> Refuse sizes that need `room` for more than EMPTY_ROOM positions and for more than `filled`, the most that the
  !> number of entries justifies. Otherwise a damaged header alone could take any amount of memory.
  pure subroutine check_room(source, room, filled, info)
    type(matrix_file), intent(in) :: source
    real(dp), intent(in) :: room, filled
    type(fuge_info), intent(inout) :: info

    if (room <= max(real(EMPTY_ROOM, dp), filled)) return
    call source%file%refuse('most of '//text(source%layout%rows)//' rows and '//text(source%layout%columns) &
                            //' columns have none of the entries: are the sizes right?', info)
  end subroutine check_room

  !> Advance to the next line that is neither blank nor a comment; `exists` is false at the end
  !> of the file.
  pure subroutine next_line(source, exists)
    type(matrix_file), intent(inout) :: source
    logical, intent(out) :: exists

    do
      call source%file%advance(exists)
      if (.not. exists) return
      if (.not. is_skipped(source%file%content(source%file%first:source%file%last))) return
    end do
  end subroutine next_line

  !> Report that the file ends before its last entry (FUGE_ERR_FILE).
  pure subroutine refuse_end(source, info)
    type(matrix_file), intent(in) :: source
    type(fuge_info), intent(inout) :: info
    character(len=24) :: present_entries, announced

    write (present_entries, '(i0)') source%count
    write (announced, '(i0)') source%layout%entries
    call source%file%refuse('the file ends after '//trim(present_entries)//' of '//trim(announced)//' entries', info)
  end subroutine refuse_end

  !> Refuse a file with more entries than it announces (FUGE_ERR_FILE).
  pure subroutine check_end(source, info)
    type(matrix_file), intent(inout) :: source
    type(fuge_info), intent(inout) :: info
    logical :: exists

    call next_line(source, exists)
    if (exists) call source%file%refuse('more entries than the line with the sizes announces', info)
  end subroutine check_end

  !> Read the next entry: its position from the line or, in an array file, from its number.
  pure subroutine next_entry(source, info)
    type(matrix_file), intent(inout) :: source
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    logical :: exists

    call next_line(source, exists)
    if (.not. exists) then
      call refuse_end(source, info)
      return
    end if
    if (source%layout%coordinate) then
      call read_entry(source%file%content(source%file%first:source%file%last), source%layout, source%row, &
                      source%column, source%value, reason)
    else
      source%row = source%row + 1
      if (source%row > source%layout%rows) then
        source%column = source%column + 1
        source%row = merge(source%column, 1, source%layout%symmetric)
      end if
      call read_value(source%file%content(source%file%first:source%file%last), source%layout, source%value, reason)
    end if
    source%count = source%count + 1_int64
    if (allocated(reason)) call source%file%refuse(reason, info)
  end subroutine next_entry

  !> Read all entries into a dense array, (rows, columns).
  pure subroutine read_dense(source, matrix, info)
    type(matrix_file), intent(inout) :: source
    real(dp), intent(out) :: matrix(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: i, j

    matrix = 0.0_dp
    do while (source%count < source%layout%entries)
      call next_entry(source, info)
      if (info%failed()) return
      i = source%row
      j = source%column
      if (.not. source%layout%coordinate) then
        matrix(i, j) = source%value
      else if (sum_overflows(matrix(i, j), source%value)) then
        call source%file%refuse(overflow_reason(i, j), info)
        return
      else
        matrix(i, j) = matrix(i, j) + source%value
      end if
      if (source%layout%symmetric) matrix(j, i) = matrix(i, j)
    end do
    call check_end(source, info)
  end subroutine read_dense

  !> Number of entries with those above the diagonal that a symmetric file leaves out, at most.
  pure function entries_of_both_triangles(layout) result(entries)
    type(matrix_layout), intent(in) :: layout
    integer(int64) :: entries

    entries = layout%entries
    if (layout%symmetric) entries = 2_int64*entries
  end function entries_of_both_triangles

  !> Read all entries as triplets, without the zeros of an array file.
  pure subroutine read_triplets(source, triplets, info)
    type(matrix_file), intent(inout) :: source
    type(matrix_triplets), intent(inout) :: triplets
    type(fuge_info), intent(inout) :: info

    do while (source%count < source%layout%entries)
      call next_entry(source, info)
      if (info%failed()) return
      associate (i => source%row, j => source%column, value => source%value)
        if (.not. (source%layout%coordinate .or. abs(value) > 0.0_dp)) cycle
        call triplets%append(i, j, value)
        if (source%layout%symmetric .and. i /= j) call triplets%append(j, i, value)
      end associate
    end do
    call check_end(source, info)
  end subroutine read_triplets

end module fuge_matrix_market_reader
