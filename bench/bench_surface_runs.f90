!> Repeated solves of a contact on an area: the first of an operator, and the following ones; and what bounds them.
module bench_surface_runs
  use bench_records, only: bench_row, element_name
  use bench_surfaces, only: bench_surface, set_operator
  use bench_transforms, only: forget_wisdom, grid_transform
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_FREE, FUGE_ITERATIVE
  use fuge_fft, only: good_length
  implicit none
  private

  public :: new_area_row, run_area, time_products

  !> The times of an operator and of its solves.
  type :: area_watches
    type(stopwatch) :: setup, first, repeated
  end type area_watches

  !> A first solve that takes more seconds than this counts as a repeated one too.
  real(dp), parameter :: LONG = 10.0_dp

contains

  function new_area_row(surface) result(row)
    type(bench_surface), intent(in) :: surface
    type(bench_row) :: row

    row%problem = surface%name
    row%method = 'iterative_fft'
    row%n = size(surface%gap)
    row%element = element_name(surface%element)
  end function new_area_row

  !> Times and products of solves to `tolerance`. `force` (n*n): the answer, if there is one. `threads`: elapsed times
  !> of solves by as many; without it processor times of one.
  subroutine run_area(surface, tolerance, row, force, threads)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: tolerance
    type(bench_row), intent(inout) :: row
    real(dp), allocatable, intent(out), optional :: force(:)
    integer, intent(in), optional :: threads
    type(area_watches) :: watches
    type(fuge_options) :: options
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    options = fuge_options(FUGE_ITERATIVE, tolerance=tolerance)
    if (present(threads)) then
      options%threads = threads
      watches%setup%elapsed = .true.
      watches%first%elapsed = .true.
      watches%repeated%elapsed = .true.
    end if
    do while (.not. watches%first%enough())
      call solve_twice(surface, options, watches, solution, info)
      if (info%failed()) exit
    end do
    row%tolerance = tolerance
    row%setup = watches%setup%best
    row%first = watches%first%best
    row%time = watches%first%best - watches%setup%best
    if (watches%repeated%runs > 0) row%time = watches%repeated%best
    row%work = info%products
    row%preconditionings = info%preconditionings
    row%failure = ''
    if (info%status /= 0) row%failure = info%message(:len(row%failure))
    if (present(force) .and. .not. info%failed()) call move_alloc(solution%force, force)
  end subroutine run_area

  !> By a new operator and, unless that takes long, by the same again, each time by a new solver.
  subroutine solve_twice(surface, options, watches, solution, info)
    type(bench_surface), intent(in) :: surface
    type(fuge_options), intent(in) :: options
    type(area_watches), intent(inout) :: watches
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_halfspace_operator) :: operator
    type(fuge_problem) :: contact

    contact = surface%contact()
    ! A first solve would not have what FFTW remembers of earlier plans.
    call forget_wisdom()
    call watches%first%start()
    call watches%setup%start()
    call set_operator(surface, operator)
    call watches%setup%stop()
    call solve_cold(operator, contact, options, solution, info)
    call watches%first%stop()
    if (info%failed() .or. watches%first%best > LONG) return
    call watches%repeated%start()
    call solve_cold(operator, contact, options, solution, info)
    call watches%repeated%stop()
  end subroutine solve_twice

  subroutine solve_cold(operator, contact, options, solution, info)
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: contact
    type(fuge_options), intent(in) :: options
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_solver) :: solver

    call solver%solve(operator, contact, solution, info, options)
  end subroutine solve_cold

  !> The least time of one product, and of one preconditioning: the operator's own, or a pair of bare transforms in
  !> place of the whole padded grid, forward and back. Call it between the solves that it bounds.
  subroutine time_products(surface, operator, product, preconditioning)
    type(bench_surface), intent(in) :: surface
    type(fuge_halfspace_operator), intent(in) :: operator
    type(stopwatch), intent(inout) :: product, preconditioning
    real(dp), allocatable :: force(:), displacement(:)
    integer, parameter :: RUNS = 3
    integer :: k, status

    allocate (force(size(surface%gap)), source=1.0_dp)
    allocate (displacement(size(surface%gap)), source=0.0_dp)
    do k = 1, RUNS
      call product%start()
      call operator%apply(force, displacement, status)
      call product%stop()
      if (status /= 0) error stop 'no product'
      call preconditioning%start()
      call operator%precondition(force, displacement, status)
      call preconditioning%stop()
      if (status /= 0) error stop 'no preconditioning'
    end do
    deallocate (force, displacement)
    if (surface%boundary == FUGE_FREE) then
      call time_pairs(good_length(2*surface%n - 1), RUNS, product)
      call time_pairs(good_length(surface%n), RUNS, preconditioning)
    else
      call time_pairs(surface%n, RUNS, product)
      call time_pairs(surface%n, RUNS, preconditioning)
    end if
  end subroutine time_products

  !> Pairs of bare transforms of length x length numbers, in place.
  subroutine time_pairs(length, runs, watch)
    integer, intent(in) :: length, runs
    type(stopwatch), intent(inout) :: watch
    type(grid_transform) :: transform
    integer :: k

    call transform%create(length, length)
    do k = 1, runs
      call watch%start()
      call transform%forward()
      call transform%backward()
      call watch%stop()
      transform%values = 0.0_dp
    end do
    call transform%free()
  end subroutine time_pairs

end module bench_surface_runs
