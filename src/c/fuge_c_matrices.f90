!> C bindings, section "matrix files".
module fuge_c_matrices
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_size_t, c_associated, c_f_pointer
  use fuge_c_types, only: copy_integers, copy_reals, copy_string, from_c_string
  use fuge_matrix_market_reader, only: fuge_read_matrix, fuge_read_sparse
  use fuge_matrix_market_writer, only: fuge_write_matrix, fuge_write_sparse
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_POINTER, FUGE_ERR_SIZE
  use fuge_number_text, only: text
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

    if (.not. (c_associated(path) .and. c_associated(rows) .and. c_associated(columns))) then
      call report(info, FUGE_ERR_POINTER, 'path, rows or columns is NULL')
    else if (lda < 0 .or. capacity < 0) then
      call report(info, FUGE_ERR_SIZE, 'lda or capacity is negative: matrix has room for lda rows and capacity columns')
    else
      call fuge_read_matrix(from_c_string(path), whole, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    if (c_associated(matrix)) then
      shown = min(shape(whole), [int(lda), int(capacity)])
      call c_f_pointer(matrix, destination, [lda, capacity])
      destination(:shown(1), :shown(2)) = whole(:shown(1), :shown(2))
    end if
    call copy_integers([size(whole, 1)], rows)
    call copy_integers([size(whole, 2)], columns)
  end function c_read_matrix

  function c_read_sparse(path, columns_room, entries_room, column, row, value, rows, columns, entries, message, &
    length) bind(c, name='fuge_read_sparse') result(status)
    type(c_ptr), intent(in), value :: path, column, row, value, rows, columns, entries, message
    integer(c_int), intent(in), value :: columns_room, entries_room
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    integer, allocatable :: begin(:), i(:)
    real(c_double), allocatable :: entry(:)
    type(fuge_info) :: info
    integer :: height, shown

    height = 0
    if (.not. (c_associated(path) .and. c_associated(rows) .and. c_associated(columns) &
               .and. c_associated(entries))) then
      call report(info, FUGE_ERR_POINTER, 'path, rows, columns or entries is NULL')
    else if (columns_room < 0 .or. entries_room < 0) then
      call report(info, FUGE_ERR_SIZE, 'columns_room or entries_room is negative: they are the room in the arrays')
    else
      call fuge_read_sparse(from_c_string(path), height, begin, i, entry, info)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
    if (info%failed()) return
    call copy_integers(begin(:min(size(begin), int(columns_room) + 1)) - 1, column)
    shown = min(size(i), int(entries_room))
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

    if (.not. (c_associated(path) .and. c_associated(matrix))) then
      call report(info, FUGE_ERR_POINTER, 'path or matrix is NULL')
    else if (rows < 0 .or. columns < 0 .or. lda < rows) then
      call report(info, FUGE_ERR_SIZE, 'rows = '//text(int(rows))//', columns = '//text(int(columns))//', lda = ' &
                  //text(int(lda))//': sizes are not negative, and lda is at least rows')
    else
      call c_f_pointer(matrix, whole, [lda, columns])
      call fuge_write_matrix(from_c_string(path), whole(:rows, :), info, symmetric=symmetric /= 0)
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_write_matrix

  function c_write_sparse(path, rows, columns, column, row, value, symmetric, message, length) &
    bind(c, name='fuge_write_sparse') result(status)
    type(c_ptr), intent(in), value :: path, column, row, value, message
    integer(c_int), intent(in), value :: rows, columns, symmetric
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    integer(c_int), pointer :: begin(:)
    type(fuge_info) :: info

    if (.not. (c_associated(path) .and. c_associated(column) .and. c_associated(row) .and. c_associated(value))) then
      call report(info, FUGE_ERR_POINTER, 'path, column, row or value is NULL')
    else if (rows < 0 .or. columns < 0) then
      call report(info, FUGE_ERR_SIZE, 'rows = '//text(int(rows))//', columns = '//text(int(columns)) &
                  //': sizes are not negative')
    else
      call c_f_pointer(column, begin, [columns + 1])
      if (begin(columns + 1) < 0) then
        call report(info, FUGE_ERR_SIZE, 'column ends with '//text(int(begin(columns + 1)))//', the number of entries')
      else
        call write_columns(from_c_string(path), int(rows), begin, row, value, symmetric /= 0, info)
      end if
    end if
    call copy_string(info%message, message, length)
    status = int(info%status, c_int)
  end function c_write_sparse

  !> With indices from 1.
  subroutine write_columns(path, rows, begin, row, value, symmetric, info)
    character(len=*), intent(in) :: path
    integer, intent(in) :: rows
    integer(c_int), intent(in) :: begin(:)
    type(c_ptr), intent(in) :: row, value
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: rows_of_c(:)
    real(c_double), pointer :: entry(:)
    integer, allocatable :: column(:), i(:)
    integer :: entries, status

    entries = int(begin(size(begin)))
    allocate (column(size(begin)), i(entries), stat=status)
    if (status /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of '//text(entries)//' indices')
      return
    end if
    call c_f_pointer(row, rows_of_c, [entries])
    call c_f_pointer(value, entry, [entries])
    column = int(begin) + 1
    i = int(rows_of_c) + 1
    call fuge_write_sparse(path, rows, column, i, entry, info, symmetric)
  end subroutine write_columns

end module fuge_c_matrices
