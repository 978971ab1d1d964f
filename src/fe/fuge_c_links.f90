!> C bindings, section "links of structures".
module fuge_c_links
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_body, only: body_handle, find_body, find_condensed, report_data
  use fuge_c_solver, only: find_solver, require_problem, solver_handle
  use fuge_c_types, only: from_c_string, from_zero, give_message, report_failure, report_to_c, &
    report_to_handle, reporting_handle, require_columns, require_count, require_pointer, set_handle, take_handle
  use fuge_constants, only: NAME_LENGTH
  use fuge_links_type, only: fuge_link_law, fuge_links, fuge_member, infinite_if_none
  use fuge_mechanism_words, only: fuge_describe_mechanism
  use fuge_member_stiffness, only: fuge_remove_member
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  use fuge_structure_mechanism, only: fuge_find_mechanism
  implicit none
  private

  public :: give_links

  !> struct fuge_link_law.
  type, bind(c) :: c_link_law
    real(c_double) :: gap, play, compliance, limit, limit_upper, reserved(7)
  end type c_link_law

  !> struct fuge_member.
  type, bind(c) :: c_member
    integer(c_int) :: kind
    real(c_double) :: area, modulus, slack, yield, reserved(7)
  end type c_member

  !> Behind struct fuge_links.
  type, extends(reporting_handle) :: links_handle
    type(fuge_links) :: links
  end type links_handle

