!> C bindings, section "elastic bodies": what is given.
module fuge_c_elastic_bodies
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_bodies_solution, only: fuge_bodies_contact
  use fuge_body_joining, only: fuge_joined_bodies
  use fuge_c_arrays, only: find_array, give
  use fuge_c_body, only: copy_supports
  use fuge_c_pairs, only: copy_surface, take_options
  use fuge_c_types, only: reporting_handle, from_zero, report_to_c, report_to_handle, require_columns, require_count, &
    require_pointer, set_handle, take_handle
  use fuge_contact_pairs_type, only: fuge_pair_options, FUGE_NORMALS_GIVEN
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  implicit none
  private

  public :: find_bodies

  !> Behind struct fuge_bodies.
  type, extends(reporting_handle), public :: bodies_handle
    type(fuge_elastic_body), allocatable :: body(:)
    type(fuge_surface_pair), allocatable :: pair(:)
    !> The surfaces of the next pair.
    type(fuge_surface_pair) :: next
    !> Options of pairs that hold until they are set again.
    type(fuge_pair_options) :: options
    !> All bodies as one, for the present data if allocated.
    type(fuge_joined_bodies), allocatable :: joined
    !> The last solution, and the report of the last solve.
    type(fuge_bodies_contact), allocatable :: contact
    type(fuge_info) :: info
    logical :: tried = .false.
  end type bodies_handle

