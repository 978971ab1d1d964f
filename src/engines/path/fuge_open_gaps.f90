!> Elastic displacements of the open points only, which is all that a path needs between two events.
module fuge_open_gaps
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_open_displacement

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
