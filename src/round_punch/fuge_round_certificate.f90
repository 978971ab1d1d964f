!> The certificate of a round contact: how far pressure and approach are from the contact problem.
!>
!> The search uses slopes and Abel's transform; here the displacement in the contact follows from the inverse
!> transform and is compared with the gap, at points of its own, and the load is the integral of the pressure
!> that is returned.
module fuge_round_certificate
  use fuge_abel_transform, only: abel_transform
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: certify_round

  !> Radii where the gap equation is evaluated, and nodes of the quadrature rules, beyond a multiple of the degree.
  integer, parameter :: MORE_POINTS = 12, MORE_NODES = 24
  !> The offset keeps the radii off the nodes of a Chebyshev series.
  real(dp), parameter :: OFFSET = 0.39_dp
  !> Substitutions that make a singular pressure in a tip, and powers that are no integers, smooth enough.
  integer, parameter :: RIM_POWER = 6, AXIS_POWER = 4
  !> Rounding errors of the caller's own numbers that do not count, in units of the last place.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  !> The `residual`, no unit, is the larger of
  !>
  !> - |gap + displacement - approach| at radii in the contact, relative to the height of the profile there plus
  !>   load/(E* radius), less the rounding of the gap;
  !> - |the integral of the pressure less the load|, relative to the load.
  !>
  !> Calls the profile once. Errors: those of the profile.
  subroutine certify_round(profile, contact, transform, residual, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp), intent(out) :: residual
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(size(transform%coefficients) + MORE_POINTS) :: r, gap, slope, error, height
    real(dp) :: unit
    integer :: k

    residual = 0.0_dp
    r = [(contact%radius*sin(0.5_dp*PI*((real(k, dp) - OFFSET)/real(size(r), dp))), k=1, size(r))]
    call sample_profile(profile, r, gap, slope, info)
    if (info%failed()) return
    height = recovered_heights(transform, r)
    unit = contact%load/contact%e_star/contact%radius
    error = abs((contact%axis_gap + height) - gap) - ROUNDINGS*epsilon(error)*(abs(gap) + abs(slope)*r)
    residual = max(0.0_dp, maxval(error/(abs(gap - contact%axis_gap) + unit)), &
                   abs(integrated_load(contact, transform) - 1.0_dp))
    if (.not. residual <= huge(residual)) residual = huge(residual)
  end subroutine certify_round

  !> The profile above its axis at `r`, by the inverse transform of g: approach less displacement.
  pure function recovered_heights(transform, r) result(height)
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r(:)
    real(dp) :: height(size(r))
    real(dp), dimension(nodes_of(transform)) :: node, weight, angle
    integer :: k

    call gauss_rule(node, weight)
    if (size(transform%powers) > 0) then
      weight = real(AXIS_POWER, dp)*node**(AXIS_POWER - 1)*weight
      node = node**AXIS_POWER
    end if
    angle = 0.5_dp*PI*node
    do k = 1, size(r)
      height(k) = r(k)*dot_product(weight, transform%slopes(min(1.0_dp, r(k)/transform%radius*sin(angle))) &
                                   *(0.5_dp*PI - angle)*cos(angle))
    end do
  end function recovered_heights

  !> The integral of the pressure over the load.
  pure function integrated_load(contact, transform) result(ratio)
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp) :: ratio
    real(dp), dimension(nodes_of(transform)) :: node, weight, depth, pressure

    call gauss_rule(node, weight)
    ! r = radius sqrt(1 - y**2) with y = 1 - depth.
    depth = node**RIM_POWER
    weight = weight*real(RIM_POWER, dp)*node**(RIM_POWER - 1)*(1.0_dp - depth)
    pressure = contact%pressure(contact%radius*sqrt(depth*(2.0_dp - depth)))
    ratio = 2.0_dp*PI*contact%radius*(contact%radius/contact%load*dot_product(weight, pressure))
  end function integrated_load

  pure function nodes_of(transform) result(nodes)
    type(abel_transform), intent(in) :: transform
    integer :: nodes

    nodes = MORE_NODES + 3*(size(transform%coefficients)/2)
    if (size(transform%powers) > 0) nodes = nodes + int(min(400.0_dp, 2.0_dp*maxval(transform%powers)))
  end function nodes_of

end module fuge_round_certificate
