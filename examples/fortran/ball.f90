!> A ball, and a barrel, pressed on a plane: an area of contact against Hertz.
!>
!>     ball [cells [folder for its tables]]
!>
!> The gap is x**2/(2 R_x) + y**2/(2 R_y). First the matrix of a small model: a quarter of the surface, x >= 0 and
!> y >= 0, with n x n rectangles that cover a little more than the contact. Then the whole surface as a grid of `cells`
!> x `cells`, 512 unless given, by FFT. The semi-axes follow from the second moments of the forces: for the pressure of
!> Hertz the mean of x**2 is a**2/5. All values are compared with the closed form of `fuge_hertz_ellipse`.
!> For the picture it writes ball_axis.csv and ball_map.dat, that of the barrel.
program ball
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_matrix, fuge_halfspace_operator, fuge_hertz_contact, &
    fuge_hertz_ellipse, fuge_info, fuge_problem, fuge_solution, fuge_solve_dense, fuge_solver, FUGE_CENTRE, FUGE_FREE, &
    FUGE_MEAN
  implicit none

  !> N, mm: steel on steel.
  real(dp), parameter :: E_STAR = 1.15e5_dp, LOAD = 100.0_dp
  !> The model ends this many semi-axes from the middle.
  real(dp), parameter :: COVERED = 1.2_dp
  integer, parameter :: SIZES(3) = [10, 20, 40]
  !> The picture of the pressure has about this many cells in each direction.
  integer, parameter :: SHOWN = 256

  call run()

