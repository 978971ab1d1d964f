!> The public interface of the component elastic: what all elastic bodies share, moduli, cells, and fields inside.
module fuge_elastic
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN, FUGE_HAT, FUGE_FREE, FUGE_PERIODIC
  use fuge_elastic_moduli, only: fuge_plane_modulus, fuge_combined_modulus, fuge_displacement_shares, &
    FUGE_PLANE_STRAIN, FUGE_PLANE_STRESS
  use fuge_field_type, only: fuge_field
  use fuge_stress_measures, only: fuge_principal_stresses, fuge_von_mises, fuge_tresca, fuge_mean_stress
  use fuge_stress_peak_type, only: fuge_interface_stress, fuge_stress_peak, FUGE_MEASURE_TRESCA, &
    FUGE_MEASURE_VON_MISES, FUGE_PEAK_INSIDE, FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  implicit none
  public

end module fuge_elastic
