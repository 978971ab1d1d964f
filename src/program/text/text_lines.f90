!> Lines of a file: job files and tables of supports and loads.
module text_lines
  use file_access, only: is_endless
  use fuge_core, only: fuge_info, FUGE_ERR_FILE
  use number_words, only: number_text
  implicit none
  private

  character, parameter :: TAB = achar(9), CARRIAGE_RETURN = achar(13)
  character(len=*), parameter :: BYTE_ORDER_MARK = char(239)//char(187)//char(191)

  type, public :: line_reader
    !> The present line without comment and blanks at its ends, tabs as blanks.
    character(len=:), allocatable :: line
    integer, private :: unit = -1
    integer, private :: number = 0
    character(len=:), allocatable, private :: path
  contains
    procedure :: open => open_lines
    procedure :: next
    procedure :: source
    procedure :: close => close_lines
  end type line_reader

contains

  !> Error: FUGE_ERR_FILE.
  subroutine open_lines(self, path, info)
    class(line_reader), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    character(len=200) :: reason
    integer :: status

    self%path = path
    self%number = 0
    if (is_endless(path)) then
      info%status = FUGE_ERR_FILE
      info%message = '"'//path//'" is a device or a folder: a file with lines is needed'
      return
    end if
    open (newunit=self%unit, file=path, status='old', action='read', iostat=status, iomsg=reason)
    if (status == 0) return
    self%unit = -1
    info%status = FUGE_ERR_FILE
    ! gfortran's message has the path again, in quotes.
    info%message = '"'//path//'" cannot be opened: '//trim(reason(index(reason, ''': ', back=.true.) &
      + merge(3, 1, index(reason, ''': ') > 0):))
  end subroutine open_lines

  !> The next line that is neither blank nor a comment. Error: FUGE_ERR_FILE.
  subroutine next(self, exists, info)
    class(line_reader), intent(inout) :: self
    logical, intent(out) :: exists
    type(fuge_info), intent(inout) :: info
    character(len=200) :: reason
    integer :: status

    exists = .false.
    do while (.not. exists)
      call read_line(self, status, reason)
      if (status < 0) return
      if (status > 0) then
        info%status = FUGE_ERR_FILE
        info%message = self%source()//' cannot be read: '//trim(reason)
        return
      end if
      if (self%number == 1 .and. index(self%line, BYTE_ORDER_MARK) == 1) &
        self%line = self%line(len(BYTE_ORDER_MARK) + 1:)
      call clean(self%line)
      exists = len(self%line) > 0
    end do
  end subroutine next

  !> The next line as it is; `status` is that of the read, negative after the last line.
  subroutine read_line(self, status, reason)
    class(line_reader), intent(inout) :: self
    integer, intent(out) :: status
    character(len=*), intent(inout) :: reason
    character(len=256) :: piece
    integer :: length

    self%line = ''
    self%number = self%number + 1
    do
      read (self%unit, '(a)', advance='no', size=length, iostat=status, iomsg=reason) piece
      if (status > 0 .or. is_iostat_end(status)) exit
      self%line = self%line//piece(:length)
      if (is_iostat_eor(status)) exit
    end do
    if (is_iostat_eor(status) .or. (is_iostat_end(status) .and. len(self%line) > 0)) status = 0
  end subroutine read_line

  !> Drop comments and the blanks at both ends.
  pure subroutine clean(line)
    character(len=:), allocatable, intent(inout) :: line
    integer :: k

    do k = 1, len(line)
      if (line(k:k) == TAB .or. line(k:k) == CARRIAGE_RETURN) line(k:k) = ' '
    end do
    k = scan(line, '#')
    if (k > 0) line = line(:k - 1)
    k = index(line, '**')
    if (k == 1) line = ''
    line = trim(adjustl(line))
  end subroutine clean

  !> The file and the number of the present line, for messages.
  pure function source(self)
    class(line_reader), intent(in) :: self
    character(len=:), allocatable :: source

    source = '"'//self%path//'", line '//number_text(self%number)
  end function source

  subroutine close_lines(self)
    class(line_reader), intent(inout) :: self

    if (self%unit /= -1) close (self%unit)
    self%unit = -1
  end subroutine close_lines

end module text_lines
