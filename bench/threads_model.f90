!> A model of the time of a first solve that threads share, fitted to this machine and evaluated for more cores: what
!> cannot be measured here. Companion of mpi_model, which is about ranks.
!>
!>     threads_model [N [GB/s [GB/s]]]
!>
!> prints a table for areas of N x N cells, by default 1024. A solve that takes T on one core takes on p of them
!>
!>   S + (T - S - M)/p + M B/min(p B, W)
!>
!> S: the serial rest, in which the other cores of this machine idle: of the elapsed time of a solve on all c of them,
!> (c elapsed - processor time)/(c - 1), so that nothing else may run meanwhile. M: the time in which one core waits for
!> memory, the bytes of a solve over its bandwidth B, which is measured; and W the bandwidth of all cores together,
!> measured here and assumed elsewhere: 50 and 200 GB/s by default, two channels of memory and eight. The bytes are
!> counted, not measured, for the search in single precision: passes over the points move 72 bytes of a cell in contact
!> for a step, 80 for another contact set, and each has a product; transforms and kernel move 11 arrays of 4 bytes in a
!> product of a free surface, 6.5 in one of a periodic surface and in a preconditioning.
program threads_model
  use bench_bandwidth, only: bandwidth
  use bench_problems, only: whole
  use bench_surfaces, only: bench_surface, make_surface
  use bench_team, only: solve_area
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_info, fuge_options, FUGE_FREE
  use fuge_threads, only: usable_threads
  implicit none

  character(len=10), parameter :: NAMES(3) = [character(len=10) :: 'sphere', 'light_area', 'heavy_area']
  character(len=12), parameter :: TEXTS(3) = [character(len=12) :: 'sphere', 'rough, light', 'rough, heavy']
  real(dp), parameter :: TOLERANCES(3) = [1.0e-10_dp, 1.0e-8_dp, 1.0e-8_dp]
  !> Bytes at a cell.
  real(dp), parameter :: OF_PASSES = 76.0_dp, OF_FREE = 4.0_dp*11.0_dp, OF_PERIODIC = 4.0_dp*6.5_dp
  integer, parameter :: CORES(2) = [8, 16], RUNS = 3

  !> Seconds of a solve on one core; bytes/s of one core.
  type :: solve_model
    real(dp) :: total = 0.0_dp, serial = 0.0_dp, memory = 0.0_dp, bandwidth = 0.0_dp
  end type solve_model

  call run()

