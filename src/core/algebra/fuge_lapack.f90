!> Interfaces of LAPACK and BLAS; the only module that names their procedures.
module fuge_lapack
  use fuge_kinds, only: dp
  implicit none
  private

  public :: ddot, dgelsy, dgemm, dgemv, dgeqp3, dgesv, dgetrf, dgetri, dorgqr, dpbtrf, dpbtrs, dpotrf, dpotri, &
    dpotrs, dpttrs, dsyev, dsymv, dsyrk, dsytrf, dsytrs, dtrsm, dtrsv

  interface
    !> x.y.
    function ddot(n, x, incx, y, incy) result(product)
      import :: dp
      integer, intent(in) :: n, incx, incy
      real(dp), intent(in) :: x(*), y(*)
      real(dp) :: product
    end function ddot

    !> Least-squares solution of least norm, by a complete orthogonal factorisation.
    subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
      import :: dp
      integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
      real(dp), intent(in) :: rcond
      real(dp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
      integer, intent(inout) :: jpvt(*)
      integer, intent(out) :: rank, info
    end subroutine dgelsy

    !> C := alpha A B + beta C.
    subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
      import :: dp
      character(len=1), intent(in) :: transa, transb
      integer, intent(in) :: m, n, k, lda, ldb, ldc
      real(dp), intent(in) :: alpha, a(lda, *), b(ldb, *), beta
      real(dp), intent(inout) :: c(ldc, *)
    end subroutine dgemm

    !> QR factorisation with column pivoting, A P = Q R.
    subroutine dgeqp3(m, n, a, lda, jpvt, tau, work, lwork, info)
      import :: dp
      integer, intent(in) :: m, n, lda, lwork
      real(dp), intent(inout) :: a(lda, *), work(*)
      integer, intent(inout) :: jpvt(*)
      real(dp), intent(out) :: tau(*)
      integer, intent(out) :: info
    end subroutine dgeqp3

    !> Solve A X = B by Gaussian elimination with partial pivoting.
    subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: dp
      integer, intent(in) :: n, nrhs, lda, ldb
      real(dp), intent(inout) :: a(lda, *), b(ldb, *)
      integer, intent(out) :: ipiv(*), info
    end subroutine dgesv

    !> LU factors of a matrix, with partial pivoting.
    subroutine dgetrf(m, n, a, lda, ipiv, info)
      import :: dp
      integer, intent(in) :: m, n, lda
      real(dp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*), info
    end subroutine dgetrf

    !> The inverse from the LU factors.
    subroutine dgetri(n, a, lda, ipiv, work, lwork, info)
      import :: dp
      integer, intent(in) :: n, lda, lwork, ipiv(*)
      real(dp), intent(inout) :: a(lda, *), work(*)
      integer, intent(out) :: info
    end subroutine dgetri

    !> The first columns of Q from its reflectors.
    subroutine dorgqr(m, n, k, a, lda, tau, work, lwork, info)
      import :: dp
      integer, intent(in) :: m, n, k, lda, lwork
      real(dp), intent(in) :: tau(*)
      real(dp), intent(inout) :: a(lda, *), work(*)
      integer, intent(out) :: info
    end subroutine dorgqr

    !> y := alpha A x + beta y.
    subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
      import :: dp
      character(len=1), intent(in) :: trans
      integer, intent(in) :: m, n, lda, incx, incy
      real(dp), intent(in) :: alpha, a(lda, *), x(*), beta
      real(dp), intent(inout) :: y(*)
    end subroutine dgemv

    !> Cholesky factor of a symmetric positive definite band matrix.
    subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, kd, ldab
      real(dp), intent(inout) :: ab(ldab, *)
      integer, intent(out) :: info
    end subroutine dpbtrf

    !> Solve with the factor of `dpbtrf`.
    subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, kd, nrhs, ldab, ldb
      real(dp), intent(in) :: ab(ldab, *)
      real(dp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dpbtrs

    !> Cholesky factor of a symmetric positive definite matrix.
    subroutine dpotrf(uplo, n, a, lda, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(dp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info
    end subroutine dpotrf

    !> Inverse from the factor of `dpotrf`, one triangle.
    subroutine dpotri(uplo, n, a, lda, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(dp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info
    end subroutine dpotri

    !> Solve with the factor of `dpotrf`.
    subroutine dpotrs(uplo, n, nrhs, a, lda, b, ldb, info)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(dp), intent(in) :: a(lda, *)
      real(dp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dpotrs

    !> Solve with the factors L D L^T of a symmetric positive definite tridiagonal matrix: `d` (n) the diagonal of D,
    !> `e` (n - 1) the elements of L below its unit diagonal.
    subroutine dpttrs(n, nrhs, d, e, b, ldb, info)
      import :: dp
      integer, intent(in) :: n, nrhs, ldb
      real(dp), intent(in) :: d(*), e(*)
      real(dp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dpttrs

    !> Eigenvalues, ascending, and eigenvectors of a symmetric matrix.
    subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      import :: dp
      character(len=1), intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(dp), intent(inout) :: a(lda, *)
      real(dp), intent(out) :: w(*), work(*)
      integer, intent(out) :: info
    end subroutine dsyev

    !> y := alpha A x + beta y for a symmetric A, of which one triangle is read.
    subroutine dsymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
      import :: dp
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, lda, incx, incy
      real(dp), intent(in) :: alpha, a(lda, *), x(*), beta
      real(dp), intent(inout) :: y(*)
    end subroutine dsymv

    !> C := alpha A^T A + beta C (trans = 'T'), one triangle of C.
    subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
      import :: dp
      character(len=1), intent(in) :: uplo, trans
      integer, intent(in) :: n, k, lda, ldc
      real(dp), intent(in) :: alpha, a(lda, *), beta
      real(dp), intent(inout) :: c(ldc, *)
    end subroutine dsyrk

    !> Bunch-Kaufman factor of a symmetric indefinite matrix.
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
