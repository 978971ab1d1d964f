!> Stresses below a ball and a barrel, for the example `stress`.
!>
!> Units are the longer semi-axis of the contact and p_0; E* is 1, and Poisson's ratio 0.3.
module stress_areas
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_field, fuge_halfspace_field, fuge_halfspace_matrix, fuge_hertz_contact, &
    fuge_hertz_ellipse, fuge_info, fuge_power_profile, fuge_ring_matrix, fuge_rings_field, fuge_round_contact, &
    fuge_round_punch_field, fuge_solve_dense, fuge_solve_round_punch, fuge_stress_peak, fuge_von_mises, FUGE_MEAN, &
    FUGE_MEASURE_TRESCA, FUGE_MEASURE_VON_MISES
  use stress_known, only: hertz_axis_stress, known_peaks
  use stress_maps, only: picture, require, write_halves, write_map, FOLDER_ARGUMENT
  implicit none
  private

  public :: press_ball_and_barrel

  real(dp), parameter :: PI = acos(-1.0_dp), POISSON = 0.3_dp, YOUNG = 1.0_dp - POISSON**2
  !> Rectangles along each axis of a quarter of the surface, and the semi-axes that they cover.
  integer, parameter :: RECTANGLES = 24, RINGS = 100
  real(dp), parameter :: COVERED = 1.1_dp
  !> Whether the largest shear or the largest von Mises stress is asked for.
  integer, parameter :: MEASURES(2) = [FUGE_MEASURE_TRESCA, FUGE_MEASURE_VON_MISES]

