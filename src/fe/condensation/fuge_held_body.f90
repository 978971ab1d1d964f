!> The stiffness matrix of a body held by its supports and by a pin for each rigid mode, and its factor.
!>
!> One degree of freedom is pinned for each rigid mode; its reaction is zero when the forces are in equilibrium, so that
!> no result depends on the choice.
module fuge_held_body
  use fuge_body_type, only: fuge_body
  use fuge_condensed_influence, only: touched_degrees
  use fuge_contact_modes, only: remove_motions, ROUNDING_ERROR
  use fuge_contact_normals, only: add_contact_forces, check_free_points, pin_scale
  use fuge_floating_factor, only: factorise_floating
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_rigid_body_modes, only: check_rigid_modes, choose_pins, find_pin_loads, find_rigid_modes
  use fuge_smallest_eigenvalue, only: find_smallest_eigenvalue, unscale
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_NOT_DEFINITE, FUGE_WARN_RESIDUAL
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: add_motions, add_supports, find_residual, find_support_forces, hold_body, move_held, set_loads

  !> A pivot below this fraction of its diagonal term counts as zero.
  real(dp), parameter :: SMALLEST_PIVOT = 16.0_dp*epsilon(1.0_dp)
  !> With a smallest eigenvalue below this, alpha may have fewer than four correct digits; often it
  !> has two or three more.
  real(dp), parameter :: NEARLY_SINGULAR = 1.0e4_dp*epsilon(1.0_dp)
  !> Above this smallest eigenvalue more than half of the digits are right in whatever order K is eliminated. Below it
  !> the order that fills least is taken, which loses fewer digits on bodies in one row.
  real(dp), parameter :: ANY_ORDER = 1.0e-8_dp
  !> Largest residual of K u = forces that counts as solved, relative to the largest force.
  real(dp), parameter :: RESIDUAL_TOLERANCE = 1.0e-10_dp

  !> A body that is held.
  type, public :: held_body
    class(fuge_stiffness), allocatable :: stiffness
    class(stiffness_factor), allocatable :: factor
    type(fuge_body) :: body
    !> Supports and pins, (degrees).
    logical, allocatable :: constrained(:)
    !> Square root of the diagonal of K, (degrees), which makes displacements of any unit
    !> comparable; zero where fixed.
    real(dp), allocatable :: scale(:)
    !> Degrees of freedom without stiffness of a body that floats, as of a node that cables alone hold: each one is a
    !> rigid mode, and its own pin.
    integer, allocatable :: idle(:)
    !> Z, (degrees, m): the rigid modes, and apart from them those that move no contact point.
    real(dp), allocatable :: rigid_modes(:, :), unresisted_modes(:, :)
    !> Relative error of the rigid modes.
    real(dp) :: mode_error = ROUNDING_ERROR
    !> u_p: displacements by load and supports, (degrees), length.
    real(dp), allocatable :: load_displacement(:)
  end type held_body

