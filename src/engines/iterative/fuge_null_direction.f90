!> Search directions whose forces store no energy, because the operator is singular.
!>
!> Where the forces of a contact set can change along such a direction, the residual cannot: if it works on them,
!> nothing on this set can stop them. Either some force changes its sign, and its point leaves the set, or none does, and
!> the contact problem has no solution (Farkas' lemma, for a convex quadratic program).
module fuge_null_direction
  use fuge_contact_iterate, only: compute_displacement, contact_iterate, counts_datum
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: max_abs_over
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: find_softness, leave_null_direction, stores_no_energy

  !> So many units in the last place of the terms of an energy are none.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  !> Forces of a direction below this fraction of its largest one are what it has of others.
  real(dp), parameter :: NO_FORCE = 1.0e-4_dp
  !> A step along the direction goes this far beyond the forces that there are.
  real(dp), parameter :: FAR = 1.0e5_dp

contains

  !> Note the largest displacement by forces of size 1, iterate%softness; iterate%work is the displacement by the search
  !> direction. The first direction may be one that displaces nothing: then from the terms of its displacement, which the
  !> operator of a grid knows, or for other operators from a product with one force. Errors: those of the operator.
  subroutine find_softness(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: force
    real(dp), allocatable :: terms(:), unit(:)

    force = max_abs_over(iterate%segments, iterate%direction)
    if (.not. force > 0.0_dp) return
    if (.not. iterate%softness > 0.0_dp) then
      allocate (terms(size(iterate%work)))
      if (all(operator%grid() > 0)) then
        call operator%magnitude(iterate%direction, iterate%work, terms)
        iterate%softness = maxval(terms)/force
      else
        allocate (unit(size(terms)))
        unit = 0.0_dp
        unit(iterate%segments%first(1)) = 1.0_dp
        call compute_displacement(operator, counts_datum(scene, iterate), unit, terms, info)
        if (.not. info%failed()) iterate%softness = maxval(abs(terms))
      end if
    end if
    iterate%softness = max(iterate%softness, maxval(abs(iterate%work))/force)
  end subroutine find_softness

  !> Is the energy `curvature` of the search direction no more than rounding?
  pure function stores_no_energy(iterate, curvature) result(none)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: curvature
    logical :: none
    real(dp) :: largest

    largest = max_abs_over(iterate%segments, iterate%direction)
    none = curvature <= ROUNDINGS*epsilon(largest)*iterate%softness*largest*total_force(iterate)
  end function stores_no_energy

  !> The sum of the magnitudes of the forces of the search direction.
  pure function total_force(iterate) result(total)
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: total
    integer :: i

    total = 0.0_dp
    do i = 1, size(iterate%segments%first)
      total = total + sum(abs(iterate%direction(iterate%segments%first(i):iterate%segments%last(i))))
    end do
  end function total_force

  !> May forces of the set go against the search direction for ever, because none of them changes its sign?
  pure function is_unbounded(scene, iterate) result(unbounded)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    logical :: unbounded
    real(dp) :: least, pull
    integer :: k

    unbounded = .true.
    least = NO_FORCE*max_abs_over(iterate%segments, iterate%direction)
    do k = 1, size(iterate%contact)
      if (.not. iterate%contact(k)) cycle
      pull = iterate%direction(k)
      if (allocated(iterate%at_upper)) pull = merge(-pull, pull, iterate%at_upper(k))
      if (pull > least .and. .not. scene%is_tied(k)) unbounded = .false.
    end do
  end function is_unbounded

  !> Go against the search direction, which stores no energy, so far that forces change their sign; iterate%unbounded if
  !> none does. Not where it does no work beyond rounding, `energy` being that for a step of 1: the mean residual is
  !> below `tolerance` times the lengths of the scene.
  pure subroutine leave_null_direction(scene, tolerance, energy, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance, energy
    type(contact_iterate), intent(inout) :: iterate

    if (energy <= (tolerance*length_of(scene, iterate) + iterate%rounding)*total_force(iterate)) return
    iterate%unbounded = is_unbounded(scene, iterate)
    if (.not. iterate%unbounded) iterate%force = iterate%force - step_along_null(scene, iterate)*iterate%direction
  end subroutine leave_null_direction

  !> The largest of gaps, plays and displacements by the resultants. Not of the displacements by the forces, which may
  !> already have grown.
  pure function length_of(scene, iterate) result(length)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: length

    length = maxval(abs(scene%gap), mask=iterate%contact)
    if (allocated(scene%play)) length = max(length, maxval(scene%play, mask=iterate%contact .and. iterate%at_upper))
    if (allocated(scene%balance)) length = max(length, iterate%softness*maxval(abs(scene%balance)))
  end function length_of

  !> The step after which the forces of the direction are large beside all others.
  pure function step_along_null(scene, iterate) result(step_length)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: step_length
    real(dp) :: force

    force = maxval(abs(iterate%force))
    if (iterate%softness > 0.0_dp) force = max(force, iterate%residual_norm/iterate%softness)
    if (allocated(scene%balance)) force = max(force, maxval(abs(scene%balance)))
    step_length = FAR*force/max(max_abs_over(iterate%segments, iterate%direction), tiny(force))
  end function step_along_null

end module fuge_null_direction
