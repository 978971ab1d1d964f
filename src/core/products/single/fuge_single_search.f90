!> Search for the contact set of a grid with products in single precision, which take half the time: where the operator
!> has them.
!>
!> As fuge_contact_set_search. The last forces, gaps and residuals are as exact as with double precision throughout,
!> because the displacements are those of products in double precision, or differ from them by less than the tolerance.
module fuge_single_search
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_set, only: contact_set
  use fuge_feasible_forces, only: set_feasible_forces
  use fuge_iteration_progress, only: tell_progress
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_search_settings, only: search_settings, MAX_STALLS, SAFETY, WRONG_ON_COARSE
  use fuge_single_gradients, only: estimate_compliance, run_single_gradients
  use fuge_single_law, only: exchange_states, set_ranges
  use fuge_single_passes, only: exchange_points, give_displacements, point_pass, set_forces, sum_forces, take_change
  use fuge_single_preconditioner, only: single_preconditioner
  use fuge_single_state, only: move_forces, refresh, restore_sum, single_state, start_displacements
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: fuge_info
  use fuge_wrong_points, only: choose_contact
  implicit none
  private

  public :: find_in_single, suits_single

  !> Displacements are exact enough for the end if their error is below the first fraction of the tolerance, and that is
  !> not less than the second number.
  real(dp), parameter :: NEGLIGIBLE = 0.1_dp, LOOSE = 1.0e-5_dp
  !> Displacements below this fraction of the largest one that lengths were judged by are others than those.
  real(dp), parameter :: CURRENT = 0.5_dp
  !> Larger gaps are out of the range of single precision, or their squares would be; so are those less a prescribed
  !> approach that are all smaller.
  real(dp), parameter :: LARGEST_GAP = 1.0e15_dp, SMALLEST_APPROACH = 1.0e-15_dp

