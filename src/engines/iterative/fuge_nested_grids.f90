!> Nested iteration: contact sets and forces on coarser grids first, from the coarsest to the
!> finest, so that on the finest grid only the edges of contact are left to move.
!>
!> fuge_grid_transfer carries gaps to a coarser grid and forces to the next finer one.
module fuge_nested_grids
  use fuge_contact_set_search, only: find_contact_set, search_settings
  use fuge_grid_transfer, only: coarser_cells, prolong, restrict_gap
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_projected_gradients, only: contact_iterate, start_iterate
  use fuge_status, only: composed_message, fuge_info, report
  implicit none
  private

  public :: nested_iteration

contains

  !> Forces to start from on the finest grid, by solving on all coarser grids of the operator.
  !>
  !> `settings` those of a coarser grid; `reduced_gap` (n) and `start` (n) scaled as in contact_iterate.
  !> `start` stays unallocated where the operator has no coarser grids. Products and
  !> preconditionings on a coarser grid count as fractions of one on the finest. Errors: those of
  !> find_contact_set, FUGE_ERR_MEMORY.
  subroutine nested_iteration(operator, settings, reduced_gap, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    real(dp), intent(in), contiguous :: reduced_gap(:)
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: coarse
    class(fuge_operator), pointer :: kept
    type(fuge_info) :: coarse_info
    real(dp) :: products, preconditionings, share
    integer :: finest(2), cells(2), k

    products = 0.0_dp
    preconditionings = 0.0_dp
    finest = operator%grid()
    if (any(finest < 1)) finest = [operator%points(), 1]
    do k = digits(maxval(finest)) - 1, 1, -1
      cells = coarser_cells(finest, k)
      coarse_info = fuge_info(iterations=info%iterations)
      call operator%kept_coarser(k, kept)
      if (associated(kept)) then
        if (kept%points() /= product(cells)) cycle
        call solve_on_grid(kept, settings, reduced_gap, finest, k, monitor, start, coarse_info)
      else
        call operator%coarsen(k, coarse)
        if (.not. allocated(coarse)) cycle
        if (coarse%points() /= product(cells)) cycle
        call solve_on_grid(coarse, settings, reduced_gap, finest, k, monitor, start, coarse_info)
      end if
      info%iterations = coarse_info%iterations
      share = real(product(cells), dp)/real(size(reduced_gap), dp)
      products = products + share*real(coarse_info%products, dp)
      preconditionings = preconditionings + share*real(coarse_info%preconditionings, dp)
      if (coarse_info%failed()) then
        call report(info, coarse_info%status, 'on the grid of '//text(product(cells))//' points: ' &
                    //composed_message(coarse_info))
        exit
      end if
    end do
    if (allocated(start) .and. .not. info%failed()) call prolong(finest, start, info)
    info%products = info%products + ceiling(products)
    info%preconditionings = info%preconditionings + ceiling(preconditionings)
  end subroutine nested_iteration

  !> Solve on the grid that is `level` times coarser than the finest one, of `finest` cells in each direction, with the
  !> gaps `finest_gap`. `start` in: the forces of the next coarser grid, if there is one; out: those of this grid.
  subroutine solve_on_grid(operator, settings, finest_gap, finest, level, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    real(dp), intent(in), contiguous :: finest_gap(:)
    integer, intent(in) :: finest(2), level
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    real(dp), allocatable :: reduced_gap(:)

    call restrict_gap(finest_gap, finest, level, reduced_gap, info)
    if (info%failed()) return
    if (allocated(start)) call prolong(coarser_cells(finest, level), start, info)
    if (.not. info%failed()) call start_iterate(iterate, size(reduced_gap), settings%prescribed, start, info)
    if (.not. info%failed()) call find_contact_set(operator, settings, reduced_gap, monitor, iterate, info)
    if (.not. info%failed()) call move_alloc(iterate%force, start)
  end subroutine solve_on_grid

end module fuge_nested_grids
