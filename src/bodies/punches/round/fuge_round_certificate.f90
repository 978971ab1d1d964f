!> The certificate of a round contact: how far pressure and approach are from the contact problem.
!>
!> The search uses slopes and Abel's transform; here the load and the displacement on the axis are integrals of the
!> pressure that is returned, and the gaps are compared with the inverse transform, at points of their own.
module fuge_round_certificate
  use fuge_abel_transform, only: abel_transform
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_profile_edges, only: edge_height, EDGE_NODES
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: certify_round

  !> Radii where the gap equation is evaluated, and nodes of the quadrature rules, beyond a multiple of the degree.
  integer, parameter :: MORE_POINTS = 12, MORE_NODES = 24
  !> More nodes for the pressure beside an edge, which may lie close to the rim.
  integer, parameter :: NODES_FOR_EDGES = 40
  !> The offset keeps the radii off the nodes of a Chebyshev series.
  real(dp), parameter :: OFFSET = 0.39_dp
  !> With the angle node**4 a power that is no integer is smooth enough on the axis.
  integer, parameter :: AXIS_POWER = 4
  !> Rounding errors of the caller's own numbers that do not count, in units of the last place.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

contains

  !> The `residual`, no unit, is the largest of
  !>
  !> - |gap + displacement - approach| on the axis, where the displacement is 2/E* times the integral of the pressure
  !>   over r, relative to load/(E* radius), less the rounding of the gap;
  !> - |gap - that which the inverse transform gives| at radii in the contact, relative to the height of the profile
  !>   there plus load/(E* radius), less the rounding of the gap;
  !> - |the integral of the pressure less the load|, relative to the load.
  !>
  !> Calls the profile once. Errors: those of the profile.
  subroutine certify_round(profile, contact, transform, residual, info)
    class(fuge_smooth_profile), intent(in) :: profile
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp), intent(out) :: residual
    type(fuge_info), intent(inout) :: info
    real(dp), dimension(size(transform%coefficients) + MORE_POINTS) :: r, gap, slope, error
    real(dp) :: unit, load, displacement
    integer :: k

    residual = 0.0_dp
    r = [(contact%radius*sin(0.5_dp*PI*((real(k, dp) - OFFSET)/real(size(r), dp))), k=1, size(r))]
    call sample_profile(profile, r, gap, slope, info)
    if (info%failed()) return
    unit = contact%load/contact%e_star/contact%radius
    error = abs((contact%axis_gap + recovered_heights(transform, r)) - gap) &
            - ROUNDINGS*epsilon(error)*(abs(gap) + abs(slope)*r)
    call integrate_pressure(contact, transform, load, displacement)
    displacement = abs((contact%axis_gap - contact%approach) + unit*displacement) &
                   - ROUNDINGS*epsilon(displacement)*(abs(contact%axis_gap) + abs(contact%approach))
    residual = max(0.0_dp, maxval(error/(abs(gap - contact%axis_gap) + unit)), displacement/unit, abs(load - 1.0_dp))
    if (.not. residual <= huge(residual)) residual = huge(residual)
  end subroutine certify_round

  !> The profile above its axis at `r`, by the inverse transform of chi: approach less displacement.
  pure function recovered_heights(transform, r) result(height)
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r(:)
    real(dp) :: height(size(r))
    real(dp), dimension(nodes_of(transform)) :: node, weight, angle
    real(dp), dimension(EDGE_NODES) :: edge_node, edge_weight
    integer :: j, k

    call gauss_rule(edge_node, edge_weight)
    call gauss_rule(node, weight)
    if (size(transform%powers) > 0) then
      weight = real(AXIS_POWER, dp)*node**(AXIS_POWER - 1)*weight
      node = node**AXIS_POWER
    end if
    angle = 0.5_dp*PI*node
    do k = 1, size(r)
      height(k) = r(k)*dot_product(weight, transform%slopes(min(1.0_dp, r(k)/transform%radius*sin(angle))) &
                                   *(0.5_dp*PI - angle)*cos(angle))
      do j = 1, size(transform%edges)
        height(k) = height(k) + 2.0_dp/PI*transform%radius*edge_height(transform%edges(j), r(k)/transform%radius, &
                                                                          edge_node, edge_weight)
      end do
    end do
  end function recovered_heights

  !> The integral of the pressure over the `load`, and its `displacement` on the axis over load/(E* radius).
  pure subroutine integrate_pressure(contact, transform, load, displacement)
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    real(dp), intent(out) :: load, displacement
    real(dp), dimension(nodes_of(transform)) :: node, weight, fraction, r, pressure
    real(dp) :: ends(0:size(transform%edges) + 1)
    integer :: k

    call gauss_rule(node, weight)
    ! Smooth at both ends, where the pressure has a root or a logarithm: the fraction grows like the sixth power there.
    fraction = node**6*(462.0_dp - node*(1980.0_dp - node*(3465.0_dp - node*(3080.0_dp - node*(1386.0_dp &
                                                                                          - 252.0_dp*node)))))
    weight = weight*2772.0_dp*(node*(1.0_dp - node))**5
    ends = sorted([0.0_dp, transform%edges%start, 1.0_dp])
    load = 0.0_dp
    displacement = 0.0_dp
    do k = 1, ubound(ends, 1)
      r = min(1.0_dp, ends(k - 1) + (ends(k) - ends(k - 1))*fraction)
      ! In units of the mean pressure, which keeps extreme numbers in range.
      pressure = contact%pressure(contact%radius*r)/(contact%load/contact%radius/contact%radius)
      load = load + 2.0_dp*PI*(ends(k) - ends(k - 1))*dot_product(weight, r*pressure)
      displacement = displacement + 2.0_dp*(ends(k) - ends(k - 1))*dot_product(weight, pressure)
    end do
  end subroutine integrate_pressure

  !> The values in ascending order.
  pure function sorted(values) result(ascending)
    real(dp), intent(in) :: values(:)
    real(dp) :: ascending(size(values))
    integer :: k, j

    ascending = values
    do k = 2, size(values)
      do j = k, 2, -1
        if (ascending(j) < ascending(j - 1)) ascending(j - 1:j) = ascending([j, j - 1])
      end do
    end do
  end function sorted

  pure function nodes_of(transform) result(nodes)
    type(abel_transform), intent(in) :: transform
    integer :: nodes

    nodes = MORE_NODES + 3*size(transform%coefficients)
    if (size(transform%powers) > 0) nodes = nodes + int(min(400.0_dp, 2.0_dp*maxval(transform%powers)))
    if (size(transform%edges) > 0) nodes = nodes + NODES_FOR_EDGES
  end function nodes_of

end module fuge_round_certificate
