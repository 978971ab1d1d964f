! A model of the time of an iteration on a surface that ranks share: fitted to times of this machine, held against
! products that its ranks share, and evaluated for more ranks and a network.
!
!   mpirun -n RANKS mpi_model [largest N] [latency of the network in s] [bandwidth of a rank in bytes/s]
!
! An iteration is one product and one preconditioning in single precision, SUMS sums or maxima over all ranks, passes
! over the points, and the extension of residuals. On P ranks that share n x n cells it takes
!
!   W(n) n^2/P + 24 n^2/(P B) (1 - 1/P) + (4 (P - 1) + SUMS log2(P)) L (levels) + EXTENDED/B
!     + ROWS L (shared levels)
!
! W(n) = (product + preconditioning) (a + b log2 n) + passes is the work at a cell, with all cores busy. The latencies
! count once for each grid, as if coarser grids took as many iterations as the finest one; each grid lies on as many
! ranks as fuge_slab_rows gives it.
program mpi_model
  use, intrinsic :: iso_fortran_env, only: sp => real32
  use bench_exchanges, only: exchange_time, latency, sent_numbers, sum_time
  use fuge, dp => fuge_dp
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  use mpi_f08
  implicit none

  ! Sums and maxima of an iteration.
  integer, parameter :: SUMS = 20
  ! To extend residuals and to collect forces: messages of rows to and from neighbours on each coarser grid that ranks
  ! share.
  integer, parameter :: ROWS = 8
  ! For the same: numbers of the first grid that they do not share, there and back.
  real(dp), parameter :: EXTENDED = 4.0_dp*16384.0_dp
  ! As in fuge_slab_rows.
  integer, parameter :: FEWEST_CELLS = 16384, SHORTEST = 128
  ! Cells along a side of the smallest grid that is measured.
  integer, parameter :: LEAST = 512

  ! Seconds at a cell: of a product and a preconditioning (a + b log2 n), of passes; of a message, a number, a sum.
  type :: machine
    real(dp) :: product(2) = 0.0_dp, preconditioning(2) = 0.0_dp, passes = 0.0_dp
    real(dp) :: latency = 0.0_dp, number = 0.0_dp, sum = 0.0_dp
  end type machine

  integer :: rank, ranks

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  call run()
  call MPI_Finalize()

