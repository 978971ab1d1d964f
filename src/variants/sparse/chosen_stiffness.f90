!> How stiffness matrices are stored where the library has its sparse component.
module chosen_stiffness
  use fuge_sparse, only: stored_stiffness => fuge_sparse_stiffness
  implicit none
  private

  public :: stored_stiffness

  !> What `fuge --version` says.
  character(len=*), parameter, public :: STORAGE = 'stiffness matrices: sparse, by CHOLMOD (LGPL, in part GPL)'

end module chosen_stiffness
