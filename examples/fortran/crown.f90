!> Which crown of a roller makes its pressure even? A logarithm, and a free profile, found by least squares.
!>
!>     crown [rows of cells on the roller [folder for its tables]]
!>
!> The roller of the example `roller`: steel on steel, radius 10 mm, length 20 mm, 10 kN; 320 rows of cells unless
!> given, an even number. Profiles along the axis y are -h ln(1 - k (2y/L)**2), with h and k to be found, and 24 cubic
!> B-splines that must not stand out. Wanted is Hertz's largest pressure of a roller without ends, in each row of cells.
!> Hertz's pressure in each single cell is a worse wish: near the ends the contact is narrower, and to carry as much as
!> elsewhere it would need more pressure on its axis.
!>
!> Known: h = F/(pi E* L) and k = 1 - 0.3033 (2b/L) with the half width b, by G. Lundberg (1939), K. L. Johnson and
!> R. Gohar (1981). Their formula looks at displacements on the axis only, and leaves an eighth too much near the ends.
!> With 1.2 times this h, as in the example `roller`, the pressure is hardly too high, but the very ends carry less; the
!> h that is found lies between. For the picture it writes crown.csv.
program crown
  use crown_profiles, only: crown_grid, free_crown, logarithmic_crown, lundberg, set_grid, set_splines, E_STAR, &
    HALF_WIDTH, LINE_PRESSURE, LOAD, LUNDBERG_FACTOR
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_solution, fuge_solver, FUGE_FREE, FUGE_MEAN
  use profile_fit, only: fit_contact, fit_result, fit_rules, fitted_case, shaped_gap
  implicit none

  integer, parameter :: ACROSS = 48, SPLINES = 24
  !> Profiles; the first is straight.
  integer, parameter :: BY_LUNDBERG = 2, RESERVED = 3, LOGARITHM = 4, FREE = 5, PROFILES = 5
  character(len=*), parameter :: NAMES(PROFILES) = &
    ['straight       ', 'Lundberg       ', 'Lundberg, 1.2 F', 'logarithm found', 'splines found  ']
  !> Half of Lundberg's h, and a larger drop at the ends.
  real(dp), parameter :: START(2) = [0.5_dp, 6.0_dp]
  !> The weight of the second differences of the splines, micrometres, beside relative errors of the pressure.
  real(dp), parameter :: SMOOTHNESS = 2.0e-3_dp

  !> A profile, mm, and its largest pressure, N/mm2, on each row of cells.
  type :: row_values
    real(dp), allocatable :: height(:), pressure(:)
    integer :: solves = 0, derivatives = 0
  end type row_values

  call run()

