!> Pairs of surfaces as the options name them.
module mesh_pairs
  use command_line, only: arguments, refuse
  use fuge_core, only: dp => fuge_dp, fuge_info
  use fuge_fe, only: fuge_contact_pairs, fuge_pair_options, fuge_surface_mesh, fuge_surface_pair, FUGE_NODE_TO_FACE, &
    FUGE_NORMALS_AVERAGED, FUGE_NORMALS_GIVEN, FUGE_NORMALS_OPPOSITE
  use fuge_files, only: fuge_mesh_faces
  use mesh_body, only: model_body, refuse_memory
  use mesh_names, only: find_surface
  use number_words, only: number_text, read_real
  implicit none
  private

  public :: find_pairs, mesh_node

  !> The options that belong to a pair.
  character(len=12), parameter :: OF_PAIRS(8) = [character(len=12) :: 'clearance', 'crease', 'faceted', &
    'node-to-face', 'normals', 'play', 'reach', 'tied']

  !> A pair of surfaces: of which bodies, and what is between them.
  type, public :: model_pair
    !> Contact and opposite surface as the option names them.
    character(len=:), allocatable :: name
    !> Their bodies, rigid ones too, and their indices in the meshes.
    integer :: body(2) = 0, surface(2) = 0
    type(fuge_pair_options) :: options
    !> One normal for all nodes, if the options give it.
    real(dp) :: normal(3) = 0.0_dp
    !> How many components it has.
    integer :: components = 0
    !> Added to the gaps.
    real(dp) :: clearance = 0.0_dp
    type(fuge_surface_pair) :: surfaces
    !> The axis of each degree of freedom of all bodies that belongs to the contact surface, 0 for the others; if that
    !> is rigid, of the opposite surface, negative.
    integer, allocatable, private :: axis(:)
  contains
    procedure :: action
    procedure :: set_axes
  end type model_pair

