!> Search for the contact set of one grid, using only products with the operator.
!>
!> Each iteration solves on the present set by conjugate gradients, just accurately enough to tell
!> which points are in tension and which penetrate, and exchanges those. Where block exchanges
!> stop making progress, a primal active-set method exchanges one point at a time: it lowers the
!> energy in each step and so terminates.
module fuge_contact_set_search
  use fuge_blocking_step, only: is_tensile, step_to_blocking
  use fuge_complete_contact, only: equal_forces_displace_nothing
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set, only: contact_set, find_states
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_feasible_forces, only: make_feasible
  use fuge_iterate_evaluation, only: evaluate_iterate
  use fuge_iterate_lengths, only: iterate_lengths
  use fuge_iteration_progress, only: tell_progress
  use fuge_kinds, only: dp
  use fuge_limited_descent, only: descend_within_limits
  use fuge_limited_points, only: release_furthest, set_balanced_forces, step_to_limit
  use fuge_monitor_type, only: fuge_monitor
  use fuge_number_text, only: index_text
  use fuge_operator_type, only: fuge_operator
  use fuge_projected_gradients, only: run_projected_gradients
  use fuge_search_settings, only: search_settings, MAX_STALLS, SAFETY, WRONG_ON_COARSE
  use fuge_single_search, only: find_in_single, suits_single
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_NOT_DEFINITE
  use fuge_wrong_points, only: change_state, choose_contact, count_wrong_points, deepest_open_point, &
    exchange_wrong_points, greatest_tension
  implicit none
  private

  public :: find_contact_set, report_unbounded

  !> Limits whose sum is beyond the load by this fraction carry just the load.
  real(dp), parameter :: NEARLY = 1.0e-8_dp
  !> Tensions up to this many units in the last place of the largest force are rounding in any case.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

  !> What a search knows from one contact set to the next.
  type :: set_search
    type(contact_preconditioner) :: preconditioner
    type(stall_counter) :: stalls
    !> The residual of the last confirmation.
    real(dp) :: previous_residual = huge(1.0_dp)
    !> The set is solved to the tolerance, not just until it can be judged.
    logical :: to_tolerance = .false.
    !> The displacements are those of a product with feasible forces.
    logical :: fresh = .true.
    !> Projected gradients have been tried.
    logical :: descended = .false.
    !> The set is found, or nothing is left to try.
    logical :: done = .false.
  end type set_search

