!> Files that a test writes, reads and deletes.
module scratch_files
  implicit none
  private

  public :: delete_scratch, write_scratch

contains

  !> Write these bytes; an existing file is replaced.
  subroutine write_scratch(path, content)
    character(len=*), intent(in) :: path, content
    integer :: unit

    open (newunit=unit, file=path, status='replace', access='stream', form='unformatted', action='write')
    write (unit) content
    close (unit)
  end subroutine write_scratch

  subroutine delete_scratch(path)
    character(len=*), intent(in) :: path
    integer :: unit

    open (newunit=unit, file=path, status='old')
    close (unit, status='delete')
  end subroutine delete_scratch

end module scratch_files
