!> Plans for transforms of many complex numbers as a grid, so that each part of it is done in cache and by one thread
!> (D. H. Bailey, FFTs in external or hierarchical memory, 1990).
!>
!> M = R C numbers z_j are R rows of C: number j = c + C r is in column c and row r. The columns are transformed, number
!> p of column c is multiplied by exp(-2 pi i p c/M), and the rows are transformed: place q of row p is then the wave
!> p + R q. On the way back real and imaginary parts are exchanged: then the same transforms and the same factors serve.
!>
!> For a circle on which what has gone once round changes its sign (fuge_convolution), the numbers are multiplied by
!> exp(-i pi j/(2 M)) before the transform, and by its conjugate after it: by exp(-i pi r/(2 R)) in row r, and with
!> p + 1/4 in place of p above.
module fuge_split_plan
  use, intrinsic :: iso_c_binding, only: c_double
  use fuge_fft, only: fft_plan
  use fuge_kept_rows, only: free_rows, kept_rows, take_rows, taken_rows
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  use fuge_threads, only: threads_here
  use fuge_unit_roots, only: quarter_root, root_of_one
  implicit none
  private

  public :: blocks_of_columns, get_columns, line_stride, multiply_row, put_columns, take_work

  !> Columns for which each row has factors; those of others are their products with the factors of every NEAR-th one.
  integer, parameter :: NEAR = 32

  !> C is at least as large: columns of values that are transformed together.
  integer, parameter, public :: COLUMN_BLOCK = 32
  !> Lines of a thread: the complex columns of both circles, and one in which the first is transformed.
  integer, parameter, public :: LINES_OF_THREAD = 2*COLUMN_BLOCK + 1

  !> Transforms of one grid.
  type, public :: split_plan
    !> R and C >= R, an even number >= COLUMN_BLOCK; 0 before `set`.
    integer :: rows = 0, columns = 0
    type(fft_plan) :: along_column, along_row
    !> exp(-i pi r/(2 R)), (2, 0:R-1): real and imaginary parts.
    real(dp), allocatable :: row_twist(:, :)
    !> exp(-2 pi i p c/M) for c = 0, 1, .. NEAR - 1 and c = 0, NEAR, 2 NEAR, .., (2, :, p = 0:R-1, 0:1); last those of
    !> p + 1/4.
    real(dp), allocatable, private :: near_factors(:, :, :, :), far_factors(:, :, :, :)
    !> Belongs to the variable that owns the plans.
    type(kept_rows), pointer :: kept => null()
  contains
    procedure :: set => set_plan
    procedure :: multiply_by_factors
    procedure :: copy_from => copy_plan
    procedure :: move_from => move_plan
    final :: release_plan
  end type split_plan