contains

  !> Hold `body` by its supports and pins and factorise `stiffness`, with the displacements u_p by its load. Contact
  !> points are eliminated last if alpha is to be found (`with_alpha`) and the matrix can order its rows. Warning and
  !> errors as of `fuge_condense`.
  subroutine hold_body(stiffness, body, with_alpha, held, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: with_alpha
    type(held_body), intent(inout) :: held
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: all_scale(:)
    integer, allocatable :: pins(:)
    logical :: found
    integer :: stat

    allocate (held%stiffness, source=stiffness, stat=stat)
    call require_memory(stat, 'a copy of the stiffness', info)
    held%body = body
    if (.not. info%failed()) call mark_supports(held, all_scale, info)
    found = .false.
    if (.not. info%failed() .and. body%floats .and. with_alpha .and. held%stiffness%can_order()) &
      call factorise_once(held, pins, found)
    if (.not. (found .or. info%failed())) call constrain(held, all_scale, pins, info)
    if (with_alpha .and. .not. (body%floats .or. info%failed()) .and. held%stiffness%can_order()) then
      held%stiffness%last = touched_degrees(body, held%constrained)
      held%stiffness%columns = size(body%dof, 2)
    end if
    if (.not. (found .or. info%failed())) call factorise(held, pins, info)
    ! Now that they are held, idle degrees of freedom count like any other.
    if (.not. info%failed() .and. size(held%idle) > 0) &
      held%scale(held%idle) = merge(maxval(held%scale), 1.0_dp, maxval(held%scale) > 0.0_dp)
  end subroutine hold_body

  !> Mark the supports; `all_scale` (degrees) as in `find_scale`.
  subroutine mark_supports(held, all_scale, info)
    type(held_body), intent(inout) :: held
    real(dp), allocatable, intent(out) :: all_scale(:)
    type(fuge_info), intent(inout) :: info
    integer :: degrees, stat

    degrees = held%stiffness%degrees()
    allocate (held%constrained(degrees), held%scale(degrees), all_scale(degrees), stat=stat)
    call require_memory(stat, '', degrees, 'degrees of freedom', info)
    if (stat /= 0) return
    held%constrained = .false.
    if (allocated(held%body%fixed)) held%constrained(held%body%fixed) = .true.
    call find_scale(held, all_scale, info)
    if (.not. (held%body%held_points .or. info%failed())) call check_free_points(held%body, held%constrained, info)
    if (.not. info%failed()) held%constrained(held%idle) = .true.
  end subroutine mark_supports

  !> Factorise a body that floats, pins included, in an order that gives its rigid modes as well. `found`: false if that
  !> is not possible, or if K is so near to singular that order and modes matter.
  subroutine factorise_once(held, pins, found)
    type(held_body), intent(inout) :: held
    integer, allocatable, intent(out) :: pins(:)
    logical, intent(out) :: found
    real(dp) :: quotient
    integer :: status, weakest

    call factorise_floating(held%stiffness, held%body, held%constrained, held%scale, held%factor, pins, found)
    if (.not. found) return
    pins = [pins, held%idle]
    held%constrained(pins) = .true.
    call measure(held, pins, quotient, weakest, status)
    found = status == FUGE_DONE .and. quotient > ANY_ORDER
    if (found) then
      held%mode_error = max(held%mode_error, epsilon(quotient)/quotient)
    else
      held%constrained(pins) = .false.
      held%constrained(held%idle) = .true.
    end if
  end subroutine factorise_once

  !> Find or check the rigid modes and choose their pins; `all_scale` (degrees) as in `find_scale`.
  subroutine constrain(held, all_scale, pins, info)
    type(held_body), intent(inout) :: held
    real(dp), allocatable, intent(in) :: all_scale(:)
    integer, allocatable, intent(out) :: pins(:)
    type(fuge_info), intent(inout) :: info

    if (allocated(held%stiffness%last)) deallocate (held%stiffness%last)
    if (held%body%floats) then
      call find_rigid_modes(held%stiffness, held%constrained, held%scale, held%rigid_modes, info)
    else if (allocated(held%body%rigid_modes)) then
      call check_rigid_modes(held%stiffness, held%constrained, all_scale, held%body%rigid_modes, info)
      if (.not. info%failed()) held%rigid_modes = held%body%rigid_modes
    else
      allocate (held%rigid_modes(size(all_scale), 0))
    end if
    if (.not. info%failed()) call choose_pins(pin_scale(held%body, held%scale), held%rigid_modes, pins, info)
    if (info%failed()) return
    pins = [pins, held%idle]
    held%constrained(pins) = .true.
  end subroutine constrain

  !> Square roots of the diagonal of K: `all_scale` (degrees), and held%scale, zero where fixed. A free degree of
  !> freedom without stiffness is idle if the body floats, else it is refused.
  subroutine find_scale(held, all_scale, info)
    type(held_body), intent(inout) :: held
    real(dp), intent(out) :: all_scale(:)
    type(fuge_info), intent(inout) :: info
    integer :: j

    call held%stiffness%diagonal(all_scale)
    call find_idle(held, all_scale, info)
    if (info%failed()) return
    do j = 1, size(all_scale)
      if (all_scale(j) > 0.0_dp) then
        all_scale(j) = sqrt(all_scale(j))
      else if (held%constrained(j) .or. (size(held%idle) > 0 .and. .not. abs(all_scale(j)) > 0.0_dp)) then
        ! If any are idle, all are that have no stiffness.
        all_scale(j) = 0.0_dp
      else
        call report(info, FUGE_ERR_NOT_DEFINITE, 'degree of freedom '//index_text(j)//' has the stiffness ' &
                    //text(all_scale(j))//' on the diagonal: make it positive, or fix the degree of freedom')
        return
      end if
    end do
    held%scale = merge(0.0_dp, all_scale, held%constrained)
  end subroutine find_scale

  !> Free degrees of freedom whose rows of K are zero, if the body floats; none if only their diagonal is.
  subroutine find_idle(held, diagonal, info)
    type(held_body), intent(inout) :: held
    real(dp), intent(in) :: diagonal(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: moved(:), product(:), magnitude(:)
    integer :: j, stat

    allocate (held%idle(0))
    if (.not. held%body%floats .or. all(abs(diagonal) > 0.0_dp .or. held%constrained)) return
    allocate (moved(size(diagonal)), product(size(diagonal)), magnitude(size(diagonal)), stat=stat)
    call require_memory(stat, '', size(diagonal), 'degrees of freedom', info)
    if (stat /= 0) return
    moved = merge(0.0_dp, 1.0_dp, abs(diagonal) > 0.0_dp .or. held%constrained)
    call held%stiffness%multiply(moved, product, magnitude)
    if (.not. any(magnitude > 0.0_dp)) held%idle = pack([(j, j=1, size(moved))], moved > 0.0_dp)
  end subroutine find_idle

  !> Factorise with supports and pins; refuse a body that still floats, warn if it nearly does.
  subroutine factorise(held, pins, info)
    type(held_body), intent(inout) :: held
    integer, intent(in) :: pins(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: quotient
    integer :: status, weakest

    call factorise_measured(held, pins, quotient, weakest, status)
    if (allocated(held%stiffness%last) .and. .not. (status == FUGE_DONE .and. quotient > ANY_ORDER)) then
      deallocate (held%stiffness%last)
      call factorise_measured(held, pins, quotient, weakest, status)
    end if
    ! Rigid modes computed with the factor are as accurate as the factor.
    if (held%body%floats) held%mode_error = max(held%mode_error, epsilon(quotient)/max(quotient, epsilon(quotient)))
    if (status /= FUGE_DONE) then
      call require_memory(status, 'the factor of the stiffness matrix', info)
    else if (.not. quotient > epsilon(quotient)) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness matrix is not positive definite: ' &
                  //trim(what_holds(held, pins))//', and degree of freedom '//index_text(weakest) &
                  //' still moves freely; fix it, or, if the body floats, set its rigid modes or let them be found')
    else if (quotient < NEARLY_SINGULAR) then
      call report(info, FUGE_WARN_RESIDUAL, 'the stiffness matrix is nearly singular: its softest mode, which ' &
                  //'moves degree of freedom '//index_text(weakest)//' most, has the relative stiffness ' &
                  //text(quotient)//'; alpha may have only '//text(max(nint(-log10(epsilon(quotient)/quotient)), 0)) &
                  //' correct digits')
    end if
  end subroutine factorise

  !> What holds a body that moves nevertheless, for a message: its supports, and the pins for its rigid modes.
  function what_holds(held, pins) result(words)
    type(held_body), intent(in) :: held
    integer, intent(in) :: pins(:)
    character(len=80) :: words
    integer :: supports

    supports = count(held%constrained) - size(pins)
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
  subroutine factorise_measured(held, pins, quotient, weakest, status)
    type(held_body), intent(inout) :: held
    integer, intent(in) :: pins(:)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: weakest, status
    real(dp) :: pivot

    call held%stiffness%factorise(held%constrained, 0.0_dp, held%factor, pivot, weakest, status)
    quotient = 0.0_dp
    if (status == FUGE_DONE .and. pivot > SMALLEST_PIVOT) call measure(held, pins, quotient, weakest, status)
  end subroutine factorise_measured

  !> The smallest eigenvalue of the factored stiffness, `quotient`, the degree of freedom `weakest` that its mode moves
  !> most, and, since all of them need solves, the displacements by load and supports, u_p, and the rigid modes if they
  !> are to be found. `status` is FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine measure(held, pins, quotient, weakest, status)
    type(held_body), intent(inout) :: held
    integer, intent(in) :: pins(:)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: weakest, status
    real(dp), allocatable :: loads(:, :)
    integer :: k, modes

    modes = merge(size(pins), 0, held%body%floats)
    allocate (loads(size(held%constrained), 1 + modes), stat=status)
    if (status == FUGE_DONE) call set_loads(held, loads(:, 1), status)
    if (status /= FUGE_DONE) return
    if (modes > 0) call find_pin_loads(held%stiffness, held%constrained, pins, loads(:, 2:))
    call find_smallest_eigenvalue(held%stiffness, held%factor, merge(0.0_dp, held%scale, held%constrained), loads, &
                                  quotient, weakest, status)
    if (status /= FUGE_DONE) return
    call add_supports(held, loads(:, 1), held%body%displacement)
    held%load_displacement = loads(:, 1)
    if (.not. held%body%floats) return
    held%rigid_modes = loads(:, 2:)
    do k = 1, modes
      held%rigid_modes(pins(k), k) = 1.0_dp
    end do
  end subroutine measure

  !> The load less the forces of the displaced supports, `load` (degrees), zero where constrained. `status` is not
  !> FUGE_DONE without memory.
  subroutine set_loads(held, load, status)
    type(held_body), intent(in) :: held
    real(dp), intent(out) :: load(:)
    integer, intent(out) :: status
    real(dp), allocatable :: support_forces(:)

    allocate (support_forces(size(load)), stat=status)
    if (status /= FUGE_DONE) return
    call find_support_forces(held, support_forces, status, held%body%displacement)
    if (status /= FUGE_DONE) return
    load = 0.0_dp
    if (allocated(held%body%load)) load = held%body%load
    load = load - support_forces
    where (held%constrained) load = 0.0_dp
  end subroutine set_loads

  !> The forces (degrees) that displace the supports alone by `displacement` (fixed), by default not at all. `status` is
  !> not FUGE_DONE without memory.
  subroutine find_support_forces(held, forces, status, displacement)
    type(held_body), intent(in) :: held
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
    call add_supports(held, prescribed, displacement)
    call held%stiffness%multiply(prescribed, forces, magnitude)
  end subroutine find_support_forces

  !> Add the displacements of the supports, if there are any, to `u` (degrees).
  pure subroutine add_supports(held, u, displacement)
    type(held_body), intent(in) :: held
    real(dp), intent(inout) :: u(:)
    real(dp), intent(in), optional :: displacement(:)

    if (.not. present(displacement)) return
    if (size(displacement) > 0) u(held%body%fixed) = u(held%body%fixed) + displacement
  end subroutine add_supports

  !> Add the displacements by the motions q to `u` (degrees), and leave out those modes that no contact resists. Error:
  !> FUGE_ERR_MEMORY.
  subroutine add_motions(held, motion, u, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: motion(:)
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, stat

    do j = 1, size(held%rigid_modes, 2)
      u = u + held%rigid_modes(:, j)*motion(j)
    end do
    if (.not. allocated(held%unresisted_modes)) return
    call remove_motions(held%unresisted_modes, held%scale, u, stat)
    call require_memory(stat, 'the displacements', info)
  end subroutine add_motions

  !> The residual of K u = forces, with K itself and not its factor, as info%residual; a warning if it is large. `load`
  !> (degrees) external, `force` (n) of the contact.
  subroutine find_residual(held, load, force, u, info)
    type(held_body), intent(in) :: held
    real(dp), intent(in) :: load(:), force(:), u(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: forces(:), residual(:), product(:), magnitude(:)
    integer :: stat

    allocate (forces(size(u)), residual(size(u)), product(size(u)), magnitude(size(u)), stat=stat)
    call require_memory(stat, 'the residual', info)
    if (stat /= 0) return
    forces = 0.0_dp
    call add_contact_forces(held%body, force, forces)
    call held%stiffness%multiply(u, product, magnitude)
    residual = product - forces - load
    magnitude = magnitude + abs(forces) + abs(load)
    call unscale(residual, held%scale)
    call unscale(magnitude, held%scale)
    if (.not. maxval(magnitude) > 0.0_dp) return
    info%residual = maxval(abs(residual))/maxval(magnitude)
    if (info%residual > RESIDUAL_TOLERANCE) call report(info, FUGE_WARN_RESIDUAL, &
      'the displacements leave degree of freedom '//index_text(maxloc(abs(residual), 1))//' out of balance by ' &
      //text(info%residual)//' of the largest force')
  end subroutine find_residual

  !> Move all components without a copy.
  subroutine move_held(source, destination)
    type(held_body), intent(inout) :: source, destination

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
  end subroutine move_held

end module fuge_held_body
