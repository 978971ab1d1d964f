!> A file of lines and numbers that is written through a buffer, by the C library: Fortran's `close` does not release a
!> file on a full disk.
module fuge_text_writer
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_FILE
  use fuge_quoted_text, only: quoted_path
  implicit none
  private

  !> Bytes that are written at a time.
  integer, parameter :: BUFFER_LENGTH = 16384
  !> Length of the text of an error.
  integer, parameter :: REASON_LENGTH = 200
  character, parameter :: LINE_FEED = achar(10)

  !> A new file. After the first error nothing more is written, and `finish` reports the error.
  type, public :: text_output
    private
    type(c_ptr) :: file = c_null_ptr
    integer(c_int) :: failure = 0_c_int
    integer :: used = 0
    character(len=:), allocatable :: path
    character(len=:), allocatable :: buffer
  contains
    procedure :: create
    procedure :: put
    procedure :: put_bytes
    procedure :: put_reals
    procedure :: finish
    procedure, private :: write_buffer
  end type text_output

  ! The procedures of fuge_output_file.c.
  interface
    function output_create(path, error) bind(c, name='fuge_output_create') result(file)
      import :: c_char, c_int, c_ptr
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), intent(out) :: error
      type(c_ptr) :: file
    end function output_create

    function output_write(file, bytes, count) bind(c, name='fuge_output_write') result(error)
      import :: c_char, c_int, c_ptr, c_size_t
      type(c_ptr), intent(in), value :: file
      character(kind=c_char), intent(in) :: bytes(*)
      integer(c_size_t), intent(in), value :: count
      integer(c_int) :: error
    end function output_write

    function output_close(file) bind(c, name='fuge_output_close') result(error)
      import :: c_int, c_ptr
      type(c_ptr), intent(in), value :: file
      integer(c_int) :: error
    end function output_close

    subroutine output_empty(path) bind(c, name='fuge_output_empty')
      import :: c_char
      character(kind=c_char), intent(in) :: path(*)
    end subroutine output_empty

    subroutine output_reason(error, text, length) bind(c, name='fuge_output_reason')
      import :: c_char, c_int, c_size_t
      integer(c_int), intent(in), value :: error
      character(kind=c_char), intent(out) :: text(*)
      integer(c_size_t), intent(in), value :: length
    end subroutine output_reason
  end interface

contains

  !> Create a file at `path`, or replace it. Errors: FUGE_ERR_FILE, FUGE_ERR_MEMORY.
  subroutine create(self, path, info)
    class(text_output), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    integer :: stat

    self%path = trim(path)
    if (len(self%path) == 0) then
      call report(info, FUGE_ERR_FILE, 'the path is blank: pass the path of a file')
      return
    end if
    allocate (character(len=BUFFER_LENGTH) :: self%buffer, stat=stat)
    call require_memory(stat, 'the buffer of a file', info)
    if (stat /= 0) return
    self%file = output_create(self%path//c_null_char, self%failure)
    if (self%failure /= 0_c_int) call report(info, FUGE_ERR_FILE, quoted_path(path)//' cannot be opened: ' &
                                             //trim(reason(self%failure)))
  end subroutine create

  !> The text of an error of the C library.
  function reason(failure) result(text)
    integer(c_int), intent(in) :: failure
    character(len=REASON_LENGTH) :: text

    call output_reason(failure, text, int(len(text), c_size_t))
  end function reason

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

  !> Add bytes as they are, at most as many as the buffer holds.
  subroutine put_bytes(self, bytes)
    class(text_output), intent(inout) :: self
    character(len=*), intent(in) :: bytes

    if (self%used + len(bytes) > BUFFER_LENGTH) call self%write_buffer()
    self%buffer(self%used + 1:self%used + len(bytes)) = bytes
    self%used = self%used + len(bytes)
  end subroutine put_bytes

  !> Add numbers as this machine stores them.
  subroutine put_reals(self, values)
    class(text_output), intent(inout) :: self
    real(dp), intent(in) :: values(:)
    integer, parameter :: BLOCK = BUFFER_LENGTH/8
    integer :: k, last

    do k = 1, size(values), BLOCK
      last = min(size(values) - k, BLOCK - 1) + k
      call self%write_buffer()
      self%used = 8*(last - k + 1)
      self%buffer(:self%used) = transfer(values(k:last), self%buffer(:self%used))
    end do
  end subroutine put_reals

  !> Write and empty the buffer, unless an error has occurred.
  subroutine write_buffer(self)
    class(text_output), intent(inout) :: self

    if (self%failure == 0_c_int .and. self%used > 0) &
      self%failure = output_write(self%file, self%buffer, int(self%used, c_size_t))
    self%used = 0
  end subroutine write_buffer

  !> Write what is left and close the file. Error: FUGE_ERR_FILE if that fails; the file is then empty.
  subroutine finish(self, info)
    class(text_output), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    integer(c_int) :: closing

    if (.not. c_associated(self%file)) return
    call self%write_buffer()
    closing = output_close(self%file)
    self%file = c_null_ptr
    if (self%failure == 0_c_int) self%failure = closing
    if (self%failure == 0_c_int) return
    call output_empty(self%path//c_null_char)
    call report(info, FUGE_ERR_FILE, quoted_path(self%path)//' cannot be written: '//trim(reason(self%failure)))
  end subroutine finish

end module fuge_text_writer