contains

  !> Plan transforms of `rows` by `columns` >= `rows` complex numbers, `columns` even and at least
  !> COLUMN_BLOCK.
  !>
  !> `measured` as in fuge_fft. Errors, the plan unchanged: FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED.
  subroutine set_plan(self, rows, columns, info, measured)
    class(split_plan), intent(inout) :: self
    integer, intent(in) :: rows, columns
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: measured
    type(split_plan) :: new

    call prepare_plan(new, rows, columns, info, measured)
    if (.not. info%failed()) call self%move_from(new)
  end subroutine set_plan

  !> Set a plan that has nothing yet, but perhaps factors of the right sizes. Errors as in `set`.
  subroutine prepare_plan(plan, rows, columns, info, measured)
    type(split_plan), intent(inout) :: plan
    integer, intent(in) :: rows, columns
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: measured
    integer :: stat

    call plan%along_column%set(2*rows, info, measured=measured, separate=.true.)
    if (.not. info%failed()) call plan%along_row%set(2*columns, info, measured=measured, separate=.true.)
    if (info%failed()) return
    stat = 0
    if (.not. allocated(plan%row_twist)) then
      allocate (plan%row_twist(2, 0:rows - 1), plan%near_factors(2, 0:NEAR - 1, 0:rows - 1, 0:1), &
                plan%far_factors(2, 0:(columns - 1)/NEAR, 0:rows - 1, 0:1), stat=stat)
    end if
    if (stat == 0) allocate (plan%kept, stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a transform of '//text(2*rows*columns)//' values')
      return
    end if
    call compute_factors(rows, rows*columns, plan%row_twist, plan%near_factors, plan%far_factors)
    plan%rows = rows
    plan%columns = columns
  end subroutine prepare_plan

  !> The factors of a transform of `numbers` complex numbers in `rows` rows.
  pure subroutine compute_factors(rows, numbers, row_twist, near_factors, far_factors)
    integer, intent(in) :: rows, numbers
    real(dp), intent(inout) :: row_twist(:, 0:), near_factors(:, 0:, 0:, 0:), far_factors(:, 0:, 0:, 0:)
    integer :: c, p

    do p = 0, rows - 1
      row_twist(:, p) = quarter_root(p, rows)
      do c = 0, NEAR - 1
        near_factors(:, c, p, 0) = root_of_one(modulo(p*c, numbers), numbers)
        near_factors(:, c, p, 1) = root_of_one(modulo((4*p + 1)*c, 4*numbers), 4*numbers)
      end do
      do c = 0, ubound(far_factors, 2)
        far_factors(:, c, p, 0) = root_of_one(p*c*NEAR, numbers)
        far_factors(:, c, p, 1) = root_of_one((4*p + 1)*c*NEAR, 4*numbers)
      end do
    end do
  end subroutine compute_factors

  !> Multiply `row` p, from 0, by its factors, and return them: real and imaginary parts of C numbers. `twisted`: those
  !> of p + 1/4.
  pure subroutine multiply_by_factors(self, p, twisted, row, factors)
    class(split_plan), intent(in) :: self
    integer, intent(in) :: p
    logical, intent(in) :: twisted
    real(c_double), intent(inout), contiguous :: row(:), factors(:)
    integer :: begin, c, kind

    kind = merge(1, 0, twisted)
    do c = 0, ubound(self%far_factors, 2)
      begin = 2*NEAR*c
      call multiply_near(min(NEAR, self%columns - NEAR*c), self%far_factors(:, c, p, kind), &
                         self%near_factors(:, :, p, kind), row(begin + 1:), factors(begin + 1:))
    end do
  end subroutine multiply_by_factors

  !> `factors` = `far` times `near_factors`, and `z` = `z` times these, `n` complex numbers.
  pure subroutine multiply_near(n, far, near_factors, z, factors)
    integer, intent(in) :: n
    real(dp), intent(in) :: far(2), near_factors(2, n)
    real(c_double), intent(inout) :: z(2, n), factors(2, n)
    real(dp) :: v, w(2)
    integer :: k

    do k = 1, n
      w(1) = near_factors(1, k)*far(1) - near_factors(2, k)*far(2)
      w(2) = near_factors(1, k)*far(2) + near_factors(2, k)*far(1)
      factors(1, k) = w(1)
      factors(2, k) = w(2)
      v = z(1, k)
      z(1, k) = v*w(1) - z(2, k)*w(2)
      z(2, k) = v*w(2) + z(2, k)*w(1)
    end do
  end subroutine multiply_near

  !> Real numbers from one line of a buffer to the next, for a row or a column: lines whose distance is a multiple of a
  !> power of two would displace each other from the cache.
  pure function line_stride(plan) result(stride)
    type(split_plan), intent(in) :: plan
    integer :: stride

    stride = 2*max(plan%rows, plan%columns) + 8
  end function line_stride

  !> How many times COLUMN_BLOCK columns are transformed together.
  pure function blocks_of_columns(plan) result(blocks)
    type(split_plan), intent(in) :: plan
    integer :: blocks

    blocks = (plan%columns - 1)/COLUMN_BLOCK + 1
  end function blocks_of_columns

  !> Take room for R lines of each of two circles and LINES_OF_THREAD lines of each of `threads`, to be returned. All of
  !> it even if less is needed, because it is kept. `status` as in `take_rows`.
  subroutine take_work(plan, threads, taken, work, status)
    type(split_plan), intent(in) :: plan
    integer, intent(out) :: threads
    type(taken_rows), intent(out) :: taken
    real(c_double), pointer, contiguous, intent(out) :: work(:, :)
    integer, intent(out) :: status

    ! More threads would have no columns.
    threads = min(threads_here(), blocks_of_columns(plan))
    call take_rows(plan%kept, line_stride(plan), 2*plan%rows + LINES_OF_THREAD*threads, taken, work, status)
  end subroutine take_work

  !> Copy `count` columns of `table`, from number `place` (from 0) on, to the lines of a buffer. The rows of the table
  !> are lines of complex numbers.
  pure subroutine get_columns(table, place, count, lines)
    real(c_double), intent(in), contiguous :: table(:, :)
    integer, intent(in) :: place, count
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: c, r

    do r = 1, size(table, 2)
      do c = 1, count
        lines(2*r - 1, c) = table(2*(place + c) - 1, r)
        lines(2*r, c) = table(2*(place + c), r)
      end do
    end do
  end subroutine get_columns

  !> The reverse of `get_columns`.
  pure subroutine put_columns(lines, place, count, table)
    real(c_double), intent(in), contiguous :: lines(:, :)
    integer, intent(in) :: place, count
    real(c_double), intent(inout), contiguous :: table(:, :)
    integer :: c, r

    do r = 1, size(table, 2)
      do c = 1, count
        table(2*(place + c) - 1, r) = lines(2*r - 1, c)
        table(2*(place + c), r) = lines(2*r, c)
      end do
    end do
  end subroutine put_columns

  !> Multiply complex numbers, `z` (n real and imaginary parts), by others.
  pure subroutine multiply_row(n, factors, z)
    integer, intent(in) :: n
    real(c_double), intent(in) :: factors(n)
    real(c_double), intent(inout) :: z(n)
    real(c_double) :: real_part
    integer :: k

    do k = 1, n, 2
      real_part = z(k)*factors(k) - z(k + 1)*factors(k + 1)
      z(k + 1) = z(k + 1)*factors(k) + z(k)*factors(k + 1)
      z(k) = real_part
    end do
  end subroutine multiply_row

  subroutine move_plan(self, source)
    class(split_plan), intent(inout) :: self, source

    call clear_plan(self)
    self%rows = source%rows
    self%columns = source%columns
    if (source%along_row%owns_plans()) self%kept => source%kept
    nullify (source%kept)
    call self%along_column%move_from(source%along_column)
    call self%along_row%move_from(source%along_row)
    if (allocated(source%row_twist)) call move_alloc(source%row_twist, self%row_twist)
    if (allocated(source%near_factors)) call move_alloc(source%near_factors, self%near_factors)
    if (allocated(source%far_factors)) call move_alloc(source%far_factors, self%far_factors)
    source%rows = 0
    source%columns = 0
  end subroutine move_plan

  !> Plan anew what `source` plans; without memory, or if it plans nothing, the copy plans nothing.
  subroutine copy_plan(self, source)
    class(split_plan), intent(inout) :: self
    class(split_plan), intent(in) :: source
    type(split_plan) :: new
    type(fuge_info) :: info

    if (source%rows > 0) then
      ! Kept, because the source may be a bitwise copy of self that shares them.
      if (self%rows == source%rows .and. self%columns == source%columns .and. allocated(self%row_twist)) then
        call move_alloc(self%row_twist, new%row_twist)
        call move_alloc(self%near_factors, new%near_factors)
        call move_alloc(self%far_factors, new%far_factors)
      end if
      call prepare_plan(new, source%rows, source%columns, info, source%along_row%measured)
    end if
    call self%move_from(new)
  end subroutine copy_plan

  subroutine clear_plan(self)
    class(split_plan), intent(inout) :: self

    if (allocated(self%row_twist)) deallocate (self%row_twist)
    if (allocated(self%near_factors)) deallocate (self%near_factors)
    if (allocated(self%far_factors)) deallocate (self%far_factors)
    if (self%along_row%owns_plans() .and. associated(self%kept)) then
      call free_rows(self%kept)
      deallocate (self%kept)
    end if
    nullify (self%kept)
    self%rows = 0
    self%columns = 0
  end subroutine clear_plan

  impure elemental subroutine release_plan(self)
    type(split_plan), intent(inout) :: self

    call clear_plan(self)
  end subroutine release_plan

end module fuge_split_plan
