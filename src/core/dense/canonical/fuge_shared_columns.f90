!> Columns of a matrix whose rows ranks share: orthonormal ones, and the few rows that span what all rows span.
module fuge_shared_columns
  use fuge_kinds, only: dp
  use fuge_pivoted_qr, only: factorise_pivoted
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: gather_spanning_rows, orthonormalise_shared, swap_columns

contains

  !> Overwrite a matrix by orthonormal columns that span the same space, and count those that are not rounding: that
  !> keep more than `tolerance` of the first one's length beside those before them.
  !>
  !> By Gram-Schmidt orthogonalisation, twice (L. Giraud, J. Langou, M. Rozloznik, The loss of orthogonality in the
  !> Gram-Schmidt orthogonalization process, 2005). `matrix` (rows of this rank, n); `pivoted`: the longest remaining
  !> column comes next, else the columns come in their order; `order` (n): position of each column before.
  subroutine orthonormalise_shared(space, matrix, tolerance, pivoted, order, rank)
    type(point_space), intent(in) :: space
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: pivoted
    integer, intent(out) :: order(:), rank
    real(dp) :: lengths(size(matrix, 2)), first
    integer :: j, k, next, number

    order = [(j, j=1, size(order))]
    rank = 0
    first = 0.0_dp
    do k = 1, size(matrix, 2)
      lengths = [(dot_product(matrix(:, j), matrix(:, j)), j=1, size(lengths))]
      call space%add(lengths)
      next = k
      if (pivoted) next = k - 1 + maxloc(lengths(k:), dim=1)
      if (next /= k) then
        call swap_columns(k, next, matrix)
        number = order(k)
        order(k) = order(next)
        order(next) = number
      end if
      lengths(1) = sqrt(lengths(next))
      if (k == 1) first = lengths(1)
      if (.not. lengths(1) > tolerance*first) return
      matrix(:, k) = matrix(:, k)/lengths(1)
      rank = k
      call project_rest(space, k, matrix)
    end do
  end subroutine orthonormalise_shared

  !> Exchange the columns number `i` and `j`.
  pure subroutine swap_columns(i, j, matrix)
    integer, intent(in) :: i, j
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp) :: value
    integer :: k

    do k = 1, size(matrix, 1)
      value = matrix(k, i)
      matrix(k, i) = matrix(k, j)
      matrix(k, j) = value
    end do
  end subroutine swap_columns

  !> Subtract from the columns behind number `k` their components along those up to it.
  subroutine project_rest(space, k, matrix)
    type(point_space), intent(in) :: space
    integer, intent(in) :: k
    real(dp), intent(inout), contiguous :: matrix(:, :)
    real(dp) :: products(k)
    integer :: i, j, pass

    do j = k + 1, size(matrix, 2)
      do pass = 1, 2
        products = [(dot_product(matrix(:, i), matrix(:, j)), i=1, k)]
        call space%add(products)
        do i = 1, k
          matrix(:, j) = matrix(:, j) - products(i)*matrix(:, i)
        end do
      end do
    end do
  end subroutine project_rest

  !> `spanning` (m, m ranks), the same on all ranks: columns that span what the columns of `rows` (m, :) of all ranks
  !> span, of the size of these. `stat` is not 0 without memory on any of the ranks.
  subroutine gather_spanning_rows(space, rows, spanning, stat)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: rows(:, :)
    real(dp), intent(out) :: spanning(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: factors(:, :)
    real(dp) :: tau(min(size(rows, 1), size(rows, 2))), values(size(spanning))
    integer :: begin, k, m, order(size(rows, 1))

    m = size(rows, 1)
    spanning = 0.0_dp
    begin = m*space%number()
    allocate (factors(size(rows, 2), m), stat=stat)
    if (stat == 0) then
      factors = transpose(rows)
      if (size(tau) > 0) call factorise_pivoted(factors, tau, order, stat)
    end if
    if (stat == 0) then
      do k = 1, size(tau)
        ! Row k of R, its columns in their old places.
        spanning(order(k:), begin + k) = factors(k, k:)
      end do
    end if
    values = reshape(spanning, shape(values))
    call space%add(values)
    spanning = reshape(values, shape(spanning))
    if (.not. space%everywhere(stat == 0)) stat = 1
  end subroutine gather_spanning_rows

end module fuge_shared_columns
