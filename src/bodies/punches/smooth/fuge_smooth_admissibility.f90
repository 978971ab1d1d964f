!> Admissibility of a contact in one interval: the pressure must not be negative, and the punch
!> must not penetrate the half-plane outside of the contact. The solution of the contact problem
!> is unique, so that an interval which meets both conditions is the solution, however it was
!> found.
module fuge_smooth_admissibility
  use fuge_chebyshev, only: chebyshev_values, second_to_first
  use fuge_kinds, only: dp
  use fuge_series_minimum, only: cells_for, find_minimum
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_exterior, only: exterior_violation, find_penetration
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: check_admissibility

  !> How far a contact violates the sign conditions.
  type, public :: sign_violation
    !> The largest tensile pressure relative to the largest pressure, no unit, and its position.
    real(dp) :: tension = 0.0_dp, tension_position = 0.0_dp
    !> The deepest penetration relative to the magnitude of the gap there, no unit, and its position.
    real(dp) :: penetration = 0.0_dp, penetration_position = 0.0_dp
    !> A bound for the penetration that may have been overlooked beside the contact; no unit.
    real(dp) :: undecided = 0.0_dp
  end type sign_violation

  !> The least pressure is found to this fraction of the largest.
  real(dp), parameter :: RESOLUTION = 1.0e-11_dp

contains

  !> The largest violations of the sign conditions by `contact`. Errors: those of the profile.
  subroutine check_admissibility(profile, contact, violation, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    type(exterior_violation) :: exterior
    integer :: side

    call find_tension(contact, violation)
    do side = 1, 2
      call find_penetration(profile, contact, side, exterior, info)
      if (info%failed()) return
    end do
    violation%penetration = exterior%penetration
    violation%penetration_position = exterior%position
    violation%undecided = exterior%undecided
  end subroutine check_admissibility

  !> The least value of the pressure over the square root: it has the sign of the pressure, and at the
  !> ends the sign of the pressure close to them.
  pure subroutine find_tension(contact, violation)
    type(fuge_smooth_contact), intent(in) :: contact
    type(sign_violation), intent(inout) :: violation
    real(dp) :: a(size(contact%coefficients)), largest, least, t

    a = second_to_first(contact%coefficients)
    largest = maxval(abs(chebyshev_values(a, cells_for(size(a)))))
    call find_minimum(a, 0.0_dp, RESOLUTION*largest, least, t)
    violation%tension = max(0.0_dp, -least/largest)
    violation%tension_position = 0.5_dp*(contact%ends(1) + contact%ends(2)) + contact%half_width*t
  end subroutine find_tension

end module fuge_smooth_admissibility
