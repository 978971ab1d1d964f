!> The public interface of the component halfspace: rectangles on a half-space, and the field below.
module fuge_halfspace
  use fuge_field_of_halfspace, only: fuge_halfspace_field
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_halfspace_influence, only: fuge_halfspace_matrix
  implicit none
  public

end module fuge_halfspace
