!> From places near maxima of a stress to the largest of them, all at once.
!>
!> Around every place that still may lead to the largest value differences give a quadratic model, whose best point
!> within a trust radius comes next (J. Nocedal and S. J. Wright, Numerical Optimization, 2006, chapter 4). The von
!> Mises stress is smooth where it is large. The Tresca stress is the largest of three differences of principal
!> stresses: where it has a maximum, so has each of them that is as large, so that its maxima are not at its kinks.
module fuge_peak_climb
  use fuge_kinds, only: dp
  use fuge_peak_starts, only: peak_start
  use fuge_peak_values, only: evaluate_measure
  use fuge_pressed_cells, only: pressed_cells
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  implicit none
  private

  public :: climb

  !> The step of the differences and the first trust radius, over the length of a start.
  real(dp), parameter :: DIFFERENCE = 1.0e-4_dp, FIRST_RADIUS = 0.5_dp
  !> The least step of the differences, in roundings of the coordinates.
  real(dp), parameter :: LEAST_ROUNDINGS = 4096.0_dp
  !> The climb ends where the model promises a lesser relative gain, or with a trust radius of so many differences.
  real(dp), parameter :: LEAST_GAIN = 1.0e-11_dp, LEAST_RADIUS = 0.1_dp
  !> The model of round k may miss this fraction of the value times itself k - 1 times.
  real(dp), parameter :: MISSED = 0.25_dp
  !> A curvature below this fraction of the greatest derivative counts as zero.
  real(dp), parameter :: LEAST_CURVATURE = 1.0e-6_dp
  integer, parameter :: MOST_ROUNDS = 120

  !> The ascent from one start: the best place so far; the middle of the next differences, their step and the trust
  !> radius, length; and the last model that was an ascent, with lengths in steps.
  type :: climber
    type(peak_start) :: best
    real(dp) :: middle(3) = 0.0_dp, step = 0.0_dp, radius = 0.0_dp
    real(dp) :: model_middle(3) = 0.0_dp, model_value = -1.0_dp, gradient(3) = 0.0_dp, hessian(3, 3) = 0.0_dp
    !> A bound for the value that it may reach, by the model.
    real(dp) :: promise = huge(1.0_dp)
    logical :: active = .true.
  end type climber

