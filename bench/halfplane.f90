!> Speed, memory and errors of the iterative engine with the FFT operator of a half-plane.
!>
!>     halfplane DIRECTORY FAMILY N [write]
!>
!> FAMILY is punch or cylinder (free surface, known answers) or light, heavy, nearfull (rough
!> periodic profile, N a power of two). Appends to DIRECTORY/halfplane.csv. One problem to a
!> process, so that the memory of the first solve is that of a program that does nothing
!> else. `write` also writes problem and forces for other solvers.
program halfplane
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_problems, only: bench_problem, make_cylinder, make_punch, make_rough
  use bench_records, only: iterative_row, write_iterative_header, write_iterative_row, write_profile
  use bench_watch, only: stopwatch
  use fuge, only: dp, fuge_contact_edges, fuge_halfplane_operator, fuge_info, fuge_interval, fuge_options, &
    fuge_problem, fuge_solution, fuge_solver, FUGE_CENTRE, FUGE_FREE, FUGE_ITERATIVE, FUGE_MEAN, FUGE_PERIODIC
  implicit none

  character(len=8), parameter :: FAMILIES(5) = ['punch   ', 'cylinder', 'light   ', 'heavy   ', 'nearfull']
  !> Mean pressures of the last three.
  real(dp), parameter :: PRESSURES(3:5) = [0.005_dp, 0.05_dp, 0.2_dp]
  integer, parameter :: ELEMENTS(2) = [FUGE_CENTRE, FUGE_MEAN]
  character(len=6), parameter :: ELEMENT_NAMES(2) = ['centre', 'mean  ']
  !> Finer grids of known answers are there for their speed, coarser ones for their errors.
  integer, parameter :: FINEST_FOR_ERRORS = 2**14, COARSEST_FOR_SPEED = 2**12
  real(dp), parameter :: TOLERANCES(2) = [1.0e-10_dp, 1.0e-12_dp], ROUGH_TOLERANCES(2) = [1.0e-10_dp, 1.0e-8_dp]
  !> Products in one sample: one alone is at the mercy of the clock.
  integer, parameter :: BATCH = 5
  !> Seconds for a grid that is there for its errors.
  real(dp), parameter :: SHORT = 0.1_dp

  !> What the command line asks for, and the unit of the table.
  type :: settings
    character(len=256) :: directory = ''
    integer :: family = 0, n = 0, table = 0
    logical :: writes = .false.
  end type settings

  !> What one solve needs, in one place.
  type :: scene
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
  end type scene

  call run()

