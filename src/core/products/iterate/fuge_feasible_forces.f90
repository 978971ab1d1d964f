!> Forces that are feasible: on the contact set only, of the right sign, within their limits, and with the resultants.
module fuge_feasible_forces
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_set, only: contact_set
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: clip_forces, keep_resultants, make_feasible, set_feasible_forces

  !> A sum of n forces is rounded by at most about this many units in its last place, times the root of n.
  real(dp), parameter :: SUM_ROUNDINGS = 64.0_dp
  !> Distances tried to find those of the last points that carry a load.
  integer, parameter :: LEVELS = 100

contains

  !> Make the forces feasible, as `set_feasible_forces`, and recompute their displacements. Errors: FUGE_ERR_MEMORY,
  !> those of the operator.
  subroutine make_feasible(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest(2)

    call set_feasible_forces(scene, iterate, info)
    if (allocated(scene%modes)) iterate%rigid_motion = 0.0_dp
    if (.not. info%failed()) call compute_displacement(operator, scene%counts_datum(), iterate%force, &
                                                       iterate%displacement, info)
    ! Forces to start from may be the rounding of those under another load.
    if (scene%is_unloaded() .and. .not. info%failed()) then
      largest = [maxval(abs(iterate%force)), maxval(abs(iterate%displacement))]
      call scene%rows%raise(largest)
      if (largest(1) > 0.0_dp) iterate%gradients%softness = max(iterate%gradients%softness, largest(2)/largest(1))
    end if
  end subroutine make_feasible

  !> Forces that are zero off the contact set, of the right sign on it, and have the resultants.
  !>
  !> With modes, forces of the wrong sign may come back with the resultants; where the set cannot carry these at all,
  !> the points of scene%balance join it. Error: FUGE_ERR_MEMORY.
  subroutine set_feasible_forces(scene, iterate, info)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    call clip_forces(scene, iterate%contact_set)
    if (allocated(scene%modes)) then
      call restore_resultants(scene, iterate%contact_set, info)
    else if (.not. scene%prescribed) then
      if (scene%has_limits()) then
        call restore_load_within_limits(scene, iterate)
      else
        call restore_load(iterate%contact_set)
      end if
    end if
  end subroutine set_feasible_forces

  !> Forces on the contact set, to which set%projection belongs, with the resultants of a scene with modes, from
  !> which rounding has led away.
  subroutine keep_resultants(scene, set)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(inout) :: set
    logical :: possible

    call set%projection%correct_resultants(scene%modes, load_on_contact(scene, set), set%segments, &
                                               set%force, possible)
  end subroutine keep_resultants

  !> Open points lose their forces, and those in contact what is beyond the range of their stop; points at limits keep
  !> theirs.
  subroutine clip_forces(scene, set)
    type(contact_scene), intent(in), target :: scene
    type(contact_set), intent(inout), target :: set
    type(iterate_pass) :: pass
    real(dp) :: none(0)

    pass%scene => scene
    pass%set => set
    if (allocated(scene%play)) then
      call pass%go(clip_to_ranges, size(scene%gap), 0, none)
    else
      call pass%go(clip_pushing, size(scene%gap), 0, none)
    end if
  end subroutine clip_forces

  !> Clip forces of points with one stop. Finds nothing.
  subroutine clip_pushing(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) found = 0.0_dp
    associate (force => pass%set%force, contact => pass%set%contact)
      do i = first, last
        force(i) = merge(max(force(i), 0.0_dp), 0.0_dp, contact(i))
      end do
    end associate
  end subroutine clip_pushing

  !> Clip forces of points that may have two stops or limits of their forces. Finds nothing.
  subroutine clip_to_ranges(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) found = 0.0_dp
    do i = first, last
      pass%set%force(i) = force_in_range(pass%scene, pass%set, i)
    end do
  end subroutine clip_to_ranges

  !> The force of point `k`, or the nearest one that it may have: that of its limit, or none, off the contact set.
  pure function force_in_range(scene, set, k) result(force)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    integer, intent(in) :: k
    real(dp) :: force
    real(dp) :: least, most

    force = 0.0_dp
    if (set%contact(k)) then
      call scene%find_range(k, set%at_upper(k), least, most)
      force = min(max(set%force(k), least), most)
    else if (allocated(set%limited)) then
      if (set%limited(k) /= 0) force = scene%limited_force(k, set%limited(k))
    end if
  end function force_in_range

  !> As `restore_load`, where some forces are at their limits and stay there. Forces that are too large together shrink
  !> by one factor; where they are too small, what they lack of their limits does, so that all stay within these. Where
  !> the others would have to pull, all points that have a force share the load. Where the forces at their limits carry
  !> just the load, the last of them to get there has what they leave; where they carry less or more and no others are
  !> in contact, the nearest points get to their limits as well, or the furthest leave theirs.
  subroutine restore_load_within_limits(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: sums(4), factor, rest

    sums = sums_within_limits(scene, iterate%contact_set)
    if (.not. sums(3) > 0.0_dp) then
      if (abs(1.0_dp - sums(2)) <= sum_rounding(scene)) then
        call free_last_limited(scene, iterate)
      else
        call fill_to_load(scene, 1.0_dp - sums(2), iterate)
      end if
      sums = sums_within_limits(scene, iterate%contact_set)
    end if
    rest = 1.0_dp - sums(2)
    if (rest <= 0.0_dp .or. .not. sums(3) > 0.0_dp) then
      iterate%contact = iterate%contact .or. iterate%limited /= 0
      iterate%limited = 0
      call restore_load(iterate%contact_set)
    else if (rest > sums(1) .and. rest < sums(4)) then
      factor = (sums(4) - rest)/(sums(4) - sums(1))
      where (iterate%contact)
        iterate%force = min(scene%limit, 1.0_dp) - factor*(min(scene%limit, 1.0_dp) - iterate%force)
      end where
    else if (sums(1) > 0.0_dp) then
      where (iterate%contact) iterate%force = iterate%force*(rest/sums(1))
    else
      where (iterate%contact) iterate%force = rest/sums(3)
    end if
  end subroutine restore_load_within_limits

  !> The sums of the forces on the contact set and off it, the points of the set, and the sum of their limits.
  function sums_within_limits(scene, set) result(sums)
    type(contact_scene), intent(in), target :: scene
    type(contact_set), intent(in), target :: set
    real(dp) :: sums(4)
    type(iterate_pass) :: pass

    pass%scene => scene
    pass%set => set
    call pass%go(sum_within_limits, size(scene%gap), 4, sums)
    call set%segments%space%add(sums)
  end function sums_within_limits

  !> Found: what sums_within_limits gives.
  subroutine sum_within_limits(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    real(dp) :: sums(4)
    integer :: i

    if (k < 1) found = 0.0_dp
    sums = 0.0_dp
    associate (force => pass%set%force, contact => pass%set%contact, limit => pass%scene%limit)
      do i = first, last
        if (contact(i)) then
          sums(1) = sums(1) + force(i)
          sums(3) = sums(3) + 1.0_dp
          sums(4) = sums(4) + min(limit(i), 1.0_dp)
        else
          sums(2) = sums(2) + force(i)
        end if
      end do
    end associate
    found = found + sums
  end subroutine sum_within_limits

  !> The rounding of a sum of forces that is 1.
  function sum_rounding(scene) result(rounding)
    type(contact_scene), intent(in) :: scene
    real(dp) :: rounding

    rounding = SUM_ROUNDINGS*epsilon(rounding)*sqrt(real(scene%points(), dp))
  end function sum_rounding

  !> The point that penetrates its stop least of those at the limits of these comes back to it.
  subroutine free_last_limited(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: greatest, greatest_of_all
    integer :: last

    last = maxloc(scene%gap + iterate%displacement, dim=1, mask=iterate%limited == 1)
    greatest = -huge(greatest)
    if (last > 0) greatest = scene%gap(last) + iterate%displacement(last)
    greatest_of_all = iterate%segments%space%largest(greatest)
    if (last < 1 .or. greatest < greatest_of_all) return
    iterate%limited(last) = 0
    iterate%contact(last) = .true.
    iterate%at_upper(last) = .false.
  end subroutine free_last_limited

  !> Open points get to their limits, the nearest first, until these have the `rest` of the load; if that is negative,
  !> those at their limits open, the furthest first. The last ones are in contact.
  subroutine fill_to_load(scene, rest, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: rest
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: bounds(2), carried(1), middle
    integer :: step

    associate (work => iterate%gradients%work)
      ! Distances in `work`; those of points that do not take part are out of reach.
      work = sign(1.0_dp, rest)*(scene%gap + iterate%displacement)
      if (rest > 0.0_dp) then
        where (iterate%limited /= 0 .or. .not. scene%limit > 0.0_dp .or. scene%gap >= OUT_OF_REACH) &
          work = OUT_OF_REACH
      else
        where (iterate%limited /= 1) work = OUT_OF_REACH
      end if
      bounds = [-minval(work), maxval(work, mask=work < OUT_OF_REACH)]
      call iterate%segments%space%raise(bounds)
      if (.not. -bounds(1) < OUT_OF_REACH) return
      bounds(1) = -bounds(1) - max(bounds(2) + bounds(1), spacing(bounds(1)))
      do step = 1, LEVELS
        middle = bounds(1) + 0.5_dp*(bounds(2) - bounds(1))
        if (.not. (middle > bounds(1) .and. middle < bounds(2))) exit
        carried = sum(min(scene%limit, 1.0_dp), mask=work <= middle)
        call iterate%segments%space%add(carried)
        bounds(merge(2, 1, carried(1) >= abs(rest))) = middle
      end do
      where (work <= bounds(1))
        iterate%limited = merge(1, 0, rest > 0.0_dp)
        iterate%force = merge(scene%limit, 0.0_dp, rest > 0.0_dp)
      else where (work <= bounds(2))
        iterate%limited = 0
        iterate%contact = .true.
        iterate%at_upper = .false.
      end where
    end associate
  end subroutine fill_to_load

  !> Forces of sum 1; equal ones where there are none.
  subroutine restore_load(set)
    type(contact_set), intent(inout), target :: set
    type(iterate_pass) :: pass
    real(dp) :: none(0), sums(2)

    pass%set => set
    call pass%go(sum_forces, size(set%force), 2, sums)
    pass%value = set%segments%space%total(sums(1))
    if (pass%value > 0.0_dp) then
      call pass%go(divide_forces, size(set%force), 0, none)
    else
      pass%value = real(set%segments%space%total_count(nint(sums(2))), dp)
      call pass%go(set_equal_forces, size(set%force), 0, none)
    end if
  end subroutine restore_load

  !> Found: the sum of the forces, and the number of points in contact.
  subroutine sum_forces(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)

    if (k > 0) found = [sum(pass%set%force(first:last)), real(count(pass%set%contact(first:last)), dp)]
  end subroutine sum_forces

  !> Divide the forces by the value of the pass. Finds nothing.
  subroutine divide_forces(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)

    if (k < 1) found = 0.0_dp
    pass%set%force(first:last) = pass%set%force(first:last)/pass%value
  end subroutine divide_forces

  !> Divide 1 among the points in contact, of which the value of the pass is the number. Finds nothing.
  subroutine set_equal_forces(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) found = 0.0_dp
    do i = first, last
      if (pass%set%contact(i)) pass%set%force(i) = 1.0_dp/pass%value
    end do
  end subroutine set_equal_forces

  !> Forces with the resultants of the scene, on the set, or on the set and the points of scene%balance.
  subroutine restore_resultants(scene, set, info)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(inout) :: set
    type(fuge_info), intent(inout) :: info
    logical :: possible
    integer :: trial

    do trial = 1, 2
      call set%segments%find(set%contact, info)
      if (.not. info%failed()) call set%projection%set(scene%modes, set%segments, info)
      if (info%failed()) return
      call set%projection%correct_resultants(scene%modes, load_on_contact(scene, set), set%segments, &
                                                 set%force, possible)
      if (possible .or. trial > 1) return
      if (allocated(set%limited)) set%limited = 0
      where (.not. set%contact) set%force = scene%balance
      if (allocated(set%at_upper)) then
        where (.not. set%contact) set%at_upper = scene%balance < 0.0_dp
      end if
      set%contact = set%contact .or. abs(scene%balance) > 0.0_dp
    end do
  end subroutine restore_resultants

  !> The resultants that the forces on the contact set must have, (m): without those of the forces at their limits.
  function load_on_contact(scene, set) result(load)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    real(dp) :: load(size(scene%load))
    real(dp) :: carried(size(load))
    integer :: j

    load = scene%load
    if (.not. scene%has_limits()) return
    carried = [(sum(set%force*scene%modes(:, j), mask=.not. set%contact), j=1, size(load))]
    call set%segments%space%add(carried)
    load = load - carried
  end function load_on_contact

end module fuge_feasible_forces
