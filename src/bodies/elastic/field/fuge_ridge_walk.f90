!> Along a ridge of a stress to its highest place.
!>
!> Under uniform pressure on a strip the Tresca stress is the same on a whole semicircle, and under pressures that are
!> nearly uniform its maximum is that of a ridge. Its slope drowns in the curvature across, so that second differences
!> do not find the way. Here heights of the ridge itself are compared, each the maximum across it.
module fuge_ridge_walk
  use fuge_kinds, only: dp
  use fuge_peak_climb, only: fit, stencil, ALL_POINTS
  use fuge_peak_starts, only: peak_start
  use fuge_peak_values, only: evaluate_measure
  use fuge_status, only: fuge_info
  use fuge_stress_field, only: stress_field
  implicit none
  private

  public :: walk_ridge

  !> Lengths of the first and the longest step, of the last one, and of the differences, over that of the start.
  real(dp), parameter :: FIRST_STEP = 0.1_dp, LONGEST_STEP = 0.3_dp, LAST_STEP = 1.0e-5_dp, DIFFERENCE = 3.0e-4_dp
  !> Values whose relative difference is at most this count as equal.
  real(dp), parameter :: SAME = 2.0e-15_dp
  !> Steps across the ridge to its top, and along it at most.
  integer, parameter :: CORRECTIONS = 3, MOST_STEPS = 80
  !> Steps of the power iteration for the greatest curvature.
  integer, parameter :: POWER_STEPS = 40

contains

  !> Move a `summit` along its ridge while that leads higher. `axes` of the search: 2 (x and z) or 3. Errors: those of
  !> the field.
  subroutine walk_ridge(field, axes, measure, summit, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: axes, measure
    type(peak_start), intent(inout) :: summit
    type(fuge_info), intent(inout) :: info
    type(peak_start) :: here, next(2)
    real(dp) :: along(3), step
    integer :: k, side

    here = summit
    along = 0.0_dp
    call go_across(field, axes, measure, here, along, info)
    step = FIRST_STEP*here%length
    do k = 1, MOST_STEPS
      do side = 1, 2
        next(side) = here
        next(side)%place = here%place + merge(step, -step, side == 1)*along
        next(side)%place(3) = max(next(side)%place(3), here%least_depth)
        call go_across(field, axes, measure, next(side), along, info)
        if (info%failed()) return
      end do
      side = maxloc(next%value, dim=1)
      if (maxval(abs(next%value - here%value)) <= SAME*here%value) exit
      if (next(side)%value > here%value) then
        here = next(side)
        step = min(2.0_dp*step, LONGEST_STEP*here%length)
      else
        step = 0.25_dp*step
        if (step < LAST_STEP*here%length) exit
      end if
    end do
    if (here%value > summit%value) summit = here
  end subroutine walk_ridge

  !> Move a place across the ridge to its top; `along` becomes the direction of the ridge there.
  subroutine go_across(field, axes, measure, here, along, info)
    class(stress_field), intent(inout) :: field
    integer, intent(in) :: axes, measure
    type(peak_start), intent(inout) :: here
    real(dp), intent(inout) :: along(3)
    type(fuge_info), intent(inout) :: info
    real(dp) :: place(3, ALL_POINTS(axes)), value(ALL_POINTS(axes)), normal(ALL_POINTS(axes)), middle(3), step
    real(dp) :: gradient(axes), hessian(axes, axes), flat(axes), offset(axes)
    integer :: k

    step = DIFFERENCE*here%length
    do k = 1, CORRECTIONS
      middle = here%place
      middle(3) = max(middle(3), here%least_depth + step)
      place = stencil(axes, size(value), middle, step, here%least_depth)
      call evaluate_measure(field, measure, place, value, normal, info)
      if (info%failed()) return
      call fit(axes, value, gradient, hessian)
      flat = flattest(hessian)
      offset = step_across(gradient, hessian, flat)
      here%place = middle
      here%place(:axes - 1) = middle(:axes - 1) + step*offset(:axes - 1)
      here%place(3) = max(middle(3) + step*offset(axes), here%least_depth)
    end do
    call evaluate_measure(field, measure, reshape(here%place, [3, 1]), value(:1), normal(:1), info)
    here%value = value(1)
    ! Keep the sense.
    middle = 0.0_dp
    middle(:axes - 1) = flat(:axes - 1)
    middle(3) = flat(axes)
    along = merge(-middle, middle, dot_product(along, middle) < 0.0_dp)
  end subroutine go_across

  !> Newton's step to a maximum in the directions other than `flat`, a unit vector; none where it is no maximum.
  pure function step_across(gradient, hessian, flat) result(step)
    real(dp), intent(in) :: gradient(:), hessian(:, :), flat(:)
    real(dp) :: step(size(gradient))
    real(dp), parameter :: FARTHEST = 500.0_dp
    real(dp) :: direction(size(gradient)), curved(size(gradient), size(gradient)), curvature, slope(size(gradient))
    integer :: k

    step = 0.0_dp
    curved = -hessian
    slope = gradient - dot_product(flat, gradient)*flat
    do k = 1, size(gradient) - 1
      direction = greatest(curved, flat)
      curvature = dot_product(direction, matmul(curved, direction))
      if (.not. curvature > 0.0_dp) exit
      step = step + dot_product(direction, slope)/curvature*direction
      curved = curved - curvature*spread(direction, 2, size(direction))*spread(direction, 1, size(direction))
    end do
    step = step/max(1.0_dp, maxval(abs(step))/FARTHEST)
  end function step_across

  !> The direction of least curvature, a unit vector.
  pure function flattest(hessian) result(direction)
    real(dp), intent(in) :: hessian(:, :)
    real(dp) :: direction(size(hessian, 1))
    real(dp) :: shifted(size(hessian, 1), size(hessian, 1)), largest
    integer :: i

    largest = 0.0_dp
    do i = 1, size(hessian, 1)
      largest = max(largest, sum(abs(hessian(:, i))))
    end do
    shifted = hessian
    do i = 1, size(hessian, 1)
      shifted(i, i) = shifted(i, i) + largest
    end do
    direction = greatest(shifted, 0.0_dp*hessian(:, 1))
  end function flattest

  !> A unit vector along the greatest eigenvalue of a semidefinite matrix, across `besides`, by power iteration.
  pure function greatest(matrix, besides) result(direction)
    real(dp), intent(in) :: matrix(:, :), besides(:)
    real(dp) :: direction(size(besides))
    real(dp) :: power(size(besides), size(besides))
    integer :: i, k

    power = matrix
    ! Squared again and again: each step doubles the power.
    do k = 1, POWER_STEPS
      if (.not. maxval(abs(power)) > 0.0_dp) exit
      power = power/maxval(abs(power))
      power = matmul(power, power)
    end do
    k = maxloc([(norm2(power(:, i)), i=1, size(besides))], dim=1)
    direction = power(:, k)
    direction = direction - dot_product(besides, direction)*besides
    if (norm2(direction) > 0.0_dp) direction = direction/norm2(direction)
  end function greatest

end module fuge_ridge_walk
