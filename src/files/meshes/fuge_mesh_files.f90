!> Meshes from input files of Abaqus and CalculiX: what both programs have in common.
module fuge_mesh_files
  use fuge_element_faces, only: nodes_of_type
  use fuge_input_deck, only: input_deck, upper_case, LINE_DATA, LINE_END, LINE_KEYWORD, VALUE_LENGTH
  use fuge_mesh_lines, only: add_element_nodes, mesh_block, read_element_line, read_node_line, read_set_line, &
    read_surface_line
  use fuge_mesh_type, only: fuge_mesh, move_mesh, move_text, NAME_LENGTH, TYPE_LENGTH
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_text_numbers, only: quoted
  implicit none
  private

  public :: fuge_read_mesh

  !> What the data lines under a keyword are.
  integer, parameter :: DATA_SKIPPED = 0, DATA_NODES = 1, DATA_ELEMENTS = 2, DATA_NODE_SET = 3, DATA_ELEMENT_SET = 4, &
    DATA_SURFACE = 5
  !> Keywords that make or move nodes and elements in ways that are not read: without them the mesh would be another
  !> one.
  character(len=8), parameter :: REFUSED(9) = [character(len=8) :: 'PART', 'INSTANCE', 'NGEN', 'NFILL', 'NCOPY', &
    'NMAP', 'ELGEN', 'ELCOPY', 'SYSTEM']

