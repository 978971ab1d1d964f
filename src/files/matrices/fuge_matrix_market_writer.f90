!> Matrix Market files: write a matrix with 17 digits, so that it is read back to the last bit.
module fuge_matrix_market_writer
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_matrix_market_lines, only: banner_line
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_FINITE, FUGE_ERR_SIZE
  use fuge_text_writer, only: text_output
  implicit none
  private

  public :: fuge_write_matrix, fuge_write_sparse

  !> Number of entries that one write statement converts, because each statement costs time.
  integer, parameter :: BLOCK = 64

contains

  !> Write a dense matrix to a Matrix Market file in array format; an existing file is replaced.
  !>
  !> `matrix` (any shape); `symmetric` (default .false.): the matrix is square, and only its lower
  !> triangle is read and written.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, an existing file unchanged; FUGE_ERR_FILE if
  !> writing fails, the file is then empty.
  subroutine fuge_write_matrix(path, matrix, info, symmetric)
    character(len=*), intent(in) :: path
    real(dp), intent(in) :: matrix(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(text_output) :: file
    character(len=24) :: lines(BLOCK)
    logical :: lower
    integer :: i, j, k, last

    lower = .false.
    if (present(symmetric)) lower = symmetric
    call check_square(size(matrix, 1), size(matrix, 2), lower, info)
    do j = 1, size(matrix, 2)
      if (.not. info%failed()) call check_column(matrix(:, j), merge(j, 1, lower), j, info)
    end do
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    call file%put(banner_line(.false., lower))
    call file%put(text(size(matrix, 1))//' '//text(size(matrix, 2)))
    do j = 1, size(matrix, 2)
      do i = merge(j, 1, lower), size(matrix, 1), BLOCK
        last = min(i + BLOCK - 1, size(matrix, 1))
        ! gfortran's run-time library keeps internal units in the list through which `open` walks.
        call lock(LOCK_FILES)
        write (lines(:last - i + 1), '(es24.16e3)') matrix(i:last, j)
        call unlock(LOCK_FILES)
        do k = 1, last - i + 1
          call file%put(lines(k))
        end do
      end do
    end do
    call file%finish(info)
  end subroutine fuge_write_matrix

  !> Write compressed columns to a Matrix Market file in coordinate format; an existing file is
  !> replaced.
  !>
  !> `rows`, `column`, `row`, `value` as fuge_read_sparse returns them, but rows may be in any
  !> order and repeated; `symmetric` (default .false.): the matrix is square, and entries above
  !> the diagonal are not written.
  !> Errors: FUGE_ERR_SIZE for columns that are not in order or a row outside 1 .. `rows`,
  !> FUGE_ERR_NOT_FINITE, an existing file unchanged; FUGE_ERR_FILE if writing fails, the file is
  !> then empty.
  subroutine fuge_write_sparse(path, rows, column, row, value, info, symmetric)
    character(len=*), intent(in) :: path
    integer, intent(in) :: rows, column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(text_output) :: file
    character(len=48) :: lines(BLOCK)
    logical :: lower
    integer :: j, k, l, last

    lower = .false.
    if (present(symmetric)) lower = symmetric
    call check_square(rows, size(column) - 1, lower, info)
    if (.not. info%failed()) call check_columns(rows, column, row, value, info)
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    call file%put(banner_line(.true., lower))
    call file%put(text(rows)//' '//text(size(column) - 1)//' '//text(entries_to_write(column, row, lower)))
    do j = 1, size(column) - 1
      do k = column(j), column(j + 1) - 1, BLOCK
        last = min(k + BLOCK, column(j + 1)) - 1
        call lock(LOCK_FILES)
        write (lines(:last - k + 1), '(i0,1x,i0,es25.16e3)') (row(l), j, value(l), l=k, last)
        call unlock(LOCK_FILES)
        do l = k, last
          if (row(l) >= j .or. .not. lower) call file%put(lines(l - k + 1))
        end do
      end do
    end do
    call file%finish(info)
  end subroutine fuge_write_sparse

  !> Number of entries that are written, only the `lower` triangle or all.
  pure function entries_to_write(column, row, lower) result(entries)
    integer, intent(in) :: column(:), row(:)
    logical, intent(in) :: lower
    integer :: entries
    integer :: j

    entries = column(size(column)) - 1
    if (.not. lower) return
    do j = 1, size(column) - 1
      entries = entries - count(row(column(j):column(j + 1) - 1) < j)
    end do
  end function entries_to_write

  !> Refuse negative sizes, and a symmetric matrix that is not square (FUGE_ERR_SIZE).
  pure subroutine check_square(rows, columns, symmetric, info)
    integer, intent(in) :: rows, columns
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info

    if (rows < 0 .or. columns < 0) then
      call report(info, FUGE_ERR_SIZE, 'rows = '//text(rows)//', columns = '//text(columns) &
                  //': both must be 0 or more; column needs one element more than the matrix has columns')
    else if (symmetric .and. rows /= columns) then
      call report(info, FUGE_ERR_SIZE, 'a symmetric matrix cannot be '//text(rows)//' x '//text(columns))
    end if
  end subroutine check_square

  !> Refuse NaN and infinity in column j from row `first` on (FUGE_ERR_NOT_FINITE).
  pure subroutine check_column(values, first, j, info)
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: first, j
    type(fuge_info), intent(inout) :: info
    integer :: i

    do i = first, size(values)
      if (ieee_is_finite(values(i))) cycle
      call refuse_entry(i, j, values(i), info)
      return
    end do
  end subroutine check_column

  !> Report an entry that is NaN or infinity (FUGE_ERR_NOT_FINITE).
  pure subroutine refuse_entry(i, j, value, info)
    integer, intent(in) :: i, j
    real(dp), intent(in) :: value
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_NOT_FINITE, 'entry ('//index_text(i)//', '//index_text(j)//') = '//text(value) &
                //' is not a finite number')
  end subroutine refuse_entry

  !> Refuse columns that are not in order and rows out of range (FUGE_ERR_SIZE), NaN and infinity
  !> (FUGE_ERR_NOT_FINITE).
  pure subroutine check_columns(rows, column, row, value, info)
    integer, intent(in) :: rows, column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, k, last

    last = min(size(row), size(value))
    if (column(1) /= 1) call report(info, FUGE_ERR_SIZE, 'column('//index_text(1)//') = '//index_text(column(1)) &
                                    //': it must be '//index_text(1)//', where the first column begins')
    do j = 1, size(column) - 1
      if (info%failed()) return
      if (column(j + 1) < column(j) .or. column(j + 1) - 1 > last) then
        call report(info, FUGE_ERR_SIZE, 'column('//index_text(j + 1)//') = '//index_text(column(j + 1)) &
                    //' is outside '//index_text(column(j))//' .. '//index_text(last + 1) &
                    //', from the previous column to the end of row and value')
        return
      end if
      do k = column(j), column(j + 1) - 1
        if (row(k) < 1 .or. row(k) > rows) then
          call report(info, FUGE_ERR_SIZE, 'row('//index_text(k)//') = '//index_text(row(k))//' is outside ' &
                      //index_text(1)//' .. '//index_text(rows))
        else if (.not. ieee_is_finite(value(k))) then
          call refuse_entry(row(k), j, value(k), info)
        end if
        if (info%failed()) return
      end do
    end do
  end subroutine check_columns

end module fuge_matrix_market_writer
