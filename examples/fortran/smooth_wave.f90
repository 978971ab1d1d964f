!> A user-defined profile: one wave crest.
module smooth_wave
  use fuge, only: dp => fuge_dp, fuge_smooth_profile
  implicit none
  private

  !> Initial gap amplitude (1 - cos(number x)); length, 1/length.
  type, extends(fuge_smooth_profile), public :: wave_crest
    real(dp) :: amplitude = 0.0_dp, number = 0.0_dp
  contains
    procedure :: evaluate
  end type wave_crest

contains

  subroutine evaluate(self, x, gap, slope, status)
    class(wave_crest), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status

    ! 1 - cos loses digits near the crest.
    gap = 2.0_dp*self%amplitude*sin(0.5_dp*self%number*x)**2
    slope = self%amplitude*self%number*sin(self%number*x)
    status = 0
  end subroutine evaluate

end module smooth_wave
