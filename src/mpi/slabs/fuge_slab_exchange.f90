!> Exchange of a matrix whose rows the ranks share for one whose columns they share, and back.
!>
!> An element has several numbers. Each row is written in pieces, one for each rank that has some of its columns, and a
!> message carries the pieces of some rows to where their columns are read, row after row. So nothing is transposed or
!> copied in memory, what a rank keeps does not move at all, and messages travel while further rows are computed.
module fuge_slab_exchange
  use, intrinsic :: iso_c_binding, only: c_double, c_intptr_t
  use fuge_rank_communicator, only: rank_communicator
  use mpi_f08, only: MPI_Irecv, MPI_Isend, MPI_Request, MPI_Testall, MPI_Waitall, MPI_DOUBLE_PRECISION, &
    MPI_STATUSES_IGNORE
  implicit none
  private

  !> Numbers of a message, at most and about: few enough that some messages travel while the next rows are computed,
  !> and enough that their latency does not matter.
  integer, parameter :: MESSAGE = 131072

  !> Describe it, set it, then exchange any number of times: `begin_rows`, `send_row` for each row in turn, `finish`;
  !> and back, `return_rows`, `wait_for_row` for each row in turn, `finish`. All ranks of the group call the same. It
  !> must not be copied.
  type, public :: slab_exchange
    private
    type(rank_communicator) :: group
    !> Numbers of an element; rows and columns of all ranks; those of each rank but the last ones.
    integer :: numbers = 1, rows = 0, columns = 0, row_block = 1, column_block = 1
    !> Rows whose pieces make one message.
    integer :: chunk = 1
    !> Messages under way.
    type(MPI_Request), pointer, contiguous :: sent(:) => null(), expected(:) => null()
    integer :: sends = 0, expects = 0
  contains
    procedure :: describe
    procedure :: set
    procedure :: free
    procedure :: row_range
    procedure :: column_range
    procedure :: numbers_by_rows
    procedure :: numbers_by_columns
    procedure :: find_piece
    procedure :: begin_rows
    procedure :: send_row
    procedure :: return_rows
    procedure :: wait_for_row
    procedure :: finish
  end type slab_exchange

