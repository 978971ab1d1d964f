!> C bindings, section "mesh files".
module fuge_c_mesh_files
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: give
  use fuge_c_types, only: copy_string, from_c_string, report_to_c, require_count, require_path, require_pointer, &
    set_handle, take_handle
  use fuge_mesh_files, only: fuge_read_mesh
  use fuge_mesh_sets, only: fuge_mesh_element_set, fuge_mesh_faces, fuge_mesh_node_set
  use fuge_mesh_type, only: fuge_mesh, move_mesh
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_mesh, give_mesh

  !> Sets of nodes, sets of elements, and surfaces.
  integer, parameter :: OF_NODES = 1, OF_ELEMENTS = 2, OF_FACES = 3

contains

  function c_read_mesh(path, destination, message, length) bind(c, name='fuge_read_mesh') result(status)
    type(c_ptr), intent(in), value :: path, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh) :: mesh
    type(fuge_info) :: info

    call require_path(path, info)
    call require_pointer(destination, 'mesh', info)
    if (.not. info%failed()) call fuge_read_mesh(from_c_string(path), mesh, info)
    call give_mesh(mesh, destination, info)
    status = report_to_c(info, message, length)
  end function c_read_mesh

  !> Give a mesh to the caller as a handle, unless an error is known already; FUGE_ERR_MEMORY.
  subroutine give_mesh(mesh, destination, info)
    type(fuge_mesh), intent(inout) :: mesh
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh), pointer :: handle
    integer :: stat

    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'a mesh', info)
    if (stat /= 0) return
    call move_mesh(mesh, handle)
    call set_handle(c_loc(handle), destination)
  end subroutine give_mesh

  subroutine c_mesh_free(source) bind(c, name='fuge_mesh_free')
    type(c_ptr), intent(in), value :: source
    type(fuge_mesh), pointer :: mesh
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, mesh)
    deallocate (mesh)
  end subroutine c_mesh_free

  !> The mesh behind a handle, the argument `name`; NULL is an error, unless one is known already.
  subroutine find_mesh(handle, name, mesh, info)
    type(c_ptr), intent(in) :: handle
    character(len=*), intent(in) :: name
    type(fuge_mesh), pointer, intent(out) :: mesh
    type(fuge_info), intent(inout) :: info

    nullify (mesh)
    call require_pointer(handle, name, info)
    if (.not. info%failed()) call c_f_pointer(handle, mesh)
  end subroutine find_mesh

  function c_mesh_get_sizes(handle, nodes, elements, connections) bind(c, name='fuge_mesh_get_sizes') result(status)
    type(c_ptr), intent(in), value :: handle, nodes, elements, connections
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    status = info%status
    if (info%failed()) return
    call give(size(mesh%node), nodes)
    call give(size(mesh%element), elements)
    call give(size(mesh%connection), connections)
  end function c_mesh_get_sizes

  function c_mesh_get_nodes(handle, node, position) bind(c, name='fuge_mesh_get_nodes') result(status)
    type(c_ptr), intent(in), value :: handle, node, position
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    status = info%status
    if (info%failed()) return
    call give(mesh%node, node)
    call give(mesh%position, position)
  end function c_mesh_get_nodes

  function c_mesh_get_elements(handle, element, first, connection) bind(c, name='fuge_mesh_get_elements') result(status)
    type(c_ptr), intent(in), value :: handle, element, first, connection
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    status = info%status
    if (info%failed()) return
    call give(mesh%element, element)
    call give(mesh%first - 1, first)
    call give(mesh%connection - 1, connection)
  end function c_mesh_get_elements

  function c_mesh_get_type(handle, k, element_type, length) bind(c, name='fuge_mesh_get_type') result(status)
    type(c_ptr), intent(in), value :: handle, element_type
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    if (.not. info%failed()) then
      if (k < 0 .or. k >= size(mesh%element)) call report(info, FUGE_ERR_SIZE, 'the mesh has no element ' &
                                                          //index_text(int(k) + 1))
    end if
    status = info%status
    if (.not. info%failed()) call copy_string(mesh%element_type(k + 1), element_type, length)
  end function c_mesh_get_type

  function c_mesh_get_node_set(handle, name, capacity, member, count, message, length) &
    bind(c, name='fuge_mesh_get_node_set') result(status)
    type(c_ptr), intent(in), value :: handle, name, member, count, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info

    call get_set(handle, OF_NODES, name, capacity, member, count, info)
    status = report_to_c(info, message, length)
  end function c_mesh_get_node_set

  function c_mesh_get_element_set(handle, name, capacity, member, count, message, length) &
    bind(c, name='fuge_mesh_get_element_set') result(status)
    type(c_ptr), intent(in), value :: handle, name, member, count, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_info) :: info

    call get_set(handle, OF_ELEMENTS, name, capacity, member, count, info)
    status = report_to_c(info, message, length)
  end function c_mesh_get_element_set

  !> Copy the first `capacity` members of a set, OF_NODES or OF_ELEMENTS, counted from 0, and their number.
  subroutine get_set(handle, kind, name, capacity, member, count, info)
    type(c_ptr), intent(in) :: handle, name, member, count
    integer, intent(in) :: kind
    integer(c_int), intent(in) :: capacity
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh), pointer :: mesh
    integer, allocatable :: found(:)

    call check_arguments(handle, name, capacity, count, 'member', mesh, info)
    if (info%failed()) return
    if (kind == OF_NODES) then
      call fuge_mesh_node_set(mesh, from_c_string(name), found, info)
    else
      call fuge_mesh_element_set(mesh, from_c_string(name), found, info)
    end if
    if (info%failed()) return
    call give(found(:min(int(capacity), size(found))) - 1, member)
    call give(size(found), count)
  end subroutine get_set

  subroutine check_arguments(handle, name, capacity, count, array, mesh, info)
    type(c_ptr), intent(in) :: handle, name, count
    integer(c_int), intent(in) :: capacity
    character(len=*), intent(in) :: array
    type(fuge_mesh), pointer, intent(out) :: mesh
    type(fuge_info), intent(inout) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    call require_pointer(name, 'name', info)
    call require_pointer(count, 'count', info)
    call require_count(capacity, 0, 'capacity', 'elements that fit into '//array, info)
  end subroutine check_arguments

  function c_mesh_get_set_counts(handle, node_sets, element_sets, surfaces) &
    bind(c, name='fuge_mesh_get_set_counts') result(status)
    type(c_ptr), intent(in), value :: handle, node_sets, element_sets, surfaces
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    status = info%status
    if (info%failed()) return
    call give(size(mesh%node_set), node_sets)
    call give(size(mesh%element_set), element_sets)
    call give(size(mesh%surface), surfaces)
  end function c_mesh_get_set_counts

  function c_mesh_get_node_set_name(handle, k, name, length) bind(c, name='fuge_mesh_get_node_set_name') result(status)
    type(c_ptr), intent(in), value :: handle, name
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = get_name(handle, OF_NODES, k, name, length)
  end function c_mesh_get_node_set_name

  function c_mesh_get_element_set_name(handle, k, name, length) &
    bind(c, name='fuge_mesh_get_element_set_name') result(status)
    type(c_ptr), intent(in), value :: handle, name
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = get_name(handle, OF_ELEMENTS, k, name, length)
  end function c_mesh_get_element_set_name

  function c_mesh_get_surface_name(handle, k, name, length) bind(c, name='fuge_mesh_get_surface_name') result(status)
    type(c_ptr), intent(in), value :: handle, name
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = get_name(handle, OF_FACES, k, name, length)
  end function c_mesh_get_surface_name

  !> Copy the name of set or surface k, counted from 0; FUGE_ERR_SIZE if there is none.
  function get_name(handle, kind, k, name, length) result(status)
    type(c_ptr), intent(in) :: handle, name
    integer, intent(in) :: kind
    integer(c_int), intent(in) :: k
    integer(c_size_t), intent(in) :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_info) :: info
    integer :: counts(3)

    call find_mesh(handle, 'mesh', mesh, info)
    if (.not. info%failed()) then
      counts = [size(mesh%node_set), size(mesh%element_set), size(mesh%surface)]
      if (k < 0 .or. k >= counts(kind)) call report(info, FUGE_ERR_SIZE, 'there is no name '//index_text(int(k) + 1))
    end if
    status = info%status
    if (info%failed()) return
    select case (kind)
    case (OF_NODES)
      call copy_string(mesh%node_set(k + 1)%name, name, length)
    case (OF_ELEMENTS)
      call copy_string(mesh%element_set(k + 1)%name, name, length)
    case (OF_FACES)
      call copy_string(mesh%surface(k + 1)%name, name, length)
    end select
  end function get_name

  function c_mesh_get_faces(handle, name, capacity, faces, count, message, length) &
    bind(c, name='fuge_mesh_get_faces') result(status)
    type(c_ptr), intent(in), value :: handle, name, faces, count, message
    integer(c_int), intent(in), value :: capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    integer, allocatable :: found(:, :)
    type(fuge_info) :: info

    call check_arguments(handle, name, capacity, count, 'faces', mesh, info)
    if (.not. info%failed()) call fuge_mesh_faces(mesh, from_c_string(name), found, info)
    status = report_to_c(info, message, length)
    if (info%failed()) return
    call give(found(:, :min(int(capacity), size(found, 2))) - 1, faces)
    call give(size(found, 2), count)
  end function c_mesh_get_faces

end module fuge_c_mesh_files
