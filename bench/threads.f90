!> Whole first solves by 1, 2, 4, .. threads: how many times as fast as one, and whether the bits are the same.
!>
!>     threads [quick] [most MOST]
!>
!> prints a table. The numbers of threads alternate in each problem, the least elapsed time of each counts; up to as
!> many threads as there are cores, or MOST. `quick`: small problems only.
program threads
  use bench_problems, only: bench_problem, add_matrix, make_known, make_random, make_rough, uniform_edges, whole
  use bench_surfaces, only: bench_surface, make_surface
  use bench_team, only: solve_area, solve_line, solve_matrix
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_info, fuge_options, FUGE_MEAN
  use fuge_threads, only: usable_threads
  implicit none

  integer, parameter :: AREAS(3) = [512, 1024, 2048], LINES(2) = [18, 20], MATRICES(2) = [1000, 2000]
  integer, parameter :: AREAS_QUICK(1) = [128], LINES_QUICK(1) = [14], MATRICES_QUICK(1) = [200]
  character(len=10), parameter :: NAMES(3) = [character(len=10) :: 'sphere', 'light_area', 'heavy_area']
  character(len=12), parameter :: TEXTS(3) = [character(len=12) :: 'sphere', 'rough, light', 'rough, heavy']
  real(dp), parameter :: TOLERANCES(3) = [1.0e-10_dp, 1.0e-8_dp, 1.0e-8_dp]
  !> Mean pressures over E* of the rough profiles.
  real(dp), parameter :: LIGHT = 0.005_dp, HEAVY = 0.05_dp
  !> Runs by each number of threads, and the seconds after which there is none more.
  integer, parameter :: RUNS = 5
  real(dp), parameter :: PATIENCE = 60.0_dp

  abstract interface
    !> One more solve of the present problem.
    subroutine solve_present(options, watch, force, info)
      import :: dp, fuge_info, fuge_options, stopwatch
      type(fuge_options), intent(in) :: options
      type(stopwatch), intent(inout) :: watch
      real(dp), allocatable, intent(out) :: force(:)
      type(fuge_info), intent(out) :: info
    end subroutine solve_present
  end interface

  type(bench_surface) :: surface
  type(bench_problem) :: problem
  integer, allocatable :: counts(:)
  logical :: quick

  call run()

