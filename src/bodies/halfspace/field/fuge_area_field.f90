!> Stresses and displacements under rectangles at any points: close loads one by one, far ones in clusters.
!>
!> Points are taken in batches of neighbours, for which one walk through the clusters decides. A part of a batch that is
!> small against a cluster and too near to it goes on to the halves of the cluster; one that is large is halved itself.
module fuge_area_field
    use fuge_force_clusters, only: cluster_classes, force_clusters, new_force_clusters, place_cluster_forces, &
    prepare_cluster, set_single_cluster, CLASS_POINTS, FINEST, LEAST
  use fuge_kinds, only: dp
  use fuge_median_split, only: sort_by_place
  use fuge_point_forces, only: add_force_displacements, add_force_stresses, finish_displacement, finish_stress
  use fuge_pressed_area, only: pressed_area
  use fuge_rectangle_field, only: new_rectangle_rules, part_displacement, part_stress, place_nodes, rectangle_rules, &
    rule_order, MOST_NODES
  implicit none
  private

  public :: add_area_field, new_area_field

  !> Points of a batch, at most.
  integer, parameter :: MOST_POINTS = 64
  !> Forces that are collected before they are summed, at most.
  integer, parameter :: SOURCES = 512
  !> Up to this number of points, a sum over all loads takes less time than the moments of clusters.
  integer, parameter :: FEW_POINTS = 8
  !> A batch is halved if its extent exceeds this fraction of that of the cluster.
  real(dp), parameter :: BATCH_EXTENT = 0.5_dp

  !> The loads of an area, for any number of points. Clusters are made when they are needed.
  type, public :: area_field
    private
    type(pressed_area) :: loads
    type(force_clusters) :: clusters
    type(rectangle_rules) :: rules
    real(dp) :: poisson = 0.0_dp
    !> Points evaluated so far, as far as they matter for the clusters.
    integer :: asked = 0
  end type area_field

  !> Points close to each other, in the unit of the loads, and what has been summed for them.
  type :: point_batch
    integer :: count = 0
    !> Components: 6 are stresses, 3 displacements.
    integer :: components = 6
    real(dp) :: x(MOST_POINTS) = 0.0_dp, y(MOST_POINTS) = 0.0_dp, z(MOST_POINTS) = 0.0_dp
    !> Sums over point forces, and what is final already.
    real(dp) :: sums(MOST_POINTS, 6) = 0.0_dp, values(6, MOST_POINTS) = 0.0_dp
  end type point_batch

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
    integer, allocatable :: order(:)
    real(dp), allocatable :: places(:, :)
    integer :: k

    stat = 0
    if (field%loads%count < 1 .or. size(z) < 1) return
    if (field%asked <= FEW_POINTS) then
      field%asked = field%asked + min(size(z), FEW_POINTS + 1)
      if (field%asked > FEW_POINTS) call new_force_clusters(field%loads, field%clusters, stat)
      if (stat /= 0) return
    end if
    allocate (order(size(z)), places(size(z), 3), stat=stat)
    if (stat /= 0) return
    do k = 1, size(z)
      order(k) = k
      ! Points beyond FAR_EXPONENT do without a place.
      places(k, :) = 0.0_dp
      if (.not. field%loads%is_far_from(x(k), y(k), z(k))) places(k, :) = scale([x(k), y(k), z(k)], -field%loads%unit)
    end do
    call sort_by_place(places, 1, order)
    call add_batches(field, x, y, z, places, order, values, stat)
  end subroutine add_area_field

  !> Halve the list `order` of points until its parts are batches, and add their values.
  pure recursive subroutine add_batches(field, x, y, z, places, order, values, stat)
    type(area_field), intent(inout) :: field
    real(dp), intent(in) :: x(:), y(:), z(:), places(:, :)
    integer, intent(in) :: order(:)
    real(dp), intent(inout) :: values(:, :)
    integer, intent(inout) :: stat
    type(point_batch) :: batch
    integer :: k, middle

    if (stat /= 0) return
    if (size(order) > MOST_POINTS) then
      middle = (size(order) + 1)/2
      call add_batches(field, x, y, z, places, order(:middle), values, stat)
      call add_batches(field, x, y, z, places, order(middle + 1:), values, stat)
      return
    end if
    batch%count = size(order)
    batch%components = size(values, 1)
    batch%x(:batch%count) = places(order, 1)
    batch%y(:batch%count) = places(order, 2)
    batch%z(:batch%count) = places(order, 3)
    call add_cluster_field(field, batch, 1, batch%count, [1, 1, field%loads%count], stat)
    if (stat /= 0) return
    do k = 1, batch%count
      if (field%loads%is_far_from(x(order(k)), y(order(k)), z(order(k)))) then
        values(:, order(k)) = values(:, order(k)) + far_values(field, x(order(k)), y(order(k)), z(order(k)), &
                                                               size(values, 1))
      else
        values(:, order(k)) = values(:, order(k)) + batch_values(field, batch, k)
      end if
    end do
  end subroutine add_batches

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

  !> The values at point `k` of a batch.
  pure function batch_values(field, batch, k) result(values)
    type(area_field), intent(in) :: field
    type(point_batch), intent(in) :: batch
    integer, intent(in) :: k
    real(dp) :: values(batch%components)

    values = in_caller_units(field%loads, batch%values(:batch%components, k) &
                             + finished(batch%sums(k, :), batch%z(k), field%poisson, batch%components), &
                             field%loads%unit)
  end function batch_values

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

  !> Add the field of a cluster to points `first` to `last` of a batch. `cluster` (3): its number, and the first and the
  !> last of its loads.
  pure recursive subroutine add_cluster_field(field, batch, first, last, cluster, stat)
    type(area_field), intent(inout) :: field
    type(point_batch), intent(inout) :: batch
    integer, intent(in) :: first, last, cluster(3)
    integer, intent(inout) :: stat
    real(dp) :: low(3), high(3)
    integer :: class(2), middle

    if (stat /= 0) return
    low = [minval(batch%x(first:last)), minval(batch%y(first:last)), minval(batch%z(first:last))]
    high = [maxval(batch%x(first:last)), maxval(batch%y(first:last)), maxval(batch%z(first:last))]
    class = cluster_classes(field%clusters, cluster(1), low, high)
    if (minval(class) > 0) then
      if (is_cheaper(field, cluster, class, low, high)) then
        call add_grid_forces(field, batch, first, last, cluster(1), class, stat)
        return
      end if
    end if
    if (last > first .and. is_to_be_halved(field%clusters, cluster, maxval(high - low))) then
      middle = (first + last)/2
      call add_cluster_field(field, batch, first, middle, cluster, stat)
      call add_cluster_field(field, batch, middle + 1, last, cluster, stat)
    else if (2*cluster(1) > field%clusters%count) then
      call add_loads(field, batch, first, last, cluster(2:), low, high)
    else
      middle = (cluster(2) + cluster(3))/2
      call add_cluster_field(field, batch, first, last, [2*cluster(1), cluster(2), middle], stat)
      call add_cluster_field(field, batch, first, last, [2*cluster(1) + 1, middle + 1, cluster(3)], stat)
    end if
  end subroutine add_cluster_field

  !> Is a batch of this `extent` too large for a cluster?
  pure function is_to_be_halved(clusters, cluster, extent) result(halved)
    type(force_clusters), intent(in) :: clusters
    integer, intent(in) :: cluster(3)
    real(dp), intent(in) :: extent
    logical :: halved

    halved = extent > BATCH_EXTENT*2.0_dp*maxval(clusters%box(3:, cluster(1)))
    ! Many loads, but few points: each for itself, since most loads would be close to one of them.
    if (2*cluster(1) > clusters%count .and. cluster(3) - cluster(2) >= LEAST) halved = extent > 0.0_dp
  end function is_to_be_halved

  !> Are there fewer forces on the grid of a cluster than nodes on its loads?
  pure function is_cheaper(field, cluster, class, low, high) result(cheaper)
    type(area_field), intent(in) :: field
    integer, intent(in) :: cluster(3), class(2)
    real(dp), intent(in) :: low(3), high(3)
    logical :: cheaper
    integer :: k, most, nodes

    most = product(CLASS_POINTS(class))
    nodes = 0
    do k = cluster(2), cluster(3)
      nodes = nodes + product(load_orders(field%loads, k, low, high))
      if (nodes > most) exit
    end do
    cheaper = nodes > most
  end function is_cheaper

  !> Nodes along x and y for load `k` and all points between `low` and `high`.
  pure function load_orders(loads, k, low, high) result(order)
    type(pressed_area), intent(in) :: loads
    integer, intent(in) :: k
    real(dp), intent(in) :: low(3), high(3)
    integer :: order(2)
    real(dp) :: half(2), centre(2), middle(2), beside(2)

    centre = [loads%x(k), loads%y(k)]
    half = [loads%half_x(k), loads%half_y(k)]
    middle = max(low(:2) - centre, centre - high(:2), 0.0_dp)
    beside = max(middle - half, 0.0_dp)
    order(1) = rule_order(middle(1)**2 + beside(2)**2 + low(3)**2, half(1))
    order(2) = rule_order(middle(2)**2 + beside(1)**2 + low(3)**2, half(2))
  end function load_orders

  !> Add the field of the forces on a grid of cluster `k`.
  pure subroutine add_grid_forces(field, batch, first, last, k, class, stat)
    type(area_field), intent(inout) :: field
    type(point_batch), intent(inout) :: batch
    integer, intent(in) :: first, last, k, class(2)
    integer, intent(inout) :: stat
    real(dp), dimension(FINEST**2) :: x, y, force
    integer :: n

    call prepare_cluster(field%clusters, k, class, stat)
    if (stat /= 0) return
    n = product(CLASS_POINTS(class))
    call place_cluster_forces(field%clusters, k, class, [batch%x(first), batch%y(first)], x(:n), y(:n), force(:n))
    call add_sources(field%poisson, batch, first, last, x(:n), y(:n), force(:n))
  end subroutine add_grid_forces

  !> Add the field of point forces, whose places count from point `first`.
  pure subroutine add_sources(poisson, batch, first, last, x, y, force)
    real(dp), intent(in) :: poisson
    type(point_batch), intent(inout) :: batch
    integer, intent(in) :: first, last
    real(dp), intent(in), contiguous :: x(:), y(:), force(:)
    real(dp) :: sums(last - first + 1, 6)

    sums = 0.0_dp
    call add_forces(batch%components, x, y, force, poisson, batch%x(first:last) - batch%x(first), &
                    batch%y(first:last) - batch%y(first), batch%z(first:last), sums)
    batch%sums(first:last, :) = batch%sums(first:last, :) + sums
  end subroutine add_sources

  !> Add the field of the loads `range` (2) one by one: many nodes at once of those that are far from all points.
  pure subroutine add_loads(field, batch, first, last, range, low, high)
    type(area_field), intent(in) :: field
    type(point_batch), intent(inout) :: batch
    integer, intent(in) :: first, last, range(2)
    real(dp), intent(in) :: low(3), high(3)
    real(dp), dimension(SOURCES) :: x, y, force
    integer :: count, k, n, order(2)

    count = 0
    associate (loads => field%loads)
      do k = range(1), range(2)
        order = load_orders(loads, k, low, high)
        if (any(order > MOST_NODES)) then
          call add_near_load(field, batch, first, last, k)
          cycle
        end if
        n = product(order)
        if (count + n > SOURCES) then
          call add_sources(field%poisson, batch, first, last, x(:count), y(:count), force(:count))
          count = 0
        end if
        call place_nodes(field%rules, order, [loads%x(k) - batch%x(first), loads%y(k) - batch%y(first)], &
                         [loads%half_x(k), loads%half_y(k)], loads%force(k), x(count + 1:count + n), &
                         y(count + 1:count + n), force(count + 1:count + n))
        count = count + n
      end do
    end associate
    call add_sources(field%poisson, batch, first, last, x(:count), y(:count), force(:count))
  end subroutine add_loads

  !> Add the field of load `k`, which is close to some of the points.
  pure subroutine add_near_load(field, batch, first, last, k)
    type(area_field), intent(in) :: field
    type(point_batch), intent(inout) :: batch
    integer, intent(in) :: first, last, k
    real(dp) :: pressure
    integer :: i

    pressure = 0.25_dp*(field%loads%force(k)/field%loads%half_x(k))/field%loads%half_y(k)
    do i = first, last
      if (batch%components == 6) then
        batch%values(:, i) = batch%values(:, i) &
                             + pressure*part_stress(field%rules, field%loads%seen_from(k, batch%x(i), batch%y(i)), &
                                                    batch%z(i), field%poisson)
      else
        batch%values(:3, i) = batch%values(:3, i) &
          + pressure*part_displacement(field%rules, field%loads%seen_from(k, batch%x(i), batch%y(i)), batch%z(i), &
                                       field%poisson)
      end if
    end do
  end subroutine add_near_load

end module fuge_area_field
