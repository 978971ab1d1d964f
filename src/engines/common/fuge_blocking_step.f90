!> The step of the primal active set method that keeps all forces pushing
!> (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23).
module fuge_blocking_step
  use fuge_kinds, only: dp
  implicit none
  private

  public :: step_back, pulls

contains

  !> Go towards the wanted forces until the first becomes zero; that point leaves. A point
  !> that was to join but would pull at once did so by rounding: it is barred until the
  !> forces have moved. All (n); `state` 1 at the lower stop, -1 at the upper one, 0 open;
  !> `tied` points may pull; `noise` >= 0 is a force that is rounding.
  pure subroutine step_back(wanted, noise, tied, state, force, newest, barred)
    real(dp), intent(in) :: wanted(:), noise
    logical, intent(in) :: tied(:)
    integer, intent(inout) :: state(:)
    logical, intent(inout) :: barred(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(in) :: newest
    real(dp) :: way, least
    integer :: j, k

    k = 0
    if (newest > 0) then
      if (pulls(wanted(newest), noise, state(newest), tied(newest)) .and. .not. abs(force(newest)) > 0.0_dp) k = newest
    end if
    if (k > 0) then
      barred(k) = .true.
    else
      least = huge(least)
      do j = 1, size(force)
        if (.not. pulls(wanted(j), noise, state(j), tied(j))) cycle
        way = abs(force(j))/max(abs(force(j) - wanted(j)), tiny(way))
        if (way >= least) cycle
        least = way
        k = j
      end do
      least = min(least, 1.0_dp)
      where (state /= 0) force = force + least*(wanted - force)
      where (.not. tied) force = real(state, dp)*max(state*force, 0.0_dp)
    end if
    force(k) = 0.0_dp
    state(k) = 0
  end subroutine step_back

  !> Would the force pull at its stop? None at all counts as that too, unless it may hold a
  !> motion that no other point does: then only one beyond the rounding.
  elemental function pulls(wanted, noise, state, tied)
    real(dp), intent(in) :: wanted, noise
    integer, intent(in) :: state
    logical, intent(in) :: tied
    logical :: pulls

    pulls = state /= 0 .and. .not. tied
    if (.not. pulls) return
    if (noise > 0.0_dp) then
      pulls = wanted*state < -noise
    else
      pulls = wanted*state <= 0.0_dp
    end if
  end function pulls

end module fuge_blocking_step
