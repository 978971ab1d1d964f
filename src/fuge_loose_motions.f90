!> Rigid motions that some points do not hold.
module fuge_loose_motions
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgeqp3, dorgqr
  implicit none
  private

  public :: find_loose, without_loose

  !> Rows of the modes that differ by less than this part are one.
  real(dp), parameter :: DEPENDENT = 1.0e-12_dp

contains

  !> An orthonormal base of the motions q with R q = 0 at the points `held` (n).
  !>
  !> `modes` R (n, m) with columns of about the same size; `base` (m, number of loose motions).
  subroutine find_loose(modes, held, base)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: held(:)
    real(dp), allocatable, intent(out) :: base(:, :)
    real(dp) :: rows(size(modes, 2), count(held)), whole(size(modes, 2), size(modes, 2))
    real(dp) :: tau(size(modes, 2) + count(held)), work(3*count(held) + 64*(size(modes, 2) + 1))
    integer :: order(count(held)), points(count(held)), j, k, m, p, rank, info

    m = size(modes, 2)
    p = count(held)
    k = min(m, p)
    points = pack([(j, j=1, size(held))], held)
    rows = transpose(modes(points, :))
    order = 0
    rank = 0
    whole = 0.0_dp
    do j = 1, m
      whole(j, j) = 1.0_dp
    end do
    if (k > 0) then
      call dgeqp3(m, p, rows, m, order, tau, work, size(work), info)
      do j = 1, k
        if (abs(rows(j, j)) > DEPENDENT*abs(rows(1, 1))) rank = j
      end do
      whole(:, :k) = rows(:, :k)
      call dorgqr(m, m, k, whole, m, tau, work, size(work), info)
    end if
    base = whole(:, rank + 1:)
  end subroutine find_loose

  !> The motion (m) less its part in the `base` of the loose ones.
  pure function without_loose(motion, base) result(rest)
    real(dp), intent(in) :: motion(:), base(:, :)
    real(dp) :: rest(size(motion))
    integer :: j

    rest = motion
    do j = 1, size(base, 2)
      rest = rest - dot_product(base(:, j), motion)*base(:, j)
    end do
  end function without_loose

end module fuge_loose_motions
