!> Preconditioned conjugate gradients on a given contact set: forces change there only,
!> their sum stays, and all gaps of the set become equal.
module fuge_set_gradients
  use fuge_contact_filter, only: contact_filter
  use fuge_grids, only: grid_family
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_products, only: multiply
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
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
    !> Work space, (n).
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
  !> its depth and the terms of its displacement) or, unless `thorough`, when it is small enough to tell which points
  !> pull and which penetrate. Errors: those of the operator, FUGE_ERR_NOT_DEFINITE.
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
    integer :: points, iteration, limit
    logical :: judges_forces, filtered

    filtered = operator%has_filter()
    judges_forces = filtered .and. .not. thorough
    points = count(state%contact)
    limit = min(points + SPARE_ITERATIONS, MOST_ITERATIONS)
    call start(shape, points, state, penetration)
    call operator%magnitude(state%force, state%displacement, state%image)
    state%target = tolerance*minval(abs(shape - state%motion) + state%image, mask=state%contact)
    state%direction = 0.0_dp
    previous = 1.0_dp
    do iteration = 0, limit
      if (state%residual <= state%target .or. iteration == limit) return
      if (iteration > 0 .and. .not. thorough .and. state%residual <= ENOUGH*penetration) return
      call filter%apply(operator, family, grid, state%remainder, state%correction, info)
      if (info%failed()) return
      if (iteration > 0 .and. judges_forces) then
        call estimate(state, drift, tension)
        if (drift <= ENOUGH*tension) return
      end if
      product = dot_product(state%remainder, state%correction)
      ! Nothing is left but rounding.
      if (.not. product > 0.0_dp) return
      state%direction = state%correction + (product/previous)*state%direction
      previous = product
      call multiply(operator, state%direction, state%image, info)
      if (info%failed()) return
      curvature = dot_product(state%direction, state%image)
      if (.not. curvature > 0.0_dp) then
        call explain(state, curvature, info)
        return
      end if
      step = product/curvature
      call advance(shape, points, step, state, penetration)
      if (.not. (thorough .or. filtered)) then
        ! Without a filter the last step stands for the error of the forces.
        drift = step*maxval(abs(state%direction))
        tension = -minval(state%force)
        if (drift <= ENOUGH*tension) return
      end if
    end do
  end subroutine relax

  !> Motion and residual of the present forces and displacements.
  pure subroutine measure(shape, state)
    real(dp), intent(in) :: shape(:)
    type(iterate), intent(inout) :: state
    real(dp) :: penetration

    call start(shape, count(state%contact), state, penetration)
  end subroutine measure

  !> What lengths differ by on the contact set, and the worst penetration off it.
  pure subroutine start(shape, points, state, penetration)
    real(dp), intent(in) :: shape(:)
    integer, intent(in) :: points
    type(iterate), intent(inout) :: state
    real(dp), intent(out) :: penetration
    integer :: k

    state%motion = 0.0_dp
    do k = 1, size(shape)
      state%remainder(k) = 0.0_dp
      if (state%contact(k)) state%remainder(k) = shape(k) + state%displacement(k)
    end do
    state%motion = sum(state%remainder)/real(points, dp)
    where (state%contact) state%remainder = state%remainder - state%motion
    call centre(shape, points, sum(state%remainder), state, penetration)
  end subroutine start

  !> One step along the direction.
  pure subroutine advance(shape, points, step, state, penetration)
    real(dp), intent(in) :: shape(:), step
    integer, intent(in) :: points
    type(iterate), intent(inout) :: state
    real(dp), intent(out) :: penetration
    real(dp) :: mean, total
    integer :: k

    mean = 0.0_dp
    do k = 1, size(shape)
      if (state%contact(k)) mean = mean + state%image(k)
    end do
    mean = mean/real(points, dp)
    total = 0.0_dp
    do k = 1, size(shape)
      state%displacement(k) = state%displacement(k) - step*state%image(k)
      if (.not. state%contact(k)) cycle
      state%force(k) = state%force(k) - step*state%direction(k)
      state%remainder(k) = state%remainder(k) - step*(state%image(k) - mean)
      total = total + state%remainder(k)
    end do
    state%motion = state%motion - step*mean
    call centre(shape, points, total, state, penetration)
  end subroutine advance

  !> Keep the mean of the remainder zero: its rounding would grow and drown the rest.
  pure subroutine centre(shape, points, total, state, penetration)
    real(dp), intent(in) :: shape(:), total
    integer, intent(in) :: points
    type(iterate), intent(inout) :: state
    real(dp), intent(out) :: penetration
    real(dp) :: mean, deepest
    integer :: k

    mean = total/real(points, dp)
    state%motion = state%motion + mean
    state%residual = 0.0_dp
    deepest = 0.0_dp
    do k = 1, size(shape)
      if (state%contact(k)) then
        state%remainder(k) = state%remainder(k) - mean
        state%residual = max(state%residual, abs(state%remainder(k)))
      else
        deepest = min(deepest, shape(k) + state%displacement(k) - state%motion)
      end if
    end do
    penetration = -deepest
  end subroutine centre

  !> How far the forces still are from those wanted, and how strongly those pull.
  pure subroutine estimate(state, drift, tension)
    type(iterate), intent(in) :: state
    real(dp), intent(out) :: drift, tension
    integer :: k

    drift = 0.0_dp
    tension = 0.0_dp
    do k = 1, size(state%force)
      drift = max(drift, abs(state%correction(k)))
      tension = max(tension, state%correction(k) - state%force(k))
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

    if (curvature >= -ROUNDING*dot_product(abs(state%direction), abs(state%image))) return
    call report(info, FUGE_ERR_NOT_DEFINITE, 'product '//text(info%products)//': forces with zero sum store the ' &
                //'negative energy '//text(0.5_dp*curvature)//': the operator is not positive definite')
  end subroutine explain

end module fuge_set_gradients
