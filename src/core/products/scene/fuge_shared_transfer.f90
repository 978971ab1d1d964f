!> Gaps and forces carried between nested grids, as by fuge_grid_transfer, where ranks may share the rows.
module fuge_shared_transfer
  use fuge_grid_transfer, only: open_cells, interpolate_columns, interpolate_rows, prolong, restrict
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: prolong_to, restrict_rows

contains

  !> Prolong forces, in place, to the grid of `operator` from the next coarser one; deallocate them if they are those of
  !> another grid. Error: FUGE_ERR_MEMORY.
  subroutine prolong_to(operator, force, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), allocatable, intent(inout) :: force(:)
    type(fuge_info), intent(inout) :: info
    type(shared_rows) :: coarse, fine

    call rows_of(operator, 0, fine, info)
    if (fine%is_alone()) then
      call prolong(operator%grid(), force, info)
      return
    end if
    if (.not. info%failed()) call rows_of(operator, 1, coarse, info)
    if (.not. info%failed()) call prolong_rows(coarse, fine, force, info)
  end subroutine prolong_to

  !> Prolong the rows of this rank from the grid of the rows `coarse` to that of `fine`.
  subroutine prolong_rows(coarse, fine, force, info)
    type(shared_rows), intent(in) :: coarse, fine
    real(dp), allocatable, intent(inout) :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: near(:), values(:), wide(:)
    integer, dimension(0:coarse%members() - 1) :: first, last
    integer :: begin, ends, r, rows(2), stat

    rows = coarse%own()
    if (.not. coarse%everywhere(size(force) == coarse%cells(1)*(rows(2) - rows(1) + 1))) then
      deallocate (force)
      return
    end if
    do r = 0, size(first) - 1
      ! The coarse rows about those of rank r, and one on each side.
      first(r) = max((fine%first(r) + 1)/2 - 1, 1)
      last(r) = min(fine%first(r + 1)/2 + 1, coarse%cells(2))
      if (fine%first(r + 1) == fine%first(r)) last(r) = first(r) - 1
    end do
    call coarse%fetch(coarse%cells(1), force, first, last, near, info)
    if (info%failed()) return
    rows = fine%own()
    begin = first(fine%number())
    ends = last(fine%number())
    allocate (wide(fine%cells(1)*max(ends - begin + 1, 0)), values(fine%cells(1)*(rows(2) - rows(1) + 1)), stat=stat)
    call require_memory(stat, 'the starting forces on', fine%cells(1)*(rows(2) - rows(1) + 1), 'points', info)
    call fine%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call interpolate_rows(coarse%cells(1), fine%cells(1), max(ends - begin + 1, 0), near, wide)
    call interpolate_columns(fine%cells(1), coarse%cells(2), fine%cells(2), begin, ends, rows, wide, values)
    if (all(fine%cells > 1)) call open_cells(coarse%cells(1), fine%cells(1), begin, ends, rows, near, values)
    call move_alloc(values, force)
  end subroutine prolong_rows

  !> `coarse`: the means of `values`, those of the rows `fine` on this rank, over the cells of the rows `coarser` of the
  !> grid whose cells are 2**level times as wide. `cells` in each direction of the finer grid. Error: FUGE_ERR_MEMORY.
  subroutine restrict_rows(fine, coarser, cells, level, values, coarse, info)
    type(shared_rows), intent(in) :: fine, coarser
    integer, intent(in) :: cells(2), level
    real(dp), intent(in), contiguous :: values(:)
    real(dp), allocatable, intent(out) :: coarse(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: sums(:)
    integer, dimension(0:fine%members() - 1) :: first, last
    integer :: me, n, r, stat

    if (fine%is_alone()) then
      call restrict(values, cells, level, coarse, info)
      return
    end if
    do r = 0, size(first) - 1
      first(r) = coarse_row(fine%first(r), level)
      last(r) = coarse_row(fine%first(r + 1) - 1, level)
      if (fine%first(r + 1) == fine%first(r)) last(r) = first(r) - 1
    end do
    me = fine%number()
    n = coarser%cells(1)
    allocate (sums(n*(last(me) - first(me) + 1)), stat=stat)
    call require_memory(stat, 'the gaps of', product(coarser%cells), 'cells', info)
    call fine%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call sum_cells(cells(1), fine%own(), n, level, first(me), last(me), values, sums)
    call coarser%collect(n, sums, first, last, coarse, info)
    if (.not. info%failed()) call divide_by_cells(cells, coarser%own(), n, level, coarse)
  end subroutine restrict_rows

  !> The row of the grid `level` times coarser that row `row` belongs to.
  pure function coarse_row(row, level)
    integer, intent(in) :: row, level
    integer :: coarse_row

    coarse_row = (row - 1)/2**level + 1
  end function coarse_row

  !> Add the cells of the rows `rows`(1) .. `rows`(2), of `columns` cells each, to the `sums` of the coarser cells.
  pure subroutine sum_cells(columns, rows, coarser, level, first, last, fine, sums)
    integer, intent(in) :: columns, rows(2), coarser, level, first, last
    real(dp), intent(in) :: fine(columns, rows(1):rows(2))
    real(dp), intent(inout) :: sums(coarser, first:last)
    integer :: i, j, k, width

    width = 2**level
    sums = 0.0_dp
    do j = rows(1), rows(2)
      k = coarse_row(j, level)
      do i = 1, coarser
        sums(i, k) = sums(i, k) + sum(fine((i - 1)*width + 1:min(i*width, columns), j))
      end do
    end do
  end subroutine sum_cells

  !> Divide sums over the coarser cells of the rows `rows`(1) .. `rows`(2) by the numbers of their cells.
  pure subroutine divide_by_cells(cells, rows, coarser, level, sums)
    integer, intent(in) :: cells(2), rows(2), coarser, level
    real(dp), intent(inout) :: sums(coarser, rows(1):rows(2))
    integer :: i, j, width

    width = 2**level
    do j = rows(1), rows(2)
      do i = 1, coarser
        sums(i, j) = sums(i, j) &
                     /real((min(i*width, cells(1)) - (i - 1)*width)*(min(j*width, cells(2)) - (j - 1)*width), dp)
      end do
    end do
  end subroutine divide_by_cells

end module fuge_shared_transfer
