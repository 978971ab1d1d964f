!> Forces within limits that share a resultant, found in few passes over all points.
!>
!> They follow from a motion q by f = f_0 + d R q, cut off at the limits, with weights d >= 0: the least change from f_0
!> that carries w. The motion is the minimum of a convex function of few variables (the dual problem), with
!> the gradient R^T f - w. Newton's method finds it, with a search along each step: many points go to their limits, or
!> leave them, at once. A small resistance to the motion keeps it finite where the limits are too low for the resultant;
!> repetitions from the forces found take it out.
module fuge_load_sharing
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: share_load

  !> The resistance to motion in each repetition, relative to that of all points together. A low one brings more points
  !> to their limits, a high one leaves more digits to those between them.
  real(dp), parameter :: RESISTANCES(6) = [1.0e-6_dp, 1.0e-9_dp, 1.0e-12_dp, 1.0e-12_dp, 1.0e-9_dp, 1.0e-6_dp]
  !> Steps of Newton's method in each repetition.
  integer, parameter :: MOST_STEPS = 60
  !> A step ends where the slope along it is below this fraction of that at its start, or after so many trials.
  real(dp), parameter :: FLAT = 0.1_dp
  integer, parameter :: MOST_TRIALS = 30
  !> A gradient below this many units in the last place of its terms is zero.
  real(dp), parameter :: ROUNDINGS = 16.0_dp

  !> What the search for a motion knows of it, (m) and (m, m).
  type :: motion_state
    !> The motion, R^T f - w + resistance q with the size of its terms, and its derivative.
    real(dp), allocatable :: motion(:), gradient(:), terms(:), hessian(:, :)
  end type motion_state