contains

  !> The start that leads to the largest value, moved to its maximum. Errors: those of the field, FUGE_ERR_MEMORY.
  subroutine climb(field, cells, measure, starts, best, info)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(peak_start), intent(in) :: starts(:)
    type(peak_start), intent(out) :: best
    type(fuge_info), intent(inout) :: info
    type(climber), allocatable :: climbers(:)
    integer :: k, round, stat

    allocate (climbers(size(starts)), stat=stat)
    call require_memory(stat, '', size(starts), 'starts of the search', info)
    if (stat /= 0) return
    do k = 1, size(starts)
      climbers(k)%best = starts(k)
      climbers(k)%middle = starts(k)%place
      climbers(k)%step = max(DIFFERENCE*starts(k)%length, LEAST_ROUNDINGS*spacing(maxval(abs(starts(k)%place))))
      climbers(k)%radius = FIRST_RADIUS*starts(k)%length
      climbers(k)%active = .not. starts(k)%fixed
    end do
    do round = 1, MOST_ROUNDS
      if (.not. any(climbers%active)) exit
      call advance(field, cells, measure, round, climbers, info)
      if (info%failed()) return
      call drop_losers(climbers)
    end do
    best = climbers(maxloc(climbers%best%value, dim=1))%best
  end subroutine climb

  !> One round of the active climbers.
  subroutine advance(field, cells, measure, round, climbers, info)
    class(stress_field), intent(in) :: field
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure, round
    type(climber), intent(inout) :: climbers(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: place(:, :), value(:), normal(:)
    integer :: active(size(climbers)), coordinate(cells%axes + 1), first, k, points, stat

    ! The last one is the depth.
    coordinate = [(k, k=1, cells%axes), 3]
    active = pack([(k, k=1, size(climbers))], climbers%active, spread(0, 1, size(climbers)))
    points = (cells%axes + 2)*(cells%axes + 3)/2
    allocate (place(3, points*count(active > 0)), stat=stat)
    if (stat == 0) allocate (value(size(place, 2)), normal(size(place, 2)), stat=stat)
    call require_memory(stat, '', size(climbers), 'climbs of the search', info)
    if (stat /= 0) return
    do k = 1, count(active > 0)
      first = (k - 1)*points
      associate (one => climbers(active(k)))
        one%middle(3) = max(one%middle(3), one%best%least_depth + one%step)
        call set_stencil(coordinate, one%middle, one%step, place(:, first + 1:first + points))
      end associate
    end do
    call evaluate_measure(field, cells, measure, place, value, normal, info)
    if (info%failed()) return
    do k = 1, count(active > 0)
      first = (k - 1)*points
      call move(coordinate, round, place(:, first + 1:first + points), value(first + 1:first + points), &
                climbers(active(k)))
    end do
  end subroutine advance

  !> The middle, two neighbours on each axis, and one in the plane of each pair of axes.
  pure subroutine set_stencil(coordinate, middle, step, place)
    integer, intent(in) :: coordinate(:)
    real(dp), intent(in) :: middle(3), step
    real(dp), intent(out) :: place(:, :)
    integer :: i, j, k

    place = spread(middle, 2, size(place, 2))
    k = 1
    do i = 1, size(coordinate)
      place(coordinate(i), k + 1:k + 2) = middle(coordinate(i)) + step*[1, -1]
      k = k + 2
    end do
    do i = 1, size(coordinate)
      do j = 1, i - 1
        k = k + 1
        place(coordinate([i, j]), k) = middle(coordinate([i, j])) + step
      end do
    end do
  end subroutine set_stencil

  !> Gradient and second derivatives, in units of the step, from the values of a stencil.
  pure subroutine fit(value, gradient, hessian)
    real(dp), intent(in) :: value(:)
    real(dp), intent(out) :: gradient(:), hessian(:, :)
    integer :: i, j, k

    do i = 1, size(gradient)
      gradient(i) = 0.5_dp*(value(2*i) - value(2*i + 1))
      hessian(i, i) = (value(2*i) - value(1)) + (value(2*i + 1) - value(1))
    end do
    k = 2*size(gradient) + 1
    do i = 1, size(gradient)
      do j = 1, i - 1
        k = k + 1
        hessian(i, j) = (value(k) - value(2*i)) - (value(2*j) - value(1))
        hessian(j, i) = hessian(i, j)
      end do
    end do
  end subroutine fit

  !> From the values of a stencil to the middle of the next one.
  pure subroutine move(coordinate, round, place, value, one)
    integer, intent(in) :: coordinate(:), round
    real(dp), intent(in) :: place(:, :), value(:)
    type(climber), intent(inout) :: one
    real(dp) :: gain, offset(size(coordinate))
    integer :: k, n

    n = size(coordinate)
    k = maxloc(value, dim=1)
    if (value(k) > one%best%value) then
      one%best%value = value(k)
      one%best%place = place(:, k)
    end if
    if (value(1) > one%model_value) then
      if (round > 1) one%radius = 2.0_dp*one%radius
      one%model_middle = one%middle
      one%model_value = value(1)
      call fit(value, one%gradient(:n), one%hessian(:n, :n))
    else
      one%radius = 0.25_dp*min(one%radius, maxval(abs(one%middle - one%model_middle)))
    end if
    associate (gradient => one%gradient(:n), hessian => one%hessian(:n, :n))
      offset = best_offset(gradient, hessian, one%radius/one%step, &
                           (one%model_middle(3) - one%best%least_depth)/one%step - 1.0_dp)
      gain = dot_product(gradient, offset) + 0.5_dp*dot_product(offset, matmul(hessian, offset))
    end associate
    one%active = gain > LEAST_GAIN*one%best%value .and. one%radius > LEAST_RADIUS*one%step
    one%promise = one%best%value + 2.0_dp*max(gain, 0.0_dp) + MISSED**round*one%best%value
    one%middle = one%model_middle
    one%middle(coordinate) = one%middle(coordinate) + one%step*offset
  end subroutine move

  !> Where the quadratic model is largest within the trust `radius`, and up to `room` along -z.
  pure function best_offset(gradient, hessian, radius, room) result(offset)
    real(dp), intent(in) :: gradient(:), hessian(:, :), radius, room
    real(dp) :: offset(size(gradient))
    integer :: n

    n = size(gradient)
    offset = newton_step(gradient, hessian, radius)
    if (offset(n) >= -room) return
    ! At the bound the other coordinates have a maximum of their own.
    offset(n) = -room
    offset(:n - 1) = newton_step(gradient(:n - 1) - room*hessian(:n - 1, n), hessian(:n - 1, :n - 1), radius)
  end function best_offset

  !> Newton's step to a maximum within a `radius` along each axis. Where the model is not concave, or the step too long,
  !> curvature is added along all axes, as by E. M. Levenberg and D. W. Marquardt.
  pure function newton_step(gradient, hessian, radius) result(step)
    real(dp), intent(in) :: gradient(:), hessian(:, :), radius
    real(dp) :: step(size(gradient))
    real(dp) :: added, largest
    logical :: solved

    step = 0.0_dp
    largest = max(maxval(abs(hessian)), maxval(abs(gradient)))
    if (.not. largest > 0.0_dp) return
    added = 0.0_dp
    do
      call solve_concave(gradient/largest, hessian/largest, added, step, solved)
      if (solved .and. maxval(abs(step)) <= radius) exit
      added = max(LEAST_CURVATURE, 2.0_dp*added)
    end do
  end function newton_step

  !> Solve (added I - hessian) step = gradient by Cholesky's method; not `solved` unless the matrix is positive
  !> definite.
  pure subroutine solve_concave(gradient, hessian, added, step, solved)
    real(dp), intent(in) :: gradient(:), hessian(:, :), added
    real(dp), intent(out) :: step(:)
    logical, intent(out) :: solved
    real(dp) :: factor(size(gradient), size(gradient)), pivot
    integer :: i, j

    solved = .false.
    step = 0.0_dp
    factor = -hessian
    do j = 1, size(gradient)
      pivot = factor(j, j) + added - sum(factor(j, :j - 1)**2)
      if (pivot < LEAST_CURVATURE) return
      factor(j, j) = sqrt(pivot)
      do i = j + 1, size(gradient)
        factor(i, j) = (factor(i, j) - dot_product(factor(i, :j - 1), factor(j, :j - 1)))/factor(j, j)
      end do
    end do
    solved = .true.
    step = gradient
    do j = 1, size(gradient)
      step(j) = (step(j) - dot_product(factor(j, :j - 1), step(:j - 1)))/factor(j, j)
    end do
    do j = size(gradient), 1, -1
      step(j) = (step(j) - dot_product(factor(j + 1:, j), step(j + 1:)))/factor(j, j)
    end do
  end subroutine solve_concave

  !> Stop the climbers that cannot reach the best value, and those beside another one that is not worse.
  pure subroutine drop_losers(climbers)
    type(climber), intent(inout) :: climbers(:)
    real(dp) :: best, near
    integer :: j, k

    best = maxval(climbers%best%value)
    where (climbers%promise < best) climbers%active = .false.
    do k = 1, size(climbers)
      if (.not. climbers(k)%active) cycle
      do j = 1, size(climbers)
        if (j == k .or. .not. climbers(j)%active) cycle
        near = min(climbers(j)%step, climbers(k)%step)
        if (maxval(abs(climbers(j)%middle - climbers(k)%middle)) >= near) cycle
        if (climbers(j)%best%value <= climbers(k)%best%value) climbers(j)%active = .false.
      end do
    end do
  end subroutine drop_losers

end module fuge_peak_climb
