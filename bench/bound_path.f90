!> The load path beside its bound: two triangular solves for each event.
!>
!>     bound_path [N]
!>
!> A path from zero load to that at which the contact is as wide as in the other benchmarks. The bound is two
!> triangular solves with the Cholesky factor of the mean contact set, centred, of the same matrix. Both are measured
!> alternately in processor time, and the fastest run of each counts; times are microseconds for one event. Writes
!> rows of a Markdown table, with N that of quartic N only.
program bound_path
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_lapack, only: dposv, dtrsv
  use bench_problems, only: bench_problem, add_matrix, make_known, uniform_edges, whole
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_load_path, fuge_path, FUGE_MEAN
  implicit none

  integer, parameter :: POINTS(3) = [256, 1024, 2048]
  real(dp), parameter :: WANTED = 3.0_dp
  !> Seconds for the repetitions of a row, and the fewest of them.
  real(dp), parameter :: PATIENCE = 3.0_dp
  integer, parameter :: FEWEST = 5, SOLVES = 100

  call run()

contains

  subroutine run()
    character(len=16) :: word
    integer :: k

    call get_command_argument(1, word)
    write (output_unit, '(a)') '| problem | bound | fuge | ratio | wanted |', '| --- | ---: | ---: | ---: | ---: |'
    do k = 1, size(POINTS)
      if (word == '' .or. word == whole(POINTS(k))) call measure(POINTS(k))
    end do
  end subroutine run

  subroutine measure(n)
    integer, intent(in) :: n
    type(bench_problem), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_path) :: path
    type(fuge_info) :: info
    real(dp), allocatable :: factor(:, :)
    real(dp) :: bound, event, began, before, after
    integer :: run

    call make_known('quartic', FUGE_MEAN, uniform_edges(n), problem)
    call add_matrix(problem)
    call operator%set(problem%alpha, info)
    call fuge_load_path(operator, problem%gap, problem%load, path, info)
    if (info%failed()) error stop 'the path has failed'
    call factor_centre(problem%alpha, sum(path%contacts(2:))/(path%entries - 1), factor)
    bound = huge(bound)
    event = huge(event)
    call cpu_time(began)
    run = 0
    do
      run = run + 1
      bound = min(bound, time_of_solves(factor))
      call cpu_time(before)
      call fuge_load_path(operator, problem%gap, problem%load, path, info)
      call cpu_time(after)
      event = min(event, (after - before)/real(path%entries - 1, dp))
      if (run >= FEWEST .and. after - began > PATIENCE) exit
    end do
    write (output_unit, '(a,i0,a,i0,a,f0.1,a,f0.1,a,f0.2,a,f0.1,a)') '| load path, quartic ', n, ', an event of ', &
      path%entries - 1, ' | ', 1.0e6_dp*bound, ' us | ', 1.0e6_dp*event, ' us | ', event/bound, ' | ', WANTED, ' |'
  end subroutine measure

  !> The Cholesky factor of the block of `m` points in the middle.
  subroutine factor_centre(alpha, m, factor)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: m
    real(dp), allocatable, intent(out) :: factor(:, :)
    real(dp) :: right(m)
    integer :: first, info

    first = (size(alpha, 2) - m)/2
    factor = alpha(first + 1:first + m, first + 1:first + m)
    factor = factor - minval(factor)
    right = 1.0_dp
    call dposv('L', m, 1, factor, m, right, m, info)
    if (info /= 0) error stop 'the block is not definite'
  end subroutine factor_centre

  !> Seconds for two triangular solves.
  function time_of_solves(factor) result(time)
    real(dp), intent(in) :: factor(:, :)
    real(dp) :: time
    real(dp) :: right(size(factor, 1)), before
    integer :: k, m

    m = size(right)
    right = 1.0_dp
    call cpu_time(before)
    do k = 1, SOLVES
      call dtrsv('L', 'N', 'N', m, factor, m, right, 1)
      call dtrsv('L', 'T', 'N', m, factor, m, right, 1)
      right = right/maxval(abs(right))
    end do
    call cpu_time(time)
    time = (time - before)/real(SOLVES, dp)
  end function time_of_solves

end program bound_path
