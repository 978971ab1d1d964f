!> Stiffness matrices from files of finite element programs.
module fuge_stiffness_files
  use fuge_column_entries, only: read_column_entries
  use fuge_compressed_columns, only: compressed_columns
  use fuge_dmig_reader, only: read_dmig
  use fuge_kinds, only: dp
  use fuge_matrix_market_reader, only: fuge_read_sparse
  use fuge_number_text, only: text
  use fuge_op4_reader, only: read_op4
  use fuge_row_names, only: read_row_names
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY, FUGE_ERR_OPTION
  use fuge_stiffness_entries, only: make_columns, stiffness_entries
  use fuge_stiffness_formats, only: is_binary_op4, recognise_format, FUGE_STIFFNESS_ANY, &
    FUGE_STIFFNESS_CALCULIX, FUGE_STIFFNESS_DMIG, FUGE_STIFFNESS_MATRIX_MARKET, FUGE_STIFFNESS_OP4
  use fuge_text_numbers, only: lower_case
  use fuge_text_reader, only: quoted_path, text_file
  implicit none
  private

  public :: fuge_read_stiffness

contains

  !> Read the stiffness matrix of a body from a file of a finite element program, into compressed columns and the names
  !> of its rows. Ten arguments: the file, three arrays of the matrix, two of names, the report, and three options.
  !>
  !> `column`, `row`, `value`: both triangles, rows ascending, as fuge_read_sparse returns them and
  !> fuge_sparse_stiffness takes them, in the unit of the file; if it has one triangle, or one of each two positions,
  !> the other is its mirror image. `node`, `direction` (rows): the node of each row and its direction, 1 to 3 for
  !> displacements along x, y, z and 4 to 6 for rotations; 0 where no name is known. All five are allocated afresh.
  !>
  !> `format` (default FUGE_STIFFNESS_ANY: by the content):
  !> FUGE_STIFFNESS_CALCULIX: job.sti of *FREQUENCY, SOLVER=MATRIXSTORAGE; rows in the order of job.dof.
  !> FUGE_STIFFNESS_ABAQUS: *MATRIX OUTPUT, FORMAT=MATRIX INPUT, where entries name node and direction, or COORDINATE.
  !> FUGE_STIFFNESS_DMIG: Nastran's punch file, fields of 8 or 16 columns or free; FUGE_STIFFNESS_OP4: a formatted
  !> file of OUTPUT4, dense, sparse or BIGMAT. FUGE_STIFFNESS_MATRIX_MARKET.
  !> Where entries name nodes, rows ascend by nodes and directions.
  !> `names_path` (default, and if blank: job.dof for a path job.sti, otherwise none): a file with a line
  !> node.direction for each row of a matrix whose entries have numbers only. `name` (default, and if blank: the only
  !> one): which matrix of a file of Nastran, such as KAAX.
  !>
  !> Errors, outputs unchanged: FUGE_ERR_FILE with file, line and reason; FUGE_ERR_OPTION; FUGE_ERR_MEMORY.
  subroutine fuge_read_stiffness(path, column, row, value, node, direction, info, format, names_path, name)
    character(len=*), intent(in) :: path
    integer, allocatable, intent(inout) :: column(:), row(:), node(:), direction(:)
    real(dp), allocatable, intent(inout) :: value(:)
    type(fuge_info), intent(out) :: info
    integer, intent(in), optional :: format
    character(len=*), intent(in), optional :: names_path, name
    type(compressed_columns) :: matrix
    integer, allocatable :: nodes(:), directions(:)
    integer :: known, wanted_length

    known = FUGE_STIFFNESS_ANY
    if (present(format)) known = format
    if (known < FUGE_STIFFNESS_ANY .or. known > FUGE_STIFFNESS_OP4) then
      call report(info, FUGE_ERR_OPTION, 'format = '//text(known)//' is unknown: use FUGE_STIFFNESS_ANY or another ' &
                  //'constant FUGE_STIFFNESS_..')
      return
    end if
    wanted_length = 0
    if (present(name)) wanted_length = len_trim(name)
    call read_names(path, known, nodes, directions, info, names_path)
    if (info%failed()) return
    if (wanted_length > 0) then
      call read_matrix(path, known, name(:wanted_length), matrix, nodes, directions, info)
    else
      call read_matrix(path, known, '', matrix, nodes, directions, info)
    end if
    if (info%failed()) return
    call move_alloc(matrix%column, column)
    call move_alloc(matrix%row, row)
    call move_alloc(matrix%value, value)
    call move_alloc(nodes, node)
    call move_alloc(directions, direction)
  end subroutine fuge_read_stiffness

  !> Read the names of the rows, from the file of the caller or from CalculiX's beside the matrix; not allocated if
  !> there is neither.
  subroutine read_names(path, format, node, direction, info, names_path)
    character(len=*), intent(in) :: path
    integer, intent(in) :: format
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    character(len=*), intent(in), optional :: names_path
    integer :: length

    if (present(names_path)) then
      if (len_trim(names_path) > 0) then
        call read_row_names(names_path, node, direction, info)
        return
      end if
    end if
    length = len_trim(path)
    if (length < 4) return
    if (lower_case(path(length - 3:length)) /= '.sti') return
    if (format == FUGE_STIFFNESS_ANY .or. format == FUGE_STIFFNESS_CALCULIX) &
      call read_row_names(path(:length - 4)//'.dof', node, direction, info)
  end subroutine read_names

  !> Read the matrix; `node` and `direction`, if they are allocated, are the names of its rows, and are set otherwise.
  subroutine read_matrix(path, given_format, name, matrix, node, direction, info)
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: given_format
    type(compressed_columns), intent(inout) :: matrix
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    type(text_file) :: file
    type(stiffness_entries) :: entries
    integer :: format

    format = given_format
    call file%load(path, info)
    if (info%failed()) return
    if (is_binary_op4(file)) then
      call report(info, FUGE_ERR_FILE, file%name//' is a binary file, as of OUTPUT4: only text is read, write it ' &
                  //'with FORM=FORMATTED')
      return
    end if
    if (format == FUGE_STIFFNESS_ANY) call recognise_format(file, format)
    if (allocated(node)) entries%rows = size(node)
    select case (format)
    case (FUGE_STIFFNESS_MATRIX_MARKET)
      file%content = ''
      call read_matrix_market(path, matrix, node, direction, info)
      return
    case (FUGE_STIFFNESS_DMIG)
      call read_dmig(file, name, entries, info)
    case (FUGE_STIFFNESS_OP4)
      call read_op4(file, name, entries, info)
    case default
      call read_column_entries(file, entries, info)
    end select
    if (.not. info%failed() .and. allocated(node)) call check_names(file, entries, size(node), info)
    if (.not. info%failed()) call make_columns(file, entries, matrix, node, direction, info)
  end subroutine read_matrix

  !> Hold the rows of the matrix against the `named` rows of the file of names.
  pure subroutine check_names(file, entries, named, info)
    type(text_file), intent(in) :: file
    type(stiffness_entries), intent(in) :: entries
    integer, intent(in) :: named
    type(fuge_info), intent(inout) :: info
    integer :: rows

    if (entries%names%count > 0) then
      call report(info, FUGE_ERR_FILE, file%name//' names the nodes of its entries itself: pass no file of names')
    else if (entries%count > 0) then
      rows = max(maxval(entries%row(:entries%count)), maxval(entries%column(:entries%count)))
      if (rows < named) call report(info, FUGE_ERR_FILE, file%name//' ends with row '//text(rows)//', but ' &
                                    //text(named)//' rows are named: is it cut off, or of another model?')
    end if
  end subroutine check_names

  !> Read a matrix in the Matrix Market format.
  subroutine read_matrix_market(path, matrix, node, direction, info)
    character(len=*), intent(in) :: path
    type(compressed_columns), intent(inout) :: matrix
    integer, allocatable, intent(inout) :: node(:), direction(:)
    type(fuge_info), intent(inout) :: info
    integer :: named, rows, status

    rows = 0
    call fuge_read_sparse(path, rows, matrix%column, matrix%row, matrix%value, info)
    if (info%failed()) return
    named = rows
    if (allocated(node)) named = size(node)
    if (rows /= size(matrix%column) - 1) then
      call report(info, FUGE_ERR_FILE, quoted_path(path)//' has a matrix of '//text(rows)//' x ' &
                  //text(size(matrix%column) - 1)//': a stiffness matrix is square')
    else if (named /= rows) then
      call report(info, FUGE_ERR_FILE, quoted_path(path)//' has '//text(rows)//' rows, but '//text(named)//' are named')
    else if (.not. allocated(node)) then
      allocate (node(rows), direction(rows), stat=status)
      if (status /= 0) then
        call report(info, FUGE_ERR_MEMORY, quoted_path(path)//': no memory for the names of '//text(rows)//' rows')
        return
      end if
      node = 0
      direction = 0
    end if
  end subroutine read_matrix_market

end module fuge_stiffness_files
