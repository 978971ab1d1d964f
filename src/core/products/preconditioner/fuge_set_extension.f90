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
!>
!> Where ranks share the rows of the finest grid, they share those of coarser ones too, as long as these have many
!> cells: a coarse row belongs to the rank that has the first of its fine rows, and the ranks beside it have a copy, a
!> halo. Of the grids below each rank has all rows, to which each adds what its rows give.
module fuge_set_extension
  use fuge_extension_kernels, only: add_open_row, add_row, collect_row, coarser_row, fill_row, interpolate_row, &
    spread_row, sum_pairs, NEAR, NEXT
  use fuge_grid_transfer, only: coarser_cells
  use fuge_kinds, only: dp, sp
  use fuge_operator_type, only: fuge_operator
  use fuge_row_halo, only: row_halo
  use fuge_shared_rows, only: shared_rows
  use fuge_status, only: fuge_info, require_memory
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: wave_slopes

  !> Slopes of more grids are those of the last one.
  integer, parameter :: LEVELS = 16
  !> From one grid to the next the cover grows by this factor on a half-space. With 2 a lone cell would reach as far as
  !> its force, whose displacement falls off like 1/r, with 1 as far as its share of the area. In between the condition
  !> is least: on rough surfaces 1.2, for any grid and load, but 1.8 with 1 and 2.4 with 2.
  real(sp), parameter :: GROWTH = 1.2_sp
  !> Where displacements by waves fall like q**-s, those by a lone force fall like r**(s - 2): the growth is 2**(s - 1)
  !> times as large, at most this. A stiff film bends as a plate, s = 4: what touches it moves it far around.
  real(sp), parameter :: MOST_GROWTH = 4.0_sp
  !> The coarsest grid has no more cells than this in each direction.
  integer, parameter :: COARSEST = 4
  !> Fewer cells are done by one thread: waking others would take as long.
  real(dp), parameter :: FEWEST_FOR_THREADS = 16384.0_dp
  !> Ranks do not share the rows of coarser grids of fewer cells: messages would take as long.
  integer, parameter :: FEWEST_SHARED = 16384

  !> One grid. Arrays have the rows first .. last, those of coarser grids that ranks share one more on each side.
  type :: extension_level
    integer :: cells(2) = 0
    !> Who has which rows, and those that are here.
    type(shared_rows) :: rows = shared_rows()
    integer :: first = 1, last = 0
    !> The rows beside, on coarser grids that ranks share.
    type(row_halo) :: halo = row_halo()
    !> For the sums over ranks, where they share the rows of the next finer grid but not of this one.
    real(dp), allocatable :: sums(:)
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
    integer :: first = 1, last = 0
    !> Beyond the last row of `fine` follows the first one; else rows beyond are in the halo.
    logical :: wraps = .true.
    !> Of the cover, from `fine` to `coarse`.
    real(sp) :: cover_growth = GROWTH
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

  !> Prepare for the set `contact` of a grid of `cells` in each direction, of which the rows may be shared: `contact`
  !> (n), of the points here. `slope` (0:): that of the waves of each grid, from the finest on, as an operator's
  !> `wave_slope`; where there are none, 1 as on a half-space. Error: FUGE_ERR_MEMORY.
  subroutine set(self, rows, cells, contact, info, slope)
    class(set_extension), intent(inout), target :: self
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: cells(2)
    logical, intent(in), contiguous, target :: contact(:)
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), optional :: slope(0:)
    type(row_pass) :: pass
    integer :: l

    call create_levels(self, rows, cells, info)
    if (info%failed()) return
    call point_to_level(self, 1, pass)
    pass%contact(1:cells(1), pass%fine%first:pass%fine%last) => contact
    call pass%go(mark_cells, pass%fine%first, pass%fine%last)
    do l = 1, size(self%levels)
      self%depth = l
      if (l == size(self%levels)) exit
      if (.not. rows%anywhere(any(self%levels(l)%cover < 1.0_sp))) exit
      call point_to_level(self, l, pass)
      if (present(slope)) pass%cover_growth = growth_of(slope(min(l, size(slope)) - 1))
      call pass%go(sum_cover, lbound(pass%coarse%values, 2), ubound(pass%coarse%values, 2))
      call add_up(pass%fine, pass%coarse, .true.)
      call fetch_halo(pass%coarse, .true.)
      call pass%go(cover_cells, lbound(pass%coarse%values, 2), ubound(pass%coarse%values, 2))
    end do
    if (self%depth == 1) return
    ! The rest of the coarsest cells is filled with zero.
    associate (coarsest => self%levels(self%depth))
      coarsest%inverse = coarsest%cover*coarsest%inverse
    end associate
  end subroutine set

  !> The growth of the cover where displacements by waves fall like q**-`slope`.
  elemental function growth_of(slope) result(factor)
    real(dp), intent(in) :: slope
    real(sp) :: factor

    factor = min(GROWTH*2.0_sp**real(slope - 1.0_dp, sp), MOST_GROWTH)
  end function growth_of

  !> The slopes of the waves of an operator's grid and its coarser ones, (0:).
  function wave_slopes(operator) result(slope)
    class(fuge_operator), intent(in) :: operator
    real(dp) :: slope(0:LEVELS)
    integer :: l

    slope = [(operator%wave_slope(l), l=0, LEVELS)]
  end function wave_slopes

  !> Create the grids, unless they are there; `rows` are those of the finest one.
  subroutine create_levels(self, rows, cells, info)
    class(set_extension), intent(inout) :: self
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: cells(2)
    type(fuge_info), intent(inout) :: info
    integer :: count, halo, l, stat

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
      associate (level => self%levels(l))
        level%cells = coarser_cells(cells, l - 1)
        if (l == 1) level%rows = rows
        if (l > 1) call share_rows(self%levels(l - 1)%rows, level)
        level%last = level%cells(2)
        halo = 0
        if (.not. level%rows%is_alone()) then
          level%first = level%rows%first(rows%number())
          level%last = level%rows%first(rows%number() + 1) - 1
          halo = merge(0, 1, l == 1)
          if (l > 1) call level%halo%set(level%rows, stat)
        else if (l > 1) then
          if (.not. self%levels(l - 1)%rows%is_alone()) allocate (level%sums(product(level%cells)), stat=stat)
        end if
        if (stat /= 0) cycle
        allocate (level%cover(level%cells(1), level%first - halo:level%last + halo), stat=stat)
        if (l == 1 .or. stat /= 0) cycle
        allocate (level%values(level%cells(1), level%first - halo:level%last + halo), &
                  level%inverse(level%cells(1), level%first - halo:level%last + halo), stat=stat)
      end associate
    end do
    if (stat /= 0 .and. allocated(self%levels)) deallocate (self%levels)
    call require_memory(stat, 'the extension of a contact set of', product(cells), 'points', info)
    call rows%agree(info)
    if (info%failed() .and. allocated(self%levels)) deallocate (self%levels)
  end subroutine create_levels

  !> Share the rows of the grid `level` as those of the next finer one, `fine`, if it has enough cells.
  subroutine share_rows(fine, level)
    type(shared_rows), intent(in) :: fine
    type(extension_level), intent(inout) :: level

    if (fine%is_alone() .or. product(level%cells) < FEWEST_SHARED) return
    level%rows = fine
    level%rows%cells = level%cells
    level%rows%first = (fine%first + 2)/2
  end subroutine share_rows

  !> Add up the rows of the grid `coarse`, of its values or `of_cover`, which each rank has found from its rows of
  !> `fine`.
  subroutine add_up(fine, coarse, of_cover)
    type(extension_level), intent(in) :: fine
    type(extension_level), intent(inout), target :: coarse
    logical, intent(in) :: of_cover
    real(sp), pointer, contiguous :: values(:, :)
    integer :: j, n

    values => coarse%values
    if (of_cover) values => coarse%inverse
    if (.not. coarse%rows%is_alone()) then
      call coarse%halo%collect(coarse%rows, coarse%first - 1, values)
    else if (.not. fine%rows%is_alone()) then
      n = size(values, 1)
      do j = 1, size(values, 2)
        coarse%sums(n*(j - 1) + 1:n*j) = real(values(:, j), dp)
      end do
      call fine%rows%add(coarse%sums)
      do j = 1, size(values, 2)
        values(:, j) = real(coarse%sums(n*(j - 1) + 1:n*j), sp)
      end do
    end if
  end subroutine add_up

  !> Copy the rows of the halo, of the values or `of_cover`, from the ranks that have them; nothing where all rows are
  !> here.
  subroutine fetch_halo(level, of_cover)
    type(extension_level), intent(inout), target :: level
    logical, intent(in) :: of_cover
    real(sp), pointer, contiguous :: values(:, :)

    values => level%values
    if (of_cover) values => level%inverse
    if (.not. level%rows%is_alone()) call level%halo%fetch(level%rows, level%first - 1, values)
  end subroutine fetch_halo

  !> The `cover` (n) of the points: 1 on the set, 0 off it.
  subroutine point_to_cover(self, cover)
    class(set_extension), intent(in), target :: self
    real(sp), pointer, contiguous, intent(out) :: cover(:)

    cover(1:size(self%levels(1)%cover)) => self%levels(1)%cover
  end subroutine point_to_cover

  !> E: give the `values` (n) of the set to open points too, whose own values do not count. On no more cells than the
  !> coarsest grid has they stay as they are, and are to be zero.
  subroutine extend(self, values)
    class(set_extension), intent(inout), target :: self
    real(sp), intent(inout), contiguous, target :: values(:)
    type(row_pass) :: pass
    integer :: l

    do l = 1, self%depth - 1
      call point_to(self, l, values, pass)
      call pass%go(average_cells, lbound(pass%coarse%values, 2), ubound(pass%coarse%values, 2))
      call add_up(pass%fine, pass%coarse, .false.)
    end do
    do l = self%depth - 1, 1, -1
      call point_to(self, l, values, pass)
      call fetch_halo(pass%coarse, .false.)
      call pass%go(fill_cells, pass%fine%first, pass%fine%last)
    end do
  end subroutine extend

  !> E^T: distribute the `values` (n) of open points to the set; these are zero then. On no more
  !> cells than the coarsest grid has all stay as they are.
  subroutine collect(self, values)
    class(set_extension), intent(inout), target :: self
    real(sp), intent(inout), contiguous, target :: values(:)
    type(row_pass) :: pass
    integer :: l

    do l = 1, self%depth - 1
      call point_to(self, l, values, pass)
      call pass%go(collect_cells, lbound(pass%coarse%values, 2), ubound(pass%coarse%values, 2))
      call add_up(pass%fine, pass%coarse, .false.)
    end do
    do l = self%depth - 1, 1, -1
      call point_to(self, l, values, pass)
      call fetch_halo(pass%coarse, .false.)
      call pass%go(spread_cells, pass%fine%first, pass%fine%last)
    end do
  end subroutine collect

  !> Point a pass to level `l`, on the finest one with `values`, and to the next one.
  subroutine point_to(self, l, values, pass)
    class(set_extension), intent(in), target :: self
    integer, intent(in) :: l
    real(sp), intent(in), contiguous, target :: values(:)
    type(row_pass), intent(inout) :: pass

    call point_to_level(self, l, pass)
    if (l > 1) then
      pass%values => self%levels(l)%values
    else
      pass%values(1:pass%fine%cells(1), pass%fine%first:pass%fine%last) => values
    end if
  end subroutine point_to

  !> Point a pass to level `l` and to the next one, if there is one.
  subroutine point_to_level(self, l, pass)
    class(set_extension), intent(in), target :: self
    integer, intent(in) :: l
    type(row_pass), intent(inout) :: pass

    pass%fine => self%levels(l)
    if (l == size(self%levels)) return
    pass%coarse => self%levels(l + 1)
    pass%wraps = pass%coarse%rows%is_alone()
  end subroutine point_to_level

  !> Do `operation` on the rows `first` .. `last`.
  subroutine go(self, operation, first, last)
    class(row_pass), intent(inout) :: self
    procedure(row_operation) :: operation
    integer, intent(in) :: first, last
    integer :: parts, rows

    self%operation => operation
    self%first = first
    self%last = last
    rows = last - first + 1
    parts = 1
    if (real(self%fine%cells(1), dp)*rows >= FEWEST_FOR_THREADS) parts = min(threads_here(), rows)
    call run_in_parts(parts, self)
  end subroutine go

  subroutine do_part(self, part, parts)
    class(row_pass), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, j, last

    call share(self%last - self%first + 1, part, parts, first, last)
    do j = self%first + first, self%first + last
      call self%operation(self, j)
    end do
  end subroutine do_part

  !> Cover of the finest cells.
  subroutine mark_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j

    pass%fine%cover(:, j) = merge(1.0_sp, 0.0_sp, pass%contact(:, j))
  end subroutine mark_cells

  !> The sums of the cover of their cells, for coarse cells.
  subroutine sum_cover(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: pair(2*pass%coarse%cells(1))
    integer :: k

    pair = 0.0_sp
    associate (n => pass%fine%cells(1))
      do k = max(2*j - 1, pass%fine%first), min(2*j, pass%fine%last)
        pair(:n) = pair(:n) + pass%fine%cover(:, k)
      end do
    end associate
    call sum_pairs(pass%coarse%cells(1), pair, pass%coarse%inverse(:, j))
  end subroutine sum_cover

  !> Cover of coarse cells, and one over that of their fine cells, of which the sums are known.
  subroutine cover_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    integer :: i, rows

    associate (n => pass%fine%cells, inverse => pass%coarse%inverse, cover => pass%coarse%cover)
      rows = fine_cells(n(2), modulo(j - 1, pass%coarse%cells(2)) + 1)
      do i = 1, size(inverse, 1)
        cover(i, j) = min(pass%cover_growth*inverse(i, j)/real(fine_cells(n(1), i)*rows, sp), 1.0_sp)
        if (inverse(i, j) > 0.0_sp) inverse(i, j) = 1.0_sp/inverse(i, j)
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
    associate (n => pass%fine%cells(1))
      do k = max(2*j - 1, pass%fine%first), min(2*j, pass%fine%last)
        call add_row(n, pass%fine%cover(:, k), pass%values(:, k), pair(:n))
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
    integer :: next_row

    associate (n => pass%fine%cells, m => pass%coarse%cells, values => pass%coarse%values)
      next_row = coarser_row(j)
      if (pass%wraps) next_row = modulo(next_row - 1, m(2)) + 1
      row = NEAR*values(:, (j + 1)/2) + NEXT*values(:, next_row)
      call interpolate_row(m(1), row, filling)
      call fill_row(n(1), pass%fine%cover(:, j), filling(:n(1)), pass%values(:, j))
    end associate
  end subroutine fill_cells

  !> The transpose of what fill_cells takes from coarse cells.
  subroutine collect_cells(pass, j)
    class(row_pass), intent(inout) :: pass
    integer, intent(in) :: j
    real(sp) :: rows(2*pass%coarse%cells(1))
    integer :: beside(2)

    rows = 0.0_sp
    beside = [2*j - 2, 2*j + 1]
    if (pass%wraps) beside = modulo(beside - 1, 2*pass%coarse%cells(2)) + 1
    associate (m => pass%coarse%cells)
      call add_open(pass, NEAR, 2*j - 1, rows)
      call add_open(pass, NEAR, 2*j, rows)
      call add_open(pass, NEXT, beside(1), rows)
      call add_open(pass, NEXT, beside(2), rows)
      call collect_row(m(1), rows, pass%coarse%values(:, j))
    end associate
  end subroutine collect_cells

  !> Add `weight` times what is not covered of row `k` of the fine grid to `rows`; nothing if it has no such row here.
  subroutine add_open(pass, weight, k, rows)
    class(row_pass), intent(in) :: pass
    real(sp), intent(in) :: weight
    integer, intent(in) :: k
    real(sp), intent(inout) :: rows(:)

    if (k < pass%fine%first .or. k > pass%fine%last) return
    associate (n => pass%fine%cells(1))
      call add_open_row(n, weight, pass%fine%cover(:, k), pass%values(:, k), rows(:n))
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
