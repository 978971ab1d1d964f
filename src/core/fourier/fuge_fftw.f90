!> FFTW's procedures for double and single precision, as `fuge_fft` calls them, but for those of `fuge_fftw_planner`.
!>
!> src/variants/without_fftw/ has another module of this name, which takes its place where the library is built without
!> FFTW.
module fuge_fftw
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_size_t
  implicit none
  private

  public :: fftw_destroy_plan, fftw_execute_c2c, fftw_execute_c2r, fftw_execute_r2c, fftw_free, fftw_malloc, &
    fftw_plan_c2c, fftw_plan_c2r, fftw_plan_grid_c2r, fftw_plan_grid_r2c, fftw_plan_r2c, fftwf_destroy_plan, &
    fftwf_execute_c2c, fftwf_plan_c2c

  !> This library can transform.
  logical, parameter, public :: HAS_FFTW = .true.

  integer(c_int), parameter, public :: FFTW_FORWARD = -1
  integer(c_int), parameter, public :: FFTW_MEASURE = 0
  integer(c_int), parameter, public :: FFTW_ESTIMATE = 64
  !> FFTW may not copy parts of long transforms to buffers: in place, copying only costs time.
  integer(c_int), parameter, public :: FFTW_NO_BUFFERING = 2048

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

    function fftw_plan_c2c(n, in, out, sign, flags) bind(c, name='fftw_plan_dft_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, sign, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_c2c

    function fftw_plan_r2c(n, in, out, flags) bind(c, name='fftw_plan_dft_r2c_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_r2c

    function fftw_plan_c2r(n, in, out, flags) bind(c, name='fftw_plan_dft_c2r_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_c2r

    !> `n` counts along the second dimension of a Fortran array, `m` along the first.
    function fftw_plan_grid_r2c(n, m, in, out, flags) bind(c, name='fftw_plan_dft_r2c_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, m, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_grid_r2c

    function fftw_plan_grid_c2r(n, m, in, out, flags) bind(c, name='fftw_plan_dft_c2r_2d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, m, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftw_plan_grid_c2r

    subroutine fftw_execute_c2c(plan, in, out) bind(c, name='fftw_execute_dft')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_c2c

    subroutine fftw_execute_r2c(plan, in, out) bind(c, name='fftw_execute_dft_r2c')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_r2c

    subroutine fftw_execute_c2r(plan, in, out) bind(c, name='fftw_execute_dft_c2r')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_c2r

    subroutine fftw_destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_destroy_plan

    function fftwf_plan_c2c(n, in, out, sign, flags) bind(c, name='fftwf_plan_dft_1d') result(plan)
      import :: c_int, c_ptr
      integer(c_int), intent(in), value :: n, sign, flags
      type(c_ptr), intent(in), value :: in, out
      type(c_ptr) :: plan
    end function fftwf_plan_c2c

    subroutine fftwf_execute_c2c(plan, in, out) bind(c, name='fftwf_execute_dft')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftwf_execute_c2c

    subroutine fftwf_destroy_plan(plan) bind(c, name='fftwf_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftwf_destroy_plan
  end interface

end module fuge_fftw
