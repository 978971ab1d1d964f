!> The direction of a link between two nodes.
module fuge_link_direction
  use fuge_kinds, only: dp
  implicit none
  private

  public :: direction_between

  !> Nodes whose distance is below this fraction of their largest coordinate coincide: the digits of a deck give the
  !> line between them no direction.
  real(dp), parameter, public :: COINCIDENT = 1.0e-6_dp

contains

  !> The unit vector from node a to node b; `reason` if they coincide.
  pure subroutine direction_between(position_a, position_b, direction, reason)
    real(dp), intent(in) :: position_a(3), position_b(3)
    real(dp), intent(out) :: direction(3)
    character(len=:), allocatable, intent(inout) :: reason
    real(dp) :: largest

    direction = 0.0_dp
    if (allocated(reason)) return
    largest = maxval(abs([position_a, position_b]))
    if (largest > 0.0_dp) direction = position_b/largest - position_a/largest
    if (norm2(direction) > COINCIDENT) then
      direction = direction/norm2(direction)
    else
      reason = 'its nodes coincide, so that it has no direction'
    end if
  end subroutine direction_between

end module fuge_link_direction
