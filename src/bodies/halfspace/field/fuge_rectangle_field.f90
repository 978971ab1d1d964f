!> Stresses and displacements under uniform pressure on one rectangle, accurate to rounding at any point.
!>
!> The closed form loses digits by differences of its corners. So a rectangle that is far from the point, seen along
!> each of its sides, is summed by Gauss's rule over point forces, in which nothing cancels. Others are
!> cut in two until each part is far, or close enough and compact enough for the closed form.
module fuge_rectangle_field
  use fuge_gauss_legendre, only: gauss_rules
  use fuge_kinds, only: dp
  use fuge_point_forces, only: add_force_displacements, add_force_stresses, finish_displacement, finish_stress
  use fuge_rectangle_corners, only: corner_displacement, corner_stress
  implicit none
  private

  public :: new_rectangle_rules, part_displacement, part_stress, place_nodes, rectangle_displacement, &
    rectangle_stress, rule_order

  !> The most nodes of a rule along one side.
  integer, parameter, public :: MOST_NODES = 18
  !> A rule of k nodes has errors below 1e-15 of the integral from distances of NEAREST(k) half lengths on.
  real(dp), parameter :: NEAREST(MOST_NODES) = &
    [7.1e7_dp, 8900.0_dp, 411.0_dp, 86.0_dp, 33.0_dp, 17.3_dp, 10.9_dp, 7.7_dp, 5.8_dp, 4.7_dp, 3.9_dp, 3.4_dp, &
     3.0_dp, 2.7_dp, 2.45_dp, 2.27_dp, 2.12_dp, 2.0_dp]
  !> The closed form takes sides of at most this ratio.
  real(dp), parameter :: COMPACT_RATIO = 2.0_dp
  !> Outside of the rectangle, the closed form takes points deeper than this fraction of the distance to it.
  real(dp), parameter :: DEEP = 0.5_dp
  !> Points count as lying at the edge up to this distance from it, in the greater half width of the rectangle.
  real(dp), parameter :: SMALLEST = 1.0e-18_dp

  !> Gauss's rules of 1 .. MOST_NODES nodes on (-1, 1): (node, rule). Their weights add up to 1.
  type, public :: rectangle_rules
    private
    real(dp) :: node(MOST_NODES, MOST_NODES) = 0.0_dp
    real(dp) :: weight(MOST_NODES, MOST_NODES) = 0.0_dp
  end type rectangle_rules

  !> A rectangle as it is seen from a point.
  type, public :: rectangle_part
    !> The point minus its upper and its lower edge along x and y, the greater value second: exact near an edge.
    real(dp) :: x(2) = 0.0_dp, y(2) = 0.0_dp
    !> Half widths along x and y, which are exact far away.
    real(dp) :: half(2) = 0.0_dp
  end type rectangle_part

