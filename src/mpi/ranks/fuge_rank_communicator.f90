!> The ranks of an MPI communicator as the group that shares the points of a problem.
module fuge_rank_communicator
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_point_space, only: rank_group
  use fuge_status, only: composed_message, fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_MESSAGE_LENGTH
  use mpi_f08, only: MPI_Allreduce, MPI_Bcast, MPI_Comm, MPI_Comm_dup, MPI_Comm_free, MPI_Comm_rank, MPI_Comm_size, &
    MPI_Comm_split, MPI_Comm_split_type, MPI_Finalized, MPI_Initialized, MPI_Irecv, MPI_Isend, MPI_Request, &
    MPI_Waitall, operator(/=), MPI_CHARACTER, MPI_COMM_NULL, MPI_COMM_TYPE_SHARED, MPI_DOUBLE_PRECISION, &
    MPI_IN_PLACE, MPI_INFO_NULL, MPI_INTEGER, MPI_LAND, MPI_LOGICAL, MPI_MAX, MPI_MIN, MPI_STATUSES_IGNORE, MPI_SUM, &
    MPI_UNDEFINED
  implicit none
  private

  public :: check_mpi, free_communicator, members_here, new_communicator, split_communicator

  !> A communicator of its own, so that messages do not mix with those of the caller.
  type, extends(rank_group), public :: rank_communicator
    !> Is there a communicator, and its handle, as mpi_f08 keeps it.
    logical, private :: exists = .false.
    integer, private :: handle = 0
    integer, private :: rank = 0, size = 1
  contains
    procedure :: members
    procedure :: number
    procedure :: add
    procedure :: raise
    procedure :: exchange
    procedure :: agree
    procedure :: comm
  end type rank_communicator

