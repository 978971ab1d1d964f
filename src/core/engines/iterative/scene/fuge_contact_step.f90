!> The step of the conjugate gradients on a contact set, and the deepest penetration.
!>
!> Large arrays do not stay in the cache from one iteration to the next, so that reading them takes longer than the
!> arithmetic: all that a step changes and measures is done in one pass over the points.
module fuge_contact_step
  use fuge_contact_segments, only: contact_segments
  use fuge_kinds, only: dp
  implicit none
  private

  public :: deepest_penetration, step_over

  !> Number of partial sums and maxima: several are faster, and the sums more exact, than one.
  integer, parameter :: LANES = 4

contains

  !> Subtract `step_length` times the search direction from the forces, and update what follows from them.
  !>
  !> `direction` (n), force, zero off the set; `image` (n), length, the displacements by it; `force` (n) and
  !> `residual` (n), length, are changed on the set: the residuals by `shift` less their step;
  !> `displacement` (n) everywhere. `total` and `largest` are the sum and the largest magnitude of the new residuals,
  !> 0 without contact; `penetration` as deepest_penetration. The arguments are thirteen, because one pass over the
  !> points updates all that follows from the forces.
  subroutine step_over(segments, step_length, shift, reduced_gap, motion, direction, image, force, displacement, &
                            residual, total, largest, penetration)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: step_length, shift, motion
    real(dp), intent(in), contiguous :: reduced_gap(:), direction(:), image(:)
    real(dp), intent(inout), contiguous :: force(:), displacement(:), residual(:)
    real(dp), intent(out) :: total, largest, penetration
    real(dp) :: totals(LANES), magnitudes(LANES), least_gaps(LANES), extremes(2)
    integer :: i, first, last

    totals = 0.0_dp
    magnitudes = 0.0_dp
    least_gaps = 0.0_dp
    last = 0
    do i = 1, size(segments%first)
      first = segments%first(i)
      call move_open_points(last + 1, first - 1, step_length, reduced_gap, motion, image, displacement, least_gaps)
      last = segments%last(i)
      call move_contact_points(first, last, step_length, shift, direction, image, force, displacement, residual, &
                               totals, magnitudes)
    end do
    call move_open_points(last + 1, size(reduced_gap), step_length, reduced_gap, motion, image, displacement, &
                          least_gaps)
    total = segments%space%total(sum(totals))
    extremes = [maxval(magnitudes), max(0.0_dp, -minval(least_gaps))]
    call segments%space%raise(extremes)
    largest = extremes(1)
    penetration = extremes(2)
  end subroutine step_over

  !> The step of the displacements of the open points `first` .. `last`; `least_gaps` are lowered to their gaps.
  !> `image` (n) are the displacements by the search direction.
  pure subroutine move_open_points(first, last, step_length, reduced_gap, motion, image, displacement, least_gaps)
    integer, intent(in) :: first, last
    real(dp), intent(in) :: step_length, motion
    real(dp), intent(in), contiguous :: reduced_gap(:), image(:)
    real(dp), intent(inout), contiguous :: displacement(:)
    real(dp), intent(inout) :: least_gaps(LANES)
    real(dp) :: values(LANES)
    integer :: k

    do k = first, last - LANES + 1, LANES
      values = displacement(k:k + LANES - 1) - step_length*image(k:k + LANES - 1)
      displacement(k:k + LANES - 1) = values
      values = (reduced_gap(k:k + LANES - 1) - motion) + values
      least_gaps = merge(values, least_gaps, values < least_gaps)
    end do
    do k = last - modulo(last - first + 1, LANES) + 1, last
      displacement(k) = displacement(k) - step_length*image(k)
      least_gaps(1) = min(least_gaps(1), (reduced_gap(k) - motion) + displacement(k))
    end do
  end subroutine move_open_points

  !> The step of forces, displacements and residuals of the contact points `first` .. `last`; `totals` gain the
  !> residuals, `magnitudes` rise to their magnitudes. `image` (n) are the displacements by `direction` (n), of
  !> which the residuals get what exceeds `shift`. The arguments are eleven, because the arrays of the pass are
  !> contiguous only one by one.
  pure subroutine move_contact_points(first, last, step_length, shift, direction, image, force, displacement, &
                                      residual, totals, magnitudes)
    integer, intent(in) :: first, last
    real(dp), intent(in) :: step_length, shift
    real(dp), intent(in), contiguous :: direction(:), image(:)
    real(dp), intent(inout), contiguous :: force(:), displacement(:), residual(:)
    real(dp), intent(inout) :: totals(LANES), magnitudes(LANES)
    real(dp) :: values(LANES)
    integer :: k

    do k = first, last - LANES + 1, LANES
      force(k:k + LANES - 1) = force(k:k + LANES - 1) - step_length*direction(k:k + LANES - 1)
      values = step_length*image(k:k + LANES - 1)
      displacement(k:k + LANES - 1) = displacement(k:k + LANES - 1) - values
      values = residual(k:k + LANES - 1) - (values - shift)
      residual(k:k + LANES - 1) = values
      totals = totals + values
      values = abs(values)
      magnitudes = merge(values, magnitudes, values > magnitudes)
    end do
    do k = last - modulo(last - first + 1, LANES) + 1, last
      force(k) = force(k) - step_length*direction(k)
      displacement(k) = displacement(k) - step_length*image(k)
      residual(k) = residual(k) - (step_length*image(k) - shift)
      totals(1) = totals(1) + residual(k)
      magnitudes(1) = max(magnitudes(1), abs(residual(k)))
    end do
  end subroutine move_contact_points

  !> The deepest penetration of an open point, 0 if none penetrates; `reduced_gap` and `displacement` (n), less
  !> `motion`, are the gaps.
  function deepest_penetration(segments, reduced_gap, motion, displacement) result(depth)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: reduced_gap(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp) :: depth
    real(dp) :: deepest(LANES)
    integer :: i, last

    deepest = 0.0_dp
    last = 0
    do i = 1, size(segments%first)
      call deepen(last + 1, segments%first(i) - 1, reduced_gap, motion, displacement, deepest)
      last = segments%last(i)
    end do
    call deepen(last + 1, size(reduced_gap), reduced_gap, motion, displacement, deepest)
    depth = segments%space%largest(maxval(deepest))
  end function deepest_penetration

  !> Raise `deepest` to the penetrations of the points `first` .. `last`.
  pure subroutine deepen(first, last, reduced_gap, motion, displacement, deepest)
    integer, intent(in) :: first, last
    real(dp), intent(in), contiguous :: reduced_gap(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp), intent(inout) :: deepest(LANES)
    real(dp) :: depth(LANES)
    integer :: k

    do k = first, last - LANES + 1, LANES
      depth = (motion - reduced_gap(k:k + LANES - 1)) - displacement(k:k + LANES - 1)
      deepest = merge(depth, deepest, depth > deepest)
    end do
    do k = last - modulo(last - first + 1, LANES) + 1, last
      deepest(1) = max(deepest(1), (motion - reduced_gap(k)) - displacement(k))
    end do
  end subroutine deepen

end module fuge_contact_step
