!> C bindings, section "pairs of surfaces".
module fuge_c_pairs
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: give
  use fuge_c_types, only: reporting_handle, from_zero, give_message, report_failure, report_to_c, report_to_handle, &
    require_count, require_pointer, set_handle, take_handle
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs, fuge_pair_options, FUGE_NORMALS_GIVEN
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  private

  public :: find_pairs, take_pair

  !> Behind struct fuge_pairs.
  type, extends(reporting_handle), public :: pairs_handle
    type(fuge_surface_mesh) :: contact, opposite
    type(fuge_contact_pairs) :: pairs
    !> Options that hold until they are set again.
    type(fuge_pair_options) :: options
  end type pairs_handle

contains

  function c_pairs_create(destination, message, length) bind(c, name='fuge_pairs_create') result(status)
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_info) :: info
    integer :: stat

    call require_pointer(destination, 'pairs', info)
    if (.not. info%failed()) then
      allocate (handle, stat=stat)
      call require_memory(stat, 'the pairs', info)
      if (stat == 0) call set_handle(c_loc(handle), destination)
    end if
    status = report_to_c(info, message, length)
  end function c_pairs_create

  subroutine c_pairs_free(source) bind(c, name='fuge_pairs_free')
    type(c_ptr), intent(in), value :: source
    type(pairs_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_pairs_free

  function c_pairs_set_contact(pairs, dimensions, nodes, node, most, faces, face, dof) &
    bind(c, name='fuge_pairs_set_contact') result(status)
    type(c_ptr), intent(in), value :: pairs, node, face, dof
    integer(c_int), intent(in), value :: dimensions, nodes, most, faces
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_info) :: info

    call find_pairs(pairs, handle, info)
    if (.not. info%failed()) call copy_surface([dimensions, nodes, most, faces], node, face, dof, handle%contact, info)
    status = report_to_handle(info, handle)
  end function c_pairs_set_contact

  function c_pairs_set_opposite(pairs, dimensions, nodes, node, most, faces, face, dof) &
    bind(c, name='fuge_pairs_set_opposite') result(status)
    type(c_ptr), intent(in), value :: pairs, node, face, dof
    integer(c_int), intent(in), value :: dimensions, nodes, most, faces
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_info) :: info

    call find_pairs(pairs, handle, info)
    if (.not. info%failed()) call copy_surface([dimensions, nodes, most, faces], node, face, dof, handle%opposite, info)
    status = report_to_handle(info, handle)
  end function c_pairs_set_opposite

  !> Refuse sizes (dimensions, nodes, most nodes of a face, faces) that no arrays have, and NULL.
  subroutine check_sizes(sizes, node, face, info)
    integer(c_int), intent(in) :: sizes(4)
    type(c_ptr), intent(in) :: node, face
    type(fuge_info), intent(inout) :: info

    call require_count(sizes(1), 2, 'dimensions', '2 or 3 dimensions', info)
    call require_count(sizes(2), 1, 'nodes', 'nodes', info)
    call require_count(sizes(3), 1, 'most', 'nodes of each face', info)
    call require_count(sizes(4), 1, 'faces', 'faces', info)
    if (.not. info%failed() .and. sizes(1) > 3) call report(info, FUGE_ERR_SIZE, 'dimensions = '//text(int(sizes(1))) &
      //': surfaces are in the plane, 2, or in space, 3')
    call require_pointer(node, 'node', info)
    call require_pointer(face, 'face', info)
  end subroutine check_sizes

  !> Replace a surface; `sizes`: dimensions, nodes, most nodes of a face, faces. Errors: those of `check_sizes`,
  !> FUGE_ERR_MEMORY.
  subroutine copy_surface(sizes, node, face, dof, surface, info)
    integer(c_int), intent(in) :: sizes(4)
    type(c_ptr), intent(in) :: node, face, dof
    type(fuge_surface_mesh), intent(inout) :: surface
    type(fuge_info), intent(inout) :: info
    type(fuge_surface_mesh) :: copy
    real(c_double), pointer :: positions(:, :)
    integer(c_int), pointer :: numbers(:, :)
    integer :: stat

    call check_sizes(sizes, node, face, info)
    if (info%failed()) return
    allocate (copy%node(sizes(1), sizes(2)), copy%face(sizes(3), sizes(4)), stat=stat)
    if (stat == 0 .and. c_associated(dof)) allocate (copy%dof(sizes(1), sizes(2)), stat=stat)
    call require_memory(stat, 'a surface of', int(sizes(4)), 'faces', info)
    if (stat /= 0) return
    call c_f_pointer(node, positions, [sizes(1), sizes(2)])
    copy%node = positions
    call c_f_pointer(face, numbers, [sizes(3), sizes(4)])
    copy%face = from_zero(numbers)
    if (c_associated(dof)) then
      call c_f_pointer(dof, numbers, [sizes(1), sizes(2)])
      copy%dof = from_zero(numbers)
    end if
    surface = copy
  end subroutine copy_surface

  function c_pairs_set_geometry(pairs, crease, revolution) bind(c, name='fuge_pairs_set_geometry') result(status)
    type(c_ptr), intent(in), value :: pairs
    real(c_double), intent(in), value :: crease
    integer(c_int), intent(in), value :: revolution
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_info) :: info

    call find_pairs(pairs, handle, info)
    if (.not. info%failed()) then
      handle%options%crease = crease
      handle%options%revolution = revolution /= 0
    end if
    status = report_to_handle(info, handle)
  end function c_pairs_set_geometry

  function c_pairs_find(pairs, method, normals, normal, reach, play, tied, smooth) &
    bind(c, name='fuge_pairs_find') result(status)
    type(c_ptr), intent(in), value :: pairs, normal
    integer(c_int), intent(in), value :: method, normals, tied, smooth
    real(c_double), intent(in), value :: reach, play
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_pair_options) :: options
    type(fuge_info) :: info

    call find_pairs(pairs, handle, info)
    if (.not. info%failed()) call take_pair(handle, [method, normals, tied, smooth], normal, [reach, play], options, &
                                            info)
    if (.not. info%failed()) then
      call fuge_find_pairs(handle%contact, handle%opposite, options, handle%pairs, info)
    end if
    status = report_to_handle(info, handle)
  end function c_pairs_find

  !> The options of the pair whose surfaces are set: method, normals, tied and smooth; `normal` at the nodes of the
  !> contact surface if it is given; reach and play. Errors: FUGE_ERR_CALL_ORDER without both surfaces,
  !> FUGE_ERR_POINTER, FUGE_ERR_MEMORY.
  subroutine take_pair(handle, choices, normal, lengths, options, info)
    type(pairs_handle), intent(in) :: handle
    integer(c_int), intent(in) :: choices(4)
    type(c_ptr), intent(in) :: normal
    real(c_double), intent(in) :: lengths(2)
    type(fuge_pair_options), intent(out) :: options
    type(fuge_info), intent(inout) :: info
    real(c_double), pointer :: values(:, :)
    integer :: stat

    if (.not. (allocated(handle%contact%node) .and. allocated(handle%opposite%node))) call report(info, &
      FUGE_ERR_CALL_ORDER, 'a surface is missing: set the contact surface and the opposite one first')
    options = handle%options
    options%method = int(choices(1))
    options%normals = int(choices(2))
    options%tied = choices(3) /= 0
    options%smooth = choices(4) /= 0
    options%reach = lengths(1)
    options%play = lengths(2)
    if (options%normals /= FUGE_NORMALS_GIVEN) return
    call require_pointer(normal, 'normal', info)
    if (info%failed()) return
    call c_f_pointer(normal, values, shape(handle%contact%node))
    allocate (options%normal, source=values, stat=stat)
    call require_memory(stat, 'the normals', info)
  end subroutine take_pair

  function c_pairs_get_sizes(pairs, n, width, unpaired) bind(c, name='fuge_pairs_get_sizes') result(status)
    type(c_ptr), intent(in), value :: pairs, n, width, unpaired
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle

    status = find_found(pairs, handle)
    if (status /= FUGE_DONE) return
    call give(handle%pairs%points(), n)
    call give(size(handle%pairs%dof, 1), width)
    call give(size(handle%pairs%unpaired_node), unpaired)
  end function c_pairs_get_sizes

  function c_pairs_get_contact(pairs, dof, normal) bind(c, name='fuge_pairs_get_contact') result(status)
    type(c_ptr), intent(in), value :: pairs, dof, normal
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle

    status = find_found(pairs, handle)
    if (status /= FUGE_DONE) return
    call give(handle%pairs%dof - 1, dof)
    call give(handle%pairs%normal, normal)
  end function c_pairs_get_contact

  function c_pairs_get_gaps(pairs, gap, gap_upper, area) bind(c, name='fuge_pairs_get_gaps') result(status)
    type(c_ptr), intent(in), value :: pairs, gap, gap_upper, area
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle

    status = find_found(pairs, handle)
    if (status /= FUGE_DONE) return
    call give(handle%pairs%gap, gap)
    call give(handle%pairs%gap_upper, gap_upper)
    call give(handle%pairs%area, area)
  end function c_pairs_get_gaps

  function c_pairs_get_points(pairs, pair, node, face, place, direction) bind(c, name='fuge_pairs_get_points') &
    result(status)
    type(c_ptr), intent(in), value :: pairs, pair, node, face, place, direction
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle

    status = find_found(pairs, handle)
    if (status /= FUGE_DONE) return
    call give(handle%pairs%pair - 1, pair)
    call give(handle%pairs%node - 1, node)
    call give(handle%pairs%face - 1, face)
    call give(handle%pairs%place, place)
    call give(handle%pairs%direction, direction)
  end function c_pairs_get_points

  function c_pairs_get_unpaired(pairs, pair, node) bind(c, name='fuge_pairs_get_unpaired') result(status)
    type(c_ptr), intent(in), value :: pairs, pair, node
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle

    status = find_found(pairs, handle)
    if (status /= FUGE_DONE) return
    call give(handle%pairs%unpaired_pair - 1, pair)
    call give(handle%pairs%unpaired_node - 1, node)
  end function c_pairs_get_unpaired

  function c_pairs_message(pairs, message, length) bind(c, name='fuge_pairs_message') result(status)
    type(c_ptr), intent(in), value :: pairs, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(pairs_handle), pointer :: handle
    type(fuge_info) :: info

    call find_pairs(pairs, handle, info)
    status = give_message(info, handle, message, length)
  end function c_pairs_message

  !> The pairs behind a handle; NULL is FUGE_ERR_POINTER.
  subroutine find_pairs(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(pairs_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    handle => null()
    call require_pointer(address, 'pairs', info)
    if (.not. info%failed()) call c_f_pointer(address, handle)
  end subroutine find_pairs

  !> The same for a getter, refused before any are found (FUGE_ERR_CALL_ORDER). The result is the status to return.
  function find_found(address, handle) result(status)
    type(c_ptr), intent(in) :: address
    type(pairs_handle), pointer, intent(out) :: handle
    integer(c_int) :: status
    type(fuge_info) :: info

    call find_pairs(address, handle, info)
    if (.not. info%failed()) then
      if (handle%pairs%pairs == 0) call report(info, FUGE_ERR_CALL_ORDER, &
          'there are no pairs: call fuge_pairs_find first')
    end if
    status = report_failure(info, handle)
  end function find_found

end module fuge_c_pairs
