!> FFTW's procedure for a planner that the threads of a host program share.
!>
!> MKL has FFTW's interface without it. Where it is missing another module of this name, in src/variants/without_fftw/,
!> takes the place of this one.
module fuge_fftw_planner
  implicit none
  private

  public :: fftw_make_planner_thread_safe, fftwf_make_planner_thread_safe

  interface
    subroutine fftw_make_planner_thread_safe() bind(c, name='fftw_make_planner_thread_safe')
    end subroutine fftw_make_planner_thread_safe

    subroutine fftwf_make_planner_thread_safe() bind(c, name='fftwf_make_planner_thread_safe')
    end subroutine fftwf_make_planner_thread_safe
  end interface

end module fuge_fftw_planner
