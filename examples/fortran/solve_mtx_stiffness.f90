!> The stiffness matrix of the example `solve_mtx` as a dense one, where the library has been
!> built without its sparse component.
module solve_mtx_stiffness
  use fuge, only: dp => fuge_dp, fuge_dense_stiffness, fuge_info
  use solve_mtx_files, only: read_square
  implicit none
  private

  type, public :: stored_stiffness
    type(fuge_dense_stiffness) :: stiffness
    real(dp), allocatable, private :: matrix(:, :)
  contains
    procedure :: read => read_stiffness
  end type stored_stiffness

contains

  subroutine read_stiffness(self, path, info)
    class(stored_stiffness), intent(inout), target :: self
    character(len=*), intent(in) :: path
    type(fuge_info), intent(out) :: info

    call read_square(path, self%matrix, info)
    if (.not. info%failed()) call self%stiffness%set(self%matrix, info)
  end subroutine read_stiffness

end module solve_mtx_stiffness
