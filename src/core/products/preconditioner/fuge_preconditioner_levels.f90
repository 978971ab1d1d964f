!> Levels of cells for the preconditioner of a contact set of many segments.
!>
!> Each level has cells sixteen times as wide as those of the level before: the preconditioner of each level handles
!> what varies within groups of sixteen of its cells, and the next level handles the group means. doc/theory.md shows
!> that the sum over the levels is symmetric and positive definite.
module fuge_preconditioner_levels
  use fuge_kinds, only: dp
  use fuge_level_groups, only: add_to_groups, compute_group_means, subtract_from_groups, sum_over_groups, GROUP
  use fuge_number_text, only: text
  use fuge_operator_products, only: precondition
  use fuge_operator_type, only: fuge_operator
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_status, only: composed_message, fuge_info, report
  implicit none
  private

  public :: apply_levels, count_contacts, create_level, exists

  !> From one level to the next the cell width doubles this many times, so that a cell is a GROUP of cells.
  integer, parameter :: DOUBLINGS_PER_LEVEL = 4

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
    !> Which cells each rank has, where several share them.
    type(shared_rows) :: rows = shared_rows()
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
  !> (doc/theory.md). `stat` is not 0 where memory is short, maybe on this rank only.
  subroutine create_level(operator, number, level, force, stat)
    class(fuge_operator), intent(in) :: operator
    integer, intent(in) :: number
    type(preconditioner_level), intent(inout) :: level
    type(level_force), intent(inout) :: force
    integer, intent(out) :: stat
    class(fuge_operator), pointer :: kept
    class(fuge_operator), allocatable :: coarse
    type(fuge_info) :: info
    integer :: grid(2), cells, own

    stat = 0
    grid = operator%grid()
    if (exists(level) .or. all(grid > 1)) return
    cells = (product(grid) - 1)/GROUP**(number - 1) + 1
    call operator%kept_coarser(DOUBLINGS_PER_LEVEL*(number - 1), kept)
    if (associated(kept)) then
      if (.not. is_usable(kept, cells)) return
      own = kept%points()
      call rows_of(kept, 0, level%rows, info)
    else
      call operator%coarsen(DOUBLINGS_PER_LEVEL*(number - 1), coarse)
      if (.not. allocated(coarse)) return
      if (.not. is_usable(coarse, cells)) return
      own = coarse%points()
      call rows_of(coarse, 0, level%rows, info)
    end if
    if (info%failed()) stat = 1
    if (stat == 0) allocate (level%weight(own), level%indicator(own), level%residual(own), force%values(own), stat=stat)
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

    usable = product(coarse%grid()) == cells
    if (usable) usable = coarse%has_preconditioner()
  end function is_usable

  !> Count the points in contact in the cells of every level. Error: FUGE_ERR_MEMORY.
  subroutine count_contacts(levels, contact, info)
    type(preconditioner_level), intent(inout) :: levels(:)
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    integer :: l

    levels(1)%weight = merge(1.0_dp, 0.0_dp, contact)
    do l = 2, size(levels)
      call sum_over_groups(levels(l - 1)%rows, levels(l)%rows, levels(l - 1)%weight, levels(l)%weight, info)
      if (info%failed()) return
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
      associate (fine => levels(1), coarse => levels(2))
        call compute_group_means(fine%rows, coarse%rows, fine%weight, fine%residual, coarse%weight, coarse%residual, &
                                 info)
        if (info%failed()) return
        if (allocated(fine%indicator)) then
          call subtract_from_groups(fine%rows, coarse%rows, coarse%residual, fine%indicator, fine%residual, info)
        else
          call subtract_from_groups(fine%rows, coarse%rows, coarse%residual, fine%weight, fine%residual, info)
        end if
      end associate
      if (info%failed()) return
    end if
    if (exists(levels(1))) then
      call precondition_coarse(levels(1), product(operator%grid()), force, coarse_share, info)
    else
      call precondition(operator, levels(1)%residual, force, info)
    end if
    if (info%failed() .or. size(levels) == 1) return
    associate (fine => levels(1)%rows, coarse => levels(2)%rows, means => forces(2)%values)
      call compute_group_means(fine, coarse, levels(1)%weight, force, levels(2)%weight, means, info)
      if (.not. info%failed()) call add_to_groups(fine, coarse, -1.0_dp, means, force, info)
      if (.not. info%failed()) call apply_levels(levels(2:), forces(2:), operator, means, coarse_share, info)
      if (.not. info%failed()) call add_to_groups(fine, coarse, 1.0_dp, means, force, info)
    end associate
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
    associate (cells => level%rows%points(size(force)))
      coarse_share = coarse_share + real(cells, dp)/real(points, dp)
      if (coarse%failed()) call report(info, coarse%status, 'on the grid of '//text(cells)//' cells: ' &
                                       //composed_message(coarse))
    end associate
    where (level%weight > 0.0_dp) force = force/level%weight
  end subroutine precondition_coarse

end module fuge_preconditioner_levels
