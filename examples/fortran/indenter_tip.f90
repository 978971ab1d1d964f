!> The tip of a conical indenter that is no longer sharp: a hyperboloid.
module indenter_tip
  use fuge, only: dp => fuge_dp, fuge_smooth_profile
  implicit none
  private

  !> Initial gap sqrt(b**2 + (s r)**2) - b with the slope s of the cone and the tip's radius b/s**2.
  type, extends(fuge_smooth_profile), public :: blunt_cone
    real(dp) :: slope = 1.0_dp, tip_radius = 1.0_dp
  contains
    procedure :: evaluate
  end type blunt_cone

contains

  !> `x` the distance from the axis.
  subroutine evaluate(self, x, gap, slope, status)
    class(blunt_cone), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp) :: b, root(size(x))

    b = self%slope**2*self%tip_radius
    root = sqrt(b**2 + (self%slope*x)**2)
    gap = (self%slope*x)**2/(b + root)
    slope = self%slope**2*x/root
    status = 0
  end subroutine evaluate

end module indenter_tip
