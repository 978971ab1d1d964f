!> A text file read at once, handed out line by line.
module fuge_text_reader
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_status, only: fuge_info, report, FUGE_MESSAGE_LENGTH, FUGE_ERR_FILE, FUGE_ERR_MEMORY
  use fuge_number_text, only: text
  implicit none
  private

  public :: named

  !> Of a path a message shows no more than its end.
  integer, parameter :: PATH_LENGTH = 100
  character, parameter :: LINE_FEED = achar(10)
  character(len=*), parameter :: BYTE_ORDER_MARK = char(239)//char(187)//char(191)

  !> The bytes of a file and a place in them.
  type, public :: text_file
    !> The path for messages.
    character(len=:), allocatable :: name
    character(len=:), allocatable :: content
    !> Number of the present line, content(first:last), its line feed left out.
    integer :: line = 0
    integer(int64) :: first = 1_int64
    integer(int64) :: last = -1_int64
  contains
    procedure :: load
    procedure :: advance
    procedure :: count_lines
    procedure :: refuse
  end type text_file

contains

  !> The path for a message: its end, in quotes.
  pure function named(path) result(name)
    character(len=*), intent(in) :: path
    character(len=merge(PATH_LENGTH + 4, len_trim(path) + 2, len_trim(path) > PATH_LENGTH)) :: name
    integer :: length

    length = len_trim(path)
    if (length > PATH_LENGTH) then
      name = '"..'//path(length - PATH_LENGTH + 1:length)//'"'
    else
      name = '"'//path(:length)//'"'
    end if
  end function named

  !> The whole file at once; it is closed again in any case. Errors: FUGE_ERR_FILE,
  !> FUGE_ERR_MEMORY.
  subroutine load(self, path, info)
    class(text_file), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    character(len=FUGE_MESSAGE_LENGTH) :: reason
    integer(int64) :: bytes
    integer :: file, status

    self%name = named(path)
    self%content = ''
    if (len_trim(path) == 0) then
      call report(info, FUGE_ERR_FILE, 'the path is blank: give the name of a file')
      return
    end if
    reason = ''
    call lock(LOCK_FILES)
    open (newunit=file, file=path, status='old', action='read', access='stream', form='unformatted', &
          iostat=status, iomsg=reason)
    if (status /= 0) then
      call unlock(LOCK_FILES)
      call report(info, FUGE_ERR_FILE, self%name//' cannot be opened: '//trim(reason))
      return
    end if
    inquire (unit=file, size=bytes)
    if (bytes < 0_int64) then
      call report(info, FUGE_ERR_FILE, self%name//' has no size: only a regular file can be read')
    else if (bytes > 0_int64) then
      deallocate (self%content)
      allocate (character(len=bytes) :: self%content, stat=status)
      if (status == 0) then
        read (file, iostat=status, iomsg=reason) self%content
        if (status /= 0) call report(info, FUGE_ERR_FILE, self%name//' cannot be read: '//trim(reason))
      else
        call report(info, FUGE_ERR_MEMORY, self%name//': no memory for its '//text(real(bytes, dp))//' bytes')
      end if
    end if
    close (file, iostat=status)
    call unlock(LOCK_FILES)
    if (status /= 0 .and. .not. info%failed()) call report(info, FUGE_ERR_FILE, self%name//' cannot be closed')
    if (info%failed()) return
    if (index(self%content, BYTE_ORDER_MARK) == 1) self%last = 2_int64
  end subroutine load

  !> Go to the next line; `found` is false at the end of the file.
  pure subroutine advance(self, found)
    class(text_file), intent(inout) :: self
    logical, intent(out) :: found
    integer(int64) :: next

    next = self%last + 2_int64
    found = next <= len(self%content, kind=int64)
    if (.not. found) return
    self%line = self%line + 1
    self%first = next
    do while (next <= len(self%content, kind=int64))
      if (self%content(next:next) == LINE_FEED) exit
      next = next + 1_int64
    end do
    self%last = next - 1_int64
  end subroutine advance

  !> Lines in the whole file, an empty last one included.
  pure function count_lines(self) result(lines)
    class(text_file), intent(in) :: self
    integer :: lines
    integer(int64) :: k

    lines = 1
    do k = 1_int64, len(self%content, kind=int64)
      if (self%content(k:k) == LINE_FEED) lines = lines + 1
    end do
  end function count_lines

  !> Report what is wrong with the present line (FUGE_ERR_FILE).
  pure subroutine refuse(self, reason, info)
    class(text_file), intent(in) :: self
    character(len=*), intent(in) :: reason
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_FILE, self%name//', line '//text(self%line)//': '//reason)
  end subroutine refuse

end module fuge_text_reader
