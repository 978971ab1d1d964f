!> Displacements of a structure in all load cases: a table, or a file for ParaView.
module deck_fields
  use command_line, only: arguments, refuse
  use deck_cases, only: case_results
  use deck_model, only: structure
  use fuge_core, only: fuge_dp, fuge_info
  use fuge_files, only: fuge_make_mesh, fuge_mesh, fuge_mesh_field, fuge_read_mesh, fuge_write_mesh
  use number_index, only: index_of_numbers
  use number_words, only: number_text
  use text_table, only: table
  implicit none
  private

  public :: is_mesh_file, read_drawn_mesh, write_fields

  !> Types of elements that have no cell, by the letters that they begin with.
  character(len=8), parameter :: NOT_DRAWN(8) = [character(len=8) :: 'GAP', 'SPRING', 'DASHPOT', 'MASS', 'ROTARYI', &
    'CONN', 'DCOUP', 'DGAP']

contains

  !> Is it the name of a file for ParaView?
  pure function is_mesh_file(path)
    character(len=*), intent(in) :: path
    logical :: is_mesh_file

    is_mesh_file = .false.
    if (len(path) > 4) is_mesh_file = path(len(path) - 3:) == '.vtu' .or. path(len(path) - 3:) == '.VTU'
  end function is_mesh_file

  !> The mesh of --mesh, or of a deck of Abaqus or CalculiX, without its springs and masses.
  subroutine read_drawn_mesh(given, mesh, info)
    type(arguments), intent(in) :: given
    type(fuge_mesh), intent(inout) :: mesh
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh) :: whole, drawn
    integer, allocatable :: nodes(:, :), kept(:)
    integer :: i, k, most

    if (given%has('mesh')) then
      call fuge_read_mesh(given%file('mesh'), whole, info)
    else
      call fuge_read_mesh(given%file('deck'), whole, info)
      if (info%failed()) call refuse('--field '//given%file('field')//' needs --mesh, an input file of Abaqus or ' &
                                     //'CalculiX with the nodes and elements', info)
    end if
    if (info%failed()) return
    kept = pack([(k, k=1, size(whole%element))], [(is_drawn(whole%element_type(k)), k=1, size(whole%element))])
    most = 1
    do i = 1, size(kept)
      most = max(most, whole%first(kept(i) + 1) - whole%first(kept(i)))
    end do
    allocate (nodes(most, size(kept)), source=0)
    do i = 1, size(kept)
      k = whole%first(kept(i) + 1) - whole%first(kept(i))
      nodes(:k, i) = whole%connection(whole%first(kept(i)):whole%first(kept(i)) + k - 1)
    end do
    call fuge_make_mesh(whole%position, nodes, whole%element_type(kept), drawn, info)
    if (info%failed()) return
    drawn%node = whole%node
    mesh = drawn
  end subroutine read_drawn_mesh

  pure function is_drawn(element_type)
    character(len=*), intent(in) :: element_type
    logical :: is_drawn
    integer :: k

    is_drawn = .true.
    do k = 1, size(NOT_DRAWN)
      if (index(element_type, trim(NOT_DRAWN(k))) == 1) is_drawn = .false.
    end do
  end function is_drawn

  !> Write the displacements of the cases that are solved. Error: FUGE_ERR_FILE.
  subroutine write_fields(path, mesh, model, results, info)
    character(len=*), intent(in) :: path
    type(fuge_mesh), intent(in) :: mesh
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    type(fuge_info), intent(inout) :: info
    type(fuge_mesh_field), allocatable :: fields(:)
    type(index_of_numbers) :: nodes
    integer :: i, k, n, node

    if (.not. is_mesh_file(path)) then
      call write_table(path, model, results, info)
      return
    end if
    call nodes%set(mesh%node)
    allocate (fields(count(results%report%status >= 0)))
    n = 0
    do k = 1, size(results%report)
      if (results%report(k)%status < 0) cycle
      n = n + 1
      fields(n)%name = 'displacement '//number_text(k)//', '//model%deck%cases(k)%name
      allocate (fields(n)%value(3, size(mesh%node)), source=0.0_fuge_dp)
      do i = 1, model%degrees()
        node = nodes%find(model%node(i))
        if (node > 0 .and. model%direction(i) >= 1 .and. model%direction(i) <= 3) &
          fields(n)%value(model%direction(i), node) = results%displacement(i, k)
      end do
    end do
    call fuge_write_mesh(path, mesh, fields, info)
  end subroutine write_fields

  !> A line for each row, a column for each case.
  subroutine write_table(path, model, results, info)
    character(len=*), intent(in) :: path
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=:), allocatable :: line
    character(len=25) :: value
    integer :: i, k

    call csv%create(path, info)
    if (info%failed()) return
    line = 'node,direction'
    do k = 1, size(results%report)
      line = line//',displacement '//number_text(k)
    end do
    call csv%put(line)
    do i = 1, model%degrees()
      line = number_text(model%node(i))//','//number_text(model%direction(i))
      do k = 1, size(results%report)
        value = ''
        if (results%report(k)%status >= 0) write (value, '(es25.16e3)') results%displacement(i, k)
        line = line//','//trim(value)
      end do
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_table

end module deck_fields
