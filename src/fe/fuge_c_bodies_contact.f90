!> C bindings, sections "elastic bodies" and "bodies as one": what is found.
module fuge_c_bodies_contact
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_size_t
  use fuge_bodies_solution, only: fuge_solve_bodies
  use fuge_body_joining, only: fuge_join_bodies
  use fuge_c_arrays, only: give
  use fuge_c_elastic_bodies, only: bodies_handle, find_bodies
  use fuge_c_types, only: give_info, give_message, options_at, report_failure, report_to_handle, require_pointer
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: solve_bodies

contains

  function c_bodies_solve(bodies, options) bind(c, name='fuge_bodies_solve') result(status)
    type(c_ptr), intent(in), value :: bodies, options
    integer(c_int) :: status
    type(fuge_band_stiffness) :: band

    status = solve_bodies(bodies, options, band)
  end function c_bodies_solve

  !> Solve with a storage of the stiffness matrix of all bodies.
  function solve_bodies(bodies, options, stiffness) result(status)
    type(c_ptr), intent(in) :: bodies, options
    class(fuge_stiffness), intent(inout) :: stiffness
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info
    integer :: stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      stat = 0
      if (.not. allocated(handle%contact)) allocate (handle%contact, stat=stat)
      call require_memory(stat, 'the solution', info)
      if (stat == 0) call fuge_solve_bodies(stiffness, handle%body, handle%pair, handle%contact, info, &
                                            options_at(options))
      handle%info = info
      handle%tried = .true.
    end if
    status = report_to_handle(info, handle)
  end function solve_bodies

  function c_bodies_get_sizes(bodies, n, unpaired, number) bind(c, name='fuge_bodies_get_sizes') result(status)
    type(c_ptr), intent(in), value :: bodies, n, unpaired, number
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(size(handle%contact%force), n)
    call give(size(handle%contact%pairs%unpaired_node), unpaired)
    call give(size(handle%contact%first) - 1, number)
  end function c_bodies_get_sizes

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

  function c_bodies_get_points(bodies, pair, node, face, place, direction) bind(c, name='fuge_bodies_get_points') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, pair, node, face, place, direction
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%contact%pairs%pair - 1, pair)
    call give(handle%contact%pairs%node - 1, node)
    call give(handle%contact%pairs%face - 1, face)
    call give(handle%contact%pairs%place, place)
    call give(handle%contact%pairs%direction, direction)
  end function c_bodies_get_points

  function c_bodies_get_areas(bodies, area, initial_gap) bind(c, name='fuge_bodies_get_areas') result(status)
    type(c_ptr), intent(in), value :: bodies, area, initial_gap
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%contact%pairs%area, area)
    call give(handle%contact%pairs%gap, initial_gap)
  end function c_bodies_get_areas

  function c_bodies_get_unpaired(bodies, pair, node) bind(c, name='fuge_bodies_get_unpaired') result(status)
    type(c_ptr), intent(in), value :: bodies, pair, node
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_solved(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%contact%pairs%unpaired_pair - 1, pair)
    call give(handle%contact%pairs%unpaired_node - 1, node)
  end function c_bodies_get_unpaired

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

  function c_bodies_join(bodies) bind(c, name='fuge_bodies_join') result(status)
    type(c_ptr), intent(in), value :: bodies
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info
    integer :: stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      if (allocated(handle%joined)) deallocate (handle%joined)
      allocate (handle%joined, stat=stat)
      call require_memory(stat, 'all bodies together', info)
      if (stat == 0) then
        call fuge_join_bodies(handle%body, handle%pair, handle%joined, info)
        if (info%failed()) deallocate (handle%joined)
      end if
    end if
    status = report_to_handle(info, handle)
  end function c_bodies_join

  function c_bodies_get_joined_sizes(bodies, degrees, entries, n, width) bind(c, name='fuge_bodies_get_joined_sizes') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, degrees, entries, n, width
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_joined(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(size(handle%joined%column) - 1, degrees)
    call give(size(handle%joined%row), entries)
    call give(handle%joined%pairs%points(), n)
    call give(size(handle%joined%pairs%dof, 1), width)
  end function c_bodies_get_joined_sizes

  function c_bodies_get_matrix(bodies, column, row, value, first) bind(c, name='fuge_bodies_get_matrix') result(status)
    type(c_ptr), intent(in), value :: bodies, column, row, value, first
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_joined(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%joined%column - 1, column)
    call give(handle%joined%row - 1, row)
    call give(handle%joined%value, value)
    call give(handle%joined%first, first)
  end function c_bodies_get_matrix

  function c_bodies_get_contact(bodies, dof, normal, gap, gap_upper, area) bind(c, name='fuge_bodies_get_contact') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, dof, normal, gap, gap_upper, area
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle

    status = find_joined(bodies, handle)
    if (status /= FUGE_DONE) return
    call give(handle%joined%pairs%dof - 1, dof)
    call give(handle%joined%pairs%normal, normal)
    call give(handle%joined%pairs%gap, gap)
    call give(handle%joined%pairs%gap_upper, gap_upper)
    call give(handle%joined%pairs%area, area)
  end function c_bodies_get_contact

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

  !> The same before fuge_bodies_join.
  function find_joined(address, handle) result(status)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    integer(c_int) :: status
    type(fuge_info) :: info

    call find_bodies(address, handle, info)
    if (.not. info%failed()) then
      if (.not. allocated(handle%joined)) call report(info, FUGE_ERR_CALL_ORDER, 'the bodies have not been joined ' &
                                                      //'since their data were set: call fuge_bodies_join first')
    end if
    status = report_failure(info, handle)
  end function find_joined

end module fuge_c_bodies_contact
