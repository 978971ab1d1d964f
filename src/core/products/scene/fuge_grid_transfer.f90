!> Gaps and forces carried between the nested grids of an operator.
!>
!> Gaps are restricted to a coarser grid as means over its cells; forces are prolonged to the next
!> finer grid linearly, in one direction after the other. A direction of one cell stays as it is.
!> On an area open cells stay open: the linear interpolation would add a rim of cells to every contact,
!> on a rough surface half as many cells as are in contact.
module fuge_grid_transfer
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: coarser_cells, interpolate_columns, interpolate_rows, open_cells, prolong, restrict

  !> Fewer cells are done by one thread: waking others would take as long.
  integer, parameter :: FEWEST_FOR_THREADS = 16384

  !> Means of the cells of a finer grid, shared by rows of the coarser one.
  type, extends(work_in_parts) :: restriction
    integer :: cells(2) = 0, coarser(2) = 0, width = 1
    real(dp), pointer, contiguous :: values(:) => null(), coarse(:) => null()
  contains
    procedure :: do_part => restrict_part
  end type restriction

  !> Forces on a finer grid, shared by its rows.
  type, extends(work_in_parts) :: prolongation
    integer :: cells(2) = 0, coarse(2) = 0
    real(dp), pointer, contiguous :: force(:) => null(), fine(:) => null()
  contains
    procedure :: do_part => prolong_part
  end type prolongation