contains

  !> Has MPI been started, and not ended yet?
  function mpi_is_running() result(running)
    logical :: running, ended

    call MPI_Initialized(running)
    if (.not. running) return
    call MPI_Finalized(ended)
    running = .not. ended
  end function mpi_is_running

  !> Report FUGE_ERR_CALL_ORDER before MPI_Init and after MPI_Finalize, which are the caller's to call.
  subroutine check_mpi(info)
    type(fuge_info), intent(inout) :: info

    if (.not. mpi_is_running()) call report(info, FUGE_ERR_CALL_ORDER, 'MPI is not running: call MPI_Init before ' &
                                            //'an operator on several ranks, and MPI_Finalize after it is freed')
  end subroutine check_mpi

  !> A group of the ranks of `comm`; all of them call it.
  subroutine new_communicator(comm, group)
    type(MPI_Comm), intent(in) :: comm
    type(rank_communicator), intent(out) :: group
    type(MPI_Comm) :: own

    call MPI_Comm_dup(comm, own)
    group%handle = own%MPI_VAL
    group%exists = .true.
    call MPI_Comm_rank(own, group%rank)
    call MPI_Comm_size(own, group%size)
  end subroutine new_communicator

  !> How many of the first `count` ranks of `group` share the memory of this one; all ranks of it call.
  function members_here(group, count) result(members)
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: count
    integer :: members
    type(MPI_Comm) :: here

    call MPI_Comm_split_type(group%comm(), MPI_COMM_TYPE_SHARED, group%rank, MPI_INFO_NULL, here)
    members = merge(1, 0, group%rank < count)
    call MPI_Allreduce(MPI_IN_PLACE, members, 1, MPI_INTEGER, MPI_SUM, here)
    call MPI_Comm_free(here)
  end function members_here

  !> A group of the first `count` ranks of `whole`, which all of them call; on the others it has no communicator.
  subroutine split_communicator(whole, count, part)
    type(rank_communicator), intent(in) :: whole
    integer, intent(in) :: count
    type(rank_communicator), intent(out) :: part
    type(MPI_Comm) :: own

    call MPI_Comm_split(whole%comm(), merge(0, MPI_UNDEFINED, whole%rank < count), whole%rank, own)
    part%handle = own%MPI_VAL
    part%exists = own /= MPI_COMM_NULL
    part%rank = whole%rank
    part%size = count
  end subroutine split_communicator

  !> Free the communicator, unless MPI has ended.
  subroutine free_communicator(group)
    type(rank_communicator), intent(inout) :: group
    type(MPI_Comm) :: own

    if (.not. group%exists) return
    if (.not. mpi_is_running()) return
    own = group%comm()
    call MPI_Comm_free(own)
    group%exists = .false.
  end subroutine free_communicator

  !> The communicator.
  function comm(self)
    class(rank_communicator), intent(in) :: self
    type(MPI_Comm) :: comm

    comm%MPI_VAL = self%handle
  end function comm

  pure function members(self) result(number)
    class(rank_communicator), intent(in) :: self
    integer :: number

    number = self%size
  end function members

  pure function number(self)
    class(rank_communicator), intent(in) :: self
    integer :: number

    number = self%rank
  end function number

  !> MPI requires that all ranks receive the same sums (MPI 3.1, section 5.9.6).
  subroutine add(self, values)
    class(rank_communicator), intent(in) :: self
    real(dp), intent(inout), contiguous :: values(:)

    call MPI_Allreduce(MPI_IN_PLACE, values, size(values), MPI_DOUBLE_PRECISION, MPI_SUM, self%comm())
  end subroutine add

  subroutine raise(self, values)
    class(rank_communicator), intent(in) :: self
    real(dp), intent(inout), contiguous :: values(:)

    call MPI_Allreduce(MPI_IN_PLACE, values, size(values), MPI_DOUBLE_PRECISION, MPI_MAX, self%comm())
  end subroutine raise

  !> Only ranks that have something for each other exchange messages. Each begins with the rank after its own, so that
  !> not all send to the same one.
  subroutine exchange(self, to, sent, from, received)
    class(rank_communicator), intent(in) :: self
    integer, intent(in) :: to(0:), from(0:)
    real(dp), intent(in), contiguous :: sent(:)
    real(dp), intent(inout), contiguous, asynchronous :: received(:)
    type(MPI_Request) :: requests(2*self%size)
    integer :: n, r, step

    n = 0
    do step = 1, self%size
      r = modulo(self%rank - step, self%size)
      if (from(r) < 1) cycle
      n = n + 1
      call MPI_Irecv(received(sum(from(:r - 1)) + 1), from(r), MPI_DOUBLE_PRECISION, r, 0, self%comm(), requests(n))
    end do
    do step = 1, self%size
      r = modulo(self%rank + step, self%size)
      if (to(r) < 1) cycle
      n = n + 1
      call MPI_Isend(sent(sum(to(:r - 1)) + 1), to(r), MPI_DOUBLE_PRECISION, r, 0, self%comm(), requests(n))
    end do
    call MPI_Waitall(n, requests, MPI_STATUSES_IGNORE)
  end subroutine exchange

  !> One small message where nothing is wrong.
  subroutine agree(self, info)
    class(rank_communicator), intent(in) :: self
    type(fuge_info), intent(inout) :: info
    character(len=2*FUGE_MESSAGE_LENGTH) :: message
    integer :: lowest, status
    logical :: same

    lowest = merge(self%rank, self%size, info%failed())
    call MPI_Allreduce(MPI_IN_PLACE, lowest, 1, MPI_INTEGER, MPI_MIN, self%comm())
    if (lowest == self%size) return
    status = info%status
    message = composed_message(info)
    call MPI_Bcast(status, 1, MPI_INTEGER, lowest, self%comm())
    call MPI_Bcast(message, len(message), MPI_CHARACTER, lowest, self%comm())
    same = status == info%status .and. message == composed_message(info)
    call MPI_Allreduce(MPI_IN_PLACE, same, 1, MPI_LOGICAL, MPI_LAND, self%comm())
    if (same) return
    call report(info, status, 'rank '//text(lowest)//': '//trim(message))
  end subroutine agree

end module fuge_rank_communicator
