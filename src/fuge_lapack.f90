!> LAPACK and BLAS as fuge uses them: the only place that names them.
module fuge_lapack
  use fuge_kinds, only: dp
  implicit none
  private

  public :: dgemv, dpotrf, dsyrk, dsytrf, dsytrs, dtrsm, dtrsv

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

    !> C := alpha A^T A + beta C (trans = 'T'), one triangle.
    subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
      import :: dp
      character(len=1), intent(in) :: uplo, trans
      integer, intent(in) :: n, k, lda, ldc
      real(dp), intent(in) :: alpha, a(lda, *), beta
      real(dp), intent(inout) :: c(ldc, *)
    end subroutine dsyrk

    !> Factor of a symmetric indefinite matrix.
    subroutine dsytrf(uplo, n, a, lda, ipiv, work, lwork, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, lda, lwork
      real(dp), intent(inout) :: a(lda, *), work(*)
      integer, intent(out) :: ipiv(*), info
    end subroutine dsytrf

    !> Solve with the factor of `dsytrf`.
    subroutine dsytrs(uplo, n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ipiv(*), ldb
      real(dp), intent(in) :: a(lda, *)
      real(dp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dsytrs

    !> B := alpha inv(A) B for a triangular A.
    subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
      import :: dp
      character(len=1), intent(in) :: side, uplo, transa, diag
      integer, intent(in) :: m, n, lda, ldb
      real(dp), intent(in) :: alpha, a(lda, *)
      real(dp), intent(inout) :: b(ldb, *)
    end subroutine dtrsm

    !> x := inv(A) x for a triangular A.
    subroutine dtrsv(uplo, trans, diag, n, a, lda, x, incx)
      import :: dp
      character(len=1), intent(in) :: uplo, trans, diag
      integer, intent(in) :: n, lda, incx
      real(dp), intent(in) :: a(lda, *)
      real(dp), intent(inout) :: x(*)
    end subroutine dtrsv
  end interface

end module fuge_lapack