contains

  subroutine run()
    type(verdict) :: hertz
    integer :: cells, axis, map

    call read_cells(cells)
    call press('Ball, R = 10 mm', 10.0_dp, 10.0_dp)
    call press('Barrel, R_x = 10 mm, R_y = 200 mm', 10.0_dp, 200.0_dp)
    call create_file('ball_axis.csv', 2, axis)
    call create_file('ball_map.dat', 2, map)
    write (axis, '(a)') 'x,pressure,hertz'
    print '(/,a,i0,a,i0,a)', 'Grids of ', cells, ' x ', cells, ' cells by FFT, pressure in GPa:'
    print '(a8,2(a12,a9),a15,a9,a10,a9,a10)', '', 'a [mm]', 'error', 'b [mm]', 'error', 'approach [mm]', 'error', &
      'pressure', 'error', 'products'
    call press_grid('Ball', cells, 10.0_dp, 10.0_dp, hertz, axis_file=axis)
    call press_grid('Barrel', cells, 10.0_dp, 200.0_dp, hertz, map_file=map)
    close (axis)
    close (map)
    call hertz%give('against Hertz')
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 512
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: ball [cells [folder]]'
    if (cells < 16) error stop 'cells: at least 16'
  end subroutine read_cells

  !> Both elements on finer and finer grids.
  subroutine press(title, radius_x, radius_y)
    character(len=*), intent(in) :: title
    real(dp), intent(in) :: radius_x, radius_y
    type(fuge_hertz_contact) :: hertz
    type(fuge_info) :: info
    integer :: k

    call fuge_hertz_ellipse(radius_x, radius_y, E_STAR, LOAD, hertz, info)
    call require(info, 'Hertz')
    print '(/,a)', title
    print '(4(a,f9.6))', 'Hertz: semi-axes ', hertz%semi_axis_x, ' and ', hertz%semi_axis_y, ' mm, approach ', &
      hertz%approach, ' mm, pressure [GPa] ', 1.0e-3_dp*hertz%peak_pressure
    print '(a,2(a12,a10),a14,a10,a17)', 'element    cells', 'a [mm]', 'error', 'b [mm]', 'error', 'approach [mm]', &
      'error', 'pressure, error'
    do k = 1, size(SIZES)
      call solve(SIZES(k), FUGE_CENTRE, radius_x, radius_y, hertz)
    end do
    do k = 1, size(SIZES)
      call solve(SIZES(k), FUGE_MEAN, radius_x, radius_y, hertz)
    end do
  end subroutine press

  !> One grid of n x n rectangles, and its line in the table.
  subroutine solve(n, element, radius_x, radius_y, hertz)
    integer, intent(in) :: n, element
    real(dp), intent(in) :: radius_x, radius_y
    type(fuge_hertz_contact), intent(in) :: hertz
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), allocatable :: x(:), y(:), width_x(:), width_y(:), gap(:), force(:), open(:)
    real(dp) :: h_x, h_y, approach, error(4), a, b
    type(fuge_info) :: info
    integer :: i, j

    allocate (alpha(n*n, n*n), force(n*n), open(n*n))
    h_x = COVERED*hertz%semi_axis_x/n
    h_y = COVERED*hertz%semi_axis_y/n
    x = [(((i - 0.5_dp)*h_x, i=1, n), j=1, n)]
    y = [(((j - 0.5_dp)*h_y, i=1, n), j=1, n)]
    width_x = spread(h_x, 1, n*n)
    width_y = spread(h_y, 1, n*n)
    gap = x**2/(2.0_dp*radius_x) + y**2/(2.0_dp*radius_y)
    ! The mean of the gap over a rectangle.
    if (element == FUGE_MEAN) gap = gap + h_x**2/(24.0_dp*radius_x) + h_y**2/(24.0_dp*radius_y)
    call fuge_halfspace_matrix(x, y, width_x, width_y, E_STAR, element, alpha, info, symmetric_x=.true., &
                               symmetric_y=.true.)
    call require(info, 'matrix')
    call fuge_solve_dense(alpha, gap, LOAD, force, open, approach, info)
    call require(info, 'contact')

    a = sqrt(5.0_dp*sum(force*(x**2 + h_x**2/12.0_dp))/LOAD)
    b = sqrt(5.0_dp*sum(force*(y**2 + h_y**2/12.0_dp))/LOAD)
    ! A force is that of a rectangle and its three images.
    error = [a/hertz%semi_axis_x - 1.0_dp, b/hertz%semi_axis_y - 1.0_dp, approach/hertz%approach - 1.0_dp, &
             pressure_error(force/(4.0_dp*h_x*h_y), x, y, hertz)]
    print '(a,i4,a,i2,2(f12.6,es10.1),f14.6,es10.1,es17.1)', &
      merge('centre ', 'mean   ', element == FUGE_CENTRE), n, ' x ', n, a, &
      error(1), b, error(2), approach, error(3), error(4)
    ! Between one and five times what is observed.
    if (any(abs(error) > [0.05_dp, 0.05_dp, 0.02_dp, 2.0_dp]/real(n, dp)**1.5_dp)) error stop 'far from Hertz'
  end subroutine solve

  !> The largest difference from the pressure of Hertz, over its maximum, up to nine tenths of the semi-axes.
  function pressure_error(pressure, x, y, hertz) result(error)
    real(dp), intent(in) :: pressure(:), x(:), y(:)
    type(fuge_hertz_contact), intent(in) :: hertz
    real(dp) :: error
    logical :: inside(size(x))

    inside = hypot(x/hertz%semi_axis_x, y/hertz%semi_axis_y) < 0.9_dp
    error = maxval(abs(pressure - hertz%pressure(x, y)), mask=inside)/hertz%peak_pressure
  end function pressure_error

  !> The whole surface, by products: no matrix, and no symmetry needed.
  subroutine press_grid(title, n, radius_x, radius_y, known, axis_file, map_file)
    character(len=*), intent(in) :: title
    integer, intent(in) :: n
    real(dp), intent(in) :: radius_x, radius_y
    type(verdict), intent(inout) :: known
    integer, intent(in), optional :: axis_file, map_file
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_hertz_contact) :: hertz
    type(fuge_info) :: info
    real(dp) :: x(n), y(n), h_x, h_y
    integer :: i, j

    call fuge_hertz_ellipse(radius_x, radius_y, E_STAR, LOAD, hertz, info)
    call require(info, 'Hertz')
    h_x = 2.0_dp*COVERED*hertz%semi_axis_x/n
    h_y = 2.0_dp*COVERED*hertz%semi_axis_y/n
    x = [((i - 0.5_dp*(n + 1))*h_x, i=1, n)]
    y = [((j - 0.5_dp*(n + 1))*h_y, j=1, n)]
    call operator%set(n, n, h_x, h_y, E_STAR, info, element=FUGE_MEAN, boundary=FUGE_FREE)
    call require(info, 'grid')
    ! Point i + n*(j - 1) is the cell i, j; the gap is the mean over the cell.
    allocate (problem%gap(n*n))
    do j = 1, n
      problem%gap((j - 1)*n + 1:j*n) = (x**2 + h_x**2/12.0_dp)/(2.0_dp*radius_x) &
                                       + (y(j)**2 + h_y**2/12.0_dp)/(2.0_dp*radius_y)
    end do
    problem%resultant = [LOAD]
    call solver%solve(operator, problem, solution, info)
    call require(info, 'contact')
    call compare(title, reshape(solution%force, [n, n]), solution%motion(1), x, y, hertz, info%products, &
                 known)
    if (present(axis_file)) &
      call write_axis(axis_file, x, y(n/2), solution%force((n/2 - 1)*n + 1:n/2*n)/(h_x*h_y), hertz)
    if (present(map_file)) call write_map(map_file, x, y, reshape(solution%force, [n, n])/(h_x*h_y))
  end subroutine press_grid

  !> The line of a grid in the table.
  subroutine compare(title, force, approach, x, y, hertz, products, known)
    character(len=*), intent(in) :: title
    real(dp), intent(in) :: force(:, :), approach, x(:), y(:)
    type(fuge_hertz_contact), intent(in) :: hertz
    integer, intent(in) :: products
    type(verdict), intent(inout) :: known
    real(dp) :: h_x, h_y, a, b, pressure, error(4)

    h_x = x(2) - x(1)
    h_y = y(2) - y(1)
    a = sqrt(5.0_dp*dot_product(sum(force, 2), x**2 + h_x**2/12.0_dp)/LOAD)
    b = sqrt(5.0_dp*dot_product(sum(force, 1), y**2 + h_y**2/12.0_dp)/LOAD)
    pressure = maxval(force)/(h_x*h_y)
    error = [a/hertz%semi_axis_x, b/hertz%semi_axis_y, approach/hertz%approach, pressure/hertz%peak_pressure] - 1.0_dp
    print '(a8,2(f12.6,es9.1),f15.7,es9.1,f10.5,es9.1,i10)', title, a, error(1), b, error(2), approach, error(3), &
      1.0e-3_dp*pressure, error(4), products
    ! Between two and ten times what is observed.
    call known%compare(error(:3), 1.0_dp/real(size(x), dp)**1.5_dp, 'a semi-axis or the approach')
    call known%compare(error(4), 2.0_dp/real(size(x), dp)**1.5_dp, 'the largest pressure')
  end subroutine compare

  !> Pressure along x, beside that of Hertz.
  subroutine write_axis(file, x, y, pressure, hertz)
    integer, intent(in) :: file
    real(dp), intent(in) :: x(:), y, pressure(:)
    type(fuge_hertz_contact), intent(in) :: hertz
    integer :: i

    do i = 1, size(x)
      write (file, '(2(es14.6,","),es14.6)') x(i), pressure(i), hertz%pressure(x(i), y)
    end do
  end subroutine write_axis

  !> x, y and pressure of cells at equal steps.
  subroutine write_map(file, x, y, pressure)
    integer, intent(in) :: file
    real(dp), intent(in) :: x(:), y(:), pressure(:, :)
    integer :: i, j, stride

    stride = max(1, size(x)/SHOWN)
    do j = 1, size(y), stride
      do i = 1, size(x), stride
        write (file, '(2es14.6,es12.4)') x(i), y(j), pressure(i, j)
      end do
    end do
  end subroutine write_map

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (info%status == 0) return
    print '(3a)', what, ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program ball
