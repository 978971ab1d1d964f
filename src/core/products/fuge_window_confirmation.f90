!> Does a contact that was found on a window solve the whole grid? One product tells, and no search on the whole grid
!> needs its memory.
module fuge_window_confirmation
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunked_pass
  use fuge_search_settings, only: search_settings, SAFETY
  use fuge_status, only: fuge_info
  use fuge_wrong_points, only: choose_contact
  implicit none
  private

  public :: confirm_window

  !> Finds the sum of gaps and displacements in the contact and the largest displacement; once the `motion` is known
  !> the largest residual, the deepest penetration, and minus the least magnitude of a gap less `motion` in the contact.
  type, extends(chunked_pass) :: distance_pass
    real(dp), pointer, contiguous :: gap(:) => null(), displacement(:) => null()
    logical, pointer, contiguous :: contact(:) => null()
    !> Where forces have limits: points at these, and the limits.
    integer, pointer, contiguous :: limited(:) => null()
    real(dp), pointer, contiguous :: limit(:) => null()
    logical :: knows_motion = .false.
    real(dp) :: motion = 0.0_dp
  contains
    procedure :: do_chunk
  end type distance_pass

contains

  !> Evaluate `iterate`, whose forces are those of a window and zero outside it. `confirmed`: they solve the scene, one
  !> free translation with one-sided contact at all points, whatever the limits of forces, to the tolerance; otherwise
  !> they are a start. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine confirm_window(operator, settings, scene, iterate, confirmed, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: confirmed
    type(fuge_info), intent(inout) :: info
    type(distance_pass) :: pass
    real(dp) :: found(3)

    confirmed = scene%rows%everywhere(scene%fits_window()) .and. .not. scene%prescribed
    ! Where points have magnitudes of their own, the search finds them.
    if (confirmed) confirmed = operator%common_magnitude(1.0_dp, 1.0_dp) > 0.0_dp
    if (.not. confirmed) return
    call choose_contact(scene, iterate%contact_set)
    call compute_displacement(operator, .false., iterate%force, iterate%displacement, info)
    if (.not. info%failed()) call iterate%segments%find(iterate%contact, info)
    confirmed = .not. info%failed() .and. iterate%segments%points > 0
    if (.not. confirmed) return
    pass%gap => scene%gap
    pass%displacement => iterate%displacement
    pass%contact => iterate%contact
    if (scene%has_limits()) then
      pass%limited => iterate%limited
      pass%limit => scene%limit
    end if
    call pass%run(size(scene%gap), 2)
    associate (lengths => iterate%lengths)
      lengths%largest_magnitude = operator%common_magnitude(scene%rows%largest(pass%largest(2)), 1.0_dp)
      iterate%motion = scene%rows%total(pass%total(1))/real(iterate%segments%points, dp)
      pass%motion = iterate%motion
      pass%knows_motion = .true.
      call pass%run(size(scene%gap), 3)
      found = [pass%largest(1), pass%largest(2), pass%largest(3)]
      call scene%rows%raise(found)
      lengths%residual_norm = found(1)
      lengths%penetration = found(2)
      lengths%least_magnitude = lengths%largest_magnitude - found(3)
      call lengths%note_start()
      confirmed = lengths%is_accurate(SAFETY*settings%tolerance) &
                  .and. lengths%penetration <= lengths%allowed(SAFETY**2*settings%tolerance)
    end associate
  end subroutine confirm_window

  subroutine do_chunk(self, k, first, last)
    class(distance_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    real(dp) :: deepest, distance, largest, least, total
    integer :: i

    total = 0.0_dp
    largest = 0.0_dp
    deepest = 0.0_dp
    least = huge(least)
    do i = first, last
      if (.not. self%knows_motion) then
        if (self%contact(i)) total = total + (self%gap(i) + self%displacement(i))
        largest = max(largest, abs(self%displacement(i)))
        cycle
      end if
      distance = (self%gap(i) - self%motion) + self%displacement(i)
      if (self%contact(i)) then
        largest = max(largest, abs(distance))
        least = min(least, abs(self%gap(i) - self%motion))
      else if (.not. associated(self%limited)) then
        deepest = max(deepest, -distance)
      else if (self%limited(i) > 0) then
        deepest = max(deepest, distance)
      else if (self%limit(i) > 0.0_dp) then
        deepest = max(deepest, -distance)
      end if
    end do
    if (self%knows_motion) then
      self%found(:, k) = [largest, deepest, -least]
    else
      self%found(:, k) = [total, largest]
    end if
  end subroutine do_chunk

end module fuge_window_confirmation
