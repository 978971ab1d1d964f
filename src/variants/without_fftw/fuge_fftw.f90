!> What `fuge_fft` calls where the library is built without FFTW (FUGE_WITH_FFTW=OFF): there is no memory, and no plan.
!>
!> It takes the place of src/core/fourier/fuge_fftw.f90, and lies outside of src/core/ because fpm compiles all
!> that is there. The names, arguments and constants are those of that module. Nothing is executed: `set` of an
!> `fft_plan` asks HAS_FFTW and refuses.
module fuge_fftw
  use, intrinsic :: iso_c_binding, only: c_int, c_null_ptr, c_ptr, c_size_t
  implicit none
  private

  public :: fftw_destroy_plan, fftw_execute_c2c, fftw_execute_c2r, fftw_execute_r2c, fftw_free, fftw_malloc, &
    fftw_plan_c2c, fftw_plan_c2r, fftw_plan_grid_c2r, fftw_plan_grid_r2c, fftw_plan_r2c, fftwf_destroy_plan, &
    fftwf_execute_c2c, fftwf_plan_c2c

  !> This library cannot transform.
  logical, parameter, public :: HAS_FFTW = .false.

  integer(c_int), parameter, public :: FFTW_FORWARD = -1
  integer(c_int), parameter, public :: FFTW_MEASURE = 0
  integer(c_int), parameter, public :: FFTW_ESTIMATE = 64
  !> FFTW may not copy parts of long transforms to buffers: in place, copying only costs time.
  integer(c_int), parameter, public :: FFTW_NO_BUFFERING = 2048

contains

  pure function fftw_malloc(bytes) result(memory)
    integer(c_size_t), intent(in), value :: bytes
    type(c_ptr) :: memory

    memory = c_null_ptr
  end function fftw_malloc

  pure subroutine fftw_free(memory)
    type(c_ptr), intent(in), value :: memory
  end subroutine fftw_free

  pure function fftw_plan_c2c(n, in, out, sign, flags) result(plan)
    integer(c_int), intent(in), value :: n, sign, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftw_plan_c2c

  pure function fftw_plan_r2c(n, in, out, flags) result(plan)
    integer(c_int), intent(in), value :: n, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftw_plan_r2c

  pure function fftw_plan_c2r(n, in, out, flags) result(plan)
    integer(c_int), intent(in), value :: n, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftw_plan_c2r

  pure function fftw_plan_grid_r2c(n, m, in, out, flags) result(plan)
    integer(c_int), intent(in), value :: n, m, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftw_plan_grid_r2c

  pure function fftw_plan_grid_c2r(n, m, in, out, flags) result(plan)
    integer(c_int), intent(in), value :: n, m, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftw_plan_grid_c2r

  pure subroutine fftw_execute_c2c(plan, in, out)
    type(c_ptr), intent(in), value :: plan, in, out
  end subroutine fftw_execute_c2c

  pure subroutine fftw_execute_r2c(plan, in, out)
    type(c_ptr), intent(in), value :: plan, in, out
  end subroutine fftw_execute_r2c

  pure subroutine fftw_execute_c2r(plan, in, out)
    type(c_ptr), intent(in), value :: plan, in, out
  end subroutine fftw_execute_c2r

  pure subroutine fftw_destroy_plan(plan)
    type(c_ptr), intent(in), value :: plan
  end subroutine fftw_destroy_plan

  pure function fftwf_plan_c2c(n, in, out, sign, flags) result(plan)
    integer(c_int), intent(in), value :: n, sign, flags
    type(c_ptr), intent(in), value :: in, out
    type(c_ptr) :: plan

    plan = c_null_ptr
  end function fftwf_plan_c2c

  pure subroutine fftwf_execute_c2c(plan, in, out)
    type(c_ptr), intent(in), value :: plan, in, out
  end subroutine fftwf_execute_c2c

  pure subroutine fftwf_destroy_plan(plan)
    type(c_ptr), intent(in), value :: plan
  end subroutine fftwf_destroy_plan

end module fuge_fftw
