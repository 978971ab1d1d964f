!> Files of surfaces that are not text: which program or instrument wrote them, told by their first bytes.
module fuge_instrument_files
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE
  use fuge_text_numbers, only: lower_case
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: refuse_instrument

  !> What a format is called, and the first bytes by which a file of it is known.
  type :: signature
    character(len=44) :: name
    character(len=16) :: bytes
    integer :: length
  end type signature

  character(len=*), parameter :: READERS = 'SurfaceTopography or surfalize'
  character(len=*), parameter :: HDF5 = char(137)//'HDF'//char(13)//char(10)//char(26)//char(10)
  type(signature), parameter :: SIGNATURES(14) = [ &
    signature('a Digital Surf file (sur)', 'DIGITAL SURF', 12), &
    signature('a Digital Surf file (sur)', 'DSCOMPRESSED', 12), &
    signature('a Keyence file (vk3)', 'VK3', 3), &
    signature('a Keyence file (vk4)', 'VK4', 3), &
    signature('a Keyence file (vk6)', 'VK6', 3), &
    signature('a Keyence file (vk7)', 'VK7', 3), &
    signature('a Keyence file (zon)', 'KPK0', 4), &
    signature('a Gwyddion file (gwy)', 'GWYP', 4), &
    signature('an Alicona file (al3d)', 'AliconaImaging', 14), &
    signature('a Zygo file (dat)', char(136)//char(27)//char(3), 3), &
    signature('a Wyko file (opd)', char(1)//char(0)//'Directory', 11), &
    signature('a Bruker file (opdx)', 'VCA DATA', 8), &
    signature('an Olympus file (oir)', 'OLYMPUSRAWFORMAT', 16), &
    signature('an HDF5 file, as Zygo writes them (datx)', HDF5, 8)]
  !> The first bytes of an archive, and of text in UTF-16.
  character(len=*), parameter :: ZIP = 'PK'//char(3)//char(4)
  character(len=*), parameter :: UTF_16(2) = [char(255)//char(254), char(254)//char(255)]
  !> Bytes that are examined at the beginning: a file that is not text has one among them that no text has.
  integer(int64), parameter :: EXAMINED = 4096_int64
  integer, parameter :: FIRST_PRINTABLE = 32, TAB = 9, CARRIAGE_RETURN = 13, END_OF_FILE = 26

contains

  !> What a file is that is not text, with its article, such as "an x3p file"; blank for text.
  !>
  !> `name` as messages quote the path: an archive is told by its ending.
  pure function instrument_format(name, content) result(format)
    character(len=*), intent(in) :: name, content
    character(len=48) :: format
    integer :: k

    format = ''
    if (begins_with(content, ZIP)) then
      format = archive_format(name)
      return
    end if
    ! Headers of text may begin with the same letters.
    if (is_text(content)) return
    do k = 1, size(SIGNATURES)
      if (.not. begins_with(content, SIGNATURES(k)%bytes(:SIGNATURES(k)%length))) cycle
      format = SIGNATURES(k)%name
      return
    end do
    do k = 1, size(UTF_16)
      if (begins_with(content, UTF_16(k))) format = 'text in UTF-16'
    end do
    if (len_trim(format) == 0) format = 'a binary file'
  end function instrument_format

  pure function begins_with(content, bytes) result(begins)
    character(len=*), intent(in) :: content, bytes
    logical :: begins

    begins = len(content, kind=int64) >= len(bytes, kind=int64)
    if (begins) begins = content(:len(bytes)) == bytes
  end function begins_with

  !> Which kind of archive, by the ending of a path in quotes.
  pure function archive_format(name) result(format)
    character(len=*), intent(in) :: name
    character(len=48) :: format
    character(len=5) :: ending

    ending = lower_case(name(max(len(name) - 5, 1):len(name) - 1))
    format = 'a ZIP archive'
    if (index(ending, '.x3p') > 0) format = 'an x3p file (ISO 25178-72)'
    if (ending == '.plux') format = 'a Sensofar file (plux)'
  end function archive_format

  !> Is the beginning text? It has no control characters but tabs, line ends, form feeds and DOS's end-of-file mark.
  pure function is_text(content)
    character(len=*), intent(in) :: content
    logical :: is_text
    integer(int64) :: k
    integer :: code

    is_text = .true.
    do k = 1_int64, min(len(content, kind=int64), EXAMINED)
      code = iachar(content(k:k))
      if (code < 0 .or. code >= FIRST_PRINTABLE .or. code == END_OF_FILE) cycle
      is_text = code >= TAB .and. code <= CARRIAGE_RETURN
      if (.not. is_text) return
    end do
  end function is_text

  !> Refuse a file that is not text (FUGE_ERR_FILE); the message says how its heights can be read.
  pure subroutine refuse_instrument(file, info)
    type(text_file), intent(in) :: file
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: format

    format = trim(instrument_format(file%name, file%content))
    if (len(format) == 0) return
    if (format == 'text in UTF-16') then
      call report(info, FUGE_ERR_FILE, file%name//' is '//format//': save it as plain text or UTF-8')
    else if (format == 'a ZIP archive') then
      call report(info, FUGE_ERR_FILE, file%name//' is '//format//': unpack it and pass the file of heights in it')
    else
      call report(info, FUGE_ERR_FILE, file%name//' is '//format//', which fuge does not read: read it with '//READERS &
                  //' in Python and pass the heights (Python tutorial, "Measured surfaces")')
    end if
  end subroutine refuse_instrument

end module fuge_instrument_files
