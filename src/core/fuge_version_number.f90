!> The version of the library. include/fuge_core.h repeats it, and a test compares the two.
module fuge_version_number
  implicit none
  private

  !> Version of the library.
  character(len=*), parameter, public :: FUGE_VERSION = '0.1.0'

end module fuge_version_number
