!> Static condensation: from the stiffness matrix of a body to the influence matrix of its contact
!> points, and back from contact forces to the displacements of all degrees of freedom.
!>
!> With H the normals of the contact points (n columns), p the external load and G the inverse of
!> K with supports and pins constrained,
!>
!>     alpha = H^T G H,    b = H^T u_p,    u_p = G p (plus the displacements of the supports),
!>     u = u_p + G H f + Z q.
!>
!> alpha is the inverse of the Schur complement of K in the contact points. Z are the rigid modes
!> of a floating body. One degree of freedom is pinned for each; its reaction is zero when the
!> forces are in equilibrium, so that no result depends on the choice. The gaps are then
!> g + b + alpha f - R q with R = -H^T Z, and equilibrium is R^T f = w with w = Z^T p: the general
!> problem. A rigid mode that moves no contact point, such as sliding along a flat one, is left
!> out; the load must not drive it.
module fuge_condensation
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_body_type, only: check_body, check_load_field, fuge_body
  use fuge_condensed_influence, only: find_influence, touched_degrees
  use fuge_contact_modes, only: check_unresisted, find_contact_modes, load_resultant, remove_motions, &
    split_rigid_modes, ROUNDING_ERROR
  use fuge_contact_normals, only: add_contact_forces, check_free_points, displacement_scale, &
    pin_scale, point_displacement
  use fuge_floating_factor, only: factorise_floating
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases, move_cases
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_rigid_body_modes, only: check_rigid_modes, choose_pins, find_pin_loads, find_rigid_modes
  use fuge_smallest_eigenvalue, only: find_smallest_eigenvalue, unscale
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_SIZE, FUGE_WARN_RESIDUAL
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: fuge_condense, condense_to_recover

  !> A pivot below this fraction of its diagonal term counts as zero.
  real(dp), parameter :: SMALLEST_PIVOT = 16.0_dp*epsilon(1.0_dp)
  !> With a smallest eigenvalue below this, alpha may have fewer than four correct digits; often it
  !> has two or three more.
  real(dp), parameter :: NEARLY_SINGULAR = 1.0e4_dp*epsilon(1.0_dp)
  !> Above this smallest eigenvalue more than half of the digits are right in whatever order K is eliminated. Below it
  !> the order that fills least is taken, which loses fewer digits on bodies in one row.
  real(dp), parameter :: ANY_ORDER = 1.0e-8_dp
  !> Load cases that are solved together.
  integer, parameter :: COLUMNS = 64
  !> Largest residual of K u = forces that counts as solved, relative to the largest force.
  real(dp), parameter :: RESIDUAL_TOLERANCE = 1.0e-10_dp

  !> A body condensed to its contact points.
  type, public :: fuge_condensed
    !> Influence matrix, (n, n), length per force.
    real(dp), allocatable :: alpha(:, :)
    !> b: displacements of the contact points due to load and supports, (n), length.
    real(dp), allocatable :: displacement(:)
    !> R: rigid modes at the contact points, (n, m); m = 0 for a body that does not float.
    real(dp), allocatable :: modes(:, :)
    !> w: work of the load in each mode, (m): the resultant of the contact forces.
    real(dp), allocatable :: resultant(:)
    class(fuge_stiffness), allocatable, private :: stiffness
    class(stiffness_factor), allocatable, private :: factor
    type(fuge_body), private :: body
    !> Supports and pins, (degrees).
    logical, allocatable, private :: constrained(:)
    !> Square root of the diagonal of K, (degrees), which makes displacements of any unit
    !> comparable; zero where fixed.
    real(dp), allocatable, private :: scale(:)
    !> Degrees of freedom without stiffness of a body that floats, as of a node that cables alone hold: each one is a
    !> rigid mode, and its own pin.
    integer, allocatable, private :: idle(:)
    !> Z of `modes`, (degrees, m), and the rigid modes that move no contact point.
    real(dp), allocatable, private :: rigid_modes(:, :), unresisted_modes(:, :)
    !> Relative error of the rigid modes.
    real(dp), private :: mode_error = ROUNDING_ERROR
    !> u_p, (degrees).
    real(dp), allocatable, private :: load_displacement(:)
  contains
    procedure :: pose
    procedure :: recover
    procedure :: set_load
    procedure :: pose_cases
    procedure :: recover_cases
    procedure :: move_rigidly
    procedure :: clear
  end type fuge_condensed

