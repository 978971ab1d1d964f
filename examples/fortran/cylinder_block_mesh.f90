!> Meshes of the example `cylinder_block`: a quarter of a cylinder with its lowest point at the origin, and half of a
!> block below it. Only x >= 0 is meshed.
module cylinder_block_mesh
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: make_block, make_cylinder

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Elements along each way out of the fine zone over those along the zone itself.
  integer, parameter :: LENGTHS = 3

  !> A mesh in the plane; elements of 4 or 8 nodes, as `elastic_elements` takes them.
  type, public :: plane_mesh
    real(dp), allocatable :: node(:, :)
    integer, allocatable :: element(:, :)
    !> Edges that may touch, (2 or 3, edges), as fuge_surface_mesh takes them.
    integer, allocatable :: edge(:, :)
    !> Nodes on the axis x = 0, and on the far side, that of the support.
    integer, allocatable :: axis(:), far(:)
  end type plane_mesh

contains

  !> The lower quarter of a cylinder, cut at its centre: a ring of elements around a core.
  !>
  !> `zone`: width and depth of the zone with `cells` (an even number) equal elements, from which on they grow;
  !> `order` 1 or 2.
  subroutine make_cylinder(radius, zone, cells, order, mesh)
    real(dp), intent(in) :: radius, zone
    integer, intent(in) :: cells, order
    type(plane_mesh), intent(out) :: mesh
    real(dp) :: around, s
    integer, allocatable :: core(:, :), ring(:, :)
    integer :: graded, i, j, nodes, uniform

    ! Graded from 0 to 45 degrees, equal steps from there on to 90.
    graded = LENGTHS*cells*order
    uniform = cells/2*order
    allocate (ring(0:graded + uniform, 0:graded), core(0:graded, 0:uniform))
    ring = 0
    core = 0
    nodes = 0
    call number_nodes(order, ring, nodes)
    core(:, 0) = ring(:graded, graded)
    core(graded, :) = ring(graded:, graded)
    call number_nodes(order, core, nodes)
    allocate (mesh%node(2, nodes))
    do j = 0, graded
      do i = 0, graded + uniform
        if (ring(i, j) == 0) cycle
        around = 0.25_dp*PI*(1.0_dp + real(max(i - graded, 0), dp)/real(uniform, dp))
        if (i <= graded) around = graded_place(zone/radius, 0.25_dp*PI, real(i, dp)/real(cells*order, dp))
        s = graded_place(zone, 0.5_dp*radius, real(j, dp)/real(cells*order, dp))/(0.5_dp*radius)
        mesh%node(:, ring(i, j)) = radius*((1.0_dp - s)*[sin(around), 1.0_dp - cos(around)] + s*core_edge(around))
      end do
    end do
    do j = 1, uniform
      do i = 0, graded - 1
        if (core(i, j) == 0) cycle
        s = real(j, dp)/real(uniform, dp)
        around = graded_place(zone/radius, 0.25_dp*PI, real(i, dp)/real(cells*order, dp))
        mesh%node(:, core(i, j)) = radius*((1.0_dp - s)*core_edge(around) + s*core_top(around))
      end do
    end do
    call add_elements(order, ring, mesh%element)
    call add_elements(order, core, mesh%element)
    mesh%axis = [pack(ring(0, :), ring(0, :) > 0), pack(core(0, 1:), core(0, 1:) > 0)]
    mesh%far = [pack(ring(graded + uniform, :), ring(graded + uniform, :) > 0), &
                pack(core(:graded - 1, uniform), core(:graded - 1, uniform) > 0)]
    mesh%edge = edges_of(order, ring(:cells*order, 0))
  end subroutine make_cylinder

  !> Half of a block, `size` wide and deep, its surface at y = 0.
  subroutine make_block(size, zone, cells, order, mesh)
    real(dp), intent(in) :: size, zone
    integer, intent(in) :: cells, order
    type(plane_mesh), intent(out) :: mesh
    integer, allocatable :: grid(:, :)
    integer :: i, j, n, nodes

    n = LENGTHS*cells*order
    allocate (grid(0:n, 0:n))
    grid = 0
    nodes = 0
    call number_nodes(order, grid, nodes)
    allocate (mesh%node(2, nodes))
    do j = 0, n
      do i = 0, n
        if (grid(i, j) == 0) cycle
        mesh%node(1, grid(i, j)) = graded_place(zone, size, real(i, dp)/real(cells*order, dp))
        mesh%node(2, grid(i, j)) = -graded_place(zone, size, real(n - j, dp)/real(cells*order, dp))
      end do
    end do
    call add_elements(order, grid, mesh%element)
    mesh%axis = pack(grid(0, :), grid(0, :) > 0)
    mesh%far = pack(grid(:, 0), grid(:, 0) > 0)
    mesh%edge = edges_of(order, grid(cells*order:0:-1, n))
  end subroutine make_block

  !> Where the elements end that begin at 0: equal steps as far as `zone`, at s = 1; from there on they grow without a
  !> jump, to `extent` at s = LENGTHS.
  pure function graded_place(zone, extent, s) result(place)
    real(dp), intent(in) :: zone, extent, s
    real(dp) :: place
    real(dp) :: above, below, growth
    integer :: k

    place = zone*s
    if (s <= 1.0_dp) return
    below = 1.0e-3_dp
    above = 20.0_dp
    do k = 1, 60
      growth = 0.5_dp*(below + above)
      if (1.0_dp + (exp(growth*real(LENGTHS - 1, dp)) - 1.0_dp)/growth > extent/zone) then
        above = growth
      else
        below = growth
      end if
    end do
    place = zone*(1.0_dp + (exp(growth*(s - 1.0_dp)) - 1.0_dp)/growth)
  end function graded_place

  !> The boundary of the core, straight lines, over the angle; all in radii, as seen from the lowest point.
  pure function core_edge(around) result(place)
    real(dp), intent(in) :: around
    real(dp) :: place(2)
    real(dp), parameter :: CORNER = 0.36_dp

    if (around <= 0.25_dp*PI) then
      place = [CORNER*around/(0.25_dp*PI), 0.5_dp + (0.5_dp - CORNER)*around/(0.25_dp*PI)]
    else
      place = [CORNER + (0.5_dp - CORNER)*(around/(0.25_dp*PI) - 1.0_dp), &
               1.0_dp - CORNER*(2.0_dp - around/(0.25_dp*PI))]
    end if
  end function core_edge

  !> The upper side of the core, on the cut.
  pure function core_top(around) result(place)
    real(dp), intent(in) :: around
    real(dp) :: place(2)

    place = [0.5_dp*around/(0.25_dp*PI), 1.0_dp]
  end function core_top

  !> Number the points of a grid that have none (0) and are nodes: with `order` 2 elements have none in their middle.
  pure subroutine number_nodes(order, grid, nodes)
    integer, intent(in) :: order
    integer, intent(inout) :: grid(0:, 0:)
    integer, intent(inout) :: nodes
    integer :: i, j

    do j = 0, ubound(grid, 2)
      do i = 0, ubound(grid, 1)
        if (grid(i, j) > 0 .or. (order == 2 .and. modulo(i, 2) == 1 .and. modulo(j, 2) == 1)) cycle
        nodes = nodes + 1
        grid(i, j) = nodes
      end do
    end do
  end subroutine number_nodes

  !> Add the elements of a grid.
  pure subroutine add_elements(order, grid, element)
    integer, intent(in) :: order, grid(0:, 0:)
    integer, allocatable, intent(inout) :: element(:, :)
    integer, allocatable :: all(:, :)
    integer :: before, e, i, j

    before = 0
    if (allocated(element)) before = size(element, 2)
    allocate (all(4*order, before + ubound(grid, 1)/order*(ubound(grid, 2)/order)))
    if (allocated(element)) all(:, :before) = element
    e = before
    do j = 0, ubound(grid, 2) - order, order
      do i = 0, ubound(grid, 1) - order, order
        e = e + 1
        all(:4, e) = [grid(i, j), grid(i + order, j), grid(i + order, j + order), grid(i, j + order)]
        if (order == 2) all(5:, e) = [grid(i + 1, j), grid(i + 2, j + 1), grid(i + 1, j + 2), grid(i, j + 1)]
      end do
    end do
    call move_alloc(all, element)
  end subroutine add_elements

  !> Edges along a line of nodes, corners first.
  pure function edges_of(order, line) result(edge)
    integer, intent(in) :: order, line(0:)
    integer, allocatable :: edge(:, :)
    integer :: e

    allocate (edge(order + 1, ubound(line, 1)/order))
    do e = 1, size(edge, 2)
      edge(:2, e) = [line(order*(e - 1)), line(order*e)]
      if (order == 2) edge(3, e) = line(2*e - 1)
    end do
  end function edges_of

end module cylinder_block_mesh