contains

  !> Find the contact set of one grid and its forces.
  !>
  !> `iterate` in: forces to start from; out: forces, displacements, contact set and motion. Counts contact sets,
  !> products and preconditionings in `info`. Errors: those of the operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY,
  !> FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CANCELLED.
  subroutine find_contact_set(operator, settings, scene, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    type(set_search) :: search
    integer :: wrong
    logical :: found, in_single, prepared

    prepared = settings%prepared
    in_single = suits_single(operator, scene)
    if (in_single) in_single = .not. carry_just_the_load(scene)
    if (in_single) then
      call find_in_single(operator, settings, scene, monitor, iterate, found, info)
      if (found .or. info%failed()) return
      prepared = .false.
      iterate%projection%needs_basis = .true.
    end if
    call search%stalls%start(MAX_STALLS)
    call choose_first_set(operator, scene, prepared, iterate, info)
    do while (.not. (search%done .or. info%failed()))
      if (has_undetermined_forces(operator, scene, iterate%contact, info)) then
        call solve_complete_contact(operator, settings, search%preconditioner, scene, monitor, iterate, info)
        search%done = scene%rows%everywhere(all(iterate%contact))
        call search%stalls%spend()
        cycle
      end if
      if (info%failed()) exit
      call solve_and_judge(operator, settings, scene, monitor, search, iterate, wrong, info)
      if (search%done .or. wrong == 0 .or. info%failed()) cycle
      call search%stalls%spend()
      call search%stalls%renew_if_fewer(wrong)
      if (search%stalls%has_stalled()) then
        call leave_stall(operator, settings, scene, monitor, search, iterate, info)
      else
        call choose_next_set(operator, settings, scene, search, iterate, info)
      end if
    end do
    info%preconditionings = info%preconditionings + ceiling(search%preconditioner%coarse_share)
  end subroutine find_contact_set

  !> The first contact set, unless the iterate is `prepared`, and feasible forces on it. Errors: those of the operator,
  !> FUGE_ERR_MEMORY.
  subroutine choose_first_set(operator, scene, prepared, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: prepared
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    if (carry_just_the_load(scene)) then
      call start_at_limits(operator, scene, iterate, info)
    else if (prepared) then
      return
    else
      call choose_contact(scene, iterate%contact_set)
    end if
    if (.not. info%failed()) call make_feasible(operator, scene, iterate, info)
  end subroutine choose_first_set

  !> Solve on the present set, and count its `wrong` points, on the finest grid by exact displacements before it is
  !> `done`. Errors: those of find_contact_set.
  subroutine solve_and_judge(operator, settings, scene, monitor, search, iterate, wrong, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(set_search), intent(inout) :: search
    type(contact_iterate), intent(inout) :: iterate
    integer, intent(out) :: wrong
    type(fuge_info), intent(inout) :: info
    integer :: products
    logical :: confirmed

    wrong = 0
    products = info%products
    call solve_on_contact_set(operator, settings, search%preconditioner, scene, search%to_tolerance, monitor, iterate, &
                              info)
    if (info%failed()) return
    search%fresh = search%fresh .and. info%products == products
    wrong = count_wrong_points(scene, penetration_noise(settings, iterate%lengths), iterate)
    if (settings%coarse_grid) search%done = wrong <= WRONG_ON_COARSE*scene%rows%total_count(count(iterate%contact))
    ! Without a step the displacements are still those of a product with feasible forces.
    if (wrong == 0) search%done = search%done .or. (iterate%gradients%converged .and. search%fresh)
    if (search%done) return
    if (wrong == 0 .and. (search%to_tolerance .or. iterate%gradients%converged)) then
      call confirm_contact_set(operator, settings, scene, search%previous_residual, iterate, confirmed, info)
      if (info%failed()) return
      ! The lengths that decide may have been those of much larger forces at the start.
      if (confirmed) wrong = count_wrong_points(scene, penetration_noise(settings, iterate%lengths), iterate)
      search%done = confirmed .and. wrong == 0
    end if
    search%to_tolerance = wrong == 0
  end subroutine solve_and_judge

  !> Exchange the wrong points, for feasible forces on another set. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine choose_next_set(operator, settings, scene, search, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    type(set_search), intent(inout) :: search
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    integer :: cells(2)
    logical :: in_row

    cells = operator%grid()
    in_row = all(cells > 0) .and. any(cells == 1) .and. .not. scene%has_limits()
    call exchange_wrong_points(scene, penetration_noise(settings, iterate%lengths), &
                               in_row .and. 2*search%stalls%left > MAX_STALLS, iterate, info)
    if (info%failed()) return
    call begin_new_set(search, iterate%gradients)
    call make_feasible(operator, scene, iterate, info)
  end subroutine choose_next_set

  !> Residuals and compliances of another set tell nothing of this one.
  pure subroutine begin_new_set(search, gradients)
    type(set_search), intent(inout) :: search
    type(conjugate_gradients), intent(inout) :: gradients

    gradients%least_compliance = 0.0_dp
    search%previous_residual = huge(search%previous_residual)
    search%fresh = .true.
  end subroutine begin_new_set

  !> Where block exchanges make no progress: exchange single points to the end, after projected gradients where forces
  !> have limits; on a coarser grid forces to start from are worth no exchanges of those. Errors: those of
  !> find_contact_set.
  subroutine leave_stall(operator, settings, scene, monitor, search, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(set_search), intent(inout) :: search
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    search%done = .true.
    if (.not. scene%has_limits()) then
      call exchange_single_points(operator, settings, search%preconditioner, scene, monitor, iterate, info)
      return
    end if
    if (settings%coarse_grid) return
    search%done = .not. scene%rows%everywhere(scene%fits_window() .and. .not. search%descended)
    if (search%done) then
      call exchange_single_limits(operator, settings, search%preconditioner, scene, monitor, iterate, info)
      return
    end if
    search%descended = .true.
    call set_feasible_start(operator, scene, iterate, info)
    if (.not. info%failed()) call descend_within_limits(operator, scene, monitor, iterate, info)
    if (info%failed()) return
    call choose_contact(scene, iterate%contact_set)
    call begin_new_set(search, iterate%gradients)
    call search%stalls%start(MAX_STALLS)
    call make_feasible(operator, scene, iterate, info)
  end subroutine leave_stall

  !> Do all limits together carry just the load, which is 1?
  function carry_just_the_load(scene) result(carry)
    type(contact_scene), intent(in) :: scene
    logical :: carry

    carry = scene%has_limits() .and. .not. (scene%prescribed .or. allocated(scene%modes))
    if (carry) carry = scene%rows%total(sum(min(scene%limit, 1.0_dp))) <= 1.0_dp + NEARLY
  end function carry_just_the_load

  !> Limits that carry just the load: all points are at theirs, but for the last one to come there. Errors: those of
  !> the operator.
  subroutine start_at_limits(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    ! A point without a limit carries no more than the load, which is 1.
    iterate%force = min(scene%limit, 1.0_dp)
    if (allocated(scene%excluded)) where (scene%excluded) iterate%force = 0.0_dp
    iterate%contact = .false.
    iterate%limited = merge(1, 0, iterate%force > 0.0_dp)
    call compute_displacement(operator, scene%counts_datum(), iterate%force, iterate%displacement, info)
    ! A point of next to no force does not carry what the others leave.
    if (.not. info%failed()) call release_furthest(scene, NEARLY, iterate)
  end subroutine start_at_limits

  !> Is the contact complete and its forces undetermined, because the motion is prescribed and equal
  !> forces displace nothing? Errors: those of equal_forces_displace_nothing.
  function has_undetermined_forces(operator, scene, contact, info) result(undetermined)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    logical :: undetermined

    undetermined = .false.
    if (.not. (scene%prescribed .and. scene%is_simple())) return
    if (scene%rows%everywhere(all(contact))) undetermined = equal_forces_displace_nothing(operator, info)
  end function has_undetermined_forces

  !> Leave a complete contact whose forces are undetermined: its equations fix the differences of
  !> the forces only, and no forces close a mean gap that the approach leaves open.
  !>
  !> The points whose forces are above the mean stay: those in contact under the least load. Where the mean gap is
  !> closed, the contact stays complete, under the least load that closes it: on a coarser grid, or on the finest one
  !> but for rounding.
  subroutine solve_complete_contact(operator, settings, preconditioner, scene, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    type(contact_scene) :: free
    real(dp) :: sums(2)
    integer :: stat

    sums = [sum(scene%gap), sum(abs(scene%gap))]
    call scene%rows%add(sums)
    free%rows = scene%rows
    allocate (free%gap, source=scene%gap, stat=stat)
    call require_memory(stat, 'the gaps of', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call solve_on_contact_set(operator, settings, preconditioner, free, .false., monitor, iterate, info)
    if (info%failed()) return
    if (.not. sums(1) > ROUNDINGS*epsilon(1.0_dp)*sums(2)) then
      iterate%force = iterate%force - scene%rows%least(minval(iterate%force))
    else
      iterate%force = iterate%force - scene%rows%total(sum(iterate%force))/real(scene%points(), dp)
      iterate%contact = iterate%force > 0.0_dp
      call make_feasible(operator, scene, iterate, info)
    end if
  end subroutine solve_complete_contact

  !> Solve for the forces of the present contact set, which counts as one iteration: to the
  !> tolerance if `to_tolerance`, else until the set can be judged.
  subroutine solve_on_contact_set(operator, settings, preconditioner, scene, to_tolerance, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: to_tolerance
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: compliance

    call settings%check_limit(info)
    if (info%failed()) return
    compliance = 0.0_dp
    if (.not. operator%has_preconditioner()) compliance = maxval(abs(iterate%displacement))
    call preconditioner%set(operator, iterate%contact, .not. scene%prescribed, compliance, info)
    if (allocated(scene%modes) .and. .not. info%failed()) then
      call preconditioner%set_modes(operator, iterate%projection, iterate%segments, iterate%contact, info)
    end if
    if (info%failed()) return
    call set_tension_noise(settings, scene, iterate%lengths, iterate%gradients%softness, iterate%contact_set)
    call run_projected_gradients(operator, preconditioner, scene, SAFETY*settings%tolerance, to_tolerance, &
                                 iterate, info)
    if (iterate%gradients%unbounded .and. .not. (settings%coarse_grid .or. info%failed())) then
      call report_unbounded(maxloc(abs(iterate%gradients%direction), dim=1), scene%has_limits(), info)
    end if
    if (info%failed()) return
    info%iterations = info%iterations + 1
    if (.not. settings%coarse_grid) call iterate%gradients%note_least_compliance()
    call tell_progress(scene, iterate, monitor, info)
  end subroutine solve_on_contact_set

  !> Report that forces without energy, the largest of them at `point`, grow without bound, or, where forces are
  !> `limited`, to limits at which this engine does not look for a solution (FUGE_ERR_NOT_DEFINITE).
  pure subroutine report_unbounded(point, limited, info)
    integer, intent(in) :: point
    logical, intent(in) :: limited
    type(fuge_info), intent(inout) :: info

    if (limited) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the operator is singular: forces that store no energy, the largest ' &
                  //'at point '//index_text(point)//', cannot move the points to their stops; with a matrix ' &
                  //'FUGE_ACTIVE_SET takes them up to their limits')
      return
    end if
    call report(info, FUGE_ERR_NOT_DEFINITE, 'the operator is singular, and there is no solution: forces that store ' &
                //'no energy, the largest at point '//index_text(point)//', cannot move the points to their stops; ' &
                //'free the rigid motion that can, or change the gaps')
  end subroutine report_unbounded

  !> Confirm a contact set without wrong points by a fresh product, because displacements and residuals updated by
  !> recurrence drift. `previous_residual` of the last confirmation.
  subroutine confirm_contact_set(operator, settings, scene, previous_residual, iterate, confirmed, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    real(dp), intent(inout) :: previous_residual
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: confirmed
    type(fuge_info), intent(inout) :: info

    confirmed = .false.
    call make_feasible(operator, scene, iterate, info)
    if (.not. info%failed()) call evaluate_iterate(operator, scene, iterate, info)
    if (info%failed()) return
    call set_tension_noise(settings, scene, iterate%lengths, iterate%gradients%softness, iterate%contact_set)
    call iterate%lengths%confirm(SAFETY*settings%tolerance, previous_residual, confirmed)
  end subroutine confirm_contact_set

  !> Set the tension that is rounding. Only with several modes, where a point without force may be the one that resists
  !> a motion.
  subroutine set_tension_noise(settings, scene, lengths, softness, set)
    type(search_settings), intent(in) :: settings
    type(contact_scene), intent(in) :: scene
    type(iterate_lengths), intent(in) :: lengths
    real(dp), intent(in) :: softness
    type(contact_set), intent(inout) :: set
    real(dp) :: largest

    if (.not. allocated(scene%modes)) then
      ! The last points carry what a sum leaves of the load, with its rounding.
      if (carry_just_the_load(scene)) set%tension_noise = ROUNDINGS*epsilon(1.0_dp)*sqrt(real(scene%points(), dp))
      return
    end if
    largest = scene%rows%largest(maxval(abs(set%force)))
    set%tension_noise = max(tension_by_rounding(settings, lengths, softness, largest), scene%rounding_force(softness))
  end subroutine set_tension_noise

  !> Tensions up to this are rounding, where forces reach `largest`. They are taken out in the end, so that they may not
  !> displace by more than the tolerance allows.
  pure function tension_by_rounding(settings, lengths, softness, largest) result(noise)
    type(search_settings), intent(in) :: settings
    type(iterate_lengths), intent(in) :: lengths
    real(dp), intent(in) :: softness, largest
    real(dp) :: noise
    real(dp) :: length

    length = penetration_noise(settings, lengths)
    noise = SAFETY**2*settings%tolerance*largest
    if (noise*softness > length) noise = max(length/softness, ROUNDINGS*epsilon(noise)*largest)
  end function tension_by_rounding

  !> Penetrations below this are rounding.
  pure function penetration_noise(settings, lengths) result(noise)
    type(search_settings), intent(in) :: settings
    type(iterate_lengths), intent(in) :: lengths
    real(dp) :: noise

    noise = lengths%allowed(SAFETY**2*settings%tolerance)
  end function penetration_noise

  !> Primal active-set method (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974,
  !> chapter 23), which exchanges one point at a time and lowers the energy.
  !>
  !> Step from feasible forces towards the solution of their set until a force would become
  !> tensile: that point leaves. At the solution the point of deepest penetration joins. Stop when
  !> no point penetrates, or when the equations of the set can no longer be solved to the
  !> tolerance: penetrations are then rounding. doc/theory.md shows why it terminates.
  subroutine exchange_single_points(operator, settings, preconditioner, scene, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: feasible(:), noise(:)
    logical, allocatable :: locked(:), tied(:)
    integer, allocatable :: state(:)
    integer :: newest, n, stat
    logical :: found

    n = size(scene%gap)
    allocate (feasible(n), noise(n), locked(n), tied(n), state(n), stat=stat)
    call require_memory(stat, 'the active-set method on', n, 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    found = .false.
    locked = .false.
    tied = scene%tied_points()
    newest = 0
    call make_feasible(operator, scene, iterate, info)
    if (allocated(scene%modes) .and. .not. info%failed()) then
      call step_from_balance(scene, tied, feasible, noise, locked, state, iterate%contact_set)
      locked = .false.
    end if
    call choose_contact(scene, iterate%contact_set)
    if (.not. info%failed()) call make_feasible(operator, scene, iterate, info)
    do while (.not. info%failed())
      feasible = iterate%force
      call solve_on_contact_set(operator, settings, preconditioner, scene, .true., monitor, iterate, info)
      if (info%failed()) exit
      noise = iterate%tension_noise
      call find_states(iterate%contact_set, state)
      if (scene%rows%anywhere(any(is_tensile(iterate%force, noise, state, tied)))) then
        call step_to_blocking(iterate%force, noise, tied, state, feasible, newest, locked, scene%rows%point_space)
        iterate%contact = state /= FUGE_OPEN
        iterate%force = feasible
      else
        if (found) call keep_lock(scene, newest, locked)
        newest = deepest_open_point(scene, iterate, penetration_noise(settings, iterate%lengths), locked)
        found = scene%rows%anywhere(newest > 0)
        if (.not. (found .and. iterate%gradients%converged)) exit
        if (newest > 0) call change_state(scene, newest, iterate)
        ! A penetration at the only open point is rounding.
        if (has_undetermined_forces(operator, scene, iterate%contact, info)) then
          if (newest > 0) iterate%contact(newest) = .false.
          exit
        end if
      end if
      iterate%gradients%least_compliance = 0.0_dp
      if (.not. info%failed()) call make_feasible(operator, scene, iterate, info)
    end do
    if (.not. info%failed()) call make_feasible(operator, scene, iterate, info)
    if (.not. info%failed()) call evaluate_iterate(operator, scene, iterate, info)
  end subroutine exchange_single_points

  !> As exchange_single_points, where forces have limits: a step ends where the first force reaches zero or its limit,
  !> and at the solution of a set the point furthest on the wrong side of its stop comes back to it.
  subroutine exchange_single_limits(operator, settings, preconditioner, scene, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: settings
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: feasible(:)
    logical, allocatable :: locked(:)
    integer :: newest, stat

    allocate (feasible(size(scene%gap)), locked(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the active-set method on', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    locked = .false.
    newest = 0
    call set_feasible_start(operator, scene, iterate, info)
    do while (.not. info%failed())
      feasible = iterate%force
      call solve_on_contact_set(operator, settings, preconditioner, scene, .true., monitor, iterate, info)
      if (info%failed()) exit
      if (greatest_tension(scene, iterate%contact_set) > 0.0_dp) then
        call step_to_limit(scene, feasible, newest, locked, iterate%contact_set)
      else
        call keep_lock(scene, newest, locked)
        if (.not. iterate%gradients%converged) exit
        newest = deepest_open_point(scene, iterate, penetration_noise(settings, iterate%lengths), locked)
        if (.not. scene%rows%anywhere(newest > 0)) exit
        if (newest > 0) call change_state(scene, newest, iterate)
      end if
      iterate%gradients%least_compliance = 0.0_dp
      call make_feasible(operator, scene, iterate, info)
    end do
    if (.not. info%failed()) call make_feasible(operator, scene, iterate, info)
    if (.not. info%failed()) call evaluate_iterate(operator, scene, iterate, info)
  end subroutine exchange_single_limits

  !> Forces within their limits, with the resultants of the scene, and their displacements. Errors: those of the
  !> operator.
  subroutine set_feasible_start(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: excess

    call make_feasible(operator, scene, iterate, info)
    if (info%failed()) return
    ! Forces of the right resultants may be beyond their limits.
    excess = greatest_tension(scene, iterate%contact_set)
    if (.not. (allocated(scene%modes) .or. excess > 0.0_dp)) return
    call set_balanced_forces(scene, iterate%contact_set)
    call make_feasible(operator, scene, iterate, info)
  end subroutine set_feasible_start

  !> Points stay locked only if the point that joined last, which another rank may have, is locked.
  subroutine keep_lock(scene, newest, locked)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: newest
    logical, intent(inout) :: locked(:)
    logical :: keep

    keep = .false.
    if (newest > 0) keep = locked(newest)
    keep = scene%rows%anywhere(keep)
    locked = locked .and. keep
  end subroutine keep_lock

  !> Forces with the resultants but perhaps of the wrong sign become feasible ones: a step towards them from
  !> scene%balance, until the first force changes its sign. `force`, `noise`, `locked` and `state` (n) are work space.
  subroutine step_from_balance(scene, tied, force, noise, locked, state, set)
    type(contact_scene), intent(in) :: scene
    logical, intent(in) :: tied(:)
    real(dp), intent(out) :: force(:), noise(:)
    logical, intent(out) :: locked(:)
    integer, intent(out) :: state(:)
    type(contact_set), intent(inout) :: set

    force = scene%balance
    noise = 0.0_dp
    locked = .false.
    call find_states(set, state)
    ! Where the balance is at the other stop, or open, it decides.
    where (abs(force) > 0.0_dp) state = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, force > 0.0_dp)
    if (scene%rows%anywhere(any(is_tensile(set%force, noise, state, tied)))) then
      call step_to_blocking(set%force, noise, tied, state, force, 0, locked, scene%rows%point_space)
      set%force = force
    end if
  end subroutine step_from_balance

end module fuge_contact_set_search
