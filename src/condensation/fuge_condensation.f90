!> From the stiffness of a body to the influence matrix of its contact points, and back from
!> contact forces to the displacements of all degrees of freedom.
!>
!> With N the directions of the contact forces (n columns), p the external load and G the
!> inverse of K where supports and pins are held,
!>
!>     alpha = N^T G N,    b = N^T u_p,    u_p = G p (and what the supports impose),
!>     u = u_p + G N f + Z q.
!>
!> Z are the rigid motions of a body that floats; one degree of freedom is pinned for each,
!> whose reaction is zero once forces are in equilibrium, so that no answer depends on the
!> choice. The gaps are then g + b + alpha f - R q with R = -N^T Z, and equilibrium is
!> R^T f = w with w = Z^T p: the general problem. A motion that moves no contact point, such
!> as sliding along a flat one, is left out; nothing may drive it.
module fuge_condensation
  use fuge_body_type, only: fuge_body, check_body, check_load_field
  use fuge_input_checks, only: check_finite, is_finite_everywhere
  use fuge_contact_normals, only: add_force, add_contact_forces, check_free_points, keep_off, &
    moved, softness
  use fuge_contact_modes, only: split_motions, modes_of_points, work_of_load, check_sliding, ROUNDED
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_rigid_body_modes, only: find_motions, check_motions, choose_pins, unit_at_pins
  use fuge_smallest_eigenvalue, only: find_softest_motion, unscale
  use fuge_status, only: fuge_info, report, FUGE_WARN_RESIDUAL, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, &
    FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_OVERFLOW, FUGE_DONE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_number_text, only: text
  implicit none
  private

  public :: fuge_condense, condense_to_recover

  !> Right-hand sides that are solved together.
  integer, parameter :: BLOCK = 64
  !> A pivot below so many roundings of its diagonal term is none.
  real(dp), parameter :: NO_PIVOT = 16.0_dp*epsilon(1.0_dp)
  !> Below, the softest motion lets less than some four digits be promised; often there
  !> are two or three more.
  real(dp), parameter :: SOFT = 1.0e4_dp*epsilon(1.0_dp)
  !> Largest residual of K u = forces that counts as solved, relative to its parts.
  real(dp), parameter :: SOLVED = 1.0e-10_dp

  !> A body condensed to its contact points.
  type, public :: fuge_condensed
    !> Influence matrix, (n, n), length per force.
    real(dp), allocatable :: alpha(:, :)
    !> b: displacements of the contact points by load and supports, (n), length.
    real(dp), allocatable :: displacement(:)
    !> R: rigid motions that the contact has to hold, (n, m); m = 0 for a body that does not float.
    real(dp), allocatable :: modes(:, :)
    !> w: the load's work in each, (m): the resultant of the contact forces.
    real(dp), allocatable :: resultant(:)
    class(fuge_stiffness), allocatable, private :: stiffness
    class(stiffness_factor), allocatable, private :: factor
    type(fuge_body), private :: body
    !> Supports and pins.
    logical, allocatable, private :: held(:)
    !> Square root of the diagonal of K, by which degrees of freedom of any unit compare; zero
    !> where fixed.
    real(dp), allocatable, private :: scale(:)
    !> Z of `modes`, and those motions that move no contact point, (degrees, ..).
    real(dp), allocatable, private :: motions(:, :), sliding(:, :)
    !> Relative error of the motions.
    real(dp), private :: error = ROUNDED
    !> u_p, (degrees).
    real(dp), allocatable, private :: by_load(:)
  contains
    procedure :: pose
    procedure :: recover
    procedure :: set_load
    procedure :: clear
  end type fuge_condensed

