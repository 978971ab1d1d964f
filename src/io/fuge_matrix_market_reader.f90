!> Matrix Market files read: dense, or as compressed columns.
!>
!> Real and integer matrices in coordinate or array format, general or symmetric. A symmetric
!> file holds the lower triangle, a matrix is always given whole. Entries of a coordinate
!> file that name the same place are added, as contributions of several elements: the format
!> does not say what they mean. Comments and blank lines may be anywhere after the first
!> line, each entry has a line of its own.
module fuge_matrix_market_reader
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_matrix_market_lines, only: is_skipped, matrix_layout, read_banner, read_entry, read_sizes, read_value
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_number_text, only: text
  use fuge_text_reader, only: text_file
  use fuge_compressed_columns, only: order_triplets, sum_overflows, sum_repeated
  implicit none
  private

  public :: fuge_read_matrix, fuge_read_sparse

  !> Bytes of an entry with its line feed, at least.
  integer(int64), parameter :: SHORTEST_ENTRY = 6_int64, SHORTEST_VALUE = 2_int64

contains

  !> Read a matrix from a Matrix Market file into a dense array.
  !>
  !> `matrix` (rows, columns) is allocated afresh, with zeros where a coordinate file has no
  !> entry, in the unit of the file.
  !> Errors, `matrix` untouched: FUGE_ERR_FILE with file, line and reason, FUGE_ERR_MEMORY.
  subroutine fuge_read_matrix(path, matrix, info)
    character(len=*), intent(in) :: path
    real(dp), allocatable, intent(inout) :: matrix(:, :)
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    type(matrix_layout) :: layout
    real(dp), allocatable :: entries(:, :)
    integer :: status

    call file%load(path, info)
    if (.not. info%failed()) call read_header(file, layout, info)
    if (info%failed()) return
    allocate (entries(layout%rows, layout%columns), stat=status)
    if (status /= 0) then
      call report(info, FUGE_ERR_MEMORY, file%name//': no memory for a dense matrix of '//text(layout%rows)//' x ' &
                  //text(layout%columns)//': read it with fuge_read_sparse')
      return
    end if
    if (layout%coordinate) then
      call read_scattered(file, layout, entries, info)
    else
      call read_by_columns(file, layout, entries, info)
    end if
    if (.not. info%failed()) call move_alloc(entries, matrix)
  end subroutine fuge_read_matrix

  !> Read a matrix from a Matrix Market file into compressed columns.
  !>
  !> Column j has the rows `row`(k) and the values `value`(k), k = `column`(j) ..
  !> `column`(j + 1) - 1, rows ascending, each once; `column` has one element more than there
  !> are columns. Of an array file what is not 0 is kept, of a coordinate file all entries.
  !> The three arrays are allocated afresh.
  !> Errors, outputs untouched: FUGE_ERR_FILE with file, line and reason, FUGE_ERR_MEMORY.
  subroutine fuge_read_sparse(path, rows, column, row, value, info)
    character(len=*), intent(in) :: path
    integer, intent(inout) :: rows
    integer, allocatable, intent(inout) :: column(:), row(:)
    real(dp), allocatable, intent(inout) :: value(:)
    type(fuge_info), intent(out) :: info
    type(text_file) :: file
    type(matrix_layout) :: layout
    integer, allocatable :: i(:), j(:), order(:), begin(:)
    real(dp), allocatable :: entry(:)
    integer(int64) :: most
    integer :: count, status

    call file%load(path, info)
    if (.not. info%failed()) call read_header(file, layout, info)
    if (info%failed()) return
    status = 1
    ! Compressed columns count with default integers.
    most = room(layout)
    if (most < int(huge(1), int64)) allocate (i(most), j(most), entry(most), stat=status)
    if (status == 0) then
      if (layout%coordinate) then
        call read_triplets(file, layout, i, j, entry, count, info)
      else
        call read_what_is_not_zero(file, layout, i, j, entry, count, info)
      end if
      if (info%failed()) return
      deallocate (file%content)
      call order_triplets(layout%rows, layout%columns, i(:count), j(:count), order, begin, status)
    end if
    if (status == 0) call hand_over(file%name, i, entry, order, begin, column, row, value, status, info)
    if (status /= 0) call report(info, FUGE_ERR_MEMORY, file%name//': no memory for the entries of a matrix of ' &
                                 //text(layout%rows)//' x '//text(layout%columns))
    if (.not. info%failed()) rows = layout%rows
  end subroutine fuge_read_sparse

  !> Banner and sizes.
  subroutine read_header(file, layout, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(out) :: layout
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    integer(int64) :: bytes
    logical :: found

    call file%advance(found)
    if (.not. found) then
      call report(info, FUGE_ERR_FILE, file%name//' is empty, or no regular file')
      return
    end if
    call read_banner(file%content(file%first:file%last), layout, reason)
    if (.not. allocated(reason)) then
      call next_entry(file, found)
      if (found) then
        call read_sizes(file%content(file%first:file%last), layout, reason)
      else
        reason = 'the file ends before the line with the sizes'
      end if
    end if
    if (allocated(reason)) then
      call file%refuse(reason, info)
      return
    end if
    ! Do not ask for memory that a wrong number says.
    bytes = len(file%content, kind=int64) - file%last
    bytes = bytes/merge(SHORTEST_ENTRY, SHORTEST_VALUE, layout%coordinate)
    if (layout%entries > bytes + 1_int64) call count_entries(file, layout, info)
  end subroutine read_header

  !> Go to the next line that is not skipped.
  pure subroutine next_entry(file, found)
    type(text_file), intent(inout) :: file
    logical, intent(out) :: found

    do
      call file%advance(found)
      if (.not. found) return
      if (.not. is_skipped(file%content(file%first:file%last))) return
    end do
  end subroutine next_entry

  !> Refuse a file that ends too early.
  pure subroutine count_entries(file, layout, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    type(fuge_info), intent(inout) :: info
    integer(int64) :: count
    logical :: found

    count = -1_int64
    found = .true.
    do while (found)
      call next_entry(file, found)
      count = count + 1_int64
    end do
    call refuse_end(file, layout, count, info)
  end subroutine count_entries

  pure subroutine refuse_end(file, layout, count, info)
    type(text_file), intent(in) :: file
    type(matrix_layout), intent(in) :: layout
    integer(int64), intent(in) :: count
    type(fuge_info), intent(inout) :: info
    character(len=24) :: there, wanted

    write (there, '(i0)') count
    write (wanted, '(i0)') layout%entries
    call file%refuse('the file ends after '//trim(there)//' of '//trim(wanted)//' entries', info)
  end subroutine refuse_end

  !> Nothing may follow the last entry.
  pure subroutine check_end(file, info)
    type(text_file), intent(inout) :: file
    type(fuge_info), intent(inout) :: info
    logical :: found

    if (info%failed()) return
    call next_entry(file, found)
    if (found) call file%refuse('more entries than the line with the sizes says', info)
  end subroutine check_end

  !> The next line as an entry; `count` have been read before.
  pure subroutine take_entry(file, layout, count, row, column, value, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    integer(int64), intent(in) :: count
    integer, intent(out) :: row, column
    real(dp), intent(out) :: value
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason
    logical :: found

    row = 0
    column = 0
    value = 0.0_dp
    call next_entry(file, found)
    if (.not. found) then
      call refuse_end(file, layout, count, info)
      return
    end if
    if (layout%coordinate) then
      call read_entry(file%content(file%first:file%last), layout, row, column, value, reason)
    else
      call read_value(file%content(file%first:file%last), layout, value, reason)
    end if
    if (allocated(reason)) call file%refuse(reason, info)
  end subroutine take_entry

  pure subroutine read_by_columns(file, layout, matrix, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    real(dp), intent(inout) :: matrix(:, :)
    type(fuge_info), intent(inout) :: info
    integer(int64) :: count
    integer :: i, j, row, column

    count = 0_int64
    do j = 1, layout%columns
      do i = merge(j, 1, layout%symmetric), layout%rows
        call take_entry(file, layout, count, row, column, matrix(i, j), info)
        if (info%failed()) return
        count = count + 1_int64
        if (layout%symmetric) matrix(j, i) = matrix(i, j)
      end do
    end do
    call check_end(file, info)
  end subroutine read_by_columns

  pure subroutine read_scattered(file, layout, matrix, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    real(dp), intent(inout) :: matrix(:, :)
    type(fuge_info), intent(inout) :: info
    integer(int64) :: count
    integer :: i, j
    real(dp) :: value

    matrix = 0.0_dp
    do count = 0_int64, layout%entries - 1_int64
      call take_entry(file, layout, count, i, j, value, info)
      if (info%failed()) return
      if (sum_overflows(matrix(i, j), value)) then
        call file%refuse('the entries for ('//text(i)//', '//text(j)//') have a sum that is out of range', info)
        return
      end if
      matrix(i, j) = matrix(i, j) + value
      if (layout%symmetric) matrix(j, i) = matrix(i, j)
    end do
    call check_end(file, info)
  end subroutine read_scattered

  !> For all entries, in a symmetric file for their mirror images too.
  pure function room(layout)
    type(matrix_layout), intent(in) :: layout
    integer(int64) :: room

    room = layout%entries
    if (layout%symmetric) room = 2_int64*room
  end function room

  pure subroutine read_triplets(file, layout, i, j, entry, count, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    integer, intent(inout) :: i(:), j(:)
    real(dp), intent(inout) :: entry(:)
    integer, intent(out) :: count
    type(fuge_info), intent(inout) :: info
    integer(int64) :: line
    integer :: row, column
    real(dp) :: value

    count = 0
    do line = 0_int64, layout%entries - 1_int64
      call take_entry(file, layout, line, row, column, value, info)
      if (info%failed()) return
      call append(row, column, value, layout%symmetric, i, j, entry, count)
    end do
    call check_end(file, info)
  end subroutine read_triplets

  pure subroutine read_what_is_not_zero(file, layout, i, j, entry, count, info)
    type(text_file), intent(inout) :: file
    type(matrix_layout), intent(in) :: layout
    integer, intent(inout) :: i(:), j(:)
    real(dp), intent(inout) :: entry(:)
    integer, intent(out) :: count
    type(fuge_info), intent(inout) :: info
    integer(int64) :: line
    integer :: row, column, k, l
    real(dp) :: value

    count = 0
    line = 0_int64
    do l = 1, layout%columns
      do k = merge(l, 1, layout%symmetric), layout%rows
        call take_entry(file, layout, line, row, column, value, info)
        if (info%failed()) return
        line = line + 1_int64
        if (abs(value) > 0.0_dp) call append(k, l, value, layout%symmetric, i, j, entry, count)
      end do
    end do
    call check_end(file, info)
  end subroutine read_what_is_not_zero

  pure subroutine append(row, column, value, symmetric, i, j, entry, count)
    integer, intent(in) :: row, column
    real(dp), intent(in) :: value
    logical, intent(in) :: symmetric
    integer, intent(inout) :: i(:), j(:), count
    real(dp), intent(inout) :: entry(:)

    count = count + 1
    i(count) = row
    j(count) = column
    entry(count) = value
    if (.not. symmetric .or. row == column) return
    count = count + 1
    i(count) = column
    j(count) = row
    entry(count) = value
  end subroutine append

  !> All or none.
  pure subroutine hand_over(name, i, entry, order, begin, column, row, value, status, info)
    character(len=*), intent(in) :: name
    integer, allocatable, intent(inout) :: i(:), order(:), begin(:)
    real(dp), allocatable, intent(inout) :: entry(:)
    integer, allocatable, intent(inout) :: column(:), row(:)
    real(dp), allocatable, intent(inout) :: value(:)
    integer, intent(out) :: status
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: new_row(:)
    real(dp), allocatable :: new_value(:)
    integer :: last, overflow

    last = size(order)
    allocate (new_row(last), new_value(last), stat=status)
    if (status /= 0) return
    new_row = i(order)
    new_value = entry(order)
    call sum_repeated(begin, new_row, new_value, overflow)
    if (overflow > 0) then
      call report(info, FUGE_ERR_FILE, name//': the entries for ('//text(new_row(overflow))//', ' &
                  //text(count(begin <= overflow))//') have a sum that is out of range')
      return
    end if
    call move_alloc(begin, column)
    last = column(size(column)) - 1
    if (last == size(new_row)) then
      call move_alloc(new_row, row)
      call move_alloc(new_value, value)
    else
      row = new_row(:last)
      value = new_value(:last)
    end if
  end subroutine hand_over

end module fuge_matrix_market_reader
