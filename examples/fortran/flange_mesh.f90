!> Meshes of the example `flange`: half of the pitch of one bolt, from the middle of the bolt, y = 0, to the middle
!> between two bolts. The axis of the tube is z, the joint z = 0.
!>
!> Each body is a plan, drawn in patches of quadrangles, of which every patch is extruded over its own heights.
module flange_mesh
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: faces_inside, faces_level, faces_outside, make_bolt, make_flange, turn_over

  real(dp), parameter :: PI = acos(-1.0_dp)

  !> All lengths of a joint.
  type, public :: flange_sizes
    !> Radii of the bore, the outside of the tube, the circle of the bolts, and the rim.
    real(dp) :: bore = 50.0_dp, tube = 70.0_dp, bolt_circle = 95.0_dp, rim = 117.5_dp
    !> Height of a flange, and of the tube above it.
    real(dp) :: height = 30.0_dp, tube_height = 60.0_dp
    !> Radii of the bolt, its hole and its head; height of the head and of the nut.
    real(dp) :: bolt = 10.0_dp, hole = 11.0_dp, head = 15.0_dp, head_height = 12.5_dp
    integer :: bolts = 8
  end type flange_sizes

  !> Numbers of elements along the parts of a flange and of a bolt.
  type, public :: flange_cells
    !> Nodes of an edge less one: 1 for hexahedra of 8 nodes, 2 for 20.
    integer :: order = 2
    !> Around a bolt beside it and above it, from the hole outwards, from there to the middle between the bolts.
    integer :: beside = 1, above = 2, around = 2, between = 1
    !> Through the wall of the tube, from there to the bolt, from the bolt to the rim.
    integer :: wall = 1, inside = 2, outside = 1
    !> Through the height of a flange, and along the tube; of the shank, and of a head.
    integer :: height = 2, tube = 3
  end type flange_cells

  !> A mesh of hexahedra as `elastic_elements` takes it.
  type, public :: solid_mesh
    real(dp), allocatable :: node(:, :)
    integer, allocatable :: element(:, :)
  end type solid_mesh

  !> A patch of the plan: points (2, 0:, 0:), from element to element in steps of `order`; its first and last height.
  type :: plan_patch
    real(dp), allocatable :: point(:, :, :)
    integer, allocatable :: number(:, :)
    integer :: low = 0, high = 0
  end type plan_patch

  !> Nodes of the faces of a hexahedron, seen from outside counter-clockwise: below, above, and the four sides.
  integer, parameter :: FACE(8, 6) = reshape([1, 4, 3, 2, 12, 11, 10, 9, 5, 6, 7, 8, 13, 14, 15, 16, &
                                              1, 2, 6, 5, 9, 18, 13, 17, 2, 3, 7, 6, 10, 19, 14, 18, &
                                              3, 4, 8, 7, 11, 20, 15, 19, 4, 1, 5, 8, 12, 17, 16, 20], [8, 6])

