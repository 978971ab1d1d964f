!> A proof that a symmetric matrix is positive definite.
!>
!> If the Cholesky factorisation of B - s I ends in floating point, B - s I + E is positive definite for an E whose norm
!> is at most gamma(p + 1)/(1 - gamma(p + 1)) of the trace, so B is for a larger s (S. M. Rump, Verification of positive
!> definiteness, BIT 46, 2006).
module fuge_verified_definite
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf
  use fuge_rounding_bounds, only: gamma_bound, raised, LEAST, UNIT_ROUNDOFF
  implicit none
  private

  public :: prove_definite

contains

  !> Is every symmetric matrix positive definite whose lower triangle is within an error of the 2-norm `error` of
  !> that of `matrix` (p, p)? Its upper triangle is not read, the lower one is lost. `lowest` is then not above any
  !> eigenvalue: a larger `margin` > 1, by default 1, proves a larger one of fewer matrices.
  subroutine prove_definite(matrix, error, is_proved, margin, lowest)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(in) :: error
    logical, intent(out) :: is_proved
    real(dp), intent(in), optional :: margin
    real(dp), intent(out), optional :: lowest
    real(dp) :: factor, rounding, shift, trace
    integer :: info, k, p

    p = size(matrix, 1)
    is_proved = .true.
    if (present(lowest)) lowest = 1.0_dp
    if (p < 1) return
    trace = 0.0_dp
    do k = 1, p
      trace = trace + max(matrix(k, k), 0.0_dp)
    end do
    ! Twice the bound of the factorisation: blocks divide by reciprocals. The subtraction rounds, too.
    rounding = raised(2.0_dp*gamma_bound(p + 4)*raised(trace, p), 4)
    rounding = raised(rounding + 4.0_dp*UNIT_ROUNDOFF*(trace + error + 2.0_dp*rounding), 4) + LEAST
    factor = 1.0_dp
    if (present(margin)) factor = margin
    shift = raised(factor*rounding + error, 3)
    if (present(lowest)) lowest = 0.99_dp*(factor - 1.0_dp)*rounding
    do k = 1, p
      matrix(k, k) = matrix(k, k) - shift
    end do
    call dpotrf('L', p, matrix, p, info)
    is_proved = info == 0
    do k = 1, p
      ! A NaN may pass a factorisation.
      is_proved = is_proved .and. matrix(k, k) > 0.0_dp .and. matrix(k, k) <= huge(1.0_dp)
    end do
  end subroutine prove_definite

end module fuge_verified_definite
