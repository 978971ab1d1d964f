!> Which punch has left this contact area? Its shape, from the loads and which cells touched, by least squares.
!>
!>     punch_from_area [cells along each side of the area]
!>
!> The measured areas are those of an ellipsoid with the radii 24 mm and 8 mm, turned and off the middle, under three
!> loads; they are computed on cells a third as wide, of which most of nine decide whether a measured cell touched. No
!> pressure is known. Residuals are the pressure where a cell was open, and the gap under load where it touched; where
!> the contact agrees with the measured one, both are zero. The search begins with a ball that leaves an area of the
!> measured size under the largest load.
!>
!> Known: the punch. How well it can be found depends on the cells, which do not tell where between their centres the
!> edge of the contact is. So errors of the radii are shown as those of the semi-axes by Hertz, and all errors in widths
!> of a cell.
program punch_from_area
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_hertz_contact, fuge_hertz_ellipse, fuge_info, &
    fuge_problem, fuge_solution, fuge_solver, FUGE_FREE, FUGE_MEAN
  use profile_fit, only: fit_contact, fit_result, fit_rules, fitted_case
  use punch_ellipsoid, only: cell_centres, ellipsoid, parameters_of, punch_of, punch_values
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm: steel on steel, and the side of the measured square.
  real(dp), parameter :: E_STAR = 1.15e5_dp, LOADS(3) = [30.0_dp, 60.0_dp, 120.0_dp], SIDE = 0.8_dp
  type(punch_values), parameter :: TRUE_PUNCH = punch_values(radius=[24.0_dp, 8.0_dp], angle=0.6_dp, &
                                                             apex=[0.021_dp, -0.034_dp])
  !> Each cell is divided into so many along each side to make the measured areas.
  integer, parameter :: PARTS = 3
  !> A sum of squares over that of the ball: less is in the rounding of the areas to cells.
  real(dp), parameter :: NEGLIGIBLE = 1.0e-8_dp
  !> Widths of a cell.
  real(dp), parameter :: ALLOWED = 0.25_dp

  call run()