contains

  subroutine press_ball_and_barrel(known)
    type(verdict), intent(inout) :: known
    type(fuge_hertz_contact) :: ball, barrel
    type(fuge_halfspace_field) :: below_cells
    type(fuge_round_punch_field) :: below_punch
    type(fuge_info) :: info

    ! The ball's contact has the radius 1 and p_0 = 1.
    call fuge_hertz_ellipse(2.0_dp/PI, 2.0_dp/PI, 1.0_dp, 2.0_dp*PI/3.0_dp, ball, info)
    call require(info)
    print '(/,a)', 'Largest stresses below a ball and a barrel, over p_0, Poisson''s ratio 0.3'
    print '(a20,2(a12,a9,a10))', '', 'shear', 'at z/a', 'error', 'von Mises', 'at z/a', 'error'
    call print_known('ball, closed form', ball)
    call press_round_ball(ball, below_punch, known)
    call press_rings(ball, known)
    call press_quarter(2.0_dp/PI, 2.0_dp/PI, ball, below_cells, known)
    call draw_ball(below_cells, below_punch)
    call write_axis(below_punch, known)
    call fuge_hertz_ellipse(1.0_dp, 0.25_dp, 1.0_dp, 1.0_dp, barrel, info)
    call require(info)
    print '(a,f7.4)', 'b/a =', barrel%semi_axis_y/barrel%semi_axis_x
    call print_known('barrel, closed form', barrel)
    call press_quarter(1.0_dp, 0.25_dp, barrel, below_cells, known)
  end subroutine press_ball_and_barrel

  subroutine print_known(name, hertz)
    character(len=*), intent(in) :: name
    type(fuge_hertz_contact), intent(in) :: hertz
    real(dp) :: value(2), depth(2)

    call known_peaks(hertz%semi_axis_y/hertz%semi_axis_x, POISSON, value, depth)
    print '(a20,2(f12.7,f9.5,10x))', name, value(1), depth(1), value(2), depth(2)
  end subroutine print_known

  !> A line of the table: the largest shear and the largest von Mises stress, in the caller's units.
  subroutine print_peaks(name, field, hertz, tolerance, known)
    character(len=*), intent(in) :: name
    class(fuge_field), intent(in) :: field
    type(fuge_hertz_contact), intent(in) :: hertz
    real(dp), intent(in) :: tolerance
    type(verdict), intent(inout) :: known
    type(fuge_stress_peak) :: peaks(2)
    type(fuge_info) :: info
    real(dp) :: value(2), depth(2), found(2)
    integer :: k

    do k = 1, 2
      call field%largest(MEASURES(k), peaks(k), info)
      call require(info)
    end do
    call known_peaks(hertz%semi_axis_y/hertz%semi_axis_x, POISSON, value, depth)
    found = [0.5_dp, 1.0_dp]*peaks%value/hertz%peak_pressure
    print '(a20,2(f12.7,f9.5,es10.1))', name, &
      (found(k), peaks(k)%place(3)/hertz%semi_axis_x, found(k)/value(k) - 1.0_dp, k=1, 2)
    call known%compare(found/value - 1.0_dp, tolerance, 'the largest stresses below a ball or a barrel')
  end subroutine print_peaks

  subroutine press_round_ball(hertz, field, known)
    type(fuge_hertz_contact), intent(in) :: hertz
    type(fuge_round_punch_field), intent(out) :: field
    type(verdict), intent(inout) :: known
    type(fuge_power_profile) :: profile
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info

    profile%upper = 2.0_dp
    profile%coefficients = [0.25_dp*PI]
    profile%powers = [2.0_dp]
    call fuge_solve_round_punch(profile, 1.0_dp, contact, info, load=2.0_dp*PI/3.0_dp)
    call require(info)
    call field%set(contact, YOUNG, POISSON, info)
    call require(info)
    call print_peaks('without a grid', field, hertz, 1.0e-9_dp, known)
  end subroutine press_round_ball

  subroutine press_rings(hertz, known)
    type(fuge_hertz_contact), intent(in) :: hertz
    type(verdict), intent(inout) :: known
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: radius(0:RINGS), force(RINGS), gap(RINGS), approach
    type(fuge_rings_field) :: field
    type(fuge_info) :: info
    integer :: k

    allocate (alpha(RINGS, RINGS))
    radius = [(COVERED*k/RINGS, k=0, RINGS)]
    call fuge_ring_matrix(radius, 1.0_dp, FUGE_MEAN, alpha, info)
    call require(info)
    call fuge_solve_dense(alpha, 0.125_dp*PI*(radius(1:)**2 + radius(:RINGS - 1)**2), 2.0_dp*PI/3.0_dp, force, gap, &
                          approach, info)
    call require(info)
    call field%set(radius, force, YOUNG, POISSON, info)
    call require(info)
    call print_peaks('100 rings', field, hertz, 1.0e-3_dp, known)
  end subroutine press_rings

  !> Any two radii of curvature, on rectangles of a quarter of the surface.
  subroutine press_quarter(radius_x, radius_y, hertz, field, known)
    real(dp), intent(in) :: radius_x, radius_y
    type(fuge_hertz_contact), intent(in) :: hertz
    type(fuge_halfspace_field), intent(out) :: field
    type(verdict), intent(inout) :: known
    integer, parameter :: N = RECTANGLES**2
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), dimension(N) :: x, y, width_x, width_y, gap, force, open
    real(dp) :: approach, load
    type(fuge_info) :: info
    integer :: i, j

    allocate (alpha(N, N))
    width_x = COVERED*hertz%semi_axis_x/RECTANGLES
    width_y = COVERED*hertz%semi_axis_y/RECTANGLES
    x = [(((i - 0.5_dp)*width_x(1), i=1, RECTANGLES), j=1, RECTANGLES)]
    y = [(((j - 0.5_dp)*width_y(1), i=1, RECTANGLES), j=1, RECTANGLES)]
    ! The mean over a rectangle, up to a constant.
    gap = x**2/(2.0_dp*radius_x) + y**2/(2.0_dp*radius_y)
    load = 2.0_dp*PI/3.0_dp*hertz%semi_axis_x*hertz%semi_axis_y*hertz%peak_pressure
    call fuge_halfspace_matrix(x, y, width_x, width_y, 1.0_dp, FUGE_MEAN, alpha, info, symmetric_x=.true., &
                               symmetric_y=.true.)
    call require(info)
    call fuge_solve_dense(alpha, gap, load, force, open, approach, info)
    call require(info)
    call field%set_rectangles(x, y, width_x, width_y, force, YOUNG, POISSON, info, symmetric_x=.true., &
                              symmetric_y=.true.)
    call require(info)
    call print_peaks('48 x 48 rectangles', field, hertz, 5.0e-3_dp, known)
  end subroutine press_quarter

  !> Below the ball in the plane y = 0: the shear in that plane, for x < 0 below the rectangles, for x > 0 without a
  !> grid, and the von Mises stress.
  subroutine draw_ball(below_cells, below_punch)
    type(fuge_halfspace_field), intent(in) :: below_cells
    type(fuge_round_punch_field), intent(in) :: below_punch
    type(picture), parameter :: HALF = picture(0.0_dp, 2.0_dp, 2.0_dp, 160, 160)
    real(dp), allocatable :: tensor(:, :)
    type(fuge_info) :: info

    call write_halves('stress_ball.dat', below_cells, below_punch, HALF)
    allocate (tensor(6, HALF%columns*HALF%rows))
    call below_punch%stress(HALF%places(), tensor, info)
    call require(info)
    call write_map('stress_ball_mises.dat', fuge_von_mises(tensor), HALF%columns)
  end subroutine draw_ball

  !> The stresses on the axis of the ball, computed and known.
  subroutine write_axis(field, known)
    type(fuge_round_punch_field), intent(in) :: field
    type(verdict), intent(inout) :: known
    integer, parameter :: POINTS = 31
    real(dp) :: place(3, POINTS), tensor(6, POINTS), exact(3)
    type(fuge_info) :: info
    integer :: file, k

    place = 0.0_dp
    place(3, :) = [(0.1_dp*(k - 1), k=1, POINTS)]
    call field%stress(place, tensor, info)
    call require(info)
    call create_file('stress_axis.csv', FOLDER_ARGUMENT, file)
    write (file, '(a)') 'z/a,rr,zz,rr known,zz known'
    do k = 1, POINTS
      exact = hertz_axis_stress(1.0_dp, POISSON, place(3, k))
      write (file, '(f6.3,4('','',f12.8))') place(3, k), tensor(1, k), tensor(3, k), exact(1), exact(3)
      call known%hold(all(abs(tensor(:3, k) - exact) <= 1.0e-12_dp), 'the stresses on the axis of a ball')
    end do
    close (file)
  end subroutine write_axis

end module stress_areas
