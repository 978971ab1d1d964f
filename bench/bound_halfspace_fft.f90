!> Time of a product of the half-space by FFT, of its preconditioner and of setting it, against plain transforms: one
!> forward and one backward two-dimensional transform by FFTW (r2c and c2r, in place, estimated) of the cells and as
!> many zeros in each direction, or for a periodic surface of the cells. No multiplication, no copy to the padded array.
!>
!> Prints rows | problem | bound | fuge | ratio | wanted | to standard output, times in milliseconds. Both sides
!> alternate and the least time of each counts, because other programs may run. Arguments: sizes n of grids n x n.
program bound_halfspace_fft
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_loc, c_ptr
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, FUGE_FREE, FUGE_PERIODIC
  implicit none

  interface
    function plan_r2c(rows, columns, in, out, flags) bind(c, name='fftw_plan_dft_r2c_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), value :: rows, columns, flags
      type(c_ptr), value :: in, out
      type(c_ptr) :: plan
    end function plan_r2c

    function plan_c2r(rows, columns, in, out, flags) bind(c, name='fftw_plan_dft_c2r_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), value :: rows, columns, flags
      type(c_ptr), value :: in, out
      type(c_ptr) :: plan
    end function plan_c2r

    subroutine execute(plan) bind(c, name='fftw_execute')
      import :: c_ptr
      type(c_ptr), value :: plan
    end subroutine execute

    subroutine destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), value :: plan
    end subroutine destroy_plan
  end interface

  integer(c_int), parameter :: ESTIMATE = 64
  integer, parameter :: SIZES(5) = [256, 512, 1000, 1024, 2048]
  character(len=20) :: argument
  integer :: k, n

  do k = 1, size(SIZES)
    if (command_argument_count() == 0) call measure(SIZES(k))
  end do
  do k = 1, command_argument_count()
    call get_command_argument(k, argument)
    read (argument, *) n
    call measure(n)
  end do

contains

  subroutine measure(n)
    integer, intent(in) :: n

    call measure_surface('free', n, 2*n, FUGE_FREE)
    call measure_surface('periodic', n, n, FUGE_PERIODIC)
  end subroutine measure

  !> A grid of `n` x `n`, a circle of `length` in each direction.
  subroutine measure_surface(name, n, length, boundary)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, length, boundary
    type(fuge_halfspace_operator) :: surface
    type(fuge_info) :: info
    type(c_ptr) :: forward, backward
    real(c_double), allocatable, target :: padded(:, :)
    real(dp), allocatable :: force(:), displacement(:)
    real(dp) :: start, bound, set, product, precondition
    character(len=60) :: what
    integer :: k, status

    allocate (padded(length + 2, length), force(n*n), displacement(n*n))
    padded = 0.0_dp
    call random_number(force)
    forward = plan_r2c(length, length, c_loc(padded), c_loc(padded), ESTIMATE)
    backward = plan_c2r(length, length, c_loc(padded), c_loc(padded), ESTIMATE)
    padded = 0.0_dp
    bound = huge(bound)
    set = huge(set)
    product = huge(product)
    precondition = huge(precondition)
    do k = 1, max(3, min(20, 10*1024**2/n**2))
      start = seconds()
      call execute(forward)
      call execute(backward)
      bound = min(bound, seconds() - start)
      if (k <= 3) then
        start = seconds()
        call surface%set(n, n, 1.0_dp, 1.0_dp, 1.0_dp, info, boundary=boundary)
        set = min(set, seconds() - start)
        call surface%apply(force, displacement, status)
      end if
      start = seconds()
      call surface%apply(force, displacement, status)
      product = min(product, seconds() - start)
      start = seconds()
      call surface%precondition(force, displacement, status)
      precondition = min(precondition, seconds() - start)
    end do
    call destroy_plan(forward)
    call destroy_plan(backward)
    if (info%failed() .or. status /= 0) error stop 'no product'
    write (what, '(a,i0,a,i0,2a)') '| ', n, ' x ', n, ', ', name
    call write_row(trim(what)//': product', bound, product)
    call write_row(trim(what)//': preconditioner', bound, precondition)
    call write_row(trim(what)//': set', bound, set)
  end subroutine measure_surface

  !> CPU time.
  function seconds() result(time)
    real(dp) :: time

    call cpu_time(time)
  end function seconds

  subroutine write_row(name, bound, time)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: bound, time

    print '(2a,f9.2,a,f9.2,a,f7.2,a)', name, ' |', 1.0e3_dp*bound, ' ms |', 1.0e3_dp*time, ' ms |', time/bound, ' | - |'
  end subroutine write_row

end program bound_halfspace_fft