contains

  subroutine run()
    type(fuge_halfspace_operator) :: operator
    type(ellipsoid) :: shape
    type(fit_result) :: fit
    type(fit_rules) :: rules
    type(fitted_case) :: cases(size(LOADS))
    type(fuge_info) :: info
    logical, allocatable :: touched(:, :)
    real(dp) :: ball, start(5), width
    integer :: cells, k

    call read_cells(cells)
    width = SIDE/real(cells, dp)
    allocate (touched(cells**2, size(LOADS)))
    call measure(cells, touched)
    call cell_centres(cells, width, shape%x, shape%y)
    ! The radius of the ball that leaves the largest area, and the radius of that.
    shape%length = width*sqrt(count(touched(:, size(LOADS)))/PI)
    ball = 4.0_dp*E_STAR*shape%length**3/(3.0_dp*LOADS(size(LOADS)))
    shape%curvature = 1.0_dp/ball
    start = [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp]
    do k = 1, size(LOADS)
      call want_area(touched(:, k), LOADS(k), width, cases(k))
    end do
    call operator%set(cells, cells, width, width, E_STAR, info, element=FUGE_MEAN, boundary=FUGE_FREE)
    call require(info)
    rules%negligible = NEGLIGIBLE
    call fit_contact(shape, operator, cases, rules, start, fit, info)
    call require(info)
    print '(3(a,i0),a)', 'Areas under ', size(LOADS), ' loads, ', cells, ' x ', cells, ' cells'
    print '(a)', 'load [N]   cells that touched   that do not agree'
    do k = 1, size(LOADS)
      print '(f8.0,i21,i20)', LOADS(k), count(touched(:, k)), &
        count((fit%solution(k)%force > 0.0_dp) .neqv. touched(:, k))
    end do
    call compare(punch_of(shape, fit%parameter), ball, width, fit, touched)
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 64
    call get_command_argument(1, argument)
    if (argument == '') return
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: punch_from_area [cells]'
    if (cells < 24) error stop 'cells: at least 24'
  end subroutine read_cells

  !> Which cells touch under each load, (n, loads), from a finer grid.
  subroutine measure(cells, touched)
    integer, intent(in) :: cells
    logical, intent(out) :: touched(:, :)
    type(ellipsoid) :: shape
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp), allocatable :: by_parameter(:, :)
    integer :: fine, k, touching(PARTS, cells, PARTS, cells)

    fine = PARTS*cells
    call cell_centres(fine, SIDE/real(fine, dp), shape%x, shape%y)
    call operator%set(fine, fine, SIDE/real(fine, dp), SIDE/real(fine, dp), E_STAR, info, element=FUGE_MEAN, &
                      boundary=FUGE_FREE)
    call require(info)
    allocate (problem%gap(fine**2), by_parameter(fine**2, 5))
    call shape%set_gap(parameters_of(shape, TRUE_PUNCH), problem%gap, by_parameter)
    do k = 1, size(LOADS)
      problem%resultant = LOADS(k:k)
      call solver%solve(operator, problem, solution, info)
      call require(info)
      touching = reshape(merge(1, 0, solution%force > 0.0_dp), [PARTS, cells, PARTS, cells])
      touched(:, k) = reshape(2*sum(sum(touching, 3), 1) > PARTS**2, [cells**2])
    end do
  end subroutine measure

  !> No pressure where no cell touched, and no gap where one did: over the mean pressure, and over what a cell alone
  !> yields under that.
  pure subroutine want_area(touched, load, width, one)
    logical, intent(in) :: touched(:)
    real(dp), intent(in) :: load, width
    type(fitted_case), intent(out) :: one
    real(dp) :: mean_force

    mean_force = load/real(count(touched), dp)
    one%problem%resultant = [load]
    one%by_force = merge(0.0_dp, 1.0_dp/mean_force, touched)
    one%by_gap = merge(E_STAR*width/mean_force, 0.0_dp, touched)
    one%wanted = spread(0.0_dp, 1, size(touched))
  end subroutine want_area

  !> The punch that was found beside the true one.
  subroutine compare(found, ball, width, fit, touched)
    type(punch_values), intent(in) :: found
    real(dp), intent(in) :: ball, width
    type(fit_result), intent(in) :: fit
    logical, intent(in) :: touched(:, :)
    type(verdict) :: known
    real(dp) :: axes(2), error(5), true_axes(2)
    integer :: k

    axes = semi_axes(found%radius)
    true_axes = semi_axes(TRUE_PUNCH%radius)
    ! An angle moves the edge by as much as the semi-axes differ, times it.
    error = [axes - true_axes, (found%angle - TRUE_PUNCH%angle)*(true_axes(1) - true_axes(2)), &
             found%apex - TRUE_PUNCH%apex]/width
    print '(/,a)', '                         true     start     found   error of the edge [widths of a cell]'
    call print_line('larger radius [mm]', TRUE_PUNCH%radius(1), ball, found%radius(1), error(1))
    call print_line('smaller radius [mm]', TRUE_PUNCH%radius(2), ball, found%radius(2), error(2))
    call print_line('angle [degrees]', TRUE_PUNCH%angle*180.0_dp/PI, 0.0_dp, found%angle*180.0_dp/PI, error(3))
    call print_line('apex, x [mm]', TRUE_PUNCH%apex(1), 0.0_dp, found%apex(1), error(4))
    call print_line('apex, y [mm]', TRUE_PUNCH%apex(2), 0.0_dp, found%apex(2), error(5))
    print '(/,2(a,i0),a,es8.1)', 'Solves of each load: ', fit%solves, ', derivatives of all loads: ', fit%derivatives, &
      '; sum of squares over that at the start', fit%last_sum/fit%first_sum
    call known%compare(error, ALLOWED, 'the edge of the contact')
    call known%hold(fit%solves < 20, 'fewer than 20 solves')
    do k = 1, size(LOADS)
      call known%hold(count((fit%solution(k)%force > 0.0_dp) .neqv. touched(:, k)) <= count(touched(:, k))/50, &
                      'the measured area')
    end do
    call known%give('within a quarter of a cell of the true edge')
  end subroutine compare

  !> The semi-axes of the contact of such a punch under the largest load, mm.
  function semi_axes(radius) result(axes)
    real(dp), intent(in) :: radius(2)
    real(dp) :: axes(2)
    type(fuge_hertz_contact) :: hertz
    type(fuge_info) :: info

    call fuge_hertz_ellipse(radius(1), radius(2), E_STAR, LOADS(size(LOADS)), hertz, info)
    call require(info)
    axes = [hertz%semi_axis_x, hertz%semi_axis_y]
  end function semi_axes

  subroutine print_line(name, true, start, found, error)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: true, start, found, error
    character(len=19) :: padded

    padded = name
    print '(a,3f10.4,f16.3)', padded, true, start, found, error
  end subroutine print_line

  subroutine require(info)
    type(fuge_info), intent(in) :: info

    if (.not. info%failed()) return
    print '(a)', trim(info%message)
    error stop 'the contact was not solved'
  end subroutine require

end program punch_from_area
