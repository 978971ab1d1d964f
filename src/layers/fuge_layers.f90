!> The public interface of the component layers: coated and layered bodies.
module fuge_layers
  use fuge_layered_body_type, only: fuge_layered_body
  implicit none
  public

end module fuge_layers
