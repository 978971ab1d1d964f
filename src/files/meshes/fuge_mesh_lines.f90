!> The data lines of an input file of Abaqus or CalculiX: nodes, elements, members of sets, faces of surfaces.
module fuge_mesh_lines
  use fuge_draft_sets, only: draft_set, draft_sets, labels_in_range, GENERATED
  use fuge_entry_numbers, only: read_label, read_value
  use fuge_input_deck, only: upper_case
  use fuge_integer_list, only: integer_list
  use fuge_kinds, only: dp
  use fuge_mesh_draft, only: mesh_draft, FACE_SNEG, FACE_SPOS
  use fuge_mesh_type, only: NAME_LENGTH
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_text_columns, only: begin_columns, next_column, SEPARATOR_COMMA
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: add_element_nodes, read_element_line, read_node_line, read_set_line, read_surface_line

  !> Most members that one line of GENERATE may make.
  integer, parameter :: MOST_GENERATED = 20000000

  !> The block of data lines under a keyword.
  type, public :: mesh_block
    !> Present file and line, for the draft.
    integer :: file = 0, line = 0
    !> Set to which the nodes or elements are added, 0 if none.
    integer :: set = 0
    !> *NSET and *ELSET: lines are first, last and step.
    logical :: generate = .false.
    !> *ELEMENT: number of the type, nodes of an element (0 unknown), and those still missing of the last one.
    integer :: element_type = 0, nodes = 0, missing = 0
    !> The last line of an element of unknown type ended with a comma.
    logical :: continues = .false.
  end type mesh_block

