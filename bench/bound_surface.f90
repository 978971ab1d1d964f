!> Solves on areas beside their bounds: the products and preconditionings that a solve makes, or as many pairs of bare
!> transforms if these are faster; a repeated solve for the first of an operator; the window of the contact for a
!> sphere that touches 1 % of the grid.
!>
!> Prints rows | problem | bound | fuge | ratio | wanted | to standard output, times in milliseconds. Both sides
!> alternate and the least time of each counts, because other programs may run.
program bound_surface
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_problems, only: whole
  use bench_surface_runs, only: time_products
  use bench_surfaces, only: bench_surface, make_sphere, make_surface, set_operator
  use bench_transforms, only: forget_wisdom
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_options, fuge_problem, fuge_solution, &
    fuge_solver, FUGE_CENTRE, FUGE_ITERATIVE
  implicit none

  !> Largest wanted ratios: of a solve, of a first solve, of a contact that fills 1 % of the grid.
  real(dp), parameter :: WANTED = 1.5_dp, WANTED_FIRST = 1.5_dp, WANTED_PART = 2.0_dp
  !> Tolerances of the sphere and of rough surfaces.
  real(dp), parameter :: OF_SPHERE = 1.0e-10_dp, OF_ROUGH = 1.0e-8_dp
  real(dp), parameter :: PI = acos(-1.0_dp)

  call run()

contains

  subroutine run()
    print '(a)', '| problem | bound | fuge | ratio | wanted |', '| --- | ---: | ---: | ---: | ---: |'
    call measure_first('sphere', 64, 20)
    call measure_first('sphere', 256, 5)
    call measure_first('heavy_area', 256, 5)
    call measure_first('heavy_area', 1024, 2)
    call measure_solve('sphere', 256, 5)
    call measure_solve('sphere', 1024, 2)
    call measure_solve('light_area', 1024, 2)
    call measure_solve('heavy_area', 1024, 2)
    call measure_part(1024, 3)
  end subroutine run

  pure function options_for(surface) result(options)
    type(bench_surface), intent(in) :: surface
    type(fuge_options) :: options

    options = fuge_options(FUGE_ITERATIVE, tolerance=merge(OF_SPHERE, OF_ROUGH, surface%contact_radius > 0.0_dp))
  end function options_for

  subroutine solve_once(surface, operator, info)
    type(bench_surface), intent(in) :: surface
    type(fuge_halfspace_operator), intent(in) :: operator
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver

    contact = surface%contact()
    call solver%solve(operator, contact, solution, info, options_for(surface))
    if (info%failed()) error stop 'not solved'
  end subroutine solve_once

  !> A solve by a new solver, the operator given; its transforms alternate with it.
  subroutine measure_solve(name, n, repeats)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, repeats
    type(bench_surface) :: surface
    type(fuge_halfspace_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: solve, product, preconditioning
    integer :: k

    call make_surface(name, n, surface)
    call set_operator(surface, operator)
    call solve_once(surface, operator, info)
    do k = 1, repeats
      call time_products(surface, operator, product, preconditioning)
      call solve%start()
      call solve_once(surface, operator, info)
      call solve%stop()
    end do
    call print_row(title(name, n)//', '//whole(info%products)//' + '//whole(info%preconditionings)//' transforms', &
                   real(info%products, dp)*product%best + real(info%preconditionings, dp)*preconditioning%best, &
                   solve%best, WANTED)
  end subroutine measure_solve

  !> The first solve of an operator and a repeated one in turn.
  subroutine measure_first(name, n, repeats)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, repeats
    type(bench_surface) :: surface
    type(fuge_halfspace_operator), allocatable :: operator
    type(fuge_info) :: info
    type(stopwatch) :: first, repeated
    integer :: k

    call make_surface(name, n, surface)
    do k = 1, repeats
      allocate (operator)
      ! A first solve would not have what FFTW remembers of earlier plans.
      call forget_wisdom()
      call set_operator(surface, operator)
      call first%start()
      call solve_once(surface, operator, info)
      call first%stop()
      call repeated%start()
      call solve_once(surface, operator, info)
      call repeated%stop()
      deallocate (operator)
    end do
    call print_row(title(name, n)//', first solve', repeated%best, first%best, WANTED_FIRST)
  end subroutine measure_first

  !> A sphere that touches 1 % of n x n cells, and the square around its contact alone, each with its operator.
  subroutine measure_part(n, repeats)
    integer, intent(in) :: n, repeats
    type(bench_surface) :: whole_grid, window
    type(fuge_halfspace_operator) :: operator, small
    type(fuge_info) :: info
    type(stopwatch) :: all_cells, own_cells
    real(dp) :: radius
    integer :: k, cells

    radius = sqrt(0.01_dp/PI)
    call make_sphere(n, FUGE_CENTRE, whole_grid, radius=radius)
    ! An even number, so that the cells are the same, with one that is open on each side.
    cells = 2*(ceiling(radius*real(n, dp)) + 1)
    call make_sphere(cells, FUGE_CENTRE, window, side=real(cells, dp)/real(n, dp), radius=radius)
    call set_operator(whole_grid, operator)
    call set_operator(window, small)
    do k = 1, repeats
      call all_cells%start()
      call solve_once(whole_grid, operator, info)
      call all_cells%stop()
      call own_cells%start()
      call solve_once(window, small, info)
      call own_cells%stop()
    end do
    call print_row('sphere on 1 % of '//whole(n)//' x '//whole(n)//', over '//whole(cells)//' x '//whole(cells), &
                   own_cells%best, all_cells%best, WANTED_PART)
  end subroutine measure_part

  function title(name, n) result(words)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    character(len=:), allocatable :: words

    words = name
    if (name /= 'sphere') words = 'rough, '//name(:index(name, '_') - 1)
    words = words//', '//whole(n)//' x '//whole(n)
  end function title

  subroutine print_row(words, bound, time, wanted_ratio)
    character(len=*), intent(in) :: words
    real(dp), intent(in) :: bound, time, wanted_ratio

    print '(a, 2(f0.2, a), f0.2, a, f0.1, a)', '| '//words//' | ', 1.0e3_dp*bound, ' ms | ', 1.0e3_dp*time, ' ms | ', &
      time/bound, ' | ', wanted_ratio, ' |'
    flush (output_unit)
  end subroutine print_row

end program bound_surface
