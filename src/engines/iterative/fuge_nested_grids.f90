!> Nested iteration: contact sets and forces on coarser grids first, from the coarsest to the
!> finest, so that on the finest grid only the edges of contact are left to move.
!>
!> Gaps are restricted to a coarser grid as means over its cells; forces are prolonged to the next
!> finer grid linearly.
module fuge_nested_grids
  use fuge_contact_set_search, only: find_contact_set, search_settings
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_projected_gradients, only: contact_iterate, start_iterate
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: nested_iteration, prolong, restrict_gap

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
    integer :: cells, k

    products = 0.0_dp
    preconditionings = 0.0_dp
    do k = digits(operator%points()) - 1, 1, -1
      cells = (operator%points() - 1)/2**k + 1
      coarse_info = fuge_info(iterations=info%iterations)
      call operator%kept_coarser(k, kept)
      if (associated(kept)) then
        if (kept%points() /= cells) cycle
        call solve_on_grid(kept, settings, reduced_gap, 2**k, monitor, start, coarse_info)
      else
        call operator%coarsen(k, coarse)
        if (.not. allocated(coarse)) cycle
        if (coarse%points() /= cells) cycle
        call solve_on_grid(coarse, settings, reduced_gap, 2**k, monitor, start, coarse_info)
      end if
      info%iterations = coarse_info%iterations
      share = real(cells, dp)/real(size(reduced_gap), dp)
      products = products + share*real(coarse_info%products, dp)
      preconditionings = preconditionings + share*real(coarse_info%preconditionings, dp)
      if (coarse_info%failed()) then
        call report(info, coarse_info%status, 'on the grid of '//text(cells)//' points: ' &
                    //composed_message(coarse_info))
        exit
      end if
    end do
    if (allocated(start) .and. .not. info%failed()) call prolong(size(reduced_gap), start, info)
    info%products = info%products + ceiling(products)
    info%preconditionings = info%preconditionings + ceiling(preconditionings)
  end subroutine nested_iteration

  !> Solve on one grid, each of whose cells is `width` cells of the finest one wide, with the gaps
  !> `finest_gap`. `start` in: the forces of the next coarser grid, if there is one; out: those of this grid.
  subroutine solve_on_grid(operator, settings, finest_gap, width, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    real(dp), intent(in), contiguous :: finest_gap(:)
    integer, intent(in) :: width
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    real(dp), allocatable :: reduced_gap(:)

    call restrict_gap(finest_gap, width, operator%points(), reduced_gap, info)
    if (info%failed()) return
    if (allocated(start)) call prolong(size(reduced_gap), start, info)
    if (.not. info%failed()) call start_iterate(iterate, size(reduced_gap), settings%prescribed, start, info)
    if (.not. info%failed()) call find_contact_set(operator, settings, reduced_gap, monitor, iterate, info)
    if (.not. info%failed()) call move_alloc(iterate%force, start)
  end subroutine solve_on_grid

  !> Prolong forces, in place, to the next finer grid of `n` cells; deallocate them if it is not
  !> the next one, but a grid in between is missing. Error: FUGE_ERR_MEMORY.
  !>
  !> A coarse cell stands for two fine cells, the last one for a single cell if n is odd. For
  !> even n the sum of the forces is conserved; forces linear along the grid are prolonged exactly
  !> but for the first and last cell.
  pure subroutine prolong(n, force, info)
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: fine(:)
    integer :: stat

    if (size(force) /= (n + 1)/2) then
      deallocate (force)
      return
    end if
    allocate (fine(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the starting forces on '//text(n)//' points')
      return
    end if
    call interpolate_forces(force, fine)
    call move_alloc(fine, force)
  end subroutine prolong

  !> Linear interpolation between the centres of the coarse cells; each coarse cell carries the
  !> forces of two fine cells.
  pure subroutine interpolate_forces(coarse, fine)
    real(dp), intent(in) :: coarse(:)
    real(dp), intent(out) :: fine(:)
    integer :: k, last

    last = size(coarse)
    do k = 1, last
      fine(2*k - 1) = 0.375_dp*coarse(k) + 0.125_dp*coarse(max(k - 1, 1))
      if (2*k <= size(fine)) fine(2*k) = 0.375_dp*coarse(k) + 0.125_dp*coarse(min(k + 1, last))
    end do
  end subroutine interpolate_forces

  !> Restrict gaps to a grid of `cells` cells, each `width` cells wide (the last one may be
  !> narrower): `coarse` (cells) are the means over them. Error: FUGE_ERR_MEMORY.
  pure subroutine restrict_gap(reduced_gap, width, cells, coarse, info)
    real(dp), intent(in) :: reduced_gap(:)
    integer, intent(in) :: width, cells
    real(dp), allocatable, intent(out) :: coarse(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, last, k, stat

    allocate (coarse(cells), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps of '//text(cells)//' cells')
      return
    end if
    do k = 1, cells
      first = (k - 1)*width + 1
      last = min(k*width, size(reduced_gap))
      coarse(k) = sum(reduced_gap(first:last))/real(last - first + 1, dp)
    end do
  end subroutine restrict_gap

end module fuge_nested_grids
