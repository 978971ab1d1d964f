!> C bindings, section "decks".
module fuge_c_decks
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
  use fuge_c_arrays, only: find_array, give
  use fuge_c_links, only: give_links
  use fuge_c_types, only: copy_string, from_c_string, report_to_c, require_count, require_path, require_pointer, &
    set_handle, take_handle
  use fuge_deck_files, only: fuge_read_deck
  use fuge_deck_rows, only: fuge_deck_links, fuge_deck_loads, fuge_deck_supports
  use fuge_deck_tables, only: fuge_read_cases, fuge_read_links, fuge_read_supports
  use fuge_deck_type, only: fuge_deck, move_deck
  use fuge_kinds, only: dp
  use fuge_links_type, only: fuge_links, infinite_if_none
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  abstract interface
    subroutine table_reader(path, deck, info)
      import :: fuge_deck, fuge_info
      character(len=*), intent(in) :: path
      type(fuge_deck), intent(inout) :: deck
      type(fuge_info), intent(out) :: info
    end subroutine table_reader
  end interface

contains

  function c_read_deck(path, destination, message, length) bind(c, name='fuge_read_deck') result(status)
    type(c_ptr), intent(in), value :: path, destination, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck) :: deck
    type(fuge_info) :: info

    call require_path(path, info)
    call require_pointer(destination, 'deck', info)
    if (.not. info%failed()) call fuge_read_deck(from_c_string(path), deck, info)
    call give_deck(deck, destination, info)
    status = report_to_c(info, message, length)
  end function c_read_deck

  function c_deck_create(destination) bind(c, name='fuge_deck_create') result(status)
    type(c_ptr), intent(in), value :: destination
    integer(c_int) :: status
    type(fuge_deck) :: deck
    type(fuge_info) :: info

    call require_pointer(destination, 'deck', info)
    call give_deck(deck, destination, info)
    status = info%status
  end function c_deck_create

  !> Give a deck to the caller as a handle, unless an error is known already; FUGE_ERR_MEMORY.
  subroutine give_deck(deck, destination, info)
    type(fuge_deck), intent(inout) :: deck
    type(c_ptr), intent(in) :: destination
    type(fuge_info), intent(inout) :: info
    type(fuge_deck), pointer :: handle
    integer :: stat

    if (info%failed()) return
    allocate (handle, stat=stat)
    call require_memory(stat, 'a deck', info)
    if (stat /= 0) return
    call move_deck(deck, handle)
    call set_handle(c_loc(handle), destination)
  end subroutine give_deck

  subroutine c_deck_free(source) bind(c, name='fuge_deck_free')
    type(c_ptr), intent(in), value :: source
    type(fuge_deck), pointer :: deck
    type(c_ptr) :: address

    address = take_handle(source)
    if (.not. c_associated(address)) return
    call c_f_pointer(address, deck)
    deallocate (deck)
  end subroutine c_deck_free

  !> The deck behind a handle; unless an error is known already, NULL is one.
  subroutine find_deck(handle, deck, info)
    type(c_ptr), intent(in) :: handle
    type(fuge_deck), pointer, intent(out) :: deck
    type(fuge_info), intent(inout) :: info

    nullify (deck)
    call require_pointer(handle, 'deck', info)
    if (.not. info%failed()) call c_f_pointer(handle, deck)
  end subroutine find_deck

  !> Add the rows of a table to the deck behind a handle.
  function read_table(read_rows, handle, path, message, length) result(status)
    procedure(table_reader) :: read_rows
    type(c_ptr), intent(in) :: handle, path, message
    integer(c_size_t), intent(in) :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    type(fuge_info) :: info

    call find_deck(handle, deck, info)
    call require_path(path, info)
    if (.not. info%failed()) call read_rows(from_c_string(path), deck, info)
    status = report_to_c(info, message, length)
  end function read_table

  function c_deck_read_links(handle, path, message, length) bind(c, name='fuge_deck_read_links') result(status)
    type(c_ptr), intent(in), value :: handle, path, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = read_table(fuge_read_links, handle, path, message, length)
  end function c_deck_read_links

  function c_deck_read_supports(handle, path, message, length) bind(c, name='fuge_deck_read_supports') result(status)
    type(c_ptr), intent(in), value :: handle, path, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = read_table(fuge_read_supports, handle, path, message, length)
  end function c_deck_read_supports

  function c_deck_read_cases(handle, path, message, length) bind(c, name='fuge_deck_read_cases') result(status)
    type(c_ptr), intent(in), value :: handle, path, message
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status

    status = read_table(fuge_read_cases, handle, path, message, length)
  end function c_deck_read_cases

  function c_deck_get_counts(handle, links, cases) bind(c, name='fuge_deck_get_counts') result(status)
    type(c_ptr), intent(in), value :: handle, links, cases
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    type(fuge_info) :: info

    call find_deck(handle, deck, info)
    status = info%status
    if (info%failed()) return
    call give(deck%link_count(), links)
    call give(deck%case_count(), cases)
  end function c_deck_get_counts

  function c_deck_get_links(handle, node_a, node_b, direction, gap, play, compliance, limit) &
    bind(c, name='fuge_deck_get_links') result(status)
    type(c_ptr), intent(in), value :: handle, node_a, node_b, direction, gap, play, compliance, limit
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    type(fuge_info) :: info
    real(dp), pointer :: directions(:, :)
    integer :: k

    call find_deck(handle, deck, info)
    status = info%status
    if (info%failed()) return
    if (deck%link_count() == 0) return
    call give(deck%links%node_a, node_a)
    call give(deck%links%node_b, node_b)
    call give(deck%links%gap, gap)
    call give(infinite_if_none(deck%links%play), play)
    call give(deck%links%compliance, compliance)
    call give(infinite_if_none(deck%links%limit), limit)
    if (.not. c_associated(direction)) return
    call c_f_pointer(direction, directions, [3, deck%link_count()])
    do k = 1, deck%link_count()
      directions(:, k) = deck%links(k)%direction
    end do
  end function c_deck_get_links

  function c_deck_get_link_name(handle, k, name, length) bind(c, name='fuge_deck_get_link_name') result(status)
    type(c_ptr), intent(in), value :: handle, name
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    type(fuge_info) :: info

    call find_deck(handle, deck, info)
    if (.not. info%failed()) then
      if (k < 0 .or. k >= deck%link_count()) &
        call report(info, FUGE_ERR_SIZE, 'the deck has no link '//index_text(int(k) + 1))
    end if
    status = info%status
    if (.not. info%failed()) call copy_string(deck%links(k + 1)%name, name, length)
  end function c_deck_get_link_name

  function c_deck_get_case_name(handle, k, name, length) bind(c, name='fuge_deck_get_case_name') result(status)
    type(c_ptr), intent(in), value :: handle, name
    integer(c_int), intent(in), value :: k
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    type(fuge_info) :: info

    call find_deck(handle, deck, info)
    if (.not. info%failed()) then
      if (k < 0 .or. k >= deck%case_count()) &
        call report(info, FUGE_ERR_SIZE, 'the deck has no load case '//index_text(int(k) + 1))
    end if
    status = info%status
    if (.not. info%failed()) call copy_string(deck%cases(k + 1)%name, name, length)
  end function c_deck_get_case_name

  function c_deck_make_links(handle, rows, node, direction, links, message, length) &
    bind(c, name='fuge_deck_make_links') result(status)
    type(c_ptr), intent(in), value :: handle, node, direction, links, message
    integer(c_int), intent(in), value :: rows
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    integer(c_int), pointer :: nodes(:), directions(:)
    type(fuge_links) :: made
    type(fuge_info) :: info

    call find_rows(handle, rows, node, direction, deck, nodes, directions, info)
    call require_pointer(links, 'links', info)
    if (.not. info%failed()) call fuge_deck_links(deck, int(nodes), int(directions), made, info)
    if (.not. info%failed()) call give_links(made, links, info)
    status = report_to_c(info, message, length)
  end function c_deck_make_links

  !> What functions with the rows of a matrix are given.
  subroutine find_rows(handle, rows, node, direction, deck, nodes, directions, info)
    type(c_ptr), intent(in) :: handle, node, direction
    integer(c_int), intent(in) :: rows
    type(fuge_deck), pointer, intent(out) :: deck
    integer(c_int), pointer, intent(out) :: nodes(:), directions(:)
    type(fuge_info), intent(inout) :: info

    call find_deck(handle, deck, info)
    call require_count(rows, 1, 'rows', 'rows of the matrix', info)
    call find_array(rows, node, 'node', nodes, info)
    call find_array(rows, direction, 'direction', directions, info)
  end subroutine find_rows

  function c_deck_get_loads(handle, rows, node, direction, loads, message, length) &
    bind(c, name='fuge_deck_get_loads') result(status)
    type(c_ptr), intent(in), value :: handle, node, direction, loads, message
    integer(c_int), intent(in), value :: rows
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    integer(c_int), pointer :: nodes(:), directions(:)
    real(dp), allocatable :: columns(:, :)
    type(fuge_info) :: info

    call find_rows(handle, rows, node, direction, deck, nodes, directions, info)
    if (.not. info%failed()) call fuge_deck_loads(deck, int(nodes), int(directions), columns, info)
    if (.not. info%failed()) call give(columns, loads)
    status = report_to_c(info, message, length)
  end function c_deck_get_loads

  !> The arguments are eleven, as in the header: the deck, the case, the rows of the matrix, the result, the message.
  function c_deck_get_supports(handle, k, rows, node, direction, capacity, dof, displacement, number, message, length) &
    bind(c, name='fuge_deck_get_supports') result(status)
    type(c_ptr), intent(in), value :: handle, node, direction, dof, displacement, number, message
    integer(c_int), intent(in), value :: k, rows, capacity
    integer(c_size_t), intent(in), value :: length
    integer(c_int) :: status
    type(fuge_deck), pointer :: deck
    integer(c_int), pointer :: nodes(:), directions(:)
    integer, allocatable :: fixed(:)
    real(dp), allocatable :: displacements(:)
    type(fuge_info) :: info
    integer :: n

    call find_rows(handle, rows, node, direction, deck, nodes, directions, info)
    call require_pointer(number, 'count', info)
    call require_count(capacity, 0, 'capacity', 'elements that fit into dof', info)
    if (.not. info%failed()) then
      if (k < 0 .or. k >= deck%case_count()) &
        call report(info, FUGE_ERR_SIZE, 'the deck has no load case '//index_text(int(k) + 1))
    end if
    if (.not. info%failed()) &
      call fuge_deck_supports(deck, int(k) + 1, int(nodes), int(directions), fixed, displacements, info)
    if (.not. info%failed()) then
      n = min(int(capacity), size(fixed))
      call give(fixed(:n) - 1, dof)
      call give(displacements(:n), displacement)
      call give(size(fixed), number)
    end if
    status = report_to_c(info, message, length)
  end function c_deck_get_supports

end module fuge_c_decks
