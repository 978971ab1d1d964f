!> How stiffness matrices are stored where the library has its sparse component.
module chosen_stiffness
  use fuge, only: dp => fuge_dp, fuge_info
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none
  private

  !> What `fuge --version` says.
  character(len=*), parameter, public :: STORAGE = 'stiffness matrices: sparse, by CHOLMOD (LGPL, in part GPL)'

  type, public :: stored_stiffness
    type(fuge_sparse_stiffness) :: stiffness
  contains
    procedure :: set
  end type stored_stiffness

contains

  !> From compressed columns with both triangles.
  subroutine set(self, column, row, value, info)
    class(stored_stiffness), intent(inout) :: self
    integer, intent(in) :: column(:), row(:)
    real(dp), intent(in) :: value(:)
    type(fuge_info), intent(out) :: info

    call self%stiffness%set(column, row, value, info)
  end subroutine set

end module chosen_stiffness
