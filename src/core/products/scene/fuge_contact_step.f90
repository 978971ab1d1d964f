!> The step of the conjugate gradients on a contact set, and the deepest penetration.
!>
!> Large arrays do not stay in the cache from one iteration to the next, so that reading them takes longer than the
!> arithmetic: all that a step changes and measures is done in one pass over the points.
module fuge_contact_step
  use fuge_contact_segments, only: contact_segments
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass
  implicit none
  private

  public :: deepest_penetration, step_over

  !> Number of partial sums and maxima: several are faster, and the sums more exact, than one.
  integer, parameter :: LANES = 4

  !> The step on several chunks, or without `force` the deepest penetration.
  type, extends(chunked_pass) :: step_pass
    type(contact_segments), pointer :: segments => null()
    real(dp) :: step_length = 0.0_dp, shift = 0.0_dp, motion = 0.0_dp
    real(dp), pointer, contiguous :: reduced_gap(:) => null(), direction(:) => null(), image(:) => null(), &
      force(:) => null(), displacement(:) => null(), residual(:) => null()
  contains
    procedure :: do_chunk
  end type step_pass

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
    real(dp) :: extremes(2), found(3)

    if (segments%are_in_one_chunk()) then
      call step_points(segments, 1, size(segments%first), 1, size(reduced_gap), step_length, shift, reduced_gap, &
                       motion, direction, image, force, displacement, residual, found)
    else
      call share_step(segments, step_length, shift, reduced_gap, motion, direction, image, force, displacement, &
                      residual, found)
    end if
    total = segments%space%total(found(1))
    extremes = found(2:)
    call segments%space%raise(extremes)
    largest = extremes(1)
    penetration = extremes(2)
  end subroutine step_over

  !> As `step_over`, on several chunks; `found` as for `step_points`. The arguments are those of the step.
  subroutine share_step(segments, step_length, shift, reduced_gap, motion, direction, image, force, displacement, &
                        residual, found)
    type(contact_segments), intent(in), target :: segments
    real(dp), intent(in) :: step_length, shift, motion
    real(dp), intent(in), contiguous, target :: reduced_gap(:), direction(:), image(:)
    real(dp), intent(inout), contiguous, target :: force(:), displacement(:), residual(:)
    real(dp), intent(out) :: found(3)
    type(step_pass) :: pass

    pass%segments => segments
    pass%step_length = step_length
    pass%shift = shift
    pass%motion = motion
    pass%reduced_gap => reduced_gap
    pass%direction => direction
    pass%image => image
    pass%force => force
    pass%displacement => displacement
    pass%residual => residual
    call pass%run(size(reduced_gap), 3)
    found = [pass%total(1), pass%largest(2), pass%largest(3)]
  end subroutine share_step

  !> The step of a chunk, or its deepest penetration.
  subroutine do_chunk(self, k, first, last)
    class(step_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    associate (a => self%segments%before(k) + 1, b => self%segments%before(k + 1))
      if (associated(self%force)) then
        call step_points(self%segments, a, b, first, last, self%step_length, self%shift, self%reduced_gap, &
                         self%motion, self%direction, self%image, self%force, self%displacement, self%residual, &
                         self%found(:, k))
      else
        self%found(1, k) = depth_of_points(self%segments, a, b, first, last, self%reduced_gap, self%motion, &
                                           self%displacement)
      end if
    end associate
  end subroutine do_chunk

  !> The step of the points `begin` .. `finish`, with the segments `from` .. `to` among them. `found`: the sum and the
  !> largest magnitude of the new residuals, and the deepest penetration. The arguments are those of the step.
  pure subroutine step_points(segments, from, to, begin, finish, step_length, shift, reduced_gap, motion, direction, &
                              image, force, displacement, residual, found)
    type(contact_segments), intent(in) :: segments
    integer, intent(in) :: from, to, begin, finish
    real(dp), intent(in) :: step_length, shift, motion
    real(dp), intent(in), contiguous :: reduced_gap(:), direction(:), image(:)
    real(dp), intent(inout), contiguous :: force(:), displacement(:), residual(:)
    real(dp), intent(out) :: found(3)
    real(dp) :: totals(LANES), magnitudes(LANES), least_gaps(LANES)
    integer :: first, i, last

    totals = 0.0_dp
    magnitudes = 0.0_dp
    least_gaps = 0.0_dp
    last = begin - 1
    do i = from, to
      first = segments%first(i)
      call move_open_points(last + 1, first - 1, step_length, reduced_gap, motion, image, displacement, least_gaps)
      last = segments%last(i)
      call move_contact_points(first, last, step_length, shift, direction, image, force, displacement, residual, &
                               totals, magnitudes)
    end do
    call move_open_points(last + 1, finish, step_length, reduced_gap, motion, image, displacement, least_gaps)
    found = [sum(totals), maxval(magnitudes), max(0.0_dp, -minval(least_gaps))]
  end subroutine step_points

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

    if (segments%are_in_one_chunk()) then
      depth = depth_of_points(segments, 1, size(segments%first), 1, size(reduced_gap), reduced_gap, motion, &
                              displacement)
    else
      depth = shared_depth(segments, reduced_gap, motion, displacement)
    end if
    depth = segments%space%largest(depth)
  end function deepest_penetration

  !> As `deepest_penetration`, on several chunks.
  function shared_depth(segments, reduced_gap, motion, displacement) result(depth)
    type(contact_segments), intent(in), target :: segments
    real(dp), intent(in), contiguous, target :: reduced_gap(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp) :: depth
    type(step_pass) :: pass

    pass%segments => segments
    pass%motion = motion
    pass%reduced_gap => reduced_gap
    pass%displacement => displacement
    call pass%run(size(reduced_gap), 1)
    depth = pass%largest(1)
  end function shared_depth

  !> The deepest penetration of the points `begin` .. `finish`, with the segments `from` .. `to` among them.
  pure function depth_of_points(segments, from, to, begin, finish, reduced_gap, motion, displacement) result(depth)
    type(contact_segments), intent(in) :: segments
    integer, intent(in) :: from, to, begin, finish
    real(dp), intent(in), contiguous :: reduced_gap(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp) :: depth
    real(dp) :: deepest(LANES)
    integer :: i, last

    deepest = 0.0_dp
    last = begin - 1
    do i = from, to
      call deepen(last + 1, segments%first(i) - 1, reduced_gap, motion, displacement, deepest)
      last = segments%last(i)
    end do
    call deepen(last + 1, finish, reduced_gap, motion, displacement, deepest)
    depth = maxval(deepest)
  end function depth_of_points

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
