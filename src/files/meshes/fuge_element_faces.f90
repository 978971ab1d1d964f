!> Nodes and faces of the elements of Abaqus and CalculiX, by the names of their types.
!>
!> Numbering of nodes and faces: Abaqus and CalculiX agree. Solids C3D4, C3D6, C3D8, C3D10, C3D15, C3D20, elements of a
!> plane with 3, 4, 6 or 8 nodes, with any letters behind, such as C3D20R; shells S3, S4, S6,
!> S8 and membranes.
module fuge_element_faces
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_text_numbers, only: read_whole
  implicit none
  private

  public :: face_nodes, is_shell, nodes_of_type, split_type

  !> Most nodes of a face.
  integer, parameter, public :: MOST_FACE_NODES = 8
  !> Families of types: unknown, others whose number of nodes is known, elements of a plane, solids, and shells with
  !> membranes and rigid faces.
  integer, parameter, public :: FAMILY_UNKNOWN = 0, FAMILY_OTHER = 1, FAMILY_PLANE = 2, FAMILY_SOLID = 3, &
    FAMILY_SHELL = 4

  !> Corners of the faces S1, S2 .. as the programs list them, their normal into the element; 0 where a face has three.
  integer, parameter :: TETRAHEDRON(4, 4) = reshape([1, 2, 3, 0, 1, 4, 2, 0, 2, 4, 3, 0, 3, 4, 1, 0], [4, 4])
  integer, parameter :: WEDGE(4, 5) = reshape([1, 2, 3, 0, 4, 6, 5, 0, 1, 4, 5, 2, 2, 5, 6, 3, 3, 6, 4, 1], [4, 5])
  integer, parameter :: BRICK(4, 6) = reshape([1, 2, 3, 4, 5, 8, 7, 6, 1, 5, 6, 2, 2, 6, 7, 3, 3, 7, 8, 4, &
                                               4, 8, 5, 1], [4, 6])
  !> Ends of the edges on which the nodes behind the corners lie.
  integer, parameter :: TETRAHEDRON_EDGES(2, 6) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 4, 3, 4], [2, 6])
  integer, parameter :: WEDGE_EDGES(2, 9) = reshape([1, 2, 2, 3, 3, 1, 4, 5, 5, 6, 6, 4, 1, 4, 2, 5, 3, 6], [2, 9])
  integer, parameter :: BRICK_EDGES(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5, 1, 5, 2, 6, &
                                                      3, 7, 4, 8], [2, 12])