contains

  subroutine run()
    real(dp) :: of_one, of_all, assumed(2)
    integer :: k, n, threads

    n = nint(argument(1, 1024.0_dp))
    assumed = 1.0e9_dp*[argument(2, 50.0_dp), argument(3, 200.0_dp)]
    threads = max(usable_threads(), 2)
    of_one = bandwidth(1)
    of_all = bandwidth(threads)
    call print_head(threads, assumed)
    do k = 1, size(NAMES)
      call print_row(k, n, threads, of_one, of_all, assumed)
    end do
    write (*, '(/,a,/,a)') '| cores of this machine | bandwidth of the memory to them, GB/s |', '| ---: | ---: |'
    write (*, '(a,f0.1,a)') '| 1 | ', 1.0e-9_dp*of_one, ' |', '| '//whole(threads)//' | ', 1.0e-9_dp*of_all, ' |'
  end subroutine run

  subroutine print_head(threads, assumed)
    integer, intent(in) :: threads
    real(dp), intent(in) :: assumed(2)
    integer :: j, k

    write (*, '(a)', advance='no') '| problem | one core | serial | waits for memory | measured on ' &
      //whole(threads)//' | modelled |'
    do j = 1, size(assumed)
      do k = 1, size(CORES)
        write (*, '(a)', advance='no') ' '//whole(CORES(k))//' cores, '//whole(nint(1.0e-9_dp*assumed(j)))//' GB/s |'
      end do
    end do
    write (*, '(a,/,a)') ' longest part there |', '| --- | ---: | ---: | ---: | ---: | ---: |' &
      //repeat(' ---: |', size(assumed)*size(CORES))//' --- |'
  end subroutine print_head

  !> Times as fast as on one core.
  subroutine print_row(which, n, threads, of_one, of_all, assumed)
    integer, intent(in) :: which, n, threads
    real(dp), intent(in) :: of_one, of_all, assumed(2)
    type(bench_surface) :: surface
    type(solve_model) :: model
    real(dp) :: elapsed, parts(3)
    integer :: j, k

    call make_surface(trim(NAMES(which)), n, surface)
    call measure(surface, TOLERANCES(which), threads, of_one, model, elapsed)
    write (*, '(a,f0.1,2(a,f0.1),2(a,f0.2))', advance='no') '| '//trim(TEXTS(which))//', '//whole(n)//' x '//whole(n) &
      //' | ', 1.0e3_dp*model%total, ' ms | ', 100.0_dp*model%serial/model%total, ' % | ', &
      100.0_dp*model%memory/model%total, ' % | ', model%total/elapsed, ' | ', &
      model%total/sum(on_cores(model, threads, of_all))
    parts = 0.0_dp
    do j = 1, size(assumed)
      do k = 1, size(CORES)
        parts = on_cores(model, CORES(k), assumed(j))
        write (*, '(a,f0.1)', advance='no') ' | ', model%total/sum(parts)
      end do
    end do
    write (*, '(a)') ' | '//trim(name_of(maxloc(parts, dim=1)))//' |'
  end subroutine print_row

  !> Solves by one thread and by all, in turn.
  subroutine measure(surface, tolerance, threads, of_one, model, elapsed)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: tolerance, of_one
    integer, intent(in) :: threads
    type(solve_model), intent(out) :: model
    real(dp), intent(out) :: elapsed
    type(stopwatch) :: alone, shared
    type(fuge_options) :: options
    type(fuge_info) :: info
    real(dp), allocatable :: force(:)
    real(dp) :: bytes
    integer :: k

    alone%elapsed = .true.
    shared%elapsed = .true.
    options%tolerance = tolerance
    do k = 1, RUNS
      options%threads = 1
      call solve_area(surface, options, alone, force, info)
      options%threads = threads
      call solve_area(surface, options, shared, force, info)
      if (info%failed()) error stop 'not solved'
    end do
    elapsed = shared%best
    bytes = OF_PASSES + merge(OF_FREE, OF_PERIODIC, surface%boundary == FUGE_FREE)
    bytes = size(surface%gap)*(bytes*info%products + OF_PERIODIC*info%preconditionings)
    model%bandwidth = of_one
    model%total = alone%best
    model%serial = (threads*shared%best - shared%processor)/real(threads - 1, dp)
    model%serial = min(max(model%serial, 0.0_dp), model%total)
    model%memory = min(bytes/of_one, model%total - model%serial)
  end subroutine measure

  !> Seconds of the serial rest, of arithmetic and of memory on `p` cores with `bandwidth` together.
  pure function on_cores(model, p, bandwidth) result(parts)
    type(solve_model), intent(in) :: model
    integer, intent(in) :: p
    real(dp), intent(in) :: bandwidth
    real(dp) :: parts(3)

    parts = [model%serial, (model%total - model%serial - model%memory)/p, &
             model%memory*model%bandwidth/min(p*model%bandwidth, bandwidth)]
  end function on_cores

  pure function name_of(part) result(name)
    integer, intent(in) :: part
    character(len=12) :: name
    character(len=12), parameter :: PARTS(3) = [character(len=12) :: 'serial', 'arithmetic', 'memory']

    name = PARTS(part)
  end function name_of

  function argument(k, default) result(value)
    integer, intent(in) :: k
    real(dp), intent(in) :: default
    real(dp) :: value
    character(len=32) :: word
    integer :: stat

    value = default
    call get_command_argument(k, word)
    if (word == '') return
    read (word, *, iostat=stat) value
    if (stat /= 0) error stop 'usage: threads_model [N [GB/s [GB/s]]]'
  end function argument

end program threads_model
