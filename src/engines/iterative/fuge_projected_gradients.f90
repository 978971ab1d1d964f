!> Preconditioned conjugate gradients on a given contact set: forces change there only,
!> their sum stays, and all gaps of the set become equal.
module fuge_projected_gradients
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_operator_products, only: multiply
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  use fuge_contact_segments, only: stretches, total, inner, largest
  use fuge_number_text, only: text
  implicit none
  private

  public :: relax, measure, deflect, make_iterate, open_gap

  !> Errors of the forces below this part of the worst tension, or of the gaps below
  !> this part of the worst penetration, let the set be judged.
  real(dp), parameter :: ENOUGH = 0.2_dp
  !> Exact conjugate gradients need as many iterations as there are points; rounded ones
  !> several times as many where alpha is badly conditioned.
  integer, parameter :: ITERATIONS_PER_POINT = 10
  integer, parameter :: SPARE_ITERATIONS = 20
  !> And never more than these: then the operator needs a preconditioner.
  integer, parameter :: MOST_ITERATIONS = 20000
  !> A negative energy below this part of its terms is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp

  !> Forces as parts of the load, so that lengths are per load.
  type, public :: iterate
    !> Forces, (n), their sum is 1 unless held.
    real(dp), allocatable :: force(:)
    !> Displacements by them, (n); without the datum of the operator unless held.
    real(dp), allocatable :: displacement(:)
    !> Points taken for touching, (n).
    logical, allocatable :: contact(:)
    !> The rigid motion is prescribed and already in the gaps, so that forces are what
    !> they are; else they are parts of the load.
    logical :: held = .false.
    !> Mean over the contact of gap plus displacement: the rigid motion; 0 if held.
    real(dp) :: motion = 0.0_dp
    !> Largest difference from `motion` on the contact.
    real(dp) :: residual = huge(1.0_dp)
    !> The deepest that an open point is pressed in.
    real(dp) :: penetration = 0.0_dp
    !> Least length of a contact point as in the certificate: its depth and the terms of
    !> its displacement. Residuals are compared with it.
    real(dp) :: least_length = 0.0_dp
    !> The stretches of the set, made by `relax` and `measure`.
    type(stretches) :: over = stretches()
    !> Differences of the gaps from their mean and the direction of the next step, (n),
    !> zero off the contact.
    real(dp), allocatable, private :: remainder(:), direction(:)
    !> In turn what the preconditioner makes of `remainder` and the product with `direction`, (n).
    real(dp), allocatable, private :: work(:)
  end type iterate

