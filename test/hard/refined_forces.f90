!> Forces of a known contact set on a half-plane in quadruple precision, by iterative refinement: the inverse in double
!> precision, residuals in quadruple.
module refined_forces
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgetrf, dgetri
  implicit none
  private

  public :: cell_influence, refine_forces

  !> Each refinement adds some ten digits.
  integer, parameter :: REFINEMENTS = 6

contains

  !> The mean displacement of a cell by a unit force on a cell of width 1 and E* = 1, `apart` cells away, on a
  !> half-plane where displacements are zero at a distance of 2 n cells: an antiderivative of the logarithm,
  !> differenced.
  pure function cell_influence(apart, n) result(influence)
    integer, intent(in) :: apart, n
    real(qp) :: influence
    real(qp), parameter :: PI = acos(-1.0_qp)

    influence = (square_log(apart + 1) - 2*square_log(apart) + square_log(apart - 1)) - 1.5_qp - log(2.0_qp*n)
    influence = -2*influence/PI
  end function cell_influence

  !> x**2 ln |x| / 2.
  pure function square_log(x)
    integer, intent(in) :: x
    real(qp) :: square_log

    square_log = 0
    if (x /= 0) square_log = 0.5_qp*real(x, qp)**2*log(abs(real(x, qp)))
  end function square_log

  !> The forces (k) and the approach of cells in contact, (k): alpha f - approach = -gap, sum f = load.
  subroutine refine_forces(alpha, gap, load, force, approach)
    real(qp), intent(in) :: alpha(:, :), gap(:), load
    real(qp), intent(out) :: force(:), approach
    real(dp) :: inverse(size(gap) + 1, size(gap) + 1), work(64*size(gap) + 64)
    real(qp) :: left(size(gap) + 1)
    integer :: info, k, pivots(size(gap) + 1), step

    k = size(gap)
    inverse(:k, :k) = real(alpha, dp)
    inverse(k + 1, :k) = 1.0_dp
    inverse(:k, k + 1) = -1.0_dp
    inverse(k + 1, k + 1) = 0.0_dp
    call dgetrf(k + 1, k + 1, inverse, k + 1, pivots, info)
    call dgetri(k + 1, inverse, k + 1, pivots, work, size(work), info)
    force = 0
    approach = 0
    do step = 1, REFINEMENTS
      left(:k) = -gap + approach - matmul(alpha, force)
      left(k + 1) = load - sum(force)
      left = matmul(inverse, left)
      force = force + left(:k)
      approach = approach + left(k + 1)
    end do
  end subroutine refine_forces

end module refined_forces
