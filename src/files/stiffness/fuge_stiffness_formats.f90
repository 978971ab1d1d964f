!> The formats of files with a stiffness matrix, and which of them a file has.
module fuge_stiffness_formats
  use fuge_entry_numbers, only: is_comment
  use fuge_op4_reader, only: is_op4_header
  use fuge_text_numbers, only: lower_case
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: is_binary_op4, recognise_format

  !> Format of a file with a stiffness matrix: recognised by its content.
  integer, parameter, public :: FUGE_STIFFNESS_ANY = 0
  !> Matrix Market, array or coordinate, general or symmetric.
  integer, parameter, public :: FUGE_STIFFNESS_MATRIX_MARKET = 1
  !> CalculiX, SOLVER=MATRIXSTORAGE: row, column and value on each line (.sti), names of the rows in another file
  !> (.dof).
  integer, parameter, public :: FUGE_STIFFNESS_CALCULIX = 2
  !> Abaqus, *MATRIX OUTPUT: node, direction, node, direction and value (MATRIX INPUT), or row, column and value
  !> (COORDINATE).
  integer, parameter, public :: FUGE_STIFFNESS_ABAQUS = 3
  !> Nastran, DMIG in a punch file or an input file.
  integer, parameter, public :: FUGE_STIFFNESS_DMIG = 4
  !> Nastran, OUTPUT4 with the option FORMATTED, dense or sparse.
  integer, parameter, public :: FUGE_STIFFNESS_OP4 = 5

contains

  !> Does a loaded file begin as a binary one of OUTPUT4: with the length of its first record, six words of 4 or of 8
  !> bytes, in 4 or 8 bytes?
  pure function is_binary_op4(file) result(op4)
    type(text_file), intent(in) :: file
    logical :: op4
    character(len=3), parameter :: ZEROS = repeat(achar(0), 3)
    character(len=4) :: length

    length = file%content(:min(4, len(file%content)))
    op4 = any(length == [achar(24)//ZEROS, ZEROS//achar(24), achar(48)//ZEROS, ZEROS//achar(48), ZEROS//achar(0)])
  end function is_binary_op4

  !> The format of a loaded file, whose lines are before the first one again.
  pure subroutine recognise_format(file, format)
    type(text_file), intent(inout) :: file
    integer, intent(out) :: format
    logical :: exists

    format = FUGE_STIFFNESS_ABAQUS
    do
      call file%advance(exists)
      if (.not. exists) exit
      call recognise_line(file%content(file%first:file%last), file%line, format)
      if (format /= FUGE_STIFFNESS_ANY) exit
    end do
    if (format == FUGE_STIFFNESS_ANY) format = FUGE_STIFFNESS_ABAQUS
    call file%rewind()
  end subroutine recognise_format

  !> The format to which line `number` belongs; FUGE_STIFFNESS_ANY if it is blank or a comment, which tells nothing.
  pure subroutine recognise_line(line, number, format)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    integer, intent(out) :: format
    character(len=14) :: word

    format = FUGE_STIFFNESS_ANY
    word = line
    word = lower_case(word)
    if (number == 1 .and. word == '%%matrixmarket') then
      format = FUGE_STIFFNESS_MATRIX_MARKET
    else if (is_comment(line)) then
      return
    else if (is_op4_header(line)) then
      format = FUGE_STIFFNESS_OP4
    else if (verify(word(1:1), 'abcdefghijklmnopqrstuvwxyz') == 0) then
      ! A word of bulk data; DMIG need not be the first one.
      format = FUGE_STIFFNESS_DMIG
    else
      format = FUGE_STIFFNESS_ABAQUS
    end if
  end subroutine recognise_line

end module fuge_stiffness_formats
