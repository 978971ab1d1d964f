!> The figures of the choice tables of doc/performance.md: accuracy, time and memory of each call at some sizes.
!>
!>     choices [ROW]
!>
!> Runs each row in a process of its own and writes a Markdown table; with ROW only that one. A row begins with the data
!> of the contact and ends with a certified answer, influence matrix or operator included. Errors: of the pressure, the
!> fraction of the load in the wrong place; of the approach, relative, for lines as a fraction of 2 F/(pi E*); of the
!> half width. Where no answer is known, the library's own estimate of the largest error of a force counts as that of
!> the pressure. Memory is the largest resident memory of the first run, less that before. Processor time, the least of
!> some repetitions, one thread.
program choices
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_graded, only: make_graded
  use bench_judge, only: judge
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_problems, only: bench_problem, add_matrix, contact_problem, make_known, make_random, make_rough, &
    uniform_edges
  use bench_records, only: bench_row
  use bench_surfaces, only: bench_surface, make_sphere, make_surface, set_operator
  use bench_watch, only: stopwatch
  use closed_forms, only: quartic_punch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, &
    fuge_operator, fuge_options, fuge_polynomial_profile, fuge_problem, fuge_ring_matrix, fuge_round_contact, &
    fuge_smooth_contact, fuge_solution, fuge_solve_round_punch, fuge_solve_smooth_punch, fuge_solver, FUGE_ITERATIVE, &
    FUGE_MEAN
  implicit none

  character(len=12), parameter :: ROWS(18) = [character(len=12) :: 'smooth', 'graded_64', 'corner_64', 'equal_64', &
    'line_12', 'line_16', 'line_20', 'profile_16', 'round', 'rings_200', 'area_64', 'area_256', 'area_1024', &
    'rough_1024', 'matrix_50', 'matrix_200', 'matrix_800', 'matrix_2000']
  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Tolerance of rough surfaces; that of the others is the default.
  real(dp), parameter :: OF_ROUGH = 1.0e-8_dp
  real(dp), parameter :: NONE(0) = [real(dp) ::]

  !> Negative: not known.
  type :: choice
    real(dp) :: pressure = -1.0_dp, approach = -1.0_dp, half_width = -1.0_dp, memory = -1.0_dp
    type(stopwatch) :: watch
    real(dp) :: before = -1.0_dp
  end type choice

  call run()

