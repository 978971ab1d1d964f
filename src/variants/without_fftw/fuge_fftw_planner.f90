!> What `fuge_fft` calls where FFTW's procedure for a shared planner is missing: with MKL, and without FFTW.
!>
!> It takes the place of src/core/fourier/fuge_fftw_planner.f90. MKL needs no lock but that of `fuge_fft`.
module fuge_fftw_planner
  implicit none
  private

  public :: fftw_make_planner_thread_safe, fftwf_make_planner_thread_safe

contains

  pure subroutine fftw_make_planner_thread_safe()
  end subroutine fftw_make_planner_thread_safe

  pure subroutine fftwf_make_planner_thread_safe()
  end subroutine fftwf_make_planner_thread_safe

end module fuge_fftw_planner
