!> A ball, and a barrel, pressed on a plane: an area of contact against Hertz.
!>
!> The gap is x**2/(2 R_x) + y**2/(2 R_y). A quarter of the surface is modelled, x >= 0 and y >= 0, with n x n
!> rectangles that cover a little more than the contact. The semi-axes follow from the second moments of the forces:
!> for the pressure of Hertz the mean of x**2 is a**2/5. All values are compared with the closed form of
!> `fuge_hertz_ellipse`.
program ball
  use fuge, only: dp => fuge_dp, fuge_halfspace_matrix, fuge_hertz_contact, fuge_hertz_ellipse, fuge_info, &
    fuge_solve_dense, FUGE_CENTRE, FUGE_MEAN
  implicit none

  !> N, mm: steel on steel.
  real(dp), parameter :: E_STAR = 1.15e5_dp, LOAD = 100.0_dp
  !> The model ends this many semi-axes from the middle.
  real(dp), parameter :: COVERED = 1.2_dp
  integer, parameter :: SIZES(3) = [10, 20, 40]

  call press('Ball, R = 10 mm', 10.0_dp, 10.0_dp)
  call press('Barrel, R_x = 10 mm, R_y = 200 mm', 10.0_dp, 200.0_dp)

contains

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
    print '(a)', 'element  cells    a [mm]    error      b [mm]    error      approach [mm] error    pressure, error'
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
    print '(a,i4,a,i2,3(f12.6,es10.1),es15.1)', merge('centre ', 'mean   ', element == FUGE_CENTRE), n, ' x ', n, &
      a, error(1), b, error(2), approach, error(3), error(4)
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

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (info%status == 0) return
    print '(3a)', what, ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program ball
