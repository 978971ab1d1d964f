!> A mesh while its file is read: labels as the file has them, with the lines where they stand, until all are known.
module fuge_mesh_draft
  use fuge_draft_sets, only: draft_set, draft_sets, labels_in_range, GENERATED
  use fuge_element_faces, only: is_shell
  use fuge_growing_arrays, only: make_room
  use fuge_integer_list, only: integer_list
  use fuge_kinds, only: dp
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_set
  use fuge_name_table, only: name_table
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_FILE
  implicit none
  private

  public :: finish_mesh

  !> Instead of the number of a face: SNEG and SPOS of shells; the numbers 1 and 2 in the mesh.
  integer, parameter, public :: FACE_SNEG = -1, FACE_SPOS = -2

  !> A mesh in labels.
  type, public :: mesh_draft
    type(row_table) :: nodes, elements
    real(dp), allocatable :: position(:, :)
    !> For each element its type, an index in `types`, its line and file, and where its nodes begin in `connection`.
    type(integer_list) :: element_type, element_line, element_file, first, connection
    type(name_table) :: types
    type(draft_sets) :: node_sets, element_sets, surfaces
    !> Names of the files, for messages, and the number of the last one.
    type(name_table) :: files
    integer, private :: last_file = 0
    integer :: status = 0
  contains
    procedure :: add_node
    procedure :: file_number
  end type mesh_draft

