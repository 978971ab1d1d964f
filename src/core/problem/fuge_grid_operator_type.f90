!> The common base of operators on equal cells, whether or not ranks share these: checks, and coarser grids that are
!> kept.
module fuge_grid_operator_type
  use fuge_grid_store, only: grid_store
  use fuge_locks, only: lock, unlock, LOCK_GRIDS
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  implicit none
  private

  !> Equal cells of a surface, all of them here or shared by ranks; `grid` is zero before they are set.
  type, abstract, extends(fuge_operator), public :: grid_operator
    !> The coarser grids of its solves.
    type(grid_store), private :: coarser
  contains
    procedure :: make_room
    procedure :: take_coarser
    procedure :: drop_coarser
    procedure :: is_shared
    procedure :: has_preconditioner
    procedure :: check_sizes
    procedure :: kept_coarser
  end type grid_operator

contains

  !> Room for `count` coarser grids; what was kept is dropped.
  subroutine make_room(self, count)
    class(grid_operator), intent(inout) :: self
    integer, intent(in) :: count

    call self%coarser%create(count)
  end subroutine make_room

  !> Take the coarser grids of `source`, which has none afterwards.
  subroutine take_coarser(self, source)
    class(grid_operator), intent(inout) :: self, source

    call self%coarser%move_from(source%coarser)
  end subroutine take_coarser

  subroutine drop_coarser(self)
    class(grid_operator), intent(inout) :: self

    call self%coarser%clear()
  end subroutine drop_coarser

  !> Is it one whose cells ranks share? False by default.
  pure function is_shared(self)
    class(grid_operator), intent(in) :: self
    logical :: is_shared

    is_shared = self%points() < 0
  end function is_shared

  !> True after `set`.
  function has_preconditioner(self) result(preconditioned)
    class(grid_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = all(self%grid() > 0)
  end function has_preconditioner

  !> Has each rank two arrays of the right sizes, `first` and `second`? `status`, the same on all: 0,
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine check_sizes(self, first, second, status)
    class(grid_operator), intent(in) :: self
    integer, intent(in) :: first, second
    integer, intent(out) :: status
    type(point_space) :: space

    status = FUGE_ERR_CALL_ORDER
    if (any(self%grid() < 1)) return
    space = self%ranks()
    status = merge(FUGE_DONE, FUGE_ERR_SIZE, space%everywhere(first == self%points() .and. second == self%points()))
  end subroutine check_sizes

  !> As `coarsen`, but the wider cells are kept with those of the finest grid, for the next solve and for
  !> solves in other threads.
  subroutine kept_coarser(self, levels, coarse)
    class(grid_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), pointer, intent(out) :: coarse
    type(point_space) :: space
    integer :: k

    nullify (coarse)
    space = self%ranks()
    k = self%coarser%position_of(levels)
    if (.not. space%everywhere(k > 0)) return
    ! Ranks wait for each other, so no thread may hold the lock meanwhile: another one may need it to get there.
    if (space%is_alone()) call lock(LOCK_GRIDS)
    if (.not. allocated(self%coarser%grid(k)%operator)) call keep_coarser(self, levels, k)
    if (allocated(self%coarser%grid(k)%operator)) coarse => self%coarser%grid(k)%operator
    if (space%is_alone()) call unlock(LOCK_GRIDS)
  end subroutine kept_coarser

  !> Make element k of the kept grids, unless it has too few cells or memory is short. An operator of another kind,
  !> from a `coarsen` of the caller's own, is not kept: it may change from solve to solve.
  subroutine keep_coarser(self, levels, k)
    class(grid_operator), intent(in) :: self
    integer, intent(in) :: levels, k
    class(fuge_operator), allocatable :: wider

    call self%coarsen(levels, wider)
    if (.not. allocated(wider)) return
    select type (wider)
    class is (grid_operator)
      call wider%coarser%refer_to(self%coarser, k)
    class default
      return
    end select
    call move_alloc(wider, self%coarser%grid(k)%operator)
  end subroutine keep_coarser

end module fuge_grid_operator_type