contains

  !> Read nodes, elements, sets and surfaces from an input file of Abaqus or CalculiX.
  !>
  !> Read are *NODE (NSET), *ELEMENT (TYPE, ELSET), *NSET (GENERATE, ELSET), *ELSET (GENERATE), *SURFACE of elements
  !> (faces S1 to S6, SPOS, SNEG) or of nodes, which becomes a set of nodes, and *INCLUDE; other keywords are skipped
  !> with their data, *TRANSFORM too, although the directions at its nodes may be turned. Words may be in
  !> upper or lower case, names are returned in upper case. A label of GENERATE that does not exist is left out.
  !> Errors, `mesh` unchanged: FUGE_ERR_FILE with file, line and reason, also for *PART, *INSTANCE, *NGEN and other
  !> keywords without which the mesh would be another one, and if there is no node; FUGE_ERR_MEMORY.
  subroutine fuge_read_mesh(path, mesh, info)
    use fuge_mesh_draft, only: finish_mesh, mesh_draft
    character(len=*), intent(in) :: path
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(out) :: info
    type(input_deck) :: deck
    type(mesh_draft) :: draft
    type(fuge_mesh) :: found

    call deck%open(path, info)
    if (.not. info%failed()) call read_deck(deck, draft, info)
    if (info%failed()) return
    if (draft%nodes%count == 0) then
      call report(info, FUGE_ERR_FILE, deck%file(1)%name//' has no *NODE: is it an input file of Abaqus or CalculiX?')
      return
    end if
    call finish_mesh(draft, found, info)
    if (info%failed()) return
    call move_text(deck%paths, found%paths)
    call move_mesh(found, mesh)
  end subroutine fuge_read_mesh

  !> Read all lines.
  subroutine read_deck(deck, draft, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(inout) :: deck
    type(mesh_draft), intent(inout) :: draft
    type(fuge_info), intent(inout) :: info
    type(mesh_block) :: block
    character(len=:), allocatable :: reason
    integer :: content, line_kind

    content = DATA_SKIPPED
    do
      call deck%next(line_kind, info)
      if (info%failed()) return
      if (line_kind /= LINE_DATA) then
        call check_last_element(deck, draft, block, info)
        if (info%failed() .or. line_kind == LINE_END) return
      end if
      if (line_kind == LINE_KEYWORD) then
        call begin_block(deck, draft, block, content, info)
      else if (content /= DATA_SKIPPED) then
        call draft%file_number(deck%file(deck%depth)%name, block%file)
        block%line = deck%file(deck%depth)%line
        if (draft%status == 0) call read_data(deck%file(deck%depth)%content( &
          deck%file(deck%depth)%first:deck%file(deck%depth)%last), content, draft, block, reason)
        if (allocated(reason)) call deck%refuse(reason, info)
      end if
      if (draft%status /= 0 .and. .not. info%failed()) &
        call report(info, FUGE_ERR_MEMORY, deck%file(1)%name//': no memory for the mesh')
      if (info%failed()) return
    end do
  end subroutine read_deck

  pure subroutine read_data(line, content, draft, block, reason)
    use fuge_mesh_draft, only: mesh_draft
    character(len=*), intent(in) :: line
    integer, intent(in) :: content
    type(mesh_draft), intent(inout) :: draft
    type(mesh_block), intent(inout) :: block
    character(len=:), allocatable, intent(out) :: reason

    select case (content)
    case (DATA_NODES)
      call read_node_line(line, block, draft, reason)
    case (DATA_ELEMENTS)
      call read_element_line(line, block, draft, reason)
    case (DATA_NODE_SET)
      call read_set_line(line, 'node', block, draft%node_sets, draft%status, reason)
    case (DATA_ELEMENT_SET)
      call read_set_line(line, 'element', block, draft%element_sets, draft%status, reason)
    case (DATA_SURFACE)
      call read_surface_line(line, block, draft, reason)
    end select
  end subroutine read_data

  !> Refuse an element with fewer nodes than its type has, where the lines of elements end.
  pure subroutine check_last_element(deck, draft, block, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(in) :: deck
    type(mesh_draft), intent(in) :: draft
    type(mesh_block), intent(in) :: block
    type(fuge_info), intent(inout) :: info

    if (block%missing == 0) return
    call deck%refuse('element '//text(draft%elements%node(draft%elements%count))//' above has '//text(block%missing) &
                     //' nodes less than the '//text(block%nodes)//' of its type ' &
                     //trim(draft%types%name(block%element_type)), info)
  end subroutine check_last_element

  !> Find what the data lines under a keyword are, `content`, and where they belong, `block`.
  subroutine begin_block(deck, draft, block, content, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(inout) :: deck
    type(mesh_draft), intent(inout) :: draft
    type(mesh_block), intent(out) :: block
    integer, intent(out) :: content
    type(fuge_info), intent(inout) :: info
    character(len=VALUE_LENGTH) :: set_type

    content = DATA_SKIPPED
    if (deck%keyword == 'NODE') then
      content = DATA_NODES
      set_type = upper_case(deck%parameter('SYSTEM'))
      if (set_type /= '' .and. set_type /= 'R') call deck%refuse('SYSTEM = '//trim(set_type)//' is not read: write ' &
                                                                 //'rectangular coordinates', info)
      call choose_set(deck, 'NSET', .false., draft%node_sets, block, draft%status, info)
    else if (deck%keyword == 'ELEMENT') then
      content = DATA_ELEMENTS
      call choose_type(deck, draft, block, info)
      call choose_set(deck, 'ELSET', .false., draft%element_sets, block, draft%status, info)
    else if (deck%keyword == 'NSET') then
      content = DATA_NODE_SET
      call choose_set(deck, 'NSET', .true., draft%node_sets, block, draft%status, info)
      if (deck%has('ELSET') .and. .not. info%failed()) call begin_nodes_of_elements(deck, draft, block, info)
    else if (deck%keyword == 'ELSET') then
      content = DATA_ELEMENT_SET
      call choose_set(deck, 'ELSET', .true., draft%element_sets, block, draft%status, info)
    else if (deck%keyword == 'SURFACE') then
      call begin_surface(deck, draft, block, content, info)
    else if (deck%keyword == 'INCLUDE') then
      call deck%include(trim(deck%parameter('INPUT')), info)
      return
    else if (any(deck%keyword == REFUSED)) then
      call deck%refuse('*'//trim(deck%keyword)//' is not read, and without it the mesh would be another one: write a ' &
                       //'file that lists all nodes and elements', info)
    end if
    block%generate = deck%has('GENERATE')
    if (content /= DATA_SKIPPED .and. deck%has('INPUT')) &
      call deck%refuse('INPUT = is not read here: use *INCLUDE', info)
  end subroutine begin_block

  !> The set of nodes of a keyword line consists of the nodes of elements above.
  subroutine begin_nodes_of_elements(deck, draft, block, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(inout) :: deck
    type(mesh_draft), intent(inout) :: draft
    type(mesh_block), intent(inout) :: block
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: reason

    if (draft%status == 0) call draft%file_number(deck%file(deck%depth)%name, block%file)
    block%line = deck%file(deck%depth)%line
    if (draft%status == 0) call add_element_nodes(trim(upper_case(deck%parameter('ELSET'))), block, draft, reason)
    if (allocated(reason)) call deck%refuse(reason, info)
  end subroutine begin_nodes_of_elements

  !> The surface of a keyword line: of faces, or of nodes.
  subroutine begin_surface(deck, draft, block, content, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(inout) :: deck
    type(mesh_draft), intent(inout) :: draft
    type(mesh_block), intent(inout) :: block
    integer, intent(out) :: content
    type(fuge_info), intent(inout) :: info
    character(len=VALUE_LENGTH) :: surface_type

    surface_type = upper_case(deck%parameter('TYPE'))
    content = DATA_SKIPPED
    if (surface_type == 'NODE') then
      content = DATA_NODE_SET
      call choose_set(deck, 'NAME', .true., draft%node_sets, block, draft%status, info)
    else if (surface_type == '' .or. surface_type == 'ELEMENT') then
      content = DATA_SURFACE
      call choose_set(deck, 'NAME', .true., draft%surfaces, block, draft%status, info)
    end if
  end subroutine begin_surface

  !> The set that a parameter names; refused without it if it is `needed`.
  subroutine choose_set(deck, name, needed, sets, block, status, info)
    use fuge_draft_sets, only: draft_sets
    type(input_deck), intent(inout) :: deck
    character(len=*), intent(in) :: name
    logical, intent(in) :: needed
    type(draft_sets), intent(inout) :: sets
    type(mesh_block), intent(inout) :: block
    integer, intent(inout) :: status
    type(fuge_info), intent(inout) :: info
    character(len=VALUE_LENGTH) :: set_name

    if (info%failed()) return
    set_name = upper_case(deck%parameter(name))
    if (set_name == '') then
      if (needed) call deck%refuse('*'//trim(deck%keyword)//' needs '//name//' = and a name', info)
    else if (len_trim(set_name) > NAME_LENGTH) then
      call deck%refuse('the name '//quoted(trim(set_name))//' has more than '//text(NAME_LENGTH)//' characters', info)
    else
      call sets%named(trim(set_name), block%set, status)
    end if
  end subroutine choose_set

  subroutine choose_type(deck, draft, block, info)
    use fuge_mesh_draft, only: mesh_draft
    type(input_deck), intent(inout) :: deck
    type(mesh_draft), intent(inout) :: draft
    type(mesh_block), intent(inout) :: block
    type(fuge_info), intent(inout) :: info
    character(len=VALUE_LENGTH) :: element_type

    element_type = upper_case(deck%parameter('TYPE'))
    if (element_type == '' .or. len_trim(element_type) > TYPE_LENGTH) then
      call deck%refuse('*ELEMENT needs TYPE = and a type of at most '//text(TYPE_LENGTH)//' characters', info)
    else
      call draft%types%number_of(trim(element_type), block%element_type, draft%status)
      block%nodes = nodes_of_type(trim(element_type))
    end if
  end subroutine choose_type

end module fuge_mesh_files
