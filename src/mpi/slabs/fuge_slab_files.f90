!> Values of a grid in files that all ranks read and write together, each its own rows.
!>
!> The format is that of numpy, .npy: a header with the shape, and the numbers one after the other. The array has ny
!> rows of nx numbers, in the order of a grid's points, so that numpy.load(path)[j, i] is the cell i of row j, from 0;
!> of a line of n cells it is (n,).
module fuge_slab_files
  use, intrinsic :: iso_fortran_env, only: int8
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_point_space, only: point_space
  use fuge_shared_operator, only: shared_operator
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_FILE, FUGE_ERR_SIZE
  use mpi_f08, only: MPI_Bcast, MPI_File, MPI_File_close, MPI_File_open, MPI_File_read_at, MPI_File_read_at_all, &
    MPI_File_set_size, MPI_File_write_at, MPI_File_write_at_all, MPI_Get_count, MPI_Status, &
    MPI_CHARACTER, MPI_DOUBLE_PRECISION, MPI_INFO_NULL, MPI_INTEGER, MPI_MODE_CREATE, MPI_MODE_RDONLY, &
    MPI_MODE_WRONLY, MPI_OFFSET_KIND, MPI_STATUS_IGNORE, MPI_SUCCESS
  implicit none
  private

  public :: fuge_mpi_read_rows, fuge_mpi_write_rows

  !> Bytes of the header that is written.
  integer, parameter :: HEADER = 128
  !> Most bytes of a header that is read.
  integer, parameter :: LONGEST_HEADER = 1024
  !> The first bytes of a file: 147 and the name, then the version and the length of the text.
  integer, parameter :: FIRST_BYTE = 147
  character(len=*), parameter :: NAME = 'NUMPY'
  integer, parameter :: LENGTH_BYTES = 10