contains

  subroutine run()
    integer :: k

    call read_arguments()
    call print_head()
    if (quick) then
      call run_areas(AREAS_QUICK)
      call run_lines(LINES_QUICK)
      call run_matrices(MATRICES_QUICK)
    else
      do k = 1, size(AREAS)
        call run_areas(AREAS(k:k))
      end do
      call run_lines(LINES)
      call run_matrices(MATRICES)
    end if
  end subroutine run

  subroutine read_arguments()
    character(len=16) :: word
    integer :: k, most, stat

    quick = .false.
    most = usable_threads()
    do k = 1, command_argument_count()
      call get_command_argument(k, word)
      if (word == 'quick') quick = .true.
      if (word /= 'most') cycle
      call get_command_argument(k + 1, word)
      read (word, *, iostat=stat) most
      if (stat /= 0 .or. most < 1) error stop 'usage: threads [quick] [most MOST]'
    end do
    counts = [1]
    do while (2*counts(size(counts)) <= most)
      counts = [counts, 2*counts(size(counts))]
    end do
    if (counts(size(counts)) < most) counts = [counts, most]
  end subroutine read_arguments

  subroutine print_head()
    integer :: k

    write (*, '(a)', advance='no') '| problem | one thread |'
    do k = 2, size(counts)
      write (*, '(a)', advance='no') ' '//whole(counts(k))//' threads | times as fast |'
    end do
    write (*, '(a)') ' bits |'
    write (*, '(a)', advance='no') '| --- | ---: |'
    do k = 2, size(counts)
      write (*, '(a)', advance='no') ' ---: | ---: |'
    end do
    write (*, '(a)') ' --- |'
  end subroutine print_head

  subroutine run_areas(sides)
    integer, intent(in) :: sides(:)
    integer :: j, k

    do j = 1, size(sides)
      do k = 1, size(NAMES)
        call make_surface(trim(NAMES(k)), sides(j), surface)
        call compare(trim(TEXTS(k))//', '//whole(sides(j))//' x '//whole(sides(j)), TOLERANCES(k), present_area)
      end do
    end do
  end subroutine run_areas

  subroutine run_lines(powers)
    integer, intent(in) :: powers(:)
    integer :: k

    do k = 1, size(powers)
      call make_known('quartic', FUGE_MEAN, uniform_edges(2**powers(k)), problem)
      call compare('quartic 2^'//whole(powers(k)), 1.0e-10_dp, present_line)
      call make_rough(2**powers(k), LIGHT, problem)
      call compare('rough line, light 2^'//whole(powers(k)), 1.0e-10_dp, present_line)
      call make_rough(2**powers(k), HEAVY, problem)
      call compare('rough line, heavy 2^'//whole(powers(k)), 1.0e-10_dp, present_line)
    end do
  end subroutine run_lines

  subroutine run_matrices(sizes)
    integer, intent(in) :: sizes(:)
    integer :: k

    do k = 1, size(sizes)
      call make_known('quartic', FUGE_MEAN, uniform_edges(sizes(k)), problem)
      call add_matrix(problem)
      call compare('matrix, quartic '//whole(sizes(k)), 1.0e-10_dp, present_matrix)
      call make_random(sizes(k), problem)
      call compare('matrix, random '//whole(sizes(k)), 1.0e-10_dp, present_matrix)
    end do
  end subroutine run_matrices

  !> Print the row of a problem.
  subroutine compare(name, tolerance, solve)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: tolerance
    procedure(solve_present) :: solve
    type(stopwatch) :: watches(size(counts))
    type(fuge_options) :: options
    type(fuge_info) :: info
    real(dp), allocatable :: force(:), reference(:)
    logical :: same
    integer :: k, round

    watches%elapsed = .true.
    options%tolerance = tolerance
    same = .true.
    do round = 1, RUNS
      do k = 1, size(counts)
        options%threads = counts(k)
        call solve(options, watches(k), force, info)
        if (info%failed()) then
          write (*, '(a)') '| '//name//' | '//trim(info%message)//' |'
          return
        end if
        if (.not. allocated(reference)) allocate (reference, source=force)
        same = same .and. all(transfer(force, [0]) == transfer(reference, [0]))
      end do
      if (sum(watches%spent) > PATIENCE) exit
    end do
    write (*, '(a)', advance='no') '| '//name//' | '//milliseconds(watches(1)%best)
    do k = 2, size(counts)
      write (*, '(a,f0.2)', advance='no') ' | '//milliseconds(watches(k)%best)//' | ', watches(1)%best/watches(k)%best
    end do
    write (*, '(a)') ' | '//trim(merge('the same  ', '**differ**', same))//' |'
  end subroutine compare

  subroutine present_area(options, watch, force, info)
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info

    call solve_area(surface, options, watch, force, info)
  end subroutine present_area

  subroutine present_line(options, watch, force, info)
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info

    call solve_line(problem, options, watch, force, info)
  end subroutine present_line

  subroutine present_matrix(options, watch, force, info)
    type(fuge_options), intent(in) :: options
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable, intent(out) :: force(:)
    type(fuge_info), intent(out) :: info

    call solve_matrix(problem, options, watch, force, info)
  end subroutine present_matrix

  !> Such as 12.3 ms.
  function milliseconds(time) result(words)
    real(dp), intent(in) :: time
    character(len=:), allocatable :: words
    character(len=24) :: buffer

    write (buffer, '(f12.3)') 1.0e3_dp*time
    words = trim(adjustl(buffer))//' ms'
  end function milliseconds

end program threads
