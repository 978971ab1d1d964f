!> Normals at the nodes of a surface.
module fuge_nodal_normals
  use fuge_corner_normals, only: corner_normal
  use fuge_face_geometry, only: face_normal, face_nodes, unit
  use fuge_face_shapes, only: corner_count, node_place
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, FUGE_ERR_MESH
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  implicit none
  private

  public :: average_normals, take_normals

  !> A sum of normals below this fraction of the sum of their lengths has no direction.
  real(dp), parameter :: NO_DIRECTION = 1.0e-8_dp

  !> A normal looks outwards if the cosine of its angle with that of one of the faces is above this.
  real(dp), parameter :: OUTWARDS = 0.1_dp

contains

  !> Unit normals at all nodes, outwards, (3, nodes); zero at nodes that no face names.
  !>
  !> The mean of the normals of the faces at the node (`corner_normal`); of the faces beside a middle node.
  !> FUGE_ERR_MESH where they cancel. `stat` is not zero without memory.
  pure subroutine average_normals(surface, name, normal, stat, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    real(dp), intent(out) :: normal(:, :)
    integer, intent(out) :: stat
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: lengths(:)
    type(face_nodes) :: face
    real(dp) :: part(3)
    integer :: f, i, k

    allocate (lengths(size(normal, 2)), stat=stat)
    if (stat /= 0) return
    lengths = 0.0_dp
    normal = 0.0_dp
    do f = 1, size(surface%face, 2)
      face = get_face(surface, f)
      do k = 1, face%count
        i = surface%face(k, f)
        if (k <= corner_count(face%kind)) then
          part = corner_normal(face, k)
        else
          part = unit(face_normal(face, node_place(face%kind, k)))
        end if
        normal(:, i) = normal(:, i) + part
        lengths(i) = lengths(i) + norm2(part)
      end do
    end do
    call refuse_cancelled(surface, name, normal, lengths, info)
    if (info%failed()) return
    do i = 1, size(normal, 2)
      normal(:, i) = unit(normal(:, i))
    end do
  end subroutine average_normals

  !> Refuse nodes where the normals of the faces cancel.
  pure subroutine refuse_cancelled(surface, name, normal, lengths, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: normal(:, :), lengths(:)
    type(fuge_info), intent(inout) :: info
    integer :: f, i, k

    do f = 1, size(surface%face, 2)
      do k = 1, size(surface%face, 1)
        i = surface%face(k, f)
        if (i == 0) exit
        if (norm2(normal(:, i)) > NO_DIRECTION*lengths(i)) cycle
        call report(info, FUGE_ERR_MESH, name//': the normals of the faces at node '//index_text(i)//' cancel: split ' &
                    //'the surface there into two pairs')
        return
      end do
    end do
  end subroutine refuse_cancelled

  !> Unit normals along those given, (dimensions, nodes), of any length.
  !>
  !> FUGE_ERR_MESH for one that looks along all faces at its node, or into the body. `stat` is not zero without memory.
  pure subroutine take_normals(surface, name, given, normal, stat, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: given(:, :)
    real(dp), intent(out) :: normal(:, :)
    integer, intent(out) :: stat
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: outwards_somewhere(:)
    type(face_nodes) :: face
    integer :: f, i, k

    allocate (outwards_somewhere(size(normal, 2)), stat=stat)
    if (stat /= 0) return
    outwards_somewhere = .false.
    normal = 0.0_dp
    do f = 1, size(surface%face, 2)
      face = get_face(surface, f)
      do k = 1, face%count
        i = surface%face(k, f)
        normal(:size(given, 1), i) = given(:, i)/maxval(abs(given(:, i)))
        normal(:, i) = unit(normal(:, i))
        if (dot_product(unit(face_normal(face, node_place(face%kind, k))), normal(:, i)) > OUTWARDS) &
          outwards_somewhere(i) = .true.
      end do
    end do
    do f = 1, size(surface%face, 2)
      do k = 1, size(surface%face, 1)
        i = surface%face(k, f)
        if (i == 0) exit
        if (outwards_somewhere(i)) cycle
        call report(info, FUGE_ERR_MESH, name//': the normal given at node '//index_text(i)//' does not look ' &
                    //'outwards, as face '//index_text(f)//' does there: turn it round, or reverse the order of the ' &
                    //'nodes of the face if that is wrong')
        return
      end do
    end do
  end subroutine take_normals

end module fuge_nodal_normals
