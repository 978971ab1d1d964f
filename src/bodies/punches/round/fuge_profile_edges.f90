!> Parts of a round profile that begin at a radius of their own: flat ends, rounded edges, worn balls.
!>
!> A term c (r - b) or c (r - b)**2 from r = b on is not smooth there, but its Abel transform chi is smooth in w, w**2 =
!> t**2 - b**2. With cos(theta) = b/t and lengths in units of the radius of the contact it has
!>
!>     chi' dt = G dw,   G = c (theta w + b)/t   or   2 c (2 w - b theta) w/t
!>
!> (M. Ciavarella, D. A. Hills, G. Monno, J. Mech. Engng Sci. 212, 1998, for the rounded edge). All integrals over t
!> become integrals of G over w, by a Gauss rule on (0, 1) of EDGE_NODES nodes or more.
module fuge_profile_edges
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  implicit none
  private

  public :: edge_density, edge_depth, edge_displacement, edge_height, edge_pressure, edge_rim_slope, edge_thrust, &
    rim_sine

  !> One term on a contact of radius 1 that reaches beyond `start`.
  type, public :: profile_edge
    !> Slope factor: c for the power 1, 2 c times the radius for the power 2; no unit.
    real(dp) :: factor = 0.0_dp
    !> b, between 0 and 1; and 1 - b, which has more digits than the difference.
    real(dp) :: start = 0.0_dp, rest = 1.0_dp
    !> 1 or 2.
    integer :: power = 1
  end type profile_edge

  !> Nodes of the quadrature rules on each panel.
  integer, parameter, public :: EDGE_NODES = 24
  !> Below this angle the closed forms would cancel; the quadrature does not.
  real(dp), parameter :: SMALL_ANGLE = 0.5_dp
  !> The smallest distance from the edge that is told from 0.
  real(dp), parameter :: CLOSEST = 1.0e-17_dp

