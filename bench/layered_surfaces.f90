!> Rough surfaces on layered bodies: products of the iteration beside those on the half-space, and the time in which an
!> operator is made.
!>
!>     layered_surfaces [CELLS]
!>
!> A periodic self-affine surface of CELLS x CELLS cells (512 by default) is pressed on a film whose modulus is that of
!> the half-space of the first row; the body below the film is softer or stiffer. The tolerance is 1e-8. Writes two
!> Markdown tables. One thread.
program layered_surfaces
  use bench_problems, only: whole
  use bench_surfaces, only: bench_surface, make_surface
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_layered_body, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver, FUGE_FREE, FUGE_PERIODIC, FUGE_PERIODIC_X
  implicit none

  character(len=10), parameter :: LOADS(2) = [character(len=10) :: 'light_area', 'heavy_area']
  !> Modulus of the film over that of the body below, and thicknesses over the period.
  real(dp), parameter :: RATIOS(7) = [1.0e-3_dp, 1.0e-2_dp, 0.1_dp, 3.0_dp, 10.0_dp, 100.0_dp, 1000.0_dp]
  real(dp), parameter :: THICKNESSES(2) = [0.005_dp, 0.05_dp]
  real(dp), parameter :: TOLERANCE = 1.0e-8_dp, POISSON = 0.3_dp
  integer, parameter :: BOUNDARIES(3) = [FUGE_FREE, FUGE_PERIODIC, FUGE_PERIODIC_X], RUNS = 5
  character(len=20), parameter :: NAMES(3) = [character(len=20) :: 'free', 'periodic', 'periodic along x']

  call run()

contains

  subroutine run()
    type(bench_surface) :: surface(2)
    type(fuge_layered_body) :: body
    character(len=16) :: word
    integer :: bare(2), cells, j, k, status

    cells = 512
    if (command_argument_count() > 0) then
      call get_command_argument(1, word)
      read (word, *, iostat=status) cells
      if (status /= 0 .or. cells < 16) error stop 'usage: layered_surfaces [CELLS]'
    end if
    do k = 1, 2
      call make_surface(trim(LOADS(k)), cells, surface(k))
      bare(k) = products(surface(k), body)
    end do
    write (*, '(a)') '| film over body | thickness over period | products, light | over half-space | products, heavy ' &
      //'| over half-space |'
    write (*, '(a)') '| ---: | ---: | ---: | ---: | ---: | ---: |'
    write (*, '(a)') '| half-space | | '//whole(bare(1))//' | 1.00 | '//whole(bare(2))//' | 1.00 |'
    do j = 1, size(RATIOS)
      do k = 1, size(THICKNESSES)
        call set_film(RATIOS(j), THICKNESSES(k), body)
        write (*, '(a,f8.3,a,f5.3)', advance='no') '| ', RATIOS(j), ' | ', THICKNESSES(k)
        call print_products(surface, body, bare)
      end do
    end do
    call print_times(cells)
  end subroutine run

  subroutine set_film(ratio, thickness, body)
    real(dp), intent(in) :: ratio, thickness
    type(fuge_layered_body), intent(inout) :: body
    type(fuge_info) :: info

    call body%set([thickness], [1.0_dp, 1.0_dp/ratio]*(1.0_dp - POISSON**2), [POISSON, POISSON], info)
    if (info%failed()) error stop 'no film'
  end subroutine set_film

  subroutine print_products(surface, body, bare)
    type(bench_surface), intent(in) :: surface(2)
    type(fuge_layered_body), intent(in) :: body
    integer, intent(in) :: bare(2)
    integer :: count, k

    do k = 1, 2
      count = products(surface(k), body)
      write (*, '(a,f4.2)', advance='no') ' | '//whole(count)//' | ', real(count, dp)/real(bare(k), dp)
    end do
    write (*, '(a)') ' |'
  end subroutine print_products

  !> Of the iteration on the surface of `body`, or of the half-space if it is not set.
  function products(surface, body) result(count)
    type(bench_surface), intent(in) :: surface
    type(fuge_layered_body), intent(in) :: body
    integer :: count
    type(fuge_halfspace_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_options) :: options
    type(fuge_info) :: info

    options%tolerance = TOLERANCE
    problem = surface%contact()
    call set_operator(operator, surface%n, surface%cell(), surface%boundary, body)
    call solver%solve(operator, problem, solution, info, options)
    if (info%failed()) error stop 'not solved'
    count = info%products
  end function products

  subroutine set_operator(operator, cells, cell, boundary, body)
    type(fuge_halfspace_operator), intent(inout) :: operator
    integer, intent(in) :: cells, boundary
    real(dp), intent(in) :: cell
    type(fuge_layered_body), intent(in) :: body
    type(fuge_info) :: info

    if (body%is_set()) then
      call operator%set(cells, cells, cell, cell, body%e_star(), info, boundary=boundary, body=body%surface())
    else
      call operator%set(cells, cells, cell, cell, 1.0_dp, info, boundary=boundary)
    end if
    if (info%failed()) error stop 'no operator'
  end subroutine set_operator

  !> Time from the description of the grid to its kernels, which the first product computes: of a film ten times as
  !> stiff, and of the half-space, without the product.
  subroutine print_times(cells)
    integer, intent(in) :: cells
    type(fuge_layered_body) :: bare, film
    real(dp) :: time(2)
    integer :: k

    call set_film(10.0_dp, THICKNESSES(2), film)
    write (*, '(/,a,/,a)') '| '//whole(cells)//' x '//whole(cells)//' cells | half-space | film | over half-space |', &
      '| --- | ---: | ---: | ---: |'
    do k = 1, size(BOUNDARIES)
      time = [time_of_kernels(cells, BOUNDARIES(k), bare), time_of_kernels(cells, BOUNDARIES(k), film)]
      write (*, '(a,2(f0.1,a),f4.2,a)') '| '//trim(NAMES(k))//' | ', 1.0e3_dp*time(1), ' ms | ', 1.0e3_dp*time(2), &
        ' ms | ', time(2)/time(1), ' |'
    end do
  end subroutine print_times

  function time_of_kernels(cells, boundary, body) result(time)
    integer, intent(in) :: cells, boundary
    type(fuge_layered_body), intent(in) :: body
    real(dp) :: time
    type(fuge_halfspace_operator), allocatable :: operator
    type(stopwatch) :: first, second
    real(dp), allocatable :: force(:), displacement(:)
    integer :: k, status

    allocate (force(cells**2), source=1.0_dp)
    allocate (displacement(cells**2))
    do k = 1, RUNS
      allocate (operator)
      call first%start()
      call set_operator(operator, cells, 1.0_dp/real(cells, dp), boundary, body)
      call operator%apply(force, displacement, status)
      call first%stop()
      call second%start()
      call operator%apply(force, displacement, status)
      call second%stop()
      if (status /= 0) error stop 'no product'
      deallocate (operator)
    end do
    time = first%best - second%best
  end function time_of_kernels

end program layered_surfaces
