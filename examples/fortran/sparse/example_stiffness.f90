!> Storage of the stiffness matrix of the examples with meshes.
module example_stiffness
  use fuge_sparse, only: bodies_stiffness => fuge_sparse_stiffness
  implicit none
  private

  public :: bodies_stiffness

  logical, parameter, public :: IS_SPARSE = .true.

end module example_stiffness
