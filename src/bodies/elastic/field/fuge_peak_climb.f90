!> From places near maxima of a stress to the largest of them, all at once.
!>
!> Around every place that still may lead to the largest value a stencil of second differences gives a quadratic model
!> (J. Nocedal and S. J. Wright, Numerical Optimization, 2006, chapter 4): Newton's step within a box. The stencil is
!> four times finer in each round. The von Mises stress is smooth where it is large. The Tresca stress is the
!> largest of three differences of principal stresses: where it has a maximum, so has each of them that is as large, so
!> that its maxima are not at its kinks.
module fuge_peak_climb
  use fuge_kinds, only: dp
  use fuge_peak_starts, only: peak_start
  use fuge_peak_values, only: evaluate_measure
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  implicit none
  private

  public :: climb, fit, stencil

  !> Steps of the stencil over the length of a start: the first one, and the last one if the values of its stencil
  !> differ by less than NEARLY_SAME of the largest. Where they do not, as at a cusp of the stress at the rim of a
  !> contact, finer ones follow.
  real(dp), parameter :: FIRST_STEP = 0.25_dp, LAST_STEP = 2.0e-4_dp, NEARLY_SAME = 3.0e-7_dp
  !> The least step, in roundings of the coordinates.
  real(dp), parameter :: LEAST_ROUNDINGS = 64.0_dp
  !> The longest step of Newton's method along each axis, in steps of the stencil.
  real(dp), parameter :: REACH = 2.0_dp
  !> A slope above this fraction of the curvature, in steps of the stencil, does not belong to a ridge.
  real(dp), parameter :: STEEP = 0.1_dp
  !> A curvature below this fraction of the greatest derivative counts as zero.
  real(dp), parameter :: LEAST_CURVATURE = 1.0e-6_dp
  integer, parameter :: MOST_ROUNDS = 120
  !> Points of a stencil with two and with three axes.
  integer, parameter, public :: ALL_POINTS(2:3) = [9, 19]
  !> Without those of mixed derivatives, in the first round, from which few go on.
  integer, parameter :: FEW_POINTS(2:3) = [5, 7]

  !> The ascent from one start: its best place so far and the middle of its next stencil.
  type :: climber
    type(peak_start) :: best
    real(dp) :: middle(3) = 0.0_dp, step = 0.0_dp, last_step = 0.0_dp, least_step = 0.0_dp
    !> A bound for the value that it may reach, by the quadratic model.
    real(dp) :: promise = huge(1.0_dp)
    logical :: active = .true.
    !> 1 where the stress is curved equally along all axes, 0 on a ridge.
    real(dp) :: flatness = 1.0_dp
  end type climber