contains

  !> The family of a type in upper case, and the number of its nodes, 0 if the type is unknown.
  pure subroutine split_type(element_type, family, nodes)
    character(len=*), intent(in) :: element_type
    integer, intent(out) :: family, nodes
    character(len=3), parameter :: NAMES(8) = ['C3D', 'CPS', 'CPE', 'CAX', 'M3D', 'T3D', 'T2D', 'R3D']
    integer, parameter :: FAMILIES(8) = [FAMILY_SOLID, FAMILY_PLANE, FAMILY_PLANE, FAMILY_PLANE, FAMILY_SHELL, &
                                         FAMILY_OTHER, FAMILY_OTHER, FAMILY_SHELL]
    integer :: k, begin

    family = FAMILY_UNKNOWN
    begin = 4
    do k = 1, size(NAMES)
      if (index(element_type, NAMES(k)) == 1) family = FAMILIES(k)
    end do
    if (family == FAMILY_UNKNOWN .and. element_type(1:1) == 'S' .and. scan(element_type, '3468') == 2) then
      family = FAMILY_SHELL
      begin = 2
    end if
    nodes = 0
    if (family /= FAMILY_UNKNOWN) call leading_number(element_type(begin:), nodes)
    ! The number of nodes of some types varies.
    if (nodes == 27 .or. index(element_type, 'V') > 0) nodes = 0
    if (nodes == 0) family = FAMILY_UNKNOWN
  end subroutine split_type

  !> The whole number at the beginning of a text, of one or two digits.
  pure subroutine leading_number(text, number)
    character(len=*), intent(in) :: text
    integer, intent(out) :: number
    integer(int64) :: value
    integer :: digits, kind

    number = 0
    digits = verify(text//' ', '0123456789') - 1
    if (digits < 1 .or. digits > 2) return
    call read_whole(text(:digits), kind, value)
    number = int(value)
  end subroutine leading_number

  !> Number of nodes of an element; 0 if the type does not say.
  pure function nodes_of_type(element_type) result(nodes)
    character(len=*), intent(in) :: element_type
    integer :: nodes
    integer :: family

    call split_type(element_type, family, nodes)
  end function nodes_of_type

  !> Is the element a shell, a membrane or a rigid face, which has faces on both sides?
  pure function is_shell(element_type) result(shell)
    character(len=*), intent(in) :: element_type
    logical :: shell
    integer :: family, nodes

    call split_type(element_type, family, nodes)
    shell = family == FAMILY_SHELL
  end function is_shell

  !> The nodes of a face, their numbers in the element; `count` is 0 if the type has no such face.
  !>
  !> Corners first, then the nodes on the edges from corner to corner. The corners of a solid's face follow each other
  !> counter-clockwise if it is seen from outside. For an element of a plane a face is an edge from corner to corner,
  !> counter-clockwise round the element. A shell has two faces, 1 on the side of its negative normal, 2 on that of its
  !> positive one.
  pure subroutine face_nodes(element_type, face, count, nodes)
    character(len=*), intent(in) :: element_type
    integer, intent(in) :: face
    integer, intent(out) :: count, nodes(MOST_FACE_NODES)
    integer :: family, number

    count = 0
    nodes = 0
    call split_type(element_type, family, number)
    if (family == FAMILY_PLANE) then
      call edge_nodes(number, face, count, nodes)
    else if (family == FAMILY_SHELL) then
      call shell_side(number, face, count, nodes)
    else if (family == FAMILY_SOLID) then
      select case (number)
      case (4, 10)
        call solid_face(TETRAHEDRON, TETRAHEDRON_EDGES, 4, number == 10, face, count, nodes)
      case (6, 15)
        call solid_face(WEDGE, WEDGE_EDGES, 6, number == 15, face, count, nodes)
      case (8, 20)
        call solid_face(BRICK, BRICK_EDGES, 8, number == 20, face, count, nodes)
      end select
    end if
  end subroutine face_nodes

  !> An edge of an element of a plane with 3, 4, 6 or 8 nodes.
  pure subroutine edge_nodes(number, face, count, nodes)
    integer, intent(in) :: number, face
    integer, intent(out) :: count
    integer, intent(inout) :: nodes(MOST_FACE_NODES)
    integer :: corners

    count = 0
    corners = number
    if (number == 6 .or. number == 8) corners = number/2
    if (corners < 3 .or. corners > 4 .or. face < 1 .or. face > corners) return
    count = 2
    nodes(:2) = [face, modulo(face, corners) + 1]
    if (number == corners) return
    count = 3
    nodes(3) = corners + face
  end subroutine edge_nodes

  !> A side of a shell with 3, 4, 6 or 8 nodes: seen from its positive normal they run counter-clockwise.
  pure subroutine shell_side(number, face, count, nodes)
    integer, intent(in) :: number, face
    integer, intent(out) :: count
    integer, intent(inout) :: nodes(MOST_FACE_NODES)
    integer :: corners, k

    count = 0
    if (number == 9 .or. face < 1 .or. face > 2) return
    corners = number
    if (number > 4) corners = number/2
    count = number
    do k = 1, corners
      nodes(k) = merge(k, modulo(1 - k, corners) + 1, face == 2)
      if (number > corners) nodes(corners + k) = corners + merge(k, corners + 1 - k, face == 2)
    end do
  end subroutine shell_side

  !> A face of a solid whose `quadratic` form has nodes on its edges behind its corners.
  pure subroutine solid_face(faces, edges, corners, quadratic, face, count, nodes)
    integer, intent(in) :: faces(:, :), edges(:, :), corners, face
    logical, intent(in) :: quadratic
    integer, intent(out) :: count
    integer, intent(inout) :: nodes(MOST_FACE_NODES)
    integer :: a, b, e, k, around

    count = 0
    if (face < 1 .or. face > size(faces, 2)) return
    around = merge(3, 4, faces(4, face) == 0)
    nodes(1) = faces(1, face)
    do k = 2, around
      nodes(k) = faces(around + 2 - k, face)
    end do
    count = around
    if (.not. quadratic) return
    do k = 1, around
      a = nodes(k)
      b = nodes(modulo(k, around) + 1)
      do e = 1, size(edges, 2)
        if (minval(edges(:, e)) == min(a, b) .and. maxval(edges(:, e)) == max(a, b)) nodes(around + k) = corners + e
      end do
    end do
    count = 2*around
  end subroutine solid_face

end module fuge_element_faces
