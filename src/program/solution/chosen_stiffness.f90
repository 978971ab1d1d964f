!> How stiffness matrices are stored where the library has no sparse component.
module chosen_stiffness
  use fuge_fe, only: stored_stiffness => fuge_dense_stiffness
  implicit none
  private

  public :: stored_stiffness

  !> What `fuge --version` says.
  character(len=*), parameter, public :: STORAGE = 'stiffness matrices: dense, built without CHOLMOD'

end module chosen_stiffness