contains

  !> The start that leads to the largest value, moved to its maximum, and how flat that is: 1 if it is curved equally
  !> along all axes, 0 on a ridge. `axes` of the surface: 1 on a line, the coordinates being x and z, or 2. Errors:
  !> those of the field, FUGE_ERR_MEMORY.
  subroutine climb(field, axes, measure, starts, best, flatness, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: axes, measure
    type(peak_start), intent(in) :: starts(:)
    type(peak_start), intent(out) :: best
    real(dp), intent(out) :: flatness
    type(fuge_info), intent(inout) :: info
    type(climber), allocatable :: climbers(:)
    integer, allocatable :: active(:)
    integer :: count, k, round, stat

    flatness = 1.0_dp
    allocate (climbers(size(starts)), active(size(starts)), stat=stat)
    call require_memory(stat, '', size(starts), 'starts of the search', info)
    if (stat /= 0) return
    do k = 1, size(starts)
      climbers(k) = climber_from(starts(k))
    end do
    do round = 1, MOST_ROUNDS
      count = 0
      do k = 1, size(climbers)
        if (.not. climbers(k)%active) cycle
        count = count + 1
        active(count) = k
      end do
      if (count == 0) exit
      call advance(field, axes + 1, merge(FEW_POINTS(axes + 1), ALL_POINTS(axes + 1), round == 1), measure, climbers, &
                   active(:count), info)
      if (info%failed()) return
      call drop_losers(climbers)
    end do
    k = maxloc(climbers%best%value, dim=1)
    best = climbers(k)%best
    flatness = climbers(k)%flatness
  end subroutine climb

  pure function climber_from(start) result(new)
    type(peak_start), intent(in) :: start
    type(climber) :: new

    new%best = start
    new%middle = start%place
    new%step = FIRST_STEP*start%length
    new%least_step = LEAST_ROUNDINGS*spacing(maxval(abs(start%place)))
    new%last_step = max(LAST_STEP*start%length, new%least_step)
    new%active = .not. start%fixed
  end function climber_from

  !> One round of the active climbers, in coordinates `axes` (2: x and z; 3: x, y and z), with stencils of `points`.
  subroutine advance(field, axes, points, measure, climbers, active, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: axes, points, measure, active(:)
    type(climber), intent(inout) :: climbers(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: place(:, :), value(:), normal(:)
    integer :: first, k, stat, total

    total = points*size(active)
    allocate (place(3, total), value(total), normal(total), stat=stat)
    call require_memory(stat, '', total, 'places of the search', info)
    if (stat /= 0) return
    do k = 1, size(active)
      first = (k - 1)*points
      associate (one => climbers(active(k)))
        one%middle(3) = max(one%middle(3), one%best%least_depth + one%step)
        place(:, first + 1:first + points) = stencil(axes, points, one%middle, one%step, one%best%least_depth)
      end associate
    end do
    call evaluate_measure(field, measure, place, value, normal, info)
    if (info%failed()) return
    do k = 1, size(active)
      first = (k - 1)*points
      call move(axes, place(:, first + 1:first + points), value(first + 1:first + points), climbers(active(k)))
    end do
  end subroutine advance

  !> The middle, two neighbours on each axis and, unless there are `FEW_POINTS`, four in the plane of each pair of axes.
  pure function stencil(axes, points, middle, step, least_depth) result(place)
    integer, intent(in) :: axes, points
    real(dp), intent(in) :: middle(3), step, least_depth
    real(dp) :: place(3, points)
    integer :: i, j, k

    k = 1
    place = spread(middle, 2, points)
    do i = 1, axes
      place(coordinate(i, axes), k + 1) = middle(coordinate(i, axes)) + step
      place(coordinate(i, axes), k + 2) = middle(coordinate(i, axes)) - step
      k = k + 2
    end do
    do i = 1, axes - 1
      do j = i + 1, axes
        if (k == points) exit
        place(coordinate(i, axes), k + 1:k + 4) = middle(coordinate(i, axes)) + step*[1, 1, -1, -1]
        place(coordinate(j, axes), k + 1:k + 4) = middle(coordinate(j, axes)) + step*[1, -1, 1, -1]
        k = k + 4
      end do
    end do
    place(3, :) = max(place(3, :), least_depth)
  end function stencil

  !> Of the axes of a search the last one is z.
  pure function coordinate(i, axes)
    integer, intent(in) :: i, axes
    integer :: coordinate

    coordinate = i
    if (i == axes) coordinate = 3
  end function coordinate

  !> From the values of a stencil to the middle of the next one.
  pure subroutine move(axes, place, value, one)
    integer, intent(in) :: axes
    real(dp), intent(in) :: place(:, :), value(:)
    type(climber), intent(inout) :: one
    real(dp) :: gradient(axes), hessian(axes, axes), offset(axes), gain, room
    integer :: i, k
    logical :: followed

    k = maxloc(value, dim=1)
    if (value(k) > one%best%value) then
      one%best%value = value(k)
      one%best%place = place(:, k)
    end if
    if (one%step <= one%last_step) &
      one%active = one%best%value - minval(value) > NEARLY_SAME*one%best%value .and. one%step > one%least_step
    if (.not. one%active) return
    call fit(axes, value, gradient, hessian)
    room = (one%middle(3) - one%best%least_depth)/one%step
    if (room < 1.5_dp .and. gradient(axes) < -STEEP*maxval(abs(hessian))) then
      ! The stress falls from the least depth on: no ridge leads away from there.
      one%flatness = flatness_of(hessian(:axes - 1, :axes - 1))
    else
      one%flatness = flatness_of(hessian)
    end if
    offset = best_offset(gradient, hessian, room)
    gain = dot_product(gradient, offset) + 0.5_dp*dot_product(offset, matmul(hessian, offset))
    one%promise = max(one%best%value, value(1) + 1.5_dp*max(gain, 0.0_dp)) &
                  + (one%step/one%best%length)**2*one%best%value
    followed = value(1) + gain >= one%best%value
    if (followed) then
      do i = 1, axes
        k = coordinate(i, axes)
        one%middle(k) = one%middle(k) + offset(i)*one%step
      end do
    else
      one%middle = one%best%place
    end if
    if (followed .and. maxval(abs(offset)) <= 1.0_dp) then
      one%step = 0.25_dp*one%step
    else if (.not. followed .or. gain <= epsilon(gain)*one%best%value) then
      one%step = 0.5_dp*one%step
    end if
    one%step = max(one%step, one%least_step)
  end subroutine move

  !> Gradient and second derivatives, in units of the step, from the values of a `stencil`.
  pure subroutine fit(axes, value, gradient, hessian)
    integer, intent(in) :: axes
    real(dp), intent(in) :: value(:)
    real(dp), intent(out) :: gradient(:), hessian(:, :)
    integer :: i, j, k

    k = 1
    do i = 1, axes
      gradient(i) = 0.5_dp*(value(k + 1) - value(k + 2))
      hessian(i, i) = (value(k + 1) - value(1)) + (value(k + 2) - value(1))
      k = k + 2
    end do
    do i = 1, axes - 1
      do j = i + 1, axes
        hessian(i, j) = 0.0_dp
        hessian(j, i) = 0.0_dp
        if (k == size(value)) cycle
        hessian(i, j) = 0.25_dp*((value(k + 1) - value(k + 2)) - (value(k + 3) - value(k + 4)))
        hessian(j, i) = hessian(i, j)
        k = k + 4
      end do
    end do
  end subroutine fit

  !> The product of the curvatures of a maximum over that of equal ones with the same sum; 0 where it is no maximum.
  pure function flatness_of(hessian) result(flatness)
    real(dp), intent(in) :: hessian(:, :)
    real(dp) :: flatness
    real(dp) :: a(size(hessian, 1), size(hessian, 1)), mean
    integer :: i, j, n

    n = size(hessian, 1)
    flatness = 0.0_dp
    mean = 0.0_dp
    do i = 1, n
      mean = mean - hessian(i, i)/real(n, dp)
    end do
    if (.not. mean > 0.0_dp) return
    a = -hessian/mean
    flatness = 1.0_dp
    do i = 1, n
      flatness = flatness*a(i, i)
      if (.not. flatness > 0.0_dp) return
      do j = i + 1, n
        a(j, i + 1:) = a(j, i + 1:) - a(j, i)/a(i, i)*a(i, i + 1:)
      end do
    end do
  end function flatness_of

  !> Where the quadratic model is largest within REACH along each axis, and up to `room` along -z.
  pure function best_offset(gradient, hessian, room) result(offset)
    real(dp), intent(in) :: gradient(:), hessian(:, :), room
    real(dp) :: offset(size(gradient))
    integer :: n

    n = size(gradient)
    offset = newton_step(gradient, hessian)
    if (offset(n) >= -room) return
    ! At the bound the other coordinates have a maximum of their own.
    offset(n) = -room
    offset(:n - 1) = newton_step(gradient(:n - 1) - room*hessian(:n - 1, n), hessian(:n - 1, :n - 1))
  end function best_offset

  !> Newton's step to a maximum, cut to REACH. Where the model is not concave, the curvature that it lacks is added
  !> along all axes, as by E. M. Levenberg and D. W. Marquardt.
  pure function newton_step(gradient, hessian) result(step)
    real(dp), intent(in) :: gradient(:), hessian(:, :)
    real(dp) :: step(size(gradient))
    real(dp) :: added, largest
    logical :: solved

    step = 0.0_dp
    largest = max(maxval(abs(hessian)), maxval(abs(gradient)))
    if (.not. largest > 0.0_dp) return
    added = 0.0_dp
    solved = .false.
    do while (.not. solved)
      call solve_concave(gradient/largest, hessian/largest, added, step, solved)
      added = max(LEAST_CURVATURE, 4.0_dp*added)
    end do
    step = step/max(1.0_dp, maxval(abs(step))/REACH)
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