contains

  !> All pairs with their surfaces.
  subroutine find_pairs(given, bodies, pairs, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), allocatable, intent(out) :: pairs(:)
    type(fuge_info), intent(inout) :: info
    type(model_pair) :: common
    integer :: count, k

    count = 0
    do k = 1, given%count
      if (given%settings(k)%name == 'pair') count = count + 1
    end do
    allocate (pairs(count))
    count = 0
    do k = 1, given%count
      if (given%settings(k)%name == 'pair') then
        count = count + 1
        pairs(count)%options = common%options
        pairs(count)%normal = common%normal
        pairs(count)%components = common%components
        pairs(count)%clearance = common%clearance
        call name_pair(given%settings(k)%value, given%settings(k)%source, bodies, pairs(count), info)
      else if (count == 0) then
        call take_option(given, k, common, info)
      else
        call take_option(given, k, pairs(count), info)
      end if
      if (info%failed()) return
    end do
    do k = 1, count
      call make_surfaces(bodies, pairs(k), info)
      if (info%failed()) return
    end do
  end subroutine find_pairs

  !> CONTACT:OPPOSITE.
  subroutine name_pair(word, source, bodies, pair, info)
    character(len=*), intent(in) :: word, source
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(inout) :: pair
    type(fuge_info), intent(inout) :: info
    integer :: colon

    colon = index(word, ':')
    if (colon < 2 .or. colon == len(word)) then
      call refuse(source//': two surfaces are needed, like shaft.OUTER:hub.BORE', info)
      return
    end if
    pair%name = word
    call find_surface(word(:colon - 1), source, bodies, pair%body(1), pair%surface(1), info)
    if (.not. info%failed()) call find_surface(word(colon + 1:), source, bodies, pair%body(2), pair%surface(2), info)
    if (info%failed()) return
    if (all(bodies(pair%body)%elastic == 0)) call refuse(source//': both bodies are rigid: --stiffness is needed', info)
  end subroutine name_pair

  !> An option of a pair; others are skipped.
  subroutine take_option(given, k, pair, info)
    type(arguments), intent(in) :: given
    integer, intent(in) :: k
    type(model_pair), intent(inout) :: pair
    type(fuge_info), intent(inout) :: info

    if (is_repeated(given, k)) then
      call refuse(given%settings(k)%source//': the pair has one already', info)
      return
    end if
    select case (given%settings(k)%name)
    case ('tied')
      pair%options%tied = .true.
    case ('faceted')
      pair%options%smooth = .false.
    case ('node-to-face')
      pair%options%method = FUGE_NODE_TO_FACE
    case ('play')
      call given%number(k, pair%options%play, info)
      if (pair%options%play < 0.0_dp) call refuse(given%settings(k)%source//': a play is not negative', info)
    case ('reach')
      call given%number(k, pair%options%reach, info)
      if (.not. pair%options%reach > 0.0_dp .and. .not. info%failed()) &
        call refuse(given%settings(k)%source//': a length above 0 is needed', info)
    case ('clearance')
      call given%number(k, pair%clearance, info)
    case ('crease')
      call given%number(k, pair%options%crease, info)
      if (pair%options%crease < 0.0_dp .or. pair%options%crease > 90.0_dp) &
        call refuse(given%settings(k)%source//': an angle from 0 to 90 degrees is needed', info)
    case ('normals')
      call take_normals(given%settings(k)%value, given%settings(k)%source, pair, info)
    end select
  end subroutine take_option

  !> Has an option of a pair been given before, after the --pair to which it belongs?
  pure function is_repeated(given, k)
    type(arguments), intent(in) :: given
    integer, intent(in) :: k
    logical :: is_repeated
    integer :: j

    is_repeated = .false.
    if (all(given%settings(k)%name /= OF_PAIRS)) return
    do j = k - 1, 1, -1
      if (given%settings(j)%name == 'pair' .or. is_repeated) exit
      is_repeated = given%settings(j)%name == given%settings(k)%name
    end do
  end function is_repeated

  !> averaged, opposite, or a direction of two or three numbers.
  subroutine take_normals(word, source, pair, info)
    character(len=*), intent(in) :: word, source
    type(model_pair), intent(inout) :: pair
    type(fuge_info), intent(inout) :: info
    integer :: begin, k, length
    logical :: valid

    if (word == 'averaged') then
      pair%options%normals = FUGE_NORMALS_AVERAGED
    else if (word == 'opposite') then
      pair%options%normals = FUGE_NORMALS_OPPOSITE
    else
      pair%options%normals = FUGE_NORMALS_GIVEN
      pair%normal = 0.0_dp
      begin = 1
      valid = .true.
      do k = 1, 3
        if (.not. valid .or. begin > len(word)) exit
        length = index(word(begin:)//',', ',') - 1
        call read_real(word(begin:begin + length - 1), pair%normal(k), valid)
        pair%components = k
        begin = begin + length + 1
      end do
      if (.not. valid .or. begin <= len(word) .or. .not. any(abs(pair%normal) > 0.0_dp)) &
        call refuse(source//': averaged, opposite, or a direction like 0,0,1 is needed', info)
    end if
  end subroutine take_normals

  !> What the library needs of a pair.
  subroutine make_surfaces(bodies, pair, info)
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(inout) :: pair
    type(fuge_info), intent(inout) :: info
    integer :: dimensions(2)

    pair%surfaces%contact_body = bodies(pair%body(1))%elastic
    pair%surfaces%opposite_body = bodies(pair%body(2))%elastic
    call make_surface(bodies(pair%body(1)), pair%surface(1), pair%name, pair%surfaces%contact, dimensions(1), info)
    if (.not. info%failed()) call make_surface(bodies(pair%body(2)), pair%surface(2), pair%name, &
                                               pair%surfaces%opposite, dimensions(2), info)
    if (info%failed()) return
    if (dimensions(1) /= dimensions(2)) then
      call refuse('--pair '//pair%name//': one surface is of solids, the other one of elements of a plane', info)
      return
    end if
    if (pair%options%normals == FUGE_NORMALS_GIVEN .and. pair%components /= dimensions(1)) then
      call refuse('--pair '//pair%name//': --normals needs one number for each axis, '//number_text(dimensions(1)) &
                  //' in all', info)
      return
    end if
    pair%options%revolution = is_ring(bodies(pair%body(1)), pair%surface(1)) &
                              .or. is_ring(bodies(pair%body(2)), pair%surface(2))
    pair%surfaces%options = pair%options
    if (pair%options%normals == FUGE_NORMALS_GIVEN) &
      pair%surfaces%options%normal = spread(pair%normal(:dimensions(1)), 2, size(pair%surfaces%contact%node, 2))
  end subroutine make_surfaces

  !> Is a surface that of a body of revolution?
  pure function is_ring(body, which)
    type(model_body), intent(in) :: body
    integer, intent(in) :: which
    logical :: is_ring

    is_ring = index(body%mesh%element_type(body%mesh%surface(which)%element(1)), 'CAX') == 1
  end function is_ring

  !> Note the axes; `first`: degrees of freedom before those of each elastic body.
  pure subroutine set_axes(self, first)
    class(model_pair), intent(inout) :: self
    integer, intent(in) :: first(:)

    allocate (self%axis(first(size(first))), source=0)
    if (allocated(self%surfaces%contact%dof)) then
      call mark(self%surfaces%contact%dof, first(self%surfaces%contact_body), 1, self%axis)
    else
      call mark(self%surfaces%opposite%dof, first(self%surfaces%opposite_body), -1, self%axis)
    end if
  end subroutine set_axes

  pure subroutine mark(dof, before, sign, axes)
    integer, intent(in) :: dof(:, :), before, sign
    integer, intent(inout) :: axes(:)
    integer :: axis, i

    do i = 1, size(dof, 2)
      do axis = 1, size(dof, 1)
        if (dof(axis, i) > 0) axes(before + dof(axis, i)) = sign*axis
      end do
    end do
  end subroutine mark

  !> The resultant on the contact body of a force of 1 at a contact point; on bent surfaces the force is spread along
  !> several normals. Along an axis that the stiffness lacks it is that of the direction of the gap.
  pure function action(self, pairs, i) result(resultant)
    class(model_pair), intent(in) :: self
    type(fuge_contact_pairs), intent(in) :: pairs
    integer, intent(in) :: i
    real(dp) :: resultant(3)
    integer :: axis, k

    resultant = 0.0_dp
    do k = 1, size(pairs%dof, 1)
      if (pairs%dof(k, i) == 0) cycle
      axis = self%axis(pairs%dof(k, i))
      if (axis /= 0) resultant(abs(axis)) = resultant(abs(axis)) + sign(1, axis)*pairs%normal(k, i)
    end do
    if (.not. allocated(self%surfaces%contact%dof)) return
    do axis = 1, size(pairs%direction, 1)
      if (self%surfaces%contact%dof(axis, pairs%node(i)) == 0) resultant(axis) = -pairs%direction(axis, i)
    end do
  end function action

  !> One surface: faces, positions and rows of its nodes. `pair` is what messages call the pair.
  subroutine make_surface(body, which, pair, surface, dimensions, info)
    type(model_body), intent(in) :: body
    integer, intent(in) :: which
    character(len=*), intent(in) :: pair
    type(fuge_surface_mesh), intent(inout) :: surface
    integer, intent(out) :: dimensions
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: faces(:, :)
    integer :: at, i, k, nodes, status

    dimensions = 2
    associate (mesh => body%mesh)
      if (size(mesh%surface(which)%element) == 0) then
        call refuse('--pair '//pair//': surface '//body%name//'.'//trim(mesh%surface(which)%name)//' has no faces', &
                    info)
        return
      end if
      if (index(mesh%element_type(mesh%surface(which)%element(1)), 'C3D') == 1) dimensions = 3
      call fuge_mesh_faces(mesh, trim(mesh%surface(which)%name), faces, info)
      if (info%failed()) return
      nodes = size(mesh%node)
      if (body%keeps_numbers) nodes = maxval(mesh%node)
      allocate (surface%node(dimensions, nodes), source=0.0_dp, stat=status)
      if (status == 0 .and. body%elastic > 0) allocate (surface%dof(dimensions, nodes), source=0, stat=status)
      if (status /= 0) then
        call refuse_memory('the surfaces of --pair '//pair, info)
        return
      end if
      surface%face = faces(:maxval(count(faces > 0, 1)), :)
      do k = 1, size(surface%face, 2)
        do i = 1, size(surface%face, 1)
          if (surface%face(i, k) == 0) exit
          at = surface_index(body, surface%face(i, k))
          surface%node(:, at) = mesh%position(:dimensions, surface%face(i, k))
          if (body%elastic > 0) surface%dof(:, at) = body%row(:dimensions, surface%face(i, k))
          surface%face(i, k) = at
        end do
      end do
    end associate
    if (body%elastic == 0) return
    if (all(surface%dof == 0)) call refuse('--pair '//pair//': no node of the surface of body '//body%name &
                                           //' has a row in its stiffness: are they of the same model?', info)
  end subroutine make_surface

  !> Where a node of the mesh is in the arrays of a surface: at its number, so that messages name it as the file does.
  pure function surface_index(body, node) result(at)
    type(model_body), intent(in) :: body
    integer, intent(in) :: node
    integer :: at

    at = node
    if (body%keeps_numbers) at = body%mesh%node(node)
  end function surface_index

  !> The node of the mesh at an index of the arrays of a surface.
  pure function mesh_node(body, at) result(node)
    type(model_body), intent(in) :: body
    integer, intent(in) :: at
    integer :: node

    node = at
    if (body%keeps_numbers) node = body%nodes%find(at)
  end function mesh_node

end module mesh_pairs
