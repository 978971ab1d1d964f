!> Search directions whose forces store no energy, because the operator is singular.
!>
!> Where the forces of a contact set can change along such a direction, the residual cannot: if it works on them,
!> nothing on this set can stop them. Either some force leaves its range, and its point the set, or none does, and the
!> contact problem has no solution (Farkas' lemma, for a convex quadratic program).
module fuge_null_direction
  use fuge_contact_iterate, only: compute_displacement, contact_iterate, iterate_pass
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: max_abs_over
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: find_softness, largest_energy, leave_null_direction, softness_so_far, stores_no_energy

  !> An energy below this many units in the last place of its terms counts as zero.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  !> Forces of a direction below this fraction of its largest one come from other directions.
  real(dp), parameter :: NO_FORCE = 1.0e-4_dp
  !> A step along the direction goes beyond the first end of a range by this fraction of the largest force.
  real(dp), parameter :: BEYOND = 1.0e-3_dp

contains

  !> Note the largest displacement by forces of size 1, iterate%softness; iterate%work is the displacement by the search
  !> direction. The first direction may be one that displaces nothing: then from the terms of its displacement, which
  !> the operator of a grid or a matrix knows, and for operators without a grid also from a product with one force and
  !> from the displacements so far. Errors: FUGE_ERR_MEMORY, those of the operator.
  subroutine find_softness(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: force
    real(dp), allocatable :: terms(:), unit(:)
    integer :: stat

    force = max_abs_over(iterate%segments, iterate%direction)
    if (.not. force > 0.0_dp) return
    if (.not. iterate%softness > 0.0_dp) then
      allocate (terms(size(iterate%work)), unit(size(iterate%work)), stat=stat)
      call require_memory(stat, 'the displacements of', size(iterate%work), 'points', info)
      call scene%rows%agree(info)
      if (info%failed()) return
      call operator%magnitude(iterate%direction, iterate%work, terms)
      iterate%softness = iterate%segments%space%largest(maxval(terms))/force
      if (.not. all(operator%grid() > 0)) then
        unit = 0.0_dp
        unit(iterate%segments%first(1)) = 1.0_dp
        call compute_displacement(operator, scene%counts_datum(), unit, terms, info)
        if (.not. info%failed()) iterate%softness = max(iterate%softness, maxval(abs(terms)), &
                                                        softness_so_far(scene, iterate))
      end if
    end if
    iterate%softness = max(iterate%softness, largest_work(iterate)/force)
  end subroutine find_softness

  !> The largest magnitude of the displacements iterate%work, at all points.
  function largest_work(iterate) result(largest)
    type(contact_iterate), intent(in), target :: iterate
    real(dp) :: largest
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%iterate => iterate
    call pass%go(find_largest_work, 0, found)
    largest = iterate%segments%space%largest(found(1))
  end function largest_work

  !> Found: the largest magnitude of a displacement.
  subroutine find_largest_work(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)

    if (k > 0) found(1) = maxval(abs(pass%iterate%work(first:last)))
  end subroutine find_largest_work

  !> The largest displacement over the largest force; 0 without forces, or where displacements include rigid ones.
  function softness_so_far(scene, iterate) result(softness)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: softness
    real(dp) :: largest(2)

    softness = 0.0_dp
    if (allocated(scene%modes) .or. .not. allocated(iterate%displacement)) return
    largest = [maxval(abs(iterate%force)), maxval(abs(iterate%displacement))]
    call scene%rows%raise(largest)
    if (largest(1) > 0.0_dp) softness = largest(2)/largest(1)
  end function softness_so_far

  !> Is the energy `curvature` of the search direction no more than rounding?
  function stores_no_energy(iterate, curvature) result(none)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: curvature
    logical :: none

    none = abs(curvature) <= ROUNDINGS*epsilon(curvature)*largest_energy(iterate)
  end function stores_no_energy

  !> The energy that forces as large as those of the search direction could store, after `find_softness`.
  function largest_energy(iterate) result(energy)
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: energy

    energy = iterate%softness*max_abs_over(iterate%segments, iterate%direction)*total_force(iterate)
  end function largest_energy

  !> The sum of the magnitudes of the forces of the search direction.
  function total_force(iterate) result(total)
    type(contact_iterate), intent(in), target :: iterate
    real(dp) :: total
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%iterate => iterate
    call pass%go(sum_magnitudes, 1, found)
    total = iterate%segments%space%total(found(1))
  end function total_force

  !> Found: the sum of the magnitudes of the forces of the search direction.
  subroutine sum_magnitudes(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (last < first) return
    associate (segments => pass%iterate%segments)
      do i = segments%before(k) + 1, segments%before(k + 1)
        found(1) = found(1) + sum(abs(pass%iterate%direction(segments%first(i):segments%last(i))))
      end do
    end associate
  end subroutine sum_magnitudes

  !> How far the force of point `k` is from the end of its range, negative beyond it, on the way along `change`; huge if
  !> it has no end there.
  pure function distance_to_end(scene, iterate, k, change) result(distance)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    real(dp), intent(in) :: change
    real(dp) :: distance
    real(dp) :: least, most
    logical :: at_upper

    at_upper = .false.
    if (allocated(iterate%at_upper)) at_upper = iterate%at_upper(k)
    call scene%find_range(k, at_upper, least, most)
    distance = huge(distance)
    if (change > 0.0_dp .and. most < huge(most)) distance = most - iterate%force(k)
    if (change < 0.0_dp .and. least > -huge(least)) distance = iterate%force(k) - least
  end function distance_to_end

  !> Go from the forces at the start against the search direction, which stores no energy, until a force has left its
  !> range, unless one has already; iterate%unbounded if none ever does. Not where the direction does no work beyond
  !> rounding: `energy` is its work for a step of 1, and the mean residual in it is at most `tolerance` times the
  !> lengths of the scene.
  subroutine leave_null_direction(scene, tolerance, energy, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance, energy
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: change, distance, least, step_length
    logical :: stays
    integer :: k

    if (energy <= (tolerance*length_of(scene, iterate) + iterate%rounding)*total_force(iterate)) return
    iterate%unbounded = .true.
    stays = .false.
    ! The forces have grown on the way to this direction.
    if (allocated(iterate%start)) iterate%force = iterate%start
    least = NO_FORCE*max_abs_over(iterate%segments, iterate%direction)
    step_length = huge(step_length)
    do k = 1, size(iterate%contact)
      change = merge(-iterate%direction(k), 0.0_dp, iterate%contact(k))
      if (.not. abs(change) > least) cycle
      distance = distance_to_end(scene, iterate, k, change)
      if (.not. distance < huge(distance)) cycle
      iterate%unbounded = .false.
      stays = stays .or. distance < -iterate%tension_noise
      step_length = min(step_length, max(distance, 0.0_dp)/abs(change))
    end do
    associate (space => scene%rows%point_space)
      iterate%unbounded = space%everywhere(iterate%unbounded)
      step_length = space%least(step_length)
      stays = space%anywhere(stays)
    end associate
    if (iterate%unbounded .or. stays) return
    step_length = step_length + BEYOND*force_scale(scene, iterate)/max_abs_over(iterate%segments, iterate%direction)
    iterate%force = iterate%force - step_length*iterate%direction
  end subroutine leave_null_direction

  !> The largest of gaps, plays and displacements by the resultants. Not of the displacements by the forces, which may
  !> already have grown.
  function length_of(scene, iterate) result(length)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: length

    length = maxval(abs(scene%gap), mask=iterate%contact)
    if (allocated(scene%play)) length = max(length, maxval(scene%play, mask=iterate%contact .and. iterate%at_upper))
    if (allocated(scene%balance)) length = max(length, iterate%softness*maxval(abs(scene%balance)))
    length = scene%rows%largest(length)
    ! Under a load the forces do not grow together.
    if (.not. scene%prescribed) length = max(length, iterate%least_magnitude)
  end function length_of

  !> The size of the forces, or of those that would close the gaps.
  function force_scale(scene, iterate) result(force)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: force

    force = scene%rows%largest(maxval(abs(iterate%force)))
    if (.not. force > 0.0_dp .and. iterate%softness > 0.0_dp) force = length_of(scene, iterate)/iterate%softness
  end function force_scale

end module fuge_null_direction
