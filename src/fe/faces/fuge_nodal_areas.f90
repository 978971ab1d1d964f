!> Areas that belong to the nodes of a surface.
module fuge_nodal_areas
  use fuge_curved_faces, only: curved_point
  use fuge_face_geometry, only: circumference, face_nodes, face_normal, face_position
  use fuge_face_moments, only: mixed_values
  use fuge_face_shapes, only: shape_values, EDGE_3, MOST_NODES, TRIANGLE_3, TRIANGLE_6
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  implicit none
  private

  public :: find_nodal_areas

  !> Points along a line of a face.
  integer, parameter :: POINTS = 4

contains

  !> The area, in the plane the length, of each node, (nodes): the integral of its shape function
  !> mixed with its neighbours' (`middle_share`). Their sum is the area of the surface; zero at nodes that no face
  !> names. `normals` as in `get_face`: the area is that of the curved surface. `revolution`: that of rings.
  pure subroutine find_nodal_areas(surface, normals, revolution, area)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), intent(in) :: normals(:, :, :)
    logical, intent(in) :: revolution
    real(dp), intent(out) :: area(:)
    type(face_nodes) :: face
    integer :: f

    area = 0.0_dp
    do f = 1, size(surface%face, 2)
      face = get_face(surface, f, normals)
      face%revolution = revolution
      call add_areas(face, surface%face(:, f), area)
    end do
  end subroutine find_nodal_areas

  !> Add the areas of a face that belong to its nodes.
  pure subroutine add_areas(face, nodes, area)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: nodes(:)
    real(dp), intent(inout) :: area(:)
    real(dp) :: node(POINTS), weight(POINTS), place(2), values(MOST_NODES)
    integer :: i, j

    call gauss_rule(node, weight)
    do j = 1, merge(1, POINTS, face%kind <= EDGE_3)
      do i = 1, POINTS
        if (face%kind <= EDGE_3) then
          place = [2.0_dp*node(i) - 1.0_dp, 0.0_dp]
          values = 2.0_dp*weight(i)
        else if (face%kind == TRIANGLE_3 .or. face%kind == TRIANGLE_6) then
          place = [node(i)*(1.0_dp - node(j)), node(i)*node(j)]
          values = weight(i)*weight(j)*node(i)
        else
          place = 2.0_dp*[node(i), node(j)] - 1.0_dp
          values = 4.0_dp*weight(i)*weight(j)
        end if
        values = values*area_at(face, place)*mixed_values(face%kind, shape_values(face%kind, place))
        area(nodes(:face%count)) = area(nodes(:face%count)) + values(:face%count)
      end do
    end do
  end subroutine add_areas

  !> The area per area of the places.
  pure function area_at(face, place) result(area)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: place(2)
    real(dp) :: area, normal(3), position(3)

    if (face%bent) then
      call curved_point(face, place, position, normal)
    else
      normal = face_normal(face, place)
      position = face_position(face, place)
    end if
    area = norm2(normal)*circumference(face, position)
  end function area_at

end module fuge_nodal_areas
