!> The public interface of the component layers: coated and layered bodies.
module fuge_layers
  use fuge_coating_thickness, only: fuge_find_coating_limits
  use fuge_effective_modulus, only: fuge_find_effective_modulus
  use fuge_field_of_layers, only: fuge_layered_area_field, fuge_layered_line_field
  use fuge_graded_layers_type, only: fuge_graded_layers
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_layered_matrices, only: fuge_layered_halfplane_matrix, fuge_layered_halfspace_matrix, &
    fuge_layered_ring_matrix
  implicit none
  public

end module fuge_layers
