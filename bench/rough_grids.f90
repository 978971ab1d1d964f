!> Rough contact on finer and finer grids: the error of the grid beside that of the solver.
!>
!>     rough_grids [FINEST [light|heavy]]
!>
!> A periodic self-affine surface with waves of 4 to 16 periods along a side is pressed on a half-space under a light
!> and a heavy load, on 128 x 128 to FINEST x FINEST cells (default 2048), and on a grid twice as fine with which the
!> others are compared. Writes Markdown tables: the area of contact (as a fraction of the surface), the approach of the
!> mean planes (over the root mean square of the heights) and the largest pressure, and their errors by the grid, at a
!> tolerance of 1e-12; then what tolerances of 1e-4 and 1e-8 change on the same grid, the worst of the three quantities
!> relative to their values. One thread.
program rough_grids
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_problems, only: whole
  use bench_surfaces, only: bench_surface, make_rough_surface, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_DONE, FUGE_ITERATIVE, FUGE_WARN_ILL_CONDITIONED
  implicit none

  integer, parameter :: COARSEST = 128, FINEST = 2048, PERIODS = 16
  !> Mean pressures over E*.
  real(dp), parameter :: PRESSURES(2) = [0.005_dp, 0.05_dp]
  character(len=5), parameter :: NAMES(2) = ['light', 'heavy']
  !> Tolerances: for the errors of the grid, and those with which it is compared.
  real(dp), parameter :: TIGHT = 1.0e-12_dp, TOLERANCES(2) = [1.0e-4_dp, 1.0e-8_dp]
  !> Up to this grid the tolerances are compared.
  integer, parameter :: FINEST_COMPARED = 1024

  !> The results of a contact, as fractions of the surface, of the heights, and of E*. `corrected`: the area less the
  !> share of its perimeter by which counted cells exceed a smooth outline.
  type :: rough_result
    integer :: n = 0
    real(dp) :: area = 0.0_dp, corrected = 0.0_dp, approach = 0.0_dp, peak = 0.0_dp
    !> Of a solve to `TOLERANCES`: the largest relative change of the three, and the time in seconds.
    real(dp) :: change(2) = 0.0_dp, time(2) = 0.0_dp
  end type rough_result

  call run()

contains

  subroutine run()
    character(len=16) :: word
    integer :: finest_used, k, stat

    finest_used = FINEST
    if (command_argument_count() > 0) then
      call get_command_argument(1, word)
      read (word, *, iostat=stat) finest_used
      if (stat /= 0 .or. finest_used < COARSEST) error stop 'usage: rough_grids [FINEST [light|heavy]]'
    end if
    word = ''
    if (command_argument_count() > 1) call get_command_argument(2, word)
    do k = 1, size(NAMES)
      if (word == '' .or. word == NAMES(k)) call measure(NAMES(k), PRESSURES(k), finest_used)
    end do
  end subroutine run

  subroutine measure(name, pressure, last)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: pressure
    integer, intent(in) :: last
    type(rough_result), allocatable :: found(:)
    integer :: k, n

    allocate (found(0))
    n = COARSEST
    do while (n <= 2*last)
      found = [found, on_grid(n, pressure)]
      n = 2*n
    end do
    write (output_unit, '(a)') '| '//name//', cells | cells per shortest wave | area | error | less perimeter: error ' &
      //'| approach: error | largest pressure: error | tolerance 1e-4: error, time | 1e-8: error, time |', &
      '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do k = 1, size(found) - 1
      call show(found(k), found(size(found)))
    end do
    flush (output_unit)
  end subroutine measure

  subroutine show(one, reference)
    type(rough_result), intent(in) :: one, reference
    character(len=24) :: compared(2)
    integer :: k

    compared = ''
    do k = 1, 2
      if (one%n <= FINEST_COMPARED) write (compared(k), '(es7.0,a,f7.3,a)') one%change(k), ',', one%time(k), ' s'
    end do
    write (output_unit, '(a,i0,a,f6.2,a,2(f7.2,a),2(es9.1,a),5a)') '| '//whole(one%n)//' x '//whole(one%n)//' | ', &
      one%n/PERIODS, ' | ', 100.0_dp*one%area, ' % | ', 100.0_dp*(one%area/reference%corrected - 1.0_dp), ' % | ', &
      100.0_dp*(one%corrected/reference%corrected - 1.0_dp), ' % | ', one%approach - reference%approach, ' | ', &
      one%peak/reference%peak - 1.0_dp, ' | ', trim(adjustl(compared(1))), ' | ', trim(adjustl(compared(2))), ' |'
  end subroutine show

  function on_grid(n, pressure) result(found)
    integer, intent(in) :: n
    real(dp), intent(in) :: pressure
    type(rough_result) :: found
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: operator
    type(rough_result) :: other
    integer :: k

    call make_rough_surface(n, pressure, surface, PERIODS)
    call set_operator(surface, operator)
    found = solved(surface, operator, merge(TIGHT, TOLERANCES(2), n <= FINEST_COMPARED))
    if (n > FINEST_COMPARED) return
    do k = 1, 2
      other = solved(surface, operator, TOLERANCES(k))
      found%change(k) = max(abs(other%area/found%area - 1.0_dp), abs(other%approach/found%approach - 1.0_dp), &
                            abs(other%peak/found%peak - 1.0_dp))
      found%time(k) = other%time(1)
    end do
  end function on_grid

  function solved(surface, operator, tolerance) result(found)
    type(bench_surface), intent(in) :: surface
    type(fuge_halfspace_operator), intent(in) :: operator
    real(dp), intent(in) :: tolerance
    type(rough_result) :: found
    type(fuge_problem) :: contact
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(stopwatch) :: watch

    contact = surface%contact()
    call watch%start()
    call solver%solve(operator, contact, solution, info, fuge_options(FUGE_ITERATIVE, tolerance=tolerance))
    call watch%stop()
    ! At the loose tolerance the estimate of the forces' error is above what comes without a warning.
    if (all(info%status /= [FUGE_DONE, FUGE_WARN_ILL_CONDITIONED])) error stop 'a rough surface was not solved'
    found%n = surface%n
    found%time = watch%best
    found%peak = maxval(solution%force)/surface%cell()**2
    found%approach = solution%motion(1)/sqrt(sum(surface%gap**2)/real(size(surface%gap), dp))
    call measure_area(surface%n, solution%force, found)
  end function solved

  !> The area of the cells in contact, and that less (pi - 1 + ln 2)/24 of the length of its outline in steps from cell
  !> to cell (V. A. Yastrebov, G. Anciaux and J.-F. Molinari, Tribology International 114, 2017, 161-171).
  subroutine measure_area(n, force, found)
    integer, intent(in) :: n
    real(dp), intent(in) :: force(:)
    type(rough_result), intent(inout) :: found
    real(dp), parameter :: SHARE = (acos(-1.0_dp) - 1.0_dp + log(2.0_dp))/24.0_dp
    logical, allocatable :: touches(:, :)
    integer :: steps

    allocate (touches(n, n))
    touches = reshape(force > 0.0_dp, [n, n])
    steps = count(touches .neqv. cshift(touches, 1, 1)) + count(touches .neqv. cshift(touches, 1, 2))
    found%area = real(count(touches), dp)/real(n, dp)**2
    found%corrected = found%area - SHARE*real(steps, dp)/real(n, dp)**2
  end subroutine measure_area

end program rough_grids
