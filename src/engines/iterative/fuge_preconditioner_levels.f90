!> Levels of cells for the preconditioner of a contact set of many segments.
!>
!> Each level has cells sixteen times as wide as those of the level before: the preconditioner of each level handles what
!> varies within groups of sixteen of its cells, and the next level handles the group means. doc/theory.md shows that the
!> sum over the levels is symmetric and positive definite.
module fuge_preconditioner_levels
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_products, only: precondition
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: composed_message, fuge_info, report
  implicit none
  private

  public :: apply_levels, count_contacts, create_level, exists

  !> From one level to the next the cell width doubles this many times.
  integer, parameter :: DOUBLINGS_PER_LEVEL = 4
  !> Cells of one level in a cell of the next.
  integer, parameter :: GROUP = 2**DOUBLINGS_PER_LEVEL

  !> One level.
  type, public :: preconditioner_level
    !> The operator on the cells of this level, either kept by that of the finest level or owned by this
    !> one; neither on the finest level, where the caller passes it.
    class(fuge_operator), pointer :: kept => null()
    class(fuge_operator), allocatable :: owned
    !> Number of points in contact in each cell: the weight of the cell in means.
    real(dp), allocatable :: weight(:)
    !> 1 for cells with points in contact, else 0; unallocated on the finest level, where `weight`
    !> is just that.
    real(dp), allocatable :: indicator(:)
    !> The residual (length) that this level preconditions, zero off the contact; overwritten.
    real(dp), allocatable :: residual(:)
  end type preconditioner_level

  !> Forces on the cells of a level. They are no component of `preconditioner_level` because they
  !> are output where the level is input.
  type, public :: level_force
    real(dp), allocatable :: values(:)
  end type level_force

