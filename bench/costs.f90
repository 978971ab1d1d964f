!> The cost of what a caller may want beside a solution, in multiples of a solve: a next solve, derivatives, a load
!> path, edges and stresses.
!>
!>     costs
!>
!> The quartic punch by a matrix of 256 and 1024 cells and by FFT on 2^16 cells, and a sphere by FFT on 512 x 512 cells.
!> Writes a Markdown table; the first rows are times, the others multiples of the solve by a new solver. A path goes
!> from no load to the load; `an event` is a point that joins. Stresses are all components. Processor time, the least of
!> some repetitions, one thread.
program costs
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_problems, only: bench_problem, add_matrix, contact_problem, make_known, uniform_edges
  use bench_surfaces, only: bench_surface, make_surface, set_operator
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_contact_edges, fuge_dense_operator, fuge_field, fuge_halfplane_field, &
    fuge_halfplane_operator, fuge_halfspace_field, fuge_halfspace_operator, fuge_info, fuge_interval, fuge_load_path, &
    fuge_operator, fuge_path, fuge_problem, fuge_solution, fuge_solver, fuge_stress_peak, FUGE_FREE, FUGE_MEAN, &
    FUGE_MEASURE_VON_MISES, FUGE_PLANE_STRAIN
  implicit none

  integer, parameter :: SCENES = 4, POINTS = 1000, DEPTHS = 10, AREA = 512
  real(dp), parameter :: NU = 0.3_dp, STEP = 1.01_dp, BUDGET = 0.5_dp

  !> The rows of the table. The first two are times.
  integer, parameter :: OPERATOR_ROW = 1, SOLVE_ROW = 2, NEXT_ROW = 3, DERIVATIVE_ROW = 4, PATH_ROW = 5, &
    EVENT_ROW = 6, EDGES_ROW = 7, POINTS_ROW = 8, GRID_ROW = 9, PEAK_ROW = 10, ROWS = 10
  character(len=44), parameter :: WORDS(ROWS) = [character(len=44) :: 'matrix or operator', 'a solve', &
    'the next one, load + 1 %', 'a derivative', 'a load path from no load', 'an event of it', 'edges', &
    'stresses at 1000 points', 'stresses below all cells, 10 depths', 'the largest von Mises stress']

  call run()