contains

  !> Condense a body to its contact points.
  !>
  !> `stiffness` is any extension of fuge_stiffness, set before; of a dense or band matrix
  !> only the reference is kept, for `recover`. Cost: one Cholesky factorisation, n solves in
  !> blocks of 64, three solves for the smallest eigenvalue, and another factorisation if rigid
  !> modes are to be found. A sparse matrix takes little more than one factorisation in all, unless
  !> it is near to singular: contact is eliminated last, and alpha follows from the end of the
  !> factor. `condensed` is replaced on success or warning.
  !> Warning: FUGE_WARN_RESIDUAL if K is so near to singular that alpha may have few correct
  !> digits. Errors, which name the degree of freedom or the point:
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MODES, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_NO_EQUILIBRIUM for a load that drives a mode which no contact can resist,
  !> FUGE_ERR_MEMORY.
  subroutine fuge_condense(stiffness, body, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info

    call condense(stiffness, body, .true., condensed, info)
  end subroutine fuge_condense

  !> As `fuge_condense` but without alpha and its n solves, for callers that already know the
  !> contact forces and need `recover` only. The pins are those of `fuge_condense` for the same
  !> body.
  subroutine condense_to_recover(stiffness, body, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info

    call condense(stiffness, body, .false., condensed, info)
  end subroutine condense_to_recover

  !> `fuge_condense`, or `condense_to_recover` if not `with_alpha`.
  subroutine condense(stiffness, body, with_alpha, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: with_alpha
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info
    type(fuge_condensed) :: result
    type(fuge_info) :: warning
    real(dp), allocatable :: all_scale(:)
    integer, allocatable :: pins(:)
    logical :: found
    integer :: stat

    if (stiffness%degrees() < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the stiffness has no matrix: call set first')
      return
    end if
    call check_body(body, stiffness%degrees(), info)
    if (info%failed()) return
    allocate (result%stiffness, source=stiffness, stat=stat)
    call require_memory(stat, 'a copy of the stiffness', info)
    result%body = body
    if (.not. info%failed()) call mark_supports(result, all_scale, info)
    found = .false.
    if (.not. info%failed() .and. body%floats .and. with_alpha .and. result%stiffness%can_order()) &
      call factorise_once(result, pins, found)
    if (.not. (found .or. info%failed())) call constrain(result, all_scale, pins, info)
    if (with_alpha .and. .not. (body%floats .or. info%failed()) .and. result%stiffness%can_order()) then
      result%stiffness%last = touched_degrees(body, result%constrained)
      result%stiffness%columns = size(body%dof, 2)
    end if
    if (.not. (found .or. info%failed())) call factorise(result, pins, info)
    ! Now that they are held, idle degrees of freedom count like any other.
    if (.not. info%failed() .and. size(result%idle) > 0) &
      result%scale(result%idle) = merge(maxval(result%scale), 1.0_dp, maxval(result%scale) > 0.0_dp)
    warning = info
    if (with_alpha .and. .not. info%failed()) &
      call find_influence(body, result%constrained, result%factor, result%alpha, info)
    if (.not. info%failed()) call keep_resisted_modes(result, info)
    if (.not. info%failed()) call apply_load(result, info)
    if (.not. info%failed()) then
      call report(info, warning%status, composed_message(warning))
      call move_condensed(result, condensed)
    end if
    call result%clear()
  end subroutine condense

  !> Replace the external load; `displacement` and `resultant` are updated with one solve.
  !>
  !> `load` (degrees), force. Errors, everything unchanged: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_MEMORY.
  subroutine set_load(self, load, info)
    class(fuge_condensed), intent(inout) :: self
    real(dp), intent(in) :: load(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: block(:, :), previous(:), previous_displacement(:)
    integer :: stat

    if (.not. allocated(self%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
      return
    end if
    call check_load_field(load, size(self%constrained), info)
    if (info%failed()) return
    call move_alloc(self%body%load, previous)
    call move_alloc(self%load_displacement, previous_displacement)
    self%body%load = load
    allocate (block(size(load), 1), stat=stat)
    if (stat == 0) call set_loads(self, block(:, 1), stat)
    if (stat == 0) call self%factor%solve(block, stat)
    if (stat == 0) then
      call add_supports(self, block(:, 1), self%body%displacement)
      self%load_displacement = block(:, 1)
      call apply_load(self, info)
    else
      call require_memory(stat, 'the displacements due to the load', info)
    end if
    if (.not. info%failed()) return
    call move_alloc(previous, self%body%load)
    call move_alloc(previous_displacement, self%load_displacement)
  end subroutine set_load

  !> Pose the contact problem: set the gaps to `gap` + b and, if the body floats, `modes` and
  !> `resultant` to its own. Other components of `problem` are unchanged: a problem without modes
  !> has one translation, that of a rigid counter-body, and the caller sets its resultant.
  !>
  !> `gap` (n), initial gaps, length. Errors: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine pose(self, gap, problem, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: gap(:)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info

    if (.not. allocated(self%displacement)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (size(gap) /= size(self%displacement)) then
      call report(info, FUGE_ERR_SIZE, 'gap has '//text(size(gap))//' value(s): it needs one for each of ' &
                  //text(size(self%displacement))//' contact points')
    end if
    if (info%failed()) return
    problem%gap = gap + self%displacement
    if (size(self%resultant) < 1) return
    problem%modes = self%modes
    problem%resultant = self%resultant
    ! A spring on another motion is none of these.
    if (allocated(problem%motion_stiffness)) deallocate (problem%motion_stiffness)
  end subroutine pose

  !> Pose the contact problem of many load cases: `cases` gets the gaps, `gap` + b, and the resultants w of each, and
  !> `problem` what `pose` sets, with the first load case.
  !>
  !> `gap` (n), initial gaps, length; `loads` (degrees, cases), force: external loads, in place of that of the body;
  !> `displacement` (fixed, cases), length: displacements of the supports in each case, in the order of `fixed` of the
  !> body, by default those of the body in all cases. One solve for each case, in blocks. A case that drives a rigid
  !> mode which no contact resists is marked as refused (FUGE_ERR_NO_EQUILIBRIUM), as is one whose loads are not finite
  !> or out of range. Errors, `problem` and `cases` unchanged: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE
  !> for displacements, FUGE_ERR_MEMORY.
  subroutine pose_cases(self, gap, loads, problem, cases, info, displacement)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: gap(:), loads(:, :)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_load_cases), intent(inout) :: cases
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: displacement(:, :)
    type(fuge_load_cases) :: found
    type(fuge_problem) :: posed
    real(dp), allocatable :: moved(:, :)
    integer :: k, stat

    stat = 0
    if (present(displacement)) allocate (moved, source=displacement, stat=stat)
    call require_memory(stat, 'the displacements of supports', info)
    if (.not. info%failed()) call check_loads(self, loads, moved, info)
    if (.not. info%failed()) then
      posed = problem
      call self%pose(gap, posed, info)
    end if
    if (info%failed()) return
    allocate (found%gap(size(gap), size(loads, 2)), found%load(posed%mode_count(), size(loads, 2)), &
              found%refused(size(loads, 2)), stat=stat)
    call require_memory(stat, 'the gaps of', size(loads, 2), 'load cases', info)
    if (.not. info%failed()) call condense_loads(self, loads, moved, found, info)
    if (info%failed()) return
    do k = 1, size(loads, 2)
      found%gap(:, k) = gap + found%gap(:, k)
    end do
    posed%gap = found%gap(:, 1)
    if (size(self%resultant) > 0) then
      posed%resultant = found%load(:, 1)
    else
      deallocate (found%load)
    end if
    problem = posed
    call move_cases(found, cases)
  end subroutine pose_cases

  !> Displacements b of the contact points and resultants w of all load cases, as cases%gap and cases%load.
  subroutine condense_loads(self, loads, moved, cases, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: loads(:, :)
    real(dp), intent(in), allocatable :: moved(:, :)
    type(fuge_load_cases), intent(inout) :: cases
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: block(:, :)
    integer :: first, i, k, stat

    allocate (block(size(loads, 1), min(COLUMNS, size(loads, 2))), stat=stat)
    call require_memory(stat, 'the displacements due to the loads', info)
    cases%gap = 0.0_dp
    cases%load = 0.0_dp
    do first = 1, size(loads, 2), COLUMNS
      if (info%failed()) return
      associate (last => min(first + COLUMNS - 1, size(loads, 2)))
        do k = first, last
          call check_case(self, loads(:, k), cases%refused(k))
          block(:, k - first + 1) = 0.0_dp
          if (.not. cases%refused(k)%failed()) block(:, k - first + 1) = loads(:, k)
        end do
        call solve_loads(self, first, block(:, :last - first + 1), moved, stat)
        call require_memory(stat, 'the displacements due to the loads', info)
        if (stat /= 0) return
        do k = first, last
          if (cases%refused(k)%failed()) cycle
          do i = 1, size(cases%gap, 1)
            cases%gap(i, k) = point_displacement(self%body%dof(:, i), self%body%normal(:, i), block(:, k - first + 1))
          end do
          if (size(self%resultant) < 1) cycle
          cases%load(:, k) = load_resultant(self%rigid_modes, loads(:, k), self%scale, self%mode_error)
        end do
      end associate
    end do
  end subroutine condense_loads

  !> The report of one load case: can it be applied, and does it drive no rigid mode that no contact resists?
  subroutine check_case(self, load, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: load(:)
    type(fuge_info), intent(out) :: info

    call check_load_field(load, size(self%constrained), info)
    if (info%failed()) return
    call check_unresisted(self%unresisted_modes, load, self%scale, self%mode_error, info)
  end subroutine check_case

  !> Replace the external loads of the cases from number `first` on, (degrees, columns), by their displacements, those
  !> of the supports included.
  subroutine solve_loads(self, first, block, moved, stat)
    class(fuge_condensed), intent(in) :: self
    integer, intent(in) :: first
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: stat
    real(dp), intent(in), allocatable :: moved(:, :)
    real(dp), allocatable :: support_forces(:)
    integer :: k

    allocate (support_forces(size(block, 1)), stat=stat)
    if (stat == 0 .and. .not. allocated(moved)) &
      call find_support_forces(self, support_forces, stat, self%body%displacement)
    do k = 1, size(block, 2)
      if (stat == 0 .and. allocated(moved)) &
        call find_support_forces(self, support_forces, stat, moved(:, first + k - 1))
      if (stat /= 0) return
      block(:, k) = merge(0.0_dp, block(:, k) - support_forces, self%constrained)
    end do
    call self%factor%solve(block, stat)
    do k = 1, size(block, 2)
      if (allocated(moved)) then
        call add_supports(self, block(:, k), moved(:, first + k - 1))
      else
        call add_supports(self, block(:, k), self%body%displacement)
      end if
    end do
  end subroutine solve_loads

  !> Displacements of all degrees of freedom for the solutions of all load cases, as `recover` for each.
  !>
  !> `loads` (degrees, cases) and `displacement` as for `pose_cases`; `u` (degrees, cases), length: NaN in the columns
  !> of cases without a solution. info%residual is the largest of any case, FUGE_WARN_RESIDUAL if it exceeds 1e-10; the
  !> report of such a case, if it had no warning, has this one. Errors, `u` unchanged but for FUGE_ERR_MEMORY:
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW.
  subroutine recover_cases(self, loads, solutions, u, info, displacement)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: loads(:, :)
    type(fuge_case_solutions), intent(inout) :: solutions
    real(dp), intent(inout) :: u(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: displacement(:, :)
    real(dp), allocatable :: moved(:, :)
    real(dp), allocatable :: block(:, :)
    integer :: first, k, stat

    stat = 0
    if (present(displacement)) allocate (moved, source=displacement, stat=stat)
    call require_memory(stat, 'the displacements of supports', info)
    if (.not. info%failed()) call check_loads(self, loads, moved, info)
    if (.not. info%failed()) call check_case_solutions(self, solutions, shape(loads), shape(u), info)
    do k = 1, size(loads, 2)
      if (info%failed()) return
      if (.not. solutions%report(k)%failed()) call check_recovered_case(self, loads(:, k), solutions, k, info)
    end do
    if (info%failed()) return
    allocate (block(size(loads, 1), min(COLUMNS, size(loads, 2))), stat=stat)
    call require_memory(stat, 'the displacements of load cases', info)
    do first = 1, size(loads, 2), COLUMNS
      if (info%failed()) return
      associate (last => min(first + COLUMNS - 1, size(loads, 2)))
        do k = first, last
          block(:, k - first + 1) = 0.0_dp
          if (solutions%report(k)%failed()) cycle
          block(:, k - first + 1) = loads(:, k)
          call add_contact_forces(self%body, solutions%force(:, k), block(:, k - first + 1))
        end do
        call solve_loads(self, first, block(:, :last - first + 1), moved, stat)
        call require_memory(stat, 'the displacements of load cases', info)
        do k = first, last
          if (info%failed()) return
          u(:, k) = ieee_value(1.0_dp, ieee_quiet_nan)
          if (solutions%report(k)%failed()) cycle
          u(:, k) = block(:, k - first + 1)
          call complete_case(self, loads(:, k), solutions, k, u(:, k), info)
        end do
      end associate
    end do
  end subroutine recover_cases

  !> Refuse a load, forces or motions of case `k` that are not finite or out of range.
  pure subroutine check_recovered_case(self, load, solutions, k, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: load(:)
    type(fuge_case_solutions), intent(in) :: solutions
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info

    call check_load_field(load, size(load), info)
    if (.not. info%failed()) call check_finite(solutions%force(:, k), 'force', info)
    if (.not. info%failed()) call check_finite(solutions%motion(:size(self%resultant), k), 'motion', info)
  end subroutine check_recovered_case

  !> Add the motions of case `k` to its displacements `u` (degrees), and find its residual: `info` has the largest one
  !> of all cases. Error: FUGE_ERR_MEMORY.
  subroutine complete_case(self, load, solutions, k, u, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: load(:)
    type(fuge_case_solutions), intent(inout) :: solutions
    integer, intent(in) :: k
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: balance

    call add_motions(self, solutions%motion(:, k), u, balance)
    if (.not. balance%failed()) call find_residual(self, load, solutions%force(:, k), u, balance)
    if (balance%failed()) info = balance
    if (info%failed()) return
    if (balance%status /= FUGE_DONE .and. solutions%report(k)%status == FUGE_DONE) &
      call report(solutions%report(k), balance%status, composed_message(balance))
    if (balance%residual <= info%residual) return
    info%residual = balance%residual
    if (balance%status /= FUGE_DONE) call report(info, balance%status, 'load case '//index_text(k)//': ' &
                                                 //composed_message(balance))
  end subroutine complete_case

  !> Refuse solutions, or displacements, that do not fit the loads and this body.
  pure subroutine check_case_solutions(self, solutions, loads, displacements, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_case_solutions), intent(in) :: solutions
    integer, intent(in) :: loads(2), displacements(2)
    type(fuge_info), intent(inout) :: info

    if (.not. (allocated(solutions%force) .and. allocated(solutions%motion) .and. allocated(solutions%report))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the load cases have no forces: solve them first')
    else if (any(shape(solutions%force) /= [size(self%displacement), loads(2)]) &
             .or. size(solutions%motion, 1) < size(self%resultant) .or. size(solutions%motion, 2) /= loads(2) &
             .or. size(solutions%report) /= loads(2)) then
      call report(info, FUGE_ERR_SIZE, 'the solutions have '//text(size(solutions%force, 1))//' forces and ' &
                  //text(size(solutions%motion, 1))//' motions of '//text(size(solutions%force, 2)) &
                  //' load cases: there are '//text(size(self%displacement))//' contact points, ' &
                  //text(size(self%resultant))//' motions and '//text(loads(2))//' load cases')
    else if (any(displacements /= loads)) then
      call report(info, FUGE_ERR_SIZE, 'u has '//text(displacements(1))//' rows and '//text(displacements(2)) &
                  //' columns: it needs those of the loads, '//text(loads(1))//' and '//text(loads(2)))
    end if
  end subroutine check_case_solutions

  !> Refuse loads, or displacements of supports, that do not fit this body (FUGE_ERR_SIZE), or before there is one
  !> (FUGE_ERR_CALL_ORDER), and displacements that are not finite (FUGE_ERR_NOT_FINITE).
  pure subroutine check_loads(self, loads, moved, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: loads(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), allocatable :: moved(:, :)
    integer :: fixed, k

    if (.not. allocated(self%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (size(loads, 1) /= size(self%constrained) .or. size(loads, 2) < 1) then
      call report(info, FUGE_ERR_SIZE, 'loads has '//text(size(loads, 1))//' rows and '//text(size(loads, 2)) &
                  //' columns: it needs a row for each of '//text(size(self%constrained))//' degrees of freedom and ' &
                  //'a column for each load case')
    end if
    if (info%failed() .or. .not. allocated(moved)) return
    fixed = 0
    if (allocated(self%body%fixed)) fixed = size(self%body%fixed)
    if (any(shape(moved) /= [fixed, size(loads, 2)])) &
      call report(info, FUGE_ERR_SIZE, 'displacement has '//text(size(moved, 1))//' rows and ' &
                  //text(size(moved, 2))//' columns: it needs a row for each of '//text(fixed) &
                  //' fixed degrees of freedom and a column for each of '//text(size(loads, 2))//' load cases')
    do k = 1, size(moved, 2)
      if (.not. info%failed()) call check_finite(moved(:, k), 'displacement', info)
    end do
  end subroutine check_loads

  !> Displacements of all degrees of freedom for a solution of the contact problem.
  !>
  !> `u` (degrees), length. Of the solution, the forces and the first m motions are used, with m
  !> the number of `modes`. Rigid modes that move no contact point are not part of `u`: its projection on them, with the
  !> diagonal of K as weights, is subtracted.
  !> info%residual is the largest force that K u leaves unbalanced at a free degree of freedom,
  !> relative to the largest force; FUGE_WARN_RESIDUAL if it exceeds 1e-10.
  !> Errors, `u` unchanged: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_MEMORY.
  subroutine recover(self, solution, u, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: block(:, :), forces(:)
    integer :: stat

    call check_recovery(self, solution, size(u), info)
    if (info%failed()) return
    allocate (block(size(u), 1), forces(size(u)), stat=stat)
    if (stat == 0) then
      forces = 0.0_dp
      call add_contact_forces(self%body, solution%force, forces)
      block(:, 1) = merge(0.0_dp, forces, self%constrained)
      call self%factor%solve(block, stat)
    end if
    call require_memory(stat, 'the displacements', info)
    if (stat /= 0) return
    block(:, 1) = self%load_displacement + block(:, 1)
    call add_motions(self, solution%motion, block(:, 1), info)
    if (info%failed()) return
    if (allocated(self%body%load)) then
      call find_residual(self, self%body%load, solution%force, block(:, 1), info)
    else
      forces = 0.0_dp
      call find_residual(self, forces, solution%force, block(:, 1), info)
    end if
    if (.not. info%failed()) u = block(:, 1)
  end subroutine recover

  !> Displacements `u` (degrees) of all degrees of freedom by motions (m) in the rigid modes alone, without forces.
  !> Errors, `u` unchanged: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine move_rigidly(self, motion, u, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: motion(:)
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    integer :: j

    if (.not. allocated(self%rigid_modes)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (size(motion) /= size(self%rigid_modes, 2) .or. size(u) /= size(self%rigid_modes, 1)) then
      call report(info, FUGE_ERR_SIZE, 'there are '//text(size(motion))//' motions and '//text(size(u)) &
                  //' displacements: this body has '//text(size(self%rigid_modes, 2))//' rigid modes and ' &
                  //text(size(self%rigid_modes, 1))//' degrees of freedom')
    end if
    if (info%failed()) return
    u = 0.0_dp
    do j = 1, size(motion)
      u = u + self%rigid_modes(:, j)*motion(j)
    end do
  end subroutine move_rigidly

  !> Free the stiffness and its factor, by far the largest part of the memory; the public
  !> components stay. It happens automatically when the variable goes out of scope, but not with
  !> flang 22.
  subroutine clear(self)
    class(fuge_condensed), intent(inout) :: self

    if (allocated(self%stiffness)) deallocate (self%stiffness)
    if (allocated(self%factor)) deallocate (self%factor)
  end subroutine clear

  !> Refuse a solution, or a number of displacements, that does not fit this body.
  pure subroutine check_recovery(self, solution, degrees, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info
    integer :: m, n

    if (.not. allocated(self%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
      return
    else if (.not. (allocated(solution%force) .and. allocated(solution%motion))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the solution has no forces: solve the contact problem first')
      return
    end if
    n = size(self%displacement)
    m = size(self%resultant)
    if (size(solution%force) /= n .or. size(solution%motion) < m) then
      call report(info, FUGE_ERR_SIZE, 'the solution has '//text(size(solution%force))//' forces and ' &
                  //text(size(solution%motion))//' motions: this body has '//text(n)//' contact points and '//text(m) &
                  //' motions')
    else if (degrees /= size(self%constrained)) then
      call report(info, FUGE_ERR_SIZE, 'u has '//text(degrees)//' value(s): it needs one for each of ' &
                  //text(size(self%constrained))//' degrees of freedom')
    else
      call check_finite(solution%force, 'force', info)
      if (.not. info%failed()) call check_finite(solution%motion(:m), 'motion', info)
    end if
  end subroutine check_recovery

  !> Add the displacements by the motions q to `u` (degrees), and leave out those modes that no contact resists. Error:
  !> FUGE_ERR_MEMORY.
  subroutine add_motions(self, motion, u, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: motion(:)
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, stat

    do j = 1, size(self%rigid_modes, 2)
      u = u + self%rigid_modes(:, j)*motion(j)
    end do
    if (.not. allocated(self%unresisted_modes)) return
    call remove_motions(self%unresisted_modes, self%scale, u, stat)
    call require_memory(stat, 'the displacements', info)
  end subroutine add_motions

  !> The residual of K u = forces, with K itself and not its factor, as info%residual; a warning if it is large. `load`
  !> (degrees) external, `force` (n) of the contact.
  subroutine find_residual(self, load, force, u, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: load(:), force(:), u(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: forces(:), residual(:), product(:), magnitude(:)
    integer :: stat

    allocate (forces(size(u)), residual(size(u)), product(size(u)), magnitude(size(u)), stat=stat)
    call require_memory(stat, 'the residual', info)
    if (stat /= 0) return
    forces = 0.0_dp
    call add_contact_forces(self%body, force, forces)
    call self%stiffness%multiply(u, product, magnitude)
    residual = product - forces - load
    magnitude = magnitude + abs(forces) + abs(load)
    call unscale(residual, self%scale)
    call unscale(magnitude, self%scale)
    if (.not. maxval(magnitude) > 0.0_dp) return
    info%residual = maxval(abs(residual))/maxval(magnitude)
    if (info%residual > RESIDUAL_TOLERANCE) call report(info, FUGE_WARN_RESIDUAL, &
      'the displacements leave degree of freedom '//index_text(maxloc(abs(residual), 1))//' out of balance by ' &
      //text(info%residual)//' of the largest force')
  end subroutine find_residual

  !> Mark the supports; `all_scale` (degrees) as in `find_scale`.
  subroutine mark_supports(self, all_scale, info)
    type(fuge_condensed), intent(inout) :: self
    real(dp), allocatable, intent(out) :: all_scale(:)
    type(fuge_info), intent(inout) :: info
    integer :: degrees, stat

    degrees = self%stiffness%degrees()
    allocate (self%constrained(degrees), self%scale(degrees), all_scale(degrees), stat=stat)
    call require_memory(stat, '', degrees, 'degrees of freedom', info)
    if (stat /= 0) return
    self%constrained = .false.
    if (allocated(self%body%fixed)) self%constrained(self%body%fixed) = .true.
    call find_scale(self, all_scale, info)
    if (.not. (self%body%held_points .or. info%failed())) call check_free_points(self%body, self%constrained, info)
    if (.not. info%failed()) self%constrained(self%idle) = .true.
  end subroutine mark_supports

  !> Factorise a body that floats, pins included, in an order that gives its rigid modes as well. `found`: false if that
  !> is not possible, or if K is so near to singular that order and modes matter.
  subroutine factorise_once(self, pins, found)
    type(fuge_condensed), intent(inout) :: self
    integer, allocatable, intent(out) :: pins(:)
    logical, intent(out) :: found
    real(dp) :: quotient
    integer :: status, weakest

    call factorise_floating(self%stiffness, self%body, self%constrained, self%scale, self%factor, pins, found)
    if (.not. found) return
    pins = [pins, self%idle]
    self%constrained(pins) = .true.
    call measure(self, pins, quotient, weakest, status)
    found = status == FUGE_DONE .and. quotient > ANY_ORDER
    if (found) then
      self%mode_error = max(self%mode_error, epsilon(quotient)/quotient)
    else
      self%constrained(pins) = .false.
      self%constrained(self%idle) = .true.
    end if
  end subroutine factorise_once

  !> Find or check the rigid modes and choose their pins; `all_scale` (degrees) as in `find_scale`.
  subroutine constrain(self, all_scale, pins, info)
    type(fuge_condensed), intent(inout) :: self
    real(dp), allocatable, intent(in) :: all_scale(:)
    integer, allocatable, intent(out) :: pins(:)
    type(fuge_info), intent(inout) :: info

    if (allocated(self%stiffness%last)) deallocate (self%stiffness%last)
    if (self%body%floats) then
      call find_rigid_modes(self%stiffness, self%constrained, self%scale, self%rigid_modes, info)
    else if (allocated(self%body%rigid_modes)) then
      call check_rigid_modes(self%stiffness, self%constrained, all_scale, self%body%rigid_modes, info)
      if (.not. info%failed()) self%rigid_modes = self%body%rigid_modes
    else
      allocate (self%rigid_modes(size(all_scale), 0))
    end if
    if (.not. info%failed()) call choose_pins(pin_scale(self%body, self%scale), self%rigid_modes, pins, info)
    if (info%failed()) return
    pins = [pins, self%idle]
    self%constrained(pins) = .true.
  end subroutine constrain

  !> Square roots of the diagonal of K: `all_scale` (degrees), and self%scale, zero where fixed. A free degree of
  !> freedom without stiffness is idle if the body floats, else it is refused.
  subroutine find_scale(self, all_scale, info)
    type(fuge_condensed), intent(inout) :: self
    real(dp), intent(out) :: all_scale(:)
    type(fuge_info), intent(inout) :: info
    integer :: j

    call self%stiffness%diagonal(all_scale)
    call find_idle(self, all_scale, info)
    if (info%failed()) return
    do j = 1, size(all_scale)
      if (all_scale(j) > 0.0_dp) then
        all_scale(j) = sqrt(all_scale(j))
      else if (self%constrained(j) .or. (size(self%idle) > 0 .and. .not. abs(all_scale(j)) > 0.0_dp)) then
        ! If any are idle, all are that have no stiffness.
        all_scale(j) = 0.0_dp
      else
        call report(info, FUGE_ERR_NOT_DEFINITE, 'degree of freedom '//index_text(j)//' has the stiffness ' &
                    //text(all_scale(j))//' on the diagonal: make it positive, or fix the degree of freedom')
        return
      end if
    end do
    self%scale = merge(0.0_dp, all_scale, self%constrained)
  end subroutine find_scale

  !> Free degrees of freedom whose rows of K are zero, if the body floats; none if only their diagonal is.
  subroutine find_idle(self, diagonal, info)
    type(fuge_condensed), intent(inout) :: self
    real(dp), intent(in) :: diagonal(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: moved(:), product(:), magnitude(:)
    integer :: j, stat

    allocate (self%idle(0))
    if (.not. self%body%floats .or. all(abs(diagonal) > 0.0_dp .or. self%constrained)) return
    allocate (moved(size(diagonal)), product(size(diagonal)), magnitude(size(diagonal)), stat=stat)
    call require_memory(stat, '', size(diagonal), 'degrees of freedom', info)
    if (stat /= 0) return
    moved = merge(0.0_dp, 1.0_dp, abs(diagonal) > 0.0_dp .or. self%constrained)
    call self%stiffness%multiply(moved, product, magnitude)
    if (.not. any(magnitude > 0.0_dp)) self%idle = pack([(j, j=1, size(moved))], moved > 0.0_dp)
  end subroutine find_idle

  !> Factorise with supports and pins; refuse a body that still floats, warn if it nearly does.
  subroutine factorise(self, pins, info)
    type(fuge_condensed), intent(inout) :: self
    integer, intent(in) :: pins(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: quotient
    integer :: status, weakest

    call factorise_measured(self, pins, quotient, weakest, status)
    if (allocated(self%stiffness%last) .and. .not. (status == FUGE_DONE .and. quotient > ANY_ORDER)) then
      deallocate (self%stiffness%last)
      call factorise_measured(self, pins, quotient, weakest, status)
    end if
    ! Rigid modes computed with the factor are as accurate as the factor.
    if (self%body%floats) self%mode_error = max(self%mode_error, epsilon(quotient)/max(quotient, epsilon(quotient)))
    if (status /= FUGE_DONE) then
      call require_memory(status, 'the factor of the stiffness matrix', info)
    else if (.not. quotient > epsilon(quotient)) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness matrix is not positive definite: ' &
                  //trim(what_holds(self, pins))//', and degree of freedom '//index_text(weakest) &
                  //' still moves freely; fix it, or, if the body floats, set its rigid modes or let them be found')
    else if (quotient < NEARLY_SINGULAR) then
      call report(info, FUGE_WARN_RESIDUAL, 'the stiffness matrix is nearly singular: its softest mode, which ' &
                  //'moves degree of freedom '//index_text(weakest)//' most, has the relative stiffness ' &
                  //text(quotient)//'; alpha may have only '//text(max(nint(-log10(epsilon(quotient)/quotient)), 0)) &
                  //' correct digits')
    end if
  end subroutine factorise

  !> What holds a body that moves nevertheless, for a message: its supports, and the pins for its rigid modes.
  function what_holds(self, pins) result(words)
    type(fuge_condensed), intent(in) :: self
    integer, intent(in) :: pins(:)
    character(len=80) :: words
    integer :: supports

    supports = count(self%constrained) - size(pins)
    if (supports < 1) then
      words = 'no degree of freedom is fixed'
    else if (supports == 1) then
      words = 'with one degree of freedom fixed'
    else
      words = 'with '//text(supports)//' degrees of freedom fixed'
    end if
    if (size(pins) > 0) words = trim(words)//' and its rigid modes held'
  end function what_holds

  !> The factor in the order that the stiffness asks for, and its smallest eigenvalue; results as in `measure`.
  subroutine factorise_measured(self, pins, quotient, weakest, status)
    type(fuge_condensed), intent(inout) :: self
    integer, intent(in) :: pins(:)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: weakest, status
    real(dp) :: pivot

    call self%stiffness%factorise(self%constrained, 0.0_dp, self%factor, pivot, weakest, status)
    quotient = 0.0_dp
    if (status == FUGE_DONE .and. pivot > SMALLEST_PIVOT) call measure(self, pins, quotient, weakest, status)
  end subroutine factorise_measured

  !> The smallest eigenvalue of the factored stiffness, `quotient`, the degree of freedom `weakest` that its mode moves
  !> most, and, since all of them need solves, the displacements by load and supports, u_p, and the rigid modes if they
  !> are to be found. `status` is FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine measure(self, pins, quotient, weakest, status)
    type(fuge_condensed), intent(inout) :: self
    integer, intent(in) :: pins(:)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: weakest, status
    real(dp), allocatable :: loads(:, :)
    integer :: k, modes

    modes = merge(size(pins), 0, self%body%floats)
    allocate (loads(size(self%constrained), 1 + modes), stat=status)
    if (status == FUGE_DONE) call set_loads(self, loads(:, 1), status)
    if (status /= FUGE_DONE) return
    if (modes > 0) call find_pin_loads(self%stiffness, self%constrained, pins, loads(:, 2:))
    call find_smallest_eigenvalue(self%stiffness, self%factor, merge(0.0_dp, self%scale, self%constrained), loads, &
                                  quotient, weakest, status)
    if (status /= FUGE_DONE) return
    call add_supports(self, loads(:, 1), self%body%displacement)
    self%load_displacement = loads(:, 1)
    if (.not. self%body%floats) return
    self%rigid_modes = loads(:, 2:)
    do k = 1, modes
      self%rigid_modes(pins(k), k) = 1.0_dp
    end do
  end subroutine measure

  !> The load less the forces of the displaced supports, `load` (degrees), zero where constrained. `status` is not
  !> FUGE_DONE without memory.
  subroutine set_loads(self, load, status)
    type(fuge_condensed), intent(in) :: self
    real(dp), intent(out) :: load(:)
    integer, intent(out) :: status
    real(dp), allocatable :: support_forces(:)

    allocate (support_forces(size(load)), stat=status)
    if (status /= FUGE_DONE) return
    call find_support_forces(self, support_forces, status, self%body%displacement)
    if (status /= FUGE_DONE) return
    load = 0.0_dp
    if (allocated(self%body%load)) load = self%body%load
    load = load - support_forces
    where (self%constrained) load = 0.0_dp
  end subroutine set_loads

  !> The forces (degrees) that displace the supports alone by `displacement` (fixed), by default not at all. `status` is
  !> not FUGE_DONE without memory.
  subroutine find_support_forces(self, forces, status, displacement)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(out) :: forces(:)
    integer, intent(out) :: status
    real(dp), intent(in), optional :: displacement(:)
    real(dp), allocatable :: prescribed(:), magnitude(:)

    status = FUGE_DONE
    forces = 0.0_dp
    if (.not. present(displacement)) return
    if (.not. any(abs(displacement) > 0.0_dp)) return
    allocate (prescribed(size(forces)), magnitude(size(forces)), stat=status)
    if (status /= FUGE_DONE) return
    prescribed = 0.0_dp
    call add_supports(self, prescribed, displacement)
    call self%stiffness%multiply(prescribed, forces, magnitude)
  end subroutine find_support_forces

  !> Add the displacements of the supports, if there are any, to `u` (degrees).
  pure subroutine add_supports(self, u, displacement)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(inout) :: u(:)
    real(dp), intent(in), optional :: displacement(:)

    if (.not. present(displacement)) return
    if (size(displacement) > 0) u(self%body%fixed) = u(self%body%fixed) + displacement
  end subroutine add_supports

  !> R = -H^T Z; keep the modes that the contact points resist.
  subroutine keep_resisted_modes(self, info)
    type(fuge_condensed), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    logical :: resisted(size(self%rigid_modes, 2))
    real(dp), allocatable :: remaining(:, :)
    integer, allocatable :: columns(:)
    integer :: j, stat

    call find_contact_modes(self%body, self%rigid_modes, self%scale, self%mode_error, self%modes, stat)
    if (stat == 0) call split_rigid_modes(self%rigid_modes, self%modes, self%scale, &
                                          displacement_scale(self%body, self%scale), self%mode_error, resisted, &
                                          self%unresisted_modes, stat)
    if (stat /= 0) then
      call require_memory(stat, 'the rigid modes of the contact points', info)
    else if (.not. all(resisted)) then
      columns = pack([(j, j=1, size(resisted))], resisted)
      remaining = self%modes(:, columns)
      call move_alloc(remaining, self%modes)
      remaining = self%rigid_modes(:, columns)
      call move_alloc(remaining, self%rigid_modes)
    end if
  end subroutine keep_resisted_modes

  !> b and w by the external load and the displacements of the supports, from u_p.
  subroutine apply_load(self, info)
    type(fuge_condensed), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: load(:), resultant(:), displacement(:)
    integer :: i, n, stat

    n = size(self%body%dof, 2)
    allocate (load(size(self%constrained)), resultant(size(self%modes, 2)), displacement(n), stat=stat)
    call require_memory(stat, 'the displacements due to the load', info)
    if (stat /= 0) return
    load = 0.0_dp
    if (allocated(self%body%load)) load = self%body%load
    call check_unresisted(self%unresisted_modes, load, self%scale, self%mode_error, info)
    if (info%failed()) return
    resultant = load_resultant(self%rigid_modes, load, self%scale, self%mode_error)
    do i = 1, n
      displacement(i) = point_displacement(self%body%dof(:, i), self%body%normal(:, i), self%load_displacement)
    end do
    call move_alloc(displacement, self%displacement)
    call move_alloc(resultant, self%resultant)
  end subroutine apply_load

  !> Move all components without a copy.
  subroutine move_condensed(source, destination)
    type(fuge_condensed), intent(inout) :: source, destination

    call destination%clear()
    call move_alloc(source%alpha, destination%alpha)
    call move_alloc(source%displacement, destination%displacement)
    call move_alloc(source%modes, destination%modes)
    call move_alloc(source%resultant, destination%resultant)
    call move_alloc(source%stiffness, destination%stiffness)
    call move_alloc(source%factor, destination%factor)
    call move_alloc(source%constrained, destination%constrained)
    call move_alloc(source%scale, destination%scale)
    call move_alloc(source%idle, destination%idle)
    call move_alloc(source%rigid_modes, destination%rigid_modes)
    call move_alloc(source%unresisted_modes, destination%unresisted_modes)
    call move_alloc(source%load_displacement, destination%load_displacement)
    destination%mode_error = source%mode_error
    destination%body = source%body
  end subroutine move_condensed

end module fuge_condensation
