!> Nested iteration: contact sets and forces on coarser grids first, from the coarsest to the
!> finest, so that on the finest grid only the edges of contact are left to move.
!>
!> fuge_grid_transfer carries gaps to a coarser grid and forces to the next finer one.
module fuge_nested_grids
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_scene, only: coarser_scene, contact_scene
  use fuge_contact_set_search, only: find_contact_set
  use fuge_extended_forces, only: extend_forces
  use fuge_feasible_forces, only: clip_forces
  use fuge_grid_transfer, only: coarser_cells
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_search_settings, only: search_settings
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_shared_transfer, only: prolong_to
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: coarsest_level, nested_iteration

  !> Products and preconditionings on windows or coarser grids, each counted as the fraction of its cells.
  type, public :: shared_work
    real(dp) :: products = 0.0_dp, preconditionings = 0.0_dp
  contains
    procedure :: add => add_work
  end type shared_work

contains

  !> The level of the grid whose single cell has 2**level cells of the finest grid in its longer direction.
  function coarsest_level(operator) result(level)
    class(fuge_operator), intent(in) :: operator
    integer :: level

    level = digits(max(maxval(operator%grid()), 1)) - 1
    if (any(operator%grid() < 1)) level = 0
  end function coarsest_level

  !> Solve on the grids of the operator whose cells are 2**k times as wide, for k from `first` down to `last` >= 1.
  !>
  !> `settings` those of a coarser grid; `reduced_gap` (n) of the finest grid and `start`, scaled as in contact_iterate.
  !> `start` in: the forces of grid first + 1, or unallocated; out: those of grid `last`, or of the last one before it
  !> that the operator has; unallocated if it has none, or if the search on the last one failed. `work` counts in units
  !> of a cell. Errors: those of find_contact_set, but FUGE_ERR_ITERATION_LIMIT only if the limit of `settings` is
  !> reached, and no FUGE_ERR_NOT_DEFINITE; FUGE_ERR_MEMORY. The arguments are nine, because a window goes through
  !> some of the grids only.
  subroutine nested_iteration(operator, settings, scene, first, last, monitor, start, work, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: first, last
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(shared_work), intent(inout) :: work
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: coarse
    class(fuge_operator), pointer :: kept
    type(fuge_info) :: coarse_info
    type(search_settings) :: coarse_settings
    integer :: finest(2), cells(2), k

    finest = operator%grid()
    coarse_settings = settings
    do k = first, last, -1
      cells = coarser_cells(finest, k)
      coarse_info = fuge_info(iterations=info%iterations)
      ! A coarse grid must not spend in vain the iterations of the finer ones.
      coarse_settings%limit = min(settings%limit, info%iterations + iteration_limit(fuge_options(), product(cells)))
      call operator%kept_coarser(k, kept)
      if (associated(kept)) then
        if (any(kept%grid() /= cells)) cycle
        call solve_on_grid(kept, coarse_settings, scene, finest, k, monitor, start, coarse_info)
      else
        call operator%coarsen(k, coarse)
        if (.not. allocated(coarse)) cycle
        if (any(coarse%grid() /= cells)) cycle
        call solve_on_grid(coarse, coarse_settings, scene, finest, k, monitor, start, coarse_info)
      end if
      info%iterations = coarse_info%iterations
      call work%add(product(cells), coarse_info)
      if (is_left(coarse_info, settings%limit)) then
        if (allocated(start)) deallocate (start)
      else if (coarse_info%failed()) then
        call report(info, coarse_info%status, 'on the grid of '//text(product(cells))//' points: ' &
                    //composed_message(coarse_info))
        return
      end if
    end do
  end subroutine nested_iteration

  !> Is a grid left whose search ended with `info`? It only provides a start, which a finer grid can do without. Not at
  !> the `limit` of all grids together.
  pure function is_left(info, limit) result(left)
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: limit
    logical :: left

    left = info%status == FUGE_ERR_NOT_DEFINITE &
           .or. (info%status == FUGE_ERR_ITERATION_LIMIT .and. info%iterations < limit)
  end function is_left

  !> Add the products and preconditionings of `info`, made on `cells` cells.
  pure subroutine add_work(self, cells, info)
    class(shared_work), intent(inout) :: self
    integer, intent(in) :: cells
    type(fuge_info), intent(in) :: info

    self%products = self%products + real(cells, dp)*real(info%products, dp)
    self%preconditionings = self%preconditionings + real(cells, dp)*real(info%preconditionings, dp)
  end subroutine add_work

  !> Solve on the grid that is `level` times coarser than the finest one, of `finest` cells in each direction, with its
  !> `scene`. `start` in: the forces of the next coarser grid, if there is one; out: those of this grid, unallocated
  !> where its cells cannot carry the resultants.
  subroutine solve_on_grid(operator, settings, scene, finest, level, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: finest(2), level
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    type(contact_scene) :: coarse
    type(shared_rows) :: rows
    logical :: possible

    call rows_of(operator, 0, rows, info)
    if (.not. info%failed()) call coarser_scene(scene, finest, level, coarse, possible, info, rows)
    if (info%failed()) return
    if (.not. possible) then
      if (allocated(start)) deallocate (start)
      return
    end if
    ! Means may all be far above the least gap of the finest grid: beside them small displacements would be rounding.
    if (.not. scene%prescribed) coarse%gap = coarse%gap - rows%least(minval(coarse%gap))
    if (allocated(start)) call prolong_to(operator, start, info)
    if (.not. info%failed()) call start_iterate(iterate, coarse, start, info)
    if (.not. info%failed()) call find_contact_set(operator, settings, coarse, monitor, iterate, info)
    if (info%failed()) return
    ! Tensile forces that a coarse grid leaves help to interpolate, but with play would start at the wrong stop.
    if (allocated(coarse%play)) call clip_forces(coarse, iterate%contact_set)
    if (coarse%has_limits()) call extend_forces(coarse, iterate)
    call move_alloc(iterate%force, start)
  end subroutine solve_on_grid

end module fuge_nested_grids
