!> Files that a test writes, reads and deletes.
module scratch_files
  implicit none
  private

  public :: delete_scratch, scratch_content

contains

  !> All bytes of a file.
  function scratch_content(path) result(content)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: content
    integer :: bytes, unit

    open (newunit=unit, file=path, status='old', access='stream', form='unformatted', action='read')
    inquire (unit=unit, size=bytes)
    allocate (character(len=bytes) :: content)
    read (unit) content
    close (unit)
  end function scratch_content

  subroutine delete_scratch(path)
    character(len=*), intent(in) :: path
    integer :: unit

    open (newunit=unit, file=path, status='old')
    close (unit, status='delete')
  end subroutine delete_scratch

end module scratch_files