contains

  !> Allocate all arrays for n points. Error: FUGE_ERR_MEMORY.
  pure subroutine make_iterate(state, n, info)
    type(iterate), intent(inout) :: state
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (state%force(n), state%displacement(n), state%contact(n), state%remainder(n), state%direction(n), &
              state%work(n), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the work space of '//text(n)//' points')
  end subroutine make_iterate

  !> Go towards the forces for which the gaps of the contact set are equal.
  !>
  !> `reduced_gap` (n) gaps per load; `state` forces, displacements and set, new forces and
  !> displacements on return (the latter by recurrence). Ends when the residual is at
  !> most `tolerance` times the least length of the set, which is `reached`; unless
  !> `thorough`, when it is small enough to tell which points pull and which penetrate;
  !> or when only rounding is left, or too many iterations have been made. Errors: those of the
  !> operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY.
  subroutine relax(operator, preconditioner, reduced_gap, tolerance, thorough, state, reached, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_preconditioner), intent(inout) :: preconditioner
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: thorough
    type(iterate), intent(inout) :: state
    logical, intent(out) :: reached
    type(fuge_info), intent(inout) :: info
    real(dp) :: drift, tension, product, previous, curvature, step
    integer :: iteration, limit
    logical :: judges_forces, preconditioned

    reached = .false.
    preconditioned = operator%has_preconditioner()
    judges_forces = preconditioned .and. .not. thorough
    call measure(operator, reduced_gap, state, info)
    if (info%failed()) return
    limit = min(ITERATIONS_PER_POINT*min(state%over%points, MOST_ITERATIONS) + SPARE_ITERATIONS, MOST_ITERATIONS)
    state%direction = 0.0_dp
    previous = 1.0_dp
    do iteration = 0, limit
      reached = state%residual <= tolerance*state%least_length
      if (reached .or. iteration == limit) return
      if (iteration > 0 .and. .not. thorough .and. state%residual <= ENOUGH*state%penetration) return
      call preconditioner%apply(operator, state%over, .not. state%held, state%remainder, state%work, info)
      if (info%failed()) return
      if (iteration > 0 .and. judges_forces) then
        call estimate(state, drift, tension)
        if (drift <= ENOUGH*tension) return
      end if
      product = inner(state%over, state%remainder, state%work)
      if (.not. product > 0.0_dp) then
        call explain_preconditioner(state, product, info)
        return
      end if
      call turn(state%over, product/previous, state%work, state%direction)
      previous = product
      call deflect(operator, state%held, state%direction, state%work, info)
      if (info%failed()) return
      curvature = inner(state%over, state%direction, state%work)
      if (.not. curvature > 0.0_dp) then
        call explain(state, curvature, info)
        return
      end if
      step = product/curvature
      call advance(reduced_gap, step, state)
      if (.not. (thorough .or. preconditioned)) then
        ! Without a preconditioner the last step stands for the error of the forces.
        drift = step*largest(state%over, state%direction)
        tension = -minval(state%force)
        if (drift <= ENOUGH*tension) return
      end if
    end do
  end subroutine relax

  !> Motion, residual, penetration and least length of the present forces and
  !> displacements. Error: FUGE_ERR_MEMORY.
  subroutine measure(operator, reduced_gap, state, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous :: reduced_gap(:)
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp) :: sunk

    call state%over%find(state%contact, info)
    if (info%failed()) return
    state%remainder = 0.0_dp
    where (state%contact) state%remainder = reduced_gap + state%displacement
    state%motion = 0.0_dp
    call centre(state)
    ! The mean of large numbers is not exact: once more for what is left of it.
    call centre(state)
    state%penetration = worst_penetration(reduced_gap, state)
    call operator%magnitude(state%force, state%displacement, state%work)
    sunk = -state%motion
    if (state%held) sunk = operator%datum()*sum(state%force)
    state%least_length = least_length(state, sunk, reduced_gap, state%work)
  end subroutine measure

  !> As in the certificate: what the displacement less the datum has to make up for, and
  !> its terms.
  pure function least_length(state, sunk, reduced_gap, terms) result(least)
    type(iterate), intent(in) :: state
    real(dp), intent(in) :: sunk
    real(dp), intent(in), contiguous :: reduced_gap(:), terms(:)
    real(dp) :: least
    integer :: i, k

    least = maxval(abs(reduced_gap))
    if (state%over%points > 0) least = huge(least)
    do i = 1, size(state%over%first)
      do k = state%over%first(i), state%over%last(i)
        least = min(least, abs(reduced_gap(k) + sunk) + terms(k))
      end do
    end do
  end function least_length

  !> Displacements by forces; with the datum of the operator if nothing takes it up.
  !> Errors: those of the operator.
  subroutine deflect(operator, held, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: held
    real(dp), intent(in), contiguous :: force(:)
    real(dp), intent(inout), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info

    call multiply(operator, force, displacement, info)
    if (held .and. .not. info%failed()) displacement = displacement + operator%datum()*sum(force)
  end subroutine deflect

  !> direction = correction + factor*direction on the contact.
  pure subroutine turn(over, factor, correction, direction)
    type(stretches), intent(in) :: over
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: correction(:)
    real(dp), intent(inout), contiguous :: direction(:)
    integer :: i, k

    do i = 1, size(over%first)
      do k = over%first(i), over%last(i)
        direction(k) = correction(k) + factor*direction(k)
      end do
    end do
  end subroutine turn

  !> One step along the direction.
  pure subroutine advance(reduced_gap, step, state)
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(in) :: step
    type(iterate), intent(inout) :: state
    real(dp) :: mean

    mean = 0.0_dp
    if (.not. state%held) mean = total(state%over, state%work)/real(state%over%points, dp)
    state%displacement = state%displacement - step*state%work
    call move(state%over, step, mean, state%direction, state%work, state%force, state%remainder)
    state%motion = state%motion - step*mean
    call centre(state)
    state%penetration = worst_penetration(reduced_gap, state)
  end subroutine advance

  pure subroutine move(over, step, mean, direction, image, force, remainder)
    type(stretches), intent(in) :: over
    real(dp), intent(in) :: step, mean
    real(dp), intent(in), contiguous :: direction(:), image(:)
    real(dp), intent(inout), contiguous :: force(:), remainder(:)
    integer :: i, k

    do i = 1, size(over%first)
      do k = over%first(i), over%last(i)
        force(k) = force(k) - step*direction(k)
        remainder(k) = remainder(k) - step*(image(k) - mean)
      end do
    end do
  end subroutine move

  !> Keep the mean of the remainder zero: its rounding would grow and drown the rest.
  pure subroutine centre(state)
    type(iterate), intent(inout) :: state
    real(dp) :: mean
    integer :: i

    mean = 0.0_dp
    if (.not. state%held) mean = total(state%over, state%remainder)/real(state%over%points, dp)
    associate (over => state%over)
      do i = 1, size(over%first)
        state%remainder(over%first(i):over%last(i)) = state%remainder(over%first(i):over%last(i)) - mean
      end do
    end associate
    state%motion = state%motion + mean
    state%residual = largest(state%over, state%remainder)
  end subroutine centre

  !> The deepest that an open point is pressed in, 0 if none is.
  pure function worst_penetration(reduced_gap, state) result(depth)
    real(dp), intent(in), contiguous :: reduced_gap(:)
    type(iterate), intent(in) :: state
    real(dp) :: depth
    integer :: i, first, last

    depth = 0.0_dp
    do i = 0, size(state%over%first)
      first = 1
      last = size(reduced_gap)
      if (i > 0) first = state%over%last(i) + 1
      if (i < size(state%over%first)) last = state%over%first(i + 1) - 1
      if (first <= last) depth = max(depth, depth_between(reduced_gap(first:last), state%displacement(first:last), &
                                                          state%motion))
    end do
  end function worst_penetration

  pure function depth_between(reduced_gap, displacement, motion) result(depth)
    real(dp), intent(in), contiguous :: reduced_gap(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp) :: depth
    integer :: k

    depth = 0.0_dp
    do k = 1, size(reduced_gap)
      depth = max(depth, -open_gap(reduced_gap(k), displacement(k), motion))
    end do
  end function depth_between

  !> How far the forces still are from those wanted, and how strongly those pull.
  pure subroutine estimate(state, drift, tension)
    type(iterate), intent(in) :: state
    real(dp), intent(out) :: drift, tension
    integer :: i, k

    drift = 0.0_dp
    tension = 0.0_dp
    do i = 1, size(state%over%first)
      do k = state%over%first(i), state%over%last(i)
        drift = max(drift, abs(state%work(k)))
        tension = max(tension, state%work(k) - state%force(k))
      end do
    end do
  end subroutine estimate

  !> Gap of a point, per load; where the set is right none is negative.
  elemental function open_gap(reduced_gap, displacement, motion) result(gap)
    real(dp), intent(in) :: reduced_gap, displacement, motion
    real(dp) :: gap

    gap = (reduced_gap - motion) + displacement
  end function open_gap

  !> No energy in the remainder: nothing is left but rounding, or the preconditioner is not
  !> positive definite.
  pure subroutine explain_preconditioner(state, product, info)
    type(iterate), intent(in) :: state
    real(dp), intent(in) :: product
    type(fuge_info), intent(inout) :: info

    if (product >= -ROUNDING*largest(state%over, state%remainder)*largest(state%over, state%work)) return
    call report(info, FUGE_ERR_NOT_DEFINITE, &
                'preconditioner '//text(info%preconditionings)//': lengths with the negative energy ' &
                //text(product)//': the preconditioner of the operator is not positive definite')
  end subroutine explain_preconditioner

  !> No energy in a direction: rounding, or an operator that is not positive definite.
  pure subroutine explain(state, curvature, info)
    type(iterate), intent(in) :: state
    real(dp), intent(in) :: curvature
    type(fuge_info), intent(inout) :: info
    real(dp) :: length, force

    ! Where the operator is singular the image is nothing but rounding of displacements.
    length = max(maxval(abs(state%displacement)), largest(state%over, state%work))
    force = largest(state%over, state%direction)
    if (curvature >= -ROUNDING*length*force*max(1.0_dp, real(state%over%points, dp)*force)) return
    call report(info, FUGE_ERR_NOT_DEFINITE, 'product '//text(info%products)//': forces on the contact store the ' &
                //'negative energy '//text(0.5_dp*curvature)//': the operator is not positive definite')
  end subroutine explain

end module fuge_projected_gradients
