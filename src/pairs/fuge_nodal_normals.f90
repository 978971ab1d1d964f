!> Normals at the nodes of a surface.
module fuge_nodal_normals
  use fuge_face_geometry, only: face_normal, face_nodes, unit
  use fuge_face_shapes, only: corner_count, node_place, EDGE_3
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MESH
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  implicit none
  private

  public :: average_normals

  !> A mean of unit normals shorter than this points nowhere.
  real(dp), parameter :: NO_DIRECTION = 1.0e-8_dp

contains

  !> Unit normals at all nodes, outwards, (3, nodes); zero at nodes that no face names.
  !>
  !> The mean of the normals of the faces, each at the node and weighted by its angle there, so that the mean does not
  !> depend on how a plane is cut into faces (G. Thuermer, C. Wuethrich: Computing vertex normals from polygonal facets,
  !> Journal of Graphics Tools 3, 1998). FUGE_ERR_MESH where the normals cancel.
  pure subroutine average_normals(surface, name, normal, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    real(dp), intent(out) :: normal(:, :)
    type(fuge_info), intent(inout) :: info
    type(face_nodes) :: face
    integer :: f, i, k

    normal = 0.0_dp
    do f = 1, size(surface%face, 2)
      face = get_face(surface, f)
      do k = 1, face%count
        i = surface%face(k, f)
        normal(:, i) = normal(:, i) + node_angle(face, k)*unit(face_normal(face, node_place(face%kind, k)))
      end do
    end do
    do f = 1, size(surface%face, 2)
      do k = 1, size(surface%face, 1)
        i = surface%face(k, f)
        if (i == 0) exit
        if (norm2(normal(:, i)) > NO_DIRECTION) cycle
        call report(info, FUGE_ERR_MESH, name//': the normals of the faces at node '//index_text(i)//' cancel: split ' &
                    //'the surface there into two pairs')
        return
      end do
    end do
    do i = 1, size(normal, 2)
      normal(:, i) = unit(normal(:, i))
    end do
  end subroutine average_normals

  !> The angle of a face at its node `k`.
  pure function node_angle(face, k) result(angle)
    type(face_nodes), intent(in) :: face
    integer, intent(in) :: k
    real(dp) :: angle, after(3), before(3)
    integer :: corners

    angle = 2.0_dp
    corners = corner_count(face%kind)
    if (face%kind <= EDGE_3 .or. k > corners) return
    after = unit(face%x(:, modulo(k, corners) + 1) - face%x(:, k))
    before = unit(face%x(:, modulo(k - 2, corners) + 1) - face%x(:, k))
    angle = 2.0_dp*atan2(norm2(after - before), norm2(after + before))
  end function node_angle

end module fuge_nodal_normals