contains

  !> The rules that all rectangles share: make them once.
  pure subroutine new_rectangle_rules(rules)
    type(rectangle_rules), intent(out) :: rules

    call gauss_rules(rules%node, rules%weight)
    rules%node = 2.0_dp*rules%node - 1.0_dp
  end subroutine new_rectangle_rules

  !> Stresses xx, yy, zz, yz, xz, xy under unit pressure on a rectangle; tension is positive.
  !>
  !> `dx`, `dy`: the point minus the centre of the rectangle, and `z` >= 0 its depth; `half_x`, `half_y` > 0 half
  !> widths; lengths; `poisson` Poisson's ratio. Errors are about 1e-15 of the largest component, and in zz, yz and xz
  !> 1e-15 of the integral of the magnitude. At z = 0, zz is -1 inside, -1/2 at an edge and -1/4 at a corner; xz and yz
  !> are zero, also at an edge, where they jump from 1/pi straight below it. xy has a logarithm of the distance from
  !> each corner; at the corner itself that of the unit of length is taken instead.
  pure function rectangle_stress(rules, dx, dy, z, half_x, half_y, poisson) result(stress)
    type(rectangle_rules), intent(in) :: rules
    real(dp), intent(in) :: dx, dy, z, half_x, half_y, poisson
    real(dp) :: stress(6)

    stress = part_stress(rules, rectangle_part([dx - half_x, dx + half_x], [dy - half_y, dy + half_y], &
                                               [half_x, half_y]), z, poisson)
  end function rectangle_stress

  !> As `rectangle_stress`, of a `part`.
  pure function part_stress(rules, part, z, poisson) result(stress)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z, poisson
    real(dp) :: stress(6)
    integer :: unit

    unit = unit_exponent(part, z)
    stress = 0.0_dp
    call add_stress(rules, in_unit(part, unit), scale(z, -unit), poisson, -real(unit, dp)*log(2.0_dp), stress)
  end function part_stress

  !> Young's modulus times the displacements along x, y, z under unit pressure on a rectangle; arguments as for
  !> `rectangle_stress`. Errors are about 1e-15 of the largest component.
  pure function rectangle_displacement(rules, dx, dy, z, half_x, half_y, poisson) result(displacement)
    type(rectangle_rules), intent(in) :: rules
    real(dp), intent(in) :: dx, dy, z, half_x, half_y, poisson
    real(dp) :: displacement(3)

    displacement = part_displacement(rules, rectangle_part([dx - half_x, dx + half_x], [dy - half_y, dy + half_y], &
                                                           [half_x, half_y]), z, poisson)
  end function rectangle_displacement

  !> As `rectangle_displacement`, of a `part`.
  pure function part_displacement(rules, part, z, poisson) result(displacement)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z, poisson
    real(dp) :: displacement(3)
    integer :: unit

    unit = unit_exponent(part, z)
    displacement = 0.0_dp
    call add_displacement(rules, in_unit(part, unit), scale(z, -unit), poisson, displacement)
    displacement = scale(displacement, unit)
  end function part_displacement

  !> The power of two that is a unit of length for which no power overflows.
  pure function unit_exponent(part, z) result(unit)
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z
    integer :: unit

    unit = exponent(max(maxval(abs(part%x)), maxval(abs(part%y)), z))
  end function unit_exponent

  pure function in_unit(part, unit) result(scaled)
    type(rectangle_part), intent(in) :: part
    integer, intent(in) :: unit
    type(rectangle_part) :: scaled

    scaled = rectangle_part(scale(part%x, -unit), scale(part%y, -unit), scale(part%half, -unit))
  end function in_unit

  !> Add the stresses under a part; lengths are at most 1.
  pure recursive subroutine add_stress(rules, part, z, poisson, corner_log, stress)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z, poisson, corner_log
    real(dp), intent(inout) :: stress(6)
    integer :: order(2)

    order = part_orders(part, z)
    if (all(order <= MOST_NODES)) then
      call add_distant_stress(rules, part, order, z, poisson, stress)
    else if (is_compact(part) .and. .not. is_shallow(part, z)) then
      stress = stress + corner_stress(part%x, part%y, z, poisson, corner_log)
    else
      call add_stress(rules, half_part(part, .false.), z, poisson, corner_log, stress)
      call add_stress(rules, half_part(part, .true.), z, poisson, corner_log, stress)
    end if
  end subroutine add_stress

  !> Add the displacements of a part; lengths are at most 1.
  pure recursive subroutine add_displacement(rules, part, z, poisson, displacement)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z, poisson
    real(dp), intent(inout) :: displacement(3)
    integer :: order(2)

    order = part_orders(part, z)
    if (all(order <= MOST_NODES)) then
      call add_distant_displacement(rules, part, order, z, poisson, displacement)
    else if (is_compact(part)) then
      displacement = displacement + corner_displacement(part%x, part%y, z, poisson)
    else
      call add_displacement(rules, half_part(part, .false.), z, poisson, displacement)
      call add_displacement(rules, half_part(part, .true.), z, poisson, displacement)
    end if
  end subroutine add_displacement

  !> Add the stresses of a distant part by a rule of `order` (2) nodes along x and y.
  pure subroutine add_distant_stress(rules, part, order, z, poisson, stress)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    integer, intent(in) :: order(2)
    real(dp), intent(in) :: z, poisson
    real(dp), intent(inout) :: stress(6)
    real(dp), dimension(MOST_NODES) :: x, y, depth, origin
    real(dp) :: node_sums(order(1), 6)

    call nodes_of(rules, part, order, z, x, y, depth, origin)
    node_sums = 0.0_dp
    call add_force_stresses(origin(:order(2)), y(:order(2)), rules%weight(:order(2), order(2)), poisson, &
                            x(:order(1)), origin(:order(1)), depth(:order(1)), node_sums)
    stress = stress + 4.0_dp*product(part%half) &
             *finish_stress(matmul(rules%weight(:order(1), order(1)), node_sums), z)
  end subroutine add_distant_stress

  !> Add the displacements of a distant part, likewise.
  pure subroutine add_distant_displacement(rules, part, order, z, poisson, displacement)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    integer, intent(in) :: order(2)
    real(dp), intent(in) :: z, poisson
    real(dp), intent(inout) :: displacement(3)
    real(dp), dimension(MOST_NODES) :: x, y, depth, origin
    real(dp) :: node_sums(order(1), 3)

    call nodes_of(rules, part, order, z, x, y, depth, origin)
    node_sums = 0.0_dp
    call add_force_displacements(origin(:order(2)), y(:order(2)), rules%weight(:order(2), order(2)), poisson, &
                                 x(:order(1)), origin(:order(1)), depth(:order(1)), node_sums)
    displacement = displacement + 4.0_dp*product(part%half) &
                   *finish_displacement(matmul(rules%weight(:order(1), order(1)), node_sums), poisson)
  end subroutine add_distant_displacement

  !> Points at `x` to which the origin lies as the nodes along x do to the point, and forces at `y` that lie to the
  !> origin as the nodes along y do. `depth` and `origin` are z and 0 throughout.
  pure subroutine nodes_of(rules, part, order, z, x, y, depth, origin)
    type(rectangle_rules), intent(in) :: rules
    type(rectangle_part), intent(in) :: part
    integer, intent(in) :: order(2)
    real(dp), intent(in) :: z
    real(dp), dimension(MOST_NODES), intent(out) :: x, y, depth, origin

    x = 0.5_dp*(part%x(1) + part%x(2)) + part%half(1)*rules%node(:, order(1))
    y = -0.5_dp*(part%y(1) + part%y(2)) + part%half(2)*rules%node(:, order(2))
    depth = z
    origin = 0.0_dp
  end subroutine nodes_of

  !> Point forces that stand for the `force` on a rectangle with `centre` (2) and half widths `half` (2): a rule of
  !> `order` (2) nodes along x and y; `x`, `y`, `share` (product of the orders).
  pure subroutine place_nodes(rules, order, centre, half, force, x, y, share)
    type(rectangle_rules), intent(in) :: rules
    integer, intent(in) :: order(2)
    real(dp), intent(in) :: centre(2), half(2), force
    real(dp), intent(out) :: x(:), y(:), share(:)
    integer :: first, i, j

    do j = 1, order(2)
      first = order(1)*(j - 1)
      do i = 1, order(1)
        x(first + i) = centre(1) + half(1)*rules%node(i, order(1))
        y(first + i) = centre(2) + half(2)*rules%node(j, order(2))
        share(first + i) = force*rules%weight(j, order(2))*rules%weight(i, order(1))
      end do
    end do
  end subroutine place_nodes

  !> Nodes needed along x and y; more than MOST_NODES if the part is near. The distance counts from the middle of the
  !> closest line of nodes.
  pure function part_orders(part, z) result(order)
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z
    integer :: order(2)
    real(dp) :: middle(2), beside(2), depth

    depth = z**2
    middle = 0.5_dp*abs([part%x(1) + part%x(2), part%y(1) + part%y(2)])
    beside = max(middle - part%half, 0.0_dp)
    order(1) = rule_order(middle(1)**2 + beside(2)**2 + depth, part%half(1))
    order(2) = rule_order(middle(2)**2 + beside(1)**2 + depth, part%half(2))
  end function part_orders

  !> The number of nodes for a side of length 2 `half` at the distance whose square is `square`; MOST_NODES + 1 if it is
  !> too near for all rules.
  pure function rule_order(square, half) result(order)
    real(dp), intent(in) :: square, half
    integer :: order

    do order = MOST_NODES, 1, -1
      if (square < (NEAREST(order)*half)**2) exit
    end do
    order = order + 1
  end function rule_order

  pure function is_compact(part) result(compact)
    type(rectangle_part), intent(in) :: part
    logical :: compact

    compact = maxval(part%half) <= COMPACT_RATIO*minval(part%half)
  end function is_compact

  !> Is the point beside the part and below the surface, but so shallow that corners cancel in zz, yz and xz?
  pure function is_shallow(part, z) result(shallow)
    type(rectangle_part), intent(in) :: part
    real(dp), intent(in) :: z
    logical :: shallow
    real(dp) :: outside

    shallow = .false.
    if (.not. z > 0.0_dp) return
    outside = hypot(max(part%x(1), -part%x(2), 0.0_dp), max(part%y(1), -part%y(2), 0.0_dp))
    shallow = z < DEEP*outside .and. outside > SMALLEST*maxval(part%half)
  end function is_shallow

  !> One half of a part, cut across its longer side; both halves share the cut exactly.
  pure function half_part(part, upper) result(half)
    type(rectangle_part), intent(in) :: part
    logical, intent(in) :: upper
    type(rectangle_part) :: half
    integer :: kept

    half = part
    kept = merge(1, 2, upper)
    if (part%half(1) >= part%half(2)) then
      half%x(kept) = 0.5_dp*(part%x(1) + part%x(2))
      half%half(1) = 0.5_dp*part%half(1)
    else
      half%y(kept) = 0.5_dp*(part%y(1) + part%y(2))
      half%half(2) = 0.5_dp*part%half(2)
    end if
  end function half_part

end module fuge_rectangle_field
