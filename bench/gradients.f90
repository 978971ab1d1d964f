!> Gradients over all gaps beside derivatives in one direction: time and products.
!>
!>     gradients
!>
!> Matrices of half-planes and random ones, then lines and areas by FFT to a tolerance of 1e-10. The derivative is that
!> by a change of all gaps, the first gradient that of an objective with the same numbers as weights of the forces, so
!> that both solve the same equations; the second one has weights of the gaps too. Writes a Markdown table. One thread.
program gradients
  use bench_problems, only: add_matrix, bench_problem, contact_problem, make_known, make_random, uniform_edges, whole
  use bench_surfaces, only: bench_surface, make_surface
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_gradients, fuge_halfplane_operator, &
    fuge_halfspace_operator, fuge_info, fuge_operator, fuge_options, fuge_problem, fuge_solution, fuge_solve_adjoint, &
    fuge_solver, FUGE_MEAN
  implicit none

  integer, parameter :: SIZES(4) = [200, 500, 1000, 2000], CELLS(3) = [128, 512, 1024], LINES(2) = [4096, 65536]
  character(len=10), parameter :: SURFACES(3) = [character(len=10) :: 'sphere', 'light_area', 'heavy_area']
  real(dp), parameter :: TOLERANCE = 1.0e-10_dp

  call run()

contains

  subroutine run()
    type(bench_problem), target :: known
    type(bench_surface) :: surface
    integer :: j, k

    write (*, '(a)') '| problem | points | in contact | derivative | gradient, weights of forces | of gaps too | ' &
      //'products |'
    write (*, '(a)') '| --- | ---: | ---: | ---: | ---: | ---: | ---: |'
    do k = 1, size(SIZES)
      call make_known('quartic', FUGE_MEAN, uniform_edges(SIZES(k)), known)
      call add_matrix(known)
      call print_matrix(known)
    end do
    do k = 1, size(SIZES)
      call make_random(SIZES(k), known)
      call print_matrix(known)
    end do
    do k = 1, size(LINES)
      call print_line(LINES(k))
    end do
    do j = 1, size(SURFACES)
      do k = 1, size(CELLS)
        call make_surface(trim(SURFACES(j)), CELLS(k), surface)
        call print_surface(surface)
      end do
    end do
  end subroutine run

  subroutine print_matrix(known)
    type(bench_problem), intent(in), target :: known
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info

    call operator%set(known%alpha, info)
    call print_row(trim(known%name)//', matrix', operator, contact_problem(known), .false.)
  end subroutine print_matrix

  !> A parabola on a half-plane.
  subroutine print_line(n)
    integer, intent(in) :: n
    type(fuge_halfplane_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_info) :: info
    integer :: k

    call operator%set(n, 2.0_dp/real(n, dp), 1.0_dp, info)
    problem%gap = [(0.5_dp*(real(2*k - n - 1, dp)/real(n, dp))**2, k=1, n)]
    problem%resultant = [0.3_dp]
    call print_row('parabola, line', operator, problem, .true.)
  end subroutine print_line

  subroutine print_surface(surface)
    type(bench_surface), intent(in) :: surface
    type(fuge_halfspace_operator) :: operator
    type(fuge_info) :: info

    call operator%set(surface%n, surface%n, surface%cell(), surface%cell(), 1.0_dp, info, boundary=surface%boundary)
    call print_row(trim(surface%name), operator, surface%contact(), .true.)
  end subroutine print_surface

  subroutine print_row(name, operator, problem, by_fft)
    character(len=*), intent(in) :: name
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: by_fft
    type(fuge_solver) :: solver
    type(fuge_solution) :: by_forces, by_gaps, change, solution
    type(fuge_info) :: info
    real(dp), allocatable :: direction(:)
    type(stopwatch) :: of_derivative, of_gradient(2)
    integer :: k, products(3)

    call solver%solve(operator, problem, solution, info, fuge_options(tolerance=TOLERANCE))
    if (info%failed()) error stop 'not solved'
    direction = [(cos(0.37_dp*real(k, dp)), k=1, size(problem%gap))]
    by_forces%force = direction
    by_gaps%force = direction
    by_gaps%gap = direction
    products = info%products
    do while (.not. of_derivative%enough())
      call of_derivative%start()
      call solver%derivative(operator, -direction, 0.0_dp, change, info)
      call of_derivative%stop()
      if (info%failed()) error stop 'no derivative'
    end do
    products(1) = info%products - products(1)
    call time_gradient(solver, operator, problem, solution, by_forces, of_gradient(1), products(2))
    call time_gradient(solver, operator, problem, solution, by_gaps, of_gradient(2), products(3))
    write (*, '(a,3(f0.3,a))', advance='no') '| '//name//' | '//whole(operator%points())//' | ' &
      //whole(count(solution%force > 0.0_dp))//' | ', 1.0e3_dp*of_derivative%best, ' ms | ', &
      of_gradient(1)%best/of_derivative%best, ' | ', of_gradient(2)%best/of_derivative%best, ' | '
    if (by_fft) then
      write (*, '(a)') whole(products(1))//', '//whole(products(2))//', '//whole(products(3))//' |'
    else
      write (*, '(a)') 'none |'
    end if
  end subroutine print_row

  !> The gradient of the objective with the weights `weight`; `products` those of the solve before, and its own after.
  subroutine time_gradient(solver, operator, problem, solution, weight, watch, products)
    type(fuge_solver), intent(in) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, weight
    type(stopwatch), intent(inout) :: watch
    integer, intent(inout) :: products
    type(fuge_gradients) :: found
    type(fuge_info) :: info

    do while (.not. watch%enough())
      call watch%start()
      call fuge_solve_adjoint(solver, operator, problem, solution, weight, found, info)
      call watch%stop()
      if (info%failed()) error stop 'no gradient'
    end do
    products = info%products - products
  end subroutine time_gradient

end program gradients
