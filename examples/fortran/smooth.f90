!> One crest of a wave pressed on an elastic half-plane: accuracy over the number of unknowns.
!>
!>     smooth [folder for its table]
!>
!> The initial gap is d (1 - cos(k x)) on |x| <= pi/k, the contact |x| <= a. With J_n the Bessel
!> functions the exact answer is
!>
!>     F = (pi/2) E* d k a J_1(k a)
!>     p = E* d k sqrt(1 - t**2) sum_m (-1)**m J_(2m+1)(k a) U_2m(t),   t = x/a
!>     v = (2 F/(pi E*)) ln(2 D/a) + d (1 - J_0(k a))
!>
!> First the grid: the iteration on more and more cells, the edges of contact refined from
!> its forces. Then the engine for smooth punches, whose few coefficients are listed with the error of the
!> pressure if the series ends after each. Everything is per unit depth.
!> The table smooth.csv has the unknowns, the errors of half width, approach and pressure, and the time
!> of a solve.
program smooth
  use, intrinsic :: iso_fortran_env, only: int64
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_halfplane_operator, fuge_info, fuge_interval, fuge_problem, &
    fuge_smooth_contact, fuge_solution, fuge_solve_smooth_punch, fuge_solver, FUGE_DONE, FUGE_FREE, FUGE_HAT
  use smooth_wave, only: wave_crest
  implicit none

  !> N, mm.
  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter :: LENGTH = 20.0_dp, AMPLITUDE = 0.01_dp, E_STAR = 1.0e5_dp
  real(dp), parameter :: NUMBER = 2.0_dp*PI/LENGTH, HALF_WIDTH = 4.0_dp
  real(dp), parameter :: LOAD = 0.5_dp*PI*E_STAR*AMPLITUDE*NUMBER*HALF_WIDTH*bessel_j1(NUMBER*HALF_WIDTH)
  integer, parameter :: MOST_CELLS = 16384
  real(dp), parameter :: TOLERANCE = 1.0e-12_dp

  call run()