contains

  !> Can `find_in_single` search for the contact set of this scene?
  function suits_single(operator, scene) result(suits)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    logical :: suits
    real(dp) :: datum, magnitude
    logical :: on_spring

    suits = operator%has_single() .and. .not. scene%is_unloaded()
    if (.not. suits) return
    on_spring = operator%translation_spring() > 0.0_dp
    ! Without a free translation equal forces have to displace the points.
    if (scene%prescribed .and. .not. scene%absorbs_datum) then
      datum = operator%datum()
      magnitude = operator%common_magnitude(0.0_dp, 1.0_dp)
      suits = .not. (abs(datum) > 0.0_dp .or. (magnitude > 0.0_dp .and. .not. on_spring))
    end if
    if (on_spring) suits = suits .and. .not. allocated(scene%modes)
    if (suits) suits = all(operator%grid() > 1)
  end function suits_single

  !> Find the contact set of one grid and its forces: `iterate` as for find_contact_set. Unless `found` another search
  !> has to go on from its forces. Errors: those of the operator, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_CANCELLED.
  subroutine find_in_single(operator, settings, scene, monitor, iterate, found, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    type(single_preconditioner) :: preconditioner
    type(single_state) :: state
    type(stall_counter) :: stalls
    real(dp) :: previous_residual, total
    integer :: points, wrong
    logical :: confirmed, lost, possible, to_tolerance

    found = .false.
    call state%start(scene, info)
    if (info%failed()) return
    state%flexibility = operator%translation_spring()
    iterate%projection%needs_basis = settings%prepared
    if (settings%prepared) then
      call take_prepared(operator, settings, scene, state, iterate, possible, info)
    else
      call start_forces(operator, settings, scene, state, iterate, possible, info)
    end if
    if (.not. possible) return
    call stalls%start(MAX_STALLS)
    previous_residual = huge(previous_residual)
    to_tolerance = .false.
    do while (.not. (state%is_lost .or. info%failed()))
      call solve_on_set(operator, settings, preconditioner, scene, to_tolerance, monitor, state, iterate, lost, info)
      if (lost .or. info%failed()) return
      call exchange(settings, scene, state, iterate, wrong, points, total)
      found = wrong == 0 .and. iterate%gradients%converged
      if (settings%coarse_grid) found = wrong <= WRONG_ON_COARSE*real(points, dp)
      if (found) call finish(settings, scene, state, iterate, found)
      if (found) return
      if (wrong == 0) then
        if (to_tolerance .or. iterate%gradients%converged) then
          call confirm(operator, settings, scene, total, previous_residual, state, iterate, confirmed, info)
          if (info%failed()) return
          call preconditioner%note_changes(abs(iterate%segments%points - points))
          if (confirmed) call exchange(settings, scene, state, iterate, wrong, points, total)
          found = confirmed .and. wrong == 0
          if (found) return
        end if
        to_tolerance = .true.
        if (wrong == 0) cycle
      end if
      to_tolerance = .false.
      call stalls%spend()
      call stalls%renew_if_fewer(wrong)
      if (stalls%has_stalled() .or. (points == 0 .and. .not. scene%prescribed)) return
      call preconditioner%note_changes(wrong)
      iterate%gradients%least_compliance = 0.0_dp
      previous_residual = huge(previous_residual)
      call set_load(settings, scene, total, state, iterate, info)
      if (.not. info%failed()) call move_forces(operator, scene, state, iterate, info)
    end do
  end subroutine find_in_single

  !> The contact, forces and displacements of an iterate that is prepared. `possible`: as for start_forces. Errors:
  !> those of the operator, FUGE_ERR_MEMORY.
  subroutine take_prepared(operator, settings, scene, state, iterate, possible, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    type(single_state), intent(inout) :: state
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info

    possible = are_in_range(scene, scene%rows%largest(maxval(abs(scene%gap), mask=scene%gap < OUT_OF_REACH)))
    if (.not. possible) return
    if (allocated(scene%play)) call set_ranges(scene, state, iterate%contact_set)
    call note_forces(settings, scene, .true., state, iterate)
    call refresh(operator, scene, .true., state, iterate, info)
  end subroutine take_prepared

  !> The contact that the forces to start from suggest, and forces with the load there. `possible`: are the gaps in the
  !> range of single precision, and are there points to carry the load? Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine start_forces(operator, settings, scene, state, iterate, possible, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    call pass%go(sum_forces, 1, 1)
    possible = are_in_range(scene, pass%largest(1))
    if (possible .and. is_general(scene)) then
      call choose_contact(scene, iterate%contact_set)
      if (allocated(scene%modes)) iterate%rigid_motion = 0.0_dp
      possible = scene%rows%anywhere(scene%prescribed .or. any(iterate%contact))
    else if (allocated(scene%excluded)) then
      possible = possible .and. (scene%prescribed .or. pass%total(2) > 0.0_dp)
    end if
    if (.not. possible) return
    if (allocated(scene%play)) call set_ranges(scene, state, iterate%contact_set)
    call set_load(settings, scene, pass%total(2), state, iterate, info)
    if (.not. info%failed()) call start_displacements(operator, scene, state, iterate, info)
  end subroutine start_forces

  !> Have points other laws than one stop and no limit, or are there modes?
  pure function is_general(scene)
    type(contact_scene), intent(in) :: scene
    logical :: is_general

    is_general = allocated(scene%modes) .or. allocated(scene%play)
  end function is_general

  !> Are gaps of which this is the `largest` magnitude, and plays, in the range of single precision?
  function are_in_range(scene, largest)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: largest
    logical :: are_in_range

    are_in_range = largest <= LARGEST_GAP
    if (scene%prescribed .and. .not. allocated(scene%modes)) are_in_range = are_in_range .and. &
      largest >= SMALLEST_APPROACH
    if (.not. allocated(scene%play)) return
    if (scene%rows%anywhere(any(scene%play > LARGEST_GAP .and. scene%play < huge(largest)))) are_in_range = .false.
  end function are_in_range

  !> Leave the displacements of the set that is `found`, unless it has to be confirmed.
  subroutine finish(settings, scene, state, iterate, found)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    type(single_state), intent(inout) :: state
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(inout) :: found

    if (settings%coarse_grid) then
      call show_displacements(scene, state, iterate)
    else
      call make_exact(settings, scene, state, iterate, found)
    end if
  end subroutine finish

  !> Where forces on a coarser grid are extended beyond their limits, that takes the distances.
  subroutine show_displacements(scene, state, iterate)
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    if (.not. scene%has_limits()) return
    call state%point_to(scene, iterate, pass)
    call pass%go(give_displacements, 1, 0)
  end subroutine show_displacements

  !> Are the displacements those of a product in double precision, or is the tolerance such that the errors of single
  !> precision do not count? Then they follow from the distances.
  subroutine make_exact(settings, scene, state, iterate, exact)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: exact
    type(point_pass) :: pass

    exact = state%is_exact
    ! The distances of points that take no part are not theirs.
    if (exact .or. allocated(scene%excluded)) return
    exact = settings%tolerance >= LOOSE &
            .and. state%drift <= NEGLIGIBLE*settings%tolerance*iterate%lengths%least_magnitude
    if (.not. exact) return
    call restore_sum(scene, state, iterate)
    call state%point_to(scene, iterate, pass)
    pass%factors = state%offset
    if (.not. allocated(state%basis)) pass%shift = state%offset(1)
    call pass%go(give_displacements, 1, 0)
    ! The lengths that decided may have been those of much larger forces.
    exact = pass%largest(1) >= CURRENT*state%largest
  end subroutine make_exact

  !> Forces with the resultants in the contact: of sum 1, where they have the sum `total` now; equal ones if that is not
  !> positive. Where all motions are prescribed, those that push. Error: FUGE_ERR_MEMORY.
  subroutine set_load(settings, scene, total, state, iterate, info)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: total
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    integer :: states(2)

    if (is_general(scene)) then
      iterate%gradients%direction = iterate%force
      states = 0
      if (allocated(scene%play)) states = counts_of_states(iterate%contact_set)
      call set_feasible_forces(scene, iterate, info)
      if (allocated(scene%play)) then
        if (any(counts_of_states(iterate%contact_set) /= states)) call set_ranges(scene, state, iterate%contact_set)
      end if
      if (.not. info%failed()) call note_forces(settings, scene, .false., state, iterate)
      return
    end if
    call state%point_to(scene, iterate, pass)
    pass%factor = 0.0_dp
    if (scene%prescribed) then
      pass%factor = 1.0_dp
    else if (total > 0.0_dp) then
      pass%factor = 1.0_dp/total
    end if
    pass%shift = 1.0_dp/real(scene%points(), dp)
    call pass%go(set_forces, 0, 0)
  end subroutine set_load

  !> How many points are in contact, and at limits: where feasible forces need others, they add points to the contact.
  pure function counts_of_states(set) result(counts)
    type(contact_set), intent(in) :: set
    integer :: counts(2)

    counts = [count(set%contact), 0]
    if (allocated(set%limited)) counts(2) = count(set%limited /= 0)
  end function counts_of_states

  !> What depends on feasible forces and on the contact of a general scene: its rigid motions, and with modes the
  !> tension that is rounding. The direction is the change of the forces, which were
  !> iterate%gradients%direction before, unless they are those to `start` from.
  subroutine note_forces(settings, scene, start, state, iterate)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    logical, intent(in) :: start
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    if (.not. is_general(scene)) return
    call state%take_basis(scene, iterate)
    call state%point_to(scene, iterate, pass)
    pass%before => iterate%gradients%direction
    if (start) pass%before => iterate%force
    call pass%go(take_change, 1, 1)
    if (.not. allocated(scene%modes)) return
    state%total = pass%total(2)
    iterate%tension_noise = SAFETY**2*settings%tolerance*pass%largest(1)
  end subroutine note_forces

  !> Solve for the forces of the present contact set, as solve_on_contact_set of fuge_contact_set_search, with
  !> ten arguments: two more are the state and whether it is `lost`.
  subroutine solve_on_set(operator, settings, preconditioner, scene, to_tolerance, monitor, state, iterate, lost, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(single_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: to_tolerance
    class(fuge_monitor), intent(inout) :: monitor
    type(single_state), intent(inout) :: state
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: lost
    type(fuge_info), intent(inout) :: info

    lost = .false.
    call settings%check_limit(info)
    if (info%failed()) return
    call preconditioner%set(operator, scene, state, iterate, info)
    if (info%failed()) return
    call run_single_gradients(operator, preconditioner, scene, SAFETY*settings%tolerance, to_tolerance, state, &
                              iterate, lost, info)
    if (lost .or. info%failed()) return
    info%iterations = info%iterations + 1
    if (.not. settings%coarse_grid) call iterate%gradients%note_least_compliance()
    if (iterate%gradients%converged .and. .not. (settings%coarse_grid .or. settings%prepared)) then
      if (.not. iterate%gradients%least_compliance > 0.0_dp) then
        call estimate_compliance(operator, preconditioner, scene, state, iterate, info)
      end if
      if (info%failed()) return
    end if
    call tell_progress(scene, iterate, monitor, info)
  end subroutine solve_on_set

  !> Tensile points leave the contact, those that penetrate join it: how many were `wrong`, the `points` in
  !> contact, and the `total` of their forces.
  subroutine exchange(settings, scene, state, iterate, wrong, points, total)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    integer, intent(out) :: wrong, points
    real(dp), intent(out) :: total
    type(point_pass) :: pass
    real(dp) :: found(3), noise

    noise = iterate%lengths%allowed(SAFETY**2*settings%tolerance)
    if (allocated(scene%play)) then
      call exchange_states(scene, noise, state, iterate%contact_set, found)
    else
      call state%point_to(scene, iterate, pass)
      pass%noise = noise
      pass%tension = iterate%tension_noise
      if (.not. allocated(state%basis)) pass%shift = state%offset(1)
      call pass%go(exchange_points, 0, 3)
      found = [pass%total(1), pass%total(2), pass%total(3)]
    end if
    wrong = nint(found(1))
    total = found(2)
    points = nint(found(3))
  end subroutine exchange

  !> Confirm a contact set without wrong points, whose forces have the sum `total`, by a product in double precision.
  !> `previous_residual` of the last confirmation. The arguments are nine: those of confirm_contact_set, the state and
  !> the sum.
  subroutine confirm(operator, settings, scene, total, previous_residual, state, iterate, confirmed, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: total
    real(dp), intent(inout) :: previous_residual
    type(single_state), intent(inout) :: state
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: confirmed
    type(fuge_info), intent(inout) :: info

    confirmed = .false.
    call set_load(settings, scene, total, state, iterate, info)
    if (.not. info%failed()) call refresh(operator, scene, .false., state, iterate, info)
    if (info%failed()) return
    call iterate%lengths%confirm(SAFETY*settings%tolerance, previous_residual, confirmed)
  end subroutine confirm

end module fuge_single_search
