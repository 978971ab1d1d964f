!> A contact that fills a small part of a large grid is solved on a window of the grid, because forces
!> vanish elsewhere: products with the window's cells are exact for its forces, and much cheaper.
!>
!> A coarse grid tells where the contact is. The window has a margin around it, and grows where the
!> contact reaches its rim. Its forces are the start of the search on the whole grid, which then needs
!> one product to see that no point outside the window touches.
module fuge_contact_window
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set_search, only: find_contact_set, search_settings
  use fuge_grid_transfer, only: coarser_cells, prolong
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_nested_grids, only: coarsest_level, nested_iteration, shared_work
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: solve_in_window, survey_level

  !> The coarse grid that locates the contact has at most this many cells, and the finest grid at least
  !> FINER times as many.
  integer, parameter :: SURVEY_CELLS = 4096, FINER = 16
  !> A window of more than this fraction of the grid saves too little.
  real(dp), parameter :: WORTHWHILE = 0.25_dp
  !> Margin around the contact of the coarse grid, in its cells.
  integer, parameter :: MARGIN = 2

  !> The cells first(1) .. last(1) of the rows first(2) .. last(2) of a grid of `cells`.
  type :: cell_box
    integer :: cells(2) = 0, first(2) = 1, last(2) = 0
  contains
    procedure :: extent
    procedure :: gather
    procedure :: scatter
  end type cell_box

