!> The pivots of a tableau solve: the basis and z of each step, as the paper prints them.
module fuge_history_type
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  !> Length of z at the end of a line.
  integer, parameter :: OBJECTIVE_LENGTH = 18

  !> The pivots of a tableau solve: steps 0 (the artificial start) to `recorded()` - 1.
  type, public :: fuge_history
    private
    integer :: steps = 0
    integer, allocatable :: columns(:, :)
    real(dp), allocatable :: sums(:)
  contains
    procedure :: start
    procedure :: record
    procedure :: recorded
    procedure :: basis
    procedure :: z
    procedure :: line
  end type fuge_history

contains

  !> Forget all steps; the next ones have `rows` rows. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine start(self, rows, status)
    class(fuge_history), intent(inout) :: self
    integer, intent(in) :: rows
    integer, intent(out) :: status
    integer :: stat

    self%steps = 0
    if (allocated(self%columns)) deallocate (self%columns)
    if (allocated(self%sums)) deallocate (self%sums)
    allocate (self%columns(rows, 2*rows + 8), self%sums(2*rows + 8), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
  end subroutine start

  !> Append a step: `basis` holds a column number for each row, z is the sum of the artificials in the caller's units.
  !> `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine record(self, basis, z, status)
    class(fuge_history), intent(inout) :: self
    integer, intent(in) :: basis(:)
    real(dp), intent(in) :: z
    integer, intent(out) :: status
    integer :: stat

    status = FUGE_DONE
    if (.not. allocated(self%sums)) call self%start(size(basis), status)
    if (status /= FUGE_DONE) return
    stat = 0
    call make_room(self%columns, self%steps, stat)
    call make_room(self%sums, self%steps, stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (status /= FUGE_DONE) return
    self%steps = self%steps + 1
    self%columns(:, self%steps) = basis
    self%sums(self%steps) = z
  end subroutine record

  !> Number of steps recorded, step 0 included; 0 if no history was kept.
  pure function recorded(self)
    class(fuge_history), intent(in) :: self
    integer :: recorded

    recorded = self%steps
  end function recorded

  !> Column numbers in the basis after pivot `step`, (n+m); empty if there is no such step.
  pure function basis(self, step) result(columns)
    class(fuge_history), intent(in) :: self
    integer, intent(in) :: step
    integer :: columns(rows_at(self, step))

    if (size(columns) > 0) columns = self%columns(:, step + 1)
  end function basis

  !> Rows of the basis at a step; 0 if there is no such step.
  pure function rows_at(self, step) result(rows)
    class(fuge_history), intent(in) :: self
    integer, intent(in) :: step
    integer :: rows

    rows = 0
    if (step >= 0 .and. step < self%steps) rows = size(self%columns, 1)
  end function rows_at

  !> Sum of the artificial variables after pivot `step`; lengths and forces add up in the caller's units, as in the
  !> paper. 0 if there is no such step.
  pure function z(self, step)
    class(fuge_history), intent(in) :: self
    integer, intent(in) :: step
    real(dp) :: z

    z = 0.0_dp
    if (step >= 0 .and. step < self%steps) z = self%sums(step + 1)
  end function z

  pure function digits_of(value) result(digits)
    integer, intent(in) :: value
    integer :: digits
    character(len=12) :: buffer

    write (buffer, '(i0)') value
    digits = len_trim(buffer)
  end function digits_of

  !> Characters of a column number, a blank included. All steps align, because the largest number of all is in the
  !> artificial start.
  pure function column_width(self) result(width)
    class(fuge_history), intent(in) :: self
    integer :: width

    width = digits_of(maxval(self%columns(:, 1))) + 1
  end function column_width

  !> Number of characters of `line` for a step; 0 if there is no such step.
  pure function line_length(self, step) result(length)
    class(fuge_history), intent(in) :: self
    integer, intent(in) :: step
    integer :: length

    length = 0
    if (rows_at(self, step) > 0) length = size(self%columns, 1)*column_width(self) + OBJECTIVE_LENGTH
  end function line_length

  !> A step in the layout of the paper's Tabelle 2: the column numbers, then z.
  pure function line(self, step) result(row)
    class(fuge_history), intent(in) :: self
    integer, intent(in) :: step
    character(len=line_length(self, step)) :: row
    character(len=12) :: number
    integer :: k, width

    if (len(row) == 0) return
    width = column_width(self)
    do k = 1, size(self%columns, 1)
      write (number, '(i12)') self%columns(k, step + 1)
      row(width*(k - 1) + 1:width*k) = number(13 - width:)
    end do
    write (row(len(row) - OBJECTIVE_LENGTH + 1:), '(a,sp,es13.6)') '  Z= ', self%z(step)
  end function line

end module fuge_history_type
