!> Meshes with fields as a file for ParaView: the unstructured grid of VTK (VTU), with the numbers as they are.
module fuge_mesh_writer
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_element_types, only: upper_case
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_mesh_checks, only: check_mesh, element_name
  use fuge_mesh_type, only: fuge_mesh, fuge_mesh_field, NAME_LENGTH
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_ERR_ELEMENT, FUGE_ERR_NOT_FINITE, &
    FUGE_ERR_SIZE
  use fuge_vtk_cells, only: vtk_cell, vtk_node, CELL_UNKNOWN
  implicit none
  private

  public :: fuge_write_mesh

contains

  !> Write a mesh and fields at its nodes or elements to a VTU file, which ParaView reads; an existing file is replaced.
  !>
  !> `mesh`: from `fuge_make_mesh` or `fuge_join_meshes`, or filled by hand; needed are `position`,
  !> `element_type`, `first` and `connection`. Known are solids, elements of a plane, shells, membranes, rigid faces,
  !> trusses and beams of Abaqus and CalculiX. `fields`: none, or some of different names; a vector of two components
  !> gets a third one, 0. All values finite; they are written as doubles, to the last bit. The nodes are written where
  !> `position` has them: ParaView deforms the mesh by a displacement of two or three components (Warp By Vector).
  !> Errors, an existing file unchanged: FUGE_ERR_SIZE, FUGE_ERR_ELEMENT for a type that is not known or has another
  !> number of nodes, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for the name of a field, FUGE_ERR_MEMORY; FUGE_ERR_FILE if
  !> writing fails, the file is then empty.
  subroutine fuge_write_mesh(path, mesh, fields, info)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: end_vtk
    character(len=*), intent(in) :: path
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_mesh_field), intent(in) :: fields(:)
    type(fuge_info), intent(out) :: info
    type(text_output) :: file
    integer, allocatable :: cells(:), nodes(:)
    integer :: stat

    call check_mesh(mesh, info)
    if (info%failed()) return
    allocate (cells(size(mesh%element_type)), nodes(size(mesh%element_type)), stat=stat)
    call require_memory(stat, '', size(mesh%element_type), 'cells', info)
    if (stat /= 0) return
    call find_cells(mesh, cells, nodes, info)
    if (.not. info%failed()) call check_fields(mesh, fields, info)
    if (.not. info%failed()) call file%create(path, info)
    if (info%failed()) return
    call write_head(file, mesh, nodes, fields)
    call write_fields(file, fields, .false.)
    call write_fields(file, fields, .true.)
    call write_columns(file, mesh%position)
    call write_cells(file, mesh, cells, nodes)
    call end_vtk(file)
    call file%finish(info)
  end subroutine fuge_write_mesh

  !> The cell of each element and its number of nodes.
  pure subroutine find_cells(mesh, cells, nodes, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(out) :: cells(:), nodes(:)
    type(fuge_info), intent(inout) :: info
    logical :: known
    integer :: cell, count, e

    cell = CELL_UNKNOWN
    count = 0
    do e = 1, size(cells)
      known = .false.
      if (e > 1) known = mesh%element_type(e) == mesh%element_type(e - 1)
      if (.not. known) call vtk_cell(upper_case(mesh%element_type(e)), cell, count)
      cells(e) = cell
      nodes(e) = count
      call check_nodes(mesh, e, cells(e), nodes(e), info)
      if (info%failed()) return
    end do
  end subroutine find_cells

  !> Refuse element e if its type is unknown or has another number of nodes; a beam may have one more than its cell.
  pure subroutine check_nodes(mesh, e, cell, nodes, info)
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: e, cell, nodes
    type(fuge_info), intent(inout) :: info
    integer :: found, more

    found = mesh%first(e + 1) - mesh%first(e)
    if (cell /= CELL_UNKNOWN .and. found == nodes) return
    more = merge(1, 0, index(upper_case(mesh%element_type(e)), 'B') == 1)
    if (cell == CELL_UNKNOWN) then
      call report(info, FUGE_ERR_ELEMENT, trim(element_name(mesh, e))//' has the type "'//trim(mesh%element_type(e)) &
                  //'", which VTK does not have: leave such elements out')
    else if (found < nodes .or. found > nodes + more) then
      call report(info, FUGE_ERR_ELEMENT, trim(element_name(mesh, e))//' of type '//trim(mesh%element_type(e)) &
                  //' has '//text(found)//' nodes instead of '//text(nodes))
    end if
  end subroutine check_nodes

  !> Refuse fields of other sizes (FUGE_ERR_SIZE), NaN and infinity (FUGE_ERR_NOT_FINITE), and names as those of grids.
  pure subroutine check_fields(mesh, fields, info)
    use fuge_vtk_results, only: check_name
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_mesh_field), intent(in) :: fields(:)
    type(fuge_info), intent(inout) :: info
    character(len=NAME_LENGTH) :: names(size(fields))
    integer :: k

    do k = 1, size(fields)
      names(k) = fields(k)%name
      call check_name(names(:k), k, info)
      if (.not. info%failed()) call check_field(mesh, fields(k), info)
      if (info%failed()) return
    end do
  end subroutine check_fields

  pure subroutine check_field(mesh, field, info)
    type(fuge_mesh), intent(in) :: mesh
    type(fuge_mesh_field), intent(in) :: field
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: found
    integer :: columns, k

    columns = merge(size(mesh%element_type), size(mesh%position, 2), field%of_elements)
    if (.not. allocated(field%value)) then
      call report(info, FUGE_ERR_SIZE, 'field "'//trim(field%name)//'" has no values')
    else if (size(field%value, 1) < 1 .or. size(field%value, 1) > 3 .or. size(field%value, 2) /= columns) then
      call report(info, FUGE_ERR_SIZE, 'field "'//trim(field%name)//'" is '//text(size(field%value, 1))//' by ' &
                  //text(size(field%value, 2))//': it needs 1, 2 or 3 components and '//text(columns)//' columns, ' &
                  //'one for each '//trim(merge('element', 'node   ', field%of_elements)))
    end if
    if (info%failed()) return
    do k = 1, columns
      call check_finite(field%value(:, k), 'component', found)
      if (.not. found%failed()) cycle
      call report(info, FUGE_ERR_NOT_FINITE, 'field "'//trim(field%name)//'", column '//index_text(k)//': ' &
                  //composed_message(found))
      return
    end do
  end subroutine check_field

  !> Write all that stands before the numbers, in XML.
  subroutine write_head(file, mesh, nodes, fields)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: begin_values, begin_vtk, put_array, whole
    type(text_output), intent(inout) :: file
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: nodes(:)
    type(fuge_mesh_field), intent(in) :: fields(:)
    integer(int64) :: all_cells, all_nodes, offset

    all_nodes = size(mesh%position, 2, kind=int64)
    all_cells = size(nodes, kind=int64)
    offset = 0_int64
    call begin_vtk(file, 'UnstructuredGrid')
    call file%put('<UnstructuredGrid>')
    call file%put('<Piece NumberOfPoints="'//trim(whole(all_nodes))//'" NumberOfCells="'//trim(whole(all_cells))//'">')
    call put_list(file, 'PointData', fields, .false., all_nodes, offset)
    call put_list(file, 'CellData', fields, .true., all_cells, offset)
    call file%put('<Points>')
    call put_array(file, 'Points', all_nodes, offset, components=3)
    call file%put('</Points>')
    call file%put('<Cells>')
    call put_array(file, 'connectivity', sum(int(nodes, int64)), offset, type='Int64')
    call put_array(file, 'offsets', all_cells, offset, type='Int64')
    call put_array(file, 'types', all_cells, offset, type='UInt8')
    call file%put('</Cells>')
    call file%put('</Piece>')
    call file%put('</UnstructuredGrid>')
    call begin_values(file)
  end subroutine write_head

  !> Write the list of the fields of the nodes or of the elements.
  subroutine put_list(file, section, fields, of_elements, columns, offset)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: put_array
    type(text_output), intent(inout) :: file
    character(len=*), intent(in) :: section
    type(fuge_mesh_field), intent(in) :: fields(:)
    logical, intent(in) :: of_elements
    integer(int64), intent(in) :: columns
    integer(int64), intent(inout) :: offset
    integer :: k

    call file%put('<'//section//'>')
    do k = 1, size(fields)
      if (fields(k)%of_elements .neqv. of_elements) cycle
      call put_array(file, trim(fields(k)%name), columns, offset, components=merge(1, 3, size(fields(k)%value, 1) == 1))
    end do
    call file%put('</'//section//'>')
  end subroutine put_list

  !> Write the values of the fields of the nodes or of the elements.
  subroutine write_fields(file, fields, of_elements)
    use fuge_text_writer, only: text_output
    type(text_output), intent(inout) :: file
    type(fuge_mesh_field), intent(in) :: fields(:)
    logical, intent(in) :: of_elements
    integer :: k

    do k = 1, size(fields)
      if (fields(k)%of_elements .eqv. of_elements) call write_columns(file, fields(k)%value)
    end do
  end subroutine write_fields

  !> Write scalars, or vectors, of which those of two components get a third one.
  subroutine write_columns(file, value)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: put_length, put_vector
    type(text_output), intent(inout) :: file
    real(dp), intent(in) :: value(:, :)
    real(dp) :: vector(3)
    integer :: k

    if (size(value, 1) == 1) then
      call put_length(file, 8_int64*size(value, 2, kind=int64))
      call file%put_reals(value(1, :))
      return
    end if
    call put_length(file, 24_int64*size(value, 2, kind=int64))
    vector = 0.0_dp
    do k = 1, size(value, 2)
      vector(:size(value, 1)) = value(:, k)
      call put_vector(file, vector)
    end do
  end subroutine write_columns

  !> Write the nodes of the cells, from 0, where those of each cell end, and the types of the cells.
  subroutine write_cells(file, mesh, cells, nodes)
    use fuge_text_writer, only: text_output
    use fuge_vtk_results, only: put_length
    type(text_output), intent(inout) :: file
    type(fuge_mesh), intent(in) :: mesh
    integer, intent(in) :: cells(:), nodes(:)
    integer(int64) :: last
    integer :: e, k

    call put_length(file, 8_int64*sum(int(nodes, int64)))
    do e = 1, size(cells)
      do k = 1, nodes(e)
        associate (node => mesh%connection(mesh%first(e) + vtk_node(cells(e), k) - 1))
          call file%put_bytes(transfer(int(node, int64) - 1_int64, repeat(' ', 8)))
        end associate
      end do
    end do
    call put_length(file, 8_int64*size(cells, kind=int64))
    last = 0_int64
    do e = 1, size(cells)
      last = last + nodes(e)
      call file%put_bytes(transfer(last, repeat(' ', 8)))
    end do
    call put_length(file, size(cells, kind=int64))
    do e = 1, size(cells)
      call file%put_bytes(achar(cells(e)))
    end do
  end subroutine write_cells

end module fuge_mesh_writer
