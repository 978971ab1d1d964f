!> What operators have in common whose cells the ranks of an MPI communicator share.
module fuge_shared_operator
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_null_ptr, c_ptr
  use fuge_grid_operator_type, only: grid_operator
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_rank_communicator, only: check_mpi, free_communicator, new_communicator, rank_communicator
  use fuge_point_space, only: point_space
  use fuge_shared_problem, only: differ
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_OPTION
  use mpi_f08, only: MPI_Comm
  implicit none
  private

  public :: owns

  !> Cells in rows, of which each rank has some, one after the other; a line of cells has rows of one cell.
  type, abstract, extends(grid_operator), public :: shared_operator
    !> Let FFTW time its algorithms.
    logical :: measured = .false.
    !> All ranks; coarser grids refer to those of the finest one.
    type(rank_communicator), pointer :: group => null()
    !> Address of the variable that owns the group.
    type(c_ptr), private :: group_owner = c_null_ptr
  contains
    procedure(find_rows), deferred :: own_rows
    procedure :: comm
    procedure :: ranks
    procedure :: is_shared
    procedure :: apply_with_magnitude
    procedure :: join
    procedure :: take_group
    procedure :: leave
    procedure :: check_same
    procedure :: agreed
  end type shared_operator

  abstract interface
    !> The first and the last row of this rank, from 1; [1, 0] where it has none, and before `set`.
    pure function find_rows(self) result(rows)
      import :: shared_operator
      class(shared_operator), intent(in) :: self
      integer :: rows(2)
    end function find_rows
  end interface

contains

  !> Begin with a group of the ranks of `comm`, which all of them call. Errors: FUGE_ERR_CALL_ORDER if MPI is not
  !> running, FUGE_ERR_MEMORY.
  subroutine join(self, comm, info)
    class(shared_operator), intent(inout), target :: self
    type(MPI_Comm), intent(in) :: comm
    type(fuge_info), intent(inout) :: info
    type(rank_communicator) :: own
    integer :: stat

    call check_mpi(info)
    if (info%failed()) return
    call new_communicator(comm, own)
    allocate (self%group, stat=stat)
    call require_memory(stat, 'a communicator', info)
    call own%agree(info)
    if (info%failed()) then
      if (stat == 0) deallocate (self%group)
      call free_communicator(own)
      return
    end if
    self%group = own
    ! Addresses are only compared, never dereferenced.
    self%group_owner = c_loc(self%measured)
  end subroutine join

  !> Take the group of `source`, which leaves it.
  subroutine take_group(self, source)
    class(shared_operator), intent(inout), target :: self
    class(shared_operator), intent(inout) :: source

    self%group => source%group
    self%group_owner = c_loc(self%measured)
    source%group_owner = c_null_ptr
    nullify (source%group)
  end subroutine take_group

  !> Free the group if this variable owns it; all ranks call it.
  subroutine leave(self)
    class(shared_operator), intent(inout), target :: self

    if (owns(self%group_owner, c_loc(self%measured))) then
      call free_communicator(self%group)
      deallocate (self%group)
    end if
    self%group_owner = c_null_ptr
    nullify (self%group)
  end subroutine leave

  !> Is the variable at the address `here` the owner?
  pure function owns(owner, here)
    type(c_ptr), intent(in) :: owner, here
    logical :: owns

    owns = c_associated(owner)
    if (owns) owns = c_associated(owner, here)
  end function owns

  !> Let the ranks agree on `info`, and refuse `numbers` that differ between them (FUGE_ERR_OPTION); `which`, in the
  !> message: what they are.
  subroutine check_same(self, numbers, which, info)
    class(shared_operator), intent(in) :: self
    real(dp), intent(in) :: numbers(:)
    character(len=*), intent(in) :: which
    type(fuge_info), intent(inout) :: info

    call self%group%agree(info)
    if (info%failed()) return
    if (differ(numbers, self%ranks())) then
      call report(info, FUGE_ERR_OPTION, 'the grid differs between the ranks: pass the same '//which &
                  //' and options on all of them')
    end if
  end subroutine check_same

  !> The communicator of the operator, a duplicate of that of `set`; only after `set`.
  function comm(self)
    class(shared_operator), intent(in) :: self
    type(MPI_Comm) :: comm

    comm = self%group%comm()
  end function comm

  !> The ranks of the communicator; where it has one, that is alone.
  function ranks(self) result(space)
    class(shared_operator), intent(in) :: self
    type(point_space) :: space

    if (.not. associated(self%group)) return
    if (self%group%members() > 1) space%group => self%group
  end function ranks

  !> True after `set`, also where the communicator has one rank.
  pure function is_shared(self)
    class(shared_operator), intent(in) :: self
    logical :: is_shared

    is_shared = associated(self%group)
  end function is_shared

  !> Did an allocation succeed on all ranks?
  function agreed(self, stat)
    class(shared_operator), intent(in) :: self
    integer, intent(in) :: stat
    logical :: agreed
    type(point_space) :: space

    space = self%ranks()
    agreed = space%everywhere(stat == 0)
  end function agreed

  !> As for `fuge_operator`. All ranks decide together whether the product is finite.
  subroutine apply_with_magnitude(self, force, displacement, magnitude, status)
    class(shared_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:), magnitude(:)
    integer, intent(out) :: status
    type(point_space) :: space

    magnitude = 0.0_dp
    space = self%ranks()
    call self%apply(force, displacement, status)
    if (.not. space%everywhere(status == FUGE_DONE)) return
    if (space%everywhere(is_finite_everywhere(displacement))) call self%magnitude(force, displacement, magnitude)
  end subroutine apply_with_magnitude

end module fuge_shared_operator