contains

  !> The upper flange with its tube, from z = 0 upwards.
  subroutine make_flange(sizes, cells, mesh)
    type(flange_sizes), intent(in) :: sizes
    type(flange_cells), intent(in) :: cells
    type(solid_mesh), intent(out) :: mesh
    type(plan_patch) :: patch(8)
    real(dp) :: inner, half_pitch, outer, split
    real(dp), allocatable :: z(:)
    integer :: n

    n = cells%order
    ! The box around the bolt.
    inner = sizes%bolt_circle - 1.2_dp*sizes%head
    outer = sizes%bolt_circle + 1.2_dp*sizes%head
    half_pitch = PI/real(sizes%bolts, dp)
    split = 1.2_dp*sizes%head/sizes%bolt_circle
    z = [steps(0.0_dp, sizes%height, n*cells%height), &
         steps(sizes%height, sizes%height + sizes%tube_height, n*cells%tube)]
    z = [z(:n*cells%height), z(n*cells%height + 2:)]
    call draw_sector([sizes%bore, sizes%tube], [0.0_dp, split], n*[cells%wall, cells%beside], patch(1))
    call draw_sector([sizes%bore, sizes%tube], [split, half_pitch], n*[cells%wall, cells%between], patch(2))
    call draw_sector([sizes%tube, inner], [0.0_dp, split], n*[cells%inside, cells%beside], patch(3))
    call draw_sector([sizes%tube, inner], [split, half_pitch], n*[cells%inside, cells%between], patch(4))
    call draw_sector([inner, outer], [split, half_pitch], n*[cells%above, cells%between], patch(5))
    call draw_sector([outer, sizes%rim], [0.0_dp, split], n*[cells%outside, cells%beside], patch(6))
    call draw_sector([outer, sizes%rim], [split, half_pitch], n*[cells%outside, cells%between], patch(7))
    call draw_ring(box_line([inner, outer], split, n*[cells%above, cells%beside]), sizes%bolt_circle, sizes%hole, &
                   n*cells%around, patch(8))
    patch%high = n*cells%height
    patch(1:2)%high = size(z) - 1
    call extrude(patch, z, n, mesh)
  end subroutine make_flange

  !> The bolt, with a head at z = `length`/2 and a nut at -`length`/2.
  subroutine make_bolt(sizes, cells, length, mesh)
    type(flange_sizes), intent(in) :: sizes
    type(flange_cells), intent(in) :: cells
    real(dp), intent(in) :: length
    type(solid_mesh), intent(out) :: mesh
    type(plan_patch) :: patch(4)
    real(dp), allocatable :: circle(:, :), core(:, :), z(:)
    integer :: n, top

    n = cells%order
    z = [steps(-0.5_dp*length - sizes%head_height, -0.5_dp*length, n), &
         steps(-0.5_dp*length, 0.5_dp*length, 2*n*cells%height), &
         steps(0.5_dp*length, 0.5_dp*length + sizes%head_height, n)]
    top = 2*n*cells%height
    z = [z(:n + 1), z(n + 3:n + top + 2), z(n + top + 4:)]
    call draw_core(sizes%bolt_circle, 0.5_dp*sizes%bolt, n*[cells%above, cells%beside], patch(1), core)
    call draw_ring(core, sizes%bolt_circle, sizes%bolt, n*cells%around, patch(2))
    circle = patch(2)%point(:, :, ubound(patch(2)%point, 3))
    call draw_ring(circle, sizes%bolt_circle, sizes%head, n*cells%around, patch(3))
    patch(4) = patch(3)
    patch%high = size(z) - 1
    patch(3)%high = n
    patch(4)%low = size(z) - 1 - n
    call turn_round(patch(2))
    call turn_round(patch(3))
    call turn_round(patch(4))
    call extrude(patch, z, n, mesh)
  end subroutine make_bolt

  !> A sector of a ring between two radii and two angles.
  subroutine draw_sector(radius, angle, count, patch)
    real(dp), intent(in) :: radius(2), angle(2)
    integer, intent(in) :: count(2)
    type(plan_patch), intent(out) :: patch
    real(dp) :: r(0:count(1)), t(0:count(2))
    integer :: i, j

    r = steps(radius(1), radius(2), count(1))
    t = steps(angle(1), angle(2), count(2))
    allocate (patch%point(2, 0:count(1), 0:count(2)))
    do j = 0, count(2)
      do i = 0, count(1)
        patch%point(:, i, j) = r(i)*[cos(t(j)), sin(t(j))]
      end do
    end do
  end subroutine draw_sector

  !> The half of a box that surrounds the bolt, from its outer end over the side to its inner end.
  function box_line(radius, angle, count) result(line)
    real(dp), intent(in) :: radius(2), angle
    integer, intent(in) :: count(2)
    real(dp) :: line(2, 0:count(1) + 2*count(2))
    real(dp) :: r(0:count(1) + 2*count(2)), t(0:count(1) + 2*count(2))

    r = radius(2)
    r(count(2):count(2) + count(1)) = steps(radius(2), radius(1), count(1))
    r(count(2) + count(1):) = radius(1)
    t(:count(2)) = steps(0.0_dp, angle, count(2))
    t(count(2):count(2) + count(1)) = angle
    t(count(2) + count(1):) = steps(angle, 0.0_dp, count(2))
    line(1, :) = r*cos(t)
    line(2, :) = r*sin(t)
  end function box_line

  !> The rectangle inside a bolt, and the line around it, from its outer end to its inner one.
  subroutine draw_core(centre, half, count, patch, line)
    real(dp), intent(in) :: centre, half
    integer, intent(in) :: count(2)
    type(plan_patch), intent(out) :: patch
    real(dp), allocatable, intent(out) :: line(:, :)
    real(dp) :: x(0:count(1)), y(0:count(2))
    integer :: i, j

    x = steps(centre - half, centre + half, count(1))
    y = steps(0.0_dp, half, count(2))
    allocate (patch%point(2, 0:count(1), 0:count(2)), line(2, 0:count(1) + 2*count(2)))
    do j = 0, count(2)
      do i = 0, count(1)
        patch%point(:, i, j) = [x(i), y(j)]
      end do
    end do
    line(:, :count(2)) = patch%point(:, count(1), :)
    line(:, count(2):count(2) + count(1)) = patch%point(:, count(1):0:-1, count(2))
    line(:, count(2) + count(1):) = patch%point(:, 0, count(2):0:-1)
  end subroutine draw_core

  !> Rings of elements from a line to a circle about (centre, 0).
  subroutine draw_ring(line, centre, radius, count, patch)
    real(dp), intent(in) :: line(:, 0:), centre, radius
    integer, intent(in) :: count
    type(plan_patch), intent(out) :: patch
    real(dp) :: s(0:count), way(2)
    integer :: i, j

    s = steps(0.0_dp, 1.0_dp, count)
    allocate (patch%point(2, 0:ubound(line, 2), 0:count))
    do i = 0, ubound(line, 2)
      way = line(:, i) - [centre, 0.0_dp]
      way = [centre, 0.0_dp] + radius*way/norm2(way)
      do j = 0, count
        patch%point(:, i, j) = (1.0_dp - s(j))*line(:, i) + s(j)*way
      end do
    end do
  end subroutine draw_ring

  !> The other order of the points: rings that grow outwards are drawn from their other end.
  subroutine turn_round(patch)
    type(plan_patch), intent(inout) :: patch

    patch%point = patch%point(:, ubound(patch%point, 2):0:-1, :)
  end subroutine turn_round

  pure function steps(first, last, count) result(place)
    real(dp), intent(in) :: first, last
    integer, intent(in) :: count
    real(dp) :: place(0:count)
    integer :: i

    place = [((real(count - i, dp)*first + real(i, dp)*last)/real(count, dp), i=0, count)]
  end function steps

  !> Nodes and elements over all heights `z` (0:).
  subroutine extrude(patch, z, order, mesh)
    type(plan_patch), intent(inout) :: patch(:)
    real(dp), intent(in) :: z(0:)
    integer, intent(in) :: order
    type(solid_mesh), intent(out) :: mesh
    real(dp), allocatable :: plan(:, :)
    integer, allocatable :: number(:, :), element(:, :)
    integer :: e, i, j, k, p

    call number_points(patch, plan)
    allocate (number(size(plan, 2), 0:ubound(z, 1)), element(merge(20, 8, order == 2), &
              sum([(element_count(patch(p), order), p=1, size(patch))])))
    number = 0
    e = 0
    do p = 1, size(patch)
      do k = patch(p)%low, patch(p)%high - order, order
        do j = 0, ubound(patch(p)%number, 2) - order, order
          do i = 0, ubound(patch(p)%number, 1) - order, order
            e = e + 1
            call add_element(patch(p)%number(i:i + order, j:j + order), k, order, size(plan, 2), element(:, e))
          end do
        end do
      end do
    end do
    call number_nodes(plan, z, element, number, mesh)
  end subroutine extrude

  pure function element_count(patch, order) result(count)
    type(plan_patch), intent(in) :: patch
    integer, intent(in) :: order
    integer :: count

    count = (patch%high - patch%low)/order*(ubound(patch%number, 1)/order)*(ubound(patch%number, 2)/order)
  end function element_count

  !> Number the points of the plan; those of neighbours, where patches meet, are the same.
  subroutine number_points(patch, plan)
    type(plan_patch), intent(inout) :: patch(:)
    real(dp), allocatable, intent(out) :: plan(:, :)
    real(dp), allocatable :: found(:, :)
    integer :: i, j, k, n, p

    allocate (found(2, sum([(size(patch(p)%point)/2, p=1, size(patch))])))
    n = 0
    do p = 1, size(patch)
      allocate (patch(p)%number(0:ubound(patch(p)%point, 2), 0:ubound(patch(p)%point, 3)))
      do j = 0, ubound(patch(p)%point, 3)
        do i = 0, ubound(patch(p)%point, 2)
          do k = 1, n
            if (all(abs(found(:, k) - patch(p)%point(:, i, j)) < 1.0e-9_dp*maxval(abs(found(:, k))))) exit
          end do
          if (k > n) found(:, k) = patch(p)%point(:, i, j)
          n = max(n, k)
          patch(p)%number(i, j) = k
        end do
      end do
    end do
    plan = found(:, :n)
  end subroutine number_points

  !> The nodes of an element over a cell of the plan, as number in the plan + points of the plan times height.
  pure subroutine add_element(cell, level, order, points, element)
    integer, intent(in) :: cell(0:, 0:), level, order, points
    integer, intent(out) :: element(:)
    integer :: corner(4), middle(4)

    corner = [cell(0, 0), cell(order, 0), cell(order, order), cell(0, order)]
    element(:8) = [corner + points*level, corner + points*(level + order)]
    if (order == 1) return
    middle = [cell(1, 0), cell(2, 1), cell(1, 2), cell(0, 1)]
    element(9:) = [middle + points*level, middle + points*(level + 2), corner + points*(level + 1)]
  end subroutine add_element

  !> Number the nodes that elements use, and place them.
  subroutine number_nodes(plan, z, element, number, mesh)
    real(dp), intent(in) :: plan(:, :), z(0:)
    integer, intent(in) :: element(:, :)
    integer, intent(inout) :: number(:, 0:)
    type(solid_mesh), intent(inout) :: mesh
    integer :: e, i, k, n, p

    do e = 1, size(element, 2)
      do i = 1, size(element, 1)
        call split(element(i, e), size(plan, 2), p, k)
        number(p, k) = 1
      end do
    end do
    allocate (mesh%node(3, sum(number)))
    n = 0
    do k = 0, ubound(z, 1)
      do p = 1, size(plan, 2)
        if (number(p, k) == 0) cycle
        n = n + 1
        number(p, k) = n
        mesh%node(:, n) = [plan(:, p), z(k)]
      end do
    end do
    mesh%element = element
    do e = 1, size(element, 2)
      do i = 1, size(element, 1)
        call split(element(i, e), size(plan, 2), p, k)
        mesh%element(i, e) = number(p, k)
      end do
    end do
  end subroutine number_nodes

  pure subroutine split(code, points, p, k)
    integer, intent(in) :: code, points
    integer, intent(out) :: p, k

    p = modulo(code - 1, points) + 1
    k = (code - p)/points
  end subroutine split

  !> The faces at the height `z` that look upwards, or downwards.
  pure function faces_level(mesh, z, upwards) result(found)
    type(solid_mesh), intent(in) :: mesh
    real(dp), intent(in) :: z
    logical, intent(in) :: upwards
    integer, allocatable :: found(:, :)

    found = chosen_faces(mesh, abs(mesh%node(3, :) - z) < 1.0e-9_dp*maxval(abs(mesh%node(3, :))), &
                         merge([2], [1], upwards))
  end function faces_level

  !> All faces between a body and its surroundings.
  pure function faces_outside(mesh) result(found)
    type(solid_mesh), intent(in) :: mesh
    integer, allocatable :: found(:, :)

    found = chosen_faces(mesh, spread(.true., 1, size(mesh%node, 2)), [1, 2, 3, 4, 5, 6])
  end function faces_outside

  !> The faces on a cylinder about the axis, of this radius.
  pure function faces_inside(mesh, radius) result(found)
    type(solid_mesh), intent(in) :: mesh
    real(dp), intent(in) :: radius
    integer, allocatable :: found(:, :)

    found = chosen_faces(mesh, abs(norm2(mesh%node(:2, :), 1) - radius) < 1.0e-9_dp*radius, [3, 4, 5, 6])
  end function faces_inside

  !> The faces of these sides all of whose nodes are chosen, without those inside the body.
  pure function chosen_faces(mesh, chosen, side) result(found)
    type(solid_mesh), intent(in) :: mesh
    logical, intent(in) :: chosen(:)
    integer, intent(in) :: side(:)
    integer, allocatable :: found(:, :)
    integer :: all_faces(8, size(side)*size(mesh%element, 2)), e, n, nodes(8), per_face, s

    per_face = merge(8, 4, size(mesh%element, 1) == 20)
    n = 0
    do e = 1, size(mesh%element, 2)
      do s = 1, size(side)
        nodes(:per_face) = mesh%element(FACE(:per_face, side(s)), e)
        if (.not. all(chosen(nodes(:per_face)))) cycle
        if (is_inside(mesh%element, e, nodes(:4))) cycle
        n = n + 1
        all_faces(:per_face, n) = nodes(:per_face)
      end do
    end do
    found = all_faces(:per_face, :n)
  end function chosen_faces

  !> Does another element have the corners of this face of element `e`?
  pure function is_inside(element, e, corner) result(inside)
    integer, intent(in) :: element(:, :), e, corner(4)
    logical :: inside
    integer :: k, other

    inside = .true.
    do other = 1, size(element, 2)
      if (other == e) cycle
      if (all([(any(element(:8, other) == corner(k)), k=1, 4)])) return
    end do
    inside = .false.
  end function is_inside

  !> The same mesh below the joint: its elements begin with what is their upper face now.
  subroutine turn_over(mesh)
    type(solid_mesh), intent(inout) :: mesh
    integer, parameter :: ORDER(20) = [5, 6, 7, 8, 1, 2, 3, 4, 13, 14, 15, 16, 9, 10, 11, 12, 17, 18, 19, 20]

    mesh%node(3, :) = -mesh%node(3, :)
    mesh%element = mesh%element(ORDER(:size(mesh%element, 1)), :)
  end subroutine turn_over

end module flange_mesh