contains

  subroutine run()
    type(machine) :: here, network
    integer :: largest

    largest = nint(argument(1, 4096.0_dp))
    call measure_work(largest, here)
    if (ranks > 1) then
      call measure_messages(here)
      call check(largest, here)
    end if
    network = here
    network%latency = argument(2, 2.0e-6_dp)
    network%number = 8.0_dp/argument(3, 1.0e9_dp)
    if (rank /= 0) return
    write (*, '(/a,es9.2,a,es9.2,a)') 'Predicted for a network of ', network%latency, ' s and ', &
      8.0_dp/network%number, ' bytes/s at each rank, an iteration in ms:'
    write (*, '(a)') '| cells | ranks | with rows | work | bandwidth | latency | sums | total ' &
      //'| times faster than one |', '| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    call predict(network, 16384)
    call predict(network, 65536)
  end subroutine run

  ! Products and preconditionings of each rank alone, on all cores at once, and a solve; the work at a cell.
  subroutine measure_work(largest, here)
    integer, intent(in) :: largest
    type(machine), intent(inout) :: here
    real(dp) :: times(2), product_times(20), preconditioning_times(20), logs(20)
    integer :: k, n

    if (rank == 0) write (*, '(a)') 'Each rank alone, all at once: n, product and preconditioning, ns at a cell'
    n = LEAST
    k = 0
    do while (n <= largest)
      k = k + 1
      call time_products(MPI_COMM_SELF, n, n, times)
      logs(k) = log(real(n, dp))/log(2.0_dp)
      product_times(k) = times(1)/real(n, dp)**2
      preconditioning_times(k) = times(2)/real(n, dp)**2
      if (rank == 0) write (*, '(i7,2f10.2)') n, 1.0e9_dp*times/real(n, dp)**2
      n = 2*n
    end do
    here%product = fitted_line(logs(:k), product_times(:k))
    here%preconditioning = fitted_line(logs(:k), preconditioning_times(:k))
    call measure_passes(min(largest, 2048), here)
    if (rank == 0) then
      write (*, '(a,2f8.2)') 'product, a and b of a + b log2 n, ns:        ', 1.0e9_dp*here%product
      write (*, '(a,2f8.2)') 'preconditioning, a and b, ns:                ', 1.0e9_dp*here%preconditioning
      write (*, '(a,f8.2)') 'passes over the points, ns:                  ', 1.0e9_dp*here%passes
    end if
  end subroutine measure_work

  ! Least times of a product and of a preconditioning of nx x ny cells that the ranks of `comm` share; the
  ! greatest of all.
  subroutine time_products(comm, nx, ny, times)
    type(MPI_Comm), intent(in) :: comm
    integer, intent(in) :: nx, ny
    real(dp), intent(out) :: times(2)
    type(fuge_mpi_halfspace_operator) :: surface
    type(fuge_info) :: info
    real(sp), allocatable :: x(:), y(:)
    real(dp) :: start
    integer :: k, status

    call surface%set(nx, ny, 1.0_dp, 1.0_dp, 1.0_dp, comm, info)
    call stop_on(info)
    allocate (x(surface%points()), y(surface%points()), source=1.0_sp)
    times = huge(times)
    do k = 1, max(4096/nx, 1) + 3
      call MPI_Barrier(MPI_COMM_WORLD)
      start = MPI_Wtime()
      call surface%apply_single(x, y, status)
      times(1) = min(times(1), MPI_Wtime() - start)
      call MPI_Barrier(MPI_COMM_WORLD)
      start = MPI_Wtime()
      call surface%precondition_single(x, y, status)
      times(2) = min(times(2), MPI_Wtime() - start)
    end do
    call MPI_Allreduce(MPI_IN_PLACE, times, 2, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
  end subroutine time_products

  ! Time of a solve beside its products and preconditionings, for each product.
  subroutine measure_passes(n, here)
    integer, intent(in) :: n
    type(machine), intent(inout) :: here
    real(dp) :: seconds
    type(fuge_info) :: info

    call time_solve(MPI_COMM_SELF, n, seconds, info)
    here%passes = (seconds/real(n, dp)**2 - real(info%products, dp)*at(here%product, n) &
                   - real(info%preconditionings, dp)*at(here%preconditioning, n))/real(info%products, dp)
    if (rank == 0) write (*, '(a,i7,a,f8.3,a,2i4)') 'solve, n ', n, ': ', seconds, ' s, counts', info%products, &
      info%preconditionings
  end subroutine measure_passes

  ! The lesser time of two solves with a wavy sphere by the ranks of `comm`.
  subroutine time_solve(comm, n, seconds, info)
    type(MPI_Comm), intent(in) :: comm
    integer, intent(in) :: n
    real(dp), intent(out) :: seconds
    type(fuge_info), intent(out) :: info
    real(dp), parameter :: TWO_PI = 6.283185307179586_dp
    type(fuge_mpi_halfspace_operator) :: surface
    type(fuge_problem) :: problem
    real(dp) :: start, x, y
    integer :: i, j, k, rows(2)

    call surface%set(n, n, 1.0_dp/n, 1.0_dp/n, 1.0_dp, comm, info)
    call stop_on(info)
    rows = surface%own_rows()
    allocate (problem%gap(surface%points()))
    do j = rows(1), rows(2)
      y = (real(j, dp) - 0.5_dp)/real(n, dp) - 0.5_dp
      do i = 1, n
        x = (real(i, dp) - 0.5_dp)/real(n, dp) - 0.5_dp
        problem%gap(i + n*(j - rows(1))) = (x**2 + y**2)/2 &
          + 0.002_dp*(sin(7*TWO_PI*x)*cos(5*TWO_PI*y) + 0.3_dp*cos(TWO_PI*(31*x + 17*y)))
      end do
    end do
    problem%resultant = [0.02_dp]
    seconds = huge(seconds)
    do k = 1, 2
      call MPI_Barrier(MPI_COMM_WORLD)
      start = MPI_Wtime()
      call solve(surface, problem, info)
      seconds = min(seconds, MPI_Wtime() - start)
    end do
    call MPI_Allreduce(MPI_IN_PLACE, seconds, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
  end subroutine time_solve

  subroutine solve(surface, problem, info)
    type(fuge_mpi_halfspace_operator), intent(in) :: surface
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver

    call solver%solve(surface, problem, solution, info, fuge_options(tolerance=1.0e-8_dp))
    call stop_on(info)
  end subroutine solve

  ! The latency, the time of a number and that of a sum between the ranks.
  subroutine measure_messages(here)
    type(machine), intent(inout) :: here
    real(dp) :: short, long
    real(dp), parameter :: FEW = 131072.0_dp, MANY = 8388608.0_dp

    here%latency = latency(MPI_COMM_WORLD)
    short = exchange_time(MPI_COMM_WORLD, FEW/real(ranks - 1, dp), 20)
    long = exchange_time(MPI_COMM_WORLD, MANY/real(ranks - 1, dp), 5)
    here%number = (long - short)/(MANY - FEW)
    here%sum = sum_time(MPI_COMM_WORLD)
    if (rank == 0) write (*, '(a,f6.2,a,f6.2,a,f6.2,a)') 'messages: latency ', 1.0e6_dp*here%latency, ' us, ', &
      8.0e-9_dp/here%number, ' GB/s at each rank; a sum ', 1.0e6_dp*here%sum, ' us'
  end subroutine measure_messages

  ! Measured and modelled times of what the ranks share, and the messages alone.
  subroutine check(largest, here)
    integer, intent(in) :: largest
    type(machine), intent(in) :: here
    type(fuge_info) :: info
    real(dp) :: alone, expected(2), messages, part(2), seconds, times(2)
    integer :: n

    if (rank == 0) write (*, '(a)') &
      'Shared by the ranks: n, product, modelled, its messages alone, %; preconditioning, ' &
      //'modelled; product of n x n/P cells on each rank alone, ms'
    n = 2*LEAST
    do while (n <= largest)
      call time_products(MPI_COMM_SELF, n, max(n/ranks, 1), part)
      call time_products(MPI_COMM_WORLD, n, n, times)
      ! Two numbers of single precision are as long as one of these.
      alone = 2.0_dp*exchange_time(MPI_COMM_WORLD, 0.5_dp*sent_numbers(n, ranks, .true.), 5)
      messages = sent_numbers(n, ranks, .true.)*real(ranks - 1, dp)*here%number
      expected = [at(here%product, n), at(here%preconditioning, n)]*real(n, dp)**2/real(ranks, dp) &
                 + [messages, 0.5_dp*messages]
      if (rank == 0) write (*, '(i7,3f10.2,f7.1,3f10.2)') n, 1.0e3_dp*[times(1), expected(1), alone], &
        100.0_dp*alone/times(1), 1.0e3_dp*[times(2), expected(2), part(1)]
      n = 2*n
    end do
    n = min(largest, 2048)
    call time_solve(MPI_COMM_WORLD, n, seconds, info)
    if (rank == 0) write (*, '(a,i7,2(a,f8.3),a)') 'shared solve, n ', n, ': ', seconds, ' s, modelled ', &
      real(info%products, dp)*sum(iteration(here, n, real(ranks, dp), .false.)), ' s'
  end subroutine check

  ! Rows of the table of an iteration on 8 to 4096 ranks.
  subroutine predict(network, n)
    type(machine), intent(in) :: network
    integer, intent(in) :: n
    real(dp) :: alone, parts(4)
    integer :: k, p

    alone = sum(iteration(network, n, 1.0_dp, .true.))
    p = 8
    do while (p <= 4096)
      parts = iteration(network, n, real(p, dp), .true.)
      write (*, '(2(a,i0),2(a,i0),6a)') '| ', n, ' x ', n, ' | ', p, ' | ', nint(active(n, real(p, dp))), &
        (' | '//short(1.0e3_dp*parts(k)), k=1, size(parts)), ' | '//short(1.0e3_dp*sum(parts)), &
        ' | '//short(alone/sum(parts))//' |'
      p = merge(4*p, 2*p, p >= 16)
    end do
  end subroutine predict

  ! Two digits at least.
  pure function short(value) result(word)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: word
    character(len=16) :: field

    if (value < 9.95_dp) then
      write (field, '(f4.1)') value
    else
      write (field, '(i0)') nint(value)
    end if
    word = trim(adjustl(field))
  end function short

  ! Seconds of work, of bandwidth, of latency and of sums in an iteration on p ranks; latencies of all grids, with
  ! `coarser`, or of the finest one.
  function iteration(where, n, p, coarser) result(parts)
    type(machine), intent(in) :: where
    integer, intent(in) :: n
    real(dp), intent(in) :: p
    logical, intent(in) :: coarser
    real(dp) :: parts(4)
    real(dp) :: cells, q
    integer :: m

    cells = real(n, dp)**2
    q = active(n, p)
    parts = 0.0_dp
    parts(1) = (at(where%product, n) + at(where%preconditioning, n) + where%passes)*cells/q
    parts(2) = 3.0_dp*cells/q*(1.0_dp - 1.0_dp/q)*where%number
    if (q > 1.0_dp) parts(2) = parts(2) + EXTENDED*where%number
    m = n
    do while (m >= 16)
      parts(3) = parts(3) + 4.0_dp*(active(m, p) - 1.0_dp)*where%latency
      if (q > 1.0_dp .and. m < n .and. real(m, dp)**2 >= FEWEST_CELLS) then
        parts(3) = parts(3) + real(ROWS, dp)*where%latency
      end if
      parts(4) = parts(4) + real(SUMS, dp)*where%latency*log(p)/log(2.0_dp)
      m = m/2
      if (.not. coarser) exit
    end do
  end function iteration

  ! How many of p ranks have rows of n x n cells.
  pure function active(n, p)
    integer, intent(in) :: n
    real(dp), intent(in) :: p
    real(dp) :: active
    real(dp) :: cells

    cells = real(n, dp)**2
    active = max(min(p, cells/real(FEWEST_CELLS, dp), sqrt(cells/real(SHORTEST, dp))), 1.0_dp)
  end function active

  ! a + b log2 n.
  pure function at(line, n) result(value)
    real(dp), intent(in) :: line(2)
    integer, intent(in) :: n
    real(dp) :: value

    value = line(1) + line(2)*log(real(n, dp))/log(2.0_dp)
  end function at

  ! a and b of the line a + b x nearest to y; b = 0 for one point.
  pure function fitted_line(x, y) result(line)
    real(dp), intent(in) :: x(:), y(:)
    real(dp) :: line(2)
    real(dp) :: mean, square

    mean = sum(x)/size(x)
    square = sum((x - mean)**2)
    line = 0.0_dp
    if (square > 0.0_dp) line(2) = sum((x - mean)*y)/square
    line(1) = sum(y)/size(y) - line(2)*mean
  end function fitted_line

  subroutine stop_on(info)
    type(fuge_info), intent(in) :: info

    if (.not. info%failed()) return
    write (*, '(a)') trim(info%message)
    error stop 1
  end subroutine stop_on

  function argument(k, default) result(value)
    integer, intent(in) :: k
    real(dp), intent(in) :: default
    real(dp) :: value
    character(len=32) :: word
    integer :: stat
    real(dp) :: found

    value = default
    call get_command_argument(k, word)
    if (word == '') return
    read (word, *, iostat=stat) found
    if (stat == 0) value = found
  end function argument

end program mpi_model
