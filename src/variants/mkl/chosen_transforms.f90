!> The library that computes Fourier transforms where it is not FFTW itself.
module chosen_transforms
  implicit none
  private

  !> What `fuge --version` says.
  character(len=*), parameter, public :: TRANSFORMS = 'transforms: by a library with the interface of FFTW, such as MKL'

end module chosen_transforms
