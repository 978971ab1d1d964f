!> FFTW's procedures for a planner that several threads share, and for other threads than FFTW's own.
!>
!> MKL has FFTW's interface without them. Where they are missing another module of this name, in
!> src/variants/without_fftw/, takes the place of this one.
module fuge_fftw_planner
  use, intrinsic :: iso_c_binding, only: c_funptr, c_int, c_ptr
  implicit none
  private

  public :: fftw_make_planner_thread_safe, fftw_planner_nthreads, fftw_threads_set_callback, &
    fftwf_make_planner_thread_safe

  interface
    subroutine fftw_make_planner_thread_safe() bind(c, name='fftw_make_planner_thread_safe')
    end subroutine fftw_make_planner_thread_safe

    subroutine fftwf_make_planner_thread_safe() bind(c, name='fftwf_make_planner_thread_safe')
    end subroutine fftwf_make_planner_thread_safe

    function fftw_planner_nthreads() bind(c, name='fftw_planner_nthreads') result(threads)
      import :: c_int
      integer(c_int) :: threads
    end function fftw_planner_nthreads

    !> Let `run` do the jobs of a transform in threads, with `data` as its last argument.
    subroutine fftw_threads_set_callback(run, data) bind(c, name='fftw_threads_set_callback')
      import :: c_funptr, c_ptr
      type(c_funptr), intent(in), value :: run
      type(c_ptr), intent(in), value :: data
    end subroutine fftw_threads_set_callback
  end interface

end module fuge_fftw_planner
