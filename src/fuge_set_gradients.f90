!> Preconditioned conjugate gradients on a given contact set: forces change there only,
!> their sum stays, and all gaps of the set become equal.
module fuge_set_gradients
  use fuge_contact_filter, only: contact_filter
  use fuge_grids, only: grid_family
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_products, only: multiply
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  use fuge_stretches, only: stretches, total, inner, largest
  use fuge_text, only: text
  implicit none
  private

  public :: relax, measure, make_iterate, open_gap

  !> Errors of the forces below this part of the worst tension, or of the gaps below
  !> this part of the worst penetration, let the set be judged.
  real(dp), parameter :: ENOUGH = 0.2_dp
  !> More iterations than this, beyond the number of points, are rounding.
  integer, parameter :: SPARE_ITERATIONS = 20
  integer, parameter :: MOST_ITERATIONS = 2000
  !> A negative energy below this part of its terms is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp

  !> Forces as parts of the load, so that lengths are per load.
  type, public :: iterate
    !> Forces, (n), their sum is 1.
    real(dp), allocatable :: force(:)
    !> Displacements by them, without the datum of the operator, (n).
    real(dp), allocatable :: displacement(:)
    !> Points taken for touching, (n).
    logical, allocatable :: contact(:)
    !> Mean over the contact of gap plus displacement: the rigid motion.
    real(dp) :: motion = 0.0_dp
    !> Largest difference from `motion` on the contact.
    real(dp) :: residual = huge(1.0_dp)
    !> Residual that is asked for.
    real(dp) :: target = 0.0_dp
    !> The stretches of the set, made by `relax` and `measure`.
    type(stretches) :: over = stretches()
    !> Work space, (n); of `remainder` and `correction` only the contact counts, elsewhere
    !> `direction` is zero.
    real(dp), allocatable, private :: remainder(:), correction(:), direction(:), image(:)
  end type iterate

