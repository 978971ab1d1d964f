!> The faces of the opposite surface, made ready for search.
module fuge_opposite_faces
  use fuge_face_geometry, only: face_nodes, face_normal, unit
  use fuge_face_shapes, only: corner_count, middle_place
  use fuge_face_tree, only: build_tree, face_tree
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  implicit none
  private

  public :: face_radius, prepare_opposite

  !> Two faces look against each other if the cosine between their normals is below this.
  real(dp), parameter, public :: FACING = -0.1_dp

  type, public :: opposite_faces
    type(face_tree) :: tree
    !> Unit normals in the middle of the faces, (3, faces).
    real(dp), allocatable :: normal(:, :)
    !> Unit normals at the nodes of the faces of the contact surface and of the opposite one, (3, nodes of a face,
    !> faces), where the gaps are those of curved surfaces; else (3, nodes of a face, 0).
    real(dp), allocatable :: own_bend(:, :, :), bend(:, :, :)
    !> Do gaps between curved surfaces follow the normal from place to place, or one direction for each node?
    logical :: turning = .false.
    !> Are the faces of both surfaces sections of rings?
    logical :: revolution = .false.
    !> How far an opposite may be, on both sides.
    real(dp) :: reach = 0.0_dp
  end type opposite_faces

contains

  !> Build the tree and find the normals. `reach` not above 0: the longer diagonal of the boxes of both surfaces.
  pure subroutine prepare_opposite(contact, opposite, reach, faces, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    real(dp), intent(in) :: reach
    type(opposite_faces), intent(inout) :: faces
    integer, intent(out) :: stat
    real(dp), allocatable :: box(:, :)
    real(dp) :: whole(6), other(6)
    type(face_nodes) :: face
    integer :: f

    allocate (box(6, size(opposite%face, 2)), faces%normal(3, size(opposite%face, 2)), stat=stat)
    if (stat /= 0) return
    do f = 1, size(opposite%face, 2)
      face = get_face(opposite, f)
      box(:, f) = face_box(face)
      faces%normal(:, f) = unit(face_normal(face, middle_place(face%kind)))
    end do
    call build_tree(box, faces%tree, stat)
    faces%reach = reach
    if (reach > 0.0_dp) return
    whole = surface_box(contact)
    other = surface_box(opposite)
    faces%reach = max(norm2(whole(4:) - whole(:3)), norm2(other(4:) - other(:3)))
  end subroutine prepare_opposite

  !> The box of a surface, lower and upper corner.
  pure function surface_box(surface) result(box)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp) :: box(6), part(6)
    integer :: f

    box(:3) = huge(1.0_dp)
    box(4:) = -huge(1.0_dp)
    do f = 1, size(surface%face, 2)
      part = face_box(get_face(surface, f))
      box(:3) = min(box(:3), part(:3))
      box(4:) = max(box(4:), part(4:))
    end do
  end function surface_box

  !> A box that holds a face: a curved one bulges beyond its nodes by less than a quarter of its extent.
  pure function face_box(face) result(box)
    type(face_nodes), intent(in) :: face
    real(dp) :: box(6), margin
    integer :: axis

    do axis = 1, 3
      box(axis) = minval(face%x(axis, :face%count))
      box(axis + 3) = maxval(face%x(axis, :face%count))
    end do
    margin = 1.0e-6_dp
    if (face%count > corner_count(face%kind)) margin = 0.25_dp
    margin = margin*maxval(box(4:) - box(:3))
    box(:3) = box(:3) - margin
    box(4:) = box(4:) + margin
  end function face_box

  !> The radius of a ball about the mean of the nodes that holds a face.
  pure function face_radius(face, middle) result(radius)
    type(face_nodes), intent(in) :: face
    real(dp), intent(in) :: middle(3)
    real(dp) :: radius
    integer :: k

    radius = 0.0_dp
    do k = 1, face%count
      radius = max(radius, norm2(face%x(:, k) - middle))
    end do
    if (face%count > corner_count(face%kind)) radius = 1.25_dp*radius
  end function face_radius

end module fuge_opposite_faces
