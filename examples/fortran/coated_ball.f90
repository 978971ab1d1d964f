!> A steel ball on a steel plate with a hard film: pressure, contact radius and approach over the thickness of the film,
!> and where the film would crack or come off.
!>
!>     coated_ball [cells [folder for its tables]]
!>
!> The grid has `cells` x `cells` squares, 256 unless given. Thin films leave Hertz's contact of the bare bodies, thick
!> ones give that of a ball on a plate of the film's material; a film of steel changes nothing at any thickness. Lengths
!> count in the contact radius a_H, pressures in the largest pressure p_H and approaches in the approach of the bare
!> bodies. One film is solved on rings too, by a matrix and the dense engine. Brittle films crack where the tension is
!> largest: at the surface in a ring around the contact, or at their bottom below its middle, where they bend. They come
!> off by the shear stress at the interface.
!> For the picture it writes coated_ball.csv.
program coated_ball
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_hertz_contact, fuge_hertz_ellipse, fuge_info, &
    fuge_interface_stress, fuge_layered_area_field, fuge_layered_body, fuge_layered_ring_matrix, &
    fuge_problem, fuge_solution, fuge_solve_dense, fuge_solver, FUGE_FREE
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm. Films of 1 to 4 times the modulus of steel: steel, a nitride, diamond-like carbon of the hardest kind.
  real(dp), parameter :: STEEL = 2.1e5_dp, POISSON = 0.3_dp, RADIUS = 10.0_dp, LOAD = 100.0_dp
  real(dp), parameter :: STIFFER(3) = [1.0_dp, 2.0_dp, 4.0_dp]
  !> Thicknesses over a_H: this many, from the thinnest to the thickest in equal ratios.
  integer, parameter :: FILMS = 17
  real(dp), parameter :: THINNEST = 1.0e-3_dp, THICKEST = 10.0_dp
  !> The grid ends this many radii a_H from the middle.
  real(dp), parameter :: COVERED = 1.1_dp
  !> The film that is solved on rings too, and the number of the rings.
  real(dp), parameter :: THICKNESS_ON_RINGS = 0.1_dp, STIFFER_ON_RINGS = 4.0_dp
  integer, parameter :: RINGS = 100

  !> What a solve finds, over Hertz's values of the bare bodies.
  type :: contact_of_ball
    real(dp) :: pressure = 0.0_dp, radius = 0.0_dp, approach = 0.0_dp
    integer :: products = 0
    !> Over p_H: the largest tension at the surface, and its distance from the axis over a_H; that at the bottom of the
    !> film, and the largest shear stress there; 0 where film and plate are one.
    real(dp) :: surface = 0.0_dp, place = 0.0_dp, bottom = 0.0_dp, shear = 0.0_dp
  end type contact_of_ball

  call run()

