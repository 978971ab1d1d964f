!> Proofs of solutions beside solves from cold: time, bounds and their estimates.
!>
!>     proofs
!>
!> Matrices of half-planes and random ones, then lines and areas by FFT to a tolerance of 1e-10. Writes two Markdown
!> tables. One thread.
program proofs
  use bench_problems, only: add_matrix, bench_problem, contact_problem, make_known, make_random, uniform_edges, whole
  use bench_surfaces, only: bench_surface, make_surface
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_halfspace_operator, fuge_info, &
    fuge_operator, fuge_options, fuge_problem, fuge_proof, fuge_prove, fuge_solution, fuge_solver, FUGE_MEAN
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

    write (*, '(a)') '| matrix | n | in contact | solve | proof | over solve | largest bound of a force ' &
      //'| of the approach |'
    write (*, '(a)') '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do k = 1, size(SIZES)
      call make_known('quartic', FUGE_MEAN, uniform_edges(SIZES(k)), known)
      call add_matrix(known)
      call print_matrix(known)
    end do
    do k = 1, size(SIZES)
      call make_random(SIZES(k), known)
      call print_matrix(known)
    end do
    write (*, '(/,a)') '| by FFT | cells | in contact | solve | proof | over solve | products | largest bound of a ' &
      //'force | estimate | of the approach |'
    write (*, '(a)') '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
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
    type(fuge_problem) :: problem
    type(fuge_info) :: info

    call operator%set(known%alpha, info)
    problem = contact_problem(known)
    call print_row(trim(known%name), operator, problem, .false.)
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

  !> Solve with new solvers, prove, and print. Bounds are relative to the largest force and to the approach.
  subroutine print_row(name, operator, problem, by_fft)
    character(len=*), intent(in) :: name
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: by_fft
    type(fuge_solver), allocatable :: solver
    type(fuge_solution) :: solution
    type(fuge_proof) :: proof
    type(fuge_info) :: info, solve_info
    type(stopwatch) :: of_proof, of_solve
    real(dp) :: largest
    integer :: contacts

    do while (.not. of_solve%enough())
      allocate (solver)
      call of_solve%start()
      call solver%solve(operator, problem, solution, solve_info, fuge_options(tolerance=TOLERANCE))
      call of_solve%stop()
      if (solve_info%failed()) error stop 'not solved'
      deallocate (solver)
    end do
    do while (.not. of_proof%enough())
      call of_proof%start()
      call fuge_prove(operator, problem, solution, proof, info)
      call of_proof%stop()
      if (info%failed()) error stop 'no proof'
    end do
    contacts = solve_info%contacts
    largest = maxval(solution%force)
    write (*, '(a,2(f0.3,a),f0.2)', advance='no') '| '//name//' | '//whole(operator%points())//' | ' &
      //whole(contacts)//' | ', 1.0e3_dp*of_solve%best, ' ms | ', 1.0e3_dp*of_proof%best, ' ms | ', &
      of_proof%best/of_solve%best
    if (by_fft) then
      write (*, '(a,3(es7.1,a))') ' | '//whole(info%products)//' | ', maxval(proof%force_bound)/largest, ' | ', &
        solve_info%force_error, ' | ', proof%motion_bound(1)/abs(solution%motion(1)), ' |'
    else
      write (*, '(a,2(es7.1,a))') ' | ', maxval(proof%force_bound)/largest, ' | ', &
        proof%motion_bound(1)/abs(solution%motion(1)), ' |'
    end if
  end subroutine print_row

end program proofs
