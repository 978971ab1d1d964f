!> C bindings, section "meshes with their matrices".
module fuge_c_mesh_rows
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_mesh_files, only: find_mesh
  use fuge_c_types, only: from_c_string, report_to_c, require_count, require_pointer
  use fuge_mesh_rows, only: fuge_mesh_contact_surface, fuge_mesh_degrees
  use fuge_mesh_type, only: fuge_mesh
  use fuge_status, only: fuge_info
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

contains

  !> The arguments are nine, as in the header: the mesh, the rows of the matrix, the result, the message.
  function c_mesh_get_surface_dof(handle, name, dimensions, rows, node, direction, dof, message, length) &
    bind(c, name='fuge_mesh_get_surface_dof') result(status)
    type(c_ptr), intent(in), value :: handle, name, node, direction, dof, message
    integer(c_int), intent(in), value :: dimensions, rows
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    integer(c_int), pointer :: nodes(:), directions(:)
    type(fuge_surface_mesh) :: surface
    type(fuge_info) :: info

    call find_arguments(handle, name, rows, node, direction, mesh, nodes, directions, info)
    call require_pointer(dof, 'dof', info)
    if (.not. info%failed()) call fuge_mesh_contact_surface(mesh, from_c_string(name), int(dimensions), int(nodes), &
                                                            int(directions), surface, info)
    if (.not. info%failed()) call give(surface%dof - 1, dof)
    status = report_to_c(info, message, length)
  end function c_mesh_get_surface_dof

  !> The arguments are eleven, as in the header: the mesh, the rows of the matrix, the result, the message.
  function c_mesh_get_set_dof(handle, name, along, rows, node, direction, capacity, dof, number, message, length) &
    bind(c, name='fuge_mesh_get_set_dof') result(status)
    type(c_ptr), intent(in), value :: handle, name, node, direction, dof, number, message
    integer(c_int), intent(in), value :: along, rows, capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    integer(c_int), pointer :: nodes(:), directions(:)
    integer, allocatable :: found(:)
    type(fuge_info) :: info

    call find_arguments(handle, name, rows, node, direction, mesh, nodes, directions, info)
    call require_pointer(number, 'count', info)
    call require_count(capacity, 0, 'capacity', 'elements that fit into dof', info)
    if (.not. info%failed()) call fuge_mesh_degrees(mesh, from_c_string(name), int(along), int(nodes), &
                                                    int(directions), found, info)
    if (.not. info%failed()) then
      call give(found(:min(int(capacity), size(found))) - 1, dof)
      call give(size(found), number)
    end if
    status = report_to_c(info, message, length)
  end function c_mesh_get_set_dof

  !> What both functions are given. The arguments are nine, because each pointer has an array that it stands for.
  subroutine find_arguments(handle, name, rows, node, direction, mesh, nodes, directions, info)
    type(c_ptr), intent(in) :: handle, name, node, direction
    integer(c_int), intent(in) :: rows
    type(fuge_mesh), pointer, intent(out) :: mesh
    integer(c_int), pointer, intent(out) :: nodes(:), directions(:)
    type(fuge_info), intent(inout) :: info

    call find_mesh(handle, 'mesh', mesh, info)
    call require_pointer(name, 'name', info)
    call require_count(rows, 1, 'rows', 'rows of the matrix', info)
    call find_array(rows, node, 'node', nodes, info)
    call find_array(rows, direction, 'direction', directions, info)
  end subroutine find_arguments

end module fuge_c_mesh_rows