contains

  subroutine run()
    type(contact_of_ball) :: found(FILMS, size(STIFFER))
    type(verdict) :: known
    real(dp) :: thickness(FILMS)
    integer :: cells, i, j

    call read_cells(cells)
    thickness = [(THINNEST*(THICKEST/THINNEST)**(real(i - 1, dp)/(FILMS - 1)), i=1, FILMS)]
    do j = 1, size(STIFFER)
      print '(/,a,f4.1,a)', 'Film of', STIFFER(j), ' times the modulus of steel'
      print '(a)', '   h/a_H     p/p_H     a/a_H  approach  products   tension at r/a_H  at bottom     shear'
      do i = 1, FILMS
        call press(thickness(i), STIFFER(j), cells, found(i, j))
        if (modulo(i, 2) == 1) print '(f8.3,3f10.5,i10,2f10.4,2f10.4)', thickness(i), found(i, j)%pressure, &
          found(i, j)%radius, found(i, j)%approach, found(i, j)%products, found(i, j)%surface, found(i, j)%place, &
          found(i, j)%bottom, found(i, j)%shear
      end do
    end do
    call compare(found, known)
    call compare_rings(cells, known)
    call write_table(thickness, found)
    call known%give('against Hertz, and on squares as on rings')
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 256
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: coated_ball [cells [folder]]'
    if (cells < 64) error stop 'cells: at least 64'
  end subroutine read_cells

  !> Hertz's contact of the steel ball with a half-space of this many times the modulus of steel.
  function hertz_of(stiffer) result(hertz)
    real(dp), intent(in) :: stiffer
    type(fuge_hertz_contact) :: hertz
    type(fuge_info) :: info
    real(dp), parameter :: PLANE = STEEL/(1.0_dp - POISSON**2)

    call fuge_hertz_ellipse(RADIUS, RADIUS, PLANE/(1.0_dp + 1.0_dp/stiffer), LOAD, hertz, info)
    call require(info, 'Hertz')
  end function hertz_of

  !> The ball and the plate with its film; `thickness` over a_H.
  subroutine set_bodies(thickness, stiffer, bodies)
    real(dp), intent(in) :: thickness, stiffer
    type(fuge_layered_body), intent(out) :: bodies
    type(fuge_hertz_contact) :: bare
    type(fuge_info) :: info

    bare = hertz_of(1.0_dp)
    call bodies%set([thickness*bare%semi_axis_x], [stiffer*STEEL, STEEL], [POISSON, POISSON], info, &
                    e_star_other=STEEL/(1.0_dp - POISSON**2))
    call require(info, 'film')
  end subroutine set_bodies

  !> One contact on squares, by FFT.
  subroutine press(thickness, stiffer, cells, found)
    real(dp), intent(in) :: thickness, stiffer
    integer, intent(in) :: cells
    type(contact_of_ball), intent(out) :: found
    type(fuge_layered_body) :: bodies
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_hertz_contact) :: bare
    type(fuge_info) :: info
    real(dp) :: h, x(cells)
    integer :: i, j

    bare = hertz_of(1.0_dp)
    call set_bodies(thickness, stiffer, bodies)
    h = 2.0_dp*COVERED*bare%semi_axis_x/cells
    x = [((i - 0.5_dp*(cells + 1))*h, i=1, cells)]
    call operator%set(cells, cells, h, h, bodies%e_star(), info, body=bodies%surface())
    call require(info, 'grid')
    ! The gap is the mean over a square.
    problem%gap = [(((x(i)**2 + x(j)**2 + h**2/6.0_dp)/(2.0_dp*RADIUS), i=1, cells), j=1, cells)]
    problem%resultant = [LOAD]
    call solver%solve(operator, problem, solution, info)
    call require(info, 'contact')
    found%pressure = maxval(solution%force)/h**2/bare%peak_pressure
    found%approach = solution%motion(1)/bare%approach
    found%products = info%products
    ! The row of squares beside the axis x, from its middle on.
    i = cells*(cells/2)
    found%radius = radius_of(x(cells/2 + 1:)**2 + x(cells/2 + 1)**2, solution%force(i + cells/2 + 1:i + cells)) &
                   /bare%semi_axis_x
    call find_stresses(bodies, h, cells, solution%force, bare, found)
  end subroutine press

  !> The largest stresses of the surface and of the interface.
  subroutine find_stresses(bodies, h, cells, force, bare, found)
    type(fuge_layered_body), intent(in) :: bodies
    real(dp), intent(in) :: h, force(:)
    integer, intent(in) :: cells
    type(fuge_hertz_contact), intent(in) :: bare
    type(contact_of_ball), intent(inout) :: found
    type(fuge_layered_area_field) :: field
    type(fuge_interface_stress), allocatable :: peaks(:)
    type(fuge_info) :: info
    integer :: cell

    call field%set_grid(bodies, cells, cells, h, h, force, FUGE_FREE, info)
    call require(info, 'field')
    call field%interfaces(peaks, info)
    call require(info, 'stresses')
    found%surface = peaks(1)%tension_above/bare%peak_pressure
    cell = peaks(1)%cell_above - 1
    found%place = hypot(modulo(cell, cells) - 0.5_dp*(cells - 1), cell/cells - 0.5_dp*(cells - 1))*h/bare%semi_axis_x
    if (size(peaks) < 2) return
    found%bottom = peaks(2)%tension_above/bare%peak_pressure
    found%shear = peaks(2)%shear/bare%peak_pressure
  end subroutine find_stresses

  !> The contact radius, finer than the squares: near the edge the square of the pressure falls linearly with `r2`, the
  !> square of the distance from the axis. A straight line of least squares through some cells, without the last one,
  !> the least accurate.
  pure function radius_of(r2, force) result(radius)
    real(dp), intent(in) :: r2(:), force(:)
    real(dp) :: radius
    integer, parameter :: LINE = 5
    real(dp) :: x(LINE), y(LINE)
    integer :: last

    last = count(force > 0.0_dp) - 1
    x = r2(last - LINE + 1:last)
    y = force(last - LINE + 1:last)**2
    radius = sqrt((sum(x) - sum(y)*sum((x - sum(x)/LINE)**2)/sum((x - sum(x)/LINE)*y))/LINE)
  end function radius_of

  !> Films of steel, thin and thick films. The approach is not one of these limits: the steel below a thick film is
  !> part of it, by about a_H/h.
  subroutine compare(found, known)
    type(contact_of_ball), intent(in) :: found(:, :)
    type(verdict), intent(inout) :: known
    type(fuge_hertz_contact) :: bare, solid
    integer :: i, j

    bare = hertz_of(1.0_dp)
    do i = 1, FILMS
      call known%compare([found(i, 1)%pressure, found(i, 1)%radius, found(i, 1)%approach] - 1.0_dp, 1.0e-3_dp, &
                         'a film of steel')
      ! Hertz's tension around the contact (K. L. Johnson, Contact Mechanics, 1985, equation 3.47), which falls within
      ! a square.
      call known%compare(found(i, 1)%surface*3.0_dp/(1.0_dp - 2.0_dp*POISSON) - 1.0_dp, 0.1_dp, 'tension of steel')
      call known%compare(found(i, 1)%place - 1.0_dp, 0.03_dp, 'where steel is in tension')
    end do
    do j = 2, size(STIFFER)
      solid = hertz_of(STIFFER(j))
      associate (thin => found(1, j), thick => found(FILMS, j))
        call known%compare([thin%pressure, thin%radius, thin%approach] - 1.0_dp, 2.0e-3_dp, 'a thin film')
        call known%compare([thick%pressure*bare%peak_pressure/solid%peak_pressure, &
                            thick%radius*bare%semi_axis_x/solid%semi_axis_x] - 1.0_dp, 2.0e-3_dp, 'a thick film')
      end associate
    end do
  end subroutine compare

  !> One film on rings.
  subroutine compare_rings(cells, known)
    integer, intent(in) :: cells
    type(verdict), intent(inout) :: known
    type(contact_of_ball) :: on_squares
    type(fuge_layered_body) :: bodies
    type(fuge_hertz_contact) :: bare
    type(fuge_info) :: info
    real(dp), allocatable, target :: alpha(:, :)
    real(dp), dimension(RINGS) :: force, gap, open
    real(dp) :: approach, edge(RINGS + 1), pressure
    integer :: k

    allocate (alpha(RINGS, RINGS))
    bare = hertz_of(1.0_dp)
    call press(THICKNESS_ON_RINGS, STIFFER_ON_RINGS, cells, on_squares)
    call set_bodies(THICKNESS_ON_RINGS, STIFFER_ON_RINGS, bodies)
    edge = [(COVERED*bare%semi_axis_x*(k - 1)/RINGS, k=1, RINGS + 1)]
    call fuge_layered_ring_matrix(bodies, edge, alpha, info)
    call require(info, 'matrix of rings')
    ! The gap of a ring is the mean of r**2/(2 R) over its area.
    gap = (edge(2:)**2 + edge(:RINGS)**2)/(4.0_dp*RADIUS)
    call fuge_solve_dense(alpha, gap, LOAD, force, open, approach, info)
    call require(info, 'contact on rings')
    pressure = maxval(force/(PI*(edge(2:)**2 - edge(:RINGS)**2)))/bare%peak_pressure
    approach = approach/bare%approach
    print '(/,2(a,f9.5),2(a,f9.6))', 'Pressure on squares ', on_squares%pressure, ', on rings', pressure, &
      '; approach', on_squares%approach, ' and', approach
    call known%compare(on_squares%pressure/pressure - 1.0_dp, 1.0e-3_dp, 'the pressure on squares')
    call known%compare(on_squares%approach/approach - 1.0_dp, 1.0e-4_dp, 'the approach on squares')
  end subroutine compare_rings

  subroutine write_table(thickness, found)
    real(dp), intent(in) :: thickness(:)
    type(contact_of_ball), intent(in) :: found(:, :)
    integer :: file, i, j

    call create_file('coated_ball.csv', 2, file)
    write (file, '(a)') 'thickness,pressure_1,radius_1,approach_1,pressure_2,radius_2,approach_2,' &
      //'pressure_3,radius_3,approach_3,surface_1,bottom_1,shear_1,surface_2,bottom_2,shear_2,surface_3,bottom_3,' &
      //'shear_3'
    do i = 1, size(thickness)
      write (file, '(*(es14.6,:,","))') thickness(i), &
        (found(i, j)%pressure, found(i, j)%radius, found(i, j)%approach, j=1, size(STIFFER)), &
        (found(i, j)%surface, found(i, j)%bottom, found(i, j)%shear, j=1, size(STIFFER))
    end do
    close (file)
  end subroutine write_table

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (info%status == 0) return
    print '(3a)', what, ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program coated_ball
