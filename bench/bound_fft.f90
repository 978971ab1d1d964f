!> The FFT engine over its bound: the transforms that a solve makes. In one run, on one thread.
!>
!>     bound_fft [quick]
!>
!> Prints rows | problem | bound | fuge | ratio | wanted |, times in ms. The bound of a solve is as many pairs
!> of bare transforms, forward and back, as it makes products and preconditionings, of the padded lengths of
!> these; those on coarser grids count as fractions. A first solve, of an operator just set, has a repeated
!> one as its bound, of the same operator by a new solver.
program bound_fft
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_problems, only: bench_problem, contact_problem, make_known, make_rough, uniform_edges
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfplane_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver, &
    FUGE_FREE, FUGE_MEAN
  use fuge_fft, only: good_length
  implicit none

  interface
    function fftw_malloc(bytes) bind(c, name='fftw_malloc') result(memory)
      import :: c_ptr, c_size_t
      integer(c_size_t), intent(in), value :: bytes
      type(c_ptr) :: memory
    end function fftw_malloc

    subroutine fftw_free(memory) bind(c, name='fftw_free')
      import :: c_ptr
      type(c_ptr), intent(in), value :: memory
    end subroutine fftw_free

    function plan_r2c(n, in, out, flags) bind(c, name='fftw_plan_dft_r2c_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function plan_r2c

    function plan_c2r(n, in, out, flags) bind(c, name='fftw_plan_dft_c2r_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function plan_c2r

    subroutine fftw_execute(plan) bind(c, name='fftw_execute')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_execute

    subroutine forget_wisdom() bind(c, name='fftw_forget_wisdom')
    end subroutine forget_wisdom

    subroutine fftw_destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_destroy_plan
  end interface

  integer(c_int), parameter :: ESTIMATE = 64
  !> Mean pressures of the rough profiles.
  real(dp), parameter :: LIGHT = 0.005_dp, HEAVY = 0.05_dp
  !> Largest wanted ratios: of a solve on 2**16 and on 2**20 cells, of a first solve.
  real(dp), parameter :: WANTED_16 = 1.6_dp, WANTED_20 = 1.3_dp, WANTED_FIRST = 1.5_dp

  !> A pair of bare transforms in place.
  type :: transform_pair
    type(c_ptr) :: forward, backward, buffer
    type(stopwatch) :: watch
  end type transform_pair

  call run()

contains

  subroutine run()
    character(len=16) :: word

    call get_command_argument(1, word)
    print '(a)', '| problem | bound | fuge | ratio | wanted |', '| --- | ---: | ---: | ---: | ---: |'
    call measure_first('quartic', 4096, 30)
    call measure_first('heavy', 4096, 30)
    call measure_first('quartic', 65536, 10)
    call measure_all(16, 20, WANTED_16)
    if (word == '') call measure_all(20, 4, WANTED_20)
  end subroutine run

  subroutine measure_all(exponent, repeats, wanted)
    integer, intent(in) :: exponent, repeats
    real(dp), intent(in) :: wanted

    call measure_solve('quartic', 2**exponent, repeats, wanted)
    call measure_solve('light', 2**exponent, repeats, wanted)
    call measure_solve('heavy', 2**exponent, repeats, wanted)
  end subroutine measure_all

  subroutine make_problem(name, n, problem)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    type(bench_problem), intent(out) :: problem

    select case (name)
    case ('light')
      call make_rough(n, LIGHT, problem)
    case ('heavy')
      call make_rough(n, HEAVY, problem)
    case default
      call make_known(name, FUGE_MEAN, uniform_edges(n), problem)
    end select
  end subroutine make_problem

  !> A solve by a new solver, the operator given; its transforms alternate with it.
  subroutine measure_solve(name, n, repeats, wanted)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, repeats
    real(dp), intent(in) :: wanted
    type(bench_problem) :: problem
    type(fuge_halfplane_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: solve
    type(transform_pair) :: product, preconditioning
    character(len=40) :: title
    integer :: k

    call make_problem(name, n, problem)
    call set_operator(problem, operator)
    if (problem%boundary == FUGE_FREE) then
      product = new_pair(good_length(2*n - 1))
      preconditioning = new_pair(good_length(n))
    else
      product = new_pair(n)
      preconditioning = new_pair(n)
    end if
    call solve_once(problem, operator, info)
    do k = 1, repeats
      call time_pair(product)
      call solve%start()
      call solve_once(problem, operator, info)
      call solve%stop()
      call time_pair(preconditioning)
    end do
    write (title, '(2a, i0, a, i0, a, i0, a)') name, ', 2^', exponent(real(n)) - 1, ', ', info%products, ' + ', &
      info%preconditionings, ' transforms'
    call print_row(title, real(info%products, dp)*product%watch%best &
                   + real(info%preconditionings, dp)*preconditioning%watch%best, solve%best, wanted)
    call free_pair(product)
    call free_pair(preconditioning)
  end subroutine measure_solve

  !> The first solve of an operator and a repeated one in turn.
  subroutine measure_first(name, n, repeats)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, repeats
    type(bench_problem) :: problem
    type(fuge_halfplane_operator), allocatable :: operator
    type(fuge_info) :: info
    type(stopwatch) :: first, repeated
    character(len=40) :: title
    integer :: k

    call make_problem(name, n, problem)
    do k = 1, repeats
      allocate (operator)
      ! A first solve would not have what FFTW remembers of earlier plans.
      call forget_wisdom()
      call set_operator(problem, operator)
      call first%start()
      call solve_once(problem, operator, info)
      call first%stop()
      call repeated%start()
      call solve_once(problem, operator, info)
      call repeated%stop()
      deallocate (operator)
    end do
    write (title, '(2a, i0)') name, ', first solve, ', n
    call print_row(title, repeated%best, first%best, WANTED_FIRST)
  end subroutine measure_first

  subroutine set_operator(problem, operator)
    type(bench_problem), intent(in) :: problem
    type(fuge_halfplane_operator), intent(inout) :: operator
    type(fuge_info) :: info

    call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element, problem%boundary)
    if (info%failed()) error stop 'no operator of the half-plane'
  end subroutine set_operator

  subroutine solve_once(problem, operator, info)
    type(bench_problem), intent(in) :: problem
    type(fuge_halfplane_operator), intent(in) :: operator
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver

    contact = contact_problem(problem)
    call solver%solve(operator, contact, solution, info)
    if (info%status /= 0) error stop 'not solved'
  end subroutine solve_once

  function new_pair(length) result(pair)
    integer, intent(in) :: length
    type(transform_pair) :: pair

    pair%buffer = fftw_malloc(16_c_size_t*int(length/2 + 1, c_size_t))
    pair%forward = plan_r2c(int(length, c_int), pair%buffer, pair%buffer, ESTIMATE)
    pair%backward = plan_c2r(int(length, c_int), pair%buffer, pair%buffer, ESTIMATE)
    call clear(pair%buffer, length)
  end function new_pair

  subroutine clear(buffer, length)
    type(c_ptr), intent(in) :: buffer
    integer, intent(in) :: length
    real(c_double), pointer :: values(:)

    call c_f_pointer(buffer, values, [2*(length/2 + 1)])
    values = 0.0_dp
  end subroutine clear

  subroutine time_pair(pair)
    type(transform_pair), intent(inout) :: pair
    integer :: k

    do k = 1, 5
      call pair%watch%start()
      call fftw_execute(pair%forward)
      call fftw_execute(pair%backward)
      call pair%watch%stop()
    end do
  end subroutine time_pair

  subroutine free_pair(pair)
    type(transform_pair), intent(inout) :: pair

    call fftw_destroy_plan(pair%forward)
    call fftw_destroy_plan(pair%backward)
    call fftw_free(pair%buffer)
  end subroutine free_pair

  subroutine print_row(title, bound, time, wanted)
    character(len=*), intent(in) :: title
    real(dp), intent(in) :: bound, time, wanted

    print '(a, 2(f0.3, a), f0.2, a, f0.1, a)', '| '//trim(title)//' | ', 1.0e3_dp*bound, ' | ', 1.0e3_dp*time, ' | ', &
      time/bound, ' | ', wanted, ' |'
    flush (output_unit)
  end subroutine print_row

end program bound_fft
