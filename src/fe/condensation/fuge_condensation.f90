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
  use fuge_body_type, only: check_body, check_load_field, fuge_body
  use fuge_held_body, only: add_motions, add_supports, find_residual, held_body, hold_body, move_held, set_loads
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_load_cases_type, only: fuge_case_solutions, fuge_load_cases, move_cases
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: fuge_condense, condense_to_recover

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
    type(held_body), private :: held
  contains
    procedure :: pose
    procedure :: recover
    procedure :: set_load
    procedure :: pose_cases
    procedure :: recover_cases
    procedure :: move_rigidly
    procedure :: held_points
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
    use fuge_condensed_influence, only: find_influence
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: with_alpha
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info
    type(fuge_condensed) :: result
    type(fuge_info) :: warning

    if (stiffness%degrees() < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the stiffness has no matrix: call set first')
      return
    end if
    call check_body(body, stiffness%degrees(), info)
    if (info%failed()) return
    call hold_body(stiffness, body, with_alpha, result%held, info)
    warning = info
    if (with_alpha .and. .not. info%failed()) &
      call find_influence(body, result%held%constrained, result%held%factor, result%alpha, info)
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

    if (.not. allocated(self%held%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
      return
    end if
    call check_load_field(load, size(self%held%constrained), info)
    if (info%failed()) return
    call move_alloc(self%held%body%load, previous)
    call move_alloc(self%held%load_displacement, previous_displacement)
    self%held%body%load = load
    allocate (block(size(load), 1), stat=stat)
    if (stat == 0) call set_loads(self%held, block(:, 1), stat)
    if (stat == 0) call self%held%factor%solve(block, stat)
    if (stat == 0) then
      call add_supports(self%held, block(:, 1), self%held%body%displacement)
      self%held%load_displacement = block(:, 1)
      call apply_load(self, info)
    else
      call require_memory(stat, 'the displacements due to the load', info)
    end if
    if (.not. info%failed()) return
    call move_alloc(previous, self%held%body%load)
    call move_alloc(previous_displacement, self%held%load_displacement)
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
    use fuge_condensed_cases, only: check_loads, condense_loads
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
    if (.not. info%failed()) call check_loads(self%held, loads, moved, info)
    if (.not. info%failed()) then
      posed = problem
      call self%pose(gap, posed, info)
    end if
    if (info%failed()) return
    allocate (found%gap(size(gap), size(loads, 2)), found%load(posed%mode_count(), size(loads, 2)), &
              found%refused(size(loads, 2)), stat=stat)
    call require_memory(stat, 'the gaps of', size(loads, 2), 'load cases', info)
    if (.not. info%failed()) call condense_loads(self%held, loads, moved, found, info)
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

  !> Displacements of all degrees of freedom for the solutions of all load cases, as `recover` for each.
  !>
  !> `loads` (degrees, cases) and `displacement` as for `pose_cases`; `u` (degrees, cases), length: NaN in the columns
  !> of cases without a solution. info%residual is the largest of any case, FUGE_WARN_RESIDUAL if it exceeds 1e-10; the
  !> report of such a case, if it had no warning, has this one. Errors, `u` unchanged but for FUGE_ERR_MEMORY:
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW.
  subroutine recover_cases(self, loads, solutions, u, info, displacement)
    use fuge_condensed_cases, only: check_case_solutions, check_loads, find_case_displacements
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: loads(:, :)
    type(fuge_case_solutions), intent(inout) :: solutions
    real(dp), intent(inout) :: u(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), intent(in), optional :: displacement(:, :)
    real(dp), allocatable :: moved(:, :)
    integer :: stat

    stat = 0
    if (present(displacement)) allocate (moved, source=displacement, stat=stat)
    call require_memory(stat, 'the displacements of supports', info)
    if (.not. info%failed()) call check_loads(self%held, loads, moved, info)
    if (.not. info%failed()) call check_case_solutions(self%held, solutions, shape(loads), shape(u), info)
    if (.not. info%failed()) call find_case_displacements(self%held, loads, moved, solutions, u, info)
  end subroutine recover_cases

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
    use fuge_contact_normals, only: add_contact_forces
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
      call add_contact_forces(self%held%body, solution%force, forces)
      block(:, 1) = merge(0.0_dp, forces, self%held%constrained)
      call self%held%factor%solve(block, stat)
    end if
    call require_memory(stat, 'the displacements', info)
    if (stat /= 0) return
    block(:, 1) = self%held%load_displacement + block(:, 1)
    call add_motions(self%held, solution%motion, block(:, 1), info)
    if (info%failed()) return
    if (allocated(self%held%body%load)) then
      call find_residual(self%held, self%held%body%load, solution%force, block(:, 1), info)
    else
      forces = 0.0_dp
      call find_residual(self%held, forces, solution%force, block(:, 1), info)
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

    if (.not. allocated(self%held%rigid_modes)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (size(motion) /= size(self%held%rigid_modes, 2) .or. size(u) /= size(self%held%rigid_modes, 1)) then
      call report(info, FUGE_ERR_SIZE, 'there are '//text(size(motion))//' motions and '//text(size(u)) &
                  //' displacements: this body has '//text(size(self%held%rigid_modes, 2))//' rigid modes and ' &
                  //text(size(self%held%rigid_modes, 1))//' degrees of freedom')
    end if
    if (info%failed()) return
    u = 0.0_dp
    do j = 1, size(motion)
      u = u + self%held%rigid_modes(:, j)*motion(j)
    end do
  end subroutine move_rigidly

  !> Which contact points the supports hold entirely, (n): whatever the loads are, these move with the supports alone.
  !> A body that has been condensed before.
  pure function held_points(self) result(held)
    use fuge_contact_normals, only: is_held
    class(fuge_condensed), intent(in) :: self
    logical :: held(size(self%displacement))
    logical :: fixed(size(self%held%constrained))
    integer :: i

    fixed = .false.
    if (allocated(self%held%body%fixed)) fixed(self%held%body%fixed) = .true.
    do i = 1, size(held)
      held(i) = is_held(self%held%body%dof(:, i), self%held%body%normal(:, i), fixed)
    end do
  end function held_points

  !> Free the stiffness and its factor, by far the largest part of the memory; the public
  !> components stay. It happens automatically when the variable goes out of scope, but not with
  !> flang 22.
  subroutine clear(self)
    class(fuge_condensed), intent(inout) :: self

    if (allocated(self%held%stiffness)) deallocate (self%held%stiffness)
    if (allocated(self%held%factor)) deallocate (self%held%factor)
  end subroutine clear

  !> Refuse a solution, or a number of displacements, that does not fit this body.
  pure subroutine check_recovery(self, solution, degrees, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info
    integer :: m, n

    if (.not. allocated(self%held%factor)) then
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
    else if (degrees /= size(self%held%constrained)) then
      call report(info, FUGE_ERR_SIZE, 'u has '//text(degrees)//' value(s): it needs one for each of ' &
                  //text(size(self%held%constrained))//' degrees of freedom')
    else
      call check_finite(solution%force, 'force', info)
      if (.not. info%failed()) call check_finite(solution%motion(:m), 'motion', info)
    end if
  end subroutine check_recovery

  !> R = -H^T Z; keep the modes that the contact points resist.
  subroutine keep_resisted_modes(self, info)
    use fuge_contact_modes, only: find_contact_modes, split_rigid_modes
    use fuge_contact_normals, only: displacement_scale
    type(fuge_condensed), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    logical :: resisted(size(self%held%rigid_modes, 2))
    real(dp), allocatable :: remaining(:, :)
    integer, allocatable :: columns(:)
    integer :: j, stat

    associate (held => self%held)
      call find_contact_modes(held%body, held%rigid_modes, held%scale, held%mode_error, self%modes, stat)
      if (stat == 0) call split_rigid_modes(held%rigid_modes, self%modes, held%scale, &
                                            displacement_scale(held%body, held%scale), held%mode_error, resisted, &
                                            held%unresisted_modes, stat)
    end associate
    if (stat /= 0) then
      call require_memory(stat, 'the rigid modes of the contact points', info)
    else if (.not. all(resisted)) then
      columns = pack([(j, j=1, size(resisted))], resisted)
      remaining = self%modes(:, columns)
      call move_alloc(remaining, self%modes)
      remaining = self%held%rigid_modes(:, columns)
      call move_alloc(remaining, self%held%rigid_modes)
    end if
  end subroutine keep_resisted_modes

  !> b and w by the external load and the displacements of the supports, from u_p.
  subroutine apply_load(self, info)
    use fuge_contact_modes, only: check_unresisted, load_resultant
    use fuge_contact_normals, only: point_displacement
    type(fuge_condensed), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: load(:), resultant(:), displacement(:)
    integer :: i, n, stat

    associate (held => self%held, body => self%held%body)
      n = size(body%dof, 2)
      allocate (load(size(held%constrained)), resultant(size(self%modes, 2)), displacement(n), stat=stat)
      call require_memory(stat, 'the displacements due to the load', info)
      if (stat /= 0) return
      load = 0.0_dp
      if (allocated(body%load)) load = body%load
      call check_unresisted(held%unresisted_modes, load, held%scale, held%mode_error, info)
      if (info%failed()) return
      resultant = load_resultant(held%rigid_modes, load, held%scale, held%mode_error)
      do i = 1, n
        displacement(i) = point_displacement(body%dof(:, i), body%normal(:, i), held%load_displacement)
      end do
    end associate
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
    call move_held(source%held, destination%held)
  end subroutine move_condensed

end module fuge_condensation
