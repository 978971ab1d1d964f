!> Which rows of a grid each rank has: pairs of rows, in blocks of equal size, so that a product transforms the same
!> pairs whatever the number of ranks.
module fuge_slab_rows
  use fuge_kinds, only: dp
  implicit none
  private

  public :: active_ranks, block_of_pairs, block_of_waves, first_rows

  !> A rank has at least this many cells: coarser grids lie on fewer ranks, down to one, where messages would take
  !> longer than the transforms.
  integer, parameter, public :: FEWEST_CELLS = 16384
  !> A rank has at least this many cells for each rank, because it exchanges messages of 16 bytes a cell with all of
  !> them: with more ranks these would be so short that their latency would cost more than the ranks bring.
  integer, parameter :: SHORTEST = 128

contains

  !> Pairs of rows in each block but the last ones, of a grid of `cells` in each direction on `ranks` ranks. A grid that
  !> is a single row of cells is not shared.
  pure function block_of_pairs(cells, ranks) result(pairs)
    integer, intent(in) :: cells(2), ranks
    integer :: pairs

    pairs = (cells(2) + 1)/2
    if (any(cells < 2)) return
    pairs = max((pairs - 1)/useful_ranks(cells, ranks) + 1, min((FEWEST_CELLS - 1)/(2*cells(1)) + 1, pairs))
  end function block_of_pairs

  !> How many of the ranks messages leave useful.
  pure function useful_ranks(cells, ranks) result(useful)
    integer, intent(in) :: cells(2), ranks
    integer :: useful

    useful = min(ranks, max(int(sqrt(real(cells(1), dp)*real(cells(2), dp)/real(SHORTEST, dp))), 1))
  end function useful_ranks

  !> How many of the ranks have rows: the first ones.
  pure function active_ranks(cells, ranks) result(active)
    integer, intent(in) :: cells(2), ranks
    integer :: active

    active = ((cells(2) + 1)/2 - 1)/block_of_pairs(cells, ranks) + 1
  end function active_ranks

  !> The first row of each rank, and one more, (0:ranks).
  pure function first_rows(cells, ranks) result(first)
    integer, intent(in) :: cells(2), ranks
    integer :: first(0:ranks)
    integer :: pairs, r

    pairs = block_of_pairs(cells, ranks)
    do r = 0, ranks
      first(r) = cells(2) + 1
      if (r <= (cells(2) - 1)/(2*pairs)) first(r) = 2*pairs*r + 1
    end do
  end function first_rows

  !> Waves in each block but the last ones, of `waves` on `ranks` ranks: an even number, because tables are transformed
  !> in pairs of lines.
  pure function block_of_waves(waves, ranks) result(block)
    integer, intent(in) :: waves, ranks
    integer :: block

    block = 2*((waves - 1)/(2*ranks) + 1)
  end function block_of_waves

end module fuge_slab_rows
