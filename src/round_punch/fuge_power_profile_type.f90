!> Profiles of round punches as sums of powers of the radius, also of powers that are no integers.
module fuge_power_profile_type
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_WIDTH
  implicit none
  private

  !> Initial gap sum_k coefficients(k) r**powers(k), r >= 0; set the components by name, `upper` too. Powers >= 1:
  !> 1 for a cone, 2 for a paraboloid, any other one for a profile that a polynomial cannot follow at the axis.
  type, extends(fuge_smooth_profile), public :: fuge_power_profile
    !> Of the same size; for the power n, length per length**n.
    real(dp), allocatable :: coefficients(:), powers(:)
  contains
    procedure :: evaluate
  end type fuge_power_profile

contains

  !> `x` the radius, length; `gap` (size(x)) length and `slope` (size(x)) no unit. `status`: FUGE_DONE,
  !> FUGE_ERR_CALL_ORDER without coefficients or powers, FUGE_ERR_WIDTH for a power below 1.
  subroutine evaluate(self, x, gap, slope, status)
    class(fuge_power_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp) :: r(size(x)), power(size(x))
    integer :: k

    gap = 0.0_dp
    slope = 0.0_dp
    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%coefficients) .or. .not. allocated(self%powers)) return
    if (size(self%coefficients) /= size(self%powers)) return
    status = FUGE_ERR_WIDTH
    if (.not. all(self%powers >= 1.0_dp)) return
    status = FUGE_DONE
    r = max(0.0_dp, x)
    do k = 1, size(self%powers)
      power = self%coefficients(k)
      if (self%powers(k) > 1.0_dp) power = power*r**(self%powers(k) - 1.0_dp)
      gap = gap + power*r
      slope = slope + power*self%powers(k)
    end do
  end subroutine evaluate

end module fuge_power_profile_type
