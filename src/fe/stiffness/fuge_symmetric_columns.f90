!> A symmetric matrix in compressed columns, of which the upper triangle is kept: checks, products, columns.
module fuge_symmetric_columns
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_compressed_columns, only: append, compress_columns, compressed_columns, matrix_triplets, reserve
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_DOF, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
  use fuge_stiffness_check, only: check_entry, check_pair
  implicit none
  private

  !> A stiffness matrix in compressed columns.
  type, public :: symmetric_columns
    !> The upper triangle, each entry once, rows ascending.
    type(compressed_columns) :: upper
  contains
    procedure :: set
    procedure :: clear
    procedure :: degrees
    procedure :: diagonal
    procedure :: multiply
    procedure :: copy_columns
  end type symmetric_columns

contains

  !> Copy a matrix in compressed columns, counted from 1; rows in any order, repeated entries are added, both triangles
  !> or one of them.
  !>
  !> Errors, the matrix unchanged: FUGE_ERR_SIZE, FUGE_ERR_DOF for a row out of range, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_MEMORY.
  pure subroutine set(self, column, row, value, info)
    class(symmetric_columns), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(inout) :: info
    type(compressed_columns) :: lower, upper
    integer :: stat

    call check_columns(column, row, value, info)
    if (info%failed()) return
    call split_triangles(column, row, value, lower, upper, stat)
    call require_memory(stat, 'a copy of the stiffness matrix with', size(row), 'entries', info)
    if (stat /= 0) return
    if (.not. has_triangle(upper)) then
      call move_columns(lower, self%upper)
    else
      if (has_triangle(lower)) call check_symmetry(lower, upper, info)
      if (.not. info%failed()) call move_columns(upper, self%upper)
    end if
  end subroutine set

  !> Forget the matrix.
  pure subroutine clear(self)
    class(symmetric_columns), intent(inout) :: self

    if (allocated(self%upper%column)) deallocate (self%upper%column)
    if (allocated(self%upper%row)) deallocate (self%upper%row)
    if (allocated(self%upper%value)) deallocate (self%upper%value)
  end subroutine clear

  !> Move a matrix without a copy.
  pure subroutine move_columns(source, destination)
    type(compressed_columns), intent(inout) :: source, destination

    call move_alloc(source%column, destination%column)
    call move_alloc(source%row, destination%row)
    call move_alloc(source%value, destination%value)
  end subroutine move_columns

  !> Refuse columns that are not in order, rows out of range, and unusable values.
  pure subroutine check_columns(column, row, value, info)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, n, p

    n = size(column) - 1
    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'column has '//text(n + 1)//' value(s): it needs one more than the matrix ' &
                  //'has columns, and the matrix at least one')
      return
    else if (column(1) /= 1) then
      call report(info, FUGE_ERR_SIZE, 'column('//index_text(1)//') = '//index_text(column(1)) &
                  //': the first column starts at '//index_text(1))
      return
    end if
    do j = 1, n
      if (column(j + 1) >= column(j)) cycle
      call report(info, FUGE_ERR_SIZE, 'column('//index_text(j + 1)//') = '//index_text(column(j + 1)) &
                  //' is less than column('//index_text(j)//') = '//index_text(column(j)) &
                  //': each column begins where the one before it ends')
      return
    end do
    if (min(size(row), size(value)) < column(n + 1) - 1) then
      call report(info, FUGE_ERR_SIZE, 'row has '//text(size(row))//' and value '//text(size(value)) &
                  //' value(s): column('//index_text(n + 1)//') = '//index_text(column(n + 1))//' needs ' &
                  //text(column(n + 1) - 1)//' of each')
      return
    end if
    do j = 1, n
      do p = column(j), column(j + 1) - 1
        if (row(p) >= 1 .and. row(p) <= n) cycle
        call report(info, FUGE_ERR_DOF, 'row('//index_text(p)//') = '//index_text(row(p))//' in column ' &
                    //index_text(j)//' is not one of '//text(n)//' degrees of freedom')
        return
      end do
      do p = column(j), column(j + 1) - 1
        call check_entry(value(p), row(p), j, info)
        if (info%failed()) return
      end do
    end do
  end subroutine check_columns

  !> The upper triangle of K, and of its transpose: entry (i, j) of `lower` is entry (j, i)
  !> of K; both contain the diagonal.
  pure subroutine split_triangles(column, row, value, lower, upper, stat)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(compressed_columns), intent(out) :: lower, upper
    integer, intent(out) :: stat

    call compress_triangle(column, row, value, .false., lower, stat)
    if (stat == 0) call compress_triangle(column, row, value, .true., upper, stat)
  end subroutine split_triangles

  !> The upper triangle of K, or of its transpose if not `upper`; repeated entries are added.
  pure subroutine compress_triangle(column, row, value, upper, triangle, stat)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    logical, intent(in) :: upper
    type(compressed_columns), intent(out) :: triangle
    integer, intent(out) :: stat
    type(matrix_triplets) :: triplets
    integer :: j, n, overflow, p

    n = size(column) - 1
    call reserve(triplets, count_in_triangle(column, row, upper), stat)
    if (stat /= 0) return
    do j = 1, n
      do p = column(j), column(j + 1) - 1
        if (upper .and. row(p) <= j) then
          call append(triplets, row(p), j, value(p))
        else if (.not. upper .and. row(p) >= j) then
          call append(triplets, j, row(p), value(p))
        end if
      end do
    end do
    ! No sum overflows, because `check_entry` has refused entries near overflow.
    call compress_columns(triplets, n, n, triangle, overflow, stat)
  end subroutine compress_triangle

  !> Number of entries on and above the diagonal, or on and below it if not `upper`.
  pure function count_in_triangle(column, row, upper) result(entries)
    integer, intent(in) :: column(:), row(:)
    logical, intent(in) :: upper
    integer(int64) :: entries
    integer :: j

    entries = 0_int64
    do j = 1, size(column) - 1
      associate (rows => row(column(j):column(j + 1) - 1))
        if (upper) then
          entries = entries + int(count(rows <= j), int64)
        else
          entries = entries + int(count(rows >= j), int64)
        end if
      end associate
    end do
  end function count_in_triangle

  !> Does the matrix have entries off the diagonal?
  pure function has_triangle(matrix) result(filled)
    type(compressed_columns), intent(in) :: matrix
    logical :: filled
    integer :: j

    filled = .false.
    do j = 1, size(matrix%column) - 1
      if (matrix%column(j + 1) == matrix%column(j)) cycle
      filled = matrix%row(matrix%column(j)) < j
      if (filled) return
    end do
  end function has_triangle

  !> Refuse triangles that differ; a missing entry counts as zero.
  pure subroutine check_symmetry(lower, upper, info)
    type(compressed_columns), intent(in) :: lower, upper
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: diagonal(:)
    real(dp) :: above, below
    integer :: i, j, p, q, stat

    allocate (diagonal(size(upper%column) - 1), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to check the symmetry of the stiffness matrix')
      return
    end if
    call find_diagonal(upper, diagonal)
    do j = 1, size(diagonal)
      p = upper%column(j)
      q = lower%column(j)
      do
        i = min(row_at(upper, j, p), row_at(lower, j, q))
        if (i > j) exit
        above = 0.0_dp
        below = 0.0_dp
        if (row_at(upper, j, p) == i) then
          above = upper%value(p)
          p = p + 1
        end if
        if (row_at(lower, j, q) == i) then
          below = lower%value(q)
          q = q + 1
        end if
        call check_pair(i, j, above, below, diagonal(i), diagonal(j), info)
        if (info%failed()) return
      end do
    end do
  end subroutine check_symmetry

  !> Row of entry p of column j; j + 1, below the diagonal, where the column has ended.
  pure function row_at(matrix, j, p) result(i)
    type(compressed_columns), intent(in) :: matrix
    integer, intent(in) :: j, p
    integer :: i

    i = j + 1
    if (p < matrix%column(j + 1)) i = matrix%row(p)
  end function row_at

  !> The diagonal `terms` of a matrix from its upper triangle.
  pure subroutine find_diagonal(upper, terms)
    type(compressed_columns), intent(in) :: upper
    real(dp), intent(out) :: terms(:)
    integer :: j, p

    terms = 0.0_dp
    do j = 1, size(terms)
      p = upper%column(j + 1) - 1
      if (p < upper%column(j)) cycle
      if (upper%row(p) == j) terms(j) = upper%value(p)
    end do
  end subroutine find_diagonal

  !> Number of degrees of freedom; 0 before `set`.
  pure function degrees(self)
    class(symmetric_columns), intent(in) :: self
    integer :: degrees

    degrees = 0
    if (allocated(self%upper%column)) degrees = size(self%upper%column) - 1
  end function degrees

  !> The diagonal of K: `terms` (degrees), force per displacement.
  pure subroutine diagonal(self, terms)
    class(symmetric_columns), intent(in) :: self
    real(dp), intent(out) :: terms(:)

    call find_diagonal(self%upper, terms)
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(symmetric_columns), intent(in) :: self
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: product(:), magnitude(:)
    real(dp) :: term
    integer :: i, j, p

    product = 0.0_dp
    magnitude = 0.0_dp
    do j = 1, self%degrees()
      do p = self%upper%column(j), self%upper%column(j + 1) - 1
        i = self%upper%row(p)
        term = self%upper%value(p)
        product(i) = product(i) + term*u(j)
        magnitude(i) = magnitude(i) + abs(term*u(j))
        if (i == j) cycle
        product(j) = product(j) + term*u(i)
        magnitude(j) = magnitude(j) + abs(term*u(i))
      end do
    end do
  end subroutine multiply

  !> Columns of K; arguments as in `fuge_stiffness_type`.
  pure subroutine copy_columns(self, chosen, block)
    class(symmetric_columns), intent(in) :: self
    integer, intent(in) :: chosen(:)
    real(dp), intent(out), contiguous :: block(:, :)
    integer :: i, j, k, p

    block = 0.0_dp
    ! Columns are few: a look at all entries for each of them needs no memory.
    do k = 1, size(chosen)
      do j = 1, size(block, 1)
        do p = self%upper%column(j), self%upper%column(j + 1) - 1
          i = self%upper%row(p)
          if (i == chosen(k)) block(j, k) = self%upper%value(p)
          if (j == chosen(k)) block(i, k) = self%upper%value(p)
        end do
      end do
    end do
  end subroutine copy_columns

end module fuge_symmetric_columns
