!> Meshes and stiffness matrices from files, put together: surfaces with the degrees of freedom of their nodes, and the
!> degrees of freedom of sets of nodes.
module fuge_mesh_rows
  use fuge_element_faces, only: split_type, FAMILY_PLANE, FAMILY_SOLID
  use fuge_input_deck, only: upper_case
  use fuge_mesh_sets, only: fuge_mesh_faces, fuge_mesh_node_set
  use fuge_mesh_type, only: fuge_mesh
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_DOF, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, &
    FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: fuge_mesh_contact_surface, fuge_mesh_degrees

  !> Directions of a node: displacements along x, y, z, and rotations.
  integer, parameter :: DIRECTIONS = 6

contains

  !> A surface of a mesh with the degrees of freedom that its nodes have in a stiffness matrix.
  !>
  !> `name`: of the surface, in upper or lower case. `dimensions`: 2 for elements of a plane, whose x and y are taken,
  !> or 3. `node` and `direction` (rows of the matrix): the names of the rows, as fuge_read_stiffness returns them.
  !> `surface` is that of `fuge_find_pairs` and `fuge_join_bodies`, and has all nodes of the mesh, so that node i of it
  !> is node mesh%node(i) of the file; degrees of freedom that the matrix does not have are 0, since programs leave out
  !> those of supports.
  !> Errors, `surface` unchanged: FUGE_ERR_OPTION if the mesh has no such surface or `dimensions` is another number;
  !> FUGE_ERR_ELEMENT for faces of unknown elements, or of other dimensions; FUGE_ERR_SIZE; FUGE_ERR_DOF for a matrix
  !> without names, a row named twice, a matrix that knows no node of the surface, and a matrix of another mesh: it
  !> misses a node of the surface and has rows of nodes that the mesh does not have; FUGE_ERR_MEMORY.
  subroutine fuge_mesh_contact_surface(mesh, name, dimensions, node, direction, surface, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, intent(in) :: dimensions, node(:), direction(:)
    type(fuge_surface_mesh), intent(inout) :: surface
    type(fuge_info), intent(out) :: info
    type(fuge_surface_mesh) :: found
    integer, allocatable :: member(:), rows(:, :)
    integer :: stat, strange

    if (dimensions < 2 .or. dimensions > 3) then
      call report(info, FUGE_ERR_OPTION, 'dimensions = '//text(dimensions)//': it is 2 or 3')
      return
    end if
    call fuge_mesh_faces(mesh, name, found%face, info)
    if (.not. info%failed()) call check_dimensions(mesh, name, dimensions, info)
    if (.not. info%failed()) call find_rows(mesh, node, direction, rows, strange, info)
    if (.not. info%failed()) call list_members(found%face, member, info)
    if (.not. info%failed()) call check_nodes(mesh, 'surface '//quoted(name), member, node, rows, strange, info)
    if (info%failed()) return
    if (.not. have_rows(rows(:dimensions, :), member)) then
      call report(info, FUGE_ERR_DOF, 'surface '//quoted(name)//': the stiffness matrix has no row of its nodes, so ' &
                  //'none of them moves: leave dof of a surface that is rigid out')
      return
    end if
    allocate (found%node(dimensions, size(mesh%node)), found%dof(dimensions, size(mesh%node)), stat=stat)
    call require_memory(stat, 'the nodes of surface '//quoted(name), info)
    if (stat /= 0) return
    found%node = mesh%position(:dimensions, :)
    found%dof = rows(:dimensions, :)
    call move_alloc(found%node, surface%node)
    call move_alloc(found%face, surface%face)
    call move_alloc(found%dof, surface%dof)
  end subroutine fuge_mesh_contact_surface

  !> Degrees of freedom, the rows of a stiffness matrix, of the nodes of a set along one direction: for supports and
  !> loads.
  !>
  !> `name`: of the set of nodes, in upper or lower case. `along`: 1 to 3 for x, y, z, 4 to 6 for rotations. `node` and
  !> `direction` as in `fuge_mesh_contact_surface`. `dof`, allocated afresh: in the order of the set, without nodes
  !> whose degree of freedom the matrix does not have, since programs leave out those of supports.
  !> Errors, `dof` unchanged: FUGE_ERR_OPTION if the mesh has no such set, or for another direction; FUGE_ERR_SIZE;
  !> FUGE_ERR_DOF for a matrix without names, a row named twice and a matrix of another mesh, as in
  !> `fuge_mesh_contact_surface`; FUGE_ERR_MEMORY.
  subroutine fuge_mesh_degrees(mesh, name, along, node, direction, dof, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, intent(in) :: along, node(:), direction(:)
    integer, allocatable, intent(inout) :: dof(:)
    type(fuge_info), intent(out) :: info
    integer, allocatable :: found(:), member(:), rows(:, :)
    integer :: count, k, stat, strange

    call fuge_mesh_node_set(mesh, name, member, info)
    if (info%failed()) return
    if (along < 1 .or. along > DIRECTIONS) &
      call report(info, FUGE_ERR_OPTION, 'along = '//text(along)//': directions are 1 to '//text(DIRECTIONS))
    if (.not. info%failed()) call find_rows(mesh, node, direction, rows, strange, info)
    if (.not. info%failed()) call check_nodes(mesh, 'set '//quoted(name), member, node, rows, strange, info)
    if (info%failed()) return
    count = 0
    do k = 1, size(member)
      if (rows(along, member(k)) > 0) count = count + 1
    end do
    allocate (found(count), stat=stat)
    call require_memory(stat, '', count, 'degrees of freedom', info)
    if (stat /= 0) return
    count = 0
    do k = 1, size(member)
      if (rows(along, member(k)) == 0) cycle
      count = count + 1
      found(count) = rows(along, member(k))
    end do
    call move_alloc(found, dof)
  end subroutine fuge_mesh_degrees

  !> Refuse faces of elements that do not have as many dimensions.
  pure subroutine check_dimensions(mesh, name, dimensions, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, intent(in) :: dimensions
    type(fuge_info), intent(inout) :: info
    integer :: element, family, k, nodes, s

    do s = 1, size(mesh%surface)
      if (mesh%surface(s)%name /= upper_case(name)) cycle
      do k = 1, size(mesh%surface(s)%element)
        element = mesh%surface(s)%element(k)
        call split_type(mesh%element_type(element), family, nodes)
        if (family == merge(FAMILY_PLANE, FAMILY_SOLID, dimensions == 2)) cycle
        call report(info, FUGE_ERR_ELEMENT, 'surface '//quoted(name)//': element '//text(mesh%element(element)) &
                    //' of type '//trim(mesh%element_type(element))//' is none of '//text(dimensions) &
                    //' dimensions: set dimensions to those of the mesh')
        return
      end do
    end do
  end subroutine check_dimensions

  !> The row of each direction of each node of the mesh, `rows` (6, nodes), 0 where there is none, and the first row of
  !> a node that the mesh does not have, `strange`, 0 if none.
  pure subroutine find_rows(mesh, node, direction, rows, strange, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: node(:), direction(:)
    integer, allocatable, intent(out) :: rows(:, :)
    integer, intent(out) :: strange
    type(fuge_info), intent(inout) :: info
    type(row_table) :: known_nodes
    integer :: i, k, number, stat

    strange = 0
    if (size(node) /= size(direction)) then
      call report(info, FUGE_ERR_SIZE, 'there are '//text(size(node))//' nodes and '//text(size(direction)) &
                  //' directions of rows: both are needed for each row')
      return
    else if (.not. any(node /= 0 .and. direction /= 0)) then
      call report(info, FUGE_ERR_DOF, 'the rows of the stiffness matrix have no names: read it from a file that ' &
                  //'names node and direction, or with a file of names (names_path)')
      return
    end if
    allocate (rows(DIRECTIONS, size(mesh%node)), stat=stat)
    do i = 1, size(mesh%node)
      if (stat == 0) call known_nodes%number_of(mesh%node(i), 0, number, stat)
    end do
    call require_memory(stat, 'the rows of', size(mesh%node), 'nodes', info)
    if (stat /= 0) return
    rows = 0
    do k = 1, size(node)
      if (direction(k) < 1 .or. direction(k) > DIRECTIONS) cycle
      i = known_nodes%find(node(k), 0)
      if (i == 0 .and. strange == 0) strange = k
      if (i == 0) cycle
      if (rows(direction(k), i) /= 0) then
        call report(info, FUGE_ERR_DOF, 'two rows of the stiffness matrix are node '//text(node(k))//', direction ' &
                    //text(direction(k))//': each needs a name of its own')
        return
      end if
      rows(direction(k), i) = k
    end do
  end subroutine find_rows

  !> Refuse a matrix that is not of this mesh, by the `nodes` that are asked for: indices in mesh%node.
  pure subroutine check_nodes(mesh, name, nodes, node, rows, strange, info)
    type(fuge_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    integer, intent(in) :: nodes(:), node(:), rows(:, :), strange
    type(fuge_info), intent(inout) :: info
    integer :: k, missing

    missing = 0
    do k = 1, size(nodes)
      if (missing == 0 .and. .not. any(rows(:, nodes(k)) > 0)) missing = mesh%node(nodes(k))
    end do
    if (missing == 0) return
    if (.not. any(rows > 0)) then
      call report(info, FUGE_ERR_DOF, 'the stiffness matrix has no row of any node of the mesh, such as ' &
                  //text(missing)//': are mesh and matrix of one model?')
    else if (strange > 0) then
      call report(info, FUGE_ERR_DOF, name//': node '//text(missing)//' has no row in the stiffness matrix, which ' &
                  //'has rows of node '//text(node(strange))//', unknown to the mesh: are both of one model?')
    end if
  end subroutine check_nodes

  !> Has any of these nodes a row? Those that several faces share may be named more than once.
  pure function have_rows(rows, member) result(any_row)
    integer, intent(in) :: rows(:, :), member(:)
    logical :: any_row
    integer :: k

    any_row = .false.
    do k = 1, size(member)
      any_row = any(rows(:, member(k)) > 0)
      if (any_row) return
    end do
  end function have_rows

  !> The nodes of all faces, repeated where faces meet. Error: FUGE_ERR_MEMORY.
  pure subroutine list_members(faces, member, info)
    integer, intent(in) :: faces(:, :)
    integer, allocatable, intent(out) :: member(:)
    type(fuge_info), intent(inout) :: info
    integer :: f, k, n, stat

    allocate (member(count(faces > 0)), stat=stat)
    call require_memory(stat, 'the nodes of', size(faces, 2), 'faces', info)
    if (stat /= 0) return
    n = 0
    do f = 1, size(faces, 2)
      do k = 1, size(faces, 1)
        if (faces(k, f) == 0) cycle
        n = n + 1
        member(n) = faces(k, f)
      end do
    end do
  end subroutine list_members

end module fuge_mesh_rows
