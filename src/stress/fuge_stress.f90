!> The public interface of the component stress: stresses and displacements in the bodies.
module fuge_stress
  use fuge_halfplane_depths, only: fuge_halfplane_displacement_grid, fuge_halfplane_stress_grid
  use fuge_halfplane_interior, only: fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_halfplane_peak_search, only: fuge_halfplane_peak, fuge_smooth_peak
  use fuge_halfspace_depths, only: fuge_halfspace_displacement_grid, fuge_halfspace_stress_grid
  use fuge_halfspace_interior, only: fuge_halfspace_displacement, fuge_halfspace_stress
  use fuge_halfspace_peak_search, only: fuge_halfspace_peak
  use fuge_interface_peaks, only: fuge_interface_stress, fuge_layered_halfplane_interfaces, &
    fuge_layered_halfspace_interfaces
  use fuge_layered_halfplane_depths, only: fuge_layered_halfplane_displacement_grid, fuge_layered_halfplane_stress_grid
  use fuge_layered_halfplane_interior, only: fuge_layered_halfplane_displacement, fuge_layered_halfplane_stress
  use fuge_layered_halfspace_depths, only: fuge_layered_halfspace_displacement_grid, fuge_layered_halfspace_stress_grid
  use fuge_layered_halfspace_interior, only: fuge_layered_halfspace_displacement, fuge_layered_halfspace_stress
  use fuge_layered_peak_search, only: fuge_layer_peak, fuge_layered_halfplane_peak, fuge_layered_halfspace_peak
  use fuge_ring_interior, only: fuge_ring_interior_displacement, fuge_ring_stress
  use fuge_round_interior, only: fuge_round_displacement, fuge_round_stress
  use fuge_round_peak_search, only: fuge_ring_peak, fuge_round_peak
  use fuge_smooth_interior, only: fuge_smooth_displacement, fuge_smooth_stress
  use fuge_stress_measures, only: fuge_halfplane_tensor, fuge_round_tensor, fuge_principal_stresses, fuge_von_mises, &
    fuge_tresca, fuge_mean_stress
  use fuge_stress_peak_type, only: fuge_stress_peak, FUGE_MEASURE_TRESCA, FUGE_MEASURE_VON_MISES, FUGE_PEAK_INSIDE, &
    FUGE_PEAK_SINGULAR, FUGE_PEAK_SURFACE
  implicit none
  public

end module fuge_stress
