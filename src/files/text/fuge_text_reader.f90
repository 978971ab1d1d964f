!> A text file that is loaded as a whole and read line by line.
module fuge_text_reader
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: quoted_path

  !> Number of characters of a path that messages show, from its end.
  integer, parameter :: PATH_LENGTH = 100
  !> Length of a message of the run-time library, without the path in it.
  integer, parameter, public :: REASON_LENGTH = 200
  character, parameter :: LINE_FEED = achar(10)
  character(len=*), parameter :: BYTE_ORDER_MARK = char(239)//char(187)//char(191)

  !> The bytes of a file, and the line that is being read.
  type, public :: text_file
    !> The path as messages quote it.
    character(len=:), allocatable :: name
    character(len=:), allocatable :: content
    !> Number of the present line, content(first:last) without its line feed.
    integer :: line = 0
    integer(int64) :: first = 1_int64
    integer(int64) :: last = -1_int64
  contains
    procedure :: load
    procedure :: advance
    procedure :: count_lines
    procedure :: rewind
    procedure :: refuse
  end type text_file

  interface
    !> 1 if the path leads to a device, a pipe or a folder, else 0 (fuge_output_file.c).
    function input_is_special(path) bind(c, name='fuge_input_is_special') result(special)
      import :: c_char, c_int
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: special
    end function input_is_special
  end interface

contains

  !> The path for a message: in quotes, only the end of a long one, control characters as ?.
  pure function quoted_path(path) result(name)
    character(len=*), intent(in) :: path
    character(len=merge(PATH_LENGTH + 4, len_trim(path) + 2, len_trim(path) > PATH_LENGTH)) :: name
    integer :: k, length

    length = len_trim(path)
    if (length > PATH_LENGTH) then
      name = '"..'//path(length - PATH_LENGTH + 1:length)//'"'
    else
      name = '"'//path(:length)//'"'
    end if
    do k = 1, len(name)
      if (iachar(name(k:k)) < 32 .or. iachar(name(k:k)) == 127) name(k:k) = '?'
    end do
  end function quoted_path

  !> The reason in an I/O message of the run-time library, without the path: the messages of
  !> gfortran begin with Cannot open file 'path', which the library's own messages say already.
  pure function io_reason(message) result(reason)
    character(len=*), intent(in) :: message
    character(len=len(message)) :: reason
    integer :: quote

    reason = message
    quote = index(message, ''': ', back=.true.)
    if (index(message, 'Cannot open file ') == 1 .and. quote > 0) reason = message(quote + 3:)
  end function io_reason

  !> Load a whole file. It is closed again in any case. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine load(self, path, info)
    class(text_file), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    character(len=len(path) + REASON_LENGTH) :: reason
    integer :: file, status

    self%name = quoted_path(path)
    self%content = ''
    if (len_trim(path) == 0) then
      call report(info, FUGE_ERR_FILE, 'the path is blank: pass the path of a file')
      return
    else if (input_is_special(trim(path)//c_null_char) /= 0_c_int) then
      call report(info, FUGE_ERR_FILE, self%name//' is a device, a pipe or a folder: only a regular file can be read')
      return
    end if
    reason = ''
    call lock(LOCK_FILES)
    open (newunit=file, file=path, status='old', action='read', access='stream', form='unformatted', &
          iostat=status, iomsg=reason)
    if (status == 0) then
      call read_content(file, self%name, self%content, info)
      close (file, iostat=status)
      if (status /= 0 .and. .not. info%failed()) call report(info, FUGE_ERR_FILE, self%name//' cannot be closed')
    else
      call report(info, FUGE_ERR_FILE, self%name//' cannot be opened: '//trim(io_reason(reason)))
    end if
    call unlock(LOCK_FILES)
    if (.not. info%failed()) call self%rewind()
  end subroutine load

  !> Read all bytes of an open file, whose name messages quote as `name`. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine read_content(file, name, content, info)
    integer, intent(in) :: file
    character(len=*), intent(in) :: name
    character(len=:), allocatable, intent(inout) :: content
    type(fuge_info), intent(inout) :: info
    character(len=REASON_LENGTH) :: reason
    integer(int64) :: bytes
    integer :: status

    inquire (unit=file, size=bytes)
    if (bytes < 0_int64) then
      call report(info, FUGE_ERR_FILE, name//' has no size: only a regular file can be read')
    else if (bytes > 0_int64) then
      deallocate (content)
      allocate (character(len=bytes) :: content, stat=status)
      if (status == 0) then
        reason = ''
        read (file, iostat=status, iomsg=reason) content
        if (status /= 0) call report(info, FUGE_ERR_FILE, name//' cannot be read: '//trim(reason))
      else
        call report(info, FUGE_ERR_MEMORY, name//': no memory for its '//text(real(bytes, dp))//' bytes')
      end if
    end if
  end subroutine read_content

  !> Go back before the first line, which begins after a byte order mark.
  pure subroutine rewind(self)
    class(text_file), intent(inout) :: self

    self%line = 0
    self%first = 1_int64
    self%last = -1_int64
    if (len(self%content, kind=int64) < 3_int64) return
    if (self%content(:3) == BYTE_ORDER_MARK) self%last = 2_int64
  end subroutine rewind

  !> Advance to the next line; `exists` is false at the end of the file.
  pure subroutine advance(self, exists)
    class(text_file), intent(inout) :: self
    logical, intent(out) :: exists
    integer(int64) :: next

    next = self%last + 2_int64
    exists = next <= len(self%content, kind=int64)
    if (.not. exists) return
    self%line = self%line + 1
    self%first = next
    do while (next <= len(self%content, kind=int64))
      if (self%content(next:next) == LINE_FEED) exit
      next = next + 1_int64
    end do
    self%last = next - 1_int64
  end subroutine advance

  !> Number of lines in the whole file, an empty last one included.
  pure function count_lines(self) result(lines)
    class(text_file), intent(in) :: self
    integer :: lines
    integer(int64) :: k

    lines = 1
    do k = 1_int64, len(self%content, kind=int64)
      if (self%content(k:k) == LINE_FEED) lines = lines + 1
    end do
  end function count_lines

  !> Report that the present line cannot be used (FUGE_ERR_FILE), and the `reason`. An empty file has no line.
  pure subroutine refuse(self, reason, info)
    class(text_file), intent(in) :: self
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: info

    if (self%line < 1) then
      call report(info, FUGE_ERR_FILE, self%name//': '//reason)
    else
      call report(info, FUGE_ERR_FILE, self%name//', line '//text(self%line)//': '//reason)
    end if
  end subroutine refuse

end module fuge_text_reader
