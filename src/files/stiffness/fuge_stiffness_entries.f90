!> The entries of a stiffness matrix as they come from a file, and the compressed columns that are made from them.
!>
!> A file may hold one triangle, or entries on both sides of the diagonal so that each pair of positions has one, or the
!> whole matrix. The matrix that is returned has both triangles.
module fuge_stiffness_entries
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_compressed_columns, only: compressed_columns, matrix_triplets, order_triplets
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: make_columns, no_memory

  !> Entries in the order of the file.
  type, public :: stiffness_entries
    integer :: count = 0
    integer, allocatable :: row(:), column(:)
    real(dp), allocatable :: value(:)
    !> The line of each entry.
    integer, allocatable :: line(:)
    !> Number of rows; 0 if only the entries say so.
    integer :: rows = 0
    !> The names of the rows, if the entries have them; row and column are then numbers in this table.
    type(row_table) :: names
    !> The file has both triangles: an entry that is missing is zero. Otherwise it may be that of the other triangle.
    logical :: whole = .false.
  contains
    procedure :: append
  end type stiffness_entries

contains

  !> Add an entry. `status` is not zero without memory.
  pure subroutine append(self, row, column, value, line, status)
    class(stiffness_entries), intent(inout) :: self
    integer, intent(in) :: row, column, line
    real(dp), intent(in) :: value
    integer, intent(out) :: status

    status = 0
    call make_room(self%row, self%count, status)
    call make_room(self%column, self%count, status)
    call make_room(self%value, self%count, status)
    call make_room(self%line, self%count, status)
    if (status /= 0) return
    self%count = self%count + 1
    self%row(self%count) = row
    self%column(self%count) = column
    self%value(self%count) = value
    self%line(self%count) = line
  end subroutine append

  !> Report that there is no memory for the entries of a file (FUGE_ERR_MEMORY).
  pure subroutine no_memory(file, info)
    type(text_file), intent(in) :: file
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, file%name//': no memory for its entries up to line '//text(file%line))
  end subroutine no_memory

  !> Sort the entries into compressed columns of both triangles, rows ascending, and find the node and the direction of
  !> each row, 0 where no name is known. `entries` is used up.
  !> Errors: FUGE_ERR_FILE with the line of a position that is given twice, or if there are fewer entries than rows;
  !> FUGE_ERR_MEMORY.
  pure subroutine make_columns(file, entries, matrix, node, direction, info)
    type(text_file), intent(inout) :: file
    type(stiffness_entries), intent(inout) :: entries
    type(compressed_columns), intent(inout) :: matrix
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    type(matrix_triplets) :: lower
    integer, allocatable :: order(:), begin(:)
    logical, allocatable :: above(:)
    integer :: repeated, rows, status

    call name_rows(file, entries, rows, node, direction, info)
    if (info%failed()) return
    call fold(entries, lower, above, status)
    if (status == 0) call order_triplets(lower, rows, rows, order, begin, status)
    if (status /= 0) then
      call no_memory(file, info)
      return
    end if
    call find_repeated(lower, above, order, entries%line, repeated)
    if (repeated > 0) then
      file%line = entries%line(repeated)
      call file%refuse(trim(repetition(lower%row(repeated), lower%column(repeated), node, direction)), info)
      return
    end if
    call unfold(lower, above, order, begin, entries%whole, matrix, status)
    if (status /= 0) call no_memory(file, info)
  end subroutine make_columns

  !> Number the rows: by nodes and directions if the entries name them. `entries` then has the numbers of the rows.
  pure subroutine name_rows(file, entries, rows, node, direction, info)
    type(text_file), intent(in) :: file
    type(stiffness_entries), intent(inout) :: entries
    integer, intent(out) :: rows
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: new_row(:)
    integer :: n, status

    n = entries%count
    rows = entries%rows
    status = 0
    if (n == 0) then
      call report(info, FUGE_ERR_FILE, file%name//' has no entry of a matrix')
    else if (entries%names%count > 0) then
      rows = entries%names%count
      call entries%names%sort(new_row, node, direction, status)
      if (status == 0) then
        entries%row(:n) = new_row(entries%row(:n))
        entries%column(:n) = new_row(entries%column(:n))
      end if
    else if (rows == 0) then
      rows = max(maxval(entries%row(:n)), maxval(entries%column(:n)))
    end if
    if (info%failed()) return
    if (rows > n) then
      call report(info, FUGE_ERR_FILE, file%name//' has '//text(n)//' entries for '//text(rows)//' rows: each row of ' &
                  //'a stiffness matrix has one on the diagonal')
    else if (status == 0 .and. .not. allocated(node)) then
      allocate (node(rows), direction(rows), stat=status)
      if (status == 0) then
        node = 0
        direction = 0
      end if
    end if
    if (status /= 0) call no_memory(file, info)
  end subroutine name_rows

  !> Bring all entries below the diagonal; `above` are those that were above it. The entries are moved, lines are kept.
  pure subroutine fold(entries, lower, above, status)
    type(stiffness_entries), intent(inout) :: entries
    type(matrix_triplets), intent(inout) :: lower
    logical, allocatable, intent(out) :: above(:)
    integer, intent(out) :: status
    integer :: i, k

    allocate (above(entries%count), stat=status)
    if (status /= 0) return
    lower%count = entries%count
    call move_alloc(entries%row, lower%row)
    call move_alloc(entries%column, lower%column)
    call move_alloc(entries%value, lower%value)
    do k = 1, lower%count
      i = lower%row(k)
      above(k) = i < lower%column(k)
      if (.not. above(k)) cycle
      lower%row(k) = lower%column(k)
      lower%column(k) = i
    end do
  end subroutine fold

  !> Are two folded entries of one pair of positions, or of one position of the diagonal?
  pure function same_pair(lower, a, b) result(same)
    type(matrix_triplets), intent(in) :: lower
    integer, intent(in) :: a, b
    logical :: same

    same = lower%row(a) == lower%row(b)
    if (same) same = lower%column(a) == lower%column(b)
  end function same_pair

  !> The first entry in the file whose position another one had before; 0 if there is none.
  pure subroutine find_repeated(lower, above, order, line, repeated)
    type(matrix_triplets), intent(in) :: lower
    logical, intent(in) :: above(:)
    integer, intent(in) :: order(:), line(:)
    integer, intent(out) :: repeated
    integer :: j, k

    repeated = 0
    do k = 2, size(order)
      ! A pair has two entries at most: among three neighbours two are of one side.
      do j = k - 1, max(1, k - 2), -1
        if (.not. same_pair(lower, order(j), order(k))) exit
        if (above(order(j)) .neqv. above(order(k))) cycle
        if (repeated == 0) then
          repeated = order(k)
        else if (line(order(k)) < line(repeated)) then
          repeated = order(k)
        end if
      end do
    end do
  end subroutine find_repeated

  pure function row_name(k, node, direction) result(name)
    integer, intent(in) :: k, node(:), direction(:)
    character(len=60) :: name

    name = 'row '//text(k)
    if (node(k) /= 0) name = 'node '//text(node(k))//', direction '//text(direction(k))
  end function row_name

  !> Why an entry is refused whose position another one had before.
  pure function repetition(i, j, node, direction) result(reason)
    integer, intent(in) :: i, j, node(:), direction(:)
    character(len=200) :: reason

    reason = 'a second entry for '//trim(row_name(i, node, direction))//' and '//trim(row_name(j, node, direction)) &
      //': the file was written twice, or into another one'
  end function repetition

  !> Compressed columns of both triangles from the sorted lower one, in which a pair of positions has one entry or two
  !> neighbours. An entry that is missing is its partner's value, unless the file has some pair of two, and so the whole
  !> matrix, or is `given_whole`.
  pure subroutine unfold(lower, above, order, begin, given_whole, matrix, status)
    type(matrix_triplets), intent(in) :: lower
    logical, intent(in) :: above(:), given_whole
    integer, intent(in) :: order(:), begin(:)
    type(compressed_columns), intent(inout) :: matrix
    integer, intent(out) :: status
    integer, allocatable :: next(:)
    integer(int64) :: entries
    integer :: i, j, k
    logical :: whole

    whole = given_whole
    do k = 2, size(order)
      if (whole) exit
      whole = same_pair(lower, order(k - 1), order(k))
    end do
    entries = int(size(order), int64)
    if (.not. whole) entries = entries + int(count(lower%row(:lower%count) /= lower%column(:lower%count)), int64)
    status = 1
    if (entries >= int(huge(1), int64)) return
    allocate (matrix%column(size(begin)), matrix%row(entries), matrix%value(entries), next(size(begin)), stat=status)
    if (status /= 0) return
    call count_columns(lower, above, whole, matrix%column)
    next = matrix%column
    ! Columns before j have filled column j above the diagonal, rows ascending.
    do j = 1, size(begin) - 1
      do k = begin(j), begin(j + 1) - 1
        i = lower%row(order(k))
        if (.not. whole .or. .not. above(order(k))) call put(matrix, next(j), i, lower%value(order(k)))
        if (i == j) cycle
        if (.not. whole .or. above(order(k))) call put(matrix, next(i), j, lower%value(order(k)))
      end do
    end do
  end subroutine unfold

  !> Set an entry at position `next`, which moves on.
  pure subroutine put(matrix, next, row, value)
    type(compressed_columns), intent(inout) :: matrix
    integer, intent(inout) :: next
    integer, intent(in) :: row
    real(dp), intent(in) :: value

    matrix%row(next) = row
    matrix%value(next) = value
    next = next + 1
  end subroutine put

  !> Where each column begins.
  pure subroutine count_columns(lower, above, whole, column)
    type(matrix_triplets), intent(in) :: lower
    logical, intent(in) :: above(:), whole
    integer, intent(out) :: column(:)
    integer :: j, k

    column = 0
    do k = 1, lower%count
      if (.not. whole .or. .not. above(k)) column(lower%column(k) + 1) = column(lower%column(k) + 1) + 1
      if (lower%row(k) == lower%column(k)) cycle
      if (.not. whole .or. above(k)) column(lower%row(k) + 1) = column(lower%row(k) + 1) + 1
    end do
    column(1) = 1
    do j = 2, size(column)
      column(j) = column(j) + column(j - 1)
    end do
  end subroutine count_columns

end module fuge_stiffness_entries
