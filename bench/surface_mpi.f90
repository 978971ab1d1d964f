! A surface over MPI and by one process: least times of solves and products, and what a rank allocates.
!
!   mpirun -n RANKS surface_mpi N [tolerance] [repetitions] [free|periodic] [alone]
!
! N x N cells; with `alone` rank 0 also solves by fuge_halfspace_operator, in turn with the ranks, while they wait, and
! there is a row of a table: products + preconditionings of one process and of the ranks, seconds of both and their
! ratio, seconds of a product of both and of its messages alone.
program surface_mpi
  use, intrinsic :: iso_fortran_env, only: int64
  use bench_exchanges, only: exchange_time, sent_numbers
  use bench_ranks, only: wait_for_rank_0
  use fuge, dp => fuge_dp
  use fuge_mpi, only: fuge_mpi_halfspace_operator
  use mpi_f08
  implicit none

  integer :: rank, ranks

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  call run()
  call MPI_Finalize()

contains

  subroutine run()
    type(fuge_mpi_halfspace_operator) :: shared
    type(fuge_halfspace_operator) :: whole
    type(fuge_problem) :: problem, whole_problem
    type(fuge_info) :: info, whole_info
    real(dp) :: best, messages, product_time, set_time, start, tolerance, whole_best, whole_product
    integer :: boundary, k, n, repetitions, rows(2)
    logical :: alone

    n = nint(argument(1, 1024.0_dp))
    tolerance = argument(2, 1.0e-8_dp)
    repetitions = nint(argument(3, 3.0_dp))
    boundary = merge(FUGE_PERIODIC, FUGE_FREE, word(4) == 'periodic')
    alone = word(5) == 'alone'
    call MPI_Barrier(MPI_COMM_WORLD)
    start = MPI_Wtime()
    call shared%set(n, n, 1.0_dp/n, 1.0_dp/n, 1.0_dp, MPI_COMM_WORLD, info, boundary=boundary)
    set_time = MPI_Wtime() - start
    call stop_on(info)
    rows = shared%own_rows()
    call fill_gap(n, rows(1), rows(2), boundary, problem)
    if (alone .and. rank == 0) then
      call whole%set(n, n, 1.0_dp/n, 1.0_dp/n, 1.0_dp, whole_info, boundary=boundary)
      call stop_on(whole_info)
      call fill_gap(n, 1, n, boundary, whole_problem)
    end if
    best = huge(best)
    product_time = huge(best)
    whole_best = huge(best)
    whole_product = huge(best)
    do k = 1, repetitions
      if (alone) then
        if (rank == 0) call time_solve(whole, whole_problem, tolerance, whole_best, whole_product, whole_info)
        call wait_for_rank_0()
      end if
      call MPI_Barrier(MPI_COMM_WORLD)
      call time_solve(shared, problem, tolerance, best, product_time, info)
    end do
    if (rank == 0) write (*, '(a,i7,a,i4,a,f9.3,a,f9.3,a,f9.4,a,es9.2,a,3i6)') 'n ', n, '  ranks ', ranks, '  set ', &
      set_time, ' s  solve ', best, ' s  product ', product_time, ' s  residual ', info%residual, '  counts ', &
      info%iterations, info%products, info%preconditionings
    messages = 0.0_dp
    if (ranks > 1) messages = message_time(n, boundary == FUGE_FREE)
    if (rank == 0 .and. alone) write (*, '(2(a,i0),2a,2(i0,a,i0,a),6(a,1x),a)') '| ', n, ' x ', n, &
      trim(merge(', periodic', '          ', boundary == FUGE_PERIODIC)), ' | ', whole_info%products, ' + ', &
      whole_info%preconditionings, ' | ', info%products, ' + ', info%preconditionings, ' |', &
      ' '//decimal(whole_best, 3)//' |', decimal(best, 3)//' |', decimal(whole_best/best, 1)//' |', &
      decimal(whole_product, 4)//' |', decimal(product_time, 4)//' |', decimal(messages, 4)//' |'
    call report_memory(n, ranks)
  end subroutine run

  ! Time of the two exchanges of a product if nothing else is done, if all ranks have rows.
  function message_time(n, padded) result(seconds)
    integer, intent(in) :: n
    logical, intent(in) :: padded
    real(dp) :: seconds

    seconds = 2.0_dp*exchange_time(MPI_COMM_WORLD, sent_numbers(n, ranks, padded), 5)
  end function message_time

  ! A sphere with waves, or waves alone.
  subroutine fill_gap(n, first, last, boundary, problem)
    integer, intent(in) :: n, first, last, boundary
    type(fuge_problem), intent(inout) :: problem
    real(dp), parameter :: TWO_PI = 6.283185307179586_dp
    real(dp) :: x, y
    integer :: i, j

    allocate (problem%gap(n*(last - first + 1)))
    do j = first, last
      y = (real(j, dp) - 0.5_dp)/real(n, dp) - 0.5_dp
      do i = 1, n
        x = (real(i, dp) - 0.5_dp)/real(n, dp) - 0.5_dp
        problem%gap(i + n*(j - first)) = 0.002_dp*(sin(7*TWO_PI*x)*cos(5*TWO_PI*y) + 0.3_dp*cos(TWO_PI*(31*x + 17*y)))
        if (boundary == FUGE_FREE) problem%gap(i + n*(j - first)) = problem%gap(i + n*(j - first)) + (x**2 + y**2)/2
      end do
    end do
    problem%resultant = [merge(0.02_dp, 0.005_dp, boundary == FUGE_FREE)]
  end subroutine fill_gap

  ! `best` and `product_time`: the lesser of them and the times of a solve from scratch and of a product.
  subroutine time_solve(operator, problem, tolerance, best, product_time, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: tolerance
    real(dp), intent(inout) :: best, product_time
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    real(dp), allocatable :: displacement(:)
    real(dp) :: start
    integer :: k, status

    start = MPI_Wtime()
    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=tolerance))
    best = min(best, MPI_Wtime() - start)
    call stop_on(info)
    allocate (displacement(size(solution%force)))
    do k = 1, 3
      start = MPI_Wtime()
      call operator%apply(solution%gap, displacement, status)
      product_time = min(product_time, MPI_Wtime() - start)
    end do
  end subroutine time_solve

  ! The most memory that a rank has had, in arrays of its share of the cells.
  subroutine report_memory(n, ranks)
    integer, intent(in) :: n, ranks
    character(len=200) :: line
    integer(int64) :: kilobytes
    integer :: stat, unit

    kilobytes = 0
    open (newunit=unit, file='/proc/self/status', action='read', iostat=stat)
    if (stat /= 0) return
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (line(:6) == 'VmHWM:') read (line(7:index(line, 'kB') - 1), *) kilobytes
    end do
    close (unit)
    write (*, '(a,i4,a,f9.3,a,f7.2,a)') 'rank ', rank, ': at most ', 1.024e-6_dp*real(kilobytes, dp), ' GB, ', &
      128.0_dp*real(kilobytes, dp)*ranks/real(n, dp)**2, ' arrays of its share'
  end subroutine report_memory

  ! `value` with so many digits behind the point.
  pure function decimal(value, digits) result(word)
    real(dp), intent(in) :: value
    integer, intent(in) :: digits
    character(len=:), allocatable :: word
    character(len=24) :: field, form

    write (form, '(a,i0,a)') '(f20.', digits, ')'
    write (field, form) value
    word = trim(adjustl(field))
  end function decimal

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

    value = default
    if (word(k) /= '') call read_real(word(k), value)
  end function argument

  subroutine read_real(field, value)
    character(len=*), intent(in) :: field
    real(dp), intent(inout) :: value
    integer :: stat
    real(dp) :: found

    read (field, *, iostat=stat) found
    if (stat == 0) value = found
  end subroutine read_real

  function word(k)
    integer, intent(in) :: k
    character(len=32) :: word

    call get_command_argument(k, word)
  end function word

end program surface_mpi
