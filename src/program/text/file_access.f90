!> What Fortran does not know of files: which paths lead to the same one, and whether all that was written is there.
module file_access
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_ptr, c_size_t
  use fuge_core, only: fuge_info, FUGE_ERR_FILE
  implicit none
  private

  public :: close_table, empty_file, is_endless, open_table, prepare_file, put_line, refuse_file, remove_file, same_file

  ! The procedures of file_access.c.
  interface
    function c_same_file(path, other) bind(c, name='program_same_file') result(same)
      import :: c_char, c_int
      character(kind=c_char), intent(in) :: path(*), other(*)
      integer(c_int) :: same
    end function c_same_file

    function c_prepare_file(path, made) bind(c, name='program_prepare_file') result(error)
      import :: c_char, c_int
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), intent(out) :: made
      integer(c_int) :: error
    end function c_prepare_file

    function c_is_endless(path) bind(c, name='program_is_endless') result(endless)
      import :: c_char, c_int
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: endless
    end function c_is_endless

    subroutine c_remove_file(path) bind(c, name='program_remove_file')
      import :: c_char
      character(kind=c_char), intent(in) :: path(*)
    end subroutine c_remove_file

    subroutine c_empty_file(path) bind(c, name='program_empty_file')
      import :: c_char
      character(kind=c_char), intent(in) :: path(*)
    end subroutine c_empty_file

    function c_open_table(path, error) bind(c, name='program_open_table') result(file)
      import :: c_char, c_int, c_ptr
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), intent(out) :: error
      type(c_ptr) :: file
    end function c_open_table

    function c_put_line(file, line, length) bind(c, name='program_put_line') result(error)
      import :: c_char, c_int, c_ptr, c_size_t
      type(c_ptr), intent(in), value :: file
      character(kind=c_char), intent(in) :: line(*)
      integer(c_size_t), intent(in), value :: length
      integer(c_int) :: error
    end function c_put_line

    function c_close_table(file) bind(c, name='program_close_table') result(error)
      import :: c_int, c_ptr
      type(c_ptr), intent(in), value :: file
      integer(c_int) :: error
    end function c_close_table

    subroutine c_reason(error, text, length) bind(c, name='program_reason')
      import :: c_char, c_int, c_size_t
      integer(c_int), intent(in), value :: error
      character(kind=c_char), intent(out) :: text(*)
      integer(c_size_t), intent(in), value :: length
    end subroutine c_reason
  end interface

contains

  !> Do two paths lead to one file, by links or by other names? An empty path is standard output. Devices and pipes are
  !> no files.
  function same_file(path, other) result(same)
    character(len=*), intent(in) :: path, other
    logical :: same

    same = c_same_file(trim(path)//c_null_char, trim(other)//c_null_char) /= 0_c_int
  end function same_file

  !> Make the file at `path` if there is none, `made`, and leave one that is there as it is.
  !> Error: FUGE_ERR_FILE if nothing can be written there.
  subroutine prepare_file(path, made, info)
    character(len=*), intent(in) :: path
    logical, intent(out) :: made
    type(fuge_info), intent(inout) :: info
    integer(c_int) :: error, is_new

    error = c_prepare_file(trim(path)//c_null_char, is_new)
    made = is_new /= 0_c_int
    if (error /= 0_c_int) call refuse_file(path, 'opened', int(error), info)
  end subroutine prepare_file

  !> Is it a device or a folder, from which lines cannot be read up to an end?
  function is_endless(path) result(endless)
    character(len=*), intent(in) :: path
    logical :: endless

    endless = c_is_endless(trim(path)//c_null_char) /= 0_c_int
  end function is_endless

  subroutine remove_file(path)
    character(len=*), intent(in) :: path

    call c_remove_file(trim(path)//c_null_char)
  end subroutine remove_file

  subroutine empty_file(path)
    character(len=*), intent(in) :: path

    call c_empty_file(trim(path)//c_null_char)
  end subroutine empty_file

  !> Begin a file anew, or standard output if `path` is empty. `error`: 0, or that of the C library.
  subroutine open_table(path, file, error)
    character(len=*), intent(in) :: path
    type(c_ptr), intent(out) :: file
    integer, intent(out) :: error
    integer(c_int) :: failure

    file = c_open_table(trim(path)//c_null_char, failure)
    error = int(failure)
  end subroutine open_table

  subroutine put_line(file, line, error)
    type(c_ptr), intent(in) :: file
    character(len=*), intent(in) :: line
    integer, intent(out) :: error

    error = int(c_put_line(file, line, int(len(line), c_size_t)))
  end subroutine put_line

  !> Write what is still in memory; the file is closed in any case.
  subroutine close_table(file, error)
    type(c_ptr), intent(in) :: file
    integer, intent(out) :: error

    error = int(c_close_table(file))
  end subroutine close_table

  !> Report (FUGE_ERR_FILE) that the file at `path`, or standard output, cannot be `verb`, and why.
  subroutine refuse_file(path, verb, error, info)
    character(len=*), intent(in) :: path, verb
    integer, intent(in) :: error
    type(fuge_info), intent(inout) :: info
    character(len=100) :: reason

    call c_reason(int(error, c_int), reason, int(len(reason), c_size_t))
    info%status = FUGE_ERR_FILE
    info%message = '"'//trim(path)//'" cannot be '//verb//': '//trim(reason)
    if (len_trim(path) == 0) info%message = 'standard output cannot be '//verb//': '//trim(reason)
  end subroutine refuse_file

end module file_access
