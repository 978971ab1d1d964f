!> The step of the primal active set method that keeps all forces pushing
!> (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23).
module fuge_step_back
  use fuge_kinds, only: dp
  implicit none
  private

  public :: step_back

contains

  !> Go towards the wanted forces until the first becomes zero; that point leaves. A point
  !> that was to join but would pull at once did so by rounding: it is barred until the
  !> forces have moved.
  pure subroutine step_back(wanted, contact, force, newest, barred)
    real(dp), intent(in) :: wanted(:)
    logical, intent(inout) :: contact(:), barred(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(in) :: newest
    real(dp) :: way(size(force))
    integer :: k

    k = 0
    if (newest > 0) then
      if (contact(newest) .and. wanted(newest) <= 0.0_dp .and. .not. force(newest) > 0.0_dp) k = newest
    end if
    if (k > 0) then
      barred(k) = .true.
    else
      way = huge(way)
      where (contact .and. wanted <= 0.0_dp) way = force/max(force - wanted, tiny(way))
      k = minloc(way, dim=1)
      where (contact) force = max(force + min(way(k), 1.0_dp)*(wanted - force), 0.0_dp)
    end if
    force(k) = 0.0_dp
    contact(k) = .false.
  end subroutine step_back

end module fuge_step_back
