!> The iterative engine: from checked data to a solution, using only products with the operator.
!>
!> Earlier solutions (fuge_warm_start), or nested iteration over the coarser grids of the operator (fuge_nested_grids)
!> and a window around a small contact (fuge_contact_window), provide forces to start from; unless these solve the
!> finest grid already, the contact set search there improves them to the tolerance (fuge_contact_set_search).
module fuge_iterative_engine
  use fuge_canonical_problem, only: canonical_problem
  use fuge_complete_contact, only: equal_forces_displace_nothing
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_iterate, only: contact_iterate, start_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set, only: contact_set, note_states
  use fuge_contact_set_search, only: find_contact_set, report_unbounded
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP
  use fuge_contact_window, only: solve_in_window, survey_level
  use fuge_engine_messages, only: idle_forces, report_closed_gap, SINGULAR_AND_UNRESISTED, SINGULAR_ON_CONTACT
  use fuge_feasible_forces, only: make_feasible
  use fuge_general_scene, only: assemble_general, set_general_scene
  use fuge_iterate_evaluation, only: evaluate_iterate
  use fuge_iterated_set, only: iterated_set
  use fuge_iteration_error, only: estimated_force_error, find_rounding
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_nested_grids, only: coarsest_level, nested_iteration, shared_work
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_point_space, only: point_space
  use fuge_repeated_points, only: find_repeated_points
  use fuge_scene_scaling, only: scene_scaling
  use fuge_simple_scene, only: assemble_simple, find_simple_motion, set_simple_scene
  use fuge_probed_compliance, only: probe_compliance
  use fuge_search_settings, only: search_settings
  use fuge_shared_rows, only: rows_of
  use fuge_shared_transfer, only: prolong_to
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_NO_EQUILIBRIUM, FUGE_WARN_NOT_UNIQUE
  use fuge_warm_start, only: load_history
  use fuge_window_confirmation, only: confirm_window
  use fuge_wrong_points, only: choose_contact
  implicit none
  private

  public :: is_general, solve_by_iteration

  !> A mean gap up to this many units in the last place of the largest gap, times the root of the number of points, is
  !> rounding.
  real(dp), parameter :: ROUNDINGS = 4.0_dp
  !> The tolerance of coarser grids on a spring, of that without one.
  real(dp), parameter :: SPRING_SHARE = 0.05_dp