contains

  function c_bodies_create(destination, message, length) bind(c, name='fuge_bodies_create') result(status)
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info
    integer :: stat

    call require_pointer(destination, 'bodies', info)
    if (.not. info%failed()) then
      allocate (handle, stat=stat)
      call require_memory(stat, 'the bodies', info)
      if (stat == 0) then
        allocate (handle%body(0), handle%pair(0))
        call set_handle(c_loc(handle), destination)
      end if
    end if
    status = report_to_c(info, message, length)
  end function c_bodies_create

  subroutine c_bodies_free(source) bind(c, name='fuge_bodies_free')
    type(c_ptr), intent(in), value :: source
    type(bodies_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_bodies_free

  function c_bodies_add(bodies, degrees, column, row, value, body) bind(c, name='fuge_bodies_add') result(status)
    type(c_ptr), intent(in), value :: bodies, column, row, value, body
    integer(c_int), intent(in), value :: degrees
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    integer(c_int), pointer :: columns(:)
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_columns(degrees, 'degrees', info)
    if (.not. info%failed()) call find_array(degrees + 1_c_int, column, 'column', columns, info)
    call require_pointer(row, 'row', info)
    call require_pointer(value, 'value', info)
    if (.not. info%failed()) &
      call require_count(columns(degrees + 1), 1, 'column('//text(int(degrees))//')', 'entries', info)
    if (.not. info%failed()) call append_body(handle, columns, row, value, info)
    if (.not. info%failed()) call give(size(handle%body) - 1, body)
    status = report_change(info, handle)
  end function c_bodies_add

  !> Append a body with this stiffness; those before are moved, not copied.
  subroutine append_body(handle, columns, row, value, info)
    type(bodies_handle), intent(inout) :: handle
    integer(c_int), intent(in) :: columns(:)
    type(c_ptr), intent(in) :: row, value
    type(fuge_info), intent(inout) :: info
    type(fuge_elastic_body), allocatable :: more(:)
    integer(c_int), pointer :: rows(:)
    real(c_double), pointer :: values(:)
    integer :: entries, k, n, stat

    n = size(handle%body)
    entries = columns(size(columns))
    call c_f_pointer(row, rows, [entries])
    call c_f_pointer(value, values, [entries])
    allocate (more(n + 1), stat=stat)
    if (stat == 0) allocate (more(n + 1)%column(size(columns)), more(n + 1)%row(entries), more(n + 1)%value(entries), &
                             stat=stat)
    call require_memory(stat, 'a copy of', entries, 'entries', info)
    if (stat /= 0) return
    do k = 1, entries
      more(n + 1)%row(k) = from_zero(rows(k))
      more(n + 1)%value(k) = values(k)
    end do
    more(n + 1)%column = from_zero(columns)
    do k = 1, n
      call move_body(handle%body(k), more(k))
    end do
    call move_alloc(more, handle%body)
  end subroutine append_body

  pure subroutine move_body(source, destination)
    type(fuge_elastic_body), intent(inout) :: source, destination

    call move_alloc(source%column, destination%column)
    call move_alloc(source%row, destination%row)
    call move_alloc(source%value, destination%value)
    call move_alloc(source%fixed, destination%fixed)
    call move_alloc(source%displacement, destination%displacement)
    call move_alloc(source%load, destination%load)
    call move_alloc(source%rigid_modes, destination%rigid_modes)
  end subroutine move_body

  function c_bodies_fix(bodies, body, number, dof, displacement) bind(c, name='fuge_bodies_fix') result(status)
    type(c_ptr), intent(in), value :: bodies, dof, displacement
    integer(c_int), intent(in), value :: body, number
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_body(bodies, body, handle, info)
    if (.not. info%failed()) call copy_supports(number, dof, displacement, handle%body(body + 1)%fixed, &
                                                handle%body(body + 1)%displacement, info)
    status = report_change(info, handle)
  end function c_bodies_fix

  function c_bodies_set_load(bodies, body, load) bind(c, name='fuge_bodies_set_load') result(status)
    type(c_ptr), intent(in), value :: bodies, load
    integer(c_int), intent(in), value :: body
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    real(c_double), pointer :: forces(:)
    type(fuge_info) :: info

    call find_body(bodies, body, handle, info)
    call require_pointer(load, 'load', info)
    if (.not. info%failed()) then
      call c_f_pointer(load, forces, [size(handle%body(body + 1)%column) - 1])
      handle%body(body + 1)%load = forces
    end if
    status = report_change(info, handle)
  end function c_bodies_set_load

  function c_bodies_set_rigid_modes(bodies, body, m, rigid_modes) bind(c, name='fuge_bodies_set_rigid_modes') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, rigid_modes
    integer(c_int), intent(in), value :: body, m
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    real(c_double), pointer :: values(:, :)
    type(fuge_info) :: info

    call find_body(bodies, body, handle, info)
    call require_count(m, 0, 'm', 'rigid modes', info)
    if (m > 0) call require_pointer(rigid_modes, 'rigid_modes', info)
    if (.not. info%failed()) then
      associate (own => handle%body(body + 1))
        if (allocated(own%rigid_modes)) deallocate (own%rigid_modes)
        if (m > 0) then
          call c_f_pointer(rigid_modes, values, [size(own%column) - 1, int(m)])
          own%rigid_modes = values
        end if
      end associate
    end if
    status = report_change(info, handle)
  end function c_bodies_set_rigid_modes

  !> The arguments are nine, as in the header: the handle, the body, its surface.
  function c_bodies_set_contact(bodies, body, dimensions, nodes, node, most, faces, face, dof) &
    bind(c, name='fuge_bodies_set_contact') result(status)
    type(c_ptr), intent(in), value :: bodies, node, face, dof
    integer(c_int), intent(in), value :: body, dimensions, nodes, most, faces
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) call copy_surface([dimensions, nodes, most, faces], node, face, dof, &
                                               handle%next%contact, info)
    if (.not. info%failed()) handle%next%contact_body = from_zero(body)
    status = report_to_handle(info, handle)
  end function c_bodies_set_contact

  !> The arguments are nine, as in the header: the handle, the body, its surface.
  function c_bodies_set_opposite(bodies, body, dimensions, nodes, node, most, faces, face, dof) &
    bind(c, name='fuge_bodies_set_opposite') result(status)
    type(c_ptr), intent(in), value :: bodies, node, face, dof
    integer(c_int), intent(in), value :: body, dimensions, nodes, most, faces
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) call copy_surface([dimensions, nodes, most, faces], node, face, dof, &
                                               handle%next%opposite, info)
    if (.not. info%failed()) handle%next%opposite_body = from_zero(body)
    status = report_to_handle(info, handle)
  end function c_bodies_set_opposite

  function c_bodies_set_geometry(bodies, crease, revolution) bind(c, name='fuge_bodies_set_geometry') result(status)
    type(c_ptr), intent(in), value :: bodies
    real(c_double), intent(in), value :: crease
    integer(c_int), intent(in), value :: revolution
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      handle%options%crease = crease
      handle%options%revolution = revolution /= 0
    end if
    status = report_to_handle(info, handle)
  end function c_bodies_set_geometry

  function c_bodies_add_pair(bodies, method, normals, normal, reach, play, tied, smooth) &
    bind(c, name='fuge_bodies_add_pair') result(status)
    type(c_ptr), intent(in), value :: bodies, normal
    integer(c_int), intent(in), value :: method, normals, tied, smooth
    real(c_double), intent(in), value :: reach, play
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_pair_options) :: options
    type(fuge_surface_pair), allocatable :: more(:)
    type(fuge_surface_pair) :: blank
    type(fuge_info) :: info
    integer :: n, stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      if (.not. (allocated(handle%next%contact%node) .and. allocated(handle%next%opposite%node))) call report(info, &
        FUGE_ERR_CALL_ORDER, 'a surface is missing: set the contact surface and the opposite one of this pair first')
    end if
    if (normals == FUGE_NORMALS_GIVEN) call require_pointer(normal, 'normal', info)
    if (.not. info%failed()) then
      options = handle%options
      call take_options(handle%next%contact, [method, normals, tied, smooth], normal, [reach, play], options, info)
    end if
    if (.not. info%failed()) then
      n = size(handle%pair)
      allocate (more(n + 1), stat=stat)
      call require_memory(stat, 'a pair of surfaces', info)
      if (stat == 0) then
        more(:n) = handle%pair
        more(n + 1) = handle%next
        more(n + 1)%options = options
        call move_alloc(more, handle%pair)
        handle%next = blank
      end if
    end if
    status = report_change(info, handle)
  end function c_bodies_add_pair

  !> The bodies behind a handle; NULL is FUGE_ERR_POINTER.
  subroutine find_bodies(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    handle => null()
    call require_pointer(address, 'bodies', info)
    if (.not. info%failed()) call c_f_pointer(address, handle)
  end subroutine find_bodies

  !> The same, and FUGE_ERR_SIZE unless they have a body of this number, from 0.
  subroutine find_body(address, body, handle, info)
    type(c_ptr), intent(in) :: address
    integer(c_int), intent(in) :: body
    type(bodies_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    call find_bodies(address, handle, info)
    if (info%failed()) return
    if (body < 0 .or. body >= size(handle%body)) call report(info, FUGE_ERR_SIZE, 'body = '//text(int(body)) &
      //' is not one of the '//text(size(handle%body))//' bodies: call fuge_bodies_add first')
  end subroutine find_body

  !> As `report_to_handle` for a call that changes data: what was joined is out of date.
  function report_change(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    type(bodies_handle), pointer, intent(in) :: handle
    integer(c_int) :: status

    status = report_to_handle(info, handle)
    if (info%failed()) return
    if (allocated(handle%joined)) deallocate (handle%joined)
  end function report_change

end module fuge_c_elastic_bodies
