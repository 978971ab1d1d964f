!> The iterative engine: from checked data to a solution, using only products with the operator.
!>
!> It solves in two stages: nested iteration over the coarser grids of the operator provides forces
!> to start from (fuge_nested_grids); the contact set search on the finest grid improves them to
!> the tolerance (fuge_contact_set_search).
module fuge_iterative_engine
  use fuge_complete_contact, only: equal_forces_displace_nothing
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_window, only: solve_in_window, survey_level
  use fuge_contact_set_search, only: find_contact_set, make_feasible, search_settings
  use fuge_grid_transfer, only: prolong
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_nested_grids, only: coarsest_level, nested_iteration, shared_work
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_projected_gradients, only: contact_iterate, deformed_gap, evaluate_iterate, start_iterate
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: solve_by_iteration

  !> The forces of the last solve are a good start if residual and penetration are below this
  !> fraction of the least magnitude.
  real(dp), parameter :: GOOD_START = 0.2_dp
  !> Forces up to this many units in the last place of the largest force are rounding, and so is a mean
  !> gap up to as many of the largest gap.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

contains

  !> Solve a contact problem by iteration.
  !>
  !> `problem` checked; plain with a load > 0, or with its one motion, the approach, prescribed.
  !> `scaled_force` (n), if allocated, are forces to start from, divided by the load if there is
  !> one; on return those of the solution. `solution` may be unallocated; it is written only on
  !> success. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_DEFINITE,
  !> FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED.
  subroutine solve_by_iteration(operator, problem, options, monitor, scaled_force, solution, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: scaled_force(:)
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate
    type(search_settings) :: coarse_settings, settings
    real(dp), allocatable :: reduced_gap(:)
    real(dp) :: gap_datum, load

    coarse_settings%limit = iteration_limit(options, operator%points() + 1)
    coarse_settings%prescribed = .not. problem%is_plain()
    settings = coarse_settings
    settings%tolerance = options%tolerance
    settings%coarse_grid = .false.
    call choose_scaling(problem, gap_datum, load)
    call check_range(problem, info)
    if (.not. info%failed()) call reduce_gap(problem%gap, gap_datum, load, reduced_gap, info)
    if (info%failed()) return
    if (settings%prescribed) call check_approach(operator, problem%motion(1), reduced_gap, info)
    if (allocated(scaled_force) .and. .not. info%failed()) then
      call discard_poor_start(operator, settings%prescribed, reduced_gap, scaled_force, info)
    end if
    if (.not. (info%failed() .or. allocated(scaled_force))) then
      call start_on_coarser_grids(operator, coarse_settings, settings, reduced_gap, monitor, scaled_force, info)
    end if
    if (.not. info%failed()) then
      call start_iterate(iterate, size(reduced_gap), settings%prescribed, scaled_force, info)
    end if
    if (info%failed()) return
    call find_contact_set(operator, settings, reduced_gap, monitor, iterate, info)
    if (.not. info%failed()) call assemble_solution(operator, reduced_gap, gap_datum, load, iterate, solution, info)
    if (.not. info%failed()) call move_alloc(iterate%force, scaled_force)
  end subroutine solve_by_iteration

  !> Forces to start from, `start`, by coarser grids, and where the contact is small by a window of the finest one.
  !> `start` stays unallocated where the operator has no coarser grids. Errors: those of nested_iteration.
  subroutine start_on_coarser_grids(operator, coarse_settings, settings, reduced_gap, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(search_settings), intent(in) :: coarse_settings, settings
    real(dp), intent(in), contiguous :: reduced_gap(:)
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    type(shared_work) :: work
    integer :: level
    logical :: solved

    solved = .false.
    level = survey_level(operator)
    call nested_iteration(operator, coarse_settings, reduced_gap, coarsest_level(operator), max(level, 1), monitor, &
                          start, work, info)
    if (level > 0 .and. allocated(start) .and. .not. info%failed()) then
      call solve_in_window(operator, coarse_settings, settings, reduced_gap, level, monitor, start, work, solved, info)
    end if
    if (.not. (solved .or. info%failed())) then
      call nested_iteration(operator, coarse_settings, reduced_gap, level - 1, 1, monitor, start, work, info)
      if (allocated(start) .and. .not. info%failed()) call prolong(operator%grid(), start, info)
    end if
    info%products = info%products + ceiling(work%products/real(size(reduced_gap), dp))
    info%preconditionings = info%preconditionings + ceiling(work%preconditionings/real(size(reduced_gap), dp))
  end subroutine start_on_coarser_grids

  !> What the iteration subtracts from gaps, the prescribed motion or else the least gap, and what
  !> it divides forces and lengths by: the load, or 1 for a prescribed motion.
  pure subroutine choose_scaling(problem, gap_datum, load)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(out) :: gap_datum, load

    if (problem%is_plain()) then
      gap_datum = minval(problem%gap)
      load = problem%resultant(1)
    else
      gap_datum = problem%motion(1)
      load = 1.0_dp
    end if
  end subroutine choose_scaling

  !> reduced_gap = (gap - gap_datum)/load, both gaps (n). Error: FUGE_ERR_MEMORY.
  pure subroutine reduce_gap(gap, gap_datum, load, reduced_gap, info)
    real(dp), intent(in) :: gap(:), gap_datum, load
    real(dp), allocatable, intent(out) :: reduced_gap(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (reduced_gap(size(gap)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps of '//text(size(gap))//' points')
    else
      reduced_gap = (gap - gap_datum)/load
    end if
  end subroutine reduce_gap

  !> Forces, gaps and motion in the units of the problem. Error: FUGE_ERR_MEMORY.
  subroutine assemble_solution(operator, reduced_gap, gap_datum, load, iterate, solution, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: reduced_gap(:), gap_datum, load
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: force(:), gap(:), motion(:)
    integer :: n, stat

    n = size(reduced_gap)
    allocate (force(n), gap(n), motion(1), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the forces and gaps of '//text(n)//' points')
      return
    end if
    where (iterate%force <= ROUNDINGS*epsilon(1.0_dp)*maxval(iterate%force)) iterate%force = 0.0_dp
    force = load*iterate%force
    gap = load*max(deformed_gap(reduced_gap, iterate%displacement, iterate%motion), 0.0_dp)
    where (iterate%contact) gap = 0.0_dp
    motion = gap_datum
    if (.not. iterate%prescribed) motion = (load*iterate%motion + operator%datum()*sum(force)) + gap_datum
    call move_alloc(force, solution%force)
    call move_alloc(gap, solution%gap)
    call move_alloc(motion, solution%motion)
  end subroutine assemble_solution

  !> Refuse an approach at which the mean gap is closed, or open by no more than the rounding of the
  !> gaps, where equal forces displace nothing, as on a periodic surface: no forces resist it, or
  !> any equal ones do. Errors: FUGE_ERR_NO_EQUILIBRIUM, those of equal_forces_displace_nothing.
  subroutine check_approach(operator, approach, reduced_gap, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: approach
    real(dp), intent(in) :: reduced_gap(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: mean

    mean = sum(reduced_gap)/real(size(reduced_gap), dp)
    if (mean > ROUNDINGS*epsilon(mean)*max(abs(approach), maxval(abs(reduced_gap)))) return
    if (.not. equal_forces_displace_nothing(operator, info)) return
    if (info%failed()) return
    call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'equal forces displace nothing (a periodic surface), so no forces ' &
                //'hold the approach '//text(approach)//', at which the mean gap is closed: prescribe less than ' &
                //text(approach + mean)//', or a load')
  end subroutine check_approach

  !> Deallocate forces to start from, `scaled_force` (n), that are far from the solution:
  !> coarser grids, if the points are cells in a row, provide a better start. Errors:
  !> FUGE_ERR_MEMORY, those of the operator.
  subroutine discard_poor_start(operator, prescribed, reduced_gap, scaled_force, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: prescribed
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), allocatable, intent(inout) :: scaled_force(:)
    type(fuge_info), intent(inout) :: info
    type(contact_iterate) :: iterate

    if (any(operator%grid() < 1)) return
    call start_iterate(iterate, size(scaled_force), prescribed, scaled_force, info)
    if (info%failed()) return
    iterate%contact = scaled_force > 0.0_dp
    call make_feasible(operator, iterate, info)
    if (.not. info%failed()) call evaluate_iterate(operator, reduced_gap, iterate, info)
    if (info%failed()) return
    if (max(iterate%residual_norm, iterate%penetration) > GOOD_START*iterate%least_magnitude) deallocate (scaled_force)
  end subroutine discard_poor_start

  !> Refuse gaps so large that their squares overflow, after division by the load if there is one.
  !> Error: FUGE_ERR_OVERFLOW.
  pure subroutine check_range(problem, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: excess

    if (.not. problem%is_plain()) then
      excess = exponent(maxval(abs(problem%gap - problem%motion(1))))
    else
      excess = exponent(maxval(problem%gap) - minval(problem%gap)) - exponent(problem%resultant(1))
    end if
    if (2*excess <= LARGEST_EXPONENT) return
    if (problem%is_plain()) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps are 2**'//text(excess)//' times the load: choose units in which ' &
                  //'they are nearer to it')
    else
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps differ by 2**'//text(excess)//' from the prescribed approach: ' &
                  //'choose units in which lengths are nearer to 1')
    end if
  end subroutine check_range

end module fuge_iterative_engine