contains

  !> w at the rim: the sine of the angle whose cosine is b.
  elemental function rim_sine(edge) result(w)
    type(profile_edge), intent(in) :: edge
    real(dp) :: w

    w = sqrt(edge%rest*(1.0_dp + edge%start))
  end function rim_sine

  !> G at w.
  elemental function edge_density(edge, w) result(g)
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: w
    real(dp) :: g
    real(dp) :: theta

    theta = atan2(w, edge%start)
    if (edge%power == 1) then
      g = edge%factor*(theta*w + edge%start)/hypot(w, edge%start)
    else
      g = edge%factor*(2.0_dp*w - edge%start*theta)*w/hypot(w, edge%start)
    end if
  end function edge_density

  !> chi' at the rim; no unit.
  elemental function edge_rim_slope(edge) result(slope)
    type(profile_edge), intent(in) :: edge
    real(dp) :: slope

    slope = edge_density(edge, rim_sine(edge))/rim_sine(edge)
  end function edge_rim_slope

  !> The integral of chi' dt up to the rim.
  pure function edge_depth(edge) result(depth)
    type(profile_edge), intent(in) :: edge
    real(dp) :: depth
    real(dp) :: theta, w

    w = rim_sine(edge)
    theta = atan2(w, edge%start)
    if (edge%power == 1) then
      depth = edge%factor*theta
    else if (theta > SMALL_ANGLE) then
      depth = edge%factor*(w - edge%start*theta)
    else
      depth = density_moment(edge, 0)
    end if
  end function edge_depth

  !> The integral of t chi' dt up to the rim.
  pure function edge_thrust(edge) result(thrust)
    type(profile_edge), intent(in) :: edge
    real(dp) :: thrust
    real(dp) :: theta, w

    w = rim_sine(edge)
    theta = atan2(w, edge%start)
    if (edge%power == 1) then
      thrust = 0.5_dp*edge%factor*(theta + edge%start*w)
    else if (theta > SMALL_ANGLE) then
      thrust = edge%factor*(2.0_dp/3.0_dp*w**3 - 0.5_dp*edge%start*(theta - edge%start*w))
    else
      thrust = density_moment(edge, 1)
    end if
  end function edge_thrust

  !> The integral of t**order G dw up to the rim, by quadrature.
  pure function density_moment(edge, order) result(moment)
    type(profile_edge), intent(in) :: edge
    integer, intent(in) :: order
    real(dp) :: moment
    real(dp), dimension(EDGE_NODES) :: node, weight

    call gauss_rule(node, weight)
    node = rim_sine(edge)*node
    moment = rim_sine(edge)*dot_product(weight, edge_density(edge, node)*hypot(node, edge%start)**order)
  end function density_moment

  !> The integral of chi'/sqrt(t**2 - r**2) dt from max(r, b) to the rim; no unit.
  !>
  !> With w = epsilon sinh(eta) inside the edge, r < b, and epsilon cosh(eta) outside, epsilon**2 = |r**2 - b**2|, it is
  !> that of G d(eta).
  pure function edge_pressure(edge, r, node, weight) result(integral)
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: r, node(:), weight(:)
    real(dp) :: integral
    real(dp) :: w(size(node))
    real(dp) :: distance, length, lower, upper

    integral = 0.0_dp
    distance = max(CLOSEST, sqrt(abs(r - edge%start)*(r + edge%start)))
    length = asinh(rim_sine(edge)/distance)
    if (r > edge%start) length = log((rim_sine(edge) + sqrt((1.0_dp - r)*(1.0_dp + r)))/distance)
    upper = length
    do while (upper > 0.0_dp)
      lower = max(0.0_dp, upper - 1.0_dp)
      w = lower + (upper - lower)*node
      if (r > edge%start) then
        w = distance*cosh(w)
      else
        w = distance*sinh(w)
      end if
      integral = integral + (upper - lower)*dot_product(weight, edge_density(edge, w))
      upper = lower
    end do
  end function edge_pressure

  !> The integral of chi' arcsin(t/r) dt up to the rim, r > 1.
  pure function edge_displacement(edge, r, node, weight) result(integral)
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: r, node(:), weight(:)
    real(dp) :: integral

    integral = arc_integral(edge, r, rim_sine(edge), .true., node, weight)
  end function edge_displacement

  !> The integral of chi' arccos(t/r) dt up to r <= 1: pi/2 times the height of the profile there.
  pure function edge_height(edge, r, node, weight) result(integral)
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: r, node(:), weight(:)
    real(dp) :: integral

    integral = 0.0_dp
    if (r > edge%start) integral = arc_integral(edge, r, sqrt((r - edge%start)*(r + edge%start)), .false., node, weight)
  end function edge_height

  !> The integral of G arcsin(t/r), or arccos, over w from 0 to `last`, with w = sqrt(r**2 - b**2) sin(psi), on panels
  !> of b, b, 2 b, 4 b, ..
  pure function arc_integral(edge, r, last, sine, node, weight) result(integral)
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: r, last, node(:), weight(:)
    logical, intent(in) :: sine
    real(dp) :: integral
    real(dp), dimension(size(node)) :: psi, w, arc, t
    real(dp) :: whole, lower, upper, from, to

    whole = sqrt((r - edge%start)*(r + edge%start))
    integral = 0.0_dp
    lower = 0.0_dp
    upper = min(last, edge%start)
    do
      from = asin(min(1.0_dp, lower/whole))
      to = asin(min(1.0_dp, upper/whole))
      psi = from + (to - from)*node
      w = whole*sin(psi)
      t = hypot(w, edge%start)
      if (sine) then
        arc = atan2(t, whole*cos(psi))
      else
        arc = atan2(whole*cos(psi), t)
      end if
      integral = integral + (to - from)*whole*dot_product(weight, edge_density(edge, w)*arc*cos(psi))
      if (.not. upper < last) exit
      lower = upper
      upper = min(last, 2.0_dp*upper)
    end do
  end function arc_integral

end module fuge_profile_edges
