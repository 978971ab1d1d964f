!> Search for the contact set of a grid with products in single precision, which take half the time: where the operator
!> has them, for one translation, free or prescribed, and one-sided contact at all points.
!>
!> As fuge_contact_set_search. The last forces, gaps and residuals are as exact as with double precision throughout,
!> because the displacements are those of products in double precision, or differ from them by less than the tolerance.
module fuge_single_search
  use fuge_contact_iterate, only: contact_iterate, is_accurate
  use fuge_contact_scene, only: contact_scene
  use fuge_iteration_progress, only: tell_progress
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_search_settings, only: note_least_compliance, search_settings, MAX_STALLS, SAFETY, WRONG_ON_COARSE
  use fuge_single_gradients, only: estimate_compliance, run_single_gradients
  use fuge_single_passes, only: exchange_points, give_displacements, point_pass, set_forces, sum_forces
  use fuge_single_preconditioner, only: single_preconditioner
  use fuge_single_state, only: move_forces, refresh, restore_sum, single_state, start_displacements
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: fuge_info
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

    suits = scene%is_simple() .and. scene%rows%is_alone()
    if (suits) suits = operator%has_single()
    ! Without a free translation equal forces have to displace the points.
    if (suits .and. scene%prescribed) then
      datum = operator%datum()
      magnitude = operator%common_magnitude(0.0_dp, 1.0_dp)
      suits = .not. (abs(datum) > 0.0_dp .or. magnitude > 0.0_dp)
    end if
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
    call state%start(size(scene%gap), info)
    if (settings%prepared .and. .not. info%failed()) then
      if (.not. are_in_range(scene, maxval(abs(scene%gap)))) return
      call refresh(operator, scene, .true., state, iterate, info)
    else if (.not. info%failed()) then
      call start_forces(operator, scene, state, iterate, possible, info)
      if (.not. possible) return
    end if
    call stalls%start(MAX_STALLS)
    previous_residual = huge(previous_residual)
    to_tolerance = .false.
    do while (.not. (state%is_lost .or. info%failed()))
      call solve_on_set(operator, settings, preconditioner, scene, to_tolerance, monitor, state, iterate, lost, info)
      if (lost .or. info%failed()) return
      call exchange(settings, scene, state, iterate, wrong, points, total)
      found = wrong == 0 .and. iterate%converged
      if (settings%coarse_grid) then
        found = wrong <= WRONG_ON_COARSE*real(points, dp)
      else if (found) then
        call make_exact(settings, scene, state, iterate, found)
      end if
      if (found) return
      if (wrong == 0) then
        if (to_tolerance .or. iterate%converged) then
          call confirm(operator, settings, scene, total, previous_residual, state, iterate, confirmed, info)
          if (info%failed()) return
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
      if (stalls%has_stalled()) return
      call preconditioner%note_changes(wrong)
      iterate%least_compliance = 0.0_dp
      previous_residual = huge(previous_residual)
      call set_load(scene, total, state, iterate)
      call move_forces(operator, scene, state, iterate, info)
    end do
  end subroutine find_in_single

  !> Contact where the forces to start from push, and forces with the load there. `possible`: are the gaps in the range
  !> of single precision?
  subroutine start_forces(operator, scene, state, iterate, possible, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    call pass%go(sum_forces, 2)
    possible = are_in_range(scene, pass%largest(2))
    if (.not. possible) return
    call set_load(scene, pass%total(1), state, iterate)
    call start_displacements(operator, scene, state, iterate, info)
  end subroutine start_forces

  !> Are gaps of which this is the `largest` magnitude in the range of single precision?
  pure function are_in_range(scene, largest)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: largest
    logical :: are_in_range

    are_in_range = largest <= LARGEST_GAP
    if (scene%prescribed) are_in_range = are_in_range .and. largest >= SMALLEST_APPROACH
  end function are_in_range

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
    if (exact) return
    exact = settings%tolerance >= LOOSE .and. state%drift <= NEGLIGIBLE*settings%tolerance*iterate%least_magnitude
    if (.not. exact) return
    call restore_sum(scene, state, iterate)
    call state%point_to(scene, iterate, pass)
    pass%shift = state%offset
    call pass%go(give_displacements, 1)
    ! The lengths that decided may have been those of much larger forces.
    exact = pass%largest(1) >= CURRENT*state%largest
  end subroutine make_exact

  !> Forces of sum 1 in the contact, in which they have the sum `total` now; equal ones if that is not positive. Where
  !> the motion is prescribed, those that push.
  subroutine set_load(scene, total, state, iterate)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: total
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    pass%factor = 0.0_dp
    if (scene%prescribed) then
      pass%factor = 1.0_dp
    else if (total > 0.0_dp) then
      pass%factor = 1.0_dp/total
    end if
    pass%shift = 1.0_dp/real(size(scene%gap), dp)
    call pass%go(set_forces, 0)
  end subroutine set_load

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
    if (.not. settings%coarse_grid) call note_least_compliance(iterate)
    if (iterate%converged .and. .not. (settings%coarse_grid .or. settings%prepared)) then
      if (.not. iterate%least_compliance > 0.0_dp) call estimate_compliance(operator, preconditioner, scene, state, &
                                                                            iterate, info)
      if (info%failed()) return
    end if
    call tell_progress(scene, iterate, monitor, info)
  end subroutine solve_on_set

  !> Tensile points leave the contact, those that penetrate join it: how many were `wrong`, the `points` in
  !> contact, and the `total` of their forces.
  subroutine exchange(settings, scene, state, iterate, wrong, points, total)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    integer, intent(out) :: wrong, points
    real(dp), intent(out) :: total
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    pass%noise = SAFETY**2*settings%tolerance*iterate%least_magnitude
    pass%shift = state%offset
    call pass%go(exchange_points, 3)
    wrong = nint(pass%total(1))
    total = pass%total(2)
    points = nint(pass%total(3))
  end subroutine exchange

  !> Confirm a contact set without wrong points, whose forces have the sum `total`, by a product in double precision;
  !> `confirmed` if the residual is within the tolerance, or has not halved since the last confirmation,
  !> `previous_residual`. The arguments are nine, as of confirm_contact_set, the state and the sum.
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
    call set_load(scene, total, state, iterate)
    call refresh(operator, scene, .false., state, iterate, info)
    if (info%failed()) return
    confirmed = is_accurate(iterate, SAFETY*settings%tolerance) &
                .or. .not. iterate%residual_norm < 0.5_dp*previous_residual
    previous_residual = iterate%residual_norm
  end subroutine confirm

end module fuge_single_search