contains

  !> A matrix of `rows` by `columns` elements of `numbers` numbers, in `blocks` (2) of rows and of columns for each rank
  !> of `group`.
  subroutine describe(self, group, rows, columns, numbers, blocks)
    class(slab_exchange), intent(inout) :: self
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: rows, columns, numbers, blocks(2)

    self%group = group
    self%rows = rows
    self%columns = columns
    self%numbers = numbers
    self%row_block = blocks(1)
    self%column_block = blocks(2)
    self%chunk = min(max(MESSAGE/(numbers*blocks(2)), 1), blocks(1))
  end subroutine describe

  !> Prepare for exchanges, after `describe`. `status` is not 0 without memory.
  subroutine set(self, status)
    class(slab_exchange), intent(inout) :: self
    integer, intent(out) :: status
    integer :: messages

    call self%free()
    messages = ((self%row_block - 1)/self%chunk + 1)*self%group%members()
    allocate (self%sent(messages), self%expected(messages), stat=status)
  end subroutine set

  !> Free what `set` has allocated; not during an exchange.
  subroutine free(self)
    class(slab_exchange), intent(inout) :: self

    if (associated(self%sent)) deallocate (self%sent)
    if (associated(self%expected)) deallocate (self%expected)
  end subroutine free

  !> The first row of a rank, from 0, and how many it has.
  pure function row_range(self, rank) result(range)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: rank
    integer :: range(2)

    range = share(self%rows, self%row_block, rank)
  end function row_range

  !> The first column of a rank, from 0, and how many it has.
  pure function column_range(self, rank) result(range)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: rank
    integer :: range(2)

    range = share(self%columns, self%column_block, rank)
  end function column_range

  !> The first of `n` lines that a rank has, from 0, and how many.
  pure function share(n, block, rank) result(range)
    integer, intent(in) :: n, block, rank
    integer :: range(2)

    range(1) = int(min(int(rank, c_intptr_t)*block, int(n, c_intptr_t)))
    range(2) = min(block, n - range(1))
  end function share

  !> How many numbers a buffer for the pieces of this rank's rows holds.
  pure function numbers_by_rows(self) result(count)
    class(slab_exchange), intent(in) :: self
    integer(c_intptr_t) :: count
    integer :: columns(2), rows(2)

    columns = self%column_range(self%group%number())
    rows = self%row_range(self%group%number())
    count = int(self%numbers, c_intptr_t)*rows(2)*(self%columns - columns(2))
  end function numbers_by_rows

  !> How many numbers a buffer for the columns of this rank holds.
  pure function numbers_by_columns(self) result(count)
    class(slab_exchange), intent(in) :: self
    integer(c_intptr_t) :: count
    integer :: columns(2)

    columns = self%column_range(self%group%number())
    count = int(self%numbers, c_intptr_t)*self%rows*columns(2)
  end function numbers_by_columns

  !> The piece of row `row` of this rank, from 0, that has the columns of `rank`.
  !>
  !> `by_rows` and `by_columns` hold at least as many numbers as the functions above say: the pieces for other ranks,
  !> and the columns of this rank. Of these a row of all ranks follows the other, the piece of this rank among them.
  subroutine find_piece(self, row, rank, by_rows, by_columns, piece)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: row, rank
    real(c_double), pointer, contiguous, intent(in) :: by_rows(:), by_columns(:)
    real(c_double), pointer, contiguous, intent(out) :: piece(:)
    integer(c_intptr_t) :: begin, count
    integer :: columns(2), rows(2)

    columns = self%column_range(rank)
    count = int(self%numbers, c_intptr_t)*columns(2)
    if (rank == self%group%number()) then
      rows = self%row_range(rank)
      begin = count*(rows(1) + row)
      piece => by_columns(begin + 1:begin + count)
    else
      begin = place_by_rows(self, row/self%chunk, rank) + count*mod(row, self%chunk)
      piece => by_rows(begin + 1:begin + count)
    end if
  end subroutine find_piece

  !> Where in `by_rows` the message of chunk `k`, from 0, for or from `rank` begins, from 0.
  pure function place_by_rows(self, k, rank) result(begin)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: k, rank
    integer(c_intptr_t) :: begin
    integer :: before, columns(2), me, mine(2)

    me = self%group%number()
    mine = self%column_range(me)
    columns = self%column_range(rank)
    before = columns(1) - merge(mine(2), 0, rank > me)
    begin = int(self%numbers, c_intptr_t)*(int(k, c_intptr_t)*self%chunk*(self%columns - mine(2)) &
                                           + int(rows_in_chunk(self, k, me), c_intptr_t)*before)
  end function place_by_rows

  !> Where in `by_columns` the message of chunk `k`, from 0, from or for `rank` begins, from 0.
  pure function place_by_columns(self, k, rank) result(begin)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: k, rank
    integer(c_intptr_t) :: begin
    integer :: mine(2), rows(2)

    mine = self%column_range(self%group%number())
    rows = self%row_range(rank)
    begin = int(self%numbers, c_intptr_t)*mine(2)*(rows(1) + k*self%chunk)
  end function place_by_columns

  !> Rows in chunk `k` of a rank, from 0.
  pure function rows_in_chunk(self, k, rank) result(rows)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: k, rank
    integer :: rows
    integer :: range(2)

    range = self%row_range(rank)
    rows = max(min(self%chunk, range(2) - k*self%chunk), 0)
  end function rows_in_chunk

  !> Numbers of the message of chunk `k` of the rank `from` for the columns of the rank `to`.
  pure function message_size(self, k, from, to) result(numbers)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: k, from, to
    integer :: numbers
    integer :: columns(2)

    columns = self%column_range(to)
    numbers = self%numbers*rows_in_chunk(self, k, from)*columns(2)
  end function message_size

  !> The number of the last chunk of any rank, from 0.
  pure function last_chunk(self) result(k)
    class(slab_exchange), intent(in) :: self
    integer :: k

    k = (self%row_block - 1)/self%chunk
  end function last_chunk

  !> The rank `step` after this one, in a circle: so not all send to the same one first.
  pure function rank_after(self, step) result(rank)
    class(slab_exchange), intent(in) :: self
    integer, intent(in) :: step
    integer :: rank

    rank = modulo(self%group%number() + step, self%group%members())
  end function rank_after

  !> Send `numbers` of `buffer` behind `begin`, if there are any.
  subroutine send(self, buffer, begin, numbers, rank)
    class(slab_exchange), intent(inout) :: self
    real(c_double), pointer, contiguous, intent(in) :: buffer(:)
    integer(c_intptr_t), intent(in) :: begin
    integer, intent(in) :: numbers, rank

    if (numbers < 1) return
    self%sends = self%sends + 1
    call MPI_Isend(buffer(begin + 1), numbers, MPI_DOUBLE_PRECISION, rank, 0, self%group%comm(), &
                   self%sent(self%sends))
  end subroutine send

  !> Expect `numbers` in `buffer` behind `begin`, if there are any.
  subroutine expect(self, buffer, begin, numbers, rank)
    class(slab_exchange), intent(inout) :: self
    real(c_double), pointer, contiguous, intent(in) :: buffer(:)
    integer(c_intptr_t), intent(in) :: begin
    integer, intent(in) :: numbers, rank

    if (numbers < 1) return
    self%expects = self%expects + 1
    call MPI_Irecv(buffer(begin + 1), numbers, MPI_DOUBLE_PRECISION, rank, 0, self%group%comm(), &
                   self%expected(self%expects))
  end subroutine expect

  !> Begin an exchange of rows for columns: from now on columns arrive.
  subroutine begin_rows(self, by_columns)
    class(slab_exchange), intent(inout) :: self
    real(c_double), pointer, contiguous, intent(in) :: by_columns(:)
    integer :: k, rank, step

    do k = 0, last_chunk(self)
      do step = self%group%members() - 1, 1, -1
        rank = rank_after(self, step)
        call expect(self, by_columns, place_by_columns(self, k, rank), &
                    message_size(self, k, rank, self%group%number()), rank)
      end do
    end do
  end subroutine begin_rows

  !> The pieces of row `row` of this rank, from 0, and of those before it are written: send them when a message is full.
  subroutine send_row(self, row, by_rows)
    class(slab_exchange), intent(inout) :: self
    integer, intent(in) :: row
    real(c_double), pointer, contiguous, intent(in) :: by_rows(:)
    integer :: k, me, rank, step
    logical :: all_here

    me = self%group%number()
    k = row/self%chunk
    if (row - k*self%chunk < rows_in_chunk(self, k, me) - 1) return
    do step = 1, self%group%members() - 1
      rank = rank_after(self, step)
      call send(self, by_rows, place_by_rows(self, k, rank), message_size(self, k, me, rank), rank)
    end do
    ! Messages may advance in calls of MPI only.
    if (self%expects > 0) call MPI_Testall(self%expects, self%expected, all_here, MPI_STATUSES_IGNORE)
  end subroutine send_row

  !> Begin an exchange of columns for rows: send all columns back.
  subroutine return_rows(self, by_rows, by_columns)
    class(slab_exchange), intent(inout) :: self
    real(c_double), pointer, contiguous, intent(in) :: by_rows(:), by_columns(:)
    integer :: k, me, rank, step

    me = self%group%number()
    do k = 0, last_chunk(self)
      do step = self%group%members() - 1, 1, -1
        rank = rank_after(self, step)
        call expect(self, by_rows, place_by_rows(self, k, rank), message_size(self, k, me, rank), rank)
      end do
    end do
    do k = 0, last_chunk(self)
      do step = 1, self%group%members() - 1
        rank = rank_after(self, step)
        call send(self, by_columns, place_by_columns(self, k, rank), message_size(self, k, rank, me), rank)
      end do
    end do
  end subroutine return_rows

  !> Wait until the pieces of row `row` of this rank, from 0, are here.
  subroutine wait_for_row(self, row)
    class(slab_exchange), intent(inout) :: self
    integer, intent(in) :: row
    integer :: k, messages

    if (self%expects < 1 .or. modulo(row, self%chunk) /= 0) return
    k = row/self%chunk
    messages = self%expects/((own_rows(self) - 1)/self%chunk + 1)
    call MPI_Waitall(messages, self%expected(k*messages + 1:), MPI_STATUSES_IGNORE)
  end subroutine wait_for_row

  pure function own_rows(self) result(rows)
    class(slab_exchange), intent(in) :: self
    integer :: rows
    integer :: range(2)

    range = self%row_range(self%group%number())
    rows = range(2)
  end function own_rows

  !> End an exchange: all columns are here, or all rows, and the buffers may be written again.
  subroutine finish(self)
    class(slab_exchange), intent(inout) :: self

    if (self%expects > 0) call MPI_Waitall(self%expects, self%expected, MPI_STATUSES_IGNORE)
    if (self%sends > 0) call MPI_Waitall(self%sends, self%sent, MPI_STATUSES_IGNORE)
    self%expects = 0
    self%sends = 0
  end subroutine finish

end module fuge_slab_exchange