contains

  !> How many times the grid is coarsened for the grid that locates the contact; 0 if the finest grid is not
  !> large enough, or has no rows.
  function survey_level(operator) result(level)
    class(fuge_operator), intent(in) :: operator
    integer :: level
    integer :: cells(2)

    level = 0
    cells = operator%grid()
    if (any(cells < 2) .or. operator%points()/SURVEY_CELLS < FINER) return
    do while (product(coarser_cells(cells, level)) > SURVEY_CELLS)
      level = level + 1
    end do
  end function survey_level

  !> Forces to start from, `start`, solved on a window of the finest grid.
  !>
  !> `coarse_settings` those of coarser grids, `settings` those of the finest one; `scene` a simple
  !> one; `start` in: the forces on the grid that is `level` times coarser; out, if `solved`: those on the
  !> finest grid, otherwise unchanged, because the window would be too large or the operator has none, nor that coarser
  !> grid. Errors: those of find_contact_set, FUGE_ERR_MEMORY.
  subroutine solve_in_window(operator, coarse_settings, settings, scene, level, monitor, start, work, solved, &
                             info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: coarse_settings, settings
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: level
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(shared_work), intent(inout) :: work
    logical, intent(out) :: solved
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: part
    type(cell_box) :: box
    real(dp), allocatable :: force(:)
    integer :: finest(2)
    logical :: grown

    solved = .false.
    finest = operator%grid()
    if (size(start) /= product(coarser_cells(finest, level))) return
    box = contact_box(finest, level, start)
    do
      if (.not. is_worthwhile(box)) return
      call operator%window(box%first, box%last, part)
      if (.not. allocated(part)) return
      call solve_on_part(part, coarse_settings, settings, box, scene, monitor, force, work, info)
      if (info%failed()) return
      call grow(box, force, grown)
      if (.not. grown) exit
      deallocate (force)
    end do
    call box%scatter(force, start, info)
    solved = .not. info%failed()
  end subroutine solve_in_window

  !> The cells of the finest grid that carry force on the grid that is `level` times coarser, with a margin.
  pure function contact_box(finest, level, force) result(box)
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), contiguous :: force(:)
    type(cell_box) :: box
    integer :: cells(2), i, j

    cells = coarser_cells(finest, level)
    box%cells = finest
    box%first = cells
    box%last = 1
    do j = 1, cells(2)
      do i = 1, cells(1)
        if (.not. force(i + cells(1)*(j - 1)) > 0.0_dp) cycle
        box%first = min(box%first, [i, j])
        box%last = max(box%last, [i, j])
      end do
    end do
    box%first = max((box%first - MARGIN - 1)*2**level + 1, 1)
    box%last = min((box%last + MARGIN)*2**level, finest)
  end function contact_box

  !> Cells in each direction.
  pure function extent(self)
    class(cell_box), intent(in) :: self
    integer :: extent(2)

    extent = self%last - self%first + 1
  end function extent

  pure function is_worthwhile(box)
    type(cell_box), intent(in) :: box
    logical :: is_worthwhile
    integer :: n(2)

    n = box%extent()
    is_worthwhile = all(n > 1) .and. product(real(n, dp)) <= WORTHWHILE*product(real(box%cells, dp))
  end function is_worthwhile

  !> Solve on the window `part`: nested iteration on its own coarser grids, then to the tolerance. `force`: those of its
  !> cells.
  subroutine solve_on_part(part, coarse_settings, settings, box, scene, monitor, force, work, info)
    class(fuge_operator), intent(in) :: part
    type(search_settings), intent(in) :: coarse_settings, settings
    type(cell_box), intent(in) :: box
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(out) :: force(:)
    type(shared_work), intent(inout) :: work
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    type(contact_scene) :: part_scene
    real(dp), allocatable :: start(:)
    type(fuge_info) :: part_info

    part_scene%prescribed = scene%prescribed
    call box%gather(scene%gap, part_scene%gap, info)
    if (info%failed()) return
    if (.not. scene%prescribed) part_scene%gap = part_scene%gap - minval(part_scene%gap)
    part_info = fuge_info(iterations=info%iterations)
    call nested_iteration(part, coarse_settings, part_scene, coarsest_level(part), 1, monitor, start, work, part_info)
    if (allocated(start) .and. .not. part_info%failed()) call prolong(box%extent(), start, part_info)
    if (.not. part_info%failed()) call start_iterate(iterate, part_scene, start, part_info)
    if (.not. part_info%failed()) call find_contact_set(part, settings, part_scene, monitor, iterate, part_info)
    call work%add(part%points(), part_info)
    part_info%products = info%products
    part_info%preconditionings = info%preconditionings
    info = part_info
    if (.not. info%failed()) call move_alloc(iterate%force, force)
  end subroutine solve_on_part

  !> Grow the window by half its cells on each side where the contact reaches its rim, but not that of the grid.
  pure subroutine grow(box, force, grown)
    type(cell_box), intent(inout) :: box
    real(dp), intent(in), contiguous :: force(:)
    logical, intent(out) :: grown
    logical :: at_first(2), at_last(2)
    integer :: cells(2), j, n(2)

    n = box%extent()
    at_first = .false.
    at_last = .false.
    do j = 1, n(2)
      at_first(1) = at_first(1) .or. force(n(1)*(j - 1) + 1) > 0.0_dp
      at_last(1) = at_last(1) .or. force(n(1)*j) > 0.0_dp
    end do
    at_first(2) = any(force(:n(1)) > 0.0_dp)
    at_last(2) = any(force(n(1)*(n(2) - 1) + 1:) > 0.0_dp)
    at_first = at_first .and. box%first > 1
    at_last = at_last .and. box%last < box%cells
    grown = any(at_first .or. at_last)
    cells = n/2 + 1
    where (at_first) box%first = max(box%first - cells, 1)
    where (at_last) box%last = min(box%last + cells, box%cells)
  end subroutine grow

  !> `part`: the values of `whole` (n) in the box. Error: FUGE_ERR_MEMORY.
  pure subroutine gather(self, whole, part, info)
    class(cell_box), intent(in) :: self
    real(dp), intent(in), contiguous :: whole(:)
    real(dp), allocatable, intent(out) :: part(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, j, n(2), stat

    n = self%extent()
    allocate (part(product(n)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for a window of '//text(product(n))//' points')
      return
    end if
    do j = 1, n(2)
      first = self%cells(1)*(self%first(2) + j - 2) + self%first(1)
      part(n(1)*(j - 1) + 1:n(1)*j) = whole(first:first + n(1) - 1)
    end do
  end subroutine gather

  !> `whole`: the values of `part` in the box, zero outside. Error: FUGE_ERR_MEMORY.
  pure subroutine scatter(self, part, whole, info)
    class(cell_box), intent(in) :: self
    real(dp), intent(in), contiguous :: part(:)
    real(dp), allocatable, intent(inout) :: whole(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, j, n(2), stat

    if (allocated(whole)) deallocate (whole)
    allocate (whole(product(self%cells)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the starting forces on '//text(product(self%cells))//' points')
      return
    end if
    whole = 0.0_dp
    n = self%extent()
    do j = 1, n(2)
      first = self%cells(1)*(self%first(2) + j - 2) + self%first(1)
      whole(first:first + n(1) - 1) = part(n(1)*(j - 1) + 1:n(1)*j)
    end do
  end subroutine scatter

end module fuge_contact_window
