!> A contact set with the forces on it: the state of each point.
module fuge_contact_set
  use, intrinsic :: iso_fortran_env, only: int8
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: contact_segments
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, &
    FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_mode_projection, only: mode_projection
  implicit none
  private

  public :: excess_of, find_states, leave_stop, note_states, return_to_stop

  !> Under a load, forces are divided by it; with a prescribed motion they are not scaled.
  type, public :: contact_set
    !> Forces, (n); their sum is 1 unless the motion is prescribed.
    real(dp), allocatable :: force(:)
    !> The contact set, (n).
    logical, allocatable :: contact(:)
    !> The contact is at the upper stop, (n); allocated where points have one.
    logical, allocatable :: at_upper(:)
    !> Points whose force is at its limit of the lower stop, 1, or of the upper one, -1, else 0, (n): they are open, but
    !> have a force. Allocated where forces have limits.
    integer, allocatable :: limited(:)
    !> Tensions up to this are rounding.
    real(dp) :: tension_noise = 0.0_dp
    !> The segments of the contact set.
    type(contact_segments) :: segments = contact_segments()
    !> The rigid motions on the contact set.
    type(mode_projection) :: projection = mode_projection()
  end type contact_set

contains

  !> By how much a `force` at point `k`, in contact, is beyond the range that its stop gives it.
  pure function excess_of(scene, set, k, force) result(excess)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    integer, intent(in) :: k
    real(dp), intent(in) :: force
    real(dp) :: excess
    real(dp) :: least, most

    call scene%find_range(k, set%at_upper(k), least, most)
    excess = max(least - force, force - most)
  end function excess_of

  !> Point `k`, whose force is beyond its range, goes to its limit, or opens where the force changes its sign.
  pure subroutine leave_stop(scene, k, set)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: k
    type(contact_set), intent(inout) :: set
    real(dp) :: least, most

    set%contact(k) = .false.
    if (.not. allocated(set%limited)) return
    call scene%find_range(k, set%at_upper(k), least, most)
    set%limited(k) = 0
    if (set%force(k) > most .and. (most > 0.0_dp .or. scene%is_tied(k))) set%limited(k) = 1
    if (set%force(k) < least .and. (least < 0.0_dp .or. scene%is_tied(k))) set%limited(k) = -1
  end subroutine leave_stop

  !> Point `k` comes to the stop that it penetrates, the lower one if it is `below` that, or whose limit it leaves.
  pure subroutine return_to_stop(scene, below, k, set)
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: below
    integer, intent(in) :: k
    type(contact_set), intent(inout) :: set
    logical :: at_upper

    at_upper = .not. below
    if (allocated(set%limited)) then
      if (set%limited(k) /= 0) at_upper = set%limited(k) < 0
      set%limited(k) = 0
    end if
    set%contact(k) = .true.
    if (allocated(set%at_upper)) set%at_upper(k) = at_upper .and. .not. scene%is_tied(k)
  end subroutine return_to_stop

  !> The `state` of each point, (n).
  pure subroutine find_states(set, state)
    type(contact_set), intent(in) :: set
    integer, intent(out) :: state(:)

    state = merge(FUGE_AT_LOWER_STOP, FUGE_OPEN, set%contact)
    if (allocated(set%at_upper)) where (set%contact .and. set%at_upper) state = FUGE_AT_UPPER_STOP
    if (.not. allocated(set%limited)) return
    where (set%limited > 0) state = FUGE_LIMITED_LOWER
    where (set%limited < 0) state = FUGE_LIMITED_UPPER
  end subroutine find_states

  !> The same in little memory, to be kept from one solve to the next.
  pure subroutine note_states(set, state)
    type(contact_set), intent(in) :: set
    integer(int8), intent(out) :: state(:)

    state = merge(int(FUGE_AT_LOWER_STOP, int8), int(FUGE_OPEN, int8), set%contact)
    if (allocated(set%at_upper)) where (set%contact .and. set%at_upper) state = int(FUGE_AT_UPPER_STOP, int8)
    if (.not. allocated(set%limited)) return
    where (set%limited > 0) state = int(FUGE_LIMITED_LOWER, int8)
    where (set%limited < 0) state = int(FUGE_LIMITED_UPPER, int8)
  end subroutine note_states

end module fuge_contact_set
