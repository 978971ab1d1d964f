!> Stresses and displacements under rectangles at any points: close loads one by one, far ones in clusters.
module fuge_area_field
  use fuge_force_clusters, only: cluster_classes, force_clusters, new_force_clusters, place_cluster_forces, &
    prepare_cluster, set_single_cluster, CLASS_POINTS, FINEST
  use fuge_kinds, only: dp
  use fuge_point_forces, only: add_force_displacements, add_force_stresses, finish_displacement, finish_stress
  use fuge_pressed_area, only: pressed_area
  use fuge_rectangle_field, only: new_rectangle_rules, part_displacement, part_stress, place_nodes, rectangle_rules, &
    rule_order, MOST_NODES
  implicit none
  private

  public :: add_area_field, new_area_field

  !> Forces that are collected before they are summed, at most.
  integer, parameter :: SOURCES = 512
  !> Up to this number of points, a sum over all loads takes less time than the moments of clusters.
  integer, parameter :: FEW_POINTS = 32

  !> The loads of an area, for any number of points. Clusters are made when they are needed.
  type, public :: area_field
    private
    type(pressed_area) :: loads
    type(force_clusters) :: clusters
    type(rectangle_rules) :: rules
    real(dp) :: poisson = 0.0_dp
  end type area_field

contains

  !> The field under an area, whose rectangles it takes over. `stat` as in an allocate statement.
  pure subroutine new_area_field(area, poisson, field, stat)
    type(pressed_area), intent(inout) :: area
    real(dp), intent(in) :: poisson
    type(area_field), intent(out) :: field
    integer, intent(out) :: stat

    stat = 0
    call area%move_to(field%loads)
    if (field%loads%count < 1) return
    call new_rectangle_rules(field%rules)
    field%poisson = poisson
    call set_single_cluster(field%loads, field%clusters, stat)
  end subroutine new_area_field

  !> Add the stresses at points, for `values` (6, n), or Young's modulus times the displacements, for `values` (3, n).
  !>
  !> `x`, `y`, `z` >= 0 (n) finite. `stat` as in an allocate statement; the values are undefined unless it is 0.
  pure subroutine add_area_field(field, x, y, z, values, stat)
    type(area_field), intent(inout) :: field
    real(dp), intent(in) :: x(:), y(:), z(:)
    real(dp), intent(inout) :: values(:, :)
    integer, intent(out) :: stat
    real(dp) :: place(3), sums(1, 6), near(size(values, 1))
    integer :: k

    stat = 0
    if (field%loads%count < 1 .or. size(z) < 1) return
    if (size(z) > FEW_POINTS .and. field%clusters%levels < 1) call new_force_clusters(field%loads, field%clusters, stat)
    do k = 1, size(z)
      if (stat /= 0) return
      if (field%loads%is_far_from(x(k), y(k), z(k))) then
        values(:, k) = values(:, k) + far_values(field, x(k), y(k), z(k), size(values, 1))
        cycle
      end if
      place = scale([x(k), y(k), z(k)], -field%loads%unit)
      sums = 0.0_dp
      near = 0.0_dp
      call add_cluster_field(field, place, [1, 1, field%loads%count], sums, near, stat)
      values(:, k) = values(:, k) + in_caller_units(field%loads, near + finished(sums(1, :), place(3), field%poisson, &
                                                                                 size(near)), field%loads%unit)
    end do
  end subroutine add_area_field

  !> The values at a far point.
  pure function far_values(field, x, y, z, components) result(values)
    type(area_field), intent(in) :: field
    real(dp), intent(in) :: x, y, z
    integer, intent(in) :: components
    real(dp) :: values(components), sums(1, 6), place(3)
    integer :: unit

    unit = exponent(max(abs(x), abs(y), z))
    place = scale([x, y, z], -unit)
    sums = 0.0_dp
    call add_forces(components, [0.0_dp], [0.0_dp], [sum(field%loads%force)], field%poisson, &
                    place(1:1), place(2:2), place(3:3), sums)
    values = in_caller_units(field%loads, finished(sums(1, :), place(3), field%poisson, components), unit)
  end function far_values

  !> Stresses, or displacements times Young's modulus, of lengths in multiples of 2**unit in the units of the caller.
  pure function in_caller_units(loads, values, unit) result(scaled)
    type(pressed_area), intent(in) :: loads
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: unit
    real(dp) :: scaled(size(values))

    scaled = scale(values, loads%force_unit - unit*merge(2, 1, size(values) == 6))
  end function in_caller_units

  !> The values that belong to sums over point forces, at depth `z`.
  pure function finished(sums, z, poisson, components) result(values)
    real(dp), intent(in) :: sums(6), z, poisson
    integer, intent(in) :: components
    real(dp) :: values(components)

    if (components == 6) then
      values = finish_stress(sums, z)
    else
      values = finish_displacement(sums(:3), poisson)
    end if
  end function finished

  !> Sums over point forces, of which `finished` makes the values. The arguments are nine, because sources and points
  !> are plain arrays.
  pure subroutine add_forces(components, source_x, source_y, force, poisson, x, y, z, sums)
    integer, intent(in) :: components
    real(dp), intent(in), contiguous :: source_x(:), source_y(:), force(:), x(:), y(:), z(:)
    real(dp), intent(in) :: poisson
    real(dp), intent(inout), contiguous :: sums(:, :)

    if (components == 6) then
      call add_force_stresses(source_x, source_y, force, poisson, x, y, z, sums)
    else
      call add_force_displacements(source_x, source_y, force, poisson, x, y, z, sums)
    end if
  end subroutine add_forces

  !> Add the field of a cluster at a place: to the `sums` over point forces, or to what is final already. `cluster` (3):
  !> its number, and the first and the last of its loads.
  pure recursive subroutine add_cluster_field(field, place, cluster, sums, near, stat)
    type(area_field), intent(inout) :: field
    real(dp), intent(in) :: place(3)
    integer, intent(in) :: cluster(3)
    real(dp), intent(inout) :: sums(1, 6), near(:)
    integer, intent(inout) :: stat
    integer :: class(2), middle

    if (stat /= 0) return
    class = cluster_classes(field%clusters, cluster(1), place)
    if (minval(class) > 0) then
      if (is_cheaper(field, place, cluster, class)) then
        call add_grid_forces(field, place, cluster(1), class, size(near), sums, stat)
        return
      end if
    end if
    if (2*cluster(1) > field%clusters%count) then
      call add_loads(field, place, cluster(2:), sums, near)
    else
      middle = (cluster(2) + cluster(3))/2
      call add_cluster_field(field, place, [2*cluster(1), cluster(2), middle], sums, near, stat)
      call add_cluster_field(field, place, [2*cluster(1) + 1, middle + 1, cluster(3)], sums, near, stat)
    end if
  end subroutine add_cluster_field

  !> Are there fewer forces on the grid of a cluster than nodes on its loads?
  pure function is_cheaper(field, place, cluster, class) result(cheaper)
    type(area_field), intent(in) :: field
    real(dp), intent(in) :: place(3)
    integer, intent(in) :: cluster(3), class(2)
    logical :: cheaper
    integer :: k, most, nodes

    most = product(CLASS_POINTS(class))
    nodes = 0
    do k = cluster(2), cluster(3)
      nodes = nodes + product(load_orders(field%loads, k, place))
      if (nodes > most) exit
    end do
    cheaper = nodes > most
  end function is_cheaper

  !> Nodes along x and y for load `k` as it is seen from a place.
  pure function load_orders(loads, k, place) result(order)
    type(pressed_area), intent(in) :: loads
    integer, intent(in) :: k
    real(dp), intent(in) :: place(3)
    integer :: order(2)
    real(dp) :: half(2), middle(2), beside(2)

    half = [loads%half_x(k), loads%half_y(k)]
    middle = abs(place(:2) - [loads%x(k), loads%y(k)])
    beside = max(middle - half, 0.0_dp)
    order(1) = rule_order(middle(1)**2 + beside(2)**2 + place(3)**2, half(1))
    order(2) = rule_order(middle(2)**2 + beside(1)**2 + place(3)**2, half(2))
  end function load_orders

  !> Add the sums over the forces on a grid of cluster `k`.
  pure subroutine add_grid_forces(field, place, k, class, components, sums, stat)
    type(area_field), intent(inout) :: field
    real(dp), intent(in) :: place(3)
    integer, intent(in) :: k, class(2), components
    real(dp), intent(inout) :: sums(1, 6)
    integer, intent(inout) :: stat
    real(dp), dimension(FINEST**2) :: x, y, force
    integer :: n

    call prepare_cluster(field%clusters, k, class, stat)
    if (stat /= 0) return
    n = product(CLASS_POINTS(class))
    call place_cluster_forces(field%clusters, k, class, place(:2), x(:n), y(:n), force(:n))
    call add_forces(components, x(:n), y(:n), force(:n), field%poisson, [0.0_dp], [0.0_dp], place(3:3), sums)
  end subroutine add_grid_forces

  !> Add the field of the loads `range` (2) one by one: many nodes at once of those that are far from the place.
  pure subroutine add_loads(field, place, range, sums, near)
    type(area_field), intent(in) :: field
    real(dp), intent(in) :: place(3)
    integer, intent(in) :: range(2)
    real(dp), intent(inout) :: sums(1, 6), near(:)
    real(dp), dimension(SOURCES) :: x, y, force
    integer :: count, k, n, order(2)

    count = 0
    associate (loads => field%loads)
      do k = range(1), range(2)
        order = load_orders(loads, k, place)
        if (any(order > MOST_NODES)) then
          call add_near_load(field, place, k, near)
          cycle
        end if
        n = product(order)
        if (count + n > SOURCES) then
          call add_forces(size(near), x(:count), y(:count), force(:count), field%poisson, [0.0_dp], [0.0_dp], &
                          place(3:3), sums)
          count = 0
        end if
        call place_nodes(field%rules, order, [loads%x(k), loads%y(k)] - place(:2), [loads%half_x(k), loads%half_y(k)], &
                         loads%force(k), x(count + 1:count + n), y(count + 1:count + n), force(count + 1:count + n))
        count = count + n
      end do
    end associate
    call add_forces(size(near), x(:count), y(:count), force(:count), field%poisson, [0.0_dp], [0.0_dp], place(3:3), &
                    sums)
  end subroutine add_loads

  !> Add the field of load `k`, which is close to the place.
  pure subroutine add_near_load(field, place, k, near)
    type(area_field), intent(in) :: field
    real(dp), intent(in) :: place(3)
    integer, intent(in) :: k
    real(dp), intent(inout) :: near(:)
    real(dp) :: pressure

    pressure = 0.25_dp*(field%loads%force(k)/field%loads%half_x(k))/field%loads%half_y(k)
    if (size(near) == 6) then
      near = near + pressure*part_stress(field%rules, field%loads%seen_from(k, place(1), place(2)), place(3), &
                                         field%poisson)
    else
      near = near + pressure*part_displacement(field%rules, field%loads%seen_from(k, place(1), place(2)), place(3), &
                                               field%poisson)
    end if
  end subroutine add_near_load

end module fuge_area_field