contains

  !> Add a node; `is_new` is false if there is one with its label, and then nothing changes.
  pure subroutine add_node(self, label, position, is_new)
    class(mesh_draft), intent(inout) :: self
    integer, intent(in) :: label
    real(dp), intent(in) :: position(3)
    logical, intent(out) :: is_new
    integer :: number, nodes

    nodes = self%nodes%count
    call self%nodes%number_of(label, 0, number, self%status)
    is_new = number > nodes
    if (self%status /= 0 .or. .not. is_new) return
    if (.not. allocated(self%position)) allocate (self%position(3, 0), stat=self%status)
    call make_room(self%position, nodes, self%status)
    if (self%status == 0) self%position(:, number) = position
  end subroutine add_node

  !> The number of a file, a new one if it is new; without memory `status` is set.
  pure subroutine file_number(self, name, number)
    class(mesh_draft), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(out) :: number

    number = self%last_file
    if (number > 0) then
      if (self%files%name(number) == name) return
    end if
    call self%files%number_of(name, number, self%status)
    self%last_file = number
  end subroutine file_number

  !> The mesh with indices instead of labels. Errors: FUGE_ERR_FILE with the line of a label that is not defined;
  !> FUGE_ERR_MEMORY.
  pure subroutine finish_mesh(draft, mesh, info)
    type(mesh_draft), intent(inout) :: draft
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    integer :: k, status

    call finish_nodes(draft, mesh, status)
    if (status == 0) call finish_elements(draft, mesh, info, status)
    if (info%failed()) return
    if (status == 0) allocate (mesh%node_set(draft%node_sets%count()), mesh%element_set(draft%element_sets%count()), &
                               mesh%surface(draft%surfaces%count()), stat=status)
    if (status == 0) then
      call finish_sets(draft, draft%nodes, draft%node_sets, 'node', mesh%node_set, info, status)
      call finish_sets(draft, draft%elements, draft%element_sets, 'element', mesh%element_set, info, status)
      do k = 1, draft%surfaces%count()
        call finish_surface(draft, k, mesh, info, status)
      end do
    end if
    if (.not. info%failed()) call require_memory(status, 'the mesh', info)
  end subroutine finish_mesh

  pure subroutine finish_nodes(draft, mesh, status)
    type(mesh_draft), intent(inout) :: draft
    type(fuge_mesh), intent(inout) :: mesh
    integer, intent(out) :: status

    associate (n => draft%nodes%count)
      allocate (mesh%node(n), mesh%position(3, n), stat=status)
      if (status /= 0 .or. n == 0) return
      mesh%node = draft%nodes%node(:n)
      mesh%position = draft%position(:, :n)
    end associate
  end subroutine finish_nodes

  pure subroutine finish_elements(draft, mesh, info, status)
    type(mesh_draft), intent(inout) :: draft
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    integer, intent(out) :: status
    integer :: e, k

    associate (n => draft%elements%count, all_nodes => draft%connection%count)
      allocate (mesh%element(n), mesh%element_type(n), mesh%first(n + 1), mesh%connection(all_nodes), stat=status)
      if (status /= 0) return
      mesh%first(n + 1) = all_nodes + 1
      do e = 1, n
        mesh%element(e) = draft%elements%node(e)
        mesh%element_type(e) = trim(draft%types%name(draft%element_type%item(e)))
        mesh%first(e) = draft%first%item(e)
      end do
      do e = 1, n
        do k = mesh%first(e), mesh%first(e + 1) - 1
          mesh%connection(k) = draft%nodes%find(draft%connection%item(k), 0)
          if (mesh%connection(k) > 0) cycle
          call undefined(draft, draft%element_file%item(e), draft%element_line%item(e), 'node', &
                         draft%connection%item(k), ' of element '//text(mesh%element(e)), info)
          return
        end do
      end do
    end associate
  end subroutine finish_elements

  !> Report a label that no line defines (FUGE_ERR_FILE).
  pure subroutine undefined(draft, file, line, what, label, owner, info)
    type(mesh_draft), intent(in) :: draft
    integer, intent(in) :: file, line, label
    character(len=*), intent(in) :: what, owner
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_FILE, trim(draft%files%name(file))//', line '//text(line)//': '//what//' '//text(label) &
                //owner//' is not defined in any file')
  end subroutine undefined

  !> Indices of the members of each set, each once.
  pure subroutine finish_sets(draft, table, drafts, what, sets, info, status)
    type(mesh_draft), intent(in) :: draft
    type(row_table), intent(in) :: table
    type(draft_sets), intent(in) :: drafts
    character(len=*), intent(in) :: what
    type(fuge_mesh_set), intent(inout) :: sets(:)
    type(fuge_info), intent(inout) :: info
    integer, intent(inout) :: status
    integer, allocatable :: owner(:)
    integer :: k

    if (status /= 0 .or. info%failed()) return
    allocate (owner(table%count), stat=status)
    if (status /= 0) return
    owner = 0
    do k = 1, drafts%count()
      call finish_set(draft, table, drafts%set(k), what, k, owner, sets(k), info, status)
      if (status /= 0 .or. info%failed()) return
    end do
  end subroutine finish_sets

  !> Indices of the members of set k; `owner` is k where a member is in it already. The arguments are nine, because the
  !> work space of all sets is the caller's.
  pure subroutine finish_set(draft, table, from, what, k, owner, set, info, status)
    type(mesh_draft), intent(in) :: draft
    type(row_table), intent(in) :: table
    type(draft_set), intent(in) :: from
    character(len=*), intent(in) :: what
    integer, intent(in) :: k
    integer, intent(inout) :: owner(:)
    type(fuge_mesh_set), intent(inout) :: set
    type(fuge_info), intent(inout) :: info
    integer, intent(inout) :: status
    type(integer_list) :: labels, member
    integer :: i, j, member_index

    set%name = from%name
    do i = 1, from%label%count
      if (from%line%item(i) == GENERATED) then
        call labels_in_range(table, from%label%item(i), from%face%item(i), from%file%item(i), labels, status)
        do j = 1, labels%count
          call take_member(table%find(labels%item(j), 0), k, owner, member, status)
        end do
        cycle
      end if
      member_index = table%find(from%label%item(i), 0)
      if (member_index > 0) then
        call take_member(member_index, k, owner, member, status)
      else
        call undefined(draft, from%file%item(i), from%line%item(i), what, from%label%item(i), ' of the set ' &
                       //trim(from%name), info)
        return
      end if
    end do
    if (status == 0) allocate (set%member(member%count), stat=status)
    if (status == 0 .and. member%count > 0) set%member = member%item(:member%count)
  end subroutine finish_set

  !> Add a member to set k unless it is in it.
  pure subroutine take_member(member_index, k, owner, member, status)
    integer, intent(in) :: member_index, k
    integer, intent(inout) :: owner(:), status
    type(integer_list), intent(inout) :: member

    if (owner(member_index) == k) return
    owner(member_index) = k
    call member%append(member_index, status)
  end subroutine take_member

  !> Indices of the elements of the faces of surface k.
  pure subroutine finish_surface(draft, k, mesh, info, status)
    type(mesh_draft), intent(in) :: draft
    integer, intent(in) :: k
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    integer, intent(inout) :: status
    integer :: i, n

    if (status /= 0 .or. info%failed()) return
    n = draft%surfaces%set(k)%label%count
    mesh%surface(k)%name = draft%surfaces%set(k)%name
    allocate (mesh%surface(k)%element(n), mesh%surface(k)%face(n), stat=status)
    if (status /= 0) return
    do i = 1, n
      associate (from => draft%surfaces%set(k), element => mesh%surface(k)%element(i))
        mesh%surface(k)%face(i) = from%face%item(i)
        element = draft%elements%find(from%label%item(i), 0)
        if (element == 0) then
          call undefined(draft, from%file%item(i), from%line%item(i), 'element', from%label%item(i), &
                         ' of the surface '//trim(from%name), info)
        else if (from%face%item(i) < 0) then
          call name_shell_face(draft, from%file%item(i), from%line%item(i), mesh, k, i, info)
        end if
        if (info%failed()) return
      end associate
    end do
  end subroutine finish_surface

  !> The number of face i of surface k, SNEG or SPOS in a line of a file; refused if its element is no shell.
  pure subroutine name_shell_face(draft, file, line, mesh, k, i, info)
    type(mesh_draft), intent(in) :: draft
    integer, intent(in) :: file, line, k, i
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    integer :: element

    element = mesh%surface(k)%element(i)
    if (is_shell(mesh%element_type(element))) then
      mesh%surface(k)%face(i) = -mesh%surface(k)%face(i)
    else
      call report(info, FUGE_ERR_FILE, trim(draft%files%name(file))//', line '//text(line)//': element ' &
                  //text(mesh%element(element))//' of type '//trim(mesh%element_type(element)) &
                  //' has no faces SPOS and SNEG, which shells have')
    end if
  end subroutine name_shell_face

end module fuge_mesh_draft
