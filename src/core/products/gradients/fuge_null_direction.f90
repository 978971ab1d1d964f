!> Search directions whose forces store no energy, because the operator is singular.
!>
!> Where the forces of a contact set can change along such a direction, the residual cannot: if it works on them,
!> nothing on this set can stop them. Either some force leaves its range, and its point the set, or none does, and the
!> contact problem has no solution (Farkas' lemma, for a convex quadratic program).
module fuge_null_direction
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: contact_segments, max_abs_over
  use fuge_contact_set, only: contact_set
  use fuge_iterate_lengths, only: iterate_lengths
  use fuge_iterate_pass, only: iterate_pass
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

  !> Note the largest displacement by forces of size 1, gradients%softness; gradients%work is the displacement by the
  !> search direction. The first direction may be one that displaces nothing: then from the terms of its displacement,
  !> which the operator of a grid or a matrix knows, and for operators without a grid also from a product with one force
  !> and from the `displacement` (n) by the `force` (n) so far. Errors: FUGE_ERR_MEMORY, those of the operator.
  subroutine find_softness(operator, scene, segments, force, displacement, gradients, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: force(:), displacement(:)
    type(conjugate_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest
    real(dp), allocatable :: terms(:), unit(:)
    integer :: stat

    largest = max_abs_over(segments, gradients%direction)
    if (.not. largest > 0.0_dp) return
    if (.not. gradients%softness > 0.0_dp) then
      allocate (terms(size(gradients%work)), unit(size(gradients%work)), stat=stat)
      call require_memory(stat, 'the displacements of', size(gradients%work), 'points', info)
      call scene%rows%agree(info)
      if (info%failed()) return
      call operator%magnitude(gradients%direction, gradients%work, terms)
      gradients%softness = segments%space%largest(maxval(terms))/largest
      if (.not. all(operator%grid() > 0)) then
        unit = 0.0_dp
        unit(segments%first(1)) = 1.0_dp
        call compute_displacement(operator, scene%counts_datum(), unit, terms, info)
        if (.not. info%failed()) gradients%softness = max(gradients%softness, maxval(abs(terms)), &
                                                          softness_so_far(scene, force, displacement))
      end if
    end if
    gradients%softness = max(gradients%softness, largest_work(segments, gradients)/largest)
  end subroutine find_softness

  !> The largest magnitude of the displacements gradients%work, at all points.
  function largest_work(segments, gradients) result(largest)
    type(contact_segments), intent(in), target :: segments
    type(conjugate_gradients), intent(in), target :: gradients
    real(dp) :: largest
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%gradients => gradients
    call pass%go(find_largest_work, size(gradients%work), 0, found)
    largest = segments%space%largest(found(1))
  end function largest_work

  !> Found: the largest magnitude of a displacement.
  subroutine find_largest_work(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)

    if (k > 0) found(1) = maxval(abs(pass%gradients%work(first:last)))
  end subroutine find_largest_work

  !> The largest displacement over the largest force; 0 without forces, or where displacements include rigid ones.
  function softness_so_far(scene, force, displacement) result(softness)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp) :: softness
    real(dp) :: largest(2)

    softness = 0.0_dp
    if (allocated(scene%modes)) return
    largest = [maxval(abs(force)), maxval(abs(displacement))]
    call scene%rows%raise(largest)
    if (largest(1) > 0.0_dp) softness = largest(2)/largest(1)
  end function softness_so_far

  !> Is the energy `curvature` of the search direction no more than rounding?
  function stores_no_energy(segments, gradients, curvature) result(none)
    type(contact_segments), intent(in) :: segments
    type(conjugate_gradients), intent(in) :: gradients
    real(dp), intent(in) :: curvature
    logical :: none

    none = abs(curvature) <= ROUNDINGS*epsilon(curvature)*largest_energy(segments, gradients)
  end function stores_no_energy

  !> The energy that forces as large as those of the search direction could store, after `find_softness`.
  function largest_energy(segments, gradients) result(energy)
    type(contact_segments), intent(in) :: segments
    type(conjugate_gradients), intent(in) :: gradients
    real(dp) :: energy

    energy = gradients%softness*max_abs_over(segments, gradients%direction)*total_force(segments, gradients)
  end function largest_energy

  !> The sum of the magnitudes of the forces of the search direction.
  function total_force(segments, gradients) result(total)
    type(contact_segments), intent(in), target :: segments
    type(conjugate_gradients), intent(in), target :: gradients
    real(dp) :: total
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%segments => segments
    pass%gradients => gradients
    call pass%go(sum_magnitudes, size(gradients%direction), 1, found)
    total = segments%space%total(found(1))
  end function total_force

  !> Found: the sum of the magnitudes of the forces of the search direction.
  subroutine sum_magnitudes(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (last < first) return
    associate (segments => pass%segments)
      do i = segments%before(k) + 1, segments%before(k + 1)
        found(1) = found(1) + sum(abs(pass%gradients%direction(segments%first(i):segments%last(i))))
      end do
    end associate
  end subroutine sum_magnitudes

  !> How far the force of point `k` is from the end of its range, negative beyond it, on the way along `change`; huge if
  !> it has no end there.
  pure function distance_to_end(scene, set, k, change) result(distance)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    integer, intent(in) :: k
    real(dp), intent(in) :: change
    real(dp) :: distance
    real(dp) :: least, most
    logical :: at_upper

    at_upper = .false.
    if (allocated(set%at_upper)) at_upper = set%at_upper(k)
    call scene%find_range(k, at_upper, least, most)
    distance = huge(distance)
    if (change > 0.0_dp .and. most < huge(most)) distance = most - set%force(k)
    if (change < 0.0_dp .and. least > -huge(least)) distance = set%force(k) - least
  end function distance_to_end

  !> Go from the forces at the start against the search direction, which stores no energy, until a force has left its
  !> range, unless one has already; gradients%unbounded if none ever does. Not where the direction does no work beyond
  !> rounding: `energy` is its work for a step of 1, and the mean residual in it is at most `tolerance` times the
  !> lengths of the scene.
  subroutine leave_null_direction(scene, tolerance, energy, lengths, set, gradients)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: tolerance, energy
    type(iterate_lengths), intent(in) :: lengths
    type(contact_set), intent(inout) :: set
    type(conjugate_gradients), intent(inout) :: gradients
    real(dp) :: change, distance, largest, least, length, step_length
    logical :: stays
    integer :: k

    length = tolerance*length_of(scene, lengths, set, gradients) + lengths%rounding
    if (energy <= length*total_force(set%segments, gradients)) return
    gradients%unbounded = .true.
    stays = .false.
    ! The forces have grown on the way to this direction.
    if (allocated(gradients%start)) set%force = gradients%start
    largest = max_abs_over(set%segments, gradients%direction)
    least = NO_FORCE*largest
    step_length = huge(step_length)
    do k = 1, size(set%contact)
      change = merge(-gradients%direction(k), 0.0_dp, set%contact(k))
      if (.not. abs(change) > least) cycle
      distance = distance_to_end(scene, set, k, change)
      if (.not. distance < huge(distance)) cycle
      gradients%unbounded = .false.
      stays = stays .or. distance < -set%tension_noise
      step_length = min(step_length, max(distance, 0.0_dp)/abs(change))
    end do
    associate (space => scene%rows%point_space)
      gradients%unbounded = space%everywhere(gradients%unbounded)
      step_length = space%least(step_length)
      stays = space%anywhere(stays)
    end associate
    if (gradients%unbounded .or. stays) return
    step_length = step_length + BEYOND*force_scale(scene, lengths, set, gradients)/largest
    set%force = set%force - step_length*gradients%direction
  end subroutine leave_null_direction

  !> The largest of gaps, plays and displacements by the resultants. Not of the displacements by the forces, which may
  !> already have grown.
  function length_of(scene, lengths, set, gradients) result(length)
    type(contact_scene), intent(in) :: scene
    type(iterate_lengths), intent(in) :: lengths
    type(contact_set), intent(in) :: set
    type(conjugate_gradients), intent(in) :: gradients
    real(dp) :: length

    length = maxval(abs(scene%gap), mask=set%contact)
    if (allocated(scene%play)) length = max(length, maxval(scene%play, mask=set%contact .and. set%at_upper))
    if (allocated(scene%balance)) length = max(length, gradients%softness*maxval(abs(scene%balance)))
    length = scene%rows%largest(length)
    ! Under a load the forces do not grow together.
    if (.not. scene%prescribed) length = max(length, lengths%least_magnitude)
  end function length_of

  !> The size of the forces, or of those that would close the gaps.
  function force_scale(scene, lengths, set, gradients) result(force)
    type(contact_scene), intent(in) :: scene
    type(iterate_lengths), intent(in) :: lengths
    type(contact_set), intent(in) :: set
    type(conjugate_gradients), intent(in) :: gradients
    real(dp) :: force

    force = scene%rows%largest(maxval(abs(set%force)))
    if (.not. force > 0.0_dp .and. gradients%softness > 0.0_dp) then
      force = length_of(scene, lengths, set, gradients)/gradients%softness
    end if
  end function force_scale

end module fuge_null_direction