contains

  subroutine run()
    type(settings) :: chosen

    call read_settings(chosen)
    call open_table(chosen)
    call measure(chosen, 1)
    if (chosen%family < lbound(PRESSURES, 1) .and. chosen%n <= FINEST_FOR_ERRORS) call measure(chosen, 2)
    close (chosen%table)
  end subroutine run

  subroutine read_settings(chosen)
    type(settings), intent(inout) :: chosen
    character(len=16) :: word
    integer :: k, stat

    call get_command_argument(1, chosen%directory)
    call get_command_argument(2, word)
    do k = 1, size(FAMILIES)
      if (word == FAMILIES(k)) chosen%family = k
    end do
    call get_command_argument(3, word)
    read (word, *, iostat=stat) chosen%n
    if (stat /= 0 .or. chosen%family == 0) error stop 'usage: halfplane DIRECTORY FAMILY N [write]'
    if (chosen%n < 64) error stop 'halfplane: N is 64 or more'
    if (chosen%family >= lbound(PRESSURES, 1) .and. popcnt(chosen%n) /= 1) then
      error stop 'halfplane: N is a power of two for a rough profile'
    end if
    call get_command_argument(4, word)
    chosen%writes = word == 'write'
  end subroutine read_settings

  subroutine open_table(chosen)
    type(settings), intent(inout) :: chosen
    logical :: exists

    associate (name => trim(chosen%directory)//'/halfplane.csv')
      inquire (file=name, exist=exists)
      open (newunit=chosen%table, file=name, position='append', action='write')
    end associate
    if (.not. exists) call write_iterative_header(chosen%table)
  end subroutine open_table

  subroutine make_problem(chosen, element, given)
    type(settings), intent(in) :: chosen
    integer, intent(in) :: element
    type(bench_problem), intent(out) :: given

    select case (chosen%family)
    case (1)
      call make_punch(chosen%n, element, given)
    case (2)
      call make_cylinder(chosen%n, element, given)
    case default
      call make_rough(chosen%n, PRESSURES(chosen%family), given)
    end select
    write (given%name, '(a,a,i0)') trim(FAMILIES(chosen%family)), '_', chosen%n
  end subroutine make_problem

  !> All rows of one problem and element.
  subroutine measure(chosen, e)
    type(settings), intent(in) :: chosen
    integer, intent(in) :: e
    type(bench_problem) :: given
    type(scene) :: contact
    type(iterative_row) :: row
    real(dp) :: tolerances_here(2)
    integer :: k

    call make_problem(chosen, ELEMENTS(e), given)
    row%problem = given%name
    row%element = ELEMENT_NAMES(e)
    row%n = chosen%n
    tolerances_here = merge(ROUGH_TOLERANCES, TOLERANCES, given%periodic)
    if (e == 1) then
      call first_solve(given, tolerances_here(1), contact, chosen, row)
      call write_iterative_row(chosen%table, row)
      row%memory = -1.0_dp
    else
      call set_scene(given, contact)
    end if
    do k = 1, size(TOLERANCES)
      call time_solves(given, contact, tolerances_here(k), row)
      call write_iterative_row(chosen%table, row)
    end do
    if (e == 1 .and. chosen%n >= COARSEST_FOR_SPEED) call time_parts(given, contact, row, chosen)
  end subroutine measure

  subroutine set_scene(given, contact)
    type(bench_problem), intent(in) :: given
    type(scene), intent(inout) :: contact
    type(fuge_info) :: info

    call contact%operator%set(size(given%gap), given%width, given%e_star, info, given%element, &
                              merge(FUGE_PERIODIC, FUGE_FREE, given%periodic))
    if (info%failed()) error stop 'no operator of the half-plane'
    contact%problem%gap = given%gap
    contact%problem%resultant = [given%load]
  end subroutine set_scene

  !> Operator and solve in a process that has done nothing like it, where FFTW still has to
  !> plan: time and memory of both.
  subroutine first_solve(given, tolerance, contact, chosen, row)
    type(bench_problem), intent(in) :: given
    real(dp), intent(in) :: tolerance
    type(scene), intent(inout) :: contact
    type(settings), intent(in) :: chosen
    type(iterative_row), intent(inout) :: row
    type(stopwatch) :: watch
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: before, peak
    logical :: forgotten

    call forget_peak(forgotten)
    before = resident()
    call watch%start()
    call set_scene(given, contact)
    call solve_cold(contact, tolerance, solution, info)
    call watch%stop()
    peak = peak_resident()
    row%method = 'first'
    if (forgotten .and. before > 0.0_dp .and. peak > before) row%memory = peak - before
    row%time = watch%median()
    call note(given, info, solution, tolerance, row)
    if (chosen%writes .and. .not. info%failed()) call write_profile(trim(chosen%directory), given, solution%force)
  end subroutine first_solve

  !> Nothing is known but the problem.
  subroutine solve_cold(contact, tolerance, solution, info)
    type(scene), intent(in) :: contact
    real(dp), intent(in) :: tolerance
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver
    type(fuge_options) :: options

    options%method = FUGE_ITERATIVE
    options%tolerance = tolerance
    call solver%solve(contact%operator, contact%problem, solution, info, options)
  end subroutine solve_cold

  !> Solves and products in turns, so that a busy machine slows both.
  subroutine time_solves(given, contact, tolerance, row)
    type(bench_problem), intent(in) :: given
    type(scene), intent(in) :: contact
    real(dp), intent(in) :: tolerance
    type(iterative_row), intent(inout) :: row
    type(stopwatch) :: watch, product
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    if (row%n < COARSEST_FOR_SPEED) watch%budget = SHORT
    do while (.not. watch%enough())
      call watch%start()
      call solve_cold(contact, tolerance, solution, info)
      call watch%stop()
      if (info%failed()) exit
      call run_products(contact%operator, solution%force, product)
    end do
    row%method = 'iterative'
    row%time = watch%median()
    row%product_time = product%median()/real(BATCH, dp)
    call note(given, info, solution, tolerance, row)
  end subroutine time_solves

  subroutine run_products(operator, force, watch)
    type(fuge_halfplane_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:)
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable :: displacement(:)
    integer :: k, status

    allocate (displacement(size(force)), source=0.0_dp)
    call watch%start()
    do k = 1, BATCH
      call operator%apply(force, displacement, status)
      if (status /= 0) error stop 'no product'
    end do
    call watch%stop()
  end subroutine run_products

  subroutine run_filters(operator, length, watch)
    type(fuge_halfplane_operator), intent(in) :: operator
    real(dp), intent(in) :: length(:)
    type(stopwatch), intent(inout) :: watch
    real(dp), allocatable :: force(:)
    integer :: k, status

    allocate (force(size(length)), source=0.0_dp)
    call watch%start()
    do k = 1, BATCH
      call operator%filter(length, force, status)
      if (status /= 0) error stop 'no filter'
    end do
    call watch%stop()
  end subroutine run_filters

  !> One product, one filter and the making of the operator.
  subroutine time_parts(given, contact, solved, chosen)
    type(bench_problem), intent(in) :: given
    type(scene), intent(inout) :: contact
    type(iterative_row), intent(in) :: solved
    type(settings), intent(in) :: chosen
    type(stopwatch) :: product, filter, making
    type(iterative_row) :: row

    do while (.not. making%enough())
      call making%start()
      call set_scene(given, contact)
      call making%stop()
      call run_products(contact%operator, given%gap, product)
      call run_filters(contact%operator, given%gap, filter)
    end do
    row%problem = solved%problem
    row%element = solved%element
    row%n = solved%n
    row%product_time = product%median()/real(BATCH, dp)
    call write_part('product', row%product_time, row, chosen%table)
    call write_part('filter', filter%median()/real(BATCH, dp), row, chosen%table)
    call write_part('set', making%median(), row, chosen%table)
  end subroutine time_parts

  subroutine write_part(name, time, row, table)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: time
    type(iterative_row), intent(inout) :: row
    integer, intent(in) :: table

    row%method = name
    row%time = time
    call write_iterative_row(table, row)
  end subroutine write_part

  !> Fill a row from a solve. What failed is shown as that, with what is known of it.
  subroutine note(given, info, solution, tolerance, row)
    type(bench_problem), intent(in) :: given
    type(fuge_info), intent(in) :: info
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: tolerance
    type(iterative_row), intent(inout) :: row

    row%tolerance = tolerance
    row%products = info%products
    row%filters = info%filters
    row%iterations = info%iterations
    row%unknowns = -1
    row%residual = -1.0_dp
    row%error_half_width = -1.0_dp
    row%error_pressure = -1.0_dp
    row%failure = ''
    if (info%status /= 0) row%failure = info%message(:len(row%failure))
    if (info%failed()) return
    row%unknowns = info%contacts
    row%residual = info%residual
    if (.not. allocated(given%exact)) return
    row%error_half_width = half_width_error(given, solution%force)
    row%error_pressure = norm2(solution%force - given%exact)/norm2(given%exact)
  end subroutine note

  !> Negative if contact is not one interval.
  function half_width_error(given, force) result(error)
    type(bench_problem), intent(in) :: given
    real(dp), intent(in) :: force(:)
    real(dp) :: error
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_info) :: info
    real(dp), allocatable :: width(:)

    error = -1.0_dp
    allocate (width(size(force)), source=given%width)
    call fuge_contact_edges(given%x, width, force, given%element, intervals, info)
    if (info%failed()) return
    if (size(intervals) == 1) error = abs(0.5_dp*(intervals(1)%right - intervals(1)%left) &
                                          /given%half_width - 1.0_dp)
  end function half_width_error

end program halfplane
