!> Sets and surfaces of a mesh by their names.
module fuge_mesh_sets
  use fuge_element_faces, only: face_nodes, split_type, FAMILY_PLANE, FAMILY_SOLID, MOST_FACE_NODES
  use fuge_input_deck, only: upper_case
  use fuge_kinds, only: dp
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_set
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_ELEMENT, FUGE_ERR_MESH, FUGE_ERR_OPTION
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: fuge_mesh_element_set, fuge_mesh_faces, fuge_mesh_node_set

  !> Length of a list of names in a message.
  integer, parameter :: LIST_LENGTH = 120
  !> A face looks into its element if the sine of the angle between it and the way to the middle is above this.
  real(dp), parameter :: INSIDE_PART = 1.0e-3_dp

contains

  !> The index of a name, in upper or lower case, among `names`; 0 and FUGE_ERR_OPTION with the known ones if it is none
  !> of them. `what` they are, for the message.
  pure subroutine find_name(names, wanted, what, number, info)
    character(len=*), intent(in) :: names(:), wanted, what
    integer, intent(out) :: number
    type(fuge_info), intent(inout) :: info

    do number = size(names), 1, -1
      if (names(number) == upper_case(wanted)) return
    end do
    call report(info, FUGE_ERR_OPTION, 'the mesh has no '//what//' '//quoted(trim(wanted))//', it has ' &
                //trim(listed(names)))
  end subroutine find_name

  !> Names for a message, as many as there is room for.
  pure function listed(names) result(list)
    character(len=*), intent(in) :: names(:)
    character(len=LIST_LENGTH + 20) :: list
    integer :: k

    list = 'none'
    do k = 1, size(names)
      if (k == 1 .and. len_trim(names(k)) <= LIST_LENGTH) then
        list = names(k)
      else if (len_trim(list) + 2 + len_trim(names(k)) <= LIST_LENGTH) then
        list = trim(list)//', '//names(k)
      else
        list = trim(list)//' and '//text(size(names) - k + 1)//' more'
        return
      end if
    end do
  end function listed

  !> The nodes of a set.
  !>
  !> `name`: in upper or lower case. `member`, allocated afresh: indices of the nodes in mesh%node, in the order of the
  !> file, each once.
  !> Errors, `member` unchanged: FUGE_ERR_OPTION if the mesh has no such set, with the names of those it has;
  !> FUGE_ERR_MEMORY.
  subroutine fuge_mesh_node_set(mesh, name, member, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, allocatable, intent(inout) :: member(:)
    type(fuge_info), intent(out) :: info

    call copy_set(mesh%node_set, name, 'set of nodes', member, info)
  end subroutine fuge_mesh_node_set

  !> The elements of a set, indices in mesh%element, as `fuge_mesh_node_set` the nodes.
  subroutine fuge_mesh_element_set(mesh, name, member, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, allocatable, intent(inout) :: member(:)
    type(fuge_info), intent(out) :: info

    call copy_set(mesh%element_set, name, 'set of elements', member, info)
  end subroutine fuge_mesh_element_set

  !> Copy the members of the set with a name; `sets` that are not allocated are none.
  pure subroutine copy_set(sets, name, what, member, info)
    type(fuge_mesh_set), allocatable, intent(in) :: sets(:)
    character(len=*), intent(in) :: name, what
    integer, allocatable, intent(inout) :: member(:)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: copy(:)
    integer :: k, stat

    k = 0
    if (allocated(sets)) then
      call find_name(sets%name, name, what, k, info)
    else
      call report(info, FUGE_ERR_OPTION, 'the mesh has no '//what//' '//quoted(trim(name))//', it has none')
    end if
    if (info%failed()) return
    allocate (copy(size(sets(k)%member)), stat=stat)
    call require_memory(stat, 'the '//what//' '//quoted(trim(name)), info)
    if (stat /= 0) return
    copy = sets(k)%member
    call move_alloc(copy, member)
  end subroutine copy_set

  !> The nodes of the faces of a surface.
  !>
  !> `name`: in upper or lower case. `faces` (8, faces), allocated afresh: indices of the nodes in mesh%node, corners
  !> first, then those on the edges, 0 beyond. Corners of a solid's face follow each other counter-clockwise if it is
  !> seen from outside; an edge of an element of a plane goes counter-clockwise round the element.
  !> Errors, `faces` unchanged: FUGE_ERR_OPTION if the mesh has no such surface, with the names of those it has;
  !> FUGE_ERR_ELEMENT for a type of elements that has no such face or whose faces are not known; FUGE_ERR_MESH for a
  !> face that looks into its element, because that is numbered the wrong way round; FUGE_ERR_MEMORY.
  subroutine fuge_mesh_faces(mesh, name, faces, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, allocatable, intent(inout) :: faces(:, :)
    type(fuge_info), intent(out) :: info
    integer, allocatable :: found(:, :)
    integer :: count, element, i, k, nodes(MOST_FACE_NODES), status, surface

    surface = 0
    if (allocated(mesh%surface)) then
      call find_name(mesh%surface%name, name, 'surface', surface, info)
    else
      call report(info, FUGE_ERR_OPTION, 'the mesh has no surface '//quoted(trim(name))//', it has none')
    end if
    if (info%failed()) return
    allocate (found(MOST_FACE_NODES, size(mesh%surface(surface)%element)), stat=status)
    call require_memory(status, 'the faces of '//quoted(name), info)
    if (status /= 0) return
    found = 0
    do k = 1, size(found, 2)
      element = mesh%surface(surface)%element(k)
      call face_nodes(mesh%element_type(element), mesh%surface(surface)%face(k), count, nodes)
      if (count == 0) then
        call report(info, FUGE_ERR_ELEMENT, 'surface '//quoted(name)//': element '//text(mesh%element(element)) &
                    //' of type '//trim(mesh%element_type(element))//' has no face S' &
                    //text(mesh%surface(surface)%face(k))//', or its faces are not known')
        return
      end if
      do i = 1, count
        found(i, k) = mesh%connection(mesh%first(element) + nodes(i) - 1)
      end do
      if (looks_inside(mesh, element, found(:count, k))) then
        call report(info, FUGE_ERR_MESH, 'surface '//quoted(name)//': face S'//text(mesh%surface(surface)%face(k)) &
                    //' of element '//text(mesh%element(element))//' looks into the element, whose nodes are ' &
                    //'numbered the wrong way round: number them as the type ' &
                    //trim(mesh%element_type(element))//' requires')
        return
      end if
    end do
    call move_alloc(found, faces)
  end subroutine fuge_mesh_faces

  !> Does a face of a solid, or of an element of a plane, look to the side where the middle of the element lies?
  pure function looks_inside(mesh, element, nodes) result(inside)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: element, nodes(:)
    logical :: inside
    real(dp) :: across(3, 2), distance(3), normal(3)
    integer :: count, family

    inside = .false.
    call split_type(mesh%element_type(element), family, count)
    if (family /= FAMILY_PLANE .and. family /= FAMILY_SOLID) return
    associate (x => mesh%position(:, nodes), &
               body => mesh%position(:, mesh%connection(mesh%first(element):mesh%first(element + 1) - 1)))
      distance = sum(body, 2)/real(size(body, 2), dp) - sum(x, 2)/real(size(nodes), dp)
      across(:, 1) = x(:, 2) - x(:, 1)
      across(:, 2) = [0.0_dp, 0.0_dp, 1.0_dp]
      ! Of a triangle two sides, of a quadrangle the diagonals.
      if (family == FAMILY_SOLID) across(:, 2) = x(:, 3) - x(:, 1)
      if (family == FAMILY_SOLID .and. modulo(size(nodes), 4) == 0) across = x(:, [3, 4]) - x(:, [1, 2])
    end associate
    normal = [across(2, 1)*across(3, 2) - across(3, 1)*across(2, 2), &
              across(3, 1)*across(1, 2) - across(1, 1)*across(3, 2), &
              across(1, 1)*across(2, 2) - across(2, 1)*across(1, 2)]
    inside = dot_product(normal, distance) > INSIDE_PART*norm2(normal)*norm2(distance)
  end function looks_inside

end module fuge_mesh_sets