contains

  !> Read the rows of this rank, `values` (points of this rank), from the numpy file `path`, an array (ny, nx), or
  !> (n,) for a half-plane, of real numbers of 8 bytes. All ranks call it.
  !>
  !> Errors, on all ranks, which leave `values` as they were: FUGE_ERR_CALL_ORDER before the operator is set,
  !> FUGE_ERR_FILE, FUGE_ERR_SIZE for another shape, FUGE_ERR_MEMORY.
  subroutine fuge_mpi_read_rows(path, operator, values, info)
    character(len=*), intent(in) :: path
    class(shared_operator), intent(in) :: operator
    real(dp), allocatable, intent(inout) :: values(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: rows(:)
    type(point_space) :: space
    type(MPI_File) :: file
    type(MPI_Status) :: status
    integer :: begin, count, error, stat

    call require_grid(operator, info)
    if (info%failed()) return
    space = operator%ranks()
    allocate (rows(operator%points()), stat=stat)
    call require_memory(stat, '', operator%points(), 'values', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call require_file(path, 'read', 'cannot be opened', space, info)
    if (info%failed()) return
    call MPI_File_open(operator%comm(), path, MPI_MODE_RDONLY, MPI_INFO_NULL, file, error)
    if (error /= MPI_SUCCESS) call report(info, FUGE_ERR_FILE, path//' cannot be opened')
    call space%agree(info)
    if (info%failed()) return
    call read_header(path, file, operator, begin, info)
    call space%agree(info)
    if (.not. info%failed()) then
      call MPI_File_read_at_all(file, offset_of(operator, begin), rows, size(rows), MPI_DOUBLE_PRECISION, status, error)
      count = -1
      if (error == MPI_SUCCESS) call MPI_Get_count(status, MPI_DOUBLE_PRECISION, count)
      if (count /= size(rows)) call report(info, FUGE_ERR_FILE, path//' ends too early')
      call space%agree(info)
    end if
    call MPI_File_close(file, error)
    if (.not. info%failed()) call move_alloc(rows, values)
  end subroutine fuge_mpi_read_rows

  !> Write `values` (points of this rank) to the numpy file `path`, which is replaced. All ranks call it. Errors, on all
  !> ranks: FUGE_ERR_CALL_ORDER before the operator is set, FUGE_ERR_SIZE, FUGE_ERR_FILE.
  subroutine fuge_mpi_write_rows(path, operator, values, info)
    character(len=*), intent(in) :: path
    class(shared_operator), intent(in) :: operator
    real(dp), intent(in), contiguous :: values(:)
    type(fuge_info), intent(out) :: info
    type(point_space) :: space
    type(MPI_File) :: file
    integer :: closed, error, cells(2)

    call require_grid(operator, info)
    if (info%failed()) return
    space = operator%ranks()
    if (size(values) /= operator%points()) call report(info, FUGE_ERR_SIZE, text(size(values))//' value(s): the rows ' &
                                                       //'of this rank have '//text(operator%points()))
    call space%agree(info)
    if (info%failed()) return
    if (space%number() == 0) call create_file(path, info)
    call space%agree(info)
    if (.not. info%failed()) call require_file(path, 'write', 'cannot be opened for writing', space, info)
    if (info%failed()) return
    call MPI_File_open(operator%comm(), path, ior(MPI_MODE_CREATE, MPI_MODE_WRONLY), MPI_INFO_NULL, file, error)
    if (error /= MPI_SUCCESS) call report(info, FUGE_ERR_FILE, path//' cannot be opened for writing')
    call space%agree(info)
    if (info%failed()) return
    cells = operator%grid()
    call MPI_File_set_size(file, HEADER + 8_MPI_OFFSET_KIND*cells(1)*cells(2), error)
    if (error == MPI_SUCCESS .and. space%number() == 0) then
      call MPI_File_write_at(file, 0_MPI_OFFSET_KIND, header_of(cells), HEADER, MPI_CHARACTER, MPI_STATUS_IGNORE, error)
    end if
    if (error /= MPI_SUCCESS) call report(info, FUGE_ERR_FILE, path//' cannot be written')
    call space%agree(info)
    if (.not. info%failed()) then
      call MPI_File_write_at_all(file, offset_of(operator, HEADER), values, size(values), MPI_DOUBLE_PRECISION, &
                                 MPI_STATUS_IGNORE, error)
      if (error /= MPI_SUCCESS) call report(info, FUGE_ERR_FILE, path//' cannot be written: is the disk full?')
      call space%agree(info)
    end if
    call MPI_File_close(file, closed)
    if (closed /= MPI_SUCCESS .and. .not. info%failed()) then
      call report(info, FUGE_ERR_FILE, path//' cannot be closed: is the disk full?')
    end if
    call space%agree(info)
  end subroutine fuge_mpi_write_rows

  !> Create the file, unless it exists.
  subroutine create_file(path, info)
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    integer :: status, unit

    open (newunit=unit, file=path, action='write', access='stream', iostat=status)
    if (status == 0) close (unit, iostat=status)
    if (status /= 0) call report(info, FUGE_ERR_FILE, path//' cannot be opened for writing')
  end subroutine create_file

  !> Refuse a file that a rank cannot open for this `action` (FUGE_ERR_FILE, on all ranks): where some can and some
  !> cannot, MPI_File_open would wait without end.
  subroutine require_file(path, action, reason, space, info)
    character(len=*), intent(in) :: path, action, reason
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    integer :: status, unit

    open (newunit=unit, file=path, status='old', action=action, access='stream', iostat=status)
    if (status == 0) close (unit, iostat=status)
    if (status /= 0) call report(info, FUGE_ERR_FILE, path//' '//reason)
    call space%agree(info)
  end subroutine require_file

  subroutine require_grid(operator, info)
    class(shared_operator), intent(in) :: operator
    type(fuge_info), intent(inout) :: info

    if (any(operator%grid() < 1)) call report(info, FUGE_ERR_CALL_ORDER, 'the operator has no cells: set it first')
  end subroutine require_grid

  !> Where the rows of this rank begin in a file whose numbers begin at byte `begin`.
  function offset_of(operator, begin) result(offset)
    class(shared_operator), intent(in) :: operator
    integer, intent(in) :: begin
    integer(MPI_OFFSET_KIND) :: offset
    integer :: cells(2), rows(2)

    cells = operator%grid()
    rows = operator%own_rows()
    offset = begin + 8_MPI_OFFSET_KIND*cells(1)*(rows(1) - 1)
  end function offset_of

  !> How numpy calls the real numbers of this machine.
  pure function number_type() result(name)
    character(len=3) :: name
    integer(int8) :: bytes(storage_size(1)/8)

    bytes = transfer(1, bytes)
    name = merge('<f8', '>f8', bytes(1) == 1_int8)
  end function number_type

  !> The header of an array (ny, nx): version 1.0, and a dictionary that ends with a newline.
  pure function header_of(cells) result(bytes)
    integer, intent(in) :: cells(2)
    character(len=HEADER) :: bytes

    bytes = achar(0)
    bytes(1:1) = transfer(int(FIRST_BYTE - 256, int8), 'a')
    bytes(2:) = NAME//achar(1)//achar(0)//achar(HEADER - LENGTH_BYTES)//achar(0)//'{''descr'': '''//number_type() &
                //''', ''fortran_order'': False, ''shape'': '//trim(shape_text(cells))//', }'
    bytes(HEADER:) = new_line('a')
  end function header_of

  !> How numpy writes the shape of the grid, or of the line, of `cells`.
  pure function shape_text(cells) result(words)
    integer, intent(in) :: cells(2)
    character(len=32) :: words

    if (cells(1) == 1) then
      words = '('//text(cells(2))//',)'
    else
      words = '('//text(cells(2))//', '//text(cells(1))//')'
    end if
  end function shape_text

  !> Read the header on rank 0: `begin`, the byte at which the numbers begin, on all ranks. Errors, on rank 0:
  !> FUGE_ERR_FILE, FUGE_ERR_SIZE.
  subroutine read_header(path, file, operator, begin, info)
    character(len=*), intent(in) :: path
    type(MPI_File), intent(in) :: file
    class(shared_operator), intent(in) :: operator
    integer, intent(out) :: begin
    type(fuge_info), intent(inout) :: info
    character(len=LONGEST_HEADER) :: bytes
    type(point_space) :: space
    integer :: error

    space = operator%ranks()
    begin = 0
    if (space%number() == 0) then
      bytes = ' '
      call MPI_File_read_at(file, 0_MPI_OFFSET_KIND, bytes, len(bytes), MPI_CHARACTER, MPI_STATUS_IGNORE, error)
      if (error /= MPI_SUCCESS) then
        call report(info, FUGE_ERR_FILE, path//' cannot be read')
      else
        call parse_header(path, bytes, operator%grid(), begin, info)
      end if
    end if
    call MPI_Bcast(begin, 1, MPI_INTEGER, 0, operator%comm())
  end subroutine read_header

  !> Where the numbers begin, if the header is that of `cells`.
  pure subroutine parse_header(path, bytes, cells, begin, info)
    character(len=*), intent(in) :: path, bytes
    integer, intent(in) :: cells(2)
    integer, intent(out) :: begin
    type(fuge_info), intent(inout) :: info
    character(len=len(bytes)) :: words
    integer :: first, last, shape(2), stat

    begin = 0
    if (bytes(2:6) /= NAME .or. iachar(bytes(7:7)) < 1 .or. iachar(bytes(7:7)) > 3) then
      call report(info, FUGE_ERR_FILE, path//' is no file of numpy: write it with numpy.save')
      return
    end if
    ! The length has two bytes in version 1, else four.
    first = merge(LENGTH_BYTES, LENGTH_BYTES + 2, iachar(bytes(7:7)) == 1) + 1
    begin = first - 1 + byte(bytes(9:9)) + 256*byte(bytes(10:10))
    if (index(bytes, number_type()) == 0 .or. index(bytes, '''fortran_order'': False') == 0) then
      call report(info, FUGE_ERR_FILE, path//' has no real numbers of 8 bytes row by row: save ' &
                  //'numpy.ascontiguousarray(heights, dtype=float)')
      return
    end if
    first = index(bytes, '''shape'': (') + len('''shape'': (')
    last = first + index(bytes(first:), ')') - 2
    ! A line has one number.
    shape = [0, 1]
    stat = 1
    if (first > len('''shape'': (') .and. last >= first) then
      words = bytes(first:last)//'/'
      read (words, *, iostat=stat) shape
    end if
    if (stat /= 0 .or. any(shape /= cells(2:1:-1))) then
      call report(info, FUGE_ERR_SIZE, path//' has the shape ('//bytes(first:min(last, first + 40)) &
                  //'): the grid needs '//trim(shape_text(cells)))
    end if
  end subroutine parse_header

  !> A byte as a number from 0 to 255.
  pure function byte(character) result(value)
    character, intent(in) :: character
    integer :: value

    value = modulo(int(transfer(character, 0_int8)), 256)
  end function byte

end module fuge_slab_files
