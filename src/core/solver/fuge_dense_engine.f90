!> The engines that need the coefficients of a matrix, the active set and the tableau, from the last contact set on.
module fuge_dense_engine
  use fuge_active_set_engine, only: solve_by_active_set
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_contact_engine, only: matrix_engine
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_contact_states, only: FUGE_LIMITED_LOWER, FUGE_OPEN
  use fuge_force_error, only: estimate_force_error
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, FUGE_ACTIVE_SET, FUGE_AUTO, FUGE_TABLEAU
  use fuge_problem_type, only: fuge_problem, fuge_solution, move_solution
  use fuge_sensitivity, only: find_derivative
  use fuge_spring_matrix, only: extend_problem, find_spring_motions, hold_stiff_motions, name_springs, &
    needs_springs, scale_force_error, shift_spring_forces, spring_matrix, strip_solution
  use fuge_spring_monitor, only: spring_monitor
  use fuge_status, only: fuge_info, report, require_memory, FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED, &
    FUGE_ERR_CALL_ORDER, FUGE_ERR_CANCELLED, FUGE_ERR_UNSUPPORTED
  use fuge_tableau_engine, only: solve_by_tableau
  use fuge_working_set, only: working_set
  implicit none
  private

  !> Forces of springs beyond this multiple of the largest force of a point are taken out, and the rest solved anew.
  real(dp), parameter :: MUCH_MORE = 8.0_dp

  type, extends(matrix_engine), public :: dense_engine
    private
    !> The last problem, where its canonical form is needed.
    type(canonical_problem) :: canonical
    !> States of the last solve, where the next one starts.
    integer, allocatable :: state(:)
    !> Their factor outlives a solve: the next one starts from it if the matrix is the same.
    type(kkt_factor) :: factor
    !> The last solve started from a factor that an earlier one had left.
    logical :: found_factor = .false.
    !> The last solve got as far as the matrix, so that the factor may be its own.
    logical :: took_matrix = .false.
    !> Arrays for the next solve, so that small problems do not spend their time on allocations.
    type(fuge_solution) :: spare
    type(working_set) :: set
    !> The matrix of the last problem with springs, the number of motions on springs, and whether the last
    !> problem had any springs.
    type(spring_matrix), allocatable :: springs
    integer :: spring_points = 0
    logical :: with_springs = .false.
    !> The matrix of this solve has springs of held motions on all its coefficients.
    logical :: holds_motions = .false.
  contains
    procedure :: solve
    procedure :: was_misled
    procedure :: distrust_start
    procedure :: forget_start
    procedure :: last_points
    procedure :: last_modes
    procedure :: derivative
    procedure :: has_found
    procedure :: start_from
    procedure :: take_arrays
  end type dense_engine

