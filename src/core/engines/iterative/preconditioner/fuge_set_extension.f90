!> Displacements of a contact set, extended to all points of an area.
!>
!> The inverse of the operator restricted to a set S is E^T M E, where M is its inverse for all points and E extends
!> displacements of S to those with the least energy, which are by forces on S. With zero off S instead, the restriction
!> of M, a long wave has an energy that grows with the length of the rim of S: the condition of conjugate gradients
!> grows with the cells of a rough surface. Any linear E gives a symmetric positive definite preconditioner, none of
!> whose energies are too small (doc/theory_area.md).
!>
!> Here E fills open cells from a hierarchy of grids, each with cells twice as wide. A cell has a `cover`, how far the
!> set decides its displacement: 1 or 0 on the finest grid, GROWTH times the mean of its cells on a coarser one, at most
!> 1. Its value is the mean of its cells weighted by their cover, and what is not covered is interpolated from the next
!> coarser grid, zero on the coarsest. Grids are periodic, as those of the preconditioner of a free surface are too.
module fuge_set_extension
  use fuge_extension_kernels, only: add_open_row, add_row, collect_row, coarser_row, fill_row, interpolate_row, &
    spread_row, sum_pairs, NEAR, NEXT
  use fuge_grid_transfer, only: coarser_cells
  use fuge_kinds, only: sp
  use fuge_status, only: fuge_info, require_memory
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  !> From one grid to the next the cover grows by this factor. With 2 a lone cell would reach as far as its force, whose
  !> displacement falls off like 1/r, with 1 as far as its share of the area. In between the condition is least: on
  !> rough surfaces 1.2, for any grid and load, but 1.8 with 1 and 2.4 with 2.
  real(sp), parameter :: GROWTH = 1.2_sp
  !> The coarsest grid has no more cells than this in each direction.
  integer, parameter :: COARSEST = 4
  !> Fewer cells are done by one thread: waking others would take as long.
  integer, parameter :: FEWEST_FOR_THREADS = 16384

  !> One grid.
  type :: extension_level
    integer :: cells(2) = 0
    real(sp), allocatable :: cover(:, :)
    !> What is extended, and one over the cover of its finer cells: not on the finest grid.
    real(sp), allocatable :: values(:, :), inverse(:, :)
  end type extension_level

  !> Set it for a contact set, then use it any number of times.
  type, public :: set_extension
    private
    !> From the finest grid to the coarsest; so many of them are needed.
    type(extension_level), allocatable :: levels(:)
    integer :: depth = 0
  contains
    procedure :: set
    procedure :: extend
    procedure :: point_to_cover
    procedure :: collect
  end type set_extension

  !> A pass over the rows of one grid, `fine`, with its `values`, or over those of the next one, `coarse`.
  type, extends(work_in_parts) :: row_pass
    type(extension_level), pointer :: fine => null(), coarse => null()
    real(sp), pointer, contiguous :: values(:, :) => null()
    logical, pointer, contiguous :: contact(:, :) => null()
    !> Rows to go over.
    integer :: rows = 0
    procedure(row_operation), pointer, nopass :: operation => null()
  contains
    procedure :: do_part
    procedure :: go
  end type row_pass

  abstract interface
    !> Row `j` of the grid that the pass goes over.
    subroutine row_operation(pass, j)
      import :: row_pass
      class(row_pass), intent(inout) :: pass
      integer, intent(in) :: j
    end subroutine row_operation
  end interface