contains

  subroutine run()
    character(len=256) :: program_name
    character(len=12) :: row
    integer :: k, status

    if (command_argument_count() > 0) then
      call get_command_argument(1, row)
      call write_row(row)
      return
    end if
    call get_command_argument(0, program_name)
    write (output_unit, '(a)') '| row | pressure | approach | half width | time | memory |', &
      '| --- | ---: | ---: | ---: | ---: | ---: |'
    flush (output_unit)
    do k = 1, size(ROWS)
      call execute_command_line(trim(program_name)//' '//trim(ROWS(k)), exitstat=status)
      if (status /= 0) error stop 'a row has failed'
    end do
  end subroutine run

  subroutine write_row(row)
    character(len=*), intent(in) :: row
    type(choice) :: found
    character(len=16) :: memory

    select case (row)
    case ('smooth')
      call run_smooth(found)
    case ('round')
      call run_round(found)
    case ('rings_200')
      call run_rings(200, found)
    case ('rough_1024')
      call run_area('light_area', 1024, OF_ROUGH, found)
    case ('profile_16')
      call run_profile(2**16, found)
    case default
      call run_sized(row(:index(row, '_') - 1), size_in(row), found)
    end select
    memory = '-'
    if (found%memory > 0.0_dp) write (memory, '(f0.1,a)') 1.0e-6_dp*found%memory, ' MB'
    write (output_unit, '(8a,f0.3,3a)') '| ', trim(row), ' | ', number(found%pressure), ' | ', number(found%approach), &
      ' | ', number(found%half_width)//' | ', 1.0e3_dp*found%watch%best, ' ms | ', trim(memory), ' |'
  end subroutine write_row

  !> The number at the end of the name of a row.
  function size_in(row) result(n)
    character(len=*), intent(in) :: row
    integer :: n
    integer :: stat

    read (row(index(row, '_') + 1:), *, iostat=stat) n
    if (stat /= 0) error stop 'usage: choices [ROW]'
  end function size_in

  subroutine run_sized(kind, n, found)
    character(len=*), intent(in) :: kind
    integer, intent(in) :: n
    type(choice), intent(inout) :: found

    select case (kind)
    case ('graded')
      call run_cells('quartic', n, .true., found)
    case ('corner')
      call run_cells('flat', n, .true., found)
    case ('equal')
      call run_cells('quartic', n, .false., found)
    case ('line')
      call run_line(2**n, found)
    case ('area')
      call run_area('sphere', n, 1.0e-10_dp, found)
    case ('matrix')
      call run_matrix(n, found)
    case default
      error stop 'usage: choices [ROW]'
    end select
  end subroutine run_sized

  function number(value) result(cell)
    real(dp), intent(in) :: value
    character(len=8) :: cell

    cell = ''
    if (value > 0.0_dp) write (cell, '(es8.1)') value
  end function number

  subroutine start_run(found)
    type(choice), intent(inout) :: found
    logical :: forgotten

    if (found%watch%runs < 1) then
      call forget_peak(forgotten)
      if (forgotten) found%before = resident()
    end if
    call found%watch%start()
  end subroutine start_run

  subroutine stop_run(found, info)
    type(choice), intent(inout) :: found
    type(fuge_info), intent(in) :: info

    call found%watch%stop()
    if (found%watch%runs == 1 .and. found%before > 0.0_dp) found%memory = peak_resident() - found%before
    if (info%status == 0) return
    write (output_unit, '(a)') trim(info%message)
    error stop 'a call has failed or warned'
  end subroutine stop_run

  subroutine run_smooth(found)
    type(choice), intent(inout) :: found
    integer, parameter :: PLACES = 1000
    type(bench_problem) :: problem
    type(fuge_polynomial_profile) :: profile
    type(fuge_smooth_contact) :: contact
    type(fuge_info) :: info

    call make_known('quartic', FUGE_MEAN, uniform_edges(PLACES), problem)
    profile%lower = -0.8_dp
    profile%upper = 0.8_dp
    select type (form => problem%form)
    type is (quartic_punch)
      allocate (profile%coefficients, source=[0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, form%factor])
    end select
    do while (.not. found%watch%enough())
      call start_run(found)
      call fuge_solve_smooth_punch(profile, problem%e_star, problem%load, contact, info)
      call stop_run(found, info)
    end do
    found%pressure = dot_product(abs(contact%pressure(problem%x) - problem%form%pressure(problem%x)), problem%width) &
                     /problem%load
    found%half_width = abs(contact%half_width/problem%form%a - 1.0_dp)
  end subroutine run_smooth

  !> A sphere, gap r**2/2, E* = 1, contact radius 1.
  subroutine run_round(found)
    type(choice), intent(inout) :: found
    type(fuge_polynomial_profile) :: profile
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info
    real(dp) :: r(100)
    integer :: k

    profile%upper = 2.0_dp
    profile%coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
    do while (.not. found%watch%enough())
      call start_run(found)
      call fuge_solve_round_punch(profile, 1.0_dp, contact, info, load=4.0_dp/3.0_dp)
      call stop_run(found, info)
    end do
    r = [(real(k, dp)/100.0_dp, k=0, 99)]
    found%pressure = maxval(abs(contact%pressure(r) - 2.0_dp/PI*sqrt((1.0_dp - r)*(1.0_dp + r))))*PI/2.0_dp
    found%approach = abs(contact%approach - 1.0_dp)
  end subroutine run_round

  !> The same sphere on rings of equal width to the radius 1.2.
  subroutine run_rings(n, found)
    integer, intent(in) :: n
    type(choice), intent(inout) :: found
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: radius(n + 1), exact(n)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    integer :: k

    radius = [(1.2_dp*real(k, dp)/real(n, dp), k=0, n)]
    contact%gap = 0.25_dp*(radius(:n)**2 + radius(2:)**2)
    contact%resultant = [4.0_dp/3.0_dp]
    do while (.not. found%watch%enough())
      if (allocated(alpha)) deallocate (alpha)
      call start_run(found)
      allocate (alpha(n, n), source=0.0_dp)
      call fuge_ring_matrix(radius, 1.0_dp, FUGE_MEAN, alpha, info)
      if (.not. info%failed()) call solve_matrix(alpha, contact, operator, solution, info)
      call stop_run(found, info)
    end do
    exact = min(radius(:n), 1.0_dp)
    exact = 4.0_dp/3.0_dp*(((1.0_dp - exact)*(1.0_dp + exact))**1.5_dp &
                           - ((1.0_dp - min(radius(2:), 1.0_dp))*(1.0_dp + min(radius(2:), 1.0_dp)))**1.5_dp)
    found%pressure = sum(abs(solution%force - exact))*0.75_dp
    found%approach = abs(solution%motion(1) - 1.0_dp)
  end subroutine run_rings

  subroutine solve_matrix(alpha, contact, operator, solution, info)
    real(dp), intent(in), target :: alpha(:, :)
    type(fuge_problem), intent(in) :: contact
    type(fuge_dense_operator), intent(inout) :: operator
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, contact, solution, info)
  end subroutine solve_matrix

  !> Cells and a matrix.
  subroutine run_cells(name, n, graded, found)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    logical, intent(in) :: graded
    type(choice), intent(inout) :: found
    type(bench_problem), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    do while (.not. found%watch%enough())
      call start_run(found)
      if (graded) then
        call make_graded(name, n, problem)
      else
        call make_known(name, FUGE_MEAN, uniform_edges(n), problem)
        call add_matrix(problem)
      end if
      call solve_matrix(problem%alpha, contact_problem(problem), operator, solution, info)
      call stop_run(found, info)
    end do
    call compare(problem, operator, solution, found)
  end subroutine run_cells

  subroutine compare(problem, operator, solution, found)
    type(bench_problem), intent(in) :: problem
    class(fuge_operator), intent(in) :: operator
    type(fuge_solution), intent(in) :: solution
    type(choice), intent(inout) :: found
    type(bench_row) :: row

    call judge(problem, operator, solution%force, NONE, row)
    found%pressure = row%error_pressure
    found%approach = row%error_approach
    found%half_width = row%error_half_width
  end subroutine compare

  subroutine run_line(n, found)
    integer, intent(in) :: n
    type(choice), intent(inout) :: found
    type(bench_problem) :: problem
    type(fuge_halfplane_operator) :: operator
    type(fuge_solution) :: solution

    call make_known('quartic', FUGE_MEAN, uniform_edges(n), problem)
    call solve_line(problem, operator, solution, found)
    call compare(problem, operator, solution, found)
  end subroutine run_line

  !> A rough profile; its error is the library's estimate.
  subroutine run_profile(n, found)
    integer, intent(in) :: n
    type(choice), intent(inout) :: found
    type(bench_problem) :: problem
    type(fuge_halfplane_operator) :: operator
    type(fuge_solution) :: solution

    call make_rough(n, 0.005_dp, problem)
    call solve_line(problem, operator, solution, found)
  end subroutine run_profile

  subroutine solve_line(problem, operator, solution, found)
    type(bench_problem), intent(in) :: problem
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_solution), intent(inout) :: solution
    type(choice), intent(inout) :: found
    type(fuge_problem) :: contact
    type(fuge_info) :: info

    contact = contact_problem(problem)
    do while (.not. found%watch%enough())
      call start_run(found)
      call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element, problem%boundary)
      if (.not. info%failed()) call solve_by_products(operator, contact, 1.0e-10_dp, solution, info)
      call stop_run(found, info)
    end do
    found%pressure = info%force_error
  end subroutine solve_line

  subroutine solve_by_products(operator, contact, tolerance, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: contact
    real(dp), intent(in) :: tolerance
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solver%solve(operator, contact, solution, info, fuge_options(FUGE_ITERATIVE, tolerance=tolerance))
  end subroutine solve_by_products

  subroutine run_area(name, n, tolerance, found)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    real(dp), intent(in) :: tolerance
    type(choice), intent(inout) :: found
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    if (name == 'sphere') then
      call make_sphere(n, FUGE_MEAN, surface)
    else
      call make_surface(name, n, surface)
    end if
    contact = surface%contact()
    do while (.not. found%watch%enough())
      call start_run(found)
      call set_operator(surface, operator)
      call solve_by_products(operator, contact, tolerance, solution, info)
      call stop_run(found, info)
    end do
    found%pressure = info%force_error
    if (name /= 'sphere') return
    found%pressure = sum(abs(solution%force - surface%exact_forces()))/surface%load
    found%approach = abs(solution%motion(1)/surface%approach - 1.0_dp)
  end subroutine run_area

  subroutine run_matrix(n, found)
    integer, intent(in) :: n
    type(choice), intent(inout) :: found
    type(bench_problem), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call make_random(n, problem)
    contact = contact_problem(problem)
    do while (.not. found%watch%enough())
      call start_run(found)
      call solve_matrix(problem%alpha, contact, operator, solution, info)
      call stop_run(found, info)
    end do
    found%pressure = info%force_error
    ! Memory left over from making the matrix is used again.
    found%memory = -1.0_dp
  end subroutine run_matrix

end program choices
