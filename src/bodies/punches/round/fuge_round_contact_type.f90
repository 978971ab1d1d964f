!> The contact of a round punch with a half-space, in closed form once its radius is known.
!>
!> With Abel's transform chi of the profile (`fuge_abel_transform`) the pressure is
!>
!>     p(r) = (E*/pi) integral of chi'(t)/sqrt(t**2 - r**2) dt, t = r .. a,
!>
!> and the displacement beside the contact (2/pi) integral of chi'(t) arcsin(t/r) dt, t = 0 .. a (I. N. Sneddon 1965).
!> t = r cosh(xi) and t = r sin(phi) make both integrands smooth; neither has a difference.
module fuge_round_contact_type
  use fuge_abel_transform, only: abel_transform
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_profile_edges, only: edge_displacement, edge_pressure, EDGE_NODES
  use fuge_punch_contact_type, only: punch_contact
  implicit none
  private

  !> A contact in a disc about r = 0. Without load its radius is 0. The approach is absolute; the error of the
  !> pressure is relative to load/(pi radius**2).
  type, extends(punch_contact), public :: fuge_round_contact
    !> Radius of the contact; length.
    real(dp) :: radius = 0.0_dp
    !> Force.
    real(dp) :: load = 0.0_dp
    !> Estimated error of the radius, relative to it.
    real(dp) :: radius_error = 0.0_dp
    !> Initial gap on the axis; length.
    real(dp) :: axis_gap = 0.0_dp
    !> Abel's transform of the profile.
    type(abel_transform), private :: transform
  contains
    procedure :: set => set_contact
    procedure :: coefficients => slope_coefficients
    procedure :: abel => transform_of
    procedure :: pressures_at
    procedure :: gaps_at
  end type fuge_round_contact

  !> Length of a panel of xi, and the number of panels after which only chi'(0) is left.
  real(dp), parameter :: PANEL = 1.0_dp, LAST_PANEL = 40.0_dp
  !> Nodes of a quadrature rule beyond half of the degree.
  integer, parameter :: MORE_NODES = 14
  !> With phi = v**4 a power of t that is no integer is smooth enough for the quadrature.
  integer, parameter :: AXIS_POWER = 4