contains

  !> Prepare for the set `contact` of a grid of `cells` in each direction. Error: FUGE_ERR_MEMORY.
  subroutine set(self, cells, contact, info)
    class(set_extension), intent(inout), target :: self
    integer, intent(in) :: cells(2)
    logical, intent(in), contiguous, target :: contact(:)
    type(fuge_info), intent(inout) :: info
    type(row_pass) :: pass
    integer :: l

    call create_levels(self, cells, info)
    if (info%failed()) return
    pass%fine => self%levels(1)
    pass%contact(1:cells(1), 1:cells(2)) => contact
    call pass%go(mark_cells, cells(2))
    do l = 1, size(self%levels)
      self%depth = l
      if (l == size(self%levels)) exit
      if (.not. any(self%levels(l)%cover < 1.0_sp)) exit
      pass%fine => self%levels(l)
      pass%coarse => self%levels(l + 1)
      call pass%go(cover_cells, pass%coarse%cells(2))
    end do
    if (self%depth == 1) return
    ! The rest of the coarsest cells is filled with zero.
    associate (coarsest => self%levels(self%depth))
      coarsest%inverse = coarsest%cover*coarsest%inverse
    end associate
  end subroutine set

  !> Create the grids, unless they are there.
  subroutine create_levels(self, cells, info)
    class(set_extension), intent(inout) :: self
    integer, intent(in) :: cells(2)
    type(fuge_info), intent(inout) :: info
    integer :: count, l, stat

    if (allocated(self%levels)) then
      if (all(self%levels(1)%cells == cells)) return
      deallocate (self%levels)
    end if
    count = 1
    do while (any(coarser_cells(cells, count - 1) > COARSEST))
      count = count + 1
    end do
    allocate (self%levels(count), stat=stat)
    do l = 1, count
      if (stat /= 0) exit
      self%levels(l)%cells = coarser_cells(cells, l - 1)
      associate (n => self%levels(l)%cells)
        allocate (self%levels(l)%cover(n(1), n(2)), stat=stat)
        if (l == 1 .or. stat /= 0) cycle
        allocate (self%levels(l)%values(n(1), n(2)), self%levels(l)%inverse(n(1), n(2)), stat=stat)
      end associate
    end do
    if (stat /= 0 .and. allocated(self%levels)) deallocate (self%levels)
    call require_memory(stat, 'the extension of a contact set of', product(cells), 'points', info)
  end subroutine create_levels

  !> The `cover` (n) of the points: 1 on the set, 0 off it.
  subroutine point_to_cover(self, cover)
    class(set_extension), intent(in), target :: self
    real(sp), pointer, contiguous, intent(out) :: cover(:)

    cover(1:size(self%levels(1)%cover)) => self%levels(1)%cover
  end subroutine point_to_cover

  !> E: give the `values` (n) of the set to open points too, whose own values do not count.
  subroutine extend(self, values)
    class(set_extension), intent(inout), target :: self
    real(sp), intent(inout), contiguous, target :: values(:)
    type(row_pass) :: pass
    integer :: l

    do l = 1, self%depth - 1
      call point_to(self, l, values, pass)
      call pass%go(average_cells, pass%coarse%cells(2))
    end do
    do l = self%depth - 1, 1, -1
      call point_to(self, l, values, pass)
      call pass%go(fill_cells, pass%fine%cells(2))
    end do
  end subroutine extend

  !> E^T: distribute the `values` (n) of open points to the set; these are zero then.
  subroutine collect(self, values)
    class(set_extension), intent(inout), target :: self
    real(sp), intent(inout), contiguous, target :: values(:)
    type(row_pass) :: pass
    integer :: l

    do l = 1, self%depth - 1
      call point_to(self, l, values, pass)
      call pass%go(collect_cells, pass%coarse%cells(2))
    end do
    do l = self%depth - 1, 1, -1
      call point_to(self, l, values, pass)
      call pass%go(spread_cells, pass%fine%cells(2))
    end do
  end subroutine collect

  !> Point a pass to level `l`, on the finest one with `values`, and to the next one.
  subroutine point_to(self, l, values, pass)
    class(set_extension), intent(in), target :: self
    integer, intent(in) :: l
    real(sp), intent(in), contiguous, target :: values(:)
    type(row_pass), intent(inout) :: pass

    pass%fine => self%levels(l)
    pass%coarse => self%levels(l + 1)
    if (l > 1) then
      pass%values => self%levels(l)%values
    else
      pass%values(1:pass%fine%cells(1), 1:pass%fine%cells(2)) => values
    end if
  end subroutine point_to

  !> Do `operation` on the rows 1 .. `rows`.
  subroutine go(self, operation, rows)
    class(row_pass), intent(inout) :: self
    procedure(row_operation) :: operation
    integer, intent(in) :: rows
    integer :: parts

    self%operation => operation
    self%rows = rows
    parts = 1
    if (product(self%fine%cells) >= FEWEST_FOR_THREADS) parts = min(threads_here(), rows)
    call run_in_parts(parts, self)
  end subroutine go

  subroutine do_part(self, part, parts)
    class(row_pass), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, j, last

    call share(self%rows, part, parts, first, last)
    do j = first + 1, last + 1
      call self%operation(self, j)
    end do
  end subroutine do_part

  !> Cover of the finest cells.
  subroutine mark_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j

    pass%fine%cover(:, j) = merge(1.0_sp, 0.0_sp, pass%contact(:, j))
  end subroutine mark_cells

  !> Cover of coarse cells, and one over that of their fine cells.
  subroutine cover_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: pair(2*pass%coarse%cells(1)), sums(pass%coarse%cells(1))
    integer :: i, k

    associate (n => pass%fine%cells)
      pair = 0.0_sp
      do k = 2*j - 1, min(2*j, n(2))
        pair(:n(1)) = pair(:n(1)) + pass%fine%cover(:, k)
      end do
      call sum_pairs(size(sums), pair, sums)
      do i = 1, size(sums)
        pass%coarse%cover(i, j) = min(GROWTH*sums(i)/real(fine_cells(n(1), i)*fine_cells(n(2), j), sp), 1.0_sp)
        pass%coarse%inverse(i, j) = 0.0_sp
        if (sums(i) > 0.0_sp) pass%coarse%inverse(i, j) = 1.0_sp/sums(i)
      end do
    end associate
  end subroutine cover_cells

  !> How many of `n` fine cells coarse cell number `i` has.
  elemental function fine_cells(n, i) result(cells)
    integer, intent(in) :: n, i
    integer :: cells

    cells = min(2*i, n) - 2*(i - 1)
  end function fine_cells

  !> Values of coarse cells: means of those of their cells.
  subroutine average_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: pair(2*pass%coarse%cells(1)), sums(pass%coarse%cells(1))
    integer :: k

    pair = 0.0_sp
    associate (n => pass%fine%cells)
      do k = 2*j - 1, min(2*j, n(2))
        call add_row(n(1), pass%fine%cover(:, k), pass%values(:, k), pair(:n(1)))
      end do
    end associate
    call sum_pairs(size(sums), pair, sums)
    pass%coarse%values(:, j) = pass%coarse%inverse(:, j)*sums
  end subroutine average_cells

  !> Fill fine cells, as far as they are not covered, from coarse ones.
  subroutine fill_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: filling(2*pass%coarse%cells(1)), row(pass%coarse%cells(1))

    associate (n => pass%fine%cells, m => pass%coarse%cells, values => pass%coarse%values)
      row = NEAR*values(:, (j + 1)/2) + NEXT*values(:, coarser_row(m(2), j))
      call interpolate_row(m(1), row, filling)
      call fill_row(n(1), pass%fine%cover(:, j), filling(:n(1)), pass%values(:, j))
    end associate
  end subroutine fill_cells

  !> The transpose of what fill_cells takes from coarse cells.
  subroutine collect_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: rows(2*pass%coarse%cells(1))

    rows = 0.0_sp
    associate (m => pass%coarse%cells)
      call add_open(pass, NEAR, 2*j - 1, rows)
      call add_open(pass, NEAR, 2*j, rows)
      call add_open(pass, NEXT, modulo(2*j - 3, 2*m(2)) + 1, rows)
      call add_open(pass, NEXT, modulo(2*j, 2*m(2)) + 1, rows)
      call collect_row(m(1), rows, pass%coarse%values(:, j))
    end associate
  end subroutine collect_cells

  !> Add `weight` times what is not covered of row `k` of the fine grid to `rows`; nothing if it has no such row.
  subroutine add_open(pass, weight, k, rows)
    class(row_pass), intent(in) :: pass
    real(sp), intent(in) :: weight
    integer, intent(in) :: k
    real(sp), intent(inout) :: rows(:)

    associate (n => pass%fine%cells)
      if (k > n(2)) return
      call add_open_row(n(1), weight, pass%fine%cover(:, k), pass%values(:, k), rows(:n(1)))
    end associate
  end subroutine add_open

  !> The transpose of average_cells and of what fill_cells keeps.
  subroutine spread_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j

    associate (n => pass%fine%cells, m => pass%coarse%cells, k => (j + 1)/2)
      call spread_row(m(1), n(1), pass%coarse%inverse(:, k), pass%coarse%values(:, k), pass%fine%cover(:, j), &
                      pass%values(:, j))
    end associate
  end subroutine spread_cells

end module fuge_set_extension
