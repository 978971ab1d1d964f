!> The whole public interface of fuge, frictionless elastic contact: that of its components.
module fuge
  use fuge_accuracy
  use fuge_core
  use fuge_elastic
  use fuge_fe
  use fuge_files
  use fuge_halfplane
  use fuge_halfspace
  use fuge_layers
  use fuge_punches
  use fuge_rings
  implicit none
  public

end module fuge
