!> Meshes made of arrays, or of other meshes.
module fuge_mesh_making
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_element_types, only: nodes_of_type, upper_case
  use fuge_kinds, only: dp
  use fuge_mesh_checks, only: check_mesh
  use fuge_mesh_type, only: fuge_mesh, move_mesh
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_ERR_ELEMENT, FUGE_ERR_SIZE
  implicit none
  private

  public :: append_mesh, fuge_join_meshes, fuge_make_mesh

contains

  !> Make a mesh of arrays.
  !>
  !> `position` (2 or 3, nodes). `element` (most, elements): the nodes of each element, in the order of Abaqus and
  !> CalculiX; 0 in unused places, at the end. `element_type` (elements), or (1) for all: such as C3D8 or CPE4, in upper
  !> or lower case. Nodes and elements are numbered from 1.
  !> Errors, `mesh` unchanged: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE; FUGE_ERR_ELEMENT for an element with another
  !> number of nodes than its type has; FUGE_ERR_MEMORY.
  subroutine fuge_make_mesh(position, element, element_type, mesh, info)
    real(dp), intent(in) :: position(:, :)
    integer, intent(in) :: element(:, :)
    character(len=*), intent(in) :: element_type(:)
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(out) :: info
    type(fuge_mesh) :: made
    integer :: nodes

    call check_sizes(position, element, element_type, info)
    if (info%failed()) return
    nodes = size(position, 2)
    call allocate_mesh(nodes, size(element, 2), count(element /= 0), made, info)
    if (info%failed()) return
    made%position = 0.0_dp
    made%position(:size(position, 1), :) = position
    call fill_elements(element, element_type, made)
    call check_mesh(made, info)
    if (.not. info%failed()) call check_nodes(made, info)
    if (info%failed()) return
    call number_mesh(made)
    call move_mesh(made, mesh)
  end subroutine fuge_make_mesh

  pure subroutine check_sizes(position, element, element_type, info)
    real(dp), intent(in) :: position(:, :)
    integer, intent(in) :: element(:, :)
    character(len=*), intent(in) :: element_type(:)
    type(fuge_info), intent(inout) :: info
    integer :: e

    if (size(position, 1) < 2 .or. size(position, 1) > 3) then
      call report(info, FUGE_ERR_SIZE, 'position has '//text(size(position, 1))//' rows: a node has 2 or 3 coordinates')
    else if (size(element_type) /= 1 .and. size(element_type) /= size(element, 2)) then
      call report(info, FUGE_ERR_SIZE, text(size(element, 2))//' elements and '//text(size(element_type))//' types: ' &
                  //'pass one type for each element, or one for all')
    else if (size(element, kind=int64) > huge(1) - 1) then
      call report(info, FUGE_ERR_SIZE, 'element has more numbers of nodes than an integer counts')
    end if
    if (info%failed()) return
    do e = 1, size(element, 2)
      if (all(element(:, e) /= 0)) cycle
      if (all(element(findloc(element(:, e), 0, dim=1):, e) == 0)) cycle
      call report(info, FUGE_ERR_SIZE, 'element '//index_text(e)//' has unused places, 0, before its last node')
      return
    end do
  end subroutine check_sizes

  !> Room for a mesh whose elements have no numbers.
  pure subroutine allocate_mesh(nodes, elements, connections, mesh, info)
    integer, intent(in) :: nodes, elements, connections
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (mesh%node(nodes), mesh%position(3, nodes), mesh%element(elements), mesh%element_type(elements), &
              mesh%first(elements + 1), mesh%connection(connections), stat=stat)
    call require_memory(stat, 'a mesh of '//text(nodes)//' nodes and', elements, 'elements', info)
    if (stat /= 0) return
    mesh%node = 0
    mesh%element = 0
  end subroutine allocate_mesh

  !> Number nodes and elements from 1.
  pure subroutine number_mesh(mesh)
    type(fuge_mesh), intent(inout) :: mesh
    integer :: k

    do k = 1, size(mesh%node)
      mesh%node(k) = k
    end do
    do k = 1, size(mesh%element)
      mesh%element(k) = k
    end do
  end subroutine number_mesh

  !> Fill types and nodes of the elements; both have room.
  pure subroutine fill_elements(element, element_type, mesh)
    integer, intent(in) :: element(:, :)
    character(len=*), intent(in) :: element_type(:)
    type(fuge_mesh), intent(inout) :: mesh
    integer :: e, n

    mesh%first(1) = 1
    do e = 1, size(element, 2)
      n = count(element(:, e) /= 0)
      mesh%connection(mesh%first(e):mesh%first(e) + n - 1) = element(:n, e)
      mesh%first(e + 1) = mesh%first(e) + n
      mesh%element_type(e) = upper_case(element_type(min(e, size(element_type))))
    end do
  end subroutine fill_elements

  !> Refuse elements with another number of nodes than their type has (FUGE_ERR_ELEMENT); unknown types are taken as
  !> they are.
  pure subroutine check_nodes(mesh, info)
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_info), intent(inout) :: info
    logical :: known
    integer :: e, needed

    needed = 0
    do e = 1, size(mesh%element)
      known = .false.
      if (e > 1) known = mesh%element_type(e) == mesh%element_type(e - 1)
      if (.not. known) needed = nodes_of_type(mesh%element_type(e))
      if (needed == 0 .or. needed == mesh%first(e + 1) - mesh%first(e)) cycle
      call report(info, FUGE_ERR_ELEMENT, 'element '//index_text(e)//' of type '//trim(mesh%element_type(e))//' has ' &
                  //text(mesh%first(e + 1) - mesh%first(e))//' nodes instead of '//text(needed))
      return
    end do
  end subroutine check_nodes

  !> Join meshes, such as those of several bodies, to one, for `fuge_write_mesh`: nodes and elements of all of them, one
  !> mesh after the other.
  !>
  !> `node` and `element` keep the numbers of the meshes, so that numbers may be repeated.
  !> Errors, `joined` unchanged: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MEMORY.
  subroutine fuge_join_meshes(meshes, joined, info)
    type(fuge_mesh), intent(in) :: meshes(:)
    type(fuge_mesh), intent(inout) :: joined
    type(fuge_info), intent(out) :: info
    type(fuge_mesh) :: made
    integer :: k

    if (size(meshes) < 1) call report(info, FUGE_ERR_SIZE, 'there are no meshes to be joined')
    do k = 1, size(meshes)
      if (.not. info%failed()) call append_mesh(meshes(k), k, made, info)
    end do
    if (.not. info%failed()) call move_mesh(made, joined)
  end subroutine fuge_join_meshes

  !> Append mesh k of several to those before it, `joined`, unchanged after an error.
  pure subroutine append_mesh(mesh, k, joined, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: k
    type(fuge_mesh), intent(inout) :: joined
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh) :: longer
    integer(int64) :: all(3)
    integer :: used(3)

    call check_mesh(mesh, info)
    if (info%failed()) then
      call report(info, info%status, 'mesh '//index_text(k)//': '//composed_message(info))
      return
    end if
    used = 0
    if (allocated(joined%position)) used = int(sizes_of(joined))
    all = used + sizes_of(mesh)
    if (maxval(all) >= huge(1)) call report(info, FUGE_ERR_SIZE, 'up to mesh '//index_text(k)//' there are more ' &
                                            //'nodes or elements than an integer counts')
    if (.not. info%failed()) call allocate_mesh(int(all(1)), int(all(2)), int(all(3)), longer, info)
    if (info%failed()) return
    longer%first(1) = 1
    if (allocated(joined%position)) call copy_mesh(joined, [0, 0, 0], longer)
    call copy_mesh(mesh, used, longer)
    call move_mesh(longer, joined)
  end subroutine append_mesh

  !> Nodes, elements and nodes of all elements together.
  pure function sizes_of(mesh) result(sizes)
    type(fuge_mesh), intent(in) :: mesh
    integer(int64) :: sizes(3)

    sizes = [size(mesh%position, 2, kind=int64), size(mesh%element_type, kind=int64), size(mesh%connection, kind=int64)]
  end function sizes_of

  !> Copy a mesh behind the entries of another one that are `used`: nodes, elements, nodes of all elements.
  pure subroutine copy_mesh(mesh, used, joined)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: used(3)
    type(fuge_mesh), intent(inout) :: joined
    integer :: e, k

    do k = 1, size(mesh%position, 2)
      joined%position(:, used(1) + k) = mesh%position(:, k)
      joined%node(used(1) + k) = k
      if (allocated(mesh%node)) joined%node(used(1) + k) = mesh%node(k)
    end do
    do e = 1, size(mesh%element_type)
      joined%element_type(used(2) + e) = mesh%element_type(e)
      joined%element(used(2) + e) = e
      if (allocated(mesh%element)) joined%element(used(2) + e) = mesh%element(e)
      joined%first(used(2) + e + 1) = mesh%first(e + 1) + used(3)
    end do
    do k = 1, size(mesh%connection)
      joined%connection(used(3) + k) = mesh%connection(k) + used(1)
    end do
  end subroutine copy_mesh

end module fuge_mesh_making
