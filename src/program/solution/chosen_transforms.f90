!> The library that computes Fourier transforms.
module chosen_transforms
  implicit none
  private

  !> What `fuge --version` says.
  character(len=*), parameter, public :: TRANSFORMS = 'transforms: by FFTW (GPL, version 2 or later)'

end module chosen_transforms
