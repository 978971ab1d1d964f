!> Tables as text: CSV with comments after #.
module text_table
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use fuge, only: fuge_info, FUGE_ERR_FILE
  implicit none
  private

  public :: check_path

  !> A file, or standard output. After the first error nothing more is written, and `finish` reports it.
  type, public :: table
    integer :: unit = output_unit
    integer :: failure = 0
    integer(int64) :: bytes = 0_int64
    character(len=:), allocatable :: path
    character(len=256) :: reason = ''
  contains
    procedure :: create
    procedure :: put
    procedure :: finish
  end type table

contains

  !> Replace the file at `path`; standard output if that is empty. Error: FUGE_ERR_FILE.
  subroutine create(self, path, info)
    class(table), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    self%path = path
    if (len_trim(path) == 0) return
    ! A stream, because flang's run-time library aborts on a full disk when it closes a formatted file.
    open (newunit=self%unit, file=path, status='replace', action='write', access='stream', form='unformatted', &
          iostat=self%failure, iomsg=self%reason)
    if (self%failure /= 0) call refuse(self, 'opened', info)
  end subroutine create

  subroutine put(self, line)
    class(table), intent(inout) :: self
    character(len=*), intent(in) :: line

    if (self%failure /= 0) return
    if (self%unit == output_unit) then
      write (self%unit, '(a)') trim(adjustl(line))
    else
      write (self%unit, iostat=self%failure, iomsg=self%reason) trim(adjustl(line))//new_line('a')
    end if
    self%bytes = self%bytes + len_trim(adjustl(line)) + 1
  end subroutine put

  !> Close the file. Error: FUGE_ERR_FILE if it is not complete.
  subroutine finish(self, info)
    class(table), intent(inout) :: self
    type(fuge_info), intent(inout) :: info

    if (self%unit == output_unit) return
    if (self%failure == 0) close (self%unit, iostat=self%failure, iomsg=self%reason)
    if (self%failure == 0) call compare_size(self)
    if (self%failure == 0) return
    ! After a failed write it is still open.
    close (self%unit, iostat=self%failure)
    call empty(self%path)
    call refuse(self, 'written', info)
  end subroutine finish

  !> Leave no part of a table that could be taken for the whole.
  subroutine empty(path)
    character(len=*), intent(in) :: path
    integer :: status, unit

    open (newunit=unit, file=path, status='replace', action='write', access='stream', form='unformatted', iostat=status)
    if (status == 0) close (unit, iostat=status)
  end subroutine empty

  !> Refuse, before all is computed, a path at which no file can be made. Error: FUGE_ERR_FILE.
  subroutine check_path(path, info)
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    logical :: exists

    if (len_trim(path) == 0) return
    inquire (file=path, exist=exists)
    if (exists) return
    call csv%create(path, info)
    if (.not. info%failed()) close (csv%unit, status='delete', iostat=csv%failure)
  end subroutine check_path

  !> On a full disk a run-time library may report nothing: then the file is too short.
  subroutine compare_size(self)
    class(table), intent(inout) :: self
    integer(int64) :: bytes

    open (newunit=self%unit, file=self%path, status='old', action='read', iostat=self%failure, iomsg=self%reason)
    if (self%failure /= 0) return
    inquire (unit=self%unit, size=bytes)
    close (self%unit)
    if (bytes >= self%bytes) return
    self%failure = 1
    self%reason = 'it is shorter than it should be, the disk may be full'
  end subroutine compare_size

  subroutine refuse(self, verb, info)
    class(table), intent(in) :: self
    character(len=*), intent(in) :: verb
    type(fuge_info), intent(inout) :: info

    info%status = FUGE_ERR_FILE
    info%message = '"'//self%path//'" cannot be '//verb//': '//trim(self%reason)
  end subroutine refuse

end module text_table
