!> Points in the wrong state: in contact although their force pulls away from the stop, or open although they penetrate
!> a stop. How many there are, which are worst, and their exchange.
module fuge_wrong_points
  use fuge_contact_iterate, only: contact_iterate, deformed_gap
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_kinds, only: dp
  use fuge_limited_points, only: choose_limited_contact, count_wrong_limited, excess_is_decided, greatest_excess
  use fuge_set_exchange, only: exchange
  use fuge_shared_exchange, only: exchange_in_line
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: choose_contact, count_wrong_points, deepest_open_point, exchange_wrong_points, greatest_tension, &
    penetrated_stop, tension_is_decided

  !> Partial maxima are faster than one.
  integer, parameter :: LANES = 4

contains

  !> The contact set that the forces to start from suggest; tied points always belong to it. Where a load must be
  !> carried and there are no such forces, as when the contact of the last solve is excluded now, it is every point that
  !> takes part.
  subroutine choose_contact(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    integer :: k

    if (scene%has_limits()) then
      call choose_limited_contact(scene, iterate)
      return
    end if
    iterate%contact = iterate%force > 0.0_dp
    if (allocated(scene%play)) then
      do k = 1, size(scene%play)
        iterate%at_upper(k) = iterate%force(k) < 0.0_dp .and. scene%play(k) < huge(1.0_dp) .and. .not. scene%is_tied(k)
        iterate%contact(k) = iterate%contact(k) .or. iterate%at_upper(k) .or. scene%is_tied(k)
      end do
    end if
    if (allocated(scene%excluded)) iterate%contact = iterate%contact .and. .not. scene%excluded
    if (scene%prescribed) return
    if (scene%rows%anywhere(any(iterate%contact))) return
    iterate%contact = .true.
    if (allocated(scene%excluded)) iterate%contact = .not. scene%excluded
  end subroutine choose_contact

  !> Number of points in the contact set with a tensile force and of open points that penetrate by
  !> more than `noise`.
  function count_wrong_points(scene, noise, iterate) result(wrong)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: noise
    type(contact_iterate), intent(in) :: iterate
    integer :: wrong
    integer :: k

    if (scene%has_limits()) then
      wrong = count_wrong_limited(scene, noise, iterate)
      return
    end if
    if (.not. allocated(scene%play)) then
      wrong = count(iterate%contact .and. iterate%force < -iterate%tension_noise) &
              + count(.not. iterate%contact &
                      .and. deformed_gap(scene%gap, iterate%displacement, iterate%motion) < -noise)
      wrong = scene%rows%total_count(wrong)
      return
    end if
    wrong = 0
    do k = 1, size(scene%gap)
      if (iterate%contact(k)) then
        if (pulls_away(scene, iterate, k)) wrong = wrong + 1
      else if (penetrated_stop(scene, noise, iterate, k) /= 0) then
        wrong = wrong + 1
      end if
    end do
    wrong = scene%rows%total_count(wrong)
  end function count_wrong_points

  !> Does the force of point `k`, in contact, pull away from its stop?
  pure function pulls_away(scene, iterate, k)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    logical :: pulls_away

    pulls_away = .false.
    if (.not. scene%is_tied(k)) pulls_away = tension_of(iterate, k, iterate%force(k)) > iterate%tension_noise
  end function pulls_away

  !> How much `force` at point `k` pulls away from its stop.
  pure function tension_of(iterate, k, force) result(tension)
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    real(dp), intent(in) :: force
    real(dp) :: tension

    tension = -force
    if (allocated(iterate%at_upper)) then
      if (iterate%at_upper(k)) tension = force
    end if
  end function tension_of

  !> 1 if the open point `k` penetrates the lower stop by more than `noise`, -1 the upper one, 0 if neither.
  pure function penetrated_stop(scene, noise, iterate, k) result(stop_number)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: noise
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    integer :: stop_number
    real(dp) :: gap

    stop_number = 0
    if (scene%gap(k) >= OUT_OF_REACH) return
    gap = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
    if (gap < -noise) then
      stop_number = 1
    else if (allocated(scene%play)) then
      if (scene%play(k) < huge(gap) .and. gap - scene%play(k) > noise) stop_number = -1
    end if
  end function penetrated_stop

  !> Tensile points leave the contact set, points that penetrate by more than `noise` join it; with
  !> `extrapolate` more leave and fewer join, as fuge_set_exchange explains. Error: FUGE_ERR_MEMORY.
  subroutine exchange_wrong_points(scene, noise, extrapolate, iterate, info)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: noise
    logical, intent(in) :: extrapolate
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: tensile(:), penetrating(:)
    real(dp), allocatable :: measure(:)
    integer :: k, stat

    ! Allocated here only: during the products the operator may need the memory.
    allocate (tensile(size(scene%gap)), penetrating(size(scene%gap)), stat=stat)
    if (stat == 0 .and. extrapolate) allocate (measure(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the contact set of', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    if (allocated(scene%play)) then
      do k = 1, size(scene%gap)
        tensile(k) = iterate%contact(k)
        if (tensile(k)) tensile(k) = pulls_away(scene, iterate, k)
        penetrating(k) = .not. iterate%contact(k)
        if (penetrating(k)) call join(scene, noise, iterate, k, penetrating(k))
      end do
    else
      tensile = iterate%contact .and. iterate%force < -iterate%tension_noise
      penetrating = .not. iterate%contact .and. deformed_gap(scene%gap, iterate%displacement, iterate%motion) < -noise
    end if
    if (extrapolate) then
      call measure_states(scene, iterate, measure)
      call exchange_in_line(scene%rows, tensile, penetrating, measure, iterate%contact, info)
      if (info%failed()) return
      call keep_tied(scene, iterate%contact)
    else
      call exchange(tensile, penetrating, iterate%contact)
    end if
  end subroutine exchange_wrong_points

  !> The `measure` (n) of exchange_extrapolated: forces of points in contact, distances of open ones from the stop that
  !> they are nearer to.
  pure subroutine measure_states(scene, iterate, measure)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(out) :: measure(:)
    integer :: k

    measure = merge(iterate%force, deformed_gap(scene%gap, iterate%displacement, iterate%motion), iterate%contact)
    if (.not. allocated(scene%play)) return
    do k = 1, size(measure)
      if (iterate%contact(k)) then
        measure(k) = -tension_of(iterate, k, iterate%force(k))
      else if (scene%play(k) < huge(1.0_dp)) then
        measure(k) = min(measure(k), scene%play(k) - measure(k))
      end if
    end do
  end subroutine measure_states

  !> Does the open point `k` penetrate a stop? Then it will be in contact with that one.
  pure subroutine join(scene, noise, iterate, k, penetrating)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: noise
    type(contact_iterate), intent(inout) :: iterate
    integer, intent(in) :: k
    logical, intent(out) :: penetrating
    integer :: stop_number

    stop_number = penetrated_stop(scene, noise, iterate, k)
    penetrating = stop_number /= 0
    iterate%at_upper(k) = stop_number < 0
  end subroutine join

  !> Tied points that the extrapolation released come back.
  pure subroutine keep_tied(scene, contact)
    type(contact_scene), intent(in) :: scene
    logical, intent(inout) :: contact(:)
    integer :: k

    if (.not. allocated(scene%play)) return
    do k = 1, size(contact)
      if (.not. contact(k)) contact(k) = scene%is_tied(k)
    end do
  end subroutine keep_tied

  !> The open point, of those not locked, that penetrates most, by more than `noise`; 0 if there
  !> is none, or where the deepest one is another rank's.
  function deepest_open_point(scene, iterate, noise, locked) result(deepest)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: noise
    logical, intent(in) :: locked(:)
    integer :: deepest
    real(dp) :: depth, gap, greatest, owner(1)
    integer :: k

    deepest = 0
    greatest = noise
    do k = 1, size(scene%gap)
      if (iterate%contact(k) .or. locked(k) .or. scene%gap(k) >= OUT_OF_REACH) cycle
      gap = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
      depth = -gap
      if (allocated(scene%play)) then
        if (scene%play(k) < huge(gap)) depth = max(depth, gap - scene%play(k))
      end if
      if (depth <= greatest) cycle
      deepest = k
      greatest = depth
    end do
    associate (space => scene%rows%point_space)
      owner = real(space%number(), dp)
      call space%take_from_least(merge(-greatest, huge(greatest), deepest > 0), owner)
      if (abs(owner(1) - real(space%number(), dp)) > 0.0_dp) deepest = 0
    end associate
  end function deepest_open_point

  !> The greatest tension in the contact set, of points that are not tied; 0 if there is none.
  function greatest_tension(scene, iterate) result(tension)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: tension
    integer :: k

    if (scene%has_limits()) then
      tension = greatest_excess(scene, iterate)
      return
    end if
    if (.not. allocated(scene%play)) then
      tension = scene%rows%largest(max(0.0_dp, -minval(iterate%force)))
      return
    end if
    tension = 0.0_dp
    do k = 1, size(scene%gap)
      if (.not. iterate%contact(k)) cycle
      if (pulls_away(scene, iterate, k)) tension = max(tension, abs(iterate%force(k)))
    end do
    tension = scene%rows%largest(tension)
  end function greatest_tension

  !> Are the forces accurate enough to tell which of them will be tensile: is their error below the fraction `decisive`
  !> of the greatest tension? The preconditioned residual, iterate%work, estimates their error.
  function tension_is_decided(scene, iterate, decisive) result(decided)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: decisive
    logical :: decided
    real(dp) :: force_error(LANES), tension(LANES), values(LANES), extremes(2)
    integer :: i, k

    if (scene%has_limits()) then
      decided = excess_is_decided(scene, iterate, decisive)
      return
    end if
    force_error = 0.0_dp
    tension = 0.0_dp
    if (allocated(scene%play)) then
      do k = 1, size(scene%gap)
        if (.not. iterate%contact(k)) cycle
        force_error(1) = max(force_error(1), abs(iterate%work(k)))
        if (.not. scene%is_tied(k)) tension(1) = max(tension(1), tension_of(iterate, k, &
                                                                             iterate%force(k) - iterate%work(k)))
      end do
      extremes = [force_error(1), tension(1)]
      call scene%rows%raise(extremes)
      decided = extremes(1) <= decisive*extremes(2)
      return
    end if
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i) - LANES + 1, LANES
        values = abs(iterate%work(k:k + LANES - 1))
        force_error = merge(values, force_error, values > force_error)
        values = iterate%work(k:k + LANES - 1) - iterate%force(k:k + LANES - 1)
        tension = merge(values, tension, values > tension)
      end do
      do k = iterate%segments%last(i) - modulo(iterate%segments%last(i) - iterate%segments%first(i) + 1, LANES) + 1, &
          iterate%segments%last(i)
        force_error(1) = max(force_error(1), abs(iterate%work(k)))
        tension(1) = max(tension(1), iterate%work(k) - iterate%force(k))
      end do
    end do
    extremes = [maxval(force_error), maxval(tension)]
    call scene%rows%raise(extremes)
    decided = extremes(1) <= decisive*extremes(2)
  end function tension_is_decided

end module fuge_wrong_points
