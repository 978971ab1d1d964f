!> A rough profile pressed on an elastic half-plane: real contact length over load.
!>
!>     rough [cells [folder for its tables]]
!>
!> `cells` is a power of two, 2**18 unless given. The profile is self-affine and periodic. Lengths count in periods, and
!> pressures in E*: mean pressure and contact do not depend on its value. While the contact is small its length is
!> proportional to the load, A/A_0 = kappa p/(E* h') with the rms slope h'.
!> For the pictures it writes rough_load.csv and rough_window.csv.
program rough
  use, intrinsic :: iso_fortran_env, only: int64
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver, &
    FUGE_PERIODIC
  use rough_profile, only: rms_slope, self_affine_profile
  use rough_progress, only: ticker
  implicit none

  integer, parameter :: LOADS_A_DECADE = 10, DECADES = 3
  !> Mean pressure over E*, the largest one, and that of the picture.
  real(dp), parameter :: LARGEST = 0.1_dp, SHOWN = 0.01_dp
  !> The picture shows one part in WINDOW of the period.
  integer, parameter :: WINDOW = 64

  call run()

contains

  subroutine run()
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    real(dp), allocatable :: height(:)
    real(dp) :: spacing
    integer :: cells

    call read_arguments(cells)
    allocate (height(cells))
    call self_affine_profile(cells, height)
    spacing = 1.0_dp/real(cells, dp)
    print '(i0,a,f7.4)', cells, ' cells, rms slope', rms_slope(height, spacing)

    call operator%set(cells, spacing, 1.0_dp, info, boundary=FUGE_PERIODIC)
    if (info%failed()) call give_up(info)
    ! The profile faces upwards: where it is high, the gap to the flat body above is small.
    problem%gap = maxval(height) - height
    allocate (problem%resultant(1))
    call all_loads(operator, problem, height, spacing)
  end subroutine run

  subroutine read_arguments(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 2**18
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: rough [cells [folder]]'
    if (cells < 1024 .or. popcnt(cells) /= 1) error stop 'cells has to be a power of two, 1024 or more'
  end subroutine read_arguments

  !> Solve from large to small loads; each solve starts from the forces of the one before.
  subroutine all_loads(operator, problem, height, spacing)
    type(fuge_halfplane_operator), intent(in) :: operator
    type(fuge_problem), intent(inout) :: problem
    real(dp), intent(in) :: height(:), spacing
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(ticker), target :: monitor
    type(verdict) :: theory
    real(dp) :: pressure, seconds
    integer :: file, k

    print '(a)', '   p/E*      contact    kappa    approach   residual  products   time [s]'
    call create_file('rough_load.csv', 2, file)
    write (file, '(a)') 'pressure,contact,kappa,approach,residual,products,preconditionings,seconds,rms_slope'
    do k = 0, DECADES*LOADS_A_DECADE
      pressure = LARGEST*10.0_dp**(-real(k, dp)/real(LOADS_A_DECADE, dp))
      problem%resultant(1) = pressure*spacing*real(size(height), dp)
      seconds = clock()
      call solver%solve(operator, problem, solution, info, monitor=monitor)
      if (info%status /= 0) call give_up(info)
      call write_load(file, pressure, rms_slope(height, spacing), solution, info, clock() - seconds)
      if (abs(pressure/SHOWN - 1.0_dp) < 1.0e-6_dp) then
        call write_window(height, spacing, solution)
      end if
      if (pressure > 0.99_dp*SHOWN) call check_contact(info%contacts, pressure, height, spacing, theory)
    end do
    close (file)
    call theory%give('contact lengths near Persson''s theory')
  end subroutine all_loads

  subroutine write_load(file, pressure, slope, solution, info, seconds)
    integer, intent(in) :: file
    real(dp), intent(in) :: pressure, slope, seconds
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    real(dp) :: contact, kappa

    contact = real(info%contacts, dp)/real(size(solution%force), dp)
    kappa = contact*slope/pressure
    print '(es10.3,f10.5,f9.4,es12.4,es11.1,i10,f11.3)', pressure, contact, kappa, solution%motion(1), info%residual, &
      info%products, seconds
    write (file, '(5(es14.6,","),2(i0,","),es10.3,",",es14.6)') pressure, contact, kappa, solution%motion(1), &
      info%residual, info%products, info%preconditionings, seconds, slope
  end subroutine write_load

  !> The contact length is hardly below that of Persson, erf(sqrt(2) p/(E* h')), and not much above kappa = 2.
  subroutine check_contact(contacts, pressure, height, spacing, theory)
    integer, intent(in) :: contacts
    real(dp), intent(in) :: pressure, height(:), spacing
    type(verdict), intent(inout) :: theory
    real(dp) :: length, reduced

    length = real(contacts, dp)/real(size(height), dp)
    reduced = pressure/rms_slope(height, spacing)
    call theory%hold(length >= 0.95_dp*erf(sqrt(2.0_dp)*reduced) .and. length <= 2.4_dp*reduced, 'the contact length')
  end subroutine check_contact

  !> Profile, surface of the body above and pressure around the largest pressure.
  subroutine write_window(height, spacing, solution)
    real(dp), intent(in) :: height(:), spacing
    type(fuge_solution), intent(in) :: solution
    integer :: file, first, last, middle, k

    middle = maxloc(solution%force, dim=1)
    first = max(1, middle - size(height)/(2*WINDOW))
    last = min(size(height), middle + size(height)/(2*WINDOW))
    call create_file('rough_window.csv', 2, file)
    write (file, '(a)') 'x,profile,surface,pressure'
    do k = first, last
      write (file, '(3(es16.8,","),es16.8)') (real(k, dp) - 0.5_dp)*spacing, height(k), height(k) + solution%gap(k), &
        solution%force(k)/spacing
    end do
    close (file)
  end subroutine write_window

  !> Wall time, s.
  function clock() result(seconds)
    real(dp) :: seconds
    integer(int64) :: ticks, rate

    call system_clock(ticks, rate)
    seconds = real(ticks, dp)/real(rate, dp)
  end function clock

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 'the profile was not solved'
  end subroutine give_up

end program rough
