!> C bindings, sections "elastic bodies" and "bodies as one": what is found.
module fuge_c_bodies_contact
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  use fuge_bodies_solution, only: fuge_solve_bodies
  use fuge_body_joining, only: fuge_join_bodies
  use fuge_c_elastic_bodies, only: bodies_handle, find_bodies, report_to_bodies
  use fuge_c_types, only: c_info, c_options, copy_integers, copy_reals, copy_string, from_c, require_pointer, to_c
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY, FUGE_ERR_SIZE
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
    type(c_options), pointer :: options_of_c
    type(fuge_options) :: chosen
    type(fuge_info) :: info
    integer :: stat

    call find_bodies(bodies, handle, info)
    if (.not. info%failed()) then
      if (c_associated(options)) then
        call c_f_pointer(options, options_of_c)
        chosen = from_c(options_of_c)
      end if
      stat = 0
      if (.not. allocated(handle%contact)) allocate (handle%contact, stat=stat)
      if (stat /= 0) then
        call report(info, FUGE_ERR_MEMORY, 'no memory for the solution')
      else
        call fuge_solve_bodies(stiffness, handle%body, handle%pair, handle%contact, info, chosen)
      end if
      handle%info = info
      handle%tried = .true.
    end if
    status = report_to_bodies(info, handle)
  end function solve_bodies

  function c_bodies_get_sizes(bodies, n, unpaired, number) bind(c, name='fuge_bodies_get_sizes') result(status)
    type(c_ptr), intent(in), value :: bodies, n, unpaired, number
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers([size(handle%contact%force)], n)
      call copy_integers([size(handle%contact%pairs%unpaired_node)], unpaired)
      call copy_integers([size(handle%contact%first) - 1], number)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_sizes

  function c_bodies_get_forces(bodies, force, pressure, gap) bind(c, name='fuge_bodies_get_forces') result(status)
    type(c_ptr), intent(in), value :: bodies, force, pressure, gap
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_reals(handle%contact%force, force)
      call copy_reals(handle%contact%pressure, pressure)
      call copy_reals(handle%contact%gap, gap)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_forces

  function c_bodies_get_points(bodies, pair, node, face, place, direction) bind(c, name='fuge_bodies_get_points') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, pair, node, face, place, direction
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers(handle%contact%pairs%pair - 1, pair)
      call copy_integers(handle%contact%pairs%node - 1, node)
      call copy_integers(handle%contact%pairs%face - 1, face)
      call copy_reals([handle%contact%pairs%place], place)
      call copy_reals([handle%contact%pairs%direction], direction)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_points

  function c_bodies_get_areas(bodies, area, initial_gap) bind(c, name='fuge_bodies_get_areas') result(status)
    type(c_ptr), intent(in), value :: bodies, area, initial_gap
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_reals(handle%contact%pairs%area, area)
      call copy_reals(handle%contact%pairs%gap, initial_gap)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_areas

  function c_bodies_get_unpaired(bodies, pair, node) bind(c, name='fuge_bodies_get_unpaired') result(status)
    type(c_ptr), intent(in), value :: bodies, pair, node
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers(handle%contact%pairs%unpaired_pair - 1, pair)
      call copy_integers(handle%contact%pairs%unpaired_node - 1, node)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_unpaired

  function c_bodies_get_displacement(bodies, body, displacement) bind(c, name='fuge_bodies_get_displacement') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, displacement
    integer(c_int), intent(in), value :: body
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_solved(bodies, handle, info)
    if (.not. info%failed()) then
      if (body < 0 .or. body >= size(handle%contact%first) - 1) call report(info, FUGE_ERR_SIZE, 'body = ' &
        //text(int(body))//' is not one of the '//text(size(handle%contact%first) - 1)//' bodies of the last solve')
    end if
    if (.not. info%failed()) call copy_reals(handle%contact%displacement(handle%contact%first(body + 1) + 1: &
                                                                         handle%contact%first(body + 2)), displacement)
    status = report_getter(info, handle)
  end function c_bodies_get_displacement

  function c_bodies_get_info(bodies, destination) bind(c, name='fuge_bodies_get_info') result(status)
    type(c_ptr), intent(in), value :: bodies, destination
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(c_info), pointer :: info_of_c
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    call require_pointer(destination, 'info', info)
    if (.not. info%failed()) then
      if (.not. handle%tried) call report(info, FUGE_ERR_CALL_ORDER, 'there is no solve: call fuge_bodies_solve first')
    end if
    if (.not. info%failed()) then
      call c_f_pointer(destination, info_of_c)
      info_of_c = to_c(handle%info)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_info

  function c_bodies_message(bodies, message, length) bind(c, name='fuge_bodies_message') result(status)
    type(c_ptr), intent(in), value :: bodies, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_bodies(bodies, handle, info)
    call require_pointer(message, 'message', info)
    if (.not. info%failed()) call copy_string(handle%message, message, length)
    status = int(info%status, c_int)
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
      if (stat /= 0) then
        call report(info, FUGE_ERR_MEMORY, 'no memory for all bodies together')
      else
        call fuge_join_bodies(handle%body, handle%pair, handle%joined, info)
        if (info%failed()) deallocate (handle%joined)
      end if
    end if
    status = report_to_bodies(info, handle)
  end function c_bodies_join

  function c_bodies_get_joined_sizes(bodies, degrees, entries, n, width) bind(c, name='fuge_bodies_get_joined_sizes') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, degrees, entries, n, width
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_joined(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers([size(handle%joined%column) - 1], degrees)
      call copy_integers([size(handle%joined%row)], entries)
      call copy_integers([handle%joined%pairs%points()], n)
      call copy_integers([size(handle%joined%pairs%dof, 1)], width)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_joined_sizes

  function c_bodies_get_matrix(bodies, column, row, value, first) bind(c, name='fuge_bodies_get_matrix') result(status)
    type(c_ptr), intent(in), value :: bodies, column, row, value, first
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_joined(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers(handle%joined%column - 1, column)
      call copy_integers(handle%joined%row - 1, row)
      call copy_reals(handle%joined%value, value)
      call copy_integers(handle%joined%first, first)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_matrix

  function c_bodies_get_contact(bodies, dof, normal, gap, gap_upper, area) bind(c, name='fuge_bodies_get_contact') &
    result(status)
    type(c_ptr), intent(in), value :: bodies, dof, normal, gap, gap_upper, area
    integer(c_int) :: status
    type(bodies_handle), pointer :: handle
    type(fuge_info) :: info

    call find_joined(bodies, handle, info)
    if (.not. info%failed()) then
      call copy_integers([handle%joined%pairs%dof - 1], dof)
      call copy_reals([handle%joined%pairs%normal], normal)
      call copy_reals(handle%joined%pairs%gap, gap)
      call copy_reals(handle%joined%pairs%gap_upper, gap_upper)
      call copy_reals(handle%joined%pairs%area, area)
    end if
    status = report_getter(info, handle)
  end function c_bodies_get_contact

  !> The bodies behind a handle, refused before a solve.
  subroutine find_solved(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info
    logical :: solved

    call find_bodies(address, handle, info)
    if (info%failed()) return
    solved = allocated(handle%contact)
    if (solved) solved = allocated(handle%contact%force)
    if (.not. solved) call report(info, FUGE_ERR_CALL_ORDER, 'there is no solution: call fuge_bodies_solve first')
  end subroutine find_solved

  !> The same before fuge_bodies_join.
  subroutine find_joined(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(bodies_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    call find_bodies(address, handle, info)
    if (info%failed()) return
    if (.not. allocated(handle%joined)) call report(info, FUGE_ERR_CALL_ORDER, 'the bodies have not been joined ' &
                                                    //'since their data were set: call fuge_bodies_join first')
  end subroutine find_joined

  !> The status of a getter, which leaves the message alone on success.
  function report_getter(info, handle) result(status)
    type(fuge_info), intent(in) :: info
    type(bodies_handle), pointer, intent(in) :: handle
    integer(c_int) :: status

    status = FUGE_DONE
    if (info%failed()) status = report_to_bodies(info, handle)
  end function report_getter

end module fuge_c_bodies_contact