contains

  subroutine run()
    real(dp) :: time(ROWS, SCENES)
    integer :: k

    time = -1.0_dp
    call measure_matrix(256, time(:, 1))
    call measure_matrix(1024, time(:, 2))
    call measure_line(2**16, time(:, 3))
    call measure_area(time(:, 4))
    write (output_unit, '(a)') '| | matrix, 256 | matrix, 1024 | line by FFT, 2^16 | area by FFT, 512 x 512 |', &
      '| --- | ---: | ---: | ---: | ---: |'
    do k = 1, ROWS
      if (k > SOLVE_ROW) where (time(k, :) > 0.0_dp) time(k, :) = time(k, :)/time(SOLVE_ROW, :)
      call write_cells(trim(WORDS(k)), time(k, :), k <= SOLVE_ROW)
    end do
  end subroutine run

  subroutine write_cells(word, values, are_times)
    character(len=*), intent(in) :: word
    real(dp), intent(in) :: values(:)
    logical, intent(in) :: are_times
    character(len=16) :: cell
    integer :: k

    write (output_unit, '(3a)', advance='no') '| ', word, ' |'
    do k = 1, size(values)
      cell = ''
      if (are_times) then
        write (cell, '(f0.2,a)') 1.0e3_dp*values(k), ' ms'
      else if (values(k) > 0.0_dp) then
        write (cell, '(es8.1)') values(k)
      end if
      write (output_unit, '(3a)', advance='no') ' ', trim(adjustl(cell)), ' |'
    end do
    write (output_unit, '(a)') ''
  end subroutine write_cells

  subroutine measure_matrix(n, time)
    integer, intent(in) :: n
    real(dp), intent(inout) :: time(:)
    type(bench_problem), target :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_solution) :: solution
    type(fuge_path) :: path
    type(fuge_info) :: info
    type(stopwatch) :: watch

    call make_known('quartic', FUGE_MEAN, uniform_edges(n), problem)
    watch%budget = BUDGET
    do while (.not. watch%enough())
      call watch%start()
      call add_matrix(problem)
      call operator%set(problem%alpha, info)
      call watch%stop()
      call check(info)
    end do
    time(OPERATOR_ROW) = watch%best
    call measure_solves(operator, contact_problem(problem), solution, time)
    watch = stopwatch(budget=BUDGET)
    do while (.not. watch%enough())
      call watch%start()
      call fuge_load_path(operator, problem%gap, problem%load, path, info)
      call watch%stop()
      call check(info)
    end do
    time(PATH_ROW) = watch%best
    time(EVENT_ROW) = watch%best/real(path%entries - 1, dp)
    call measure_line_results(problem, solution%force, time)
  end subroutine measure_matrix

  subroutine measure_line(n, time)
    integer, intent(in) :: n
    real(dp), intent(inout) :: time(:)
    type(bench_problem) :: problem
    type(fuge_halfplane_operator) :: operator
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    type(stopwatch) :: watch

    call make_known('quartic', FUGE_MEAN, uniform_edges(n), problem)
    watch%budget = BUDGET
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(n, problem%width(1), problem%e_star, info, FUGE_MEAN)
      call watch%stop()
      call check(info)
    end do
    time(OPERATOR_ROW) = watch%best
    call measure_solves(operator, contact_problem(problem), solution, time)
    call measure_line_results(problem, solution%force, time)
  end subroutine measure_line

  subroutine measure_area(time)
    real(dp), intent(inout) :: time(:)
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: operator
    type(fuge_solution) :: solution
    type(stopwatch) :: watch

    call make_surface('sphere', AREA, surface)
    watch%budget = BUDGET
    do while (.not. watch%enough())
      call watch%start()
      call set_operator(surface, operator)
      call watch%stop()
    end do
    time(OPERATOR_ROW) = watch%best
    call measure_solves(operator, surface%contact(), solution, time)
    call measure_area_stresses(surface, solution%force, time)
  end subroutine measure_area

  !> A solve by a new solver, the next one by the same, and the derivative by the load.
  subroutine measure_solves(operator, contact, solution, time)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: contact
    type(fuge_solution), intent(inout) :: solution
    real(dp), intent(inout) :: time(:)
    type(stopwatch) :: cold, next, derivative
    type(fuge_problem) :: heavier
    type(fuge_solution) :: change, other
    type(fuge_solver) :: solver
    type(fuge_info) :: info
    real(dp) :: no_change(size(contact%gap))

    no_change = 0.0_dp
    heavier = contact
    heavier%resultant = STEP*contact%resultant
    cold%budget = BUDGET
    do while (.not. cold%enough())
      call solver%reset()
      call cold%start()
      call solver%solve(operator, contact, solution, info)
      call cold%stop()
      call check(info)
      call derivative%start()
      call solver%derivative(operator, no_change, 1.0_dp, change, info)
      call derivative%stop()
      call check(info)
      call next%start()
      call solver%solve(operator, heavier, other, info)
      call next%stop()
      call check(info)
    end do
    time([SOLVE_ROW, NEXT_ROW, DERIVATIVE_ROW]) = [cold%best, next%best, derivative%best]
  end subroutine measure_solves

  subroutine measure_line_results(problem, force, time)
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: time(:)
    type(fuge_interval), allocatable :: intervals(:)
    type(fuge_halfplane_field) :: field
    type(fuge_info) :: info
    type(stopwatch) :: edges

    do while (.not. edges%enough())
      call edges%start()
      call fuge_contact_edges(problem%x, problem%width, force, FUGE_MEAN, intervals, info)
      call edges%stop()
      call check(info)
    end do
    time(EDGES_ROW) = edges%best
    call field%set_grid(problem%width(1), force, FUGE_MEAN, FUGE_FREE, 1.0_dp, NU, FUGE_PLANE_STRAIN, info)
    call check(info)
    call measure_field(field, size(force), problem%form%a, [-problem%x(1), 0.0_dp], time)
  end subroutine measure_line_results

  subroutine measure_area_stresses(surface, force, time)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: time(:)
    type(fuge_halfspace_field) :: field
    type(fuge_info) :: info

    call field%set_grid(surface%n, surface%n, surface%cell(), surface%cell(), force, FUGE_FREE, 1.0_dp, NU, info)
    call check(info)
    call measure_field(field, size(force), surface%contact_radius, &
                       spread(0.5_dp*(surface%n - 1)*surface%cell(), 1, 2), time)
  end subroutine measure_area_stresses

  !> Stresses below a contact of half width `a` about `middle`, counted from the first cell of the grid.
  subroutine measure_field(field, cells, a, middle, time)
    class(fuge_field), intent(in) :: field
    integer, intent(in) :: cells
    real(dp), intent(in) :: a, middle(2)
    real(dp), intent(inout) :: time(:)
    type(fuge_stress_peak) :: peak
    type(fuge_info) :: info
    type(stopwatch) :: at_points, on_grid, largest
    real(dp) :: place(3, POINTS), tensor(6, POINTS)
    real(dp), allocatable :: below(:, :, :)

    allocate (below(6, cells, DEPTHS))
    place = scattered(a, middle)
    do while (.not. at_points%enough() .and. largest%runs < 3)
      call at_points%start()
      call field%stress(place, tensor, info)
      call at_points%stop()
      call check(info)
      call on_grid%start()
      call field%grid_stress(depths_of(a), below, info)
      call on_grid%stop()
      call check(info)
      call largest%start()
      call field%largest(FUGE_MEASURE_VON_MISES, peak, info)
      call largest%stop()
      call check(info)
    end do
    time([POINTS_ROW, GRID_ROW, PEAK_ROW]) = [at_points%best, on_grid%best, largest%best]
  end subroutine measure_field

  !> Points below a contact of half width `a` about `middle`, to the depth 2 a.
  pure function scattered(a, middle) result(place)
    real(dp), intent(in) :: a, middle(2)
    real(dp) :: place(3, POINTS)
    integer :: k

    do k = 1, POINTS
      place(:2, k) = middle + a*(2.0_dp*modulo(0.6180339887_dp*k, 1.0_dp) - 1.0_dp)
      place(3, k) = 2.0_dp*a*real(k, dp)/real(POINTS, dp)
    end do
  end function scattered

  pure function depths_of(a) result(depth)
    real(dp), intent(in) :: a
    real(dp) :: depth(DEPTHS)
    integer :: k

    depth = [(2.0_dp*a*real(k, dp)/real(DEPTHS, dp), k=1, DEPTHS)]
  end function depths_of

  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    write (output_unit, '(a)') trim(info%message)
    error stop 'a call has failed or warned'
  end subroutine check

end program costs
