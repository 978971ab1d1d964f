!> Tables as text: CSV with comments after #.
module text_table
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use file_access, only: close_table, empty_file, open_table, put_line, refuse_file
  use fuge_core, only: fuge_info
  implicit none
  private

  !> A file, or standard output. After the first error nothing more is written, and `finish` reports it.
  type, public :: table
    private
    type(c_ptr) :: file = c_null_ptr
    integer :: error = 0
    character(len=:), allocatable :: path
  contains
    procedure :: create
    procedure :: put
    procedure :: finish
  end type table

contains

  !> Replace the file at `path`; standard output, which can be a table once, if that is empty. Error: FUGE_ERR_FILE.
  subroutine create(self, path, info)
    class(table), intent(out) :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(inout) :: info

    self%path = trim(path)
    call open_table(self%path, self%file, self%error)
    if (self%error /= 0) call refuse_file(self%path, 'opened', self%error, info)
  end subroutine create

  !> Add a line, without the blanks at its end.
  subroutine put(self, line)
    class(table), intent(inout) :: self
    character(len=*), intent(in) :: line

    if (self%error == 0) call put_line(self%file, trim(line), self%error)
  end subroutine put

  !> Close the file, which is empty if it cannot be complete. Error: FUGE_ERR_FILE.
  subroutine finish(self, info)
    class(table), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    integer :: error

    call close_table(self%file, error)
    if (self%error == 0) self%error = error
    if (self%error == 0) return
    if (len(self%path) > 0) call empty_file(self%path)
    call refuse_file(self%path, 'written', self%error, info)
  end subroutine finish

end module text_table
