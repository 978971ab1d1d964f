!> The step of an active-set method towards the forces of its working set, as far as none becomes tensile
!> (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23).
module fuge_blocking_step
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: find_blocking, is_tensile, step_to_blocking

contains

  !> The fraction of the step from `force` to `target` at which the first force reaches zero, and its point.
  !>
  !> All (n); `blocks` marks the points in contact whose target is tensile. `step_length` is at most 1; `point` is 0,
  !> and the step is whole, if there are none.
  pure subroutine find_blocking(force, target, blocks, step_length, point)
    real(dp), intent(in) :: force(:), target(:)
    logical, intent(in) :: blocks(:)
    real(dp), intent(out) :: step_length
    integer, intent(out) :: point
    real(dp) :: ratio
    integer :: k

    step_length = huge(step_length)
    point = 0
    do k = 1, size(force)
      if (.not. blocks(k)) cycle
      ratio = abs(force(k))/max(abs(force(k) - target(k)), tiny(ratio))
      if (ratio >= step_length) cycle
      step_length = ratio
      point = k
    end do
    step_length = min(step_length, 1.0_dp)
  end subroutine find_blocking

  !> Go towards the target forces until the first becomes zero; that point opens. A point that has just joined and
  !> whose target is tensile joined by rounding: it is locked out until the forces have changed.
  !>
  !> All (n). Forces up to `noise` >= 0 are rounding; `tied` points may pull; `state` and `force` of the working
  !> set; `newest` the point that has just joined, or 0; `locked` points must not join again. `space` may share the
  !> points: then one of them has the newest point, and one that which opens.
  subroutine step_to_blocking(target, noise, tied, state, force, newest, locked, space)
    real(dp), intent(in) :: target(:), noise(:)
    logical, intent(in) :: tied(:)
    integer, intent(inout) :: state(:)
    logical, intent(inout) :: locked(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(in) :: newest
    type(point_space), intent(in) :: space
    real(dp) :: owner(1), step_length
    integer :: k

    k = 0
    if (newest > 0) then
      if (is_tensile(target(newest), noise(newest), state(newest), tied(newest))) then
        if (.not. abs(force(newest)) > 0.0_dp) k = newest
      end if
    end if
    if (space%anywhere(k > 0)) then
      if (k > 0) locked(k) = .true.
    else
      call find_blocking(force, target, is_tensile(target, noise, state, tied), step_length, k)
      owner = real(space%number(), dp)
      call space%take_from_least(merge(step_length, huge(step_length), k > 0), owner)
      step_length = space%least(step_length)
      if (abs(owner(1) - real(space%number(), dp)) > 0.0_dp) k = 0
      where (state /= FUGE_OPEN) force = force + step_length*(target - force)
      where (.not. tied) force = real(state, dp)*max(state*force, 0.0_dp)
    end if
    if (k < 1) return
    force(k) = 0.0_dp
    state(k) = FUGE_OPEN
  end subroutine step_to_blocking

  !> Is the force tensile, that is, does it pull at the stop of its point? Zero counts as tensile, except with `noise`
  !> > 0, where only tension above `noise` does: a point without force may be the one that resists a rigid mode.
  elemental function is_tensile(force, noise, state, tied)
    real(dp), intent(in) :: force, noise
    integer, intent(in) :: state
    logical, intent(in) :: tied
    logical :: is_tensile

    is_tensile = state /= FUGE_OPEN .and. .not. tied
    if (.not. is_tensile) return
    if (noise > 0.0_dp) then
      is_tensile = force*state < -noise
    else
      is_tensile = force*state <= 0.0_dp
    end if
  end function is_tensile

end module fuge_blocking_step