contains

  subroutine c_default_link_law(destination) bind(c, name='fuge_default_link_law')
    type(c_ptr), intent(in), value :: destination
    type(c_link_law), pointer :: law
    type(fuge_link_law) :: hard

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, law)
    law = c_link_law(hard%gap, infinite_if_none(hard%play), hard%compliance, infinite_if_none(hard%limit), &
                     infinite_if_none(hard%limit_upper), 0.0_c_double)
  end subroutine c_default_link_law

  function c_links_create(destination, message, length) bind(c, name='fuge_links_create') result(status)
    type(c_ptr), intent(in), value :: destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_links) :: none
    type(fuge_info) :: info

    call give_links(none, destination, info)
    status = report_to_c(info, message, length)
  end function c_links_create

  !> Give links to the caller as a handle, unless an error is known already; FUGE_ERR_POINTER, FUGE_ERR_MEMORY.
  subroutine give_links(links, destination, info)
    type(fuge_links), intent(in) :: links
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(links_handle), pointer :: handle
    integer :: stat

    call require_pointer(destination, 'links', info)
    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'the links', info)
    if (stat /= 0) return
    handle%links = links
    call set_handle(c_loc(handle), destination)
  end subroutine give_links

  subroutine c_links_free(source) bind(c, name='fuge_links_free')
    type(c_ptr), intent(in), value :: source
    type(links_handle), pointer :: handle
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, handle)
    deallocate (handle)
  end subroutine c_links_free

  function c_links_add_support(links, count, dof, direction, law, name) bind(c, name='fuge_links_add_support') &
    result(status)
    type(c_ptr), intent(in), value :: links, dof, direction, law, name
    integer(c_int), intent(in), value :: count
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    integer(c_int), pointer :: numbers(:)
    real(c_double), pointer :: values(:)
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_count(count, 1, 'count', 'degrees of freedom of the node', info)
    call find_array(count, dof, 'dof', numbers, info)
    call find_array(count, direction, 'direction', values, info)
    if (.not. info%failed()) call handle%links%add_support(from_zero(numbers), values, info, law_at(law), name_at(name))
    status = report_to_handle(info, handle)
  end function c_links_add_support

  function c_links_add_gap(links, count, dof_a, dof_b, direction, law, name) bind(c, name='fuge_links_add_gap') &
    result(status)
    type(c_ptr), intent(in), value :: links, dof_a, dof_b, direction, law, name
    integer(c_int), intent(in), value :: count
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    integer(c_int), pointer :: first(:), second(:)
    real(c_double), pointer :: values(:)
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_count(count, 1, 'count', 'degrees of freedom of each node', info)
    call find_array(count, dof_a, 'dof_a', first, info)
    call find_array(count, dof_b, 'dof_b', second, info)
    call find_array(count, direction, 'direction', values, info)
    if (.not. info%failed()) call handle%links%add_gap(from_zero(first), from_zero(second), values, info, law_at(law), &
                                                       name_at(name))
    status = report_to_handle(info, handle)
  end function c_links_add_gap

  function c_links_add_member(links, dimensions, dof_a, dof_b, position_a, position_b, member, name) &
    bind(c, name='fuge_links_add_member') result(status)
    type(c_ptr), intent(in), value :: links, dof_a, dof_b, position_a, position_b, member, name
    integer(c_int), intent(in), value :: dimensions
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    integer(c_int), pointer :: first(:), second(:)
    real(c_double), pointer :: place_a(:), place_b(:)
    type(c_member), pointer :: source
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_count(dimensions, 1, 'dimensions', 'axes', info)
    call find_array(dimensions, dof_a, 'dof_a', first, info)
    call find_array(dimensions, dof_b, 'dof_b', second, info)
    call find_array(dimensions, position_a, 'position_a', place_a, info)
    call find_array(dimensions, position_b, 'position_b', place_b, info)
    call require_pointer(member, 'member', info)
    if (.not. info%failed()) then
      call c_f_pointer(member, source)
      call handle%links%add_member(from_zero(first), from_zero(second), place_a, place_b, &
                                   fuge_member(int(source%kind), source%area, source%modulus, source%slack, &
                                               source%yield), info, name_at(name))
    end if
    status = report_to_handle(info, handle)
  end function c_links_add_member

  !> The law in a struct of C; that of a hard link if there is none.
  function law_at(address) result(law)
    type(c_ptr), intent(in) :: address
    type(fuge_link_law) :: law
    type(c_link_law), pointer :: source

    if (.not. c_associated(address)) return
    call c_f_pointer(address, source)
    law = fuge_link_law(source%gap, source%play, source%compliance, source%limit, source%limit_upper)
  end function law_at

  !> The name of a link, as much of it as is kept; blank for NULL.
  function name_at(address) result(name)
    type(c_ptr), intent(in) :: address
    character(len=NAME_LENGTH) :: name

    name = ''
    if (c_associated(address)) name = from_c_string(address)
  end function name_at

  function c_links_get_count(links, count) bind(c, name='fuge_links_get_count') result(status)
    type(c_ptr), intent(in), value :: links, count
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_pointer(count, 'count', info)
    if (.not. info%failed()) call give(handle%links%count(), count)
    status = report_failure(info, handle)
  end function c_links_get_count

  function c_links_get_gaps(links, gap) bind(c, name='fuge_links_get_gaps') result(status)
    type(c_ptr), intent(in), value :: links, gap
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_pointer(gap, 'gap', info)
    if (.not. info%failed()) then
      if (handle%links%count() > 0) call give(handle%links%gaps(), gap)
    end if
    status = report_failure(info, handle)
  end function c_links_get_gaps

  function c_links_message(links, message, length) bind(c, name='fuge_links_message') result(status)
    type(c_ptr), intent(in), value :: links, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    type(fuge_info) :: info

    call find_links(links, handle, info)
    status = give_message(info, handle, message, length)
  end function c_links_message

  function c_body_set_links(body, links) bind(c, name='fuge_body_set_links') result(status)
    type(c_ptr), intent(in), value :: body, links
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(links_handle), pointer :: source
    type(fuge_info) :: info

    call find_body(body, handle, info)
    call find_links(links, source, info)
    if (.not. info%failed()) call source%links%attach(handle%body, info)
    status = report_data(info, handle)
  end function c_body_set_links

  !> The problem of the solver is replaced, its exclusions and springs on motions too.
  function c_links_pose(links, body, solver) bind(c, name='fuge_links_pose') result(status)
    type(c_ptr), intent(in), value :: links, body, solver
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    type(body_handle), pointer :: source
    type(solver_handle), pointer :: destination
    type(fuge_problem) :: problem
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call find_condensed(body, source, info)
    call find_solver(solver, destination, info)
    if (.not. info%failed()) then
      if (destination%operator%operator%points() /= handle%links%count()) call report(info, FUGE_ERR_SIZE, &
        'the operator of the solver has '//text(destination%operator%operator%points())//' points: there are ' &
        //text(handle%links%count())//' links')
    end if
    if (.not. info%failed()) call handle%links%pose(source%condensed, problem, info)
    if (.not. info%failed()) then
      destination%problem = problem
      destination%solved = .false.
    end if
    status = report_to_handle(info, handle)
  end function c_links_pose

  function c_body_find_mechanism(body, solver, displacement) bind(c, name='fuge_body_find_mechanism') result(status)
    type(c_ptr), intent(in), value :: body, solver, displacement
    integer(c_int) :: status
    type(body_handle), pointer :: handle
    type(solver_handle), pointer :: source
    real(c_double), pointer :: values(:)
    type(fuge_info) :: info

    call find_condensed(body, handle, info)
    call find_solver(solver, source, info)
    call require_pointer(displacement, 'displacement', info)
    if (.not. info%failed()) call require_problem(source, 'fuge_body_find_mechanism', info)
    if (.not. info%failed()) call check_points(handle, source, info)
    if (.not. info%failed()) then
      call c_f_pointer(displacement, values, [handle%degrees])
      call fuge_find_mechanism(handle%condensed, source%problem, values, info)
    end if
    status = report_to_handle(info, handle)
  end function c_body_find_mechanism

  !> Refuse a solver of another body (FUGE_ERR_SIZE).
  subroutine check_points(body, solver, info)
    type(body_handle), intent(in) :: body
    type(solver_handle), intent(in) :: solver
    type(fuge_info), intent(inout) :: info

    if (size(solver%problem%gap) /= size(body%condensed%displacement) &
        .or. solver%problem%mode_count() < size(body%condensed%resultant)) then
      call report(info, FUGE_ERR_SIZE, 'the problem of the solver has '//text(size(solver%problem%gap)) &
                  //' points and '//text(solver%problem%mode_count())//' motions: the body has ' &
                  //text(size(body%condensed%displacement))//' and '//text(size(body%condensed%resultant)) &
                  //'; call fuge_links_pose with both')
    end if
  end subroutine check_points

  !> Nine arguments, as in the header: the displacements and the nodes with their sizes, the message.
  function c_links_describe(links, degrees, u, dimensions, nodes, position, dof, message, length) &
    bind(c, name='fuge_links_describe') result(status)
    type(c_ptr), intent(in), value :: links, u, position, dof, message
    integer(c_int), intent(in), value :: degrees, dimensions, nodes
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(links_handle), pointer :: handle
    real(c_double), pointer :: values(:), places(:, :)
    integer(c_int), pointer :: numbers(:, :)
    type(fuge_info) :: info

    call find_links(links, handle, info)
    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_count(dimensions, 2, 'dimensions', 'axes', info)
    call require_count(nodes, 1, 'nodes', 'nodes', info)
    call find_array(degrees, u, 'u', values, info)
    call find_array(int(dimensions), nodes, position, 'position', places, info)
    call find_array(int(dimensions), nodes, dof, 'dof', numbers, info)
    call require_pointer(message, 'message', info)
    if (.not. info%failed()) call fuge_describe_mechanism(handle%links, values, places, from_zero(numbers), info)
    status = report_to_c(info, message, length)
    if (info%failed()) status = report_to_handle(info, handle)
  end function c_links_describe

  !> Ten arguments, as in the header: the matrix with its sizes, the member, the message.
  function c_remove_member(degrees, column, row, value, count, dof, normal, stiffness, message, length) &
    bind(c, name='fuge_remove_member') result(status)
    integer(c_int), intent(in), value :: degrees, count
    type(c_ptr), intent(in), value :: column, row, value, dof, normal, message
    real(c_double), intent(in), value :: stiffness
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    integer(c_int), pointer :: starts(:)
    type(fuge_info) :: info

    call require_count(degrees, 1, 'degrees', 'degrees of freedom', info)
    call require_columns(degrees, 'degrees', info)
    call require_count(count, 1, 'count', 'degrees of freedom of the member', info)
    call require_pointer(column, 'column', info)
    if (.not. info%failed()) then
      call c_f_pointer(column, starts, [int(degrees) + 1])
      call check_starts(starts, info)
      call remove_from(starts, row, value, count, dof, normal, stiffness, info)
    end if
    status = report_to_c(info, message, length)
  end function c_remove_member

  !> Take a member out of the matrix whose columns begin at `starts`.
  subroutine remove_from(starts, row, value, count, dof, normal, stiffness, info)
    integer(c_int), intent(in) :: starts(:), count
    type(c_ptr), intent(in) :: row, value, dof, normal
    real(c_double), intent(in) :: stiffness
    type(fuge_info), intent(inout) :: info
    integer(c_int), pointer :: rows(:), numbers(:)
    real(c_double), pointer :: values(:), directions(:)

    call find_array(starts(size(starts)), row, 'row', rows, info)
    call find_array(starts(size(starts)), value, 'value', values, info)
    call find_array(count, dof, 'dof', numbers, info)
    call find_array(count, normal, 'normal', directions, info)
    if (info%failed()) return
    call fuge_remove_member(from_zero(starts), from_zero(rows), values, from_zero(numbers), directions, stiffness, info)
  end subroutine remove_from

  !> Refuse beginnings of columns that do not ascend from 0 (FUGE_ERR_SIZE).
  subroutine check_starts(starts, info)
    integer(c_int), intent(in) :: starts(:)
    type(fuge_info), intent(inout) :: info
    integer :: j

    if (starts(1) /= 0) call report(info, FUGE_ERR_SIZE, 'column('//index_text(1)//') is '//text(int(starts(1))) &
                                    //': the first column begins at 0')
    do j = 2, size(starts)
      if (info%failed()) return
      if (starts(j) < starts(j - 1)) call report(info, FUGE_ERR_SIZE, 'column('//index_text(j)//') is ' &
        //text(int(starts(j)))//', less than the one before: columns end where the next one begins')
    end do
  end subroutine check_starts

  !> The links behind a handle; NULL is FUGE_ERR_POINTER.
  subroutine find_links(address, handle, info)
    type(c_ptr), intent(in) :: address
    type(links_handle), pointer, intent(out) :: handle
    type(fuge_info), intent(inout) :: info

    nullify (handle)
    call require_pointer(address, 'links', info)
    if (.not. info%failed()) call c_f_pointer(address, handle)
  end subroutine find_links

end module fuge_c_links
