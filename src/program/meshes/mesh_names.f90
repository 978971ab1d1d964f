!> What names on the command line mean: a surface, or nodes, of one of the bodies.
module mesh_names
  use command_line, only: refuse
  use fuge_core, only: fuge_info
  use fuge_files, only: fuge_mesh, fuge_mesh_faces
  use mesh_body, only: model_body
  use number_words, only: read_integer
  implicit none
  private

  public :: find_nodes, find_surface, upper_case

  !> What a name may be.
  integer, parameter :: NOTHING = 0, A_SURFACE = 1, A_NODE_SET = 2, A_NODE = 3

contains

  !> The body and the surface of body.SURFACE, or of SURFACE where one body only has it. `surface` is its index in
  !> mesh%surface.
  subroutine find_surface(word, source, bodies, body, surface, info)
    character(len=*), intent(in) :: word, source
    type(model_body), intent(in) :: bodies(:)
    integer, intent(out) :: body, surface
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: name
    integer :: kind

    call find_body(word, source, bodies, [A_SURFACE], 'surface', body, name, info)
    surface = 0
    if (.not. info%failed()) call find_in_mesh(bodies(body), name, [A_SURFACE], kind, surface)
  end subroutine find_surface

  !> The body of body.NODES, or of NODES where one body only has them, and the indices of the nodes in its mesh: those
  !> of a set or a surface, or that of the node with this number.
  subroutine find_nodes(word, source, bodies, body, nodes, info)
    character(len=*), intent(in) :: word, source
    type(model_body), intent(in) :: bodies(:)
    integer, intent(out) :: body
    integer, allocatable, intent(out) :: nodes(:)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: name
    integer :: at, kind

    call find_body(word, source, bodies, [A_NODE_SET, A_SURFACE, A_NODE], 'set of nodes', body, name, info)
    if (info%failed()) return
    call find_in_mesh(bodies(body), name, [A_NODE_SET, A_SURFACE, A_NODE], kind, at)
    select case (kind)
    case (A_NODE_SET)
      nodes = bodies(body)%mesh%node_set(at)%member
    case (A_SURFACE)
      call surface_nodes(bodies(body)%mesh, at, nodes, info)
    case default
      nodes = [at]
    end select
    if (info%failed()) return
    if (size(nodes) == 0) call refuse(source//': "'//word//'" is empty', info)
  end subroutine find_nodes

  !> The nodes of a surface, each once.
  subroutine surface_nodes(mesh, surface, nodes, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: surface
    integer, allocatable, intent(out) :: nodes(:)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: faces(:, :)
    logical, allocatable :: used(:)
    integer :: k

    call fuge_mesh_faces(mesh, trim(mesh%surface(surface)%name), faces, info)
    if (info%failed()) return
    allocate (used(0:size(mesh%node)), source=.false.)
    do k = 1, size(faces, 2)
      used(faces(:, k)) = .true.
    end do
    nodes = pack([(k, k=1, size(mesh%node))], used(1:))
  end subroutine surface_nodes

  !> The one body that has what `word` names, and the name without the body.
  subroutine find_body(word, source, bodies, kinds, what, body, name, info)
    character(len=*), intent(in) :: word, source, what
    type(model_body), intent(in) :: bodies(:)
    integer, intent(in) :: kinds(:)
    integer, intent(out) :: body
    character(len=:), allocatable, intent(out) :: name
    type(fuge_info), intent(inout) :: info
    integer :: at, k, kind, other, point

    name = word
    point = index(word, '.')
    body = 0
    do k = 1, size(bodies)
      if (point > 1 .and. upper_case(bodies(k)%name) == upper_case(word(:max(point - 1, 0)))) body = k
    end do
    if (body > 0) then
      name = word(point + 1:)
      call find_in_mesh(bodies(body), name, kinds, kind, at)
      if (kind == NOTHING .and. is_number(name)) then
        call refuse(source//': body '//bodies(body)%name//' has no node '//name, info)
      else if (kind == NOTHING) then
        call refuse_name(source//': body '//bodies(body)%name//' has no '//what//' "'//name//'"', bodies(body:body), &
                         what, info)
      end if
      return
    end if
    other = 0
    do k = 1, size(bodies)
      call find_in_mesh(bodies(k), name, kinds, kind, at)
      if (kind == NOTHING) cycle
      other = body
      body = k
      if (other > 0) exit
    end do
    if (other > 0) then
      call refuse(source//': bodies '//bodies(other)%name//' and '//bodies(body)%name//' both have "'//name &
                  //'": write '//bodies(body)%name//'.'//name//' or '//bodies(other)%name//'.'//name, info)
    else if (body == 0 .and. is_number(name)) then
      call refuse(source//': there is no node '//name, info)
    else if (body == 0) then
      call refuse_name(source//': there is no '//what//' "'//name//'"', bodies, what, info)
    end if
  end subroutine find_body

  pure function is_number(name)
    character(len=*), intent(in) :: name
    logical :: is_number
    integer :: number

    call read_integer(name, number, is_number)
  end function is_number

  !> Refuse a name, and list those that there are.
  subroutine refuse_name(reason, bodies, what, info)
    character(len=*), intent(in) :: reason, what
    type(model_body), intent(in) :: bodies(:)
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: list
    integer :: j, k

    list = ''
    do k = 1, size(bodies)
      if (what /= 'surface') then
        do j = 1, size(bodies(k)%mesh%node_set)
          list = list//', '//bodies(k)%name//'.'//trim(bodies(k)%mesh%node_set(j)%name)
        end do
      end if
      do j = 1, size(bodies(k)%mesh%surface)
        list = list//', '//bodies(k)%name//'.'//trim(bodies(k)%mesh%surface(j)%name)
      end do
    end do
    info%message = reason
    if (len(list) > 0) then
      call refuse(reason//'; there are '//list(3:), info)
      ! The list may be longer than a message.
      if (len(reason) + len(list) + 40 > len(info%message)) info%message(len(info%message) - 1:) = '..'
    else if (what == 'surface') then
      call refuse(reason//' and no other one: *SURFACE, TYPE=ELEMENT in the mesh makes one', info)
    else
      call refuse(reason//' and no other one: *NSET in the mesh makes one', info)
    end if
  end subroutine refuse_name

  !> What `name` is in a body, of the `kinds` allowed, in their order, and where it is in the mesh.
  subroutine find_in_mesh(body, name, kinds, kind, at)
    type(model_body), intent(in) :: body
    character(len=*), intent(in) :: name
    integer, intent(in) :: kinds(:)
    integer, intent(out) :: kind, at
    integer :: k, number
    logical :: valid

    at = 0
    do k = 1, size(kinds)
      kind = kinds(k)
      select case (kind)
      case (A_SURFACE)
        do at = size(body%mesh%surface), 1, -1
          if (body%mesh%surface(at)%name == upper_case(name)) exit
        end do
      case (A_NODE_SET)
        do at = size(body%mesh%node_set), 1, -1
          if (body%mesh%node_set(at)%name == upper_case(name)) exit
        end do
      case default
        call read_integer(name, number, valid)
        if (valid) at = body%nodes%find(number)
      end select
      if (at > 0) return
    end do
    kind = NOTHING
  end subroutine find_in_mesh

  pure function upper_case(word) result(upper)
    character(len=*), intent(in) :: word
    character(len=len(word)) :: upper
    integer :: k

    upper = word
    do k = 1, len(word)
      if (word(k:k) >= 'a' .and. word(k:k) <= 'z') upper(k:k) = achar(iachar(word(k:k)) - 32)
    end do
  end function upper_case

end module mesh_names
