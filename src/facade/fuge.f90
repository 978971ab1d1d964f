!> The whole public interface of fuge, frictionless elastic contact: that of its components.
module fuge
  use fuge_area
  use fuge_core
  use fuge_fe
  use fuge_files
  use fuge_layers
  use fuge_punch
  use fuge_stress
  implicit none
  public

end module fuge