contains

  !> Forces (n) within `least` <= 0 and `most` >= 0 (n), huge without a limit, for which R^T f comes as near to the
  !> `resultant` (m) as rounding lets it, or nearly as near as the limits let it. `modes` R (n, m) with columns of about
  !> the same size. `space` may share the points: then all ranks call it.
  subroutine share_load(modes, resultant, least, most, space, force)
    real(dp), intent(in), contiguous :: modes(:, :), resultant(:), least(:), most(:)
    type(point_space), intent(in) :: space
    real(dp), intent(out), contiguous :: force(:)
    real(dp), allocatable :: weight(:)
    type(motion_state) :: now
    real(dp) :: largest, resistance
    integer :: repetition, stat

    force = 0.0_dp
    if (.not. any(abs(resultant) > 0.0_dp)) return
    ! Without memory the search begins with no forces.
    allocate (weight(size(force)), stat=stat)
    if (.not. space%everywhere(stat == 0)) return
    ! A point carries a share of its limit, but without one no more than the load.
    weight = min(max(most, -least), maxval(abs(resultant)))
    largest = space%total(stiffness(modes, weight))/real(size(resultant), dp)
    if (.not. largest > 0.0_dp) return
    do repetition = 1, size(RESISTANCES)
      resistance = RESISTANCES(repetition)*largest
      call find_motion(modes, resultant, least, most, weight, force, resistance, space, now)
      call set_forces(modes, least, most, weight, now%motion, force)
      if (all(abs(resistance*now%motion) <= ROUNDINGS*epsilon(resistance)*now%terms)) return
    end do
  end subroutine share_load

  !> The resistance of all points together to the motions, their sum.
  pure function stiffness(modes, weight)
    real(dp), intent(in), contiguous :: modes(:, :), weight(:)
    real(dp) :: stiffness
    integer :: j, k

    stiffness = 0.0_dp
    do j = 1, size(modes, 2)
      do k = 1, size(weight)
        stiffness = stiffness + weight(k)*modes(k, j)**2
      end do
    end do
  end function stiffness

  !> The motion from the forces `start` (n) on. The arguments are those of `evaluate`.
  subroutine find_motion(modes, resultant, least, most, weight, start, resistance, space, now)
    real(dp), intent(in), contiguous :: modes(:, :), resultant(:), least(:), most(:), weight(:), start(:)
    real(dp), intent(in) :: resistance
    type(point_space), intent(in) :: space
    type(motion_state), intent(out) :: now
    real(dp) :: step(size(resultant)), system(size(resultant), size(resultant))
    integer :: iteration, m, pivots(size(resultant)), info
    logical :: is_found

    m = size(resultant)
    allocate (now%motion(m), now%gradient(m), now%terms(m), now%hessian(m, m))
    now%motion = 0.0_dp
    call evaluate(modes, resultant, least, most, weight, start, resistance, space, now)
    do iteration = 1, MOST_STEPS
      if (all(abs(now%gradient) <= ROUNDINGS*epsilon(resistance)*now%terms)) return
      system = now%hessian
      step = -now%gradient
      call dgesv(m, 1, system, m, pivots, step, m, info)
      if (info /= 0) return
      call search_along(modes, resultant, least, most, weight, start, resistance, space, step, now, is_found)
      if (.not. is_found) return
    end do
  end subroutine find_motion

  !> Go along the step until the slope has become small, if such a motion `is_found`: the slope only rises, because the
  !> function is convex. The arguments are eleven: those of `evaluate`, the step and the answer.
  subroutine search_along(modes, resultant, least, most, weight, start, resistance, space, step, now, is_found)
    real(dp), intent(in), contiguous :: modes(:, :), resultant(:), least(:), most(:), weight(:), start(:)
    real(dp), intent(in) :: resistance, step(:)
    type(point_space), intent(in) :: space
    type(motion_state), intent(inout) :: now
    logical, intent(out) :: is_found
    real(dp) :: before(size(step)), first, slope, low, high, slope_low, slope_high, fraction
    integer :: trial

    before = now%motion
    first = dot_product(now%gradient, step)
    low = 0.0_dp
    slope_low = first
    slope_high = -first
    high = 1.0_dp
    fraction = 1.0_dp
    do trial = 1, MOST_TRIALS
      now%motion = before + fraction*step
      call evaluate(modes, resultant, least, most, weight, start, resistance, space, now)
      slope = dot_product(now%gradient, step)
      is_found = slope <= FLAT*abs(first) .and. (trial == 1 .or. slope >= -FLAT*abs(first))
      if (is_found) return
      if (slope > 0.0_dp) then
        high = fraction
        slope_high = slope
      else
        low = fraction
        slope_low = slope
      end if
      fraction = low + (high - low)*min(max(-slope_low/(slope_high - slope_low), 0.1_dp), 0.9_dp)
    end do
  end subroutine search_along

  !> Gradient and its derivative at a motion. The arguments are nine: the problem and the search.
  subroutine evaluate(modes, resultant, least, most, weight, start, resistance, space, now)
    real(dp), intent(in), contiguous :: modes(:, :), resultant(:), least(:), most(:), weight(:), start(:)
    real(dp), intent(in) :: resistance
    type(point_space), intent(in) :: space
    type(motion_state), intent(inout) :: now
    real(dp) :: force, displacement
    integer :: i, j, k, m

    m = size(resultant)
    now%gradient = 0.0_dp
    now%terms = 0.0_dp
    now%hessian = 0.0_dp
    if (space%number() == 0) then
      now%gradient = resistance*now%motion - resultant
      now%terms = abs(resistance*now%motion) + abs(resultant)
    end if
    do k = 1, size(start)
      displacement = 0.0_dp
      do j = 1, m
        displacement = displacement + modes(k, j)*now%motion(j)
      end do
      force = start(k) + weight(k)*displacement
      if (force >= least(k) .and. force <= most(k)) then
        do j = 1, m
          do i = j, m
            now%hessian(i, j) = now%hessian(i, j) + weight(k)*modes(k, i)*modes(k, j)
          end do
        end do
      else
        force = min(max(force, least(k)), most(k))
      end if
      do j = 1, m
        now%gradient(j) = now%gradient(j) + modes(k, j)*force
        now%terms(j) = now%terms(j) + abs(modes(k, j)*force)
      end do
    end do
    call add_states(space, now)
    do j = 1, m
      now%hessian(j, j:) = now%hessian(j:, j)
      now%hessian(j, j) = now%hessian(j, j) + resistance
    end do
  end subroutine evaluate

  !> The sums over the ranks.
  subroutine add_states(space, now)
    type(point_space), intent(in) :: space
    type(motion_state), intent(inout) :: now
    real(dp) :: sums(size(now%gradient)*(2 + size(now%gradient)))

    if (space%is_alone()) return
    associate (m => size(now%gradient))
      sums = [now%gradient, now%terms, now%hessian]
      call space%add(sums)
      now%gradient = sums(:m)
      now%terms = sums(m + 1:2*m)
      now%hessian = reshape(sums(2*m + 1:), [m, m])
    end associate
  end subroutine add_states

  !> The forces (n) that follow from a motion, from those on entry.
  pure subroutine set_forces(modes, least, most, weight, motion, force)
    real(dp), intent(in), contiguous :: modes(:, :), least(:), most(:), weight(:), motion(:)
    real(dp), intent(inout), contiguous :: force(:)
    integer :: k

    do k = 1, size(force)
      force(k) = min(max(force(k) + weight(k)*dot_product(modes(k, :), motion), least(k)), most(k))
    end do
  end subroutine set_forces

end module fuge_load_sharing
