!> The lines of a Matrix Market file: banner, sizes, entries.
!>
!> The format: R. F. Boisvert, R. Pozo, K. A. Remington, The Matrix Market exchange formats:
!> initial design, NISTIR 5935, 1996. Supported are real and integer matrices, general and
!> symmetric.
module fuge_matrix_market_lines
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_entry_numbers, only: read_label
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_text_columns, only: after_blanks, find_column
  use fuge_text_numbers, only: describe_text, lower_case, quoted, read_number, read_whole, KIND_NUMBER
  implicit none
  private

  public :: banner_line, is_skipped, read_banner, read_entry, read_sizes, read_value

  !> The content of the banner and the line with the sizes.
  type, public :: matrix_layout
    !> Coordinate format, with row, column and value on each line; otherwise array format, with
    !> all values column by column.
    logical :: coordinate = .false.
    !> Values are whole numbers.
    logical :: whole = .false.
    !> Only the lower triangle is in the file.
    logical :: symmetric = .false.
    integer :: rows = 0
    integer :: columns = 0
    !> Number of lines with an entry.
    integer(int64) :: entries = 0_int64
  end type matrix_layout

  character(len=*), parameter :: BANNER = '%%matrixmarket'

contains

  !> The banner of a real matrix, padded with blanks.
  pure function padded_banner(coordinate, symmetric) result(line)
    logical, intent(in) :: coordinate, symmetric
    character(len=52) :: line

    line = '%%MatrixMarket matrix array real'
    if (coordinate) line = '%%MatrixMarket matrix coordinate real'
    if (symmetric) then
      line = trim(line)//' symmetric'
    else
      line = trim(line)//' general'
    end if
  end function padded_banner

  !> The banner of a real matrix.
  pure function banner_line(coordinate, symmetric) result(line)
    logical, intent(in) :: coordinate, symmetric
    character(len=len_trim(padded_banner(coordinate, symmetric))) :: line

    line = padded_banner(coordinate, symmetric)
  end function banner_line

  !> Is the line blank or a comment?
  pure function is_skipped(line) result(skipped)
    character(len=*), intent(in) :: line
    logical :: skipped
    integer :: first

    first = after_blanks(line, 1)
    skipped = first > len(line)
    if (.not. skipped) skipped = line(first:first) == '%'
  end function is_skipped

  !> Read the banner, the first line; `reason` is allocated if it is not supported.
  pure subroutine read_banner(line, layout, reason)
    character(len=*), intent(in) :: line
    type(matrix_layout), intent(out) :: layout
    character(len=:), allocatable, intent(out) :: reason
    character(len=16) :: words(5)
    integer :: first, last, k

    words = ''
    last = 0
    do k = 1, size(words)
      call find_column(line, last + 1, first, last)
      words(k) = lower_case(line(first:min(last, first + len(words) - 1)))
    end do
    if (words(1) /= BANNER) then
      reason = 'a Matrix Market file begins with a line like "'//banner_line(.false., .false.)//'"'
    else if (words(2) /= 'matrix') then
      reason = quoted(trim(words(2)))//' cannot be read, only "matrix"'
    else if (words(3) /= 'coordinate' .and. words(3) /= 'array') then
      reason = quoted(trim(words(3)))//' is not a supported format: use coordinate or array'
    else if (words(4) /= 'real' .and. words(4) /= 'integer') then
      reason = quoted(trim(words(4)))//' values are not supported: write a real or an integer matrix'
    else if (words(5) /= 'general' .and. words(5) /= 'symmetric') then
      reason = quoted(trim(words(5)))//' matrices are not supported: write a general or a symmetric one'
    else if (after_blanks(line, last + 1) <= len(line)) then
      reason = 'the first line has more than five words'
    end if
    layout%coordinate = words(3) == 'coordinate'
    layout%whole = words(4) == 'integer'
    layout%symmetric = words(5) == 'symmetric'
  end subroutine read_banner

  !> Read the numbers of rows, columns and, in coordinate format, entries; `reason` is allocated
  !> if they are missing or impossible.
  pure subroutine read_sizes(line, layout, reason)
    character(len=*), intent(in) :: line
    type(matrix_layout), intent(inout) :: layout
    character(len=:), allocatable, intent(out) :: reason
    integer(int64) :: sizes(3)
    integer :: first, last, k, kind, numbers

    numbers = merge(3, 2, layout%coordinate)
    sizes = 0_int64
    last = 0
    do k = 1, numbers
      call find_column(line, last + 1, first, last)
      call read_whole(line(first:last), kind, sizes(k))
      if (kind /= KIND_NUMBER) exit
    end do
    if (k <= numbers .or. after_blanks(line, last + 1) <= len(line)) then
      if (layout%coordinate) then
        reason = 'three whole numbers are needed here: rows, columns, entries'
      else
        reason = 'two whole numbers are needed here: rows, columns'
      end if
    else if (minval(sizes) < 0_int64 .or. maxval(sizes) >= int(huge(1), int64)) then
      reason = 'sizes must be from 0 to '//text(huge(1) - 1)
    else if (layout%symmetric .and. sizes(1) /= sizes(2)) then
      reason = 'a symmetric matrix needs as many rows as columns'
    end if
    if (allocated(reason)) return
    layout%rows = int(sizes(1))
    layout%columns = int(sizes(2))
    layout%entries = sizes(3)
    if (layout%coordinate) return
    layout%entries = sizes(1)*sizes(2)
    if (layout%symmetric) layout%entries = (sizes(1)*(sizes(1) + 1_int64))/2_int64
  end subroutine read_sizes

  !> Read a line of a coordinate file; `reason` is allocated if it cannot be used.
  pure subroutine read_entry(line, layout, row, column, value, reason)
    character(len=*), intent(in) :: line
    type(matrix_layout), intent(in) :: layout
    integer, intent(out) :: row, column
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(out) :: reason
    integer :: next

    next = 1
    column = 0
    value = 0.0_dp
    call read_index(line, next, 'row', layout%rows, row, reason)
    if (.not. allocated(reason)) call read_index(line, next, 'column', layout%columns, column, reason)
    if (.not. allocated(reason)) call read_last(line, next, layout%whole, value, reason)
    if (allocated(reason)) return
    if (layout%symmetric .and. row < column) reason = 'entry ('//text(row)//', '//text(column) &
      //') is above the diagonal: a symmetric file holds the lower triangle only'
  end subroutine read_entry

  !> Read a line of an array file; `reason` is allocated if it cannot be used.
  pure subroutine read_value(line, layout, value, reason)
    character(len=*), intent(in) :: line
    type(matrix_layout), intent(in) :: layout
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(out) :: reason
    integer :: next

    next = 1
    call read_last(line, next, layout%whole, value, reason)
  end subroutine read_value

  !> Read a row or column, called `name`, from position `next` on; `next` moves behind it.
  pure subroutine read_index(line, next, name, most, value, reason)
    character(len=*), intent(in) :: line, name
    integer, intent(inout) :: next
    integer, intent(in) :: most
    integer, intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    integer :: first, last

    call find_column(line, next, first, last)
    next = last + 1
    call read_label(line(first:last), name, 1, most, value, reason)
  end subroutine read_index

  !> Read the value from position `next` to the end of the line.
  pure subroutine read_last(line, next, whole, value, reason)
    character(len=*), intent(in) :: line
    integer, intent(inout) :: next
    logical, intent(in) :: whole
    real(dp), intent(out) :: value
    character(len=:), allocatable, intent(inout) :: reason
    integer(int64) :: number
    integer :: first, last, kind

    value = 0.0_dp
    call find_column(line, next, first, last)
    if (last < first) then
      reason = 'the value is missing'
      return
    end if
    call read_number(line(first:last), kind, value)
    if (kind /= KIND_NUMBER) then
      reason = describe_text(line(first:last), kind)
    else if (after_blanks(line, last + 1) <= len(line)) then
      reason = 'more than one entry on the line'
    else if (whole) then
      call read_whole(line(first:last), kind, number)
      if (kind /= KIND_NUMBER) reason = quoted(line(first:last))//' is not a whole number, although the banner says ' &
        //'integer'
    end if
  end subroutine read_last

end module fuge_matrix_market_lines
