!> What general scenes cost on an area beside the plain one, which is one translation under a load: two tilts, a
!> hardness that 30 % of the load would reach, half of the points excluded, play, a spring on the motion.
!>
!>     general_scenes [sizes]     n for n x n cells; 256 512 1024 by default
!>
!> The surfaces are those of bench_surfaces: the sphere on a free half-space and the heavy rough one, periodic. Prints a
!> table with a row for each scene and a column for each size: products + preconditionings, and the time over that of
!> the plain scene, which is given in milliseconds; then the largest residual. Scenes alternate and the least time of
!> each counts, because other programs may run. Each solve is from scratch, by an operator that is there already.
program general_scenes
  use bench_general_scenes, only: problem_of, PLAIN, SCENES, SURFACES
  use bench_problems, only: whole
  use bench_surfaces, only: bench_surface, make_surface, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_ITERATIVE
  implicit none

  integer, parameter :: SIZES(3) = [256, 512, 1024]
  real(dp), parameter :: TOLERANCE = 1.0e-8_dp
  !> Rounds of all scenes.
  integer, parameter :: LEAST = 3, MOST = 30
  !> Seconds after which there is no further round.
  real(dp), parameter :: ENOUGH = 10.0_dp

  type :: measurement
    type(stopwatch) :: watch
    type(fuge_info) :: info
  end type measurement

  !> The lines of the table.
  character(len=200) :: lines(size(SURFACES)*size(SCENES) + 2)
  character(len=16) :: argument
  real(dp) :: largest_residual
  integer :: j, k, n

  largest_residual = 0.0_dp
  lines(1) = '| surface, scene'
  lines(2) = '| ---'
  do j = 1, size(SURFACES)
    do k = 1, size(SCENES)
      lines(2 + size(SCENES)*(j - 1) + k) = '| '//trim(SURFACES(j))//', '//SCENES(k)
    end do
  end do
  if (command_argument_count() == 0) then
    do k = 1, size(SIZES)
      call measure(SIZES(k))
    end do
  end if
  do k = 1, command_argument_count()
    call get_command_argument(k, argument)
    read (argument, *) n
    call measure(n)
  end do
  print '(a)', (trim(lines(k))//' |', k=1, size(lines))
  print '(a,es8.1)', 'Largest residual:', largest_residual

contains

  !> Append the column of n x n cells.
  subroutine measure(n)
    integer, intent(in) :: n
    integer :: surface

    lines(1) = trim(lines(1))//' | '//whole(n)//' x '//whole(n)
    lines(2) = trim(lines(2))//' | ---:'
    do surface = 1, size(SURFACES)
      call measure_surface(trim(SURFACES(surface)), n, size(SCENES)*(surface - 1) + 2)
    end do
  end subroutine measure

  !> Solve all scenes of a surface of n x n cells, and append their cells to the lines after number `before`.
  subroutine measure_surface(name, n, before)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, before
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: operator
    type(measurement) :: found(size(SCENES))
    real(dp) :: spent
    integer :: j, round

    call make_surface(name, n, surface)
    call set_operator(surface, operator)
    spent = 0.0_dp
    do round = 1, MOST
      do j = 1, size(SCENES)
        call solve(operator, problem_of(surface, j), found(j))
        spent = spent + found(j)%watch%best
      end do
      if (round >= LEAST .and. spent > ENOUGH) exit
    end do
    do j = 1, size(SCENES)
      lines(before + j) = trim(lines(before + j))//' | '//cell_of(found(j), found(PLAIN), j == PLAIN)
      if (.not. found(j)%info%failed()) largest_residual = max(largest_residual, found(j)%info%residual)
    end do
  end subroutine measure_surface

  subroutine solve(operator, problem, found)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(measurement), intent(inout) :: found
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution

    call found%watch%start()
    call solver%solve(operator, problem, solution, found%info, fuge_options(FUGE_ITERATIVE, tolerance=TOLERANCE))
    call found%watch%stop()
  end subroutine solve

  !> A cell of the table.
  function cell_of(found, plain, is_plain) result(cell)
    type(measurement), intent(in) :: found, plain
    logical, intent(in) :: is_plain
    character(len=:), allocatable :: cell
    character(len=12) :: ratio

    if (found%info%status /= 0) then
      cell = 'status '//whole(found%info%status)
      return
    end if
    if (is_plain) then
      write (ratio, '(i0,a)') nint(1.0e3_dp*found%watch%best), ' ms'
    else
      write (ratio, '(f8.2)') found%watch%best/plain%watch%best
    end if
    cell = whole(found%info%products)//' + '//whole(found%info%preconditionings)//', '//trim(adjustl(ratio))
  end function cell_of

end program general_scenes
