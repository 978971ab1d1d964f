!> C bindings, section "meshes": made of arrays, joined, and written.
module fuge_c_meshes
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array
  use fuge_c_types, only: from_c_string, from_zero, report_to_c, require_count, require_path, require_pointer, &
    set_handle, take_handle
  use fuge_mesh_making, only: append_mesh, fuge_make_mesh
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_field, move_mesh, TYPE_LENGTH
  use fuge_mesh_writer, only: fuge_write_mesh
  use fuge_number_text, only: index_text, text
  use fuge_quoted_text, only: quoted
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  implicit none
  private

contains

  !> Eleven arguments, as in the header: the nodes, the elements, their types, the mesh, the message.
  function c_mesh_create(dimensions, nodes, position, most, elements, element, types, element_type, destination, &
                         message, length) bind(c, name='fuge_mesh_create') result(status)
    integer(c_int), intent(in), value :: dimensions, nodes, most, elements, types
    type(c_ptr), intent(in), value :: position, element, element_type, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh) :: mesh
    type(fuge_info) :: info
    real(c_double), pointer :: positions(:, :)
    integer(c_int), pointer :: numbers(:, :)
    character(len=TYPE_LENGTH), allocatable :: all_types(:)
    integer, allocatable :: connection(:, :)
    integer :: stat

    call require_count(dimensions, 2, 'dimensions', '2 or 3 dimensions', info)
    call require_count(nodes, 1, 'nodes', 'nodes', info)
    call require_count(most, 1, 'most', 'nodes of each element', info)
    call require_count(elements, 0, 'elements', 'elements', info)
    call require_count(types, 1, 'types', 'types', info)
    call find_array(int(dimensions), nodes, position, 'position', positions, info)
    call find_array(int(most), elements, element, 'element', numbers, info)
    call require_pointer(destination, 'mesh', info)
    if (.not. info%failed()) call copy_types(int(types), element_type, all_types, info)
    if (.not. info%failed()) then
      allocate (connection(most, elements), stat=stat)
      call require_memory(stat, '', int(elements), 'elements', info)
    end if
    if (.not. info%failed()) then
      connection = from_zero(numbers)
      call fuge_make_mesh(positions, connection, all_types, mesh, info)
    end if
    call give_mesh(mesh, destination, info)
    status = report_to_c(info, message, length)
  end function c_mesh_create

  !> Copy the names of types; FUGE_ERR_OPTION for one that is too long.
  subroutine copy_types(types, addresses, all_types, info)
    integer, intent(in) :: types
    type(c_ptr), intent(in) :: addresses
    character(len=TYPE_LENGTH), allocatable, intent(out) :: all_types(:)
    type(fuge_info), intent(inout) :: info
    type(c_ptr), pointer :: address(:)
    integer :: k, stat

    call require_pointer(addresses, 'type', info)
    if (info%failed()) return
    allocate (all_types(types), stat=stat)
    call require_memory(stat, '', types, 'types', info)
    if (stat /= 0) return
    call c_f_pointer(addresses, address, [types])
    do k = 1, types
      call copy_name(address(k), 'type', k, all_types(k), info)
      if (info%failed()) return
    end do
  end subroutine copy_types

  !> Copy name k of an `array`; NULL and more characters than fit are refused.
  subroutine copy_name(address, array, k, name, info)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: array
    integer, intent(in) :: k
    character(len=*), intent(inout) :: name
    type(fuge_info), intent(inout) :: info

    call require_pointer(address, array//'['//index_text(k)//']', info)
    if (info%failed()) return
    name = from_c_string(address)
    if (len(from_c_string(address)) > len(name)) call report(info, FUGE_ERR_OPTION, array//'['//index_text(k)//'], ' &
      //quoted(from_c_string(address))//', has more than '//text(len(name))//' characters')
  end subroutine copy_name

  function c_mesh_join(count, meshes, destination, message, length) bind(c, name='fuge_mesh_join') result(status)
    integer(c_int), intent(in), value :: count
    type(c_ptr), intent(in), value :: meshes, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_mesh) :: joined
    type(c_ptr), pointer :: handle(:)
    type(fuge_info) :: info
    integer :: k

    call require_count(count, 1, 'count', 'meshes', info)
    call require_pointer(meshes, 'mesh', info)
    call require_pointer(destination, 'joined', info)
    if (.not. info%failed()) then
      call c_f_pointer(meshes, handle, [count])
      do k = 1, int(count)
        call find_mesh(handle(k), 'mesh['//index_text(k)//']', mesh, info)
        if (info%failed()) exit
        call append_mesh(mesh, k, joined, info)
      end do
    end if
    call give_mesh(joined, destination, info)
    status = report_to_c(info, message, length)
  end function c_mesh_join

  !> Nine arguments, as in the header: the file, the mesh, the fields, the message.
  function c_write_mesh(path, source, count, names, components, elements, values, message, length) &
    bind(c, name='fuge_write_mesh') result(status)
    type(c_ptr), intent(in), value :: path, source, names, components, elements, values, message
    integer(c_int), intent(in), value :: count
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_mesh), pointer :: mesh
    type(fuge_mesh_field), allocatable :: fields(:)
    type(fuge_info) :: info
    integer :: stat

    call require_path(path, info)
    call find_mesh(source, 'mesh', mesh, info)
    call require_count(count, 0, 'count', 'fields', info)
    if (.not. info%failed()) then
      allocate (fields(count), stat=stat)
      call require_memory(stat, '', int(count), 'fields', info)
      if (.not. info%failed()) call copy_fields(mesh, names, components, elements, values, fields, info)
      if (.not. info%failed()) call fuge_write_mesh(from_c_string(path), mesh, fields, info)
    end if
    status = report_to_c(info, message, length)
  end function c_write_mesh

  !> Copy fields of C.
  subroutine copy_fields(mesh, names, components, elements, values, fields, info)
    type(fuge_mesh), intent(in) :: mesh
    type(c_ptr), intent(in) :: names, components, elements, values
    type(fuge_mesh_field), intent(inout) :: fields(:)
    type(fuge_info), intent(inout) :: info
    type(c_ptr), pointer :: name(:), value(:)
    integer(c_int), pointer :: counts(:), of_elements(:)
    integer :: k

    if (size(fields) == 0) return
    call require_pointer(names, 'name', info)
    call require_pointer(components, 'components', info)
    call require_pointer(values, 'field', info)
    if (info%failed()) return
    call c_f_pointer(names, name, [size(fields)])
    call c_f_pointer(components, counts, [size(fields)])
    call c_f_pointer(values, value, [size(fields)])
    if (c_associated(elements)) then
      call c_f_pointer(elements, of_elements, [size(fields)])
      fields%of_elements = of_elements /= 0_c_int
    end if
    do k = 1, size(fields)
      call copy_name(name(k), 'name', k, fields(k)%name, info)
      call require_pointer(value(k), 'field['//index_text(k)//']', info)
      if (.not. info%failed()) call copy_values(mesh, int(counts(k)), value(k), fields(k), k, info)
      if (info%failed()) return
    end do
  end subroutine copy_fields

  !> Copy the values of field k, which has 1 to 3 `components`; FUGE_ERR_SIZE, FUGE_ERR_MEMORY.
  subroutine copy_values(mesh, components, address, field, k, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: components, k
    type(c_ptr), intent(in) :: address
    type(fuge_mesh_field), intent(inout) :: field
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:, :)
    integer :: columns, stat

    columns = merge(size(mesh%element_type), size(mesh%position, 2), field%of_elements)
    if (components < 1 .or. components > 3) then
      call report(info, FUGE_ERR_SIZE, 'components['//index_text(k)//'] = '//text(components) &
                  //': a field has 1, 2 or 3')
      return
    end if
    call c_f_pointer(address, values, [components, columns])
    allocate (field%value(components, columns), stat=stat)
    call require_memory(stat, 'a copy of field '//index_text(k), info)
    if (stat == 0) field%value = values
  end subroutine copy_values

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

end module fuge_c_meshes
