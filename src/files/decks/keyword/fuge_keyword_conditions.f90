!> The data lines of *BOUNDARY and *CLOAD in input files of Abaqus and CalculiX.
module fuge_keyword_conditions
  use fuge_condition_table, only: condition_table
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_input_deck, only: upper_case
  use fuge_kinds, only: dp
  use fuge_mesh_sets, only: fuge_mesh_node_set
  use fuge_mesh_type, only: fuge_mesh
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info
  use fuge_text_columns, only: begin_columns, next_column, next_name
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: read_boundary_line, read_load_line

  !> Directions of a node.
  integer, parameter :: DIRECTIONS = 6
  !> Names of supports and the directions that they hold.
  character(len=8), parameter :: SUPPORT_NAMES(8) = [character(len=8) :: 'ENCASTRE', 'PINNED', 'XSYMM', 'YSYMM', &
    'ZSYMM', 'XASYMM', 'YASYMM', 'ZASYMM']
  integer, parameter :: HELD_DIRECTIONS(8) = [123456, 123, 156, 246, 345, 234, 135, 126]

contains

  !> *BOUNDARY: node or set, first and last direction, displacement; or node or set, and the name of a support.
  subroutine read_boundary_line(line, mesh, numbers, origin, paths, held, reason, status)
    character(len=*), intent(in) :: line, paths
    type(fuge_mesh), intent(in) :: mesh
    type(row_table), intent(in) :: numbers
    integer, intent(in) :: origin(3)
    type(condition_table), intent(inout) :: held
    character(len=:), allocatable, intent(out) :: reason
    integer, intent(inout) :: status
    integer, allocatable :: nodes(:)
    real(dp) :: value
    integer :: digits, first, k, last, last_direction, direction, separator

    k = begin_columns(line)
    call next_name(line, k, first, last, separator)
    call find_nodes(line(first:last), mesh, numbers, nodes, reason)
    if (allocated(reason)) return
    call next_column(line, k, first, last, separator)
    if (last >= first) digits = findloc(SUPPORT_NAMES == upper_case(line(first:last)), .true., dim=1)
    if (last < first) digits = 0
    value = 0.0_dp
    if (digits > 0) then
      digits = HELD_DIRECTIONS(digits)
    else
      call read_label(line(first:last), 'direction', 1, DIRECTIONS, direction, reason)
      call next_column(line, k, first, last, separator)
      last_direction = direction
      if (last >= first) call read_label(line(first:last), 'last direction', direction, DIRECTIONS, last_direction, &
                                         reason)
      call next_column(line, k, first, last, separator)
      if (last >= first) call read_value(line(first:last), value, reason)
      do direction = direction, last_direction
        digits = 10*digits + direction
      end do
    end if
    if (k <= len(line) .and. .not. allocated(reason)) reason = 'more columns than node, first and last direction, ' &
      //'displacement'
    if (.not. allocated(reason)) call hold_nodes(nodes, digits, value, origin, paths, held, reason, status)
  end subroutine read_boundary_line

  !> Hold nodes in directions such as 123.
  pure subroutine hold_nodes(nodes, directions, value, origin, paths, held, reason, status)
    integer, intent(in) :: nodes(:), directions, origin(3)
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: paths
    type(condition_table), intent(inout) :: held
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    integer :: digits, i

    do i = 1, size(nodes)
      digits = directions
      do while (digits > 0 .and. .not. allocated(reason))
        call held%hold(nodes(i), mod(digits, 10), value, origin, paths, reason, status)
        digits = digits/10
      end do
    end do
  end subroutine hold_nodes

  !> *CLOAD: node or set, direction, force on each node.
  subroutine read_load_line(line, mesh, numbers, origin, forces, reason, status)
    character(len=*), intent(in) :: line
    type(fuge_mesh), intent(in) :: mesh
    type(row_table), intent(in) :: numbers
    integer, intent(in) :: origin(3)
    type(condition_table), intent(inout) :: forces
    character(len=:), allocatable, intent(out) :: reason
    integer, intent(inout) :: status
    integer, allocatable :: nodes(:)
    real(dp) :: value
    integer :: direction, first, i, k, last, separator

    k = begin_columns(line)
    call next_name(line, k, first, last, separator)
    call find_nodes(line(first:last), mesh, numbers, nodes, reason)
    call next_column(line, k, first, last, separator)
    call read_label(line(first:last), 'direction', 1, DIRECTIONS, direction, reason)
    call next_column(line, k, first, last, separator)
    call read_value(line(first:last), value, reason)
    if (k <= len(line) .and. .not. allocated(reason)) reason = 'more columns than node, direction and force'
    if (allocated(reason)) return
    do i = 1, size(nodes)
      call forces%add(nodes(i), direction, value, origin, status)
    end do
  end subroutine read_load_line

  !> The node of this number, or those of the set of this name.
  subroutine find_nodes(word, mesh, numbers, nodes, reason)
    character(len=*), intent(in) :: word
    type(fuge_mesh), intent(in) :: mesh
    type(row_table), intent(in) :: numbers
    integer, allocatable, intent(out) :: nodes(:)
    character(len=:), allocatable, intent(inout) :: reason
    type(fuge_info) :: info
    integer :: number

    if (len(word) == 0) then
      reason = 'the node is missing'
    else if (verify(word(1:1), '0123456789+-.') == 0) then
      call read_label(word, 'node', 1, huge(1), number, reason)
      if (allocated(reason)) return
      if (numbers%find(number, 0) == 0) reason = 'the deck has no node '//text(number)
      nodes = [number]
    else
      call fuge_mesh_node_set(mesh, unquoted(word), nodes, info)
      if (info%failed()) then
        reason = 'the set of nodes '//quoted(word)//' is not defined'
      else
        nodes = mesh%node(nodes)
      end if
    end if
  end subroutine find_nodes

  !> The word without quotes at its ends.
  pure function unquoted(word) result(name)
    character(len=*), intent(in) :: word
    character(len=len(word)) :: name

    name = word
    if (len(word) > 2 .and. word(1:1) == '"') name = word(2:len(word) - 1)
  end function unquoted

end module fuge_keyword_conditions