contains

  !> Does the problem have rigid modes of its own, play or exclusions? Then `solve_by_iteration` needs its canonical
  !> form.
  pure function is_general(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: is_general

    is_general = allocated(problem%modes) .or. allocated(problem%gap_upper) .or. allocated(problem%excluded) &
                 .or. problem%has_limits()
  end function is_general

  !> Solve a contact problem by iteration.
  !>
  !> `problem` checked; if plain, with a load > 0; `canonical` its canonical form, if it is general.
  !> `history`: earlier solutions to start from; the caller adds this one. `last` the set of the last solve with this
  !> operator, on return that of this one. `solution` may be unallocated; after an error it is
  !> undefined. Errors:
  !> FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED. The arguments are nine, because the solver keeps what one solve leaves to
  !> the next.
  subroutine solve_by_iteration(operator, problem, canonical, options, monitor, history, last, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(load_history), intent(inout) :: history
    type(iterated_set), intent(inout) :: last
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    type(contact_scene) :: scene
    type(scene_scaling) :: scaling
    type(search_settings) :: coarse_settings, settings
    real(dp) :: force, length
    integer :: coarse_products, fine_products
    logical :: found

    history%started_warm = .false.
    call choose_settings(operator, options, coarse_settings, settings)
    call rows_of(operator, 0, scene%rows, info)
    if (.not. info%failed()) call set_scene(problem, canonical, scene, scaling, info)
    if (info%failed()) return
    call check_approach(operator, problem, scene, info)
    if (.not. info%failed()) call try_warm_start(operator, problem, scene, scaling, history, iterate, info)
    settings%prepared = history%started_warm
    coarse_products = -info%products
    found = .false.
    if (.not. (info%failed() .or. settings%prepared)) then
      call start_on_coarser_grids(operator, coarse_settings, settings, scene, monitor, iterate, found, info)
    end if
    if (info%failed()) return
    coarse_products = coarse_products + info%products
    fine_products = -info%products
    if (.not. found) call find_contact_set(operator, settings, scene, monitor, iterate, info)
    if (.not. info%failed()) call keep_set(iterate%contact_set, last, iterate%gradients, info)
    if (info%failed()) return
    fine_products = fine_products + info%products
    if (settings%prepared) then
      call history%record_warm(iterate%lengths%start_error, fine_products)
    else
      call history%record_cold(iterate%lengths%start_error, options%tolerance, coarse_products, fine_products)
    end if
    if (is_general(problem)) then
      call assemble_general(operator, problem, canonical, scene, scaling, iterate, solution, info)
    else
      call find_simple_motion(operator, scene, scaling, iterate, solution, info)
    end if
    if (info%failed()) return
    call find_rounding(problem, canonical, scene, scaling%load, iterate, solution, length, force)
    call judge_forces(operator, scene, length, force, monitor, iterate, info)
    if (info%failed()) return
    if (.not. is_general(problem)) call assemble_simple(scene, scaling, iterate, solution)
    last%least_compliance = iterate%gradients%least_compliance
    last%tolerance = options%tolerance
  end subroutine solve_by_iteration

  !> The scene of a problem; its rows are set. Errors: FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine set_scene(problem, canonical, scene, scaling, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(inout) :: scene
    type(scene_scaling), intent(out) :: scaling
    type(fuge_info), intent(inout) :: info

    if (is_general(problem)) then
      call set_general_scene(problem, canonical, scene, scaling, info)
    else
      call set_simple_scene(problem, scene, scaling, info)
    end if
  end subroutine set_scene

  !> The settings of the searches on coarser grids, and on the finest one.
  subroutine choose_settings(operator, options, coarse, finest)
    class(fuge_operator), intent(in) :: operator
    type(fuge_options), intent(in) :: options
    type(search_settings), intent(out) :: coarse, finest
    type(point_space) :: space

    space = operator%ranks()
    coarse%limit = iteration_limit(options, space%total_count(operator%points()) + 1)
    ! Beside what a spring gives way, displacements by the contact are small.
    if (operator%translation_spring() > 0.0_dp) coarse%tolerance = SPRING_SHARE*coarse%tolerance
    finest = coarse
    finest%tolerance = options%tolerance
    finest%coarse_grid = .false.
  end subroutine choose_settings

  !> The estimated error of the forces, info%force_error, and a warning where two points are repeated, so that forces
  !> are not unique. `length` and `force` as from `find_rounding`. Errors: FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED, those of
  !> the operator.
  subroutine judge_forces(operator, scene, length, force, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: length, force
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: pair_compliance
    logical :: repeated

    call find_compliance(operator, scene, length, monitor, iterate, pair_compliance, repeated, info)
    if (info%failed()) return
    if (repeated .and. info%status == FUGE_WARN_NOT_UNIQUE) then
      call report(info, FUGE_WARN_NOT_UNIQUE, SINGULAR_AND_UNRESISTED)
    else if (repeated) then
      call report(info, FUGE_WARN_NOT_UNIQUE, SINGULAR_ON_CONTACT)
    end if
    info%force_error = estimated_force_error(iterate, pair_compliance, length, force)
  end subroutine judge_forces

  !> The least compliance of the contact set, by which errors of the forces are judged: that of iterate%gradients and
  !> `pair_compliance` of the operator; and whether two points are `repeated`: then the forces are not unique. `length`
  !> as from `find_rounding`. Errors: those of the operator, FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED.
  subroutine find_compliance(operator, scene, length, monitor, iterate, pair_compliance, repeated, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: length
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: pair_compliance
    logical, intent(out) :: repeated
    type(fuge_info), intent(inout) :: info
    real(dp) :: compliance
    logical :: enough, preconditioned
    integer :: pair(2)

    repeated = .false.
    if (allocated(scene%modes)) then
      pair_compliance = operator%least_pair_compliance(iterate%contact, scene%modes)
    else
      pair_compliance = operator%least_pair_compliance(iterate%contact, reshape([real(dp) ::], [size(scene%gap), 0]))
    end if
    preconditioned = operator%has_preconditioner()
    ! On a grid the preconditioner is close to an inverse, and what conjugate gradients have found is enough.
    enough = preconditioned .and. iterate%gradients%least_compliance > 0.0_dp
    if (enough) enough = all(operator%grid() > 0)
    if (.not. enough) then
      call probe_compliance(operator, scene, length, monitor, iterate, compliance, info)
      if (info%failed()) return
      iterate%gradients%least_compliance = compliance
    end if
    repeated = .not. pair_compliance > 0.0_dp
    if (preconditioned .or. pair_compliance < huge(pair_compliance)) return
    call find_repeated_points(operator, scene, iterate, pair, info)
    repeated = pair(1) > 0
  end subroutine find_compliance

  !> Keep the contact set for derivatives, and what conjugate gradients found on it. A start that needs no step tells
  !> nothing of the operator: the last solve on the same set does. Error: FUGE_ERR_MEMORY.
  subroutine keep_set(set, last, gradients, info)
    type(contact_set), intent(in) :: set
    type(iterated_set), intent(inout) :: last
    type(conjugate_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    logical :: same
    integer :: stat

    stat = 0
    same = .false.
    if (allocated(last%state)) then
      if (size(last%state) /= size(set%contact)) deallocate (last%state)
    end if
    if (.not. allocated(last%state)) then
      allocate (last%state(size(set%contact)), stat=stat)
      call require_memory(stat, 'the contact set of', size(set%contact), 'points', info)
    else
      same = all((abs(last%state) == FUGE_AT_LOWER_STOP) .eqv. set%contact)
    end if
    associate (space => set%segments%space)
      call space%agree(info)
      if (info%failed()) return
      if (.not. gradients%least_compliance > 0.0_dp) then
        if (space%everywhere(same)) gradients%least_compliance = last%least_compliance
      end if
    end associate
    call note_states(set, last%state)
    last%least_compliance = gradients%least_compliance
  end subroutine keep_set

  !> Start from earlier solutions if that promises to cost less than coarser grids: history%started_warm, with the
  !> contact set and the displacements of `iterate`, which otherwise stays as it was. Errors: FUGE_ERR_MEMORY, those of
  !> the operator.
  subroutine try_warm_start(operator, problem, scene, scaling, history, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(contact_scene), intent(in) :: scene
    type(scene_scaling), intent(in) :: scaling
    type(load_history), intent(inout) :: history
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: start(:)

    call history%predict(problem, scene%rows%point_space, start)
    if (.not. allocated(start)) return
    ! Forces of another order of magnitude are no start, and their squares would overflow.
    if (2*(exponent(scene%rows%largest(maxval(abs(start)))) - exponent(scaling%load)) > LARGEST_EXPONENT) return
    start = start/scaling%load
    call start_iterate(iterate, scene, start, info)
    if (info%failed()) return
    call choose_contact(scene, iterate%contact_set)
    if (scene%rows%anywhere(any(iterate%contact))) then
      call make_feasible(operator, scene, iterate, info)
      if (.not. info%failed()) call evaluate_iterate(operator, scene, iterate, info)
      if (info%failed()) return
      call history%judge(iterate%lengths%start_error)
    end if
    if (.not. history%started_warm) call discard(iterate)
  end subroutine try_warm_start

  !> Free all arrays.
  subroutine discard(iterate)
    type(contact_iterate), intent(out) :: iterate

    iterate%gradients%converged = .false.
  end subroutine discard

  !> Start `iterate` by coarser grids, and where the contact is small by a window of the finest one; where the operator
  !> has neither, from what start_iterate chooses. `found`: the iterate solves the finest grid. Errors: those of
  !> nested_iteration.
  subroutine start_on_coarser_grids(operator, coarse_settings, settings, scene, monitor, iterate, found, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: coarse_settings, settings
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    logical, intent(out) :: found
    type(fuge_info), intent(inout) :: info
    type(shared_work) :: work
    real(dp), allocatable :: start(:)
    integer :: level
    logical :: solved

    found = .false.
    solved = .false.
    level = 0
    if (scene%rows%everywhere(scene%fits_window())) level = survey_level(operator)
    call nested_iteration(operator, coarse_settings, scene, coarsest_level(operator), max(level, 1), monitor, &
                          start, work, info)
    if (level > 0 .and. allocated(start) .and. .not. info%failed()) then
      call solve_in_window(operator, coarse_settings, settings, scene, level, monitor, start, work, solved, &
                           iterate%gradients%least_compliance, info)
    end if
    if (.not. (solved .or. info%failed())) then
      call nested_iteration(operator, coarse_settings, scene, level - 1, 1, monitor, start, work, info)
      if (allocated(start) .and. .not. info%failed()) call prolong_to(operator, start, info)
    end if
    info%products = info%products + ceiling(work%products/real(scene%points(), dp))
    info%preconditionings = info%preconditionings + ceiling(work%preconditionings/real(scene%points(), dp))
    if (.not. info%failed()) call start_iterate(iterate, scene, start, info)
    if (allocated(start)) deallocate (start)
    if (solved .and. .not. info%failed()) call confirm_window(operator, settings, scene, iterate, found, info)
  end subroutine start_on_coarser_grids

  !> Refuse prescribed motions at which the mean gap is closed by more than the rounding of the gaps, where equal forces
  !> displace nothing, as on a periodic surface: no forces resist it. Errors: FUGE_ERR_NO_EQUILIBRIUM,
  !> FUGE_ERR_NOT_DEFINITE without motions, those of equal_forces_displace_nothing.
  subroutine check_approach(operator, problem, scene, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(contact_scene), intent(in) :: scene
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest, mean

    if (.not. scene%is_simple() .or. .not. scene%prescribed) return
    mean = scene%rows%total(sum(scene%gap))/real(scene%points(), dp)
    largest = scene%rows%largest(max(maxval(abs(scene%gap)), maxval(abs(problem%gap))))
    if (.not. allocated(problem%modes)) largest = max(abs(problem%motion(1)), &
                                                      scene%rows%largest(maxval(abs(scene%gap))))
    if (mean >= -ROUNDINGS*epsilon(mean)*largest*sqrt(real(scene%points(), dp))) return
    if (.not. equal_forces_displace_nothing(operator, info)) return
    if (info%failed()) return
    if (problem%mode_count() < 1) then
      ! Without any motion there is none to change.
      call report_unbounded(1, scene%has_limits(), info)
    else if (allocated(problem%modes)) then
      call report_closed_gap(-mean, operator%grid(), info)
    else
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, idle_forces(operator%grid())//', so no forces hold the approach ' &
                  //text(problem%motion(1))//', at which the mean gap is closed: prescribe ' &
                  //'less than '//text(problem%motion(1) + mean)//', or a load')
    end if
  end subroutine check_approach

end module fuge_iterative_engine
