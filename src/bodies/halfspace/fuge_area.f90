!> The public interface of the component area: areas of contact on a half-space.
module fuge_area
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_halfspace_influence, only: fuge_halfspace_matrix
  use fuge_hertz_theory, only: fuge_hertz_contact, fuge_hertz_ellipse
  use fuge_ring_influence, only: fuge_ring_displacement, fuge_ring_matrix
  implicit none
  public

end module fuge_area