contains

  !> For the solver: the contact of a profile with this transform and this gap on the axis, length.
  subroutine set_contact(self, transform, axis_gap, e_star)
    class(fuge_round_contact), intent(inout) :: self
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: axis_gap, e_star

    self%transform = transform
    self%radius = transform%radius
    self%axis_gap = axis_gap
    self%e_star = e_star
    self%approach = axis_gap + transform%radius*transform%depth()
    self%load = e_star*transform%radius*(2.0_dp*transform%thrust()*transform%radius)
    self%pressure_error = transform%error/max(tiny(1.0_dp), transform%thrust())
  end subroutine set_contact

  !> The Chebyshev coefficients of chi' from 0 to the radius, no unit; none for a `fuge_power_profile` or without load.
  pure function slope_coefficients(self) result(coefficients)
    class(fuge_round_contact), intent(in) :: self
    real(dp), allocatable :: coefficients(:)

    if (allocated(self%transform%coefficients)) then
      allocate (coefficients, source=self%transform%coefficients)
    else
      allocate (coefficients(0))
    end if
  end function slope_coefficients

  !> For the stresses inside: Abel's transform; without load its components are not allocated.
  pure function transform_of(self) result(transform)
    class(fuge_round_contact), intent(in) :: self
    type(abel_transform) :: transform

    transform = self%transform
  end function transform_of

  !> Pressures at several distances `places` from the axis, length; (size(places)), force per length squared, 0 outside
  !> of the contact. In the tip of a cone the pressure is infinite: the result is the largest number.
  pure function pressures_at(self, places) result(pressure)
    class(fuge_round_contact), intent(in) :: self
    real(dp), intent(in) :: places(:)
    real(dp) :: pressure(size(places))
    real(dp), allocatable :: node(:), weight(:)
    integer :: k

    pressure = 0.0_dp
    if (.not. self%radius > 0.0_dp) return
    allocate (node(nodes_of(self%transform)), weight(nodes_of(self%transform)))
    call gauss_rule(node, weight)
    do k = 1, size(places)
      if (.not. abs(places(k)) > 0.0_dp .and. self%transform%tip > 0.0_dp) then
        pressure(k) = huge(1.0_dp)
      else if (abs(places(k)) < self%radius) then
        pressure(k) = self%e_star/PI*pressure_integral(self%transform, abs(places(k)), node, weight)
      end if
    end do
  end function pressures_at

  !> Nodes for a panel: half of the degree of chi', and some more.
  pure function nodes_of(transform) result(nodes)
    type(abel_transform), intent(in) :: transform
    integer :: nodes

    nodes = size(transform%coefficients)/2 + MORE_NODES
    if (size(transform%edges) > 0) nodes = EDGE_NODES
    if (size(transform%powers) > 0) nodes = nodes + int(min(200.0_dp, 0.5_dp*maxval(transform%powers)))
  end function nodes_of

  !> The integral of chi'(t)/sqrt(t**2 - r**2) dt from `r` to the radius; no unit.
  !>
  !> Panel by panel from the rim. Close to the axis only chi'(0) is left, unless there are powers between 1 and 2.
  pure function pressure_integral(transform, r, node, weight) result(integral)
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r, node(:), weight(:)
    real(dp) :: integral
    real(dp) :: ratio, length, upper, lower, fraction(size(node))
    integer :: k

    integral = 0.0_dp
    do k = 1, size(transform%edges)
      integral = integral + edge_pressure(transform%edges(k), r/transform%radius, node, weight)
    end do
    if (size(transform%coefficients) + size(transform%powers) == 0) return
    ratio = max(r/transform%radius, tiny(1.0_dp))
    length = acosh_of(ratio, (transform%radius - r)/transform%radius)
    upper = length
    do while (upper > 0.0_dp)
      if (length - upper > LAST_PANEL .and. .not. size(transform%powers) > 0) exit
      lower = max(0.0_dp, upper - PANEL)
      fraction = min(1.0_dp, ratio*cosh(lower + (upper - lower)*node))
      integral = integral + (upper - lower)*dot_product(weight, transform%slopes(fraction))
      upper = lower
    end do
    integral = integral + max(0.0_dp, upper)*transform%tip
  end function pressure_integral

  !> arcosh(1/ratio), with 1 - ratio given.
  pure function acosh_of(ratio, rest) result(angle)
    real(dp), intent(in) :: ratio, rest
    real(dp) :: angle

    angle = log((1.0_dp + sqrt(rest*(1.0_dp + ratio)))/ratio)
    if (rest < 0.5_dp) angle = asinh(sqrt(rest*(1.0_dp + ratio))/ratio)
  end function acosh_of

  !> Gaps at several distances `places` from the axis, length, where the initial gaps are `initial_gap` (size(places)),
  !> length.
  pure function gaps_at(self, places, initial_gap) result(gap)
    class(fuge_round_contact), intent(in) :: self
    real(dp), intent(in) :: places(:), initial_gap(:)
    real(dp) :: gap(size(places))
    real(dp), allocatable :: node(:), weight(:)
    integer :: k

    gap = initial_gap - self%approach
    if (.not. self%radius > 0.0_dp) return
    k = nodes_of(self%transform)
    if (size(self%transform%powers) > 0) k = AXIS_POWER*k
    allocate (node(k), weight(k))
    call gauss_rule(node, weight)
    if (size(self%transform%powers) > 0) then
      weight = real(AXIS_POWER, dp)*node**(AXIS_POWER - 1)*weight
      node = node**AXIS_POWER
    end if
    do k = 1, size(places)
      if (abs(places(k)) > self%radius) then
        gap(k) = gap(k) + displacement_integral(self%transform, abs(places(k)), node, weight) &
                 + edges_displacement(self%transform, abs(places(k)))
      else
        gap(k) = 0.0_dp
      end if
    end do
  end function gaps_at

  !> The displacement at `r` beside the contact; length.
  pure function displacement_integral(transform, r, node, weight) result(displacement)
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r, node(:), weight(:)
    real(dp) :: displacement
    real(dp), dimension(size(node)) :: angle, fraction
    real(dp) :: ratio, rim_angle

    ratio = r/transform%radius
    rim_angle = atan2(1.0_dp, sqrt(((r - transform%radius)/transform%radius)*(ratio + 1.0_dp)))
    angle = rim_angle*node
    fraction = min(1.0_dp, ratio*sin(angle))
    displacement = 2.0_dp/PI*r*rim_angle*dot_product(weight, transform%slopes(fraction)*angle*cos(angle))
  end function displacement_integral

  !> The displacement that the edges add; length.
  pure function edges_displacement(transform, r) result(displacement)
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r
    real(dp) :: displacement
    real(dp), dimension(EDGE_NODES) :: node, weight
    integer :: k

    displacement = 0.0_dp
    if (size(transform%edges) == 0) return
    call gauss_rule(node, weight)
    do k = 1, size(transform%edges)
      displacement = displacement + edge_displacement(transform%edges(k), r/transform%radius, node, weight)
    end do
    displacement = 2.0_dp/PI*transform%radius*displacement
  end function edges_displacement

end module fuge_round_contact_type
