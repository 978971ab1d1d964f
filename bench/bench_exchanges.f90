! Times of messages between ranks: the exchanges of a product on a shared surface, round trips, sums over all ranks.
module bench_exchanges
  use fuge, only: dp => fuge_dp
  use mpi_f08
  implicit none
  private

  public :: latency, sum_time, exchange_time, sent_numbers

  ! Numbers in a message at most, as in fuge_slab_exchange.
  integer, parameter :: MESSAGE = 131072

contains

  ! Numbers that a rank sends to each other one in one exchange of n x n cells, of a free surface if `padded`: the waves
  ! of that one of its pairs of rows, four numbers each.
  pure function sent_numbers(n, ranks, padded) result(numbers)
    integer, intent(in) :: n, ranks
    logical, intent(in) :: padded
    real(dp) :: numbers

    numbers = 4.0_dp*(real(n, dp)/real(2*ranks, dp))*(real(n, dp)*merge(1.0_dp, 0.5_dp, padded)/real(ranks, dp))
  end function sent_numbers

  ! Least time of an exchange of `numbers` between any two ranks of `comm`.
  function exchange_time(comm, numbers, repetitions) result(seconds)
    type(MPI_Comm), intent(in) :: comm
    real(dp), intent(in) :: numbers
    integer, intent(in) :: repetitions
    real(dp) :: seconds
    real(dp), allocatable :: sent(:), received(:)
    real(dp) :: start
    integer :: count, k, ranks

    call MPI_Comm_size(comm, ranks)
    count = max(int(numbers), 1)
    allocate (sent(count*(ranks - 1)), received(count*(ranks - 1)), source=0.0_dp)
    seconds = huge(seconds)
    do k = 1, repetitions + 1
      call MPI_Barrier(comm)
      start = MPI_Wtime()
      call exchange(comm, count, sent, received)
      if (k > 1) seconds = min(seconds, MPI_Wtime() - start)
    end do
    call MPI_Allreduce(MPI_IN_PLACE, seconds, 1, MPI_DOUBLE_PRECISION, MPI_MAX, comm)
  end function exchange_time

  subroutine exchange(comm, count, sent, received)
    type(MPI_Comm), intent(in) :: comm
    integer, intent(in) :: count
    real(dp), intent(in), contiguous :: sent(:)
    real(dp), intent(inout), contiguous :: received(:)
    type(MPI_Request), allocatable :: requests(:)
    integer :: begin, me, n, part, ranks, step

    call MPI_Comm_rank(comm, me)
    call MPI_Comm_size(comm, ranks)
    allocate (requests(2*(ranks - 1)*((count - 1)/MESSAGE + 1)))
    n = 0
    do begin = 1, count, MESSAGE
      part = min(MESSAGE, count - begin + 1)
      do step = 1, ranks - 1
        call MPI_Irecv(received((step - 1)*count + begin), part, MPI_DOUBLE_PRECISION, modulo(me - step, ranks), 0, &
                       comm, requests(n + 1))
        call MPI_Isend(sent((step - 1)*count + begin), part, MPI_DOUBLE_PRECISION, modulo(me + step, ranks), 0, comm, &
                       requests(n + 2))
        n = n + 2
      end do
    end do
    call MPI_Waitall(n, requests, MPI_STATUSES_IGNORE)
  end subroutine exchange

  ! Half of a round trip of one number between two ranks.
  function latency(comm) result(seconds)
    type(MPI_Comm), intent(in) :: comm
    real(dp) :: seconds
    integer, parameter :: TRIPS = 2000
    real(dp) :: start
    integer :: k

    seconds = huge(seconds)
    do k = 1, 5
      call MPI_Barrier(comm)
      start = MPI_Wtime()
      call make_round_trips(comm, TRIPS)
      seconds = min(seconds, (MPI_Wtime() - start)/(2*TRIPS))
    end do
    call MPI_Bcast(seconds, 1, MPI_DOUBLE_PRECISION, 0, comm)
  end function latency

  subroutine make_round_trips(comm, trips)
    type(MPI_Comm), intent(in) :: comm
    integer, intent(in) :: trips
    real(dp) :: number
    integer :: k, me

    call MPI_Comm_rank(comm, me)
    number = 0.0_dp
    if (me > 1) return
    do k = 1, trips
      if (me == 0) call MPI_Send(number, 1, MPI_DOUBLE_PRECISION, 1, 0, comm)
      call MPI_Recv(number, 1, MPI_DOUBLE_PRECISION, 1 - me, 0, comm, MPI_STATUS_IGNORE)
      if (me == 1) call MPI_Send(number, 1, MPI_DOUBLE_PRECISION, 0, 0, comm)
    end do
  end subroutine make_round_trips

  ! A sum of one number over all ranks.
  function sum_time(comm) result(seconds)
    type(MPI_Comm), intent(in) :: comm
    real(dp) :: seconds
    integer, parameter :: SUMS = 2000
    real(dp) :: number, start
    integer :: i, k

    seconds = huge(seconds)
    do k = 1, 5
      number = 0.0_dp
      call MPI_Barrier(comm)
      start = MPI_Wtime()
      do i = 1, SUMS
        call MPI_Allreduce(MPI_IN_PLACE, number, 1, MPI_DOUBLE_PRECISION, MPI_SUM, comm)
      end do
      seconds = min(seconds, (MPI_Wtime() - start)/SUMS)
    end do
    call MPI_Bcast(seconds, 1, MPI_DOUBLE_PRECISION, 0, comm)
  end function sum_time

end module bench_exchanges
