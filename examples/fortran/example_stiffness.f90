!> Storage of the stiffness matrix of the examples with meshes, where the library has been built without its sparse
!> component: a band.
module example_stiffness
  use fuge, only: bodies_stiffness => fuge_band_stiffness
  implicit none
  private

  public :: bodies_stiffness

  logical, parameter, public :: IS_SPARSE = .false.

end module example_stiffness
