!> Pairs of a node and the face across from it.
!>
!> Simple, but forces between nodes cannot balance a uniform pressure if the meshes do not match: this method fails the
!> patch test (R. Taylor, P. Papadopoulos: On a patch test for contact problems in two dimensions, 1991).
module fuge_node_to_face
  use fuge_curved_faces, only: curved_gap, curved_point, curved_weights, find_opposite
  use fuge_face_geometry, only: face_nodes, face_normal, face_position, find_across, unit
  use fuge_face_shapes, only: lies_inside, shape_values, MOST_NODES
  use fuge_kinds, only: dp
  use fuge_opposite_faces, only: opposite_faces, FACING
  use fuge_pair_draft_type, only: pair_draft
  use fuge_surface_mesh_type, only: fuge_surface_mesh, get_face
  use fuge_weight_rows, only: add_weight
  implicit none
  private

  public :: pair_nodes

  !> A place belongs to a face if it lies beside it by at most this, in the face's own coordinates.
  real(dp), parameter :: BESIDE = 1.0e-8_dp
  !> Steps that turn the line of sight until it is the normal of the opposite face.
  integer, parameter :: TURNS = 10

contains

  !> Find the face across from each node of `contact`, along `normal`, (3, nodes). With `along_face` the line of sight
  !> is then turned until it is the normal of the opposite face. `stat` is not zero without memory.
  pure subroutine pair_nodes(contact, opposite, faces, normal, along_face, draft, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(opposite_faces), intent(in) :: faces
    real(dp), intent(in) :: normal(:, :)
    logical, intent(in) :: along_face
    type(pair_draft), intent(inout) :: draft
    integer, intent(out) :: stat
    integer, allocatable :: near(:)
    integer :: f, i, k

    allocate (near(64), stat=stat)
    if (stat /= 0) return
    do f = 1, size(contact%face, 2)
      do k = 1, size(contact%face, 1)
        i = contact%face(k, f)
        if (i == 0) exit
        if (draft%weight(i) < 0.0_dp .or. draft%weight(i) > 0.0_dp) cycle
        call pair_node(contact, opposite, faces, f, i, normal(:, i), along_face, near, draft, stat)
        if (stat /= 0) return
        ! Negative: a search has found no face.
        if (draft%face(i) == 0) draft%weight(i) = -1.0_dp
      end do
    end do
    draft%weight = max(draft%weight, 0.0_dp)
  end subroutine pair_nodes

  !> Find the nearest face along the normal of node `i`, which belongs to face `f`. The arguments are ten, because the
  !> work space of all nodes is the caller's.
  pure subroutine pair_node(contact, opposite, faces, f, i, normal, along_face, near, draft, stat)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    type(opposite_faces), intent(in) :: faces
    integer, intent(in) :: f, i
    real(dp), intent(in) :: normal(3)
    logical, intent(in) :: along_face
    integer, allocatable, intent(inout) :: near(:)
    type(pair_draft), intent(inout) :: draft
    integer, intent(inout) :: stat
    type(face_nodes) :: face
    real(dp) :: x(3), place(2), distance, best, best_place(2), cosine
    integer :: best_face, count, k
    logical :: found

    x = 0.0_dp
    x(:size(contact%node, 1)) = contact%node(:, i)
    call faces%tree%find(x - faces%reach*normal, 2.0_dp*faces%reach*normal, 0.0_dp, near, count, stat)
    if (stat /= 0) return
    best = huge(best)
    best_face = 0
    best_place = 0.0_dp
    do k = 1, count
      face = get_face(opposite, near(k))
      call find_across(face, x, normal, place, distance, found)
      if (.not. found) cycle
      if (abs(distance) > faces%reach .or. .not. lies_inside(face%kind, place, BESIDE)) cycle
      cosine = dot_product(unit(face_normal(face, place)), normal)
      if (cosine > -FACING .and. draft%alike(1) == 0) draft%alike = [f, near(k)]
      if (cosine >= FACING) cycle
      ! On a common side the face of the lower number, whatever the order of the search.
      if (abs(distance) > best .or. (abs(distance) >= best .and. near(k) > best_face)) cycle
      best = abs(distance)
      best_face = near(k)
      best_place = place
    end do
    if (best_face == 0) return
    call add_pair(opposite, faces, i, best_face, best_place, x, normal, along_face, draft, stat)
  end subroutine pair_node

  !> Enter a node and the place across from it. The arguments are ten, because they are all that is known of a pair.
  pure subroutine add_pair(opposite, faces, i, f, place, x, normal, along_face, draft, stat)
    type(fuge_surface_mesh), intent(in) :: opposite
    type(opposite_faces), intent(in) :: faces
    integer, intent(in) :: i, f
    real(dp), intent(in) :: place(2), x(3), normal(3)
    logical, intent(in) :: along_face
    type(pair_draft), intent(inout) :: draft
    integer, intent(inout) :: stat
    type(face_nodes) :: face
    real(dp) :: direction(3), distance, facing(3), here(2), next(2), there(3), values(MOST_NODES), &
      axes(3, MOST_NODES)
    real(dp), parameter :: NONE(3) = 0.0_dp
    integer :: k
    logical :: found

    face = get_face(opposite, f, faces%bend)
    direction = normal
    here = place
    if (along_face) then
      do k = 1, TURNS
        direction = -unit(face_normal(face, here))
        call find_across(face, x, direction, next, distance, found)
        if (.not. found) exit
        if (.not. lies_inside(face%kind, next, BESIDE)) exit
        here = next
      end do
      direction = -unit(face_normal(face, here))
    end if
    values = shape_values(face%kind, here)
    draft%weight(i) = 1.0_dp
    draft%share(i) = 1.0_dp
    draft%face(i) = f
    draft%place(:, i) = here
    draft%normal(:, i) = -direction
    draft%way(:, i) = face_position(face, here) - x
    if (face%bent) then
      if (.not. along_face) call find_opposite(face, x, direction, here)
      call curved_point(face, here, there, facing)
      facing = unit(facing)
      if (along_face) direction = -facing
      draft%normal(:, i) = facing
      draft%way(:, i) = curved_gap(there - x, direction, facing)*direction
    end if
    axes = 0.0_dp
    if (face%bent) then
      axes = curved_weights(face, here, direction) - spread(direction, 2, MOST_NODES)*spread(values, 1, 3)
    end if
    call add_weight(draft%own, i, i, 1.0_dp, NONE, stat)
    do k = 1, face%count
      call add_weight(draft%other, i, opposite%face(k, f), values(k), axes(:, k), stat)
      if (stat /= 0) return
    end do
  end subroutine add_pair

end module fuge_node_to_face
