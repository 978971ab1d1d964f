!> FFTW's procedures for a planner that several threads share.
!>
!> MKL has FFTW's interface without them. Where they are missing another module of this name, in without_fftw/, takes
!> the place of this one.
module fuge_fftw_planner
  use, intrinsic :: iso_c_binding, only: c_int
  implicit none
  private

  public :: fftw_make_planner_thread_safe, fftw_planner_nthreads

  interface
    subroutine fftw_make_planner_thread_safe() bind(c, name='fftw_make_planner_thread_safe')
    end subroutine fftw_make_planner_thread_safe

    function fftw_planner_nthreads() bind(c, name='fftw_planner_nthreads') result(threads)
      import :: c_int
      integer(c_int) :: threads
    end function fftw_planner_nthreads
  end interface

end module fuge_fftw_planner