contains

  !> Create level `number` unless it exists already; it stays empty if the operator has no grid
  !> so coarse, and for a grid with rows and columns: on a surface the displacements of a force fall off with the
  !> distance, so that separate contacts hardly couple, and one level converges faster than two
  !> (doc/theory.md). `stat` is not 0 where memory is short.
  subroutine create_level(operator, number, level, force, stat)
    class(fuge_operator), intent(in) :: operator
    integer, intent(in) :: number
    type(preconditioner_level), intent(inout) :: level
    type(level_force), intent(inout) :: force
    integer, intent(out) :: stat
    class(fuge_operator), pointer :: kept
    class(fuge_operator), allocatable :: coarse
    integer :: grid(2), cells

    stat = 0
    grid = operator%grid()
    if (exists(level) .or. all(grid > 1)) return
    cells = (operator%points() - 1)/GROUP**(number - 1) + 1
    call operator%kept_coarser(DOUBLINGS_PER_LEVEL*(number - 1), kept)
    if (associated(kept)) then
      if (.not. is_usable(kept, cells)) return
    else
      call operator%coarsen(DOUBLINGS_PER_LEVEL*(number - 1), coarse)
      if (.not. allocated(coarse)) return
      if (.not. is_usable(coarse, cells)) return
    end if
    allocate (level%weight(cells), level%indicator(cells), level%residual(cells), force%values(cells), stat=stat)
    if (stat /= 0) return
    level%kept => kept
    if (allocated(coarse)) call move_alloc(coarse, level%owned)
  end subroutine create_level

  !> Does the level exist, and is it not the finest one?
  pure function exists(level)
    type(preconditioner_level), intent(in) :: level
    logical :: exists

    exists = associated(level%kept) .or. allocated(level%owned)
  end function exists

  !> Does the coarser operator have `cells` points and a preconditioner?
  function is_usable(coarse, cells) result(usable)
    class(fuge_operator), intent(in) :: coarse
    integer, intent(in) :: cells
    logical :: usable

    usable = coarse%points() == cells
    if (usable) usable = coarse%has_preconditioner()
  end function is_usable

  !> Count the points in contact in the cells of every level.
  pure subroutine count_contacts(levels, contact)
    type(preconditioner_level), intent(inout) :: levels(:)
    logical, intent(in) :: contact(:)
    integer :: k, l

    levels(1)%weight = merge(1.0_dp, 0.0_dp, contact)
    do l = 2, size(levels)
      do k = 1, size(levels(l)%weight)
        levels(l)%weight(k) = sum(levels(l - 1)%weight((k - 1)*GROUP + 1:min(k*GROUP, size(levels(l - 1)%weight))))
      end do
      levels(l)%indicator = min(levels(l)%weight, 1.0_dp)
    end do
  end subroutine count_contacts

  !> Force on each point as the sum over these levels of their preconditioners.
  !>
  !> The residual is levels(1)%residual, zero off the contact, and is overwritten. `operator` that
  !> of the finest grid; `force` is undefined off the contact.
  recursive subroutine apply_levels(levels, forces, operator, force, coarse_share, info)
    type(preconditioner_level), intent(inout) :: levels(:)
    type(level_force), intent(inout) :: forces(:)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(inout) :: coarse_share
    type(fuge_info), intent(inout) :: info

    if (size(levels) > 1) then
      call compute_group_means(levels(1)%weight, levels(1)%residual, levels(2)%weight, levels(2)%residual)
      if (allocated(levels(1)%indicator)) then
        call subtract_from_groups(levels(2)%residual, levels(1)%indicator, levels(1)%residual)
      else
        call subtract_from_groups(levels(2)%residual, levels(1)%weight, levels(1)%residual)
      end if
    end if
    if (exists(levels(1))) then
      call precondition_coarse(levels(1), operator%points(), force, coarse_share, info)
    else
      call precondition(operator, levels(1)%residual, force, info)
    end if
    if (info%failed() .or. size(levels) == 1) return
    call compute_group_means(levels(1)%weight, force, levels(2)%weight, forces(2)%values)
    call add_to_groups(-1.0_dp, forces(2)%values, force)
    call apply_levels(levels(2:), forces(2:), operator, forces(2)%values, coarse_share, info)
    call add_to_groups(1.0_dp, forces(2)%values, force)
  end subroutine apply_levels

  !> The preconditioner of a coarser level; the force on a cell is divided evenly among its points
  !> in contact. `points` number of points of the finest grid.
  subroutine precondition_coarse(level, points, force, coarse_share, info)
    type(preconditioner_level), intent(in) :: level
    integer, intent(in) :: points
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(inout) :: coarse_share
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: coarse

    if (associated(level%kept)) then
      call precondition(level%kept, level%residual, force, coarse)
    else
      call precondition(level%owned, level%residual, force, coarse)
    end if
    coarse_share = coarse_share + real(size(force), dp)/real(points, dp)
    if (coarse%failed()) call report(info, coarse%status, 'on the grid of '//text(size(force))//' cells: ' &
                                     //composed_message(coarse))
    where (level%weight > 0.0_dp) force = force/level%weight
  end subroutine precondition_coarse

  !> Weighted mean of `fine` over each group of cells; 0 for a group of weight 0.
  pure subroutine compute_group_means(weight, fine, coarse_weight, coarse)
    real(dp), intent(in), contiguous :: weight(:), fine(:), coarse_weight(:)
    real(dp), intent(inout), contiguous :: coarse(:)
    integer :: first, last, k

    do k = 1, size(coarse)
      coarse(k) = 0.0_dp
      if (.not. coarse_weight(k) > 0.0_dp) cycle
      first = (k - 1)*GROUP + 1
      last = min(k*GROUP, size(fine))
      coarse(k) = sum(weight(first:last)*fine(first:last))/coarse_weight(k)
    end do
  end subroutine compute_group_means

  !> Subtract each group's value from those of its cells whose `indicator` is 1.
  pure subroutine subtract_from_groups(coarse, indicator, fine)
    real(dp), intent(in), contiguous :: coarse(:), indicator(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*GROUP + 1, min(k*GROUP, size(fine))
        fine(i) = fine(i) - coarse(k)*indicator(i)
      end do
    end do
  end subroutine subtract_from_groups

  !> Add `factor` times each group's value to all its cells. Meant for forces, which are undefined
  !> off the contact anyway.
  pure subroutine add_to_groups(factor, coarse, fine)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: coarse(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*GROUP + 1, min(k*GROUP, size(fine))
        fine(i) = fine(i) + factor*coarse(k)
      end do
    end do
  end subroutine add_to_groups

end module fuge_preconditioner_levels