contains

  !> A node: label, x, y, z; coordinates that are missing are 0.
  pure subroutine read_node_line(line, block, draft, reason)
    character(len=*), intent(in) :: line
    type(mesh_block), intent(in) :: block
    type(mesh_draft), intent(inout) :: draft
    character(len=:), allocatable, intent(out) :: reason
    real(dp) :: position(3)
    integer :: first, i, k, label, last, separator
    logical :: is_new

    k = begin_columns(line)
    call next_column(line, k, first, last, separator)
    call read_label(line(first:last), 'node', 1, huge(1), label, reason)
    position = 0.0_dp
    do i = 1, 3
      call next_column(line, k, first, last, separator)
      if (first <= last) call read_value(line(first:last), position(i), reason)
    end do
    if (.not. allocated(reason) .and. k <= len(line)) then
      ! Some programs write direction cosines behind the coordinates.
      call next_column(line, k, first, last, separator)
      if (first <= last) reason = 'more than three coordinates of node '//text(label)
    end if
    if (allocated(reason)) return
    call draft%add_node(label, position, is_new)
    if (.not. is_new .and. draft%status == 0) reason = 'node '//text(label)//' is defined a second time'
    if (is_new) call add_member(draft%node_sets, block, label, 0, block%line, draft%status)
  end subroutine read_node_line

  !> Add a member to the set of a block, if it has one.
  pure subroutine add_member(sets, block, label, face, line, status)
    type(draft_sets), intent(inout) :: sets
    type(mesh_block), intent(in) :: block
    integer, intent(in) :: label, face, line
    integer, intent(inout) :: status

    if (block%set > 0) call sets%set(block%set)%append(label, face, line, block%file, status)
  end subroutine add_member

  !> An element, label and nodes, or more nodes of the last one.
  pure subroutine read_element_line(line, block, draft, reason)
    character(len=*), intent(in) :: line
    type(mesh_block), intent(inout) :: block
    type(mesh_draft), intent(inout) :: draft
    character(len=:), allocatable, intent(out) :: reason
    integer :: first, k, label, last, separator

    k = begin_columns(line)
    if (block%missing == 0 .and. .not. block%continues) then
      call next_column(line, k, first, last, separator)
      call read_label(line(first:last), 'element', 1, huge(1), label, reason)
      if (.not. allocated(reason)) call begin_element(label, block, draft, reason)
    end if
    separator = SEPARATOR_COMMA
    do while (k <= len(line) .and. .not. allocated(reason))
      call next_column(line, k, first, last, separator)
      call read_label(line(first:last), 'node', 1, huge(1), label, reason)
      if (allocated(reason)) return
      if (block%nodes > 0 .and. block%missing == 0) then
        reason = 'more than '//text(block%nodes)//' nodes of element ' &
          //text(draft%elements%node(draft%elements%count))//' of type '//trim(draft%types%name(block%element_type))
        return
      end if
      call draft%connection%append(label, draft%status)
      if (block%nodes > 0) block%missing = block%missing - 1
    end do
    block%continues = block%nodes == 0 .and. separator == SEPARATOR_COMMA
  end subroutine read_element_line

  pure subroutine begin_element(label, block, draft, reason)
    integer, intent(in) :: label
    type(mesh_block), intent(inout) :: block
    type(mesh_draft), intent(inout) :: draft
    character(len=:), allocatable, intent(inout) :: reason
    integer :: elements, number

    elements = draft%elements%count
    call draft%elements%number_of(label, 0, number, draft%status)
    if (draft%status /= 0) return
    if (number <= elements) then
      reason = 'element '//text(label)//' is defined a second time'
      return
    end if
    block%missing = block%nodes
    call draft%element_type%append(block%element_type, draft%status)
    call draft%element_line%append(block%line, draft%status)
    call draft%element_file%append(block%file, draft%status)
    call draft%first%append(draft%connection%count + 1, draft%status)
    call add_member(draft%element_sets, block, label, 0, block%line, draft%status)
  end subroutine begin_element

  !> Members of a set: labels, and names of other sets; or first, last and step.
  pure subroutine read_set_line(line, what, block, sets, status, reason)
    character(len=*), intent(in) :: line, what
    type(mesh_block), intent(in) :: block
    type(draft_sets), intent(inout) :: sets
    integer, intent(inout) :: status
    character(len=:), allocatable, intent(out) :: reason
    integer :: first, k, label, last, separator, other

    if (block%generate) then
      call generate_members(line, what, block, sets, status, reason)
      return
    end if
    k = begin_columns(line)
    do while (k <= len(line) .and. status == 0)
      call next_column(line, k, first, last, separator)
      if (is_name(line(first:last))) then
        other = known_set(line(first:last), sets)
        if (other == 0) then
          reason = 'the set '//quoted(line(first:last))//' is not defined above'
          return
        end if
        if (other /= block%set) call add_all(sets, other, block, status)
      else
        call read_label(line(first:last), what, 1, huge(1), label, reason)
        if (allocated(reason)) return
        call add_member(sets, block, label, 0, block%line, status)
      end if
    end do
  end subroutine read_set_line

  !> Is the column a name, and no number?
  pure function is_name(string) result(name)
    character(len=*), intent(in) :: string
    logical :: name

    name = len(string) > 0
    if (name) name = verify(string(1:1), '0123456789+-.') > 0
  end function is_name

  pure function known_set(string, sets) result(number)
    character(len=*), intent(in) :: string
    type(draft_sets), intent(in) :: sets
    integer :: number
    character(len=NAME_LENGTH) :: name

    name = upper_case(string)
    if (len(string) > 2 .and. string(1:1) == '"') name = upper_case(string(2:len(string) - 1))
    number = sets%known(trim(name))
  end function known_set

  !> Add all members of another set.
  pure subroutine add_all(sets, other, block, status)
    type(draft_sets), intent(inout) :: sets
    integer, intent(in) :: other
    type(mesh_block), intent(in) :: block
    integer, intent(inout) :: status
    integer :: count, first, i, label

    count = sets%set(other)%label%count
    call sets%set(block%set)%begin_taking(other, 0, count, 0, first, status)
    do i = first, count
      if (status /= 0) return
      label = sets%set(other)%label%item(i)
      if (sets%set(other)%line%item(i) == GENERATED) then
        call sets%set(block%set)%append(label, sets%set(other)%face%item(i), GENERATED, sets%set(other)%file%item(i), &
                                        status)
      else
        call sets%set(block%set)%append(label, 0, block%line, block%file, status)
      end if
    end do
  end subroutine add_all

  pure subroutine generate_members(line, what, block, sets, status, reason)
    character(len=*), intent(in) :: line, what
    type(mesh_block), intent(in) :: block
    type(draft_sets), intent(inout) :: sets
    integer, intent(inout) :: status
    character(len=:), allocatable, intent(out) :: reason
    integer :: first, i, k, last, separator, range(3)

    k = begin_columns(line)
    range = 1
    do i = 1, 3
      call next_column(line, k, first, last, separator)
      if (first > last .and. i == 3) exit
      call read_label(line(first:last), what, 1, huge(1), range(i), reason)
    end do
    if (allocated(reason)) return
    if (range(1) > range(2)) then
      reason = 'from '//text(range(1))//' to '//text(range(2))//': the first number must not be above the last one'
    else if ((range(2) - range(1))/range(3) >= MOST_GENERATED) then
      reason = 'more than '//text(MOST_GENERATED)//' members from '//text(range(1))//' to '//text(range(2))
    else
      call sets%set(block%set)%append(range(1), range(2), GENERATED, range(3), status)
    end if
  end subroutine generate_members

  !> Add the nodes of all elements of a set to the set of nodes of a block.
  pure subroutine add_element_nodes(name, block, draft, reason)
    character(len=*), intent(in) :: name
    type(mesh_block), intent(in) :: block
    type(mesh_draft), intent(inout) :: draft
    character(len=:), allocatable, intent(out) :: reason
    type(integer_list) :: elements
    integer :: first, k, number, p

    number = draft%element_sets%known(name)
    if (number == 0) then
      reason = 'the element set '//quoted(name)//' is not defined above'
      return
    end if
    associate (from => draft%element_sets%set(number))
      call draft%node_sets%set(block%set)%begin_taking(-number, 0, from%label%count, draft%elements%count, first, &
                                                       draft%status)
      call find_elements(draft%elements, from, first, elements, draft%status)
    end associate
    do k = 1, elements%count
      if (draft%status /= 0) return
      number = draft%elements%find(elements%item(k), 0)
      if (number == 0) then
        reason = 'element '//text(elements%item(k))//' of the set '//quoted(name)//' is not defined above'
        return
      end if
      do p = draft%first%item(number), last_connection(draft, number)
        call add_member(draft%node_sets, block, draft%connection%item(p), 0, block%line, draft%status)
      end do
    end do
  end subroutine add_element_nodes

  !> Where the nodes of element number `element` end.
  pure function last_connection(draft, element) result(last)
    type(mesh_draft), intent(in) :: draft
    integer, intent(in) :: element
    integer :: last

    last = draft%connection%count
    if (element < draft%first%count) last = draft%first%item(element + 1) - 1
  end function last_connection

  !> Labels of the members of a set of elements from member `first` on; of ranges only those in the `table`.
  pure subroutine find_elements(table, from, first, labels, status)
    type(row_table), intent(in) :: table
    type(draft_set), intent(in) :: from
    integer, intent(in) :: first
    type(integer_list), intent(out) :: labels
    integer, intent(inout) :: status
    type(integer_list) :: found
    integer :: i, k

    do k = first, from%label%count
      if (from%line%item(k) /= GENERATED) then
        call labels%append(from%label%item(k), status)
        cycle
      end if
      call labels_in_range(table, from%label%item(k), from%face%item(k), from%file%item(k), found, status)
      do i = 1, found%count
        call labels%append(found%item(i), status)
      end do
    end do
  end subroutine find_elements

  !> The number of a face: S1 to S6, SPOS or SNEG.
  pure subroutine read_face(string, face, reason)
    character(len=*), intent(in) :: string
    integer, intent(out) :: face
    character(len=:), allocatable, intent(inout) :: reason

    face = 0
    if (upper_case(string) == 'SPOS') then
      face = FACE_SPOS
    else if (upper_case(string) == 'SNEG') then
      face = FACE_SNEG
    else if (scan(string(1:1), 'sS') == 0) then
      reason = quoted(string)//' is no face: S1 to S6, SPOS and SNEG are read'
    else
      call read_label(string(2:), 'face S', 1, 6, face, reason)
    end if
  end subroutine read_face

  !> A face of a surface: an element or a set of them, and Sn, SPOS or SNEG.
  pure subroutine read_surface_line(line, block, draft, reason)
    character(len=*), intent(in) :: line
    type(mesh_block), intent(in) :: block
    type(mesh_draft), intent(inout) :: draft
    character(len=:), allocatable, intent(out) :: reason
    integer :: face, face_first, face_last, first, k, label, last, other, separator

    k = begin_columns(line)
    call next_column(line, k, first, last, separator)
    call next_column(line, k, face_first, face_last, separator)
    if (face_first > face_last) then
      reason = 'the face of '//quoted(line(first:last))//' is missing: write its number, as in S1'
    else
      call read_face(line(face_first:face_last), face, reason)
    end if
    if (allocated(reason)) return
    if (.not. is_name(line(first:last))) then
      call read_label(line(first:last), 'element', 1, huge(1), label, reason)
      if (.not. allocated(reason)) call add_member(draft%surfaces, block, label, face, block%line, draft%status)
      return
    end if
    other = known_set(line(first:last), draft%element_sets)
    if (other == 0) then
      reason = 'the element set '//quoted(line(first:last))//' is not defined above'
      return
    end if
    call add_faces(other, face, block, draft)
  end subroutine read_surface_line

  !> Add a face of each element of a set to the surface of a block.
  pure subroutine add_faces(number, face, block, draft)
    integer, intent(in) :: number, face
    type(mesh_block), intent(in) :: block
    type(mesh_draft), intent(inout) :: draft
    type(integer_list) :: elements
    integer :: first, k

    associate (from => draft%element_sets%set(number))
      call draft%surfaces%set(block%set)%begin_taking(number, face, from%label%count, draft%elements%count, first, &
                                                      draft%status)
      call find_elements(draft%elements, from, first, elements, draft%status)
    end associate
    do k = 1, elements%count
      call add_member(draft%surfaces, block, elements%item(k), face, block%line, draft%status)
    end do
  end subroutine add_faces

end module fuge_mesh_lines
