!> QR factors with column pivoting, A P = Q R, and the decision on the rank of A from them.
!>
!> By LAPACK's dgeqp3: the factors overwrite A, R in the upper triangle and the reflectors that
!> make Q below it. The diagonal of R does not increase, so a small entry ends the independent
!> columns. Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 2013, section 5.4.
module fuge_pivoted_qr
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgeqp3, dorgqr
  implicit none
  private

  public :: combine_independent, factorise_pivoted, numerical_rank, orthogonal_complement, orthonormalise, &
    orthonormalise_in_order

  !> LAPACK transforms at most this many columns at a time.
  integer, parameter :: LARGEST_BLOCK = 64

contains

  !> Overwrite a matrix by its pivoted QR factors.
  !>
  !> `matrix` (m, n); `tau` (min(m, n)): factors of the reflectors; `order` (n): column k of
  !> A P is column order(k) of A. `status` is not zero without memory.
  subroutine factorise_pivoted(matrix, tau, order, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(out) :: tau(:)
    integer, intent(out) :: order(:), status

    ! For dgeqp3, zero marks a column that may be moved.
    order = 0
    call factorise(matrix, tau, order, status)
  end subroutine factorise_pivoted

  !> dgeqp3 with its workspace; columns with order /= 0 on entry stay in front.
  subroutine factorise(matrix, tau, order, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(out) :: tau(:)
    integer, intent(inout) :: order(:)
    integer, intent(out) :: status
    real(dp), allocatable :: work(:)
    integer :: m, n

    m = size(matrix, 1)
    n = size(matrix, 2)
    status = 0
    if (min(m, n) < 1) return
    allocate (work(2*n + (n + 1)*min(m, n, LARGEST_BLOCK)), stat=status)
    if (status == 0) call dgeqp3(m, n, matrix, m, order, tau, work, size(work), status)
  end subroutine factorise

  !> Number of independent columns: up to the last k with
  !> abs(R(k, k)) > max(`relative` abs(R(1, 1)), `absolute`).
  !>
  !> `factors` (m, n) as `factorise_pivoted` returns them.
  pure function numerical_rank(factors, relative, absolute) result(rank)
    real(dp), intent(in) :: factors(:, :), relative, absolute
    integer :: rank
    integer :: k

    rank = 0
    do k = 1, minval(shape(factors))
      if (abs(factors(k, k)) > max(relative*abs(factors(1, 1)), absolute)) rank = k
    end do
  end function numerical_rank

  !> Each dependent column as a combination of the independent ones, R_1^-1 R_2 with
  !> R = (R_1 R_2): column order(rank + k) is the sum over i of
  !> coefficients(i, k) times column order(i).
  !>
  !> `factors` (m, n) as `factorise_pivoted` returns them; `coefficients` (rank, n - rank).
  pure subroutine combine_independent(factors, rank, coefficients)
    real(dp), intent(in) :: factors(:, :)
    integer, intent(in) :: rank
    real(dp), intent(out) :: coefficients(:, :)
    integer :: i, k

    do k = 1, size(coefficients, 2)
      coefficients(:, k) = factors(:rank, rank + k)
      do i = rank, 1, -1
        coefficients(i, k) = coefficients(i, k)/factors(i, i)
        coefficients(:i - 1, k) = coefficients(:i - 1, k) - factors(:i - 1, i)*coefficients(i, k)
      end do
    end do
  end subroutine combine_independent

  !> Overwrite a matrix by orthonormal columns that span the same space, and count those that
  !> are not rounding: diagonal entries of R above `tolerance` times the first one.
  !>
  !> `matrix` (m, n); with m < n, when no orthonormal columns exist, it is left with the
  !> factors. `order` (n): position of each column before pivoting. `status` is not zero without
  !> memory.
  subroutine orthonormalise(matrix, tolerance, order, rank, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(in) :: tolerance
    integer, intent(out) :: order(:), rank, status
    real(dp) :: tau(size(matrix, 2))

    rank = 0
    call factorise_pivoted(matrix, tau, order, status)
    if (status /= 0) return
    rank = numerical_rank(matrix, tolerance, 0.0_dp)
    if (size(matrix, 1) >= size(matrix, 2)) call form_orthogonal(matrix, tau, size(matrix, 2), status)
  end subroutine orthonormalise

  !> Overwrite a matrix by orthonormal columns, of which the first k span the first k columns
  !> of the matrix.
  !>
  !> `matrix` (m, n), m >= n, of full rank. `status` is not zero without memory.
  subroutine orthonormalise_in_order(matrix, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    integer, intent(out) :: status
    real(dp) :: tau(size(matrix, 2))
    integer :: order(size(matrix, 2))

    order = 1
    call factorise(matrix, tau, order, status)
    if (status == 0) call form_orthogonal(matrix, tau, size(matrix, 2), status)
  end subroutine orthonormalise_in_order

  !> The vectors q that are orthogonal to all columns of a matrix A: the null space of A^T.
  !>
  !> `matrix` (m, n), overwritten by its factors; its rank is decided with `tolerance` as in
  !> `orthonormalise`. `basis` (m, m - rank), orthonormal. `status` is not zero without memory;
  !> `basis` then has no columns.
  subroutine orthogonal_complement(matrix, tolerance, basis, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(in) :: tolerance
    real(dp), allocatable, intent(out) :: basis(:, :)
    integer, intent(out) :: status
    real(dp), allocatable :: orthogonal(:, :)
    real(dp) :: tau(minval(shape(matrix)))
    integer, allocatable :: order(:)
    integer :: first, j, m, reflectors

    m = size(matrix, 1)
    reflectors = size(tau)
    allocate (orthogonal(m, m), order(size(matrix, 2)), stat=status)
    if (status /= 0) then
      allocate (basis(m, 0))
      return
    end if
    call factorise_pivoted(matrix, tau, order, status)
    orthogonal = 0.0_dp
    do j = 1, m
      orthogonal(j, j) = 1.0_dp
    end do
    orthogonal(:, :reflectors) = matrix(:, :reflectors)
    if (status == 0) call form_orthogonal(orthogonal, tau, reflectors, status)
    first = numerical_rank(matrix, tolerance, 0.0_dp) + 1
    if (status == 0) allocate (basis(m, m - first + 1), stat=status)
    if (status == 0) then
      basis(:, :) = orthogonal(:, first:)
    else if (.not. allocated(basis)) then
      allocate (basis(m, 0))
    end if
  end subroutine orthogonal_complement

  !> Overwrite reflectors, the first `reflectors` columns of `matrix`, by the columns of Q.
  subroutine form_orthogonal(matrix, tau, reflectors, status)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(in) :: tau(:)
    integer, intent(in) :: reflectors
    integer, intent(out) :: status
    real(dp), allocatable :: work(:)
    integer :: m, n

    m = size(matrix, 1)
    n = size(matrix, 2)
    status = 0
    if (reflectors < 1) return
    allocate (work(n*min(n, LARGEST_BLOCK)), stat=status)
    if (status == 0) call dorgqr(m, n, reflectors, matrix, m, tau, work, size(work), status)
  end subroutine form_orthogonal

end module fuge_pivoted_qr
