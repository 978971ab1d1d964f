!> Elastic displacements of the open points only, which is all that a path needs between two events.
module fuge_open_gaps
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp, xp
  implicit none
  private

  public :: add_open_displacement, extended_open_gaps

contains

  !> u := u + (alpha - datum) f at the open points, and anything at the others.
  !>
  !> `state`, `force` and `u` (n). The open points are taken in runs of neighbours, because alpha is read by columns.
  pure subroutine add_open_displacement(canonical, state, force, u)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: u(:)
    integer :: points(count(state /= FUGE_OPEN)), first, k, last, n

    n = size(state)
    points = pack([(k, k=1, n)], state /= FUGE_OPEN)
    if (2*size(points) < n .or. number_of_runs(state) > 8) then
      call add_rows(canonical%alpha, canonical%datum, 1, n, points, force, u)
      return
    end if
    last = 0
    do
      first = last + 1
      do while (first <= n)
        if (state(first) == FUGE_OPEN) exit
        first = first + 1
      end do
      if (first > n) return
      last = first
      do while (last < n)
        if (state(last + 1) /= FUGE_OPEN) exit
        last = last + 1
      end do
      call add_rows(canonical%alpha, canonical%datum, first, last, points, force, u)
    end do
  end subroutine add_open_displacement

  !> Gaps of the open points, c = gap + (alpha - datum) f - R q, in extended precision; zero at the others. All (n) but
  !> `motion` (m).
  !>
  !> Between two contact points of a beam a gap may be far smaller than the terms that it consists of.
  pure function extended_open_gaps(canonical, state, gap, force, motion) result(open_gap)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: gap(:), force(:), motion(:)
    real(dp) :: open_gap(size(state))
    real(xp) :: sums(count(state == FUGE_OPEN))
    integer :: points(size(sums)), j, k

    points = pack([(k, k=1, size(state))], state == FUGE_OPEN)
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
  end function extended_open_gaps

  !> Runs of open points.
  pure function number_of_runs(state) result(runs)
    integer, intent(in) :: state(:)
    integer :: runs
    integer :: k

    runs = merge(1, 0, state(1) == FUGE_OPEN)
    do k = 2, size(state)
      if (state(k) == FUGE_OPEN .and. state(k - 1) /= FUGE_OPEN) runs = runs + 1
    end do
  end function number_of_runs

  !> The contributions of the forces at `points` to the rows from `first` to `last`.
  pure subroutine add_rows(alpha, datum, first, last, points, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    integer, intent(in) :: first, last, points(:)
    real(dp), intent(inout) :: u(:)
    integer :: i, j

    do j = 1, size(points) - 3, 4
      associate (a => points(j), b => points(j + 1), c => points(j + 2), d => points(j + 3))
        do i = first, last
          u(i) = u(i) + (((alpha(i, a) - datum)*force(a) + (alpha(i, b) - datum)*force(b)) &
                         + ((alpha(i, c) - datum)*force(c) + (alpha(i, d) - datum)*force(d)))
        end do
      end associate
    end do
    do j = size(points) - modulo(size(points), 4) + 1, size(points)
      do i = first, last
        u(i) = u(i) + (alpha(i, points(j)) - datum)*force(points(j))
      end do
    end do
  end subroutine add_rows

end module fuge_open_gaps