contains

  !> Condense a body to its contact points.
  !>
  !> `stiffness` is any extension of fuge_stiffness, set before; of a dense or band matrix
  !> only the reference is kept, for `recover`. Cost: one Cholesky factorisation and n
  !> solves in blocks of 64, four for the softest motion and the load, and where rigid
  !> motions are looked for another factorisation. `condensed` is replaced when done or warned.
  !> Warning: FUGE_WARN_RESIDUAL where K is so near to singular that few digits of alpha may
  !> be left. Errors, which name the degree of freedom or the point:
  !> FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MODES, FUGE_ERR_OPTION, FUGE_ERR_NO_EQUILIBRIUM for a
  !> load along a motion that no contact can hold, FUGE_ERR_MEMORY.
  subroutine fuge_condense(stiffness, body, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info

    call condense(stiffness, body, .true., condensed, info)
  end subroutine fuge_condense

  !> The same without alpha and its n solves, for who knows the contact forces already and
  !> wants `recover` only: the pins are those of `fuge_condense` for the same body.
  subroutine condense_to_recover(stiffness, body, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info

    call condense(stiffness, body, .false., condensed, info)
  end subroutine condense_to_recover

  subroutine condense(stiffness, body, with_alpha, condensed, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: with_alpha
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info
    type(fuge_condensed) :: made
    type(fuge_info) :: warning
    integer, allocatable :: pins(:)
    integer :: stat

    if (stiffness%degrees() < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the stiffness has no matrix: call set first')
      return
    end if
    call check_body(body, stiffness%degrees(), info)
    if (info%failed()) return
    allocate (made%stiffness, source=stiffness, stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for a copy of the stiffness')
    made%body = body
    if (.not. info%failed()) call hold(made, pins, info)
    if (.not. info%failed()) call factorise(made, info)
    warning = info
    if (made%body%floats .and. .not. info%failed()) then
      call unit_at_pins(made%stiffness, made%factor, made%held, pins, made%motions, info)
    end if
    if (with_alpha .and. .not. info%failed()) call find_alpha(made, info)
    if (.not. info%failed()) call find_modes(made, info)
    if (.not. info%failed()) call apply_load(made, info)
    if (.not. info%failed()) then
      info%status = warning%status
      info%message = warning%message
      call take(made, condensed)
    end if
    call made%clear()
  end subroutine condense

  !> Another external load on the same body: `displacement` and `resultant` follow, with one
  !> solve.
  !>
  !> `load` (degrees), force. Errors: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_MEMORY; all is then as it was.
  subroutine set_load(self, load, info)
    class(fuge_condensed), intent(inout) :: self
    real(dp), intent(in) :: load(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: before(:)

    if (.not. allocated(self%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'nothing has been condensed')
      return
    end if
    call check_load_field(load, size(self%held), info)
    if (info%failed()) return
    call move_alloc(self%body%load, before)
    self%body%load = load
    call apply_load(self, info)
    if (info%failed()) call move_alloc(before, self%body%load)
  end subroutine set_load

  !> Pose the contact problem: gap + b; and, if the body floats, its motions and their
  !> resultants. Other components stay: without modes that is one translation, of a rigid
  !> counter-body under a load, whose resultant is yours to set.
  !>
  !> `gap` (n), initial gaps, length. Errors: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE.
  subroutine pose(self, gap, problem, info)
    class(fuge_condensed), intent(in) :: self
    real(dp), intent(in) :: gap(:)
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info

    if (.not. allocated(self%displacement)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'nothing has been condensed')
    else if (size(gap) /= size(self%displacement)) then
      call report(info, FUGE_ERR_SIZE, 'gap has '//text(size(gap))//' value(s): it needs one for each of ' &
                  //text(size(self%displacement))//' contact points')
    end if
    if (info%failed()) return
    problem%gap = gap + self%displacement
    if (size(self%resultant) < 1) return
    problem%modes = self%modes
    problem%resultant = self%resultant
  end subroutine pose

  !> Displacements of all degrees of freedom in the solved contact.
  !>
  !> `u` (degrees), length. Of the solution the forces and the first m rigid motions are
  !> read, m the number of `modes`. A motion that moves no contact point is left at zero at
  !> its pin. info%residual is the largest force that K u leaves unbalanced at a free degree
  !> of freedom, relative to its parts; above 1e-10 FUGE_WARN_RESIDUAL.
  !> Errors: FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY; `u` is then as it was.
  subroutine recover(self, solution, u, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: field(:, :), forces(:)
    integer :: j, stat

    call check_recovery(self, solution, size(u), info)
    if (info%failed()) return
    allocate (field(size(u), 1), forces(size(u)), stat=stat)
    if (stat == 0) then
      forces = 0.0_dp
      call add_contact_forces(self%body, solution%force, forces)
      field(:, 1) = merge(0.0_dp, forces, self%held)
      call self%factor%solve(field, stat)
    end if
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the displacements')
      return
    end if
    field(:, 1) = self%by_load + field(:, 1)
    do j = 1, size(self%motions, 2)
      field(:, 1) = field(:, 1) + self%motions(:, j)*solution%motion(j)
    end do
    call find_residual(self, solution, field(:, 1), info)
    if (.not. info%failed()) u = field(:, 1)
  end subroutine recover

  !> Give back the stiffness and its factor, by far the most of the memory; alpha and what
  !> else can be read stay. Done by itself when the variable ends, but not by flang 22.
  subroutine clear(self)
    class(fuge_condensed), intent(inout) :: self

    if (allocated(self%stiffness)) deallocate (self%stiffness)
    if (allocated(self%factor)) deallocate (self%factor)
  end subroutine clear

  !> Does the solution belong here?
  pure subroutine check_recovery(self, solution, degrees, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info
    integer :: m, n

    if (.not. allocated(self%factor)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'nothing has been condensed')
      return
    else if (.not. (allocated(solution%force) .and. allocated(solution%motion))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the solution holds no forces: solve first')
      return
    end if
    n = size(self%displacement)
    m = size(self%resultant)
    if (size(solution%force) /= n .or. size(solution%motion) < m) then
      call report(info, FUGE_ERR_SIZE, 'the solution has '//text(size(solution%force))//' forces and ' &
                  //text(size(solution%motion))//' motions: this body has '//text(n)//' contact points and '//text(m) &
                  //' motions')
    else if (degrees /= size(self%held)) then
      call report(info, FUGE_ERR_SIZE, 'u has '//text(degrees)//' value(s): it needs one for each of ' &
                  //text(size(self%held))//' degrees of freedom')
    else
      call check_finite(solution%force, 'force', info)
      if (.not. info%failed()) call check_finite(solution%motion(:m), 'motion', info)
    end if
  end subroutine check_recovery

  !> What K u leaves of the loads, from K itself.
  subroutine find_residual(self, solution, u, info)
    class(fuge_condensed), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: u(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: forces(:), left(:), product(:), magnitude(:)
    integer :: stat

    allocate (forces(size(u)), left(size(u)), product(size(u)), magnitude(size(u)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the residual')
      return
    end if
    forces = 0.0_dp
    call add_contact_forces(self%body, solution%force, forces)
    call self%stiffness%multiply(u, product, magnitude)
    left = product - forces
    magnitude = magnitude + abs(forces)
    if (allocated(self%body%load)) then
      left = left - self%body%load
      magnitude = magnitude + abs(self%body%load)
    end if
    call unscale(left, self%scale)
    call unscale(magnitude, self%scale)
    if (maxval(magnitude) > 0.0_dp) info%residual = maxval(abs(left))/maxval(magnitude)
    if (info%residual > SOLVED) call report(info, FUGE_WARN_RESIDUAL, 'displacements given, but degree of freedom ' &
      //text(maxloc(abs(left), 1))//' is out of balance by '//text(info%residual)//' of the largest force')
  end subroutine find_residual

  !> Mark the supports, find or check the motions and choose where to pin them.
  subroutine hold(made, pins, info)
    type(fuge_condensed), intent(inout) :: made
    integer, allocatable, intent(out) :: pins(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: all_scale(:)
    integer :: degrees, stat

    degrees = made%stiffness%degrees()
    allocate (made%held(degrees), made%scale(degrees), all_scale(degrees), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(degrees)//' degrees of freedom')
      return
    end if
    made%held = .false.
    if (allocated(made%body%fixed)) made%held(made%body%fixed) = .true.
    call find_scale(made, all_scale, info)
    if (.not. info%failed()) call check_free_points(made%body, made%held, info)
    if (info%failed()) return
    if (made%body%floats) then
      call find_motions(made%stiffness, made%held, made%scale, made%motions, info)
    else if (allocated(made%body%rigid_modes)) then
      call check_motions(made%stiffness, made%held, all_scale, made%body%rigid_modes, info)
      if (.not. info%failed()) made%motions = made%body%rigid_modes
    else
      allocate (made%motions(degrees, 0))
    end if
    if (.not. info%failed()) call choose_pins(keep_off(made%body, made%scale), made%motions, pins, info)
    if (.not. info%failed()) made%held(pins) = .true.
  end subroutine hold

  !> Square roots of the diagonal of K, in made%scale zero where fixed; refuse a free degree
  !> of freedom without stiffness.
  subroutine find_scale(made, all_scale, info)
    type(fuge_condensed), intent(inout) :: made
    real(dp), intent(out) :: all_scale(:)
    type(fuge_info), intent(inout) :: info
    integer :: j

    call made%stiffness%diagonal(all_scale)
    do j = 1, size(all_scale)
      if (all_scale(j) > 0.0_dp) then
        all_scale(j) = sqrt(all_scale(j))
      else if (made%held(j)) then
        all_scale(j) = 0.0_dp
      else
        call report(info, FUGE_ERR_NOT_DEFINITE, 'degree of freedom '//text(j)//' has the stiffness ' &
                    //text(all_scale(j))//' on the diagonal: it needs a positive one, or to be fixed')
        return
      end if
    end do
    made%scale = merge(0.0_dp, all_scale, made%held)
  end subroutine find_scale

  !> Factorise what is free; refuse a body that still floats, and warn if it nearly does.
  subroutine factorise(made, info)
    type(fuge_condensed), intent(inout) :: made
    type(fuge_info), intent(inout) :: info
    real(dp) :: pivot, quotient
    integer :: status, weakest

    call made%stiffness%factorise(made%held, 0.0_dp, made%factor, pivot, weakest, status)
    quotient = 0.0_dp
    if (status == FUGE_DONE .and. pivot > NO_PIVOT) call find_softest_motion(made%stiffness, made%factor, &
      merge(0.0_dp, made%scale, made%held), quotient, weakest, status)
    ! Motions found by the factor are as exact as it is.
    if (made%body%floats) made%error = max(made%error, epsilon(quotient)/max(quotient, epsilon(quotient)))
    if (status /= FUGE_DONE) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the factor of the stiffness matrix')
    else if (.not. quotient > epsilon(quotient)) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness matrix is not positive definite: with ' &
                  //text(count(made%held))//' held, supports and pins, degree of freedom '//text(weakest) &
                  //' still moves freely; fix that motion, or set floats (modes) if the body floats')
    else if (quotient < SOFT) then
      call report(info, FUGE_WARN_RESIDUAL, 'the stiffness matrix is nearly singular: the motion that moves degree ' &
                  //'of freedom '//text(weakest)//' most has '//text(quotient)//' of the stiffness of its parts; as ' &
                  //'few as '//text(max(nint(-log10(epsilon(quotient)/quotient)), 0))//' digits of alpha may be left')
    end if
  end subroutine factorise

  !> alpha = N^T G N, a block of columns at a time.
  subroutine find_alpha(made, info)
    type(fuge_condensed), intent(inout) :: made
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: columns(:, :)
    integer :: first, i, j, last, n, stat

    n = size(made%body%dof, 2)
    allocate (made%alpha(n, n), columns(size(made%held), min(BLOCK, n)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the influence matrix of '//text(n)//' contact points')
      return
    end if
    do first = 1, n, BLOCK
      last = min(first + BLOCK - 1, n)
      columns = 0.0_dp
      do j = first, last
        call add_force(made%body%dof(:, j), made%body%normal(:, j), 1.0_dp, columns(:, j - first + 1))
        where (made%held) columns(:, j - first + 1) = 0.0_dp
      end do
      call made%factor%solve(columns(:, :last - first + 1), stat)
      if (stat /= FUGE_DONE) then
        call report(info, stat, 'no memory to solve for '//text(last - first + 1)//' right-hand sides')
        return
      end if
      do j = first, last
        do i = 1, n
          made%alpha(i, j) = moved(made%body%dof(:, i), made%body%normal(:, i), columns(:, j - first + 1))
        end do
      end do
    end do
    do j = 1, n
      if (is_finite_everywhere(made%alpha(:, j)) .and. made%alpha(j, j) < huge(1.0_dp)) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'the influence of contact point '//text(j)//' overflows: choose other ' &
                  //'units, or normals of length one')
      return
    end do
    do j = 2, n
      do i = 1, j - 1
        made%alpha(i, j) = 0.5_dp*(made%alpha(i, j) + made%alpha(j, i))
        made%alpha(j, i) = made%alpha(i, j)
      end do
    end do
  end subroutine find_alpha

  !> R = -N^T Z, without what the contact cannot feel.
  subroutine find_modes(made, info)
    type(fuge_condensed), intent(inout) :: made
    type(fuge_info), intent(inout) :: info
    logical :: felt(size(made%motions, 2))
    real(dp), allocatable :: kept(:, :)
    integer, allocatable :: columns(:)
    integer :: j, stat

    call modes_of_points(made%body, made%motions, made%scale, made%error, made%modes, stat)
    if (stat == 0) call split_motions(made%motions, made%modes, made%scale, softness(made%body, made%scale), &
                                      made%error, felt, made%sliding, stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the rigid motions of the contact points')
    else if (.not. all(felt)) then
      columns = pack([(j, j=1, size(felt))], felt)
      kept = made%modes(:, columns)
      call move_alloc(kept, made%modes)
      kept = made%motions(:, columns)
      call move_alloc(kept, made%motions)
    end if
  end subroutine find_modes

  !> u_p, b and w by the external load and the displacements of the supports.
  subroutine apply_load(made, info)
    class(fuge_condensed), intent(inout) :: made
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: field(:, :), given(:), product(:), magnitude(:), by_load(:), resultant(:), displacement(:)
    integer :: i, m, n, degrees, stat

    degrees = size(made%held)
    n = size(made%body%dof, 2)
    m = size(made%modes, 2)
    allocate (field(degrees, 1), given(degrees), product(degrees), magnitude(degrees), resultant(m), displacement(n), &
              stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the displacements by the load')
      return
    end if
    field = 0.0_dp
    if (allocated(made%body%load)) field(:, 1) = made%body%load
    call check_sliding(made%sliding, field(:, 1), made%scale, made%error, info)
    if (info%failed()) return
    resultant = work_of_load(made%motions, field(:, 1), made%scale, made%error)
    given = 0.0_dp
    if (allocated(made%body%displacement)) then
      given(made%body%fixed) = made%body%displacement
      call made%stiffness%multiply(given, product, magnitude)
      field(:, 1) = field(:, 1) - product
    end if
    where (made%held) field(:, 1) = 0.0_dp
    call made%factor%solve(field, stat)
    if (stat /= FUGE_DONE) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the displacements by the load')
      return
    end if
    by_load = field(:, 1) + given
    do i = 1, n
      displacement(i) = moved(made%body%dof(:, i), made%body%normal(:, i), by_load)
    end do
    call move_alloc(by_load, made%by_load)
    call move_alloc(displacement, made%displacement)
    call move_alloc(resultant, made%resultant)
  end subroutine apply_load

  !> Move what has been made to where it is wanted, without a copy.
  subroutine take(made, condensed)
    type(fuge_condensed), intent(inout) :: made, condensed

    call condensed%clear()
    call move_alloc(made%alpha, condensed%alpha)
    call move_alloc(made%displacement, condensed%displacement)
    call move_alloc(made%modes, condensed%modes)
    call move_alloc(made%resultant, condensed%resultant)
    call move_alloc(made%stiffness, condensed%stiffness)
    call move_alloc(made%factor, condensed%factor)
    call move_alloc(made%held, condensed%held)
    call move_alloc(made%scale, condensed%scale)
    call move_alloc(made%motions, condensed%motions)
    call move_alloc(made%sliding, condensed%sliding)
    call move_alloc(made%by_load, condensed%by_load)
    condensed%error = made%error
    condensed%body = made%body
  end subroutine take

end module fuge_condensation
