!> The certificate of a smooth contact: how far pressure, approach and tilt are from the contact
!> problem, by quadrature of the pressure that is returned.
!>
!> It shares no formula with the search, which uses slopes only. Displacements are integrals of
!> the pressure times the logarithm of the distance, by a product rule that integrates this
!> factor exactly (R. Kress, Linear Integral Equations, 1989, section 12.3), at points of its
!> own, and are compared with the gap instead of the slope.
module fuge_smooth_certificate
  use fuge_chebyshev, only: chebyshev_sum
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: certify_contact

  !> Positions where the gap equation is evaluated: x = centre + half_width cos(angle), POSITIONS_PER_POINT for
  !> each point of the quadrature rule, at equidistant angles. The offset of the angles, in steps, keeps them off the
  !> nodes of a Chebyshev series and the points of the rule.
  integer, parameter :: POSITIONS_PER_POINT = 2
  real(dp), parameter :: ANGLE_OFFSET = 0.39_dp
  !> Points of the quadrature rule beyond the number of coefficients.
  integer, parameter :: MORE_POINTS = 13
  !> Rounding errors of the caller's own numbers that do not count, in units of the last place.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  !> The `residual`, no unit, is the largest of
  !>
  !> - |gap + displacement - approach - tilt x| at positions in the contact, relative to F/E* plus
  !>   the height of the profile there above the lowest of these positions, less the rounding
  !>   of gap, approach and x;
  !> - the integral of the pressure less the force, relative to the force, less the rounding of x;
  !> - the integral of x times the pressure less the moment, relative to the force times the half
  !>   width, less the rounding of x.
  !>
  !> Calls the profile once. Errors: those of the profile.
  subroutine certify_contact(profile, contact, residual, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(out) :: residual
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(POSITIONS_PER_POINT*(size(contact%coefficients) + MORE_POINTS)) :: s, x, gap, slope, error, &
      height, rounding
    real(dp), dimension(size(contact%coefficients) + MORE_POINTS) :: t, force
    real(dp) :: centre, compliance, arm
    integer :: k, n

    residual = 0.0_dp
    centre = 0.5_dp*(contact%ends(1) + contact%ends(2))
    s = [(cos(PI*((real(k, dp) - ANGLE_OFFSET)/real(size(s), dp))), k=1, size(s))]
    x = max(contact%ends(1), min(contact%ends(2), centre + contact%half_width*s))
    call sample_profile(profile, x, gap, slope, info)
    if (info%failed()) return

    n = size(t)
    t = [(cos(PI*(real(k, dp) - 0.5_dp)/real(n, dp)), k=1, n)]
    force = PI/real(n, dp)*contact%half_width*sqrt((1.0_dp - t)*(1.0_dp + t)) &
            *contact%pressure(centre + contact%half_width*t)
    compliance = 2.0_dp/(PI*contact%e_star)
    error = gap - contact%approach - contact%tilt*x &
            - compliance*log(contact%half_width/(2.0_dp*(profile%upper - profile%lower)))*contact%force &
            - compliance*chebyshev_sum(log_potential(t, force), s)
    height = abs((gap - minval(gap)) - contact%tilt*(x - x(minloc(gap, 1))))
    rounding = abs(gap) + abs(contact%approach) + (abs(contact%tilt) + abs(slope))*abs(x) &
               + compliance*contact%force*abs(centre)/contact%half_width
    arm = sum(contact%half_width*t*(force/contact%force)) + centre - contact%moment/contact%force
    residual = max(maxval(excess(error, rounding)/(height + contact%force/contact%e_star)), &
                   excess(sum(force)/contact%force - 1.0_dp, abs(centre)/contact%half_width), &
                   excess(arm, abs(centre) + contact%half_width)/contact%half_width)
    if (.not. residual <= huge(residual)) residual = huge(residual)
  end subroutine certify_contact

  !> |error| less the rounding of numbers of size `rounded`.
  elemental function excess(error, rounded)
    real(dp), intent(in) :: error, rounded
    real(dp) :: excess

    excess = max(0.0_dp, abs(error) - ROUNDINGS*epsilon(error)*rounded)
  end function excess

  !> Chebyshev coefficients of sum_j force_j ln|s - t_j| as a function of s, to the degree that the points t
  !> resolve: ln|s - t| is -ln 2 - sum_m (2/m) T_m(s) T_m(t), truncated at their number.
  pure function log_potential(t, force) result(a)
    real(dp), intent(in) :: t(:), force(:)
    real(dp) :: a(0:size(t) - 1)
    real(dp), dimension(size(t)) :: now, previous, next
    integer :: m

    a(0) = -log(2.0_dp)*sum(force)
    previous = 1.0_dp
    now = t
    do m = 1, size(t) - 1
      a(m) = -2.0_dp/real(m, dp)*dot_product(now, force)
      next = 2.0_dp*t*now - previous
      previous = now
      now = next
    end do
  end function log_potential

end module fuge_smooth_certificate
