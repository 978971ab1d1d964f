!> The field of a round punch: that of flat punches of all radii up to its own, with chi' as their density.
!>
!> The pressure (E*/pi) integral of chi'(t)/sqrt(t**2 - r**2) dt (`fuge_abel_transform`) is that of flat punches, and so
!> are the stresses below it (I. N. Sneddon 1965). Where chi' is not negative, one-signed integrals are sums of terms of
!> one sign, so that no digit is lost close to the surface or far away.
module fuge_round_field
  use fuge_abel_transform, only: abel_transform
  use fuge_axial_field, only: INTEGRALS
  use fuge_flat_punch_field, only: flat_punch_field
  use fuge_graded_panels, only: new_panel_rules, next_panel, panel_rules, MOST_NODES, SMOOTH_NODES
  use fuge_kinds, only: dp
  use fuge_profile_edges, only: edge_density, profile_edge, rim_sine
  implicit none
  private

  public :: new_round_rules, round_field

  !> Up to this degree chi' is a polynomial that the nodes for a smooth factor follow.
  integer, parameter :: EASY_DEGREE = 16
  !> Half waves of a Chebyshev polynomial on one part of the radius.
  integer, parameter :: HALF_WAVES = 5
  !> A power t**n falls by exp(-FALL) on one part, and is nothing after LAST_FALL of them.
  real(dp), parameter :: FALL = 4.0_dp
  integer, parameter :: LAST_FALL = 12
  !> For powers that are no integers parts shrink towards the axis: their ratio, the shortest one, and what need not be
  !> resolved relative to the distance of the point.
  real(dp), parameter :: SHRINKING = 0.4_dp, SHORTEST = 2.0_dp**(-80), UNRESOLVED = 1.0e-9_dp
  !> Parts of an edge grow by this factor.
  real(dp), parameter :: GROWTH = 3.0_dp
  !> At the surface the integrands have a root at t = r, which is resolved to this height relative to r; its power 3/2
  !> is left.
  real(dp), parameter :: LEAST_HEIGHT = 2.0_dp**(-44)
  !> A bound from below for the distance of a singularity of the angle 45 degrees or more, over its modulus.
  real(dp), parameter :: SINE = 0.7_dp

  !> Quadrature rules, and the parts of the radius on which chi' is smooth.
  type, public :: round_rules
    private
    type(panel_rules) :: panels
    real(dp), allocatable :: parts(:)
    !> Nodes for chi' beyond those for the kernel.
    integer :: more_nodes = 0
  end type round_rules

