!> The public interface of the component stress: stresses and displacements in the bodies.
module fuge_stress
  use fuge_field_of_halfplane, only: fuge_halfplane_field
  use fuge_field_of_halfspace, only: fuge_halfspace_field
  use fuge_field_of_layers, only: fuge_layered_area_field, fuge_layered_line_field
  use fuge_field_of_punches, only: fuge_round_punch_field, fuge_smooth_punch_field
  use fuge_field_of_rings, only: fuge_rings_field
  use fuge_field_type, only: fuge_field
  use fuge_stress_measures, only: fuge_principal_stresses, fuge_von_mises, fuge_tresca, fuge_mean_stress
  use fuge_stress_peak_type, only: fuge_interface_stress, fuge_stress_peak, FUGE_MEASURE_TRESCA, &
    FUGE_MEASURE_VON_MISES, FUGE_PEAK_INSIDE, FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  implicit none
  public

end module fuge_stress
