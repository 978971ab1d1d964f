!> A contact that fills a small fraction of a large grid is solved on a window of the grid, because forces
!> vanish elsewhere: products with the window's cells are exact for its forces, and much cheaper.
!>
!> A coarse grid tells where the contact is. The window has a margin around it, and grows where the
!> contact reaches its rim. One product tells whether its forces solve the whole grid
!> (fuge_window_confirmation); otherwise the search there starts from them.
module fuge_contact_window
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set_search, only: find_contact_set
  use fuge_grid_transfer, only: coarser_cells
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_nested_grids, only: coarsest_level, nested_iteration, shared_work
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_search_settings, only: search_settings
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_shared_transfer, only: prolong_to
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: solve_in_window, survey_level

  !> The coarse grid that locates the contact has at most this many cells, and the finest grid at least
  !> FINER times as many.
  integer, parameter :: SURVEY_CELLS = 4096, FINER = 16
  !> A window of more than this fraction of the grid saves too little.
  real(dp), parameter :: WORTHWHILE = 0.25_dp
  !> The limits of the forces in a window carry at least this multiple of the load: near their sum all points would be
  !> at their limits.
  real(dp), parameter :: ROOM = 1.5_dp
  !> Margin around the contact of the coarse grid, in its cells.
  integer, parameter :: MARGIN = 2

  !> The cells first(1) .. last(1) of the rows first(2) .. last(2) of a grid of `cells`.
  type :: cell_box
    integer :: cells(2) = 0, first(2) = 1, last(2) = 0
  contains
    procedure :: extent
    procedure :: gather
    procedure :: scatter
    procedure, private :: rows_here
    procedure, private :: copy_rows
    procedure, private :: place_rows
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
    if (any(cells < 2)) return
    if (product(cells)/SURVEY_CELLS < FINER) return
    do while (product(coarser_cells(cells, level)) > SURVEY_CELLS)
      level = level + 1
    end do
  end function survey_level

  !> Forces to start from, `start`, solved on a window of the finest grid.
  !>
  !> `coarse_settings` those of coarser grids, `settings` those of the finest one; `scene` one that fits a window;
  !> `start` in: the forces on the grid that is `level` times coarser; out, if `solved`: those on the finest grid,
  !> otherwise unchanged, because the window would be too large or the operator has none, nor that coarser grid;
  !> `least_compliance` as in conjugate_gradients, unknown to a whole grid that needs no step, 0 unless `solved`. Eleven
  !> arguments: two settings and three results. Errors: those of find_contact_set, FUGE_ERR_MEMORY.
  subroutine solve_in_window(operator, coarse_settings, settings, scene, level, monitor, start, work, solved, &
                             least_compliance, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: coarse_settings, settings
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: level
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(shared_work), intent(inout) :: work
    logical, intent(out) :: solved
    real(dp), intent(out) :: least_compliance
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: window
    type(cell_box) :: box
    type(shared_rows) :: rows
    real(dp), allocatable :: force(:)
    real(dp) :: compliance
    integer :: finest(2), own(2)
    logical :: grown

    solved = .false.
    least_compliance = 0.0_dp
    finest = operator%grid()
    call rows_of(operator, level, rows, info)
    if (info%failed()) return
    own = [1, coarser_rows(finest, level)]
    if (.not. rows%is_alone()) own = rows%own()
    if (.not. rows%everywhere(is_on_grid(finest, level, own, start))) return
    box = contact_box(finest, level, own, rows%point_space, start)
    do
      if (.not. is_worthwhile(box)) return
      if (.not. carries_load(box, scene)) then
        call widen(box, [.true., .true.], [.true., .true.])
        cycle
      end if
      call operator%window(box%first, box%last, window)
      if (.not. allocated(window)) return
      call rows_of(window, 0, rows, info)
      if (info%failed()) return
      call solve_on_window(window, rows, coarse_settings, settings, box, scene, monitor, force, compliance, work, info)
      if (info%failed()) return
      call grow(box, rows, force, grown)
      if (.not. grown) exit
      deallocate (force)
    end do
    call box%scatter(force, rows, scene%rows, start, info)
    solved = .not. info%failed()
    if (solved) least_compliance = compliance
  end subroutine solve_in_window

  !> Do the limits of the forces in the box leave room for the load, which is 1?
  function carries_load(box, scene) result(carries)
    type(cell_box), intent(in) :: box
    type(contact_scene), intent(in) :: scene
    logical :: carries
    real(dp) :: most
    integer :: begin, j, n(2), range(2)

    carries = scene%prescribed .or. .not. scene%has_limits()
    if (carries) return
    n = box%extent()
    range = box%rows_here(scene%rows)
    most = 0.0_dp
    do j = range(1), range(2)
      begin = box%cells(1)*(j - first_row(scene%rows)) + box%first(1)
      most = most + sum(min(scene%limit(begin:begin + n(1) - 1), 1.0_dp))
    end do
    carries = scene%rows%total(most) > ROOM
  end function carries_load

  !> Widen the box by half its cells on the sides `at_first` and `at_last`, of each direction.
  pure subroutine widen(box, at_first, at_last)
    type(cell_box), intent(inout) :: box
    logical, intent(in) :: at_first(2), at_last(2)
    integer :: cells(2)

    cells = box%extent()/2 + 1
    where (at_first) box%first = max(box%first - cells, 1)
    where (at_last) box%last = min(box%last + cells, box%cells)
  end subroutine widen

  !> Number of rows of the grid that is `level` times coarser.
  pure function coarser_rows(finest, level) result(rows)
    integer, intent(in) :: finest(2), level
    integer :: rows, cells(2)

    cells = coarser_cells(finest, level)
    rows = cells(2)
  end function coarser_rows

  !> Are there forces for the rows own(1) .. own(2) of the grid that is `level` times coarser?
  pure function is_on_grid(finest, level, own, force)
    integer, intent(in) :: finest(2), level, own(2)
    real(dp), intent(in) :: force(:)
    logical :: is_on_grid
    integer :: cells(2)

    cells = coarser_cells(finest, level)
    is_on_grid = size(force) == cells(1)*(own(2) - own(1) + 1)
  end function is_on_grid

  !> The cells of the finest grid that carry force on the grid that is `level` times coarser, with a margin. `force`:
  !> those of the rows own(1) .. own(2) of that grid, whose points `space` shares.
  function contact_box(finest, level, own, space, force) result(box)
    integer, intent(in) :: finest(2), level, own(2)
    type(point_space), intent(in) :: space
    real(dp), intent(in), contiguous :: force(:)
    type(cell_box) :: box
    real(dp) :: reach(4)
    integer :: cells(2), i, j

    cells = coarser_cells(finest, level)
    box%cells = finest
    box%first = cells
    box%last = 1
    do j = own(1), own(2)
      do i = 1, cells(1)
        if (.not. force(i + cells(1)*(j - own(1))) > 0.0_dp) cycle
        box%first = min(box%first, [i, j])
        box%last = max(box%last, [i, j])
      end do
    end do
    if (.not. space%is_alone()) then
      reach = real([-box%first, box%last], dp)
      call space%raise(reach)
      box%first = -int(reach(1:2))
      box%last = int(reach(3:4))
    end if
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

  !> Solve on the window `window`, of the rows `rows`: nested iteration on its own coarser grids, then to the tolerance.
  !> `force`: those of its cells; `least_compliance` as in conjugate_gradients. Eleven arguments, as of solve_in_window.
  subroutine solve_on_window(window, rows, coarse_settings, settings, box, scene, monitor, force, least_compliance, &
                             work, info)
    class(fuge_operator), intent(in) :: window
    type(shared_rows), intent(in) :: rows
    type(search_settings), intent(in) :: coarse_settings, settings
    type(cell_box), intent(in) :: box
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(out) :: force(:)
    real(dp), intent(out) :: least_compliance
    type(shared_work), intent(inout) :: work
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    type(contact_scene) :: window_scene
    real(dp), allocatable :: start(:)
    type(fuge_info) :: window_info

    least_compliance = 0.0_dp
    window_scene%prescribed = scene%prescribed
    window_scene%rows = rows
    call box%gather(scene%gap, scene%rows, rows, window_scene%gap, info)
    if (scene%has_limits()) then
      if (.not. info%failed()) call box%gather(scene%play, scene%rows, rows, window_scene%play, info)
      if (.not. info%failed()) call box%gather(scene%limit, scene%rows, rows, window_scene%limit, info)
      if (.not. info%failed()) call box%gather(scene%limit_upper, scene%rows, rows, window_scene%limit_upper, info)
    end if
    if (info%failed()) return
    if (.not. scene%prescribed) window_scene%gap = window_scene%gap - rows%least(minval(window_scene%gap))
    window_info = fuge_info(iterations=info%iterations)
    call nested_iteration(window, coarse_settings, window_scene, coarsest_level(window), 1, monitor, start, work, &
                          window_info)
    if (allocated(start) .and. .not. window_info%failed()) call prolong_to(window, start, window_info)
    if (.not. window_info%failed()) call start_iterate(iterate, window_scene, start, window_info)
    if (.not. window_info%failed()) call find_contact_set(window, settings, window_scene, monitor, iterate, window_info)
    call work%add(product(box%extent()), window_info)
    window_info%products = info%products
    window_info%preconditionings = info%preconditionings
    info = window_info
    least_compliance = iterate%gradients%least_compliance
    if (.not. info%failed()) call move_alloc(iterate%force, force)
  end subroutine solve_on_window

  !> Grow the window by half its cells on each side where the contact reaches its rim, but not that of the grid.
  !> `force`: those of the `rows` of the window that this rank has.
  subroutine grow(box, rows, force, grown)
    type(cell_box), intent(inout) :: box
    type(shared_rows), intent(in) :: rows
    real(dp), intent(in), contiguous :: force(:)
    logical, intent(out) :: grown
    logical :: at_first(2), at_last(2)
    integer :: j, k, n(2), own(2)

    n = box%extent()
    own = [1, n(2)]
    if (.not. rows%is_alone()) own = rows%own()
    at_first = .false.
    at_last = .false.
    do j = 1, own(2) - own(1) + 1
      at_first(1) = at_first(1) .or. force(n(1)*(j - 1) + 1) > 0.0_dp
      at_last(1) = at_last(1) .or. force(n(1)*j) > 0.0_dp
    end do
    if (own(1) <= own(2)) then
      if (own(1) == 1) at_first(2) = any(force(:n(1)) > 0.0_dp)
      if (own(2) == n(2)) at_last(2) = any(force(n(1)*(own(2) - own(1)) + 1:) > 0.0_dp)
    end if
    do k = 1, 2
      at_first(k) = rows%anywhere(at_first(k))
      at_last(k) = rows%anywhere(at_last(k))
    end do
    at_first = at_first .and. box%first > 1
    at_last = at_last .and. box%last < box%cells
    grown = any(at_first .or. at_last)
    call widen(box, at_first, at_last)
  end subroutine grow

  !> `inside`: the values of `whole` in the box, where ranks share the rows of both: `fine` those of the grid, `rows`
  !> those of the box. Error: FUGE_ERR_MEMORY.
  subroutine gather(self, whole, fine, rows, inside, info)
    class(cell_box), intent(in) :: self
    real(dp), intent(in), contiguous :: whole(:)
    type(shared_rows), intent(in) :: fine, rows
    real(dp), allocatable, intent(out) :: inside(:)
    type(fuge_info), intent(inout) :: info
    type(shared_rows) :: box_rows
    real(dp), allocatable :: cut(:)
    integer :: range(2), n(2), stat

    n = self%extent()
    range = self%rows_here(fine)
    allocate (cut(n(1)*max(range(2) - range(1) + 1, 0)), stat=stat)
    call require_memory(stat, 'a window of', product(n), 'points', info)
    call fine%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call self%copy_rows(range, first_row(fine), whole, cut)
    if (fine%is_alone()) then
      call move_alloc(cut, inside)
    else
      call self%place_rows(fine, box_rows)
      call box_rows%fetch(n(1), cut, first_rows(rows), last_rows(rows), inside, info)
    end if
  end subroutine gather

  !> `whole`: the values `inside` the box, zero outside; `rows` and `fine` as for `gather`. Error: FUGE_ERR_MEMORY.
  subroutine scatter(self, inside, rows, fine, whole, info)
    class(cell_box), intent(in) :: self
    real(dp), intent(inout), allocatable :: inside(:)
    type(shared_rows), intent(in) :: rows, fine
    real(dp), allocatable, intent(inout) :: whole(:)
    type(fuge_info), intent(inout) :: info
    type(shared_rows) :: box_rows
    real(dp), allocatable :: cut(:)
    integer :: first, j, n(2), own(2), range(2), stat

    if (allocated(whole)) deallocate (whole)
    own = [1, self%cells(2)]
    if (.not. fine%is_alone()) own = fine%own()
    allocate (whole(self%cells(1)*(own(2) - own(1) + 1)), stat=stat)
    call require_memory(stat, 'the starting forces on', self%cells(1)*(own(2) - own(1) + 1), 'points', info)
    call fine%agree(info)
    if (stat /= 0 .or. info%failed()) return
    n = self%extent()
    if (fine%is_alone()) then
      call move_alloc(inside, cut)
    else
      call self%place_rows(fine, box_rows)
      call rows%fetch(n(1), inside, first_rows(box_rows), last_rows(box_rows), cut, info)
      if (info%failed()) return
    end if
    whole = 0.0_dp
    range = self%rows_here(fine)
    do j = range(1), range(2)
      first = self%cells(1)*(j - own(1)) + self%first(1)
      whole(first:first + n(1) - 1) = cut(n(1)*(j - range(1)) + 1:n(1)*(j - range(1) + 1))
    end do
  end subroutine scatter

  !> The rows of the grid that this rank has and that lie in the box, the first and the last one.
  pure function rows_here(self, fine) result(range)
    class(cell_box), intent(in) :: self
    type(shared_rows), intent(in) :: fine
    integer :: range(2), own(2)

    range = [self%first(2), self%last(2)]
    if (fine%is_alone()) return
    own = fine%own()
    range = [max(range(1), own(1)), min(range(2), own(2))]
  end function rows_here

  !> `cut`: the cells in the box of the rows range(1) .. range(2) of the grid; `whole` begins with row `first`.
  pure subroutine copy_rows(self, range, first, whole, cut)
    class(cell_box), intent(in) :: self
    integer, intent(in) :: range(2), first
    real(dp), intent(in), contiguous :: whole(:)
    real(dp), intent(inout), contiguous :: cut(:)
    integer :: begin, j, n(2)

    n = self%extent()
    do j = range(1), range(2)
      begin = self%cells(1)*(j - first) + self%first(1)
      cut(n(1)*(j - range(1)) + 1:n(1)*(j - range(1) + 1)) = whole(begin:begin + n(1) - 1)
    end do
  end subroutine copy_rows

  !> The rows of the box as they lie on the ranks that share the rows `fine` of the grid.
  subroutine place_rows(self, fine, box_rows)
    class(cell_box), intent(in) :: self
    type(shared_rows), intent(in) :: fine
    type(shared_rows), intent(out) :: box_rows

    box_rows%point_space = fine%point_space
    box_rows%cells = self%extent()
    allocate (box_rows%first, source=fine%first)
    box_rows%first = min(max(fine%first - self%first(2), 0), box_rows%cells(2)) + 1
  end subroutine place_rows

  !> The first row of this rank.
  pure function first_row(rows) result(first)
    type(shared_rows), intent(in) :: rows
    integer :: first, own(2)

    first = 1
    if (rows%is_alone()) return
    own = rows%own()
    first = own(1)
  end function first_row

  !> The first row of each rank.
  pure function first_rows(rows) result(first)
    type(shared_rows), intent(in) :: rows
    integer :: first(rows%members())

    first = rows%first(0:rows%members() - 1)
  end function first_rows

  !> The last row of each rank.
  pure function last_rows(rows) result(last)
    type(shared_rows), intent(in) :: rows
    integer :: last(rows%members())

    last = rows%first(1:rows%members()) - 1
  end function last_rows

end module fuge_contact_window
