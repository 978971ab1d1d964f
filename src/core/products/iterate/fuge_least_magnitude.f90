!> The magnitudes of gaps and displacements on a contact set, as the certificate forms them: what errors are compared
!> with.
module fuge_least_magnitude
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: contact_segments, max_abs_over
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_least_magnitude, largest_rigid_magnitude

  !> Gaps less rigid displacements may be rounded by this many units in the last place of their terms.
  real(dp), parameter, public :: RIGID_ROUNDINGS = 2.0_dp

contains

  !> The least magnitude as the certificate forms it, over the contact points: the size of the gap less the rigid
  !> displacement plus the magnitude of the elastic one. Without contact 0, because nothing is rounded. Error:
  !> FUGE_ERR_MEMORY.
  subroutine find_least_magnitude(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: elastic(:)
    real(dp) :: offset

    if (scene%prescribed .or. allocated(scene%modes)) call new_lengths(scene, elastic, info)
    if (info%failed()) return
    offset = 0.0_dp
    ! As in the certificate, without the displacement by the datum, which cancels against the motion.
    if (scene%counts_datum()) offset = operator%datum()*scene%rows%total(sum(iterate%force))
    if (allocated(scene%modes)) then
      iterate%lengths%rounding = RIGID_ROUNDINGS*epsilon(offset)*largest_rigid_magnitude(scene, iterate)
      call add_magnitudes(operator, scene, offset, iterate, elastic, info)
      if (info%failed()) return
      iterate%lengths%least_magnitude = least_over(iterate%segments, iterate%gradients%work)
    else if (scene%prescribed) then
      elastic = iterate%displacement - offset
      call operator%magnitude(iterate%force, elastic, iterate%gradients%work)
      iterate%lengths%least_magnitude = least_sum(scene, iterate, offset)
    else
      call operator%magnitude(iterate%force, iterate%displacement, iterate%gradients%work)
      iterate%lengths%least_magnitude = least_sum(scene, iterate, -iterate%motion)
    end if
    iterate%lengths%largest_magnitude = max_abs_over(iterate%segments, iterate%gradients%work)
  end subroutine find_least_magnitude

  !> Room for a length at each point, (n). Error: FUGE_ERR_MEMORY.
  subroutine new_lengths(scene, lengths, info)
    type(contact_scene), intent(in) :: scene
    real(dp), allocatable, intent(out) :: lengths(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (lengths(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
  end subroutine new_lengths

  !> The magnitudes of scenes with modes, in iterate%gradients%work (n). On return `elastic` (n) has the displacement
  !> without its rigid part. Error: FUGE_ERR_MEMORY.
  subroutine add_magnitudes(operator, scene, offset, iterate, elastic, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: offset
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: elastic(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rigid(:)
    integer :: j

    call new_lengths(scene, rigid, info)
    if (info%failed()) return
    rigid = 0.0_dp
    do j = 1, size(iterate%rigid_motion)
      rigid = rigid + iterate%rigid_motion(j)*scene%modes(:, j)
    end do
    elastic = (iterate%displacement + rigid) - offset
    call operator%magnitude(iterate%force, elastic, iterate%gradients%work)
    iterate%gradients%work = abs((scene%gap - rigid) + offset) + iterate%gradients%work
  end subroutine add_magnitudes

  !> The largest magnitude of a gap and a rigid displacement, the sum of their terms, on the contact set.
  function largest_rigid_magnitude(scene, iterate) result(largest)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: largest, rigid
    integer :: i, k

    largest = 0.0_dp
    rigid = abs(iterate%motion)
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i)
        if (allocated(scene%modes)) rigid = sum(abs(scene%modes(k, :)*iterate%rigid_motion))
        largest = max(largest, abs(scene%gap(k)) + rigid)
      end do
    end do
    largest = scene%rows%largest(largest)
  end function largest_rigid_magnitude

  !> The least of |gap + offset| + magnitude, iterate%gradients%work, over the segments, 0 if there are none.
  function least_sum(scene, iterate, offset) result(least)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    real(dp), intent(in) :: offset
    real(dp) :: least
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%scene => scene
    pass%iterate => iterate
    pass%value = offset
    call pass%go(find_least_sum, size(scene%gap), 0, found)
    least = merge(-found(1), 0.0_dp, iterate%segments%points > 0)
    least = iterate%segments%space%least(least)
  end function least_sum

  !> Found: minus the least sum of a chunk.
  subroutine find_least_sum(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    real(dp) :: least
    integer :: i, j

    ! A rank without points must not lower the least sum of the others.
    found(1) = -huge(least)
    if (last < first) return
    least = huge(least)
    associate (segments => pass%iterate%segments, gap => pass%scene%gap, magnitude => pass%iterate%gradients%work)
      do i = segments%before(k) + 1, segments%before(k + 1)
        do j = segments%first(i), segments%last(i)
          least = min(least, abs(gap(j) + pass%value) + magnitude(j))
        end do
      end do
    end associate
    found(1) = -least
  end subroutine find_least_sum

  !> The least of `values` (n) over the segments, 0 if there are none.
  function least_over(segments, values) result(least)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: values(:)
    real(dp) :: least
    integer :: i

    least = merge(huge(least), 0.0_dp, segments%points > 0)
    do i = 1, size(segments%first)
      least = min(least, minval(values(segments%first(i):segments%last(i))))
    end do
    least = segments%space%least(least)
  end function least_over

end module fuge_least_magnitude