contains

  subroutine run()
    type(wave_crest) :: crest
    integer :: file, cells

    crest = wave_crest(lower=-0.5_dp*LENGTH, upper=0.5_dp*LENGTH, amplitude=AMPLITUDE, number=NUMBER)
    print '(a,f6.3,a,f10.3,a)', 'Contact |x| <= ', HALF_WIDTH, ' mm under ', LOAD, ' N/mm; relative errors'
    call create_file('smooth.csv', 1, file)
    write (file, '(a)') 'engine,unknowns,half width,approach,pressure,time [s]'
    print '(/,a)', '       cells  half width    approach    pressure    time [ms]'
    cells = 64
    do while (cells <= MOST_CELLS)
      call press_cells(crest, cells, file)
      cells = 4*cells
    end do
    call press_smoothly(crest, file)
    close (file)
  end subroutine run

  !> Solve by products on a uniform grid.
  subroutine press_cells(crest, cells, file)
    type(wave_crest), intent(in) :: crest
    integer, intent(in) :: cells, file
    real(dp) :: x(cells), width(cells), gap(cells), slope(cells), error(3), seconds
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    integer(int64) :: start
    integer :: status, k

    width = LENGTH/real(cells, dp)
    x = [(-0.5_dp*LENGTH + width(1)*(real(k, dp) - 0.5_dp), k=1, cells)]
    call crest%evaluate(x, gap, slope, status)
    problem%gap = gap
    problem%resultant = [LOAD]
    call operator%set(cells, width(1), E_STAR, info, FUGE_HAT, FUGE_FREE)
    if (info%failed()) error stop 'no operator'
    call system_clock(start)
    call solver%solve(operator, problem, solution, info)
    seconds = seconds_since(start)
    if (info%status /= FUGE_DONE) error stop 'the crest was not solved on the grid'
    call fuge_contact_edges(x, width, solution%force, FUGE_HAT, intervals, info)
    if (info%failed() .or. size(intervals) /= 1) error stop 'the edges were not found'
    error(1) = abs(0.5_dp*(intervals(1)%right - intervals(1)%left)/HALF_WIDTH - 1.0_dp)
    error(2) = abs(solution%motion(1)/exact_approach() - 1.0_dp)
    error(3) = maxval(abs(solution%force/width - exact_pressure(x)))/maxval(exact_pressure([0.0_dp]))
    print '(i12,3es12.2,f13.4)', cells, error, 1.0e3_dp*seconds
    write (file, '(a,i0,4('','',es9.2))') 'grid,', cells, error, seconds
    if (error(1) > 60.0_dp/real(cells, dp)**2) error stop 'the grid misses the half width'
  end subroutine press_cells

  !> Solve by coefficients; the second solve is timed, when code and data are in the cache.
  subroutine press_smoothly(crest, file)
    type(wave_crest), intent(in) :: crest
    integer, intent(in) :: file
    type(fuge_smooth_contact) :: contact, cut
    type(fuge_info) :: info
    type(verdict) :: exact
    real(dp) :: x(1001), error(3), seconds
    integer(int64) :: start
    integer :: k

    call fuge_solve_smooth_punch(crest, E_STAR, LOAD, contact, info)
    call system_clock(start)
    call fuge_solve_smooth_punch(crest, E_STAR, LOAD, contact, info)
    seconds = seconds_since(start)
    if (info%status /= FUGE_DONE) error stop 'the crest was not solved'
    x = [(0.5_dp*LENGTH*(real(k - 501, dp)/500.0_dp), k=1, size(x))]

    print '(/,a)', 'coefficients                            pressure'
    cut = contact
    do k = 1, size(contact%coefficients), 2
      cut%coefficients = contact%coefficients(:k)
      print '(i12,24x,es12.2)', k, pressure_error(cut, x)
    end do
    error(1) = abs(contact%half_width/HALF_WIDTH - 1.0_dp)
    error(2) = abs(contact%approach/exact_approach() - 1.0_dp)
    error(3) = pressure_error(contact, x)
    print '(/,a,/,i12,3es12.2,f13.4)', 'coefficients  half width    approach    pressure    time [ms]', &
      size(contact%coefficients), error, 1.0e3_dp*seconds
    print '(a,es8.1,a,es8.1,a,es8.1)', 'estimated: ends ', contact%end_error, ', pressure ', contact%pressure_error, &
      '; certificate ', info%residual
    write (file, '(a,i0,4('','',es9.2))') 'smooth,', size(contact%coefficients), error, seconds
    if (size(contact%coefficients) > 32) error stop 'too many coefficients'
    if (info%residual > TOLERANCE) error stop 'the answer is not certain'
    call exact%compare(error, TOLERANCE, 'the half width, the approach or the pressure')
    call exact%give('against the exact width, approach and pressure')
  end subroutine press_smoothly

  function seconds_since(start) result(seconds)
    integer(int64), intent(in) :: start
    real(dp) :: seconds
    integer(int64) :: now, rate

    call system_clock(now, rate)
    seconds = real(now - start, dp)/real(rate, dp)
  end function seconds_since

  pure function pressure_error(contact, x) result(error)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:)
    real(dp) :: error

    error = maxval(abs(contact%pressure(x) - exact_pressure(x)))/maxval(exact_pressure([0.0_dp]))
  end function pressure_error

  !> U_2m(t) sqrt(1 - t**2) = sin((2 m + 1) angle), t = cos(angle).
  pure function exact_pressure(x) result(pressure)
    real(dp), intent(in) :: x(:)
    real(dp) :: pressure(size(x))
    real(dp) :: angle(size(x))
    integer :: m

    angle = acos(max(-1.0_dp, min(1.0_dp, x/HALF_WIDTH)))
    pressure = 0.0_dp
    do m = 20, 0, -1
      pressure = pressure + real((-1)**m, dp)*bessel_jn(2*m + 1, NUMBER*HALF_WIDTH)*sin(real(2*m + 1, dp)*angle)
    end do
    pressure = E_STAR*AMPLITUDE*NUMBER*pressure
  end function exact_pressure

  !> A line load displaces nothing at D, twice the length of the profile.
  pure function exact_approach() result(approach)
    real(dp) :: approach

    approach = 2.0_dp*LOAD/(PI*E_STAR)*log(4.0_dp*LENGTH/HALF_WIDTH) &
               + AMPLITUDE*(1.0_dp - bessel_j0(NUMBER*HALF_WIDTH))
  end function exact_approach

end program smooth
