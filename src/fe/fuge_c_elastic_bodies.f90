!> C bindings, sections "elastic bodies" and "bodies as one".
module fuge_c_elastic_bodies
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_bodies_solution, only: fuge_bodies_contact, fuge_solve_bodies
  use fuge_body_joining, only: fuge_join_bodies, fuge_joined_bodies
  use fuge_c_arrays, only: give
  use fuge_c_body, only: body_handle, find_body
  use fuge_c_pairs, only: find_pairs, pairs_handle, take_pair
  use fuge_c_types, only: reporting_handle, from_zero, give_info, give_message, options_at, report_failure, &
    report_to_c, report_to_handle, require_pointer, set_handle, take_handle
  use fuge_contact_pairs_type, only: fuge_contact_pairs
  use fuge_elastic_body_type, only: copy_data, fuge_elastic_body, fuge_surface_pair
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: solve_bodies

  !> A body of the caller, which it may change between two solves.
  type :: body_reference
    type(body_handle), pointer :: handle => null()
  end type body_reference

  !> Behind struct fuge_bodies.
  type, extends(reporting_handle) :: bodies_handle
    type(body_reference), allocatable :: body(:)
    type(fuge_surface_pair), allocatable :: pair(:)
    !> All bodies as one, after a join that succeeded.
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

  function c_bodies_add(bodies, body, number) bind(c, name='fuge_bodies_add') result(status)
    type(c_ptr), intent(in), value :: bodies, body, number
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(body_handle), pointer :: added
    type(body_reference), allocatable :: more(:)
    type(fuge_info) :: info
    integer :: n, stat

    call find_bodies(bodies, handle, info)
    call find_body(body, added, info)
    if (.not. info%failed()) then
      n = size(handle%body)
      allocate (more(n + 1), stat=stat)
      call require_memory(stat, 'a body', info)
      if (stat == 0) then
        more(:n) = handle%body
        more(n + 1)%handle => added
        call move_alloc(more, handle%body)
        call give(n, number)
      end if
    end if
    status = report_to_handle(info, handle)
  end function c_bodies_add

  !> The arguments are eleven, as in the header: the bodies, the surfaces and whose they are, how they are paired.
  function c_bodies_add_pair(bodies, contact_body, opposite_body, pairs, method, normals, normal, reach, play, tied, &
                             smooth) bind(c, name='fuge_bodies_add_pair') result(status)
    type(c_ptr), intent(in), value :: bodies, pairs, normal
    integer(c_int), intent(in), value :: contact_body, opposite_body, method, normals, tied, smooth
    real(c_double), intent(in), value :: reach, play
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(pairs_handle), pointer :: surfaces
    type(fuge_surface_pair), allocatable :: more(:)
    type(fuge_surface_pair) :: added
    type(fuge_info) :: info
    integer :: n, stat

    call find_bodies(bodies, handle, info)
    call find_pairs(pairs, surfaces, info)
    if (.not. info%failed()) call take_pair(surfaces, [method, normals, tied, smooth], normal, [reach, play], &
                                            added%options, info)
    if (.not. info%failed()) then
      n = size(handle%pair)
      allocate (more(n + 1), stat=stat)
      call require_memory(stat, 'a pair of surfaces', info)
      if (stat == 0) then
        added%contact = surfaces%contact
        added%opposite = surfaces%opposite
        added%contact_body = from_zero(contact_body)
        added%opposite_body = from_zero(opposite_body)
        more(:n) = handle%pair
        more(n + 1) = added
        call move_alloc(more, handle%pair)
      end if
    end if
    status = report_to_handle(info, handle)
  end function c_bodies_add_pair

  function c_bodies_solve(bodies, options, pairs) bind(c, name='fuge_bodies_solve') result(status)
    type(c_ptr), intent(in), value :: bodies, options, pairs
    integer(c_int) :: status
    type(fuge_band_stiffness) :: band

    status = solve_bodies(bodies, options, pairs, band)
  end function c_bodies_solve

  !> Solve with a storage of the stiffness matrix of all bodies.
  function solve_bodies(bodies, options, pairs, stiffness) result(status)
    type(c_ptr), intent(in) :: bodies, options, pairs
    class(fuge_stiffness), intent(inout) :: stiffness
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_elastic_body), allocatable :: body(:)
    type(fuge_info) :: info
    integer :: stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      call read_bodies(handle, body, info)
      if (.not. (info%failed() .or. allocated(handle%contact))) then
        allocate (handle%contact, stat=stat)
        call require_memory(stat, 'the solution', info)
      end if
      if (.not. info%failed()) call fuge_solve_bodies(stiffness, body, handle%pair, handle%contact, info, &
                                                      options_at(options))
      if (.not. info%failed()) call give_pairs(handle%contact%pairs, pairs)
      handle%info = info
      handle%tried = .true.
    end if
    status = report_to_handle(info, handle)
  end function solve_bodies

  !> The bodies as the caller has set them by now. Error: FUGE_ERR_MEMORY.
  subroutine read_bodies(handle, body, info)
    type(bodies_handle), intent(in) :: handle
    type(fuge_elastic_body), allocatable, intent(out) :: body(:)
    type(fuge_info), intent(inout) :: info
    integer :: k, stat

    allocate (body(size(handle%body)), stat=stat)
    call require_memory(stat, '', size(handle%body), 'bodies', info)
    do k = 1, size(handle%body)
      if (info%failed()) return
      associate (source => handle%body(k)%handle)
        call source%source%columns(body(k)%column, body(k)%row, body(k)%value, info)
        if (.not. info%failed()) call copy_data(source%body, body(k)%fuge_body, info)
      end associate
    end do
  end subroutine read_bodies

  !> Copy contact points to the pairs behind an address; NULL is left alone.
  subroutine give_pairs(found, pairs)
    type(fuge_contact_pairs), intent(in) :: found
    type(c_ptr), intent(in) :: pairs
    type(pairs_handle), pointer :: handle

    if (.not. c_associated(pairs)) return
    call c_f_pointer(pairs, handle)
    handle%pairs = found
  end subroutine give_pairs

  function c_bodies_get_forces(bodies, force, pressure, gap) bind(c, name='fuge_bodies_get_forces') result(status)
    type(c_ptr), intent(in), value :: bodies, force, pressure, gap
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%contact%force, force)
    call give(handle%contact%pressure, pressure)
    call give(handle%contact%gap, gap)
  end function c_bodies_get_forces

  function c_bodies_get_displacement(bodies, body, displacement) bind(c, name='fuge_bodies_get_displacement') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, displacement
    integer(c_int), intent(in), value :: body
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    associate (first => handle%contact%first)
      if (body < 0 .or. body >= size(first) - 1) then
        call report(info, FUGE_ERR_SIZE, 'body = '//text(int(body))//' is not one of the '//text(size(first) - 1) &
                    //' bodies of the last solve')
        status = report_failure(info, handle)
      else
        call give(handle%contact%displacement(first(body + 1) + 1:first(body + 2)), displacement)
      end if
    end associate
  end function c_bodies_get_displacement

  function c_bodies_get_info(bodies, destination) bind(c, name='fuge_bodies_get_info') result(status)
    type(c_ptr), intent(in), value :: bodies, destination
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    call require_pointer(destination, 'info', info)
    if (.not. info%failed()) then
      if (.not. handle%tried) call report(info, FUGE_ERR_CALL_ORDER, 'there is no solve: call fuge_bodies_solve first')
    end if
    if (.not. info%failed()) call give_info(handle%info, destination)
    status = report_failure(info, handle)
  end function c_bodies_get_info

  function c_bodies_message(bodies, message, length) bind(c, name='fuge_bodies_message') result(status)
    type(c_ptr), intent(in), value :: bodies, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    status = give_message(info, handle, message, length)
  end function c_bodies_message

  function c_bodies_join(bodies, pairs, degrees, entries) bind(c, name='fuge_bodies_join') result(status)
    type(c_ptr), intent(in), value :: bodies, pairs, degrees, entries
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_elastic_body), allocatable :: body(:)
    type(fuge_info) :: info
    integer :: stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      if (allocated(handle%joined)) deallocate (handle%joined)
      allocate (handle%joined, stat=stat)
      call require_memory(stat, 'all bodies together', info)
      if (stat == 0) call read_bodies(handle, body, info)
      if (.not. info%failed()) call fuge_join_bodies(body, handle%pair, handle%joined, info)
      if (.not. info%failed()) then
        call give_pairs(handle%joined%pairs, pairs)
        call give(size(handle%joined%column) - 1, degrees)
        call give(size(handle%joined%row), entries)
      else if (stat == 0) then
        deallocate (handle%joined)
      end if
    end if
    status = report_to_handle(info, handle)
  end function c_bodies_join

  function c_bodies_get_matrix(bodies, column, row, value, first) bind(c, name='fuge_bodies_get_matrix') result(status)
    type(c_ptr), intent(in), value :: bodies, column, row, value, first
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      if (.not. allocated(handle%joined)) call report(info, FUGE_ERR_CALL_ORDER, 'the bodies have not been joined: ' &
                                                      //'call fuge_bodies_join first')
    end if
    status = report_failure(info, handle)
    if (info%failed()) return
    call give(handle%joined%column - 1, column)
    call give(handle%joined%row - 1, row)
    call give(handle%joined%value, value)
    call give(handle%joined%first, first)
  end function c_bodies_get_matrix

  !> The bodies behind a handle; NULL is FUGE_ERR_POINTER.
  subroutine find_bodies(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    handle => null()
    call require_pointer(address, 'bodies', info)
    if (.not. info%failed()) call c_f_pointer(address, handle)
  end subroutine find_bodies

  !> The bodies behind a handle, for a getter, refused before a solve (FUGE_ERR_CALL_ORDER). The result is the status to
  !> return.
  function find_solved(address, handle) result(status)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    integer(c_int) :: status
    type(fuge_info) :: info
    logical :: solved

    call find_bodies(address, handle, info)
    if (.not. info%failed()) then
      solved = allocated(handle%contact)
      if (solved) solved = allocated(handle%contact%force)
      if (.not. solved) call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution: call fuge_bodies_solve first')
    end if
    status = report_failure(info, handle)
  end function find_solved

end module fuge_c_elastic_bodies
