!> Elements of Abaqus and CalculiX as the cells of VTK, by the names of their types.
!>
!> VTK numbers the nodes of lines, triangles, quadrangles, tetrahedra, wedges and bricks as both programs do: corners,
!> then edges, those of a brick round the bottom, round the top, and the upright ones. (The result files of CalculiX,
!> .frd, have another order.) Only lines of three nodes differ. Cells: vtkCellType.h, and W. Schroeder, K. Martin,
!> B. Lorensen, The Visualization Toolkit, chapter 5; a wedge is orientated as VTK 9 integrates and draws it.
module fuge_vtk_cells
  use fuge_element_types, only: split_type, FAMILY_PLANE, FAMILY_SHELL, FAMILY_SOLID
  implicit none
  private

  public :: vtk_cell, vtk_node

  !> Cell types of VTK.
  integer, parameter, public :: CELL_UNKNOWN = 0
  integer, parameter :: LINE = 3, TRIANGLE = 5, QUADRANGLE = 9, TETRAHEDRON = 10, HEXAHEDRON = 12, WEDGE = 13, &
    LINE_3 = 21, TRIANGLE_6 = 22, QUADRANGLE_8 = 23, TETRAHEDRON_10 = 24, HEXAHEDRON_20 = 25, WEDGE_15 = 26, &
    QUADRANGLE_9 = 28

contains

  !> The cell of a type of elements in upper case and the number of its nodes; CELL_UNKNOWN and 0 if there is none.
  !> A beam may have one node more in the mesh, which shows how it is turned.
  pure subroutine vtk_cell(element_type, cell, nodes)
    character(len=*), intent(in) :: element_type
    integer, intent(out) :: cell, nodes
    integer :: family

    call split_type(element_type, family, nodes)
    if (is_beam(element_type)) then
      nodes = merge(3, 2, element_type(3:3) == '2')
      cell = merge(LINE_3, LINE, nodes == 3)
    else if (family == FAMILY_SOLID) then
      cell = solid_cell(nodes)
    else if (family == FAMILY_PLANE .or. family == FAMILY_SHELL) then
      cell = face_cell(nodes)
    else
      cell = CELL_UNKNOWN
      if (index(element_type, 'T') == 1 .and. nodes == 2) cell = LINE
      if (index(element_type, 'T') == 1 .and. nodes == 3) cell = LINE_3
    end if
    if (cell == CELL_UNKNOWN) nodes = 0
  end subroutine vtk_cell

  !> Beams B21, B22, B31 and B32, with any letters behind.
  pure function is_beam(element_type) result(beam)
    character(len=*), intent(in) :: element_type
    logical :: beam

    beam = len(element_type) >= 3
    if (beam) beam = element_type(1:1) == 'B' .and. index('23', element_type(2:2)) > 0 &
      .and. index('12', element_type(3:3)) > 0
  end function is_beam

  pure function solid_cell(nodes) result(cell)
    integer, intent(in) :: nodes
    integer :: cell

    select case (nodes)
    case (4)
      cell = TETRAHEDRON
    case (6)
      cell = WEDGE
    case (8)
      cell = HEXAHEDRON
    case (10)
      cell = TETRAHEDRON_10
    case (15)
      cell = WEDGE_15
    case (20)
      cell = HEXAHEDRON_20
    case default
      cell = CELL_UNKNOWN
    end select
  end function solid_cell

  pure function face_cell(nodes) result(cell)
    integer, intent(in) :: nodes
    integer :: cell

    select case (nodes)
    case (3)
      cell = TRIANGLE
    case (4)
      cell = QUADRANGLE
    case (6)
      cell = TRIANGLE_6
    case (8)
      cell = QUADRANGLE_8
    case (9)
      cell = QUADRANGLE_9
    case default
      cell = CELL_UNKNOWN
    end select
  end function face_cell

  !> Which node of an element is node k of its cell: the middle of a line comes last in VTK, second in an element.
  pure function vtk_node(cell, k) result(node)
    integer, intent(in) :: cell, k
    integer :: node

    node = k
    if (cell == LINE_3 .and. k > 1) node = 5 - k
  end function vtk_node

end module fuge_vtk_cells
