!> Can the contact forces carry the resultant at all?
!>
!> Forces f with R^T f = w, not negative at one-sided points, are the point of a cone:
!> found by non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares
!> Problems, 1974, chapter 23), with at most as many points as there are motions. Where
!> there is none, what remains of w proves it (Farkas): a motion along which no point
!> closes, but the resultant does work.
module fuge_equilibrium
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgelsy
  implicit none
  private

  public :: find_equilibrium

  !> What remains of the resultant below this part of it is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-11_dp
  !> Two points whose columns agree to this in all motions are one.
  real(dp), parameter :: DEPENDENT = 1.0e-13_dp

contains

  !> Forces in equilibrium with the resultant, at few points.
  !>
  !> `modes` (n, m) with columns of about the same size, `resultant` (m), `pushes` (n)
  !> points whose force may be positive, `pulls` (n) negative. Out: `force` (n);
  !> `remainder` (m), zero if there are such forces, otherwise the motion above.
  subroutine find_equilibrium(modes, resultant, pushes, pulls, force, remainder)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    logical, intent(in) :: pushes(:), pulls(:)
    real(dp), intent(out) :: force(:), remainder(:)
    real(dp) :: wanted(size(force)), work(size(force)), size_of_w, way
    integer :: side(size(force)), newest, iteration

    force = 0.0_dp
    side = 0
    remainder = resultant
    size_of_w = maxval(abs(resultant))
    do iteration = 1, 20*(size(modes, 2) + 1) + size(force)
      if (maxval(abs(remainder)) <= ROUNDING*size_of_w) exit
      work = matmul(modes, remainder)
      where (.not. pulls) work = max(work, 0.0_dp)
      where (.not. pushes) work = min(work, 0.0_dp)
      where (side /= 0) work = 0.0_dp
      newest = maxloc(abs(work), dim=1)
      if (abs(work(newest)) <= ROUNDING*maxval(abs(remainder))*sum(abs(modes(newest, :)))) return
      side(newest) = merge(1, -1, work(newest) > 0.0_dp)
      do
        call solve_on(modes, resultant, side, wanted)
        if (all(wanted*side > 0.0_dp .or. side == 0)) exit
        way = step_length(force, wanted, side)
        force = force + way*(wanted - force)
        where (side /= 0 .and. wanted*side <= 0.0_dp .and. abs(force) <= DEPENDENT*maxval(abs(force))) side = 0
        where (side == 0) force = 0.0_dp
        if (way <= 0.0_dp .and. .not. any(side /= 0)) exit
      end do
      force = wanted
      remainder = resultant - matmul(force, modes)
    end do
    remainder = 0.0_dp
  end subroutine find_equilibrium

  !> Least squares forces at the points in use.
  subroutine solve_on(modes, resultant, side, force)
    real(dp), intent(in) :: modes(:, :), resultant(:)
    integer, intent(in) :: side(:)
    real(dp), intent(out) :: force(:)
    real(dp) :: matrix(size(modes, 2), count(side /= 0)), right(max(size(modes, 2), count(side /= 0)))
    real(dp) :: work(64*(size(modes, 2) + count(side /= 0)) + 64)
    integer :: points(count(side /= 0)), order(count(side /= 0)), k, p, m, rank, info

    m = size(modes, 2)
    points = pack([(k, k=1, size(side))], side /= 0)
    p = size(points)
    matrix = transpose(modes(points, :))
    right = 0.0_dp
    right(:m) = resultant
    order = 0
    call dgelsy(m, p, 1, matrix, m, right, size(right), order, DEPENDENT, rank, work, size(work), info)
    force = 0.0_dp
    force(points) = right(:p)
  end subroutine solve_on

  !> The part of the way to the wanted forces until the first changes its sign.
  pure function step_length(force, wanted, side) result(way)
    real(dp), intent(in) :: force(:), wanted(:)
    integer, intent(in) :: side(:)
    real(dp) :: way
    integer :: k

    way = 1.0_dp
    do k = 1, size(force)
      if (side(k) == 0 .or. wanted(k)*side(k) > 0.0_dp) cycle
      if (abs(force(k) - wanted(k)) > 0.0_dp) way = min(way, force(k)/(force(k) - wanted(k)))
    end do
    way = max(way, 0.0_dp)
  end function step_length

end module fuge_equilibrium