contains

  !> As for `contact_engine`. FUGE_ERR_UNSUPPORTED for an operator without coefficients.
  subroutine solve(self, operator, problem, options, monitor, history, solution, info)
    class(dense_engine), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info

    self%found_factor = .false.
    self%took_matrix = .false.
    self%holds_motions = .false.
    select type (operator)
    class is (fuge_dense_operator)
      self%spring_points = 0
      self%with_springs = needs_springs(problem)
      if (options%keep_history .and. problem%spring_count() > 0) then
        call report(info, FUGE_ERR_UNSUPPORTED, 'the history has no columns for springs on motions: leave ' &
                    //'keep_history out, or motion_stiffness')
        return
      end if
      if (self%with_springs) then
        call solve_with_springs(self, operator, problem, options, monitor, history, solution, info)
      else if (problem%has_springs()) then
        call solve_without_springs(self, operator, problem, options, monitor, history, solution, info)
      else
        if (allocated(self%springs)) deallocate (self%springs)
        call solve_with_matrix(self, operator, problem, options, monitor, history, solution, info)
      end if
      if (info%failed()) return
      call open_beyond_stops(problem, solution%state)
      self%state(:size(solution%state)) = solution%state
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'this engine needs the coefficients of a dense operator: use ' &
                  //'FUGE_ITERATIVE for other operators')
    end select
  end subroutine solve

  !> Beyond a stop that takes no force a point is open; a tied one has no other state there.
  pure subroutine open_beyond_stops(problem, state)
    type(fuge_problem), intent(in) :: problem
    integer, intent(inout) :: state(:)

    if (.not. allocated(problem%limit)) return
    if (allocated(problem%gap_upper)) then
      where (state == FUGE_LIMITED_LOWER .and. .not. problem%limit > 0.0_dp .and. problem%gap_upper > 0.0_dp) &
        state = FUGE_OPEN
    else
      where (state == FUGE_LIMITED_LOWER .and. .not. problem%limit > 0.0_dp) state = FUGE_OPEN
    end if
  end subroutine open_beyond_stops

  !> With springs of zero only: the matrix is that of the caller.
  subroutine solve_without_springs(self, operator, problem, options, monitor, history, solution, info)
    class(dense_engine), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: without_springs

    if (allocated(self%springs)) deallocate (self%springs)
    call extend_problem(problem, without_springs, info)
    if (info%failed()) return
    call solve_with_matrix(self, operator, without_springs, options, monitor, history, solution, info)
  end subroutine solve_without_springs

  !> With springs, as parts of the matrix.
  subroutine solve_with_springs(self, operator, problem, options, monitor, history, solution, info)
    class(dense_engine), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout), target :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(spring_monitor) :: relay
    ! Taken out of the engine, which changes while the operator points to it.
    type(spring_matrix), allocatable, target :: springs
    type(fuge_dense_operator) :: with_springs
    type(fuge_problem) :: extended, holding

    call move_alloc(self%springs, springs)
    if (.not. allocated(springs)) allocate (springs)
    call hold_stiff_motions(operator, problem, holding, info)
    if (.not. info%failed()) call springs%set(operator, problem, info, holding)
    if (.not. info%failed()) call extend_problem(holding, extended, info)
    if (.not. info%failed()) then
      call springs%as_operator(with_springs)
      self%holds_motions = holding%spring_count() < problem%spring_count()
      relay%listener => monitor
      relay%springs = holding%spring_count()
      call solve_with_matrix(self, with_springs, extended, options, relay, history, solution, info)
      if (.not. info%failed() .and. relay%springs > 0) then
        call correct_spring_loads(self, with_springs, holding, extended, options, relay, solution, info)
      end if
      call name_springs(holding, info)
    end if
    call move_alloc(springs, self%springs)
    if (info%failed()) return
    self%spring_points = holding%spring_count()
    call find_spring_motions(holding, extended, solution%force, solution%motion)
    call self%springs%find_held_motions(problem%resultants(), solution%force, solution%motion)
    call strip_solution(problem%points(), solution, info)
  end subroutine solve_with_springs

  !> Where springs carry far more than the points, the rounding of their forces would be in those of the points: solve
  !> once more for the change of the springs' forces, from the same states, under what these forces leave of the
  !> resultants. The estimated error is made relative to the largest force of a point. A second solve that fails leaves
  !> the first solution.
  subroutine correct_spring_loads(self, operator, problem, extended, options, monitor, solution, info)
    class(dense_engine), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem, extended
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    ! With springs on motions nothing is kept in it.
    type(fuge_history) :: history
    type(fuge_problem) :: shifted
    type(fuge_options) :: by_active_set
    type(fuge_solution) :: corrected
    type(fuge_info) :: again
    real(dp) :: carried(problem%spring_count())
    integer :: n

    n = problem%points()
    carried = solution%force(n + 1:)
    if (maxval(abs(carried)) > MUCH_MORE*maxval(abs(solution%force(:n))) &
        .and. any(solution%state(:n) /= FUGE_OPEN)) then
      call shift_spring_forces(operator%alpha, problem, extended, carried, shifted)
      by_active_set = options
      by_active_set%method = FUGE_ACTIVE_SET
      call solve_with_matrix(self, operator, shifted, by_active_set, monitor, history, corrected, again)
      if (again%status == FUGE_ERR_CANCELLED) then
        info = again
        return
      else if (again%failed()) then
        ! The factor and the states must be those of the solution.
        solution = fuge_solution()
        call solve_with_matrix(self, operator, extended, options, monitor, history, solution, info)
        if (info%failed()) return
      else
        again%iterations = info%iterations + again%iterations
        again%products = info%products + again%products
        info = again
        call scale_force_error(maxval(abs(corrected%force)), corrected%force(:n), info%force_error)
        corrected%force(n + 1:) = carried + corrected%force(n + 1:)
        call move_solution(corrected, solution)
        return
      end if
    end if
    call scale_force_error(maxval(abs(solution%force)), solution%force(:n), info%force_error)
  end subroutine correct_spring_loads

  subroutine solve_with_matrix(self, operator, problem, options, monitor, history, solution, info)
    class(dense_engine), intent(inout) :: self
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(contact_solution) :: reduced
    logical :: is_set

    call self%canonical%set_again(problem, is_set)
    if (.not. is_set) call make_canonical(problem, self%canonical, info)
    if (info%failed()) return
    call allocate_solution(problem%points(), size(self%canonical%load), reduced, info, self%spare)
    if (info%failed()) return
    self%took_matrix = .true.
    call self%canonical%set_matrix(operator%alpha, operator%datum(), operator%known(), operator%stamp())
    self%found_factor = self%factor%belongs_to(self%canonical)
    if (self%found_factor) then
      self%factor%expects_solves = .true.
    else
      self%factor = kkt_factor()
    end if
    if (options%method == FUGE_TABLEAU .or. (options%method == FUGE_AUTO .and. options%keep_history)) then
      self%factor = kkt_factor()
      self%found_factor = .false.
      call solve_by_tableau(self%canonical, options, monitor, history, self%factor, reduced, info)
    else
      call run_active_set(self, options, monitor, reduced, info)
    end if
    ! The matrix is the caller's and may be gone before the next call.
    self%canonical%alpha => null()
    if (info%failed()) return
    if (self%canonical%plain) then
      call move_alloc(reduced%motion, solution%motion)
    else
      call find_given_motions(self%canonical, operator%alpha, problem, reduced, solution, info)
      if (info%failed()) return
    end if
    call estimate_force_error(self%canonical, operator%alpha, self%factor, problem, solution%motion, &
                              self%holds_motions, reduced, info%force_error, info)
    if (info%failed()) return
    call move_alloc(reduced%force, solution%force)
    call move_alloc(reduced%gap, solution%gap)
    call move_alloc(reduced%state, solution%state)
    self%state = solution%state
  end subroutine solve_with_matrix

  !> The motions in the given modes, and the gaps of excluded points.
  subroutine find_given_motions(canonical, alpha, problem, reduced, solution, info)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(contact_solution), intent(inout) :: reduced
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%motion(problem%mode_count()), stat=stat)
    call require_memory(stat, 'the motions', info)
    if (stat /= 0) return
    call canonical%to_given_modes(problem%prescribed_motion(), reduced%motion, solution%motion)
    call canonical%set_excluded_gaps(alpha, problem%gap, reduced%force, solution%motion, reduced%gap)
  end subroutine find_given_motions

  !> The active set from the last contact set; from scratch if there is none, or if that start fails.
  subroutine run_active_set(self, options, monitor, solution, info)
    class(dense_engine), intent(inout) :: self
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    logical :: warm

    warm = .false.
    if (allocated(self%state)) warm = size(self%state) == size(solution%state)
    if (warm) solution%state = self%state
    call solve_by_active_set(self%canonical, options, monitor, self%factor, solution, info, self%set)
    if (warm .and. info%failed() .and. info%status /= FUGE_ERR_CANCELLED) then
      info = fuge_info()
      self%factor = kkt_factor()
      self%found_factor = .false.
      solution%state = FUGE_OPEN
      call solve_by_active_set(self%canonical, options, monitor, self%factor, solution, info, self%set)
    end if
  end subroutine run_active_set

  !> The matrix may have changed since it was factored, although the operator was not set again.
  pure function was_misled(self, status)
    class(dense_engine), intent(in) :: self
    integer, intent(in) :: status
    logical :: was_misled

    was_misled = self%found_factor .and. any(status == [FUGE_WARN_RESIDUAL, FUGE_WARN_ILL_CONDITIONED])
  end function was_misled

  !> The contact set stays a good start; so does the factor where a load without equilibrium was refused before it was
  !> used.
  subroutine distrust_start(self)
    class(dense_engine), intent(inout) :: self

    if (.not. self%took_matrix) return
    self%factor = kkt_factor()
    if (allocated(self%springs)) deallocate (self%springs)
  end subroutine distrust_start

  subroutine forget_start(self)
    class(dense_engine), intent(inout) :: self

    self%factor = kkt_factor()
    if (allocated(self%state)) deallocate (self%state)
    if (allocated(self%springs)) deallocate (self%springs)
  end subroutine forget_start

  pure function last_points(self) result(number)
    class(dense_engine), intent(in) :: self
    integer :: number

    number = 0
    if (allocated(self%state)) number = size(self%state) - self%spring_points
  end function last_points

  pure function last_modes(self) result(number)
    class(dense_engine), intent(in) :: self
    integer :: number

    number = self%canonical%mode_count()
  end function last_modes

  pure function has_found(self, state) result(same)
    class(dense_engine), intent(in) :: self
    integer, intent(in) :: state(:)
    logical :: same

    same = self%last_points() == size(state)
    if (same) same = all(self%state(:size(state)) == state)
  end function has_found

  !> By triangular solves with the last factor. Errors: those of `find_derivative`.
  subroutine derivative(self, operator, gap_change, load_change, change, info, wanted)
    class(dense_engine), intent(in) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: wanted(:)

    select type (operator)
    class is (fuge_dense_operator)
      if (self%with_springs) then
        call derivative_with_springs(self, self%springs, gap_change, load_change, change, info, wanted)
      else
        call find_derivative(self%canonical, operator, self%factor, self%state, gap_change, load_change, change, info, &
                             wanted)
      end if
    class default
      call report(info, FUGE_ERR_CALL_ORDER, 'the last solve was with a matrix, not with this operator')
    end select
  end subroutine derivative

  !> The derivative of a problem with springs.
  subroutine derivative_with_springs(self, springs, gap_change, load_change, change, info, wanted)
    class(dense_engine), intent(in) :: self
    type(spring_matrix), intent(in), target :: springs
    real(dp), intent(in) :: gap_change(:), load_change(:)
    type(fuge_solution), intent(inout) :: change
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: wanted(:)
    type(fuge_dense_operator) :: with_springs
    logical, allocatable :: wanted_too(:)

    call springs%as_operator(with_springs)
    ! Not allocated it counts as absent.
    if (present(wanted)) wanted_too = [wanted, spread(.false., 1, self%spring_points)]
    call find_derivative(self%canonical, with_springs, self%factor, self%state, &
                         [gap_change, spread(0.0_dp, 1, self%spring_points)], springs%held_changes(load_change), &
                         change, info, wanted_too)
    if (info%failed()) return
    call springs%find_held_motions(load_change, change%force, change%motion)
    call strip_solution(size(gap_change), change, info)
  end subroutine derivative_with_springs

  !> As for `matrix_engine`.
  pure subroutine start_from(self, state)
    class(dense_engine), intent(inout) :: self
    integer, intent(in) :: state(:)

    if (self%last_points() == size(state)) self%state(:size(state)) = state
  end subroutine start_from

  !> As for `matrix_engine`.
  subroutine take_arrays(self, solution)
    class(dense_engine), intent(inout) :: self
    type(fuge_solution), intent(inout) :: solution

    call move_solution(solution, self%spare)
  end subroutine take_arrays

end module fuge_dense_engine
