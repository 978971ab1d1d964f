!> LAPACK and BLAS as fuge uses them: the only place that names them.
module fuge_lapack
  use fuge_kinds, only: dp
  implicit none
  private

  public :: dgemv, dpotrf, dsysvx

  interface
    !> y := alpha A x + beta y.
    subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
      import :: dp
      character(len=1), intent(in) :: trans
      integer, intent(in) :: m, n, lda, incx, incy
      real(dp), intent(in) :: alpha, a(lda, *), x(*), beta
      real(dp), intent(inout) :: y(*)
    end subroutine dgemv

    !> Cholesky factor of a symmetric positive definite matrix, blocked.
    subroutine dpotrf(uplo, n, a, lda, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(dp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info
    end subroutine dpotrf

    !> Symmetric indefinite solve with iterative refinement and condition estimate.
    subroutine dsysvx(fact, uplo, n, nrhs, a, lda, af, ldaf, ipiv, b, ldb, x, ldx, rcond, &
                      ferr, berr, work, lwork, iwork, info)
      import :: dp
      character(len=1), intent(in) :: fact, uplo
      integer, intent(in) :: n, nrhs, lda, ldaf, ldb, ldx, lwork
      real(dp), intent(in) :: a(lda, *), b(ldb, *)
      real(dp), intent(inout) :: af(ldaf, *)
      integer, intent(inout) :: ipiv(*)
      real(dp), intent(out) :: x(ldx, *), rcond, ferr(*), berr(*)
      real(dp), intent(inout) :: work(*)
      integer, intent(inout) :: iwork(*)
      integer, intent(out) :: info
    end subroutine dsysvx
  end interface

end module fuge_lapack
