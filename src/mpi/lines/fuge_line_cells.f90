!> Which cells of a line each rank has. The circle of a transform is written as rows of cells, one after the other; a
!> rank has some of the rows.
module fuge_line_cells
  use fuge_slab_rows, only: FEWEST_CELLS
  implicit none
  private

  public :: active_ranks, block_begins, first_cells, rows_of_circle, rows_of_ranks

contains

  !> The number of rows of a circle of `length` cells: its largest divisor that is at most its square root.
  pure function rows_of_circle(length) result(rows)
    integer, intent(in) :: length
    integer :: rows

    rows = int(sqrt(real(length)))
    ! The root may be rounded to more, or less.
    do while (rows < length/(rows + 1))
      rows = rows + 1
    end do
    do while (rows > 1)
      if (rows <= length/rows .and. mod(length, rows) == 0) exit
      rows = rows - 1
    end do
  end function rows_of_circle

  !> Rows that hold any of `cells` on a circle of `length`.
  pure function used_rows(cells, length) result(rows)
    integer, intent(in) :: cells, length
    integer :: rows

    rows = (cells - 1)/(length/rows_of_circle(length)) + 1
  end function used_rows

  !> Rows in each block but the last ones.
  pure function block_of_rows(cells, length, ranks) result(block)
    integer, intent(in) :: cells, length, ranks
    integer :: block
    integer :: columns

    columns = length/rows_of_circle(length)
    block = max((used_rows(cells, length) - 1)/ranks + 1, (FEWEST_CELLS - 1)/columns + 1)
  end function block_of_rows

  !> How many of the ranks have any of `cells` on a circle of `length`: the first ones.
  pure function active_ranks(cells, length, ranks) result(active)
    integer, intent(in) :: cells, length, ranks
    integer :: active

    active = (used_rows(cells, length) - 1)/block_of_rows(cells, length, ranks) + 1
  end function active_ranks

  !> The first row of each rank, from 0, and one more, (0:ranks).
  pure function rows_of_ranks(cells, length, ranks) result(first)
    integer, intent(in) :: cells, length, ranks
    integer :: first(0:ranks)

    first = block_begins(used_rows(cells, length), block_of_rows(cells, length, ranks), ranks)
  end function rows_of_ranks

  !> The first cell of each rank, from 1, and one more, (0:ranks).
  pure function first_cells(cells, length, ranks) result(first)
    integer, intent(in) :: cells, length, ranks
    integer :: first(0:ranks)
    integer :: columns, r

    first = rows_of_ranks(cells, length, ranks)
    columns = length/rows_of_circle(length)
    do r = 0, ranks
      if (first(r) > (cells - 1)/columns) then
        first(r) = cells + 1
      else
        first(r) = columns*first(r) + 1
      end if
    end do
  end function first_cells

  !> The first of `count` things of each rank, from 0, in blocks of `block`, and one more, (0:ranks).
  pure function block_begins(count, block, ranks) result(first)
    integer, intent(in) :: count, block, ranks
    integer :: first(0:ranks)
    integer :: r

    first(0) = 0
    do r = 1, ranks
      first(r) = count
      if (first(r - 1) < count - block) first(r) = first(r - 1) + block
    end do
  end function block_begins

end module fuge_line_cells
