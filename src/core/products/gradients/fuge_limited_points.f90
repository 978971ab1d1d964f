!> Points whose forces have limits: states, balanced forces, and the steps of the active-set method.
module fuge_limited_points
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set, only: contact_set, excess_of, leave_stop, return_to_stop
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  implicit none
  private

  public :: choose_limited_contact, release_furthest, set_balanced_forces, step_to_limit

  !> Forces this near to their limits, as a fraction of these, are there.
  real(dp), parameter :: ROUNDING = 1.0e-12_dp

contains

  !> The contact set and the points at their limits that the forces to start from suggest.
  subroutine choose_limited_contact(scene, set)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(inout) :: set
    integer :: k

    do k = 1, size(scene%gap)
      associate (force => set%force(k), limited => set%limited(k))
        limited = 0
        ! Beyond a stop that takes no force a point is open; a tied one has no other state there.
        if (force > 0.0_dp .and. force >= scene%limit(k)) limited = merge(1, 0, scene%limit(k) > 0.0_dp .or. &
                                                                          scene%is_tied(k))
        if (scene%play(k) < huge(force)) then
          if (force < 0.0_dp .and. -force >= scene%limit_upper(k)) limited = -1
        end if
        set%at_upper(k) = force < 0.0_dp .and. scene%play(k) < huge(force) .and. .not. scene%is_tied(k)
        set%contact(k) = limited == 0 .and. ((force > 0.0_dp .and. scene%limit(k) > 0.0_dp) &
                                             .or. set%at_upper(k) .or. scene%is_tied(k))
        if (allocated(scene%excluded)) then
          if (scene%excluded(k)) limited = 0
          set%contact(k) = set%contact(k) .and. .not. scene%excluded(k)
        end if
      end associate
    end do
    if (scene%prescribed) return
    if (scene%rows%anywhere(any(set%contact) .or. any(set%limited /= 0))) return
    set%contact = scene%limit > 0.0_dp
    if (allocated(scene%excluded)) set%contact = set%contact .and. .not. scene%excluded
  end subroutine choose_limited_contact

  !> Forces within their limits that are in equilibrium with the load, and the states that belong to them.
  subroutine set_balanced_forces(scene, set)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(inout) :: set
    real(dp), allocatable :: most(:)
    real(dp) :: ignored(1)

    if (allocated(scene%modes)) then
      set%force = scene%balance
    else if (scene%prescribed) then
      set%force = 0.0_dp
    else
      allocate (most, source=scene%limit)
      if (allocated(scene%excluded)) where (scene%excluded) most = 0.0_dp
      call find_equilibrium(reshape(0.0_dp*most + 1.0_dp, [size(most), 1]), [1.0_dp], 0.0_dp*most, most, &
                            set%force, ignored, sharing=scene%rows%point_space)
      ! An even share of a load that all limits just carry is beside these by rounding.
      where (set%force >= (1.0_dp - ROUNDING)*most) set%force = most
    end if
    call choose_limited_contact(scene, set)
  end subroutine set_balanced_forces

  !> From the feasible forces `start` (n) go towards those of the set, which are its solution, until the first one
  !> reaches the end of its range: that point leaves its stop, and the forces of the set are
  !> feasible again. If that is `newest`, which has just come back to its stop, it came by rounding and is `locked` (n).
  !> `newest` is 0 where another rank has it.
  subroutine step_to_limit(scene, start, newest, locked, set)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: start(:)
    integer, intent(in) :: newest
    logical, intent(inout) :: locked(:)
    type(contact_set), intent(inout) :: set
    real(dp) :: fraction, least, most, step_length
    integer :: blocking, k

    step_length = huge(step_length)
    blocking = 0
    do k = 1, size(start)
      if (.not. set%contact(k)) cycle
      if (excess_of(scene, set, k, set%force(k)) <= set%tension_noise) cycle
      call scene%find_range(k, set%at_upper(k), least, most)
      fraction = min(abs(min(max(set%force(k), least), most) - start(k)) &
                     /max(abs(set%force(k) - start(k)), tiny(most)), 1.0_dp)
      if (k == newest .and. .not. fraction > 0.0_dp) fraction = -1.0_dp
      if (fraction >= step_length) cycle
      step_length = fraction
      blocking = k
    end do
    call scene%rows%keep_least(step_length, blocking)
    step_length = scene%rows%least(step_length)
    if (step_length >= huge(step_length)) return
    if (step_length < 0.0_dp .and. blocking > 0) locked(blocking) = .true.
    step_length = max(step_length, 0.0_dp)
    do k = 1, size(start)
      if (.not. set%contact(k)) cycle
      if (k == blocking) call leave_stop(scene, k, set)
      set%force(k) = start(k) + step_length*(set%force(k) - start(k))
    end do
  end subroutine step_to_limit

  !> Of the points at the limit of their lower stop, the one that is furthest above the stop comes back to it; only
  !> points with forces above `least` do.
  subroutine release_furthest(scene, least, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: least
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: furthest
    integer :: k, point

    point = 0
    furthest = -huge(furthest)
    do k = 1, size(scene%gap)
      if (iterate%limited(k) < 1 .or. .not. iterate%force(k) > least) cycle
      if (scene%gap(k) + iterate%displacement(k) <= furthest) cycle
      furthest = scene%gap(k) + iterate%displacement(k)
      point = k
    end do
    call scene%rows%keep_least(-furthest, point)
    if (point > 0) call return_to_stop(scene, .true., point, iterate%contact_set)
  end subroutine release_furthest

end module fuge_limited_points
