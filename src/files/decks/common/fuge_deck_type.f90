!> What the decks of finite element programs say beside the stiffness matrix: one-way links between nodes, and load
!> cases with their supports.
module fuge_deck_type
  use fuge_constants, only: NAME_LENGTH
  use fuge_kinds, only: dp
  use fuge_mesh_type, only: move_text
  use fuge_number_text, only: text
  use fuge_path_list, only: count_paths, get_path
  use fuge_text_reader, only: quoted_path
  implicit none
  private

  public :: move_deck, new_link, place_text, NAME_LENGTH

  !> A one-way link: a gap, a support, a strut or a cable between two nodes, or between a node and the ground.
  !>
  !> It opens by direction . (u_b - u_a), where the ground does not move: its gap c is `gap` plus that, and its force f
  !> >= 0 acts on node b along `direction`, on node a against it. A strut has the direction from a to b, a cable that
  !> from b to a. The law of the force is that of a contact point (`fuge_problem`).
  type, public :: fuge_deck_link
    !> Card and number, such as CGAP 12.
    character(len=NAME_LENGTH) :: name = ''
    !> Numbers of the nodes in the file; 0: the ground.
    integer :: node_a = 0, node_b = 0
    !> Unit vector along x, y, z.
    real(dp) :: direction(3) = 0.0_dp
    !> Gap without load, length; negative: an interference.
    real(dp) :: gap = 0.0_dp
    !> Distance of a second stop, length; huge(1.0_dp) or infinity: none.
    real(dp) :: play = huge(1.0_dp)
    !> Of the link itself, length per force; 0: rigid.
    real(dp) :: compliance = 0.0_dp
    !> Limit of the force; huge(1.0_dp) or infinity: none.
    real(dp) :: limit = huge(1.0_dp)
    !> Its line, and the number of its file among `paths` of the deck.
    integer :: line = 0, file = 0
  end type fuge_deck_link

  !> A force, or a prescribed displacement, at a node.
  type, public :: fuge_deck_value
    !> Number of the node in the file.
    integer :: node = 0
    !> 1 to 3 along x, y, z, 4 to 6 about them; 0: of a scalar point.
    integer :: direction = 0
    !> Force, moment, displacement or rotation.
    real(dp) :: value = 0.0_dp
    !> As those of a link.
    integer :: line = 0, file = 0
  end type fuge_deck_value

  !> A load case: a subcase of Nastran, a step of Abaqus or CalculiX, a column of a table.
  type, public :: fuge_deck_case
    !> Such as SUBCASE 3.
    character(len=NAME_LENGTH) :: name = ''
    !> Forces and moments, each degree of freedom once.
    type(fuge_deck_value), allocatable :: loads(:)
    !> Degrees of freedom that are held, each once, with their displacements.
    type(fuge_deck_value), allocatable :: supports(:)
  end type fuge_deck_case

  !> Links and load cases. A deck as it is declared has none.
  type, public :: fuge_deck
    !> One-way links.
    type(fuge_deck_link), allocatable :: links(:)
    !> Load cases.
    type(fuge_deck_case), allocatable :: cases(:)
    !> Supports of the model itself, as of all load cases that a table adds.
    type(fuge_deck_value), allocatable :: supports(:)
    !> Paths of all files, each ended by achar(0).
    character(len=:), allocatable :: paths
  contains
    procedure :: link_count
    procedure :: case_count
    procedure :: file_count
    procedure :: get_file
  end type fuge_deck

contains

  !> Number of links.
  pure function link_count(self) result(n)
    class(fuge_deck), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%links)) n = size(self%links)
  end function link_count

  !> Number of load cases.
  pure function case_count(self) result(n)
    class(fuge_deck), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%cases)) n = size(self%cases)
  end function case_count

  !> Number of files that have been read.
  pure function file_count(self) result(n)
    class(fuge_deck), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%paths)) n = count_paths(self%paths)
  end function file_count

  !> Path of file k, from 1 to file_count().
  pure subroutine get_file(self, k, path)
    class(fuge_deck), intent(in) :: self
    integer, intent(in) :: k
    character(len=:), allocatable, intent(out) :: path

    path = ''
    if (allocated(self%paths)) call get_path(self%paths, k, path)
  end subroutine get_file

  !> A rigid link between two nodes, with neither a second stop nor a limit.
  pure function new_link(name, node_a, node_b, direction, gap) result(link)
    character(len=*), intent(in) :: name
    integer, intent(in) :: node_a, node_b
    real(dp), intent(in) :: direction(3), gap
    type(fuge_deck_link) :: link

    link%name = name
    link%node_a = node_a
    link%node_b = node_b
    link%direction = direction
    link%gap = gap
  end function new_link

  !> File and line for a message, "model.bdf", line 12; empty without a line.
  pure subroutine place_text(paths, file, line, place)
    character(len=*), intent(in) :: paths
    integer, intent(in) :: file, line
    character(len=:), allocatable, intent(out) :: place

    place = ''
    if (line < 1) return
    call get_path(paths, file, place)
    place = quoted_path(place)//', line '//text(line)
  end subroutine place_text

  !> Move a deck; nothing is copied.
  pure subroutine move_deck(from, to)
    type(fuge_deck), intent(inout) :: from, to

    call move_alloc(from%links, to%links)
    call move_alloc(from%cases, to%cases)
    call move_alloc(from%supports, to%supports)
    call move_text(from%paths, to%paths)
  end subroutine move_deck

end module fuge_deck_type
