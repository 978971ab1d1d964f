!> How the iteration's gaps and forces follow from those of a problem.
module fuge_scene_scaling
  use fuge_kinds, only: dp
  implicit none
  private

  !> gap_of_scene = (gap - gap_datum)/load, force_of_scene = force/load.
  type, public :: scene_scaling
    !> Length; a free translation takes it up, or it is the prescribed approach.
    real(dp) :: gap_datum = 0.0_dp
    !> Force.
    real(dp) :: load = 1.0_dp
  end type scene_scaling

end module fuge_scene_scaling
