!> The public interface of the component rings: round bodies on a half-space, and the field below.
module fuge_rings
  use fuge_field_of_rings, only: fuge_rings_field
  use fuge_ring_influence, only: fuge_ring_displacement, fuge_ring_matrix
  implicit none
  public

end module fuge_rings
