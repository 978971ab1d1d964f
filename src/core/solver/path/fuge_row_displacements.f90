!> Elastic displacements of some of the points: of those that are not at a stop, which is all that a path needs between
!> two events, or of those at a stop.
module fuge_row_displacements
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop, FUGE_OPEN
  use fuge_kinds, only: dp, xp
  use fuge_lapack, only: dgemv
  use fuge_marked_runs, only: next_run
  implicit none
  private

  public :: add_displacement, extended_gaps

  !> Open points and contact points are taken run by run if there are at most about this many runs of neighbours.
  integer, parameter :: MOST_RUNS = 8

contains

  !> u := u + (alpha - datum) f at the points `needed`, and anything at the others.
  !>
  !> `flexibility` the largest coefficient of alpha; `contact` marks the points with force; all others (n). Where both
  !> kinds of points form few runs of neighbours, only the blocks of alpha that these have in common are read.
  subroutine add_displacement(canonical, flexibility, needed, contact, force, u)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: flexibility, force(:)
    logical, intent(in) :: needed(:), contact(:)
    real(dp), intent(inout) :: u(:)
    integer :: top, bottom, first, last, k, n

    n = size(contact)
    ! Taking a datum out of a sum, instead of each term, costs digits if the coefficients differ by little.
    if (count(contact(2:) .neqv. contact(:n - 1)) >= 2*MOST_RUNS .or. abs(canonical%datum) > 0.5_dp*flexibility) then
      do k = 1, n
        if (contact(k)) u = u + (canonical%alpha(:n, k) - canonical%datum)*force(k)
      end do
      return
    end if
    bottom = 0
    do
      call next_run(needed, bottom + 1, top, bottom)
      if (top > n) return
      last = 0
      do
        call next_run(contact, last + 1, first, last)
        if (first > n) exit
        call add_block(canonical%alpha, canonical%datum, top, bottom, first, last, force, u)
      end do
    end do
  end subroutine add_displacement

  !> The displacements of the rows from `top` to `bottom` by the forces from `first` to `last`.
  subroutine add_block(alpha, datum, top, bottom, first, last, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    integer, intent(in) :: top, bottom, first, last
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: u(:)

    call dgemv('N', bottom - top + 1, last - first + 1, 1.0_dp, alpha(top:, first), size(alpha, 1), force(first:), 1, &
               1.0_dp, u(top:), 1)
    u(top:bottom) = u(top:bottom) - datum*sum(force(first:last))
  end subroutine add_block

  !> Gaps of the points that are not at a stop, c = gap + (alpha - datum) f - R q, in extended precision; zero at the
  !> others. All (n) but `motion` (m).
  !>
  !> Between two contact points of a beam a gap may be far smaller than the terms that it consists of.
  pure function extended_gaps(canonical, state, gap, force, motion) result(open_gap)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: gap(:), force(:), motion(:)
    real(dp) :: open_gap(size(state))
    real(xp) :: sums(count(.not. is_at_stop(state)))
    integer :: points(size(sums)), j, k

    points = pack([(k, k=1, size(state))], .not. is_at_stop(state))
    sums = real(gap(points), xp)
    do j = 1, size(motion)
      sums = sums - real(canonical%modes(points, j), xp)*real(motion(j), xp)
    end do
    do j = 1, size(state)
      if (state(j) /= FUGE_OPEN) sums = sums + (real(canonical%alpha(points, j), xp) - real(canonical%datum, xp)) &
                                        *real(force(j), xp)
    end do
    open_gap = 0.0_dp
    open_gap(points) = real(sums, dp)
  end function extended_gaps

end module fuge_row_displacements