contains

  !> The cells in each direction of a grid whose cells are 2**level times as wide as those of a grid of `cells`.
  pure function coarser_cells(cells, level) result(coarser)
    integer, intent(in) :: cells(2), level
    integer :: coarser(2)

    coarser = (cells - 1)/2**level + 1
  end function coarser_cells

  !> Prolong forces, in place, to the next finer grid of `cells` in each direction; deallocate them if
  !> it is not the next one, but a grid in between is missing. Error: FUGE_ERR_MEMORY.
  !>
  !> A coarse cell stands for two fine cells in each direction, the last one for a single cell if their
  !> number is odd. For even numbers the sum of the forces is conserved; forces linear along the grid
  !> are prolonged exactly but for the first and last cells.
  subroutine prolong(cells, force, info)
    integer, intent(in) :: cells(2)
    real(dp), allocatable, intent(inout), target :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable, target :: fine(:)
    type(prolongation) :: work
    integer :: stat

    work%cells = cells
    work%coarse = coarser_cells(cells, 1)
    if (size(force) /= product(work%coarse)) then
      deallocate (force)
      return
    end if
    allocate (fine(product(cells)), stat=stat)
    call require_memory(stat, 'the starting forces on', product(cells), 'points', info)
    if (stat /= 0) return
    work%force => force
    work%fine => fine
    call run_in_parts(threads_for(cells), work)
    call move_alloc(fine, force)
  end subroutine prolong

  !> How many parts a transfer to or from a grid of `cells` has.
  function threads_for(cells) result(parts)
    integer, intent(in) :: cells(2)
    integer :: parts

    parts = 1
    if (product(cells) >= FEWEST_FOR_THREADS) parts = min(threads_here(), (cells(2) + 1)/2)
  end function threads_for

  !> Two rows after the other, from the coarse rows about them.
  subroutine prolong_part(self, part, parts)
    class(prolongation), intent(inout) :: self
    integer, intent(in) :: part, parts
    real(dp) :: wide(self%cells(1), 3)
    integer :: after, begin, first, last, near, j, rows(2)

    call share(self%coarse(2), part, parts, first, last)
    do j = first + 1, last + 1
      near = max(j - 1, 1)
      after = min(j + 1, self%coarse(2))
      begin = self%coarse(1)*(near - 1)
      rows = [2*j - 1, min(2*j, self%cells(2))]
      if (self%coarse(2) == self%cells(2)) rows = [j, j]
      associate (coarse => self%force(begin + 1:self%coarse(1)*after), &
                 fine => self%fine(self%cells(1)*(rows(1) - 1) + 1:self%cells(1)*rows(2)))
        call interpolate_rows(self%coarse(1), self%cells(1), after - near + 1, coarse, wide)
        call interpolate_columns(self%cells(1), self%coarse(2), self%cells(2), near, after, rows, wide, fine)
        if (all(self%cells > 1)) call open_cells(self%coarse(1), self%cells(1), near, after, rows, coarse, fine)
      end associate
    end do
  end subroutine prolong_part

  !> Linear interpolation along x between the centres of the coarse cells; each coarse cell carries the
  !> forces of two fine cells. `coarse` (m, rows), `fine` (n, rows).
  pure subroutine interpolate_rows(m, n, rows, coarse, fine)
    integer, intent(in) :: m, n, rows
    real(dp), intent(in) :: coarse(m, rows)
    real(dp), intent(out) :: fine(n, rows)
    integer :: j, k

    if (m == n) then
      fine = coarse
      return
    end if
    do j = 1, rows
      do k = 1, m
        fine(2*k - 1, j) = 0.375_dp*coarse(k, j) + 0.125_dp*coarse(max(k - 1, 1), j)
        if (2*k <= n) fine(2*k, j) = 0.375_dp*coarse(k, j) + 0.125_dp*coarse(min(k + 1, m), j)
      end do
    end do
  end subroutine interpolate_rows

  !> The same along y, from m rows to n: `fine` (columns, :) are the rows `rows`(1) .. `rows`(2), `coarse` (columns, :)
  !> the rows `first` .. `last`, among them all that belong to those.
  pure subroutine interpolate_columns(columns, m, n, first, last, rows, coarse, fine)
    integer, intent(in) :: columns, m, n, first, last, rows(2)
    real(dp), intent(in) :: coarse(columns, first:last)
    real(dp), intent(out) :: fine(columns, rows(1):rows(2))
    integer :: j, k

    if (m == n) then
      fine = coarse(:, rows(1):rows(2))
      return
    end if
    do j = rows(1), rows(2)
      k = (j + 1)/2
      if (mod(j, 2) == 1) then
        fine(:, j) = 0.375_dp*coarse(:, k) + 0.125_dp*coarse(:, max(k - 1, 1))
      else
        fine(:, j) = 0.375_dp*coarse(:, k) + 0.125_dp*coarse(:, min(k + 1, m))
      end if
    end do
  end subroutine interpolate_columns

  !> No force on the cells of `fine` (cells, :), the rows `rows`(1) .. `rows`(2), whose cell of `coarse` (coarser, :),
  !> the rows `first` .. `last`, carries none.
  pure subroutine open_cells(coarser, cells, first, last, rows, coarse, fine)
    integer, intent(in) :: coarser, cells, first, last, rows(2)
    real(dp), intent(in) :: coarse(coarser, first:last)
    real(dp), intent(inout) :: fine(cells, rows(1):rows(2))
    integer :: i, j

    do j = rows(1), rows(2)
      do i = 1, cells
        associate (force => coarse((i + 1)/2, (j + 1)/2))
          if (.not. (force > 0.0_dp .or. (force < 0.0_dp .and. fine(i, j) < 0.0_dp))) fine(i, j) = 0.0_dp
        end associate
      end do
    end do
  end subroutine open_cells

  !> Restrict `values` of a grid of `cells` in each direction to one whose cells are 2**level times as
  !> wide (the last ones may be narrower): `coarse` are the means over its cells. Error: FUGE_ERR_MEMORY.
  subroutine restrict(values, cells, level, coarse, info)
    real(dp), intent(in), contiguous, target :: values(:)
    integer, intent(in) :: cells(2), level
    real(dp), allocatable, intent(out), target :: coarse(:)
    type(fuge_info), intent(inout) :: info
    type(restriction) :: work
    integer :: stat

    work%cells = cells
    work%coarser = coarser_cells(cells, level)
    work%width = 2**level
    allocate (coarse(product(work%coarser)), stat=stat)
    call require_memory(stat, 'the gaps of', product(work%coarser), 'cells', info)
    if (stat /= 0) return
    call c_f_pointer(c_loc(values), work%values, shape(values))
    work%coarse => coarse
    call run_in_parts(min(threads_for(cells), work%coarser(2)), work)
  end subroutine restrict

  subroutine restrict_part(self, part, parts)
    class(restriction), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last, rows(2)

    call share(self%coarser(2), part, parts, first, last)
    if (last < first) return
    rows = [first*self%width + 1, min((last + 1)*self%width, self%cells(2))]
    call average_cells([self%cells(1), rows(2) - rows(1) + 1], [self%coarser(1), last - first + 1], self%width, &
                       self%values(self%cells(1)*(rows(1) - 1) + 1:self%cells(1)*rows(2)), &
                       self%coarse(self%coarser(1)*first + 1:self%coarser(1)*(last + 1)))
  end subroutine restrict_part

  !> Means of `fine` (nx, ny) over blocks of `width` x `width` cells.
  pure subroutine average_cells(cells, coarser, width, fine, coarse)
    integer, intent(in) :: cells(2), coarser(2), width
    real(dp), intent(in) :: fine(cells(1), cells(2))
    real(dp), intent(out) :: coarse(coarser(1), coarser(2))
    integer :: first(2), last(2), i, j

    do j = 1, coarser(2)
      do i = 1, coarser(1)
        first = ([i, j] - 1)*width + 1
        last = first + min(width - 1, cells - first)
        coarse(i, j) = sum(fine(first(1):last(1), first(2):last(2)))/real(product(last - first + 1), dp)
      end do
    end do
  end subroutine average_cells

end module fuge_grid_transfer
