!> C bindings, section "matrix files".
module fuge_c_matrices
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: copy_integers, copy_reals, from_c_string, from_zero, report_to_c, require_columns, &
    require_count, require_path, require_pointer
  use fuge_matrix_market_reader, only: fuge_read_matrix, fuge_read_sparse
  use fuge_matrix_market_writer, only: fuge_write_matrix, fuge_write_sparse
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

contains

  function c_read_matrix(path, lda, capacity, matrix, rows, columns, message, length) &
    bind(c, name='fuge_read_matrix') result(status)
    type(c_ptr), intent(in), value :: path, matrix, rows, columns, message
    integer(c_int), intent(in), value :: lda, capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), allocatable :: whole(:, :)
    real(c_double), pointer :: destination(:, :)
    type(fuge_info) :: info
    integer :: shown(2)

    call require_path(path, info)
    call require_pointer(rows, 'rows', info)
    call require_pointer(columns, 'columns', info)
    call require_count(lda, 0, 'lda', 'rows that fit into matrix', info)
    call require_count(capacity, 0, 'capacity', 'columns that fit into matrix', info)
    if (.not. info%failed()) call fuge_read_matrix(from_c_string(path), whole, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    if (c_associated(matrix)) then
      shown = min(shape(whole), [int(lda), int(capacity)])
      call c_f_pointer(matrix, destination, [lda, capacity])
      destination(:shown(1), :shown(2)) = whole(:shown(1), :shown(2))
    end if
    call copy_integers([size(whole, 1)], rows)
    call copy_integers([size(whole, 2)], columns)
  end function c_read_matrix

  !> Eleven arguments, as in the header: the file, three arrays with their sizes, the message.
  function c_read_sparse(path, column_capacity, entry_capacity, column, row, value, rows, columns, entries, message, &
    length) bind(c, name='fuge_read_sparse') result(status)
    type(c_ptr), intent(in), value :: path, column, row, value, rows, columns, entries, message
    integer(c_int), intent(in), value :: column_capacity, entry_capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    integer, allocatable :: begin(:), i(:)
    real(c_double), allocatable :: entry(:)
    type(fuge_info) :: info
    integer :: height, shown

    height = 0
    call require_path(path, info)
    call require_pointer(rows, 'rows', info)
    call require_pointer(columns, 'columns', info)
    call require_pointer(entries, 'entries', info)
    call require_count(column_capacity, 0, 'column_capacity', 'columns that fit into column', info)
    call require_count(entry_capacity, 0, 'entry_capacity', 'entries that fit into row and value', info)
    if (.not. info%failed()) call fuge_read_sparse(from_c_string(path), height, begin, i, entry, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call copy_integers(begin(:min(size(begin) - 1, int(column_capacity)) + 1) - 1, column)
    shown = min(size(i), int(entry_capacity))
    call copy_integers(i(:shown) - 1, row)
    call copy_reals(entry(:shown), value)
    call copy_integers([height], rows)
    call copy_integers([size(begin) - 1], columns)
    call copy_integers([size(i)], entries)
  end function c_read_sparse

  function c_write_matrix(path, rows, columns, matrix, lda, symmetric, message, length) &
    bind(c, name='fuge_write_matrix') result(status)
    type(c_ptr), intent(in), value :: path, matrix, message
    integer(c_int), intent(in), value :: rows, columns, lda, symmetric
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    real(c_double), pointer :: whole(:, :)
    type(fuge_info) :: info

    call require_path(path, info)
    call require_pointer(matrix, 'matrix', info)
    call require_count(rows, 0, 'rows', 'rows', info)
    call require_count(columns, 0, 'columns', 'columns', info)
    call require_count(lda, int(rows), 'lda', 'doubles from column to column', info)
    if (.not. info%failed()) then
      call c_f_pointer(matrix, whole, [lda, columns])
      call fuge_write_matrix(from_c_string(path), whole(:rows, :), info, symmetric=symmetric /= 0)
    end if
    status = report_to_c(info, message, length)
  end function c_write_matrix

  !> Nine arguments, as in the header: the file, the matrix, the message.
  function c_write_sparse(path, rows, columns, column, row, value, symmetric, message, length) &
    bind(c, name='fuge_write_sparse') result(status)
    type(c_ptr), intent(in), value :: path, column, row, value, message
    integer(c_int), intent(in), value :: rows, columns, symmetric
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    integer(c_int), pointer :: begin(:)
    type(fuge_info) :: info

    call require_path(path, info)
    call require_pointer(column, 'column', info)
    call require_pointer(row, 'row', info)
    call require_pointer(value, 'value', info)
    call require_count(rows, 0, 'rows', 'rows', info)
    call require_count(columns, 0, 'columns', 'columns', info)
    call require_columns(columns, 'columns', info)
    if (.not. info%failed()) then
      call c_f_pointer(column, begin, [columns + 1])
      call write_columns(from_c_string(path), int(rows), begin, row, value, symmetric /= 0, info)
    end if
    status = report_to_c(info, message, length)
  end function c_write_sparse

  !> Write compressed columns of C, whose indices count from 0.
  subroutine write_columns(path, rows, begin, row, value, symmetric, info)
    character(len=*), intent(in) :: path
    integer, intent(in) :: rows
    integer(c_int), intent(in) :: begin(:)
    type(c_ptr), intent(in) :: row, value
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: rows_from_zero(:)
    real(c_double), pointer :: entry(:)
    integer, allocatable :: column(:), i(:)
    integer :: entries, status

    call require_count(begin(size(begin)), 0, 'column('//text(size(begin) - 1)//')', 'entries', info)
    if (info%failed()) return
    ! Where the columns do not begin at 0 the last one may end beyond the entries: no entry is read then.
    entries = merge(int(begin(size(begin))), 0, begin(1) == 0)
    allocate (column(size(begin)), i(entries), stat=status)
    call require_memory(status, 'a copy of', entries, 'indices', info)
    if (status /= 0) return
    call c_f_pointer(row, rows_from_zero, [entries])
    call c_f_pointer(value, entry, [entries])
    column = from_zero(begin)
    i = from_zero(rows_from_zero)
    call fuge_write_sparse(path, rows, column, i, entry, info, symmetric)
  end subroutine write_columns

end module fuge_c_matrices
