!> A sparse stiffness matrix, factorised by CHOLMOD: a component of its own, so that who
!> does not need it need not link it.
module fuge_sparse
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_associated
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_MEMORY
  use fuge_stiffness_check, only: check_entry, check_pair
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_number_text, only: text
  implicit none
  private

  !> What fuge_cholmod_factorise says when it finds no memory.
  integer(c_int), parameter :: NO_MEMORY = 2

  !> Rows and values of compressed columns, the rows of each column ascending.
  type :: compressed_columns
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
  end type compressed_columns

  !> A sparse stiffness matrix in compressed columns: `set` it, then condense.
  type, extends(fuge_stiffness), public :: fuge_sparse_stiffness
    !> The upper triangle, each entry once.
    type(compressed_columns), private :: upper
  contains
    procedure :: set
    procedure :: degrees
    procedure :: diagonal
    procedure :: multiply
    procedure :: factorise
  end type fuge_sparse_stiffness

  type, extends(stiffness_factor) :: sparse_factor
    type(c_ptr) :: cholmod = c_null_ptr
  contains
    procedure :: solve
    final :: release
  end type sparse_factor

  interface
    !> fuge_cholmod.c: least pivot relative to `diagonal`; 0 done, 1 not definite, 2 no memory.
    function cholmod_factorise(n, column, row, value, diagonal, factor, pivot, weakest) &
      bind(c, name='fuge_cholmod_factorise') result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n
      integer(c_int), intent(in) :: column(*), row(*)
      real(c_double), intent(in) :: value(*), diagonal(*)
      type(c_ptr), intent(out) :: factor
      real(c_double), intent(out) :: pivot
      integer(c_int), intent(out) :: weakest
      integer(c_int) :: status
    end function cholmod_factorise

    function cholmod_solve(factor, n, columns, block) bind(c, name='fuge_cholmod_solve') result(status)
      import :: c_int, c_double, c_ptr
      type(c_ptr), intent(in), value :: factor
      integer(c_int), intent(in), value :: n, columns
      real(c_double), intent(inout) :: block(n, *)
      integer(c_int) :: status
    end function cholmod_solve

    subroutine cholmod_free(factor) bind(c, name='fuge_cholmod_free')
      import :: c_ptr
      type(c_ptr), intent(in), value :: factor
    end subroutine cholmod_free
  end interface