contains

  pure function new_round_rules(transform) result(rules)
    type(abel_transform), intent(in) :: transform
    type(round_rules) :: rules
    integer :: degree

    rules%panels = new_panel_rules()
    degree = size(transform%coefficients) - 1
    if (size(transform%powers) > 0) then
      allocate (rules%parts, source=parts_of_powers(transform%powers))
      degree = EASY_DEGREE + 1
      if (all(is_whole(transform%powers))) degree = int(min(maxval(transform%powers), real(degree, dp)))
    else if (degree >= 0) then
      allocate (rules%parts, source=parts_of_series(degree))
    else
      allocate (rules%parts(0))
    end if
    rules%more_nodes = SMOOTH_NODES
    if (degree <= EASY_DEGREE) rules%more_nodes = (degree + 1)/2
  end function new_round_rules

  elemental function is_whole(power) result(whole)
    real(dp), intent(in) :: power
    logical :: whole

    whole = .not. abs(power - aint(power)) > 0.0_dp
  end function is_whole

  !> Ends of the parts for a Chebyshev series of this degree.
  pure function parts_of_series(degree) result(parts)
    integer, intent(in) :: degree
    real(dp), allocatable :: parts(:)
    integer :: k, n

    n = 1
    if (degree > EASY_DEGREE) n = (degree + HALF_WAVES - 1)/HALF_WAVES
    allocate (parts(0:n))
    do k = 0, n
      parts(k) = sin(0.5_dp*acos(-1.0_dp)*real(k, dp)/real(n, dp))**2
    end do
    parts(n) = 1.0_dp
  end function parts_of_series

  !> Ends of the parts for t**(powers - 1), from 0 to 1.
  pure function parts_of_powers(powers) result(parts)
    real(dp), intent(in) :: powers(:)
    real(dp), allocatable :: parts(:)
    real(dp) :: upper, largest
    logical :: whole
    integer :: k, n

    largest = maxval(powers)
    whole = all(is_whole(powers))
    n = 1
    upper = 1.0_dp
    do while (upper > 0.0_dp)
      upper = next_end(upper, largest, whole)
      n = n + 1
    end do
    allocate (parts(n))
    parts(n) = 1.0_dp
    do k = n - 1, 1, -1
      parts(k) = next_end(parts(k + 1), largest, whole)
    end do
  end function parts_of_powers

  !> The lower end of the part below `upper` for powers up to `largest`, which are `whole` or not.
  pure function next_end(upper, largest, whole) result(lower)
    real(dp), intent(in) :: upper, largest
    logical, intent(in) :: whole
    real(dp) :: lower

    lower = 0.0_dp
    if (.not. whole .and. upper > SHORTEST) lower = SHRINKING*upper
    if (largest > real(EASY_DEGREE, dp) .and. -log(upper)*largest < FALL*real(LAST_FALL, dp)) &
      lower = max(lower, exp(-FALL/largest)*upper)
  end function next_end

  !> The integrals of `fuge_axial_field`, in units of E*/pi and the radius of the contact, at `r`, `z` >= 0 in units of
  !> this radius.
  !>
  !> At z = 0 only the potential, and the spread for r > 0 or without a tip: the other ones have limits there, which are
  !> the pressure, and no values.
  pure function round_field(rules, transform, r, z) result(field)
    type(round_rules), intent(in) :: rules
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: r, z
    real(dp) :: field(INTEGRALS)
    real(dp) :: height
    integer :: k, first

    field = 0.0_dp
    height = z
    if (.not. z > 0.0_dp) height = LEAST_HEIGHT*merge(r, 1.0_dp, r > 0.0_dp)
    first = 2
    do while (first < size(rules%parts))
      if (rules%parts(first) > UNRESOLVED*hypot(r, height)) exit
      first = first + 1
    end do
    do k = first, size(rules%parts)
      call add_part(rules, transform, merge(rules%parts(k - 1), 0.0_dp, k > first), rules%parts(k), r, z, height, field)
    end do
    do k = 1, size(transform%edges)
      call add_edge(rules, transform%edges(k), r, z, field)
    end do
  end function round_field

  !> Add the flat punches of radii from `lower` to `upper`.
  pure subroutine add_part(rules, transform, lower, upper, r, z, height, field)
    type(round_rules), intent(in) :: rules
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: lower, upper, r, z, height
    real(dp), intent(inout) :: field(INTEGRALS)

    if (r < upper) call add_punches(rules, transform, max(lower, r), 1.0_dp, upper, r, z, height, field)
    if (r > lower) call add_punches(rules, transform, min(upper, r), -1.0_dp, lower, r, z, height, field)
  end subroutine add_part

  !> Add the flat punches from radius `first`, the closest to the point, to radius `last`. `direction` 1 or -1: outwards
  !> or inwards. The arguments are nine, because a range of punches and a point are given by their numbers.
  pure subroutine add_punches(rules, transform, first, direction, last, r, z, height, field)
    type(round_rules), intent(in) :: rules
    type(abel_transform), intent(in) :: transform
    real(dp), intent(in) :: first, direction, last, r, z, height
    real(dp), intent(inout) :: field(INTEGRALS)
    real(dp), dimension(MOST_NODES) :: place, t, slope
    real(dp) :: left, right, length, distance
    integer :: k, nodes

    length = abs(last - first)
    distance = abs(first - r)
    left = 0.0_dp
    do while (left < length)
      call next_panel(rules%panels, left, length, distance, height, right, nodes)
      nodes = nodes + rules%more_nodes
      place(:nodes) = left + (right - left)*rules%panels%node(:nodes, nodes)
      t(:nodes) = first + direction*place(:nodes)
      slope(:nodes) = transform%slopes(t(:nodes))
      do k = 1, nodes
        field = field + (right - left)*rules%panels%weight(k, nodes)*slope(k) &
                *flat_punch_field(t(k), r, z, -direction*(distance + place(k)))
      end do
      left = right
    end do
  end subroutine add_punches

  !> Add the flat punches of an edge, over w = sqrt(t**2 - start**2), in which it is smooth; the kernel has a
  !> singularity at the root of (r + i z)**2 - start**2.
  pure subroutine add_edge(rules, edge, r, z, field)
    type(round_rules), intent(in) :: rules
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: r, z
    real(dp), intent(inout) :: field(INTEGRALS)
    complex(dp) :: root
    real(dp) :: lower, upper, last, square, place, height

    square = (r - edge%start)*(r + edge%start)
    root = sqrt(cmplx(square - z**2, 2.0_dp*r*z, dp))
    place = sqrt(max(0.0_dp, square))
    if (square > 0.0_dp) then
      height = z*hypot(z, 2.0_dp*r)/abs(root + place)
    else
      height = abs(root)
    end if
    height = SINE*height
    if (.not. z > 0.0_dp) height = max(height, LEAST_HEIGHT*max(r, edge%start))
    last = rim_sine(edge)
    lower = 0.0_dp
    upper = min(last, edge%start)
    do
      if (place < upper) &
        call add_edge_punches(rules, edge, max(lower, place), 1.0_dp, upper, r, z, place, height, field)
      if (place > lower) &
        call add_edge_punches(rules, edge, min(upper, place), -1.0_dp, lower, r, z, place, height, field)
      if (.not. upper < last) exit
      lower = upper
      upper = min(last, GROWTH*upper)
    end do
  end subroutine add_edge

  !> Add those from w = `first` to `last`; `place` and `height` of the singularity. Eleven arguments: a piece of the
  !> edge, the point, the singularity, the sum.
  pure subroutine add_edge_punches(rules, edge, first, direction, last, r, z, place, height, field)
    type(round_rules), intent(in) :: rules
    type(profile_edge), intent(in) :: edge
    real(dp), intent(in) :: first, direction, last, r, z, place, height
    real(dp), intent(inout) :: field(INTEGRALS)
    real(dp) :: left, right, length, distance, away, w, t, offset
    integer :: k, nodes

    length = abs(last - first)
    distance = abs(first - place)
    left = 0.0_dp
    do while (left < length)
      call next_panel(rules%panels, left, length, distance, height, right, nodes)
      nodes = nodes + SMOOTH_NODES
      do k = 1, nodes
        away = left + (right - left)*rules%panels%node(k, nodes)
        w = first + direction*away
        t = hypot(w, edge%start)
        if (place > 0.0_dp) then
          offset = -direction*(distance + away)*((w + place)/(t + r))
        else
          offset = -w*(w/(t + edge%start)) - (edge%start - r)
        end if
        field = field + (right - left)*rules%panels%weight(k, nodes)*edge_density(edge, w) &
                *flat_punch_field(t, r, z, offset)
      end do
      left = right
    end do
  end subroutine add_edge_punches

end module fuge_round_field
