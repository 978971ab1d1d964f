!> The passes of a search in single precision where points may have two stops, or forces have limits: the state of each
!> point decides from which stop its distance counts, and between which numbers its force is in contact, or its distance
!> where it is open or at a limit.
module fuge_single_law
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_set, only: contact_set, excess_of, leave_stop, return_to_stop
  use fuge_kinds, only: dp, sp
  use fuge_point_chunks, only: chunked_pass
  use fuge_single_state, only: single_state
  implicit none
  private

  public :: exchange_states, set_ranges

  !> Where a range has no end: beyond all distances and forces, FAR included.
  real(sp), parameter :: ENDLESS = 1.0e37_sp
  !> Limits are rounded in single precision by less than this fraction.
  real(dp), parameter :: SINGLE_ROUNDING = 1.0e-6_dp

  !> Points on the wrong side change their state, by more than `noise` if they are not in contact, and their ranges.
  !> Found: how many did, the sum of the forces in the new contact, and its points. Or the ranges of all points are set.
  type, extends(chunked_pass) :: law_pass
    type(contact_scene), pointer :: scene => null()
    type(contact_set), pointer :: set => null()
    type(single_state), pointer :: state => null()
    real(dp) :: noise = 0.0_dp
    logical :: sets_ranges = .false.
  contains
    procedure :: do_chunk
  end type law_pass

contains

  !> As exchange_points of fuge_single_passes.
  subroutine exchange_states(scene, noise, state, set, found)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: noise
    type(single_state), intent(inout), target :: state
    type(contact_set), intent(inout), target :: set
    real(dp), intent(out) :: found(3)
    type(law_pass) :: pass
    integer :: j

    call point_to(scene, state, set, pass)
    pass%noise = noise
    call pass%run(size(scene%gap), 3)
    found = [(pass%total(j), j=1, 3)]
    call scene%rows%add(found)
  end subroutine exchange_states

  !> Stops and ranges for the states of all points; distances count from the new stop.
  subroutine set_ranges(scene, state, set)
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_set), intent(in), target :: set
    type(law_pass) :: pass

    call point_to(scene, state, set, pass)
    pass%sets_ranges = .true.
    call pass%run(size(scene%gap), 0)
  end subroutine set_ranges

  subroutine point_to(scene, state, set, pass)
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_set), intent(in), target :: set
    type(law_pass), intent(inout) :: pass

    pass%scene => scene
    pass%set => set
    pass%state => state
  end subroutine point_to

  subroutine do_chunk(self, k, first, last)
    class(law_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i
    logical :: wrong

    if (self%sets_ranges) then
      do i = first, last
        call set_range(self%scene, self%set, i, self%state)
      end do
      return
    end if
    do i = first, last
      wrong = may_be_wrong(self%set%contact(i), self%set%force(i), real(self%state%distance(i), dp), &
                           real(self%state%least(i), dp), real(self%state%most(i), dp), self%noise)
      if (wrong) call exchange_point(self, i, wrong)
      if (wrong) self%found(1, k) = self%found(1, k) + 1.0_dp
      if (.not. self%set%contact(i)) cycle
      if (.not. wrong) self%found(2, k) = self%found(2, k) + self%set%force(i)
      self%found(3, k) = self%found(3, k) + 1.0_dp
    end do
  end subroutine do_chunk

  !> Is the distance of a point that is not in contact out of its range `least` .. `most` by more than `noise`, or the
  !> force of one in contact, whose range is rounded, perhaps?
  elemental function may_be_wrong(contact, force, distance, least, most, noise) result(wrong)
    logical, intent(in) :: contact
    real(dp), intent(in) :: force, distance, least, most, noise
    logical :: wrong

    if (contact) then
      wrong = force < least + SINGLE_ROUNDING*abs(least) .or. force > most - SINGLE_ROUNDING*abs(most)
    else
      wrong = max(least - distance, distance - most) > noise
    end if
  end function may_be_wrong

  !> Point `i`, which may be wrong, changes its state if it is `wrong`, and its stop and its range with that.
  subroutine exchange_point(pass, i, wrong)
    class(law_pass), intent(in) :: pass
    integer, intent(in) :: i
    logical, intent(out) :: wrong

    associate (scene => pass%scene, set => pass%set)
      wrong = .true.
      if (.not. set%contact(i)) then
        call return_to_stop(scene, pass%state%distance(i) < pass%state%least(i), i, set)
      else
        wrong = excess_of(scene, set, i, set%force(i)) > set%tension_noise
        if (wrong) call leave_stop(scene, i, set)
      end if
      if (wrong) call set_range(scene, set, i, pass%state)
    end associate
  end subroutine exchange_point

  !> The stop and the range of point `i`.
  pure subroutine set_range(scene, set, i, state)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    integer, intent(in) :: i
    type(single_state), intent(inout) :: state
    real(dp) :: least, most, stop
    integer :: limited

    limited = 0
    if (allocated(set%limited)) limited = set%limited(i)
    stop = 0.0_dp
    least = -real(ENDLESS, dp)
    most = real(ENDLESS, dp)
    if (scene%gap(i) >= OUT_OF_REACH) then
      continue
    else if (set%contact(i)) then
      call scene%find_range(i, set%at_upper(i), least, most)
      if (set%at_upper(i)) stop = scene%play(i)
    else if (limited > 0) then
      most = 0.0_dp
    else if (limited < 0) then
      least = 0.0_dp
      stop = scene%play(i)
    else
      least = 0.0_dp
      if (scene%has_limits()) then
        if (.not. scene%limit(i) > 0.0_dp) least = -real(ENDLESS, dp)
      end if
      most = scene%play(i)
    end if
    state%least(i) = real(max(least, -real(ENDLESS, dp)), sp)
    state%most(i) = real(min(most, real(ENDLESS, dp)), sp)
    state%distance(i) = state%distance(i) + real(state%stop(i) - stop, sp)
    state%stop(i) = stop
  end subroutine set_range

end module fuge_single_law
