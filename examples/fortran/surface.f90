!> A rough surface pressed on an elastic half-space: real area of contact over load.
!>
!>     surface [cells [folder for its tables]]
!>
!> A self-affine surface of `cells` x `cells`, a power of two, 1024 unless given, periodic in both directions. Lengths
!> count in periods and pressures in E*. While the contact is small its area is proportional to the load, A/A_0 = kappa
!> p/(E* g) with the root mean square g of the gradient, kappa being sqrt(2 pi) = 2.51 in the asymptotic theory of A. W.
!> Bush, R. D. Gibson and T. R. Thomas (1975) and sqrt(8/pi) = 1.60 in that of B. N. J. Persson (2001), who has A/A_0 =
!> erf(sqrt(2) p/(E* g)) up to complete contact; what is computed lies between. Cells at the edge of a spot count as a
!> whole, so the area is too large by a share of its perimeter; a second column is without it, by (pi - 1 + ln 2)/24 of
!> the perimeter times the cell (V. A. Yastrebov, G. Anciaux, J.-F. Molinari 2017). For the pictures it writes
!> surface_load.csv and surface_map.dat.
program surface
  use, intrinsic :: iso_fortran_env, only: int64
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_MEAN, FUGE_PERIODIC
  use surface_heights, only: perimeter, rms_gradient, self_affine_surface
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> p/(E* g): the loads, and that of the map.
  real(dp), parameter :: LOADS(10) = &
    [0.02_dp, 0.035_dp, 0.06_dp, 0.1_dp, 0.16_dp, 0.25_dp, 0.4_dp, 0.65_dp, 1.0_dp, 1.6_dp]
  !> A tolerance that is finer than the digits of any picture.
  type(fuge_options), parameter :: OPTIONS = fuge_options(tolerance=1.0e-8_dp)
  integer, parameter :: SHOWN = 4
  !> The map has this many pixels in each direction.
  integer, parameter :: PLACES = 512

  call run()

contains

  subroutine run()
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    real(dp), allocatable :: height(:, :)
    real(dp) :: spacing
    integer :: cells

    call read_cells(cells)
    allocate (height(cells, cells))
    call self_affine_surface(cells, height)
    spacing = 1.0_dp/real(cells, dp)
    print '(i0,a,i0,a,f7.4)', cells, ' x ', cells, ' cells, rms gradient', rms_gradient(height, spacing)

    call operator%set(cells, cells, spacing, spacing, 1.0_dp, info, element=FUGE_MEAN, boundary=FUGE_PERIODIC)
    if (info%failed()) call give_up(info)
    ! The surface faces upwards: where it is high, the gap to the flat body above is small.
    problem%gap = reshape(maxval(height) - height, [size(height)])
    call all_loads(operator, problem, height, spacing)
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 1024
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: surface [cells [folder]]'
    if (cells < 64 .or. popcnt(cells) /= 1) error stop 'cells has to be a power of two, 64 or more'
  end subroutine read_cells

  !> Loads as far apart as these are solved from coarser grids, each as if it were the first.
  subroutine all_loads(operator, problem, height, spacing)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_problem), intent(inout) :: problem
    real(dp), intent(in) :: height(:, :), spacing
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(verdict) :: theories
    real(dp) :: gradient, seconds
    integer :: file, k

    gradient = rms_gradient(height, spacing)
    print '(a)', ' p/(E* g)      A/A_0  less edge      kappa    Persson  mean gap/rms height   products' &
      //'   residual   time [s]'
    call create_file('surface_load.csv', 2, file)
    write (file, '(a)') 'pressure,contact,corrected,products,seconds'
    do k = 1, size(LOADS)
      problem%resultant = [LOADS(k)*gradient]
      seconds = clock()
      call solver%solve(operator, problem, solution, info, OPTIONS)
      if (info%status /= 0) call give_up(info)
      call write_load(file, LOADS(k), height, solution, info, clock() - seconds, theories)
      if (k == SHOWN) call write_map(reshape(solution%force, shape(height))/spacing**2)
    end do
    close (file)
    call theories%give('areas between Persson and Bush, Gibson, Thomas')
  end subroutine all_loads

  !> A line of the table; the period is 1, so areas are fractions of it.
  subroutine write_load(file, pressure, height, solution, info, seconds, theories)
    integer, intent(in) :: file
    real(dp), intent(in) :: pressure, height(:, :), seconds
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    type(verdict), intent(inout) :: theories
    logical, allocatable :: contact(:, :)
    real(dp) :: area, corrected, mean_gap, roughness

    allocate (contact(size(height, 1), size(height, 2)))
    contact = reshape(solution%force > 0.0_dp, shape(height))
    area = real(count(contact), dp)/real(size(contact), dp)
    corrected = area - (PI - 1.0_dp + log(2.0_dp))/24.0_dp*real(perimeter(contact), dp)/real(size(contact), dp)
    mean_gap = sum(solution%gap)/real(size(height), dp)
    roughness = sqrt(sum((height - sum(height)/size(height))**2)/real(size(height), dp))
    print '(f9.3,2f11.5,f11.4,f11.5,f21.4,i11,es11.1,f11.2)', pressure, area, corrected, corrected/pressure, &
      persson(pressure), mean_gap/roughness, info%products, info%residual, seconds
    write (file, '(3(es14.6,","),i0,",",es14.6)') pressure, area, corrected, info%products, seconds
    call theories%hold(is_between(pressure, corrected), 'the real area of contact')
  end subroutine write_load

  !> Persson's area; in light contact proportional to the load, kappa = sqrt(8/pi).
  pure function persson(pressure) result(area)
    real(dp), intent(in) :: pressure
    real(dp) :: area

    area = erf(sqrt(2.0_dp)*pressure)
  end function persson

  !> The area is between the two theories; Persson's is a little too small where the contact is not complete.
  pure function is_between(pressure, area)
    real(dp), intent(in) :: pressure, area
    logical :: is_between

    is_between = area >= 0.95_dp*persson(pressure) .and. area <= sqrt(2.0_dp*PI)*pressure
  end function is_between

  !> Pressures as rows of numbers, at most PLACES of them; each number is a mean over a square of cells.
  subroutine write_map(pressure)
    real(dp), intent(in) :: pressure(:, :)
    integer :: file, i, j, step

    step = max(1, size(pressure, 1)/PLACES)
    call create_file('surface_map.dat', 2, file)
    do j = 1, size(pressure, 2), step
      write (file, '(*(es10.3,1x))') &
        (sum(pressure(i:i + step - 1, j:j + step - 1))/step**2, i=1, size(pressure, 1), step)
    end do
    close (file)
  end subroutine write_map

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
    error stop 'the surface was not solved'
  end subroutine give_up

end program surface