contains

  !> Take a matrix in compressed columns, counted from 1.
  !>
  !> `column` (degrees + 1), `row` and `value` (column(degrees + 1) - 1): column j holds
  !> the entries column(j) .. column(j + 1) - 1, rows in any order, those named twice are
  !> added. Both triangles, or one of them. Force per displacement. It is copied.
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_DOF for a row out of range, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_MEMORY; the stiffness is then as
  !> it was.
  subroutine set(self, column, row, value, info)
    class(fuge_sparse_stiffness), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info
    type(compressed_columns) :: lower, upper
    integer :: stat

    call check_columns(column, row, value, info)
    if (info%failed()) return
    call split_triangles(column, row, value, lower, upper, stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of the stiffness matrix with '//text(size(row)) &
                  //' entries')
      return
    end if
    if (.not. has_triangle(upper)) then
      call take(lower, self%upper)
    else
      if (has_triangle(lower)) call check_symmetry(lower, upper, info)
      if (.not. info%failed()) call take(upper, self%upper)
    end if
  end subroutine set

  !> Move without a copy.
  pure subroutine take(source, destination)
    type(compressed_columns), intent(inout) :: source, destination

    call move_alloc(source%column, destination%column)
    call move_alloc(source%row, destination%row)
    call move_alloc(source%value, destination%value)
  end subroutine take

  !> Do the columns make sense?
  pure subroutine check_columns(column, row, value, info)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, n, p

    n = size(column) - 1
    if (n < 1) then
      call report(info, FUGE_ERR_SIZE, 'column has '//text(n + 1)//' value(s): it needs one more than there are ' &
                  //'columns')
      return
    else if (column(1) /= 1) then
      call report(info, FUGE_ERR_SIZE, 'column(1) = '//text(column(1))//': columns and rows count from 1')
      return
    end if
    do j = 1, n
      if (column(j + 1) >= column(j)) cycle
      call report(info, FUGE_ERR_SIZE, 'column('//text(j + 1)//') = '//text(column(j + 1))//' is less than the one ' &
                  //'before it: column j ends where j + 1 begins')
      return
    end do
    if (min(size(row), size(value)) < column(n + 1) - 1) then
      call report(info, FUGE_ERR_SIZE, 'row has '//text(size(row))//' and value '//text(size(value)) &
                  //' entries: column asks for '//text(column(n + 1) - 1))
      return
    end if
    do j = 1, n
      do p = column(j), column(j + 1) - 1
        if (row(p) >= 1 .and. row(p) <= n) cycle
        call report(info, FUGE_ERR_DOF, 'row('//text(p)//') = '//text(row(p))//' in column '//text(j) &
                    //' is not one of '//text(n)//' degrees of freedom')
        return
      end do
      do p = column(j), column(j + 1) - 1
        call check_entry(value(p), row(p), j, info)
        if (info%failed()) return
      end do
    end do
  end subroutine check_columns

  !> The upper triangle of K, and of its transpose: entry (i, j) of `lower` is entry (j, i)
  !> of K; the diagonal is in both.
  pure subroutine split_triangles(column, row, value, lower, upper, stat)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(compressed_columns), intent(out) :: lower, upper
    integer, intent(out) :: stat
    type(compressed_columns) :: transposed, sorted

    call transpose_columns(column, row, value, transposed, stat)
    if (stat == 0) call transpose_columns(transposed%column, transposed%row, transposed%value, sorted, stat)
    if (stat == 0) call keep_upper(transposed, lower, stat)
    if (stat == 0) call keep_upper(sorted, upper, stat)
  end subroutine split_triangles

  !> The transposed matrix, by a counting sort: its rows ascend in each column.
  pure subroutine transpose_columns(column, row, value, transposed, stat)
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(compressed_columns), intent(out) :: transposed
    integer, intent(out) :: stat
    integer :: entries, j, n, p, q

    n = size(column) - 1
    entries = column(n + 1) - 1
    allocate (transposed%column(n + 1), transposed%row(entries), transposed%value(entries), stat=stat)
    if (stat /= 0) return
    transposed%column = 0
    do p = 1, entries
      transposed%column(row(p)) = transposed%column(row(p)) + 1
    end do
    ! Each column's end, which then moves down to its beginning.
    transposed%column(n + 1) = entries + 1
    do j = n, 1, -1
      transposed%column(j) = transposed%column(j + 1) - transposed%column(j)
    end do
    transposed%column(:n) = [transposed%column(2:)]
    do j = n, 1, -1
      do p = column(j + 1) - 1, column(j), -1
        q = transposed%column(row(p)) - 1
        transposed%column(row(p)) = q
        transposed%row(q) = j
        transposed%value(q) = value(p)
      end do
    end do
  end subroutine transpose_columns

  !> The entries on and above the diagonal, those named twice added.
  pure subroutine keep_upper(sorted, upper, stat)
    type(compressed_columns), intent(in) :: sorted
    type(compressed_columns), intent(out) :: upper
    integer, intent(out) :: stat
    integer :: j, n, p, q

    n = size(sorted%column) - 1
    allocate (upper%column(n + 1), upper%row(size(sorted%row)), upper%value(size(sorted%row)), stat=stat)
    if (stat /= 0) return
    q = 0
    upper%column(1) = 1
    do j = 1, n
      do p = sorted%column(j), sorted%column(j + 1) - 1
        if (sorted%row(p) > j) exit
        if (q >= upper%column(j)) then
          if (upper%row(q) == sorted%row(p)) then
            upper%value(q) = upper%value(q) + sorted%value(p)
            cycle
          end if
        end if
        q = q + 1
        upper%row(q) = sorted%row(p)
        upper%value(q) = sorted%value(p)
      end do
      upper%column(j + 1) = q + 1
    end do
    call shorten(upper, q, stat)
  end subroutine keep_upper

  !> Give back what is not needed.
  pure subroutine shorten(matrix, entries, stat)
    type(compressed_columns), intent(inout) :: matrix
    integer, intent(in) :: entries
    integer, intent(out) :: stat
    integer, allocatable :: row(:)
    real(dp), allocatable :: value(:)

    allocate (row(entries), value(entries), stat=stat)
    if (stat /= 0) return
    row = matrix%row(:entries)
    value = matrix%value(:entries)
    call move_alloc(row, matrix%row)
    call move_alloc(value, matrix%value)
  end subroutine shorten

  !> Are there entries beside the diagonal?
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

  !> Compare the triangles; an entry that is missing is zero.
  pure subroutine check_symmetry(lower, upper, info)
    type(compressed_columns), intent(in) :: lower, upper
    type(fuge_info), intent(inout) :: info
    real(dp) :: diagonal(size(upper%column) - 1), above, below
    integer :: i, j, p, q

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

  !> Row of entry p of column j, beyond the diagonal where the column has ended.
  pure function row_at(matrix, j, p) result(i)
    type(compressed_columns), intent(in) :: matrix
    integer, intent(in) :: j, p
    integer :: i

    i = j + 1
    if (p < matrix%column(j + 1)) i = matrix%row(p)
  end function row_at

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
    class(fuge_sparse_stiffness), intent(in) :: self
    integer :: degrees

    degrees = 0
    if (allocated(self%upper%column)) degrees = size(self%upper%column) - 1
  end function degrees

  !> The diagonal of K: `terms` (degrees), force per displacement.
  pure subroutine diagonal(self, terms)
    class(fuge_sparse_stiffness), intent(in) :: self
    real(dp), intent(out) :: terms(:)

    call find_diagonal(self%upper, terms)
  end subroutine diagonal

  !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
  pure subroutine multiply(self, u, product, magnitude)
    class(fuge_sparse_stiffness), intent(in) :: self
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

  !> Cholesky factor without the rows and columns `held`; arguments as in `fuge_stiffness_type`.
  subroutine factorise(self, held, shift, factor, pivot, weakest, status)
    class(fuge_sparse_stiffness), intent(in) :: self
    logical, intent(in) :: held(:)
    real(dp), intent(in) :: shift
    class(stiffness_factor), allocatable, intent(out) :: factor
    real(dp), intent(out) :: pivot
    integer, intent(out) :: weakest, status
    type(sparse_factor), allocatable :: own
    type(compressed_columns) :: free
    real(dp), allocatable :: terms(:)
    integer(c_int) :: outcome, place
    integer :: stat

    pivot = 0.0_dp
    weakest = 0
    status = FUGE_ERR_MEMORY
    call keep_free(self%upper, held, shift, free, stat)
    if (stat == 0) allocate (own, terms(size(held)), stat=stat)
    if (stat /= 0) return
    call find_diagonal(self%upper, terms)
    where (held) terms = 1.0_dp
    outcome = cholmod_factorise(int(size(held), c_int), free%column, free%row, free%value, terms, own%cholmod, pivot, &
                                place)
    weakest = int(place)
    if (outcome == NO_MEMORY) return
    status = FUGE_DONE
    if (outcome == 0) call move_alloc(own, factor)
  end subroutine factorise

  !> The upper triangle with rows and columns that are held replaced by those of the identity.
  pure subroutine keep_free(upper, held, shift, free, stat)
    type(compressed_columns), intent(in) :: upper
    logical, intent(in) :: held(:)
    real(dp), intent(in) :: shift
    type(compressed_columns), intent(out) :: free
    integer, intent(out) :: stat
    integer :: i, j, p, q

    allocate (free%column(size(upper%column)), free%row(size(upper%row) + count(held)), &
              free%value(size(upper%row) + count(held)), stat=stat)
    if (stat /= 0) return
    q = 0
    free%column(1) = 1
    do j = 1, size(held)
      if (held(j)) then
        q = q + 1
        free%row(q) = j
        free%value(q) = 1.0_dp
      else
        do p = upper%column(j), upper%column(j + 1) - 1
          i = upper%row(p)
          if (held(i)) cycle
          q = q + 1
          free%row(q) = i
          free%value(q) = upper%value(p)
          if (i == j) free%value(q) = free%value(q)*(1.0_dp + shift)
        end do
      end if
      free%column(j + 1) = q + 1
    end do
  end subroutine keep_free

  subroutine solve(self, block, status)
    class(sparse_factor), intent(in) :: self
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: status
    integer(c_int) :: outcome

    outcome = cholmod_solve(self%cholmod, int(size(block, 1), c_int), int(size(block, 2), c_int), block)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, outcome == 0)
  end subroutine solve

  subroutine release(self)
    type(sparse_factor), intent(inout) :: self

    if (c_associated(self%cholmod)) call cholmod_free(self%cholmod)
    self%cholmod = c_null_ptr
  end subroutine release

end module fuge_sparse
