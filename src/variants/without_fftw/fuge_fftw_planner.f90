!> What `fuge_fft` calls where FFTW's procedures for a shared planner are missing: with MKL, and without FFTW.
!>
!> It takes the place of src/core/numerics/fuge_fftw_planner.f90. MKL needs no lock but that of `fuge_fft`.
module fuge_fftw_planner
  use, intrinsic :: iso_c_binding, only: c_funptr, c_int, c_ptr
  implicit none
  private

  public :: fftw_make_planner_thread_safe, fftw_planner_nthreads, fftw_threads_set_callback, &
    fftwf_make_planner_thread_safe

contains

  pure subroutine fftw_make_planner_thread_safe()
  end subroutine fftw_make_planner_thread_safe

  pure subroutine fftwf_make_planner_thread_safe()
  end subroutine fftwf_make_planner_thread_safe

  !> One, because the number that the host program may have set is not known.
  pure function fftw_planner_nthreads() result(threads)
    integer(c_int) :: threads

    threads = 1
  end function fftw_planner_nthreads

  pure subroutine fftw_threads_set_callback(run, data)
    type(c_funptr), intent(in) :: run
    type(c_ptr), intent(in) :: data
  end subroutine fftw_threads_set_callback

end module fuge_fftw_planner
