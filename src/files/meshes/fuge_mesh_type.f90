!> A mesh as an input file of a finite element program describes it: nodes, elements, sets and surfaces.
module fuge_mesh_type
  use fuge_constants, only: NAME_LENGTH
  use fuge_kinds, only: dp
  implicit none
  private

  public :: move_mesh, move_text, NAME_LENGTH

  !> Longest name of a type of elements.
  integer, parameter, public :: TYPE_LENGTH = 16

  !> A set of nodes or elements.
  type, public :: fuge_mesh_set
    !> In upper case.
    character(len=NAME_LENGTH) :: name = ''
    !> Indices of its members in `node` or `element` of the mesh, in the order of the file, each once.
    integer, allocatable :: member(:)
  end type fuge_mesh_set

  !> A surface of faces of elements.
  type, public :: fuge_mesh_surface
    !> In upper case.
    character(len=NAME_LENGTH) :: name = ''
    !> The element of each face: its index in `element` of the mesh.
    integer, allocatable :: element(:)
    !> The number n, of Sn, of each face; of a shell 1 is SNEG and 2 SPOS.
    integer, allocatable :: face(:)
  end type fuge_mesh_surface

  !> Values at the nodes of a mesh, or of its elements, for `fuge_write_mesh`.
  type, public :: fuge_mesh_field
    !> Different for each field of a file.
    character(len=NAME_LENGTH) :: name = ''
    !> One column for each node: one value, or a vector of two or three components, (1, 2 or 3, nodes).
    real(dp), allocatable :: value(:, :)
    !> The columns belong to the elements instead, (1, 2 or 3, elements).
    logical :: of_elements = .false.
  end type fuge_mesh_field

  !> A mesh. Nodes and elements have the order of the file.
  type, public :: fuge_mesh
    !> Number of each node in the file.
    integer, allocatable :: node(:)
    !> Position of each node (3, nodes); coordinates that the file leaves out are 0.
    real(dp), allocatable :: position(:, :)
    !> Number of each element in the file.
    integer, allocatable :: element(:)
    !> Type of each element in upper case, such as C3D8.
    character(len=TYPE_LENGTH), allocatable :: element_type(:)
    !> Where the nodes of each element begin in `connection`, one more than elements.
    integer, allocatable :: first(:)
    !> The nodes of element k: `connection`(`first`(k) : `first`(k + 1) - 1), their indices in `node`.
    integer, allocatable :: connection(:)
    !> Sets of nodes, in the order in which the file first names them.
    type(fuge_mesh_set), allocatable :: node_set(:)
    !> Sets of elements.
    type(fuge_mesh_set), allocatable :: element_set(:)
    !> Surfaces of faces.
    type(fuge_mesh_surface), allocatable :: surface(:)
    !> Paths of the file and of those that it includes, each once and ended by achar(0); not allocated without a file.
    character(len=:), allocatable :: paths
  end type fuge_mesh

contains

  !> Move a mesh; nothing is copied.
  pure subroutine move_mesh(from, to)
    type(fuge_mesh), intent(inout) :: from, to

    call move_alloc(from%node, to%node)
    call move_alloc(from%position, to%position)
    call move_alloc(from%element, to%element)
    call move_alloc(from%element_type, to%element_type)
    call move_alloc(from%first, to%first)
    call move_alloc(from%connection, to%connection)
    call move_alloc(from%node_set, to%node_set)
    call move_alloc(from%element_set, to%element_set)
    call move_alloc(from%surface, to%surface)
    call move_text(from%paths, to%paths)
  end subroutine move_mesh

  !> As move_alloc, whose rules for deferred lengths change with Fortran 2023.
  pure subroutine move_text(from, to)
    character(len=:), allocatable, intent(inout) :: from, to

    if (allocated(to)) deallocate (to)
    if (.not. allocated(from)) return
    to = from
    deallocate (from)
  end subroutine move_text

end module fuge_mesh_type
