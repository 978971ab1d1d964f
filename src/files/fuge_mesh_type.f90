!> A mesh to be written: nodes, elements and fields at them.
module fuge_mesh_type
  use fuge_constants, only: NAME_LENGTH
  use fuge_kinds, only: dp
  implicit none
  private

  public :: move_mesh, NAME_LENGTH

  !> Longest name of a type of elements.
  integer, parameter, public :: TYPE_LENGTH = 16

  !> Values at the nodes of a mesh, or of its elements, for `fuge_write_mesh`.
  type, public :: fuge_mesh_field
    !> Different for each field of a file.
    character(len=NAME_LENGTH) :: name = ''
    !> One column for each node: one value, or a vector of two or three components, (1, 2 or 3, nodes).
    real(dp), allocatable :: value(:, :)
    !> The columns belong to the elements instead, (1, 2 or 3, elements).
    logical :: of_elements = .false.
  end type fuge_mesh_field

  !> Nodes and elements, as `fuge_make_mesh` makes them.
  type, public :: fuge_mesh
    !> Number of each node for messages.
    integer, allocatable :: node(:)
    !> Position of each node (3, nodes); in a plane the third coordinate is 0.
    real(dp), allocatable :: position(:, :)
    !> Number of each element for messages.
    integer, allocatable :: element(:)
    !> Type of each element in upper case, such as C3D8.
    character(len=TYPE_LENGTH), allocatable :: element_type(:)
    !> Where the nodes of each element begin in `connection`, one more than elements.
    integer, allocatable :: first(:)
    !> The nodes of element k: `connection`(`first`(k) : `first`(k + 1) - 1), their indices in `node`.
    integer, allocatable :: connection(:)
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
  end subroutine move_mesh

end module fuge_mesh_type
