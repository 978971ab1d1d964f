!> Forces on a coarser grid, extended beyond their limits, to be interpolated on the next finer grid.
!>
!> Forces within limits are constant where they are at these, so that interpolation between a cell at its limit and one
!> in contact gives forces within the limits only: the finer grid would start with a rim of cells in contact around all
!> that are at their limits. Forces that go on rising with the penetration, as they would without a limit, are
!> interpolated to where they pass it. In the same way forces go on falling where cells are open.
module fuge_extended_forces
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_deformed_gaps, only: overlap_at
  use fuge_kinds, only: dp
  implicit none
  private

  public :: extend_forces

contains

  !> Extend the forces of `iterate`, within their ranges, at the points that are not in contact: beyond their limits by
  !> the force that the distance from their stop stands for, or below zero by it. A scene with limits. Points open
  !> between two stops keep no force, which of either sign would start at one of them.
  !>
  !> The force per length is that of short waves, iterate%gradients%amplification. By more than the mean magnitude of
  !> the forces no force is extended: beside a step of the gap the forces of the neighbours do not fall towards it.
  subroutine extend_forces(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: extension, most
    integer :: k

    most = mean_magnitude(scene, iterate%force)
    do k = 1, size(iterate%force)
      if (iterate%contact(k)) cycle
      extension = min(iterate%gradients%amplification*max(-overlap_at(scene, iterate, k), 0.0_dp), most)
      if (iterate%limited(k) /= 0) then
        iterate%force(k) = iterate%force(k) + sign(extension, real(iterate%limited(k), dp))
      else if (scene%play(k) >= huge(1.0_dp)) then
        iterate%force(k) = -extension
      end if
    end do
  end subroutine extend_forces

  !> The mean magnitude of the forces of all ranks that are not zero; 0 if there are none.
  function mean_magnitude(scene, force) result(mean)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: force(:)
    real(dp) :: mean
    real(dp) :: sums(2)

    sums = [sum(abs(force)), real(count(abs(force) > 0.0_dp), dp)]
    call scene%rows%add(sums)
    mean = sums(1)/max(sums(2), 1.0_dp)
  end function mean_magnitude

end module fuge_extended_forces
