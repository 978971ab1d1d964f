!> Gaps in the deformed state: on which side of their stops points are, and how far.
module fuge_deformed_gaps
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_step, only: deepest_penetration
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  implicit none
  private

  public :: deformed_gap, find_penetration, is_below, overlap_at

contains

  !> Gap of a point in the deformed state; negative where the point penetrates. Scaled as in
  !> contact_iterate.
  elemental function deformed_gap(reduced_gap, displacement, motion) result(gap)
    real(dp), intent(in) :: reduced_gap, displacement, motion
    real(dp) :: gap

    gap = (reduced_gap - motion) + displacement
  end function deformed_gap

  !> How far point `k`, which is not in contact, is on the wrong side of a stop: an open point beyond it, one at its
  !> limit before it; not positive if it is not.
  pure function overlap_at(scene, iterate, k) result(overlap)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    real(dp) :: overlap
    real(dp) :: gap
    integer :: limited
    logical :: pushes

    overlap = 0.0_dp
    if (scene%gap(k) >= OUT_OF_REACH) return
    gap = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
    limited = 0
    if (allocated(iterate%limited)) limited = iterate%limited(k)
    select case (limited)
    case (1)
      overlap = gap
    case (-1)
      overlap = scene%play(k) - gap
    case default
      pushes = .true.
      if (allocated(scene%limit)) pushes = scene%limit(k) > 0.0_dp
      if (pushes) overlap = -gap
      if (.not. allocated(scene%play)) return
      if (scene%play(k) < huge(gap)) overlap = max(overlap, gap - scene%play(k))
    end select
  end function overlap_at

  !> Is point `k` below its lower stop, and does that stop push?
  pure function is_below(scene, iterate, k)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    logical :: is_below

    is_below = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion) < 0.0_dp
    if (allocated(scene%limit)) is_below = is_below .and. scene%limit(k) > 0.0_dp
  end function is_below

  !> The deepest penetration of an open point, through either stop; 0 if none penetrates.
  function find_penetration(scene, iterate) result(depth)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    real(dp) :: depth
    type(iterate_pass) :: pass
    real(dp) :: deepest(1)

    if (.not. allocated(scene%play)) then
      depth = deepest_penetration(iterate%segments, scene%gap, iterate%motion, iterate%displacement)
      return
    end if
    pass%scene => scene
    pass%iterate => iterate
    if (scene%has_limits()) then
      call pass%go(find_overlaps, size(scene%gap), 0, deepest)
      depth = scene%rows%largest(deepest(1))
    else
      depth = deepest_penetration(iterate%segments, scene%gap, iterate%motion, iterate%displacement)
      call pass%go(penetrate_upper_stops, size(scene%gap), 0, deepest)
      depth = scene%rows%largest(max(depth, deepest(1)))
    end if
  end function find_penetration

  !> Found: the largest overlap of a point that is not in contact.
  subroutine find_overlaps(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    do i = first, last
      if (.not. pass%iterate%contact(i)) found(1) = max(found(1), overlap_at(pass%scene, pass%iterate, i))
    end do
  end subroutine find_overlaps

  !> Found: the deepest penetration of an open point through its upper stop.
  subroutine penetrate_upper_stops(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    associate (scene => pass%scene, iterate => pass%iterate)
      do i = first, last
        if (iterate%contact(i) .or. scene%play(i) >= huge(1.0_dp) .or. scene%gap(i) >= OUT_OF_REACH) cycle
        found(1) = max(found(1), deformed_gap(scene%gap(i), iterate%displacement(i), iterate%motion) - scene%play(i))
      end do
    end associate
  end subroutine penetrate_upper_stops

end module fuge_deformed_gaps
