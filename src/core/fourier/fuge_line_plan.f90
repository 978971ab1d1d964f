!> Plans for transforms of lines of values: as a whole, or long ones as a grid.
module fuge_line_plan
  use, intrinsic :: iso_c_binding, only: c_double, c_loc
  use fuge_circle_split, only: split_circle
  use fuge_fft, only: fft_plan
  use fuge_kept_rows, only: return_rows, taken_rows
  use fuge_split_plan, only: get_columns, put_columns, split_plan, take_work
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_CALL_ORDER
  implicit none
  private

  !> Lines that are transformed together.
  integer, parameter :: LINES_TOGETHER = 16

  !> Transforms of one length. Copy it by `copy_from`.
  type, public :: line_plan
    !> Number of values; 0 before `set`.
    integer :: length = 0
    !> One of these is set.
    type(fft_plan) :: whole
    type(split_plan) :: grid
  contains
    procedure :: set
    procedure :: is_split
    procedure :: copy_from
    procedure :: move_from
    procedure :: transform
  end type line_plan

contains

  !> Plan transforms of `length` >= 1 values. `measured` (default .false.) as in fuge_fft. Errors, the plan unchanged:
  !> those of an fft_plan.
  subroutine set(self, length, info, measured)
    class(line_plan), intent(inout) :: self
    integer, intent(in) :: length
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: measured
    type(line_plan) :: new
    logical :: measures
    integer :: columns, rows

    measures = .false.
    if (present(measured)) measures = measured
    call split_circle(length, rows, columns)
    if (rows > 0) then
      call new%grid%set(rows, columns, info, measures)
    else
      call new%whole%set(length, info, measured=measures)
    end if
    if (info%failed()) return
    new%length = length
    call self%move_from(new)
  end subroutine set

  !> Are the values, an even number, transformed as a grid?
  pure function is_split(self)
    class(line_plan), intent(in) :: self
    logical :: is_split

    is_split = self%grid%rows > 0
  end function is_split

  !> Plan anew what `source` plans; without memory the copy plans nothing.
  subroutine copy_from(self, source)
    class(line_plan), intent(inout) :: self
    class(line_plan), intent(in) :: source

    self%length = 0
    call self%grid%copy_from(source%grid)
    self%whole = source%whole
    if (max(self%grid%rows, self%whole%length) > 0) self%length = source%length
  end subroutine copy_from

  !> Move the plans from `source`, which has none afterwards.
  subroutine move_from(self, source)
    class(line_plan), intent(inout) :: self, source

    call self%grid%move_from(source%grid)
    call self%whole%move_from(source%whole)
    self%length = source%length
    source%length = 0
  end subroutine move_from

  !> Transform `values` in place, for spectra. An even number of values are pairs of real and imaginary parts, before
  !> and after; otherwise the complex numbers 0 .. length/2 replace them, for which there is room behind them.
  !> `status`: 0, FUGE_ERR_CALL_ORDER or FUGE_ERR_MEMORY.
  subroutine transform(self, values, status)
    class(line_plan), intent(in) :: self
    real(c_double), intent(inout), contiguous, target :: values(:)
    integer, intent(out) :: status

    status = FUGE_ERR_CALL_ORDER
    if (self%is_split()) then
      call transform_grid(self%grid, self%grid%rows, self%grid%columns, values, status)
    else if (self%whole%owns_plans()) then
      status = FUGE_DONE
      call self%whole%transform(c_loc(values))
    end if
  end subroutine transform

  !> Transform the complex numbers `z`, in the order of their numbers before and after. `status` as for `transform`.
  subroutine transform_grid(plan, rows, columns, z, status)
    type(split_plan), intent(in) :: plan
    integer, intent(in) :: rows, columns
    real(c_double), intent(inout) :: z(2*rows*columns)
    integer, intent(out) :: status
    type(taken_rows) :: taken
    real(c_double), pointer, contiguous :: work(:, :)
    integer :: threads

    call take_work(plan, threads, taken, work, status)
    if (status /= FUGE_DONE) return
    call transform_columns(plan, rows, columns, z, work(:, 2*rows + 1:), work(:, :rows))
    call transform_rows(plan, rows, columns, work(:, :rows), work(:, 2*rows + 1:), z)
    call return_rows(plan%kept, taken)
  end subroutine transform_grid

  !> Transform the columns of `z`, to `work`.
  subroutine transform_columns(plan, rows, columns, z, lines, work)
    type(split_plan), intent(in) :: plan
    integer, intent(in) :: rows, columns
    real(c_double), intent(in) :: z(2*columns, rows)
    real(c_double), intent(inout), contiguous, target :: lines(:, :)
    real(c_double), intent(inout), contiguous :: work(:, :)
    integer :: count, first, k

    do first = 0, columns - 1, LINES_TOGETHER
      count = min(LINES_TOGETHER, columns - first)
      call get_columns(z, first, count, lines(:, 2:))
      do k = 1, count
        call plan%along_column%transform_to(c_loc(lines(1, k + 1)), c_loc(lines(1, k)))
      end do
      call put_columns(lines, first, count, work)
    end do
  end subroutine transform_columns

  !> Multiply the rows of `work` by their factors and transform them; place q of row p is wave p + R q of `waves`.
  subroutine transform_rows(plan, rows, columns, work, lines, waves)
    type(split_plan), intent(in) :: plan
    integer, intent(in) :: rows, columns
    real(c_double), intent(inout), contiguous, target :: work(:, :), lines(:, :)
    real(c_double), intent(inout) :: waves(2*rows, columns)
    integer :: count, first, k

    do first = 0, rows - 1, LINES_TOGETHER
      count = min(LINES_TOGETHER, rows - first)
      do k = 1, count
        call plan%multiply_by_factors(first + k - 1, .false., work(:, first + k), lines(:, count + 1))
        call plan%along_row%transform_to(c_loc(work(1, first + k)), c_loc(lines(1, k)))
      end do
      call put_columns(lines, first, count, waves)
    end do
  end subroutine transform_rows

end module fuge_line_plan
