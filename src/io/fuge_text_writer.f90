!> A text file that is written through a buffer. Its size is checked at the end, because on a full
!> disk a run-time library may report no error, and as its size the one it should have had.
module fuge_text_writer
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_locks, only: lock, unlock, LOCK_FILES
  use fuge_status, only: fuge_info, report, FUGE_MESSAGE_LENGTH, FUGE_ERR_FILE
  use fuge_text_reader, only: io_reason, quoted_path, REASON_LENGTH
  implicit none
  private

  !> Bytes that are written at a time.
  integer, parameter :: BUFFER_LENGTH = 16384
  character, parameter :: LINE_FEED = achar(10)

  !> A new file. After the first error nothing more is written, and `finish` reports the error.
  type, public :: text_output
    private
    integer :: unit = 0
    integer :: failure = 0
    integer :: used = 0
    integer(int64) :: bytes = 0_int64
    character(len=:), allocatable :: path
    character(len=FUGE_MESSAGE_LENGTH) :: reason = ''
    character(len=BUFFER_LENGTH) :: buffer
  contains
    procedure :: create
    procedure :: put
    procedure :: finish
    procedure, private :: write_buffer
  end type text_output

contains

  !> Create a file at `path`, or replace it. Error: FUGE_ERR_FILE.
  subroutine create(self, path, info)
    class(text_output), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    character(len=len(path) + REASON_LENGTH) :: reason
    integer :: status

    self%path = path
    reason = ''
    if (len_trim(path) == 0) then
      call report(info, FUGE_ERR_FILE, 'the path is blank: pass the path of a file')
      return
    end if
    call lock(LOCK_FILES)
    open (newunit=self%unit, file=path, status='replace', action='write', access='stream', form='unformatted', &
          iostat=status, iomsg=reason)
    call unlock(LOCK_FILES)
    if (status /= 0) call report(info, FUGE_ERR_FILE, quoted_path(path)//' cannot be opened: ' &
                                 //trim(io_reason(reason)))
  end subroutine create

  !> Add a line, shorter than the buffer, without leading and trailing blanks.
  subroutine put(self, line)
    class(text_output), intent(inout) :: self
    character(len=*), intent(in) :: line
    integer :: first, length

    first = max(1, verify(line, ' '))
    length = len_trim(line) - first + 2
    if (self%used + length > BUFFER_LENGTH) call self%write_buffer()
    self%buffer(self%used + 1:self%used + length - 1) = line(first:)
    self%buffer(self%used + length:self%used + length) = LINE_FEED
    self%used = self%used + length
  end subroutine put

  !> Write and empty the buffer, unless an error has occurred.
  subroutine write_buffer(self)
    class(text_output), intent(inout) :: self
    integer :: status

    if (self%failure == 0) then
      write (self%unit, iostat=status, iomsg=self%reason) self%buffer(:self%used)
      if (status /= 0) self%failure = status
    end if
    self%bytes = self%bytes + int(self%used, int64)
    self%used = 0
  end subroutine write_buffer

  !> Write what is left and close the file. Error: FUGE_ERR_FILE if the file is not complete.
  subroutine finish(self, info)
    class(text_output), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    character(len=FUGE_MESSAGE_LENGTH) :: reason
    integer(int64) :: actual
    integer :: status

    call self%write_buffer()
    call lock(LOCK_FILES)
    close (self%unit, iostat=status, iomsg=reason)
    call unlock(LOCK_FILES)
    if (self%failure == 0 .and. status /= 0) then
      self%failure = status
      self%reason = reason
    end if
    actual = self%bytes
    if (self%failure == 0) actual = file_size(self%path)
    if (actual /= self%bytes) then
      self%failure = 1
      self%reason = 'its size is not what was written; the disk may be full'
    end if
    if (self%failure /= 0) call report(info, FUGE_ERR_FILE, quoted_path(self%path)//' cannot be written: ' &
                                       //trim(self%reason))
  end subroutine finish

  !> Size of a file in bytes, 0 if it cannot be read. Inquires by unit, because flang 22 leaks
  !> memory when it inquires by name.
  function file_size(path) result(bytes)
    character(len=*), intent(in) :: path
    integer(int64) :: bytes
    integer :: status, unit

    bytes = 0_int64
    call lock(LOCK_FILES)
    open (newunit=unit, file=path, status='old', action='read', access='stream', form='unformatted', iostat=status)
    if (status == 0) then
      inquire (unit=unit, size=bytes)
      close (unit, iostat=status)
      if (status /= 0) bytes = 0_int64
    end if
    call unlock(LOCK_FILES)
  end function file_size

end module fuge_text_writer
