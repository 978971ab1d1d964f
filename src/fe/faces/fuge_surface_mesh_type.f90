!> The surface of a body as a finite element program has it: nodes, faces and degrees of freedom.
module fuge_surface_mesh_type
  use fuge_face_shapes, only: face_kind
  use fuge_kinds, only: dp
  implicit none
  private

  public :: face_size, get_face

  !> A surface. Set components by name, since later versions may add some.
  !>
  !> A face has 2 or 3 nodes in the plane, 3, 4, 6 or 8 in space: its corners first, then the nodes in the middle of its
  !> sides, that between corners 1 and 2, between 2 and 3, and so on. In the plane the body lies to the left of the way
  !> from corner 1 to corner 2; in space the corners run counter-clockwise if seen from outside. Kinds may be mixed.
  type, public :: fuge_surface_mesh
    !> Positions, (dimensions, nodes), length. Nodes that no face names are only read by `fuge_join_bodies`: those with
    !> degrees of freedom tell on which side of its faces a body lies.
    real(dp), allocatable :: node(:, :)
    !> The nodes of each face, (most nodes of a face, faces); unused places, at the end, are 0.
    integer, allocatable :: face(:, :)
    !> Degrees of freedom of the nodes in the stiffness matrix, (dimensions, nodes); 0: it does not move. Not allocated:
    !> the surface is rigid.
    integer, allocatable :: dof(:, :)
  end type fuge_surface_mesh

contains

  !> Number of nodes of face `f`.
  pure function face_size(surface, f) result(count)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    integer :: count

    count = size(surface%face, 1)
    do while (count > 0)
      if (surface%face(count, f) /= 0) exit
      count = count - 1
    end do
  end function face_size

  !> The positions of the nodes of face `f`, and the normals of a curved surface there if they are known, (3, nodes of a
  !> face, faces).
  pure function get_face(surface, f, normal) result(face)
    use fuge_face_geometry, only: bend, face_nodes
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    real(dp), intent(in), optional :: normal(:, :, :)
    type(face_nodes) :: face
    integer :: k

    face%count = face_size(surface, f)
    face%kind = face_kind(size(surface%node, 1), face%count)
    do k = 1, face%count
      face%x(:size(surface%node, 1), k) = surface%node(:, surface%face(k, f))
    end do
    if (.not. present(normal)) return
    if (size(normal, 3) > 0) call bend(face, normal(:, :, f))
  end function get_face

end module fuge_surface_mesh_type