contains

  subroutine run()
    type(crown_grid) :: grid
    type(fuge_halfspace_operator) :: operator
    type(row_values) :: found(PROFILES)
    type(verdict) :: known
    type(fuge_info) :: info

    call set_grid(ACROSS, rows_given(), grid)
    call operator%set(grid%across, grid%along, grid%width, grid%spacing, E_STAR, info, element=FUGE_MEAN, &
                      boundary=FUGE_FREE)
    call require(info, 'grid')
    print '(2(a,i0),2(a,f8.5),a)', 'Roller, ', grid%across, ' x ', grid%along, ' cells of', grid%width, ' mm x', &
      grid%spacing, ' mm'
    print '(a,f7.4,a,f7.1,a)', 'Without ends: half width', HALF_WIDTH, ' mm, pressure', LINE_PRESSURE, ' N/mm2'
    print '(/,2a)', 'profile          drop at the ends [um]   pressure [N/mm2]: middle   least  largest   solves', &
      '  derivatives'
    call try_formulas(grid, operator, found(:RESERVED))
    call fit_logarithm(grid, operator, found(LOGARITHM), known)
    call fit_splines(grid, operator, found(FREE))
    call write_table(grid, found)
    call check(found, known)
  end subroutine run

  integer function rows_given() result(rows)
    character(len=32) :: argument
    integer :: status

    rows = 320
    call get_command_argument(1, argument)
    if (argument == '') return
    read (argument, *, iostat=status) rows
    if (status /= 0) error stop 'usage: crown [rows [folder]]'
    if (rows < 64 .or. modulo(rows, 2) /= 0) error stop 'rows has to be even, 64 or more'
  end function rows_given

  !> The straight roller, and Lundberg's for the load and for 1.2 times as much.
  subroutine try_formulas(grid, operator, found)
    type(crown_grid), intent(in) :: grid
    type(fuge_halfspace_operator), intent(in) :: operator
    type(row_values), intent(out) :: found(:)
    real(dp), parameter :: MULTIPLE(RESERVED) = [0.0_dp, 1.0_dp, 1.2_dp]
    type(fitted_case) :: wish
    type(logarithmic_crown) :: shape
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: by_parameter(size(grid%straight), 2)
    integer :: k

    call want_even_pressure(grid, wish)
    wish%problem%gap = grid%straight
    shape%grid = grid
    do k = 1, size(found)
      call shape%set_gap(lundberg(MULTIPLE(k)), wish%problem%gap, by_parameter)
      call solver%solve(operator, wish%problem, solution, info)
      call require(info, NAMES(k))
      call set_rows(grid, wish%problem%gap, solution, found(k))
      call print_profile(k, found(k))
    end do
  end subroutine try_formulas

  !> Find h and k.
  subroutine fit_logarithm(grid, operator, found, known)
    type(crown_grid), intent(in) :: grid
    type(fuge_halfspace_operator), intent(in) :: operator
    type(row_values), intent(out) :: found
    type(verdict), intent(inout) :: known
    type(fit_result) :: fit
    type(fit_rules) :: rules
    type(logarithmic_crown) :: shape
    real(dp) :: factor

    shape%grid = grid
    call find_profile(shape, grid, operator, rules, START, LOGARITHM, found, fit)
    factor = 1.0_dp - exp(-fit%parameter(2))
    print '(2(a,f6.3),2(a,f8.5))', '  h is', fit%parameter(1), ' times that of Lundberg, from', START(1), '; k =', &
      factor, ', by Lundberg', LUNDBERG_FACTOR
    call known%compare(fit%parameter(1)/1.1_dp - 1.0_dp, 0.1_dp, 'h of Lundberg')
    call known%compare(factor/LUNDBERG_FACTOR - 1.0_dp, 5.0e-3_dp, 'k of Lundberg')
  end subroutine fit_logarithm

  !> Find the heights of the splines, from a straight roller.
  subroutine fit_splines(grid, operator, found)
    type(crown_grid), intent(in) :: grid
    type(fuge_halfspace_operator), intent(in) :: operator
    type(row_values), intent(out) :: found
    type(free_crown) :: shape
    type(fit_result) :: fit
    type(fit_rules) :: rules
    integer :: k

    call set_splines(grid, SPLINES, shape)
    rules%lower = spread(0.0_dp, 1, SPLINES)
    allocate (rules%smoothness(SPLINES - 2, SPLINES))
    rules%smoothness = 0.0_dp
    do k = 1, SPLINES - 2
      rules%smoothness(k, k:k + 2) = SMOOTHNESS*[1.0_dp, -2.0_dp, 1.0_dp]
    end do
    call find_profile(shape, grid, operator, rules, spread(0.0_dp, 1, SPLINES), FREE, found, fit)
  end subroutine fit_splines

  subroutine find_profile(shape, grid, operator, rules, start_from, number, found, fit)
    class(shaped_gap), intent(in) :: shape
    type(crown_grid), intent(in) :: grid
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fit_rules), intent(in) :: rules
    real(dp), intent(in) :: start_from(:)
    integer, intent(in) :: number
    type(row_values), intent(out) :: found
    type(fit_result), intent(inout) :: fit
    type(fitted_case) :: wish(1)
    type(fuge_info) :: info
    real(dp) :: gap(size(grid%straight)), by_parameter(size(grid%straight), size(start_from))

    call want_even_pressure(grid, wish(1))
    call fit_contact(shape, operator, wish, rules, start_from, fit, info)
    call require(info, NAMES(number))
    call shape%set_gap(fit%parameter, gap, by_parameter)
    call set_rows(grid, gap, fit%solution(1), found)
    found%solves = fit%solves
    found%derivatives = fit%derivatives
    call print_profile(number, found)
  end subroutine find_profile

  !> Hertz's largest pressure in both cells beside the axis, in all rows of the roller.
  subroutine want_even_pressure(grid, wish)
    type(crown_grid), intent(in) :: grid
    type(fitted_case), intent(out) :: wish
    logical :: is_wanted(size(grid%straight))

    is_wanted = grid%is_roller .and. abs(grid%x_of) < grid%width
    wish%problem%resultant = [LOAD]
    wish%by_force = merge(1.0_dp/(LINE_PRESSURE*grid%width*grid%spacing), 0.0_dp, is_wanted)
    wish%by_gap = spread(0.0_dp, 1, size(is_wanted))
    wish%wanted = merge(1.0_dp, 0.0_dp, is_wanted)
  end subroutine want_even_pressure

  !> Heights and pressures on the rows of the roller.
  subroutine set_rows(grid, gap, solution, row)
    type(crown_grid), intent(in) :: grid
    real(dp), intent(in) :: gap(:)
    type(fuge_solution), intent(in) :: solution
    type(row_values), intent(out) :: row
    real(dp), dimension(grid%across, grid%along) :: height, pressure

    height = reshape(gap - grid%straight, shape(height))
    pressure = reshape(solution%force, shape(pressure))/(grid%width*grid%spacing)
    row%height = pack(height(1, :), grid%has_roller)
    row%height = row%height - minval(row%height)
    row%pressure = pack(maxval(pressure, 1), grid%has_roller)
  end subroutine set_rows

  subroutine print_profile(number, row)
    integer, intent(in) :: number
    type(row_values), intent(in) :: row

    print '(a,f18.2,f31.1,2f9.1,i9,i13)', NAMES(number), 1.0e3_dp*row%height(1), row%pressure(size(row%pressure)/2), &
      minval(row%pressure), maxval(row%pressure), max(1, row%solves), row%derivatives
  end subroutine print_profile

  subroutine write_table(grid, found)
    type(crown_grid), intent(in) :: grid
    type(row_values), intent(in) :: found(:)
    real(dp) :: y(size(found(1)%height))
    integer :: file, j, k

    y = pack(grid%y, grid%has_roller)
    call create_file('crown.csv', 2, file)
    write (file, '(a)') 'y [mm],pressure [N/mm2]: straight,Lundberg,Lundberg 1.2 F,logarithm,splines,' &
      //'height [um]: straight,Lundberg,Lundberg 1.2 F,logarithm,splines'
    do j = 1, size(y)
      write (file, '(10(es14.6,","),es14.6)') y(j), (found(k)%pressure(j), k=1, size(found)), &
        (1.0e3_dp*found(k)%height(j), k=1, size(found))
    end do
    close (file)
  end subroutine write_table

  subroutine check(found, known)
    type(row_values), intent(in) :: found(:)
    type(verdict), intent(inout) :: known
    real(dp) :: largest(PROFILES)
    integer :: k

    largest = [(maxval(found(k)%pressure), k=1, PROFILES)]
    call known%hold(all(found(LOGARITHM:)%solves < 20), 'fewer than 20 solves')
    call known%hold(largest(LOGARITHM) < largest(BY_LUNDBERG), 'a lower pressure than by the formula')
    call known%compare(largest(LOGARITHM)/LINE_PRESSURE - 1.0_dp, 0.03_dp, 'the pressure with the logarithm')
    call known%compare(found(FREE)%pressure/LINE_PRESSURE - 1.0_dp, 5.0e-3_dp, 'the pressure with the splines')
    call known%give('against Hertz and Lundberg')
  end subroutine check

  subroutine require(info, what)
    type(fuge_info), intent(in) :: info
    character(len=*), intent(in) :: what

    if (.not. info%failed()) return
    print '(3a)', trim(what), ': ', trim(info%message)
    error stop 'a step of the example failed'
  end subroutine require

end program crown
