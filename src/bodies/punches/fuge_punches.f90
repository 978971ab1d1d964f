!> The public interface of the component punches: Hertz, smooth and round punches without a grid, and their fields.
module fuge_punches
  use fuge_field_of_punches, only: fuge_round_punch_field, fuge_smooth_punch_field
  use fuge_hertz_theory, only: fuge_hertz_contact, fuge_hertz_ellipse
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_punch, only: fuge_solve_round_punch
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_profile_type, only: fuge_smooth_profile, fuge_polynomial_profile, fuge_sampled_profile
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  implicit none
  public

end module fuge_punches
