!> Where an example writes its tables.
module example_output
  implicit none
  private

  public :: create_file

contains

  !> Open a new file `name` in the folder that the program's argument number `argument` names; without
  !> that argument, in the working directory.
  subroutine create_file(name, argument, file)
    character(len=*), intent(in) :: name
    integer, intent(in) :: argument
    integer, intent(out) :: file
    character(len=1024) :: folder
    integer :: status

    call get_command_argument(argument, folder)
    if (folder == '') folder = '.'
    open (newunit=file, file=trim(folder)//'/'//name, status='replace', action='write', iostat=status)
    if (status /= 0) error stop 'the folder for the tables does not exist or cannot be written to'
  end subroutine create_file

end module example_output
