!> Checks of a surface of finite elements: sizes, numbers, and faces that no body can have.
module fuge_surface_checks
  use fuge_constants, only: LARGEST_EXPONENT_OF_4
  use fuge_face_geometry, only: face_normal, face_nodes
  use fuge_face_shapes, only: corner_count, face_kind, middle_place, node_place, EDGE_3, MOST_NODES, NO_FACE
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_DOF, FUGE_ERR_ELEMENT, FUGE_ERR_MEMORY, FUGE_ERR_MESH, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: face_size, fuge_surface_mesh, get_face
  implicit none
  private

  public :: check_radii, check_surface

  !> An area below this, relative to the square of the greatest distance in the face, counts as zero.
  real(dp), parameter :: NO_AREA = 1.0e-10_dp
  !> A radius below this, relative to the length of the face, counts as zero.
  real(dp), parameter :: NO_RADIUS = 1.0e-10_dp

contains

  !> Refuse a surface that is none; `name` is what messages call it.
  !>
  !> Errors, which name the face or the node: FUGE_ERR_SIZE for sizes and node numbers out of range; FUGE_ERR_ELEMENT
  !> for a face with a number of nodes that none has; FUGE_ERR_NOT_FINITE; FUGE_ERR_OVERFLOW; FUGE_ERR_MESH for a face
  !> without area, folded over or the wrong way round beside its neighbour; FUGE_ERR_DOF for a degree of freedom that is
  !> negative or belongs to two nodes; FUGE_ERR_MEMORY.
  pure subroutine check_surface(surface, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: f

    call check_sizes(surface, name, info)
    if (info%failed()) return
    do f = 1, size(surface%face, 2)
      call check_face(surface, f, name//': face '//index_text(f), info)
      if (info%failed()) return
    end do
    call check_neighbours(surface, name, info)
    if (allocated(surface%dof) .and. .not. info%failed()) call check_degrees(surface, name, info)
  end subroutine check_surface

  !> Refuse a checked surface in the plane that is no section of a body of revolution: with FUGE_ERR_MESH a node on the
  !> other side of the axis, or a face that lies on it.
  pure subroutine check_radii(surface, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    real(dp) :: least
    integer :: f, k

    do f = 1, size(surface%face, 2)
      associate (nodes => surface%face(:face_size(surface, f), f))
        least = NO_RADIUS*maxval(maxval(surface%node(:, nodes), 2) - minval(surface%node(:, nodes), 2))
        k = minloc(surface%node(1, nodes), 1)
        if (surface%node(1, nodes(k)) < -least) then
          call report(info, FUGE_ERR_MESH, name//': node '//index_text(nodes(k))//' has the radius ' &
                      //text(surface%node(1, nodes(k)))//': the section of a body of revolution lies at x >= 0')
        else if (maxval(surface%node(1, nodes)) <= least) then
          call report(info, FUGE_ERR_MESH, name//': face '//index_text(f)//' lies on the axis of revolution: remove it')
        end if
      end associate
      if (info%failed()) return
    end do
  end subroutine check_radii

  !> Refuse arrays of impossible sizes.
  pure subroutine check_sizes(surface, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. (allocated(surface%node) .and. allocated(surface%face))) then
      call report(info, FUGE_ERR_SIZE, name//': node and face are needed: positions and the nodes of the faces')
    else if (size(surface%node, 1) < 2 .or. size(surface%node, 1) > 3) then
      call report(info, FUGE_ERR_SIZE, name//': node has '//text(size(surface%node, 1))//' rows: it needs 2 in the ' &
                  //'plane, 3 in space')
    else if (size(surface%node, 2) < 1 .or. size(surface%face, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, name//': there are '//text(size(surface%node, 2))//' nodes and ' &
                  //text(size(surface%face, 2))//' faces: at least one face is needed')
    else if (size(surface%face, 1) > MOST_NODES) then
      call report(info, FUGE_ERR_SIZE, name//': face has '//text(size(surface%face, 1))//' rows: no face has more ' &
                  //'than '//text(MOST_NODES)//' nodes')
    else if (allocated(surface%dof)) then
      if (any(shape(surface%dof) /= shape(surface%node))) call report(info, FUGE_ERR_SIZE, name//': dof is ' &
        //text(size(surface%dof, 1))//' by '//text(size(surface%dof, 2))//', node '//text(size(surface%node, 1)) &
        //' by '//text(size(surface%node, 2))//': they need the same shape')
    end if
  end subroutine check_sizes

  !> Refuse one face; `name` says which.
  pure subroutine check_face(surface, f, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: count, k

    count = face_size(surface, f)
    if (face_kind(size(surface%node, 1), count) == NO_FACE) then
      call report(info, FUGE_ERR_ELEMENT, name//' has '//text(count)//' nodes: it needs ' &
                  //trim(merge('2 or 3      ', '3, 4, 6 or 8', size(surface%node, 1) == 2)))
      return
    end if
    do k = 1, count
      associate (node => surface%face(k, f))
        if (node < 1 .or. node > size(surface%node, 2)) then
          call report(info, FUGE_ERR_SIZE, name//' names node '//index_text(node)//', which is not one of the ' &
                      //text(size(surface%node, 2))//' nodes')
        else if (any(surface%face(:k - 1, f) == node)) then
          call report(info, FUGE_ERR_MESH, name//' names node '//index_text(node)//' twice: a quadrangle with two ' &
                      //'nodes in one is a triangle')
        else
          call check_finite(surface%node(:, node), name//', node '//index_text(node)//': position', info)
        end if
      end associate
      if (info%failed()) return
    end do
    call check_shape(get_face(surface, f), name, info)
  end subroutine check_face

  !> Refuse a face without area, or one folded over.
  pure subroutine check_shape(face, name, info)
    type(face_nodes), intent(in) :: face
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    real(dp) :: middle(3), normal(3), extent, least
    integer :: folded, k
    logical :: any_area

    extent = maxval(maxval(face%x(:, :face%count), 2) - minval(face%x(:, :face%count), 2))
    if (exponent(maxval(abs(face%x))) > LARGEST_EXPONENT_OF_4 &
        .or. (extent > 0.0_dp .and. exponent(extent) < -LARGEST_EXPONENT_OF_4)) then
      call report(info, FUGE_ERR_OVERFLOW, name//' has positions out of range: choose other units')
      return
    end if
    middle = face_normal(face, middle_place(face%kind))
    least = NO_AREA*extent**merge(1, 2, face%kind <= EDGE_3)
    folded = 0
    any_area = norm2(middle) > least
    do k = 1, face%count
      normal = face_normal(face, node_place(face%kind, k))
      any_area = any_area .or. norm2(normal) > least
      ! Zero is allowed: a corner of 180 degrees.
      if (folded == 0 .and. dot_product(normal, middle) < -NO_AREA*dot_product(middle, middle)) folded = k
    end do
    if (.not. any_area) then
      call report(info, FUGE_ERR_MESH, name//' has no '//trim(merge('length', 'area  ', face%kind <= EDGE_3)) &
                  //': remove it, or separate its nodes')
    else if (folded > 0 .or. .not. norm2(middle) > least) then
      call report(info, FUGE_ERR_MESH, name//' is folded over at its node '//index_text(max(folded, 1))//': number ' &
                  //'its corners around it, then the middle nodes in the same order')
    end if
  end subroutine check_shape

  !> Refuse neighbours that run along their common side, or through their common node in the plane, the same way: the
  !> normal of one of them points into the body.
  pure subroutine check_neighbours(surface, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: begin(:), side_face(:), side_end(:)
    integer :: f, k, last, next, p, sides, stat

    allocate (begin(size(surface%node, 2) + 1), side_face(4*size(surface%face, 2)), side_end(4*size(surface%face, 2)), &
              stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to check the faces of '//name)
      return
    end if
    ! Sides by the node where they begin.
    begin = 0
    do f = 1, size(surface%face, 2)
      do k = 1, side_count(surface, f)
        associate (count => begin(surface%face(k, f)))
          count = count + 1
        end associate
      end do
    end do
    last = 1
    do k = 1, size(begin)
      sides = begin(k)
      begin(k) = last
      last = last + sides
    end do
    side_face = 0
    do f = 1, size(surface%face, 2)
      sides = side_count(surface, f)
      do k = 1, sides
        next = 0
        if (sides > 1) next = surface%face(modulo(k, sides) + 1, f)
        do p = begin(surface%face(k, f)), begin(surface%face(k, f) + 1) - 1
          if (side_face(p) == 0) exit
          if (side_end(p) == next) then
            call report(info, FUGE_ERR_MESH, name//': faces '//index_text(side_face(p))//' and '//index_text(f) &
                        //', which meet at node '//index_text(surface%face(k, f))//', look to opposite sides: ' &
                        //'reverse the order of the nodes of one of them')
            return
          end if
        end do
        side_face(p) = f
        side_end(p) = next
      end do
    end do
  end subroutine check_neighbours

  !> Sides of a face; an edge in the plane counts as one, at its first node.
  pure function side_count(surface, f) result(count)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: f
    integer :: count

    count = corner_count(face_kind(size(surface%node, 1), face_size(surface, f)))
    if (size(surface%node, 1) == 2) count = 1
  end function side_count

  !> Refuse degrees of freedom that are negative or belong to two nodes.
  pure subroutine check_degrees(surface, name, info)
    type(fuge_surface_mesh), intent(in) :: surface
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: owner(:)
    integer :: i, k, stat

    if (minval(surface%dof) < 0) then
      i = minloc(minval(surface%dof, 1), 1)
      call report(info, FUGE_ERR_DOF, name//', node '//index_text(i)//': degree of freedom ' &
                  //index_text(minval(surface%dof(:, i)))//' does not exist')
      return
    end if
    allocate (owner(maxval(surface%dof)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to check the degrees of freedom of '//name)
      return
    end if
    owner = 0
    do i = 1, size(surface%dof, 2)
      do k = 1, size(surface%dof, 1)
        associate (dof => surface%dof(k, i))
          if (dof == 0) cycle
          if (owner(dof) /= 0) then
            call report(info, FUGE_ERR_DOF, name//': nodes '//index_text(owner(dof))//' and '//index_text(i) &
                        //' both have degree of freedom '//index_text(dof)//': each needs its own')
            return
          end if
          owner(dof) = i
        end associate
      end do
    end do
  end subroutine check_degrees

end module fuge_surface_checks