contains

  !> Allocate all arrays for n points. Error: FUGE_ERR_MEMORY.
  pure subroutine make_iterate(state, n, info)
    type(iterate), intent(inout) :: state
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (state%force(n), state%displacement(n), state%contact(n), state%remainder(n), state%correction(n), &
              state%direction(n), state%image(n), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the work space of '//text(n)//' points')
  end subroutine make_iterate

  !> Go towards the forces for which the gaps of the contact set are equal.
  !>
  !> `shape` (n) gaps per load; `state` forces, displacements and set, new forces and
  !> displacements on return (the latter by recurrence). Ends when the residual is at
  !> most `tolerance` times the least length of a contact point (as in the certificate:
  !> its depth and the terms of its displacement) or, unless `thorough`, when it is
  !> small enough to tell which points pull and which penetrate. Errors: those of the
  !> operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY.
  subroutine relax(operator, family, grid, filter, shape, tolerance, thorough, state, info)
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid
    type(contact_filter), intent(inout) :: filter
    real(dp), intent(in) :: shape(:), tolerance
    logical, intent(in) :: thorough
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp) :: drift, tension, penetration, product, previous, curvature, step
    integer :: iteration, limit
    logical :: judges_forces, filtered

    filtered = operator%has_filter()
    judges_forces = filtered .and. .not. thorough
    call start(shape, state, penetration, info)
    if (info%failed()) return
    limit = min(state%over%points + SPARE_ITERATIONS, MOST_ITERATIONS)
    call operator%magnitude(state%force, state%displacement, state%image)
    state%target = tolerance*minval(abs(shape - state%motion) + state%image, mask=state%contact)
    state%direction = 0.0_dp
    previous = 1.0_dp
    do iteration = 0, limit
      if (state%residual <= state%target .or. iteration == limit) return
      if (iteration > 0 .and. .not. thorough .and. state%residual <= ENOUGH*penetration) return
      call filter%apply(operator, family, grid, state%over, state%remainder, state%correction, info)
      if (info%failed()) return
      if (iteration > 0 .and. judges_forces) then
        call estimate(state, drift, tension)
        if (drift <= ENOUGH*tension) return
      end if
      product = inner(state%over, state%remainder, state%correction)
      ! Nothing is left but rounding.
      if (.not. product > 0.0_dp) return
      call turn(state%over, product/previous, state%correction, state%direction)
      previous = product
      call multiply(operator, state%direction, state%image, info)
      if (info%failed()) return
      curvature = inner(state%over, state%direction, state%image)
      if (.not. curvature > 0.0_dp) then
        call explain(state, curvature, info)
        return
      end if
      step = product/curvature
      call advance(shape, step, state, penetration)
      if (.not. (thorough .or. filtered)) then
        ! Without a filter the last step stands for the error of the forces.
        drift = step*largest(state%over, state%direction)
        tension = -minval(state%force)
        if (drift <= ENOUGH*tension) return
      end if
    end do
  end subroutine relax

  !> Motion and residual of the present forces and displacements. Error: FUGE_ERR_MEMORY.
  pure subroutine measure(shape, state, info)
    real(dp), intent(in) :: shape(:)
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp) :: penetration

    call start(shape, state, penetration, info)
  end subroutine measure

  !> What lengths differ by on the contact set, and the worst penetration off it.
  pure subroutine start(shape, state, penetration, info)
    real(dp), intent(in) :: shape(:)
    type(iterate), intent(inout) :: state
    real(dp), intent(out) :: penetration
    type(fuge_info), intent(inout) :: info

    penetration = 0.0_dp
    call state%over%find(state%contact, info)
    if (info%failed()) return
    state%remainder = shape + state%displacement
    state%motion = 0.0_dp
    call centre(state)
    ! The mean of large numbers is not exact: once more for what is left of it.
    call centre(state)
    penetration = worst_penetration(shape, state)
  end subroutine start

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
  pure subroutine advance(shape, step, state, penetration)
    real(dp), intent(in) :: shape(:), step
    type(iterate), intent(inout) :: state
    real(dp), intent(out) :: penetration
    real(dp) :: mean

    mean = total(state%over, state%image)/real(state%over%points, dp)
    state%displacement = state%displacement - step*state%image
    call move(state%over, step, mean, state%direction, state%image, state%force, state%remainder)
    state%motion = state%motion - step*mean
    call centre(state)
    penetration = worst_penetration(shape, state)
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

    mean = total(state%over, state%remainder)/real(state%over%points, dp)
    associate (over => state%over)
      do i = 1, size(over%first)
        state%remainder(over%first(i):over%last(i)) = state%remainder(over%first(i):over%last(i)) - mean
      end do
    end associate
    state%motion = state%motion + mean
    state%residual = largest(state%over, state%remainder)
  end subroutine centre

  !> The deepest that an open point is pressed in, 0 if none is.
  pure function worst_penetration(shape, state) result(depth)
    real(dp), intent(in) :: shape(:)
    type(iterate), intent(in) :: state
    real(dp) :: depth
    integer :: i, first, last

    depth = 0.0_dp
    do i = 0, size(state%over%first)
      first = 1
      last = size(shape)
      if (i > 0) first = state%over%last(i) + 1
      if (i < size(state%over%first)) last = state%over%first(i + 1) - 1
      if (first > last) cycle
      depth = max(depth, depth_between(shape(first:last), state%displacement(first:last), state%motion))
    end do
  end function worst_penetration

  pure function depth_between(shape, displacement, motion) result(depth)
    real(dp), intent(in), contiguous :: shape(:), displacement(:)
    real(dp), intent(in) :: motion
    real(dp) :: depth
    integer :: k

    depth = 0.0_dp
    do k = 1, size(shape)
      depth = max(depth, -open_gap(shape(k), displacement(k), motion))
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
        drift = max(drift, abs(state%correction(k)))
        tension = max(tension, state%correction(k) - state%force(k))
      end do
    end do
  end subroutine estimate

  !> Gap of a point, per load; where the set is right none is negative.
  elemental function open_gap(shape, displacement, motion) result(gap)
    real(dp), intent(in) :: shape, displacement, motion
    real(dp) :: gap

    gap = (shape - motion) + displacement
  end function open_gap

  !> No energy in a direction: rounding, or an operator that is not positive definite.
  pure subroutine explain(state, curvature, info)
    type(iterate), intent(in) :: state
    real(dp), intent(in) :: curvature
    type(fuge_info), intent(inout) :: info

    if (curvature >= -ROUNDING*inner(state%over, abs(state%direction), abs(state%image))) return
    call report(info, FUGE_ERR_NOT_DEFINITE, 'product '//text(info%products)//': forces with zero sum store the ' &
                //'negative energy '//text(0.5_dp*curvature)//': the operator is not positive definite')
  end subroutine explain

end module fuge_set_gradients
