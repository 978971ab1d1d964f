!> The library that computes Fourier transforms: none.
module chosen_transforms
  implicit none
  private

  !> What `fuge --version` says.
  character(len=*), parameter, public :: TRANSFORMS = 'transforms: none, built without FFTW'

end module chosen_transforms
