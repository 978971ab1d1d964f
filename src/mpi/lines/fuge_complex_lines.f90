!> Lines of complex numbers, real and imaginary parts in turn: products, and copies from and to tables.
module fuge_complex_lines
  use, intrinsic :: iso_c_binding, only: c_double
  use fuge_kinds, only: dp
  implicit none
  private

  public :: gather_lines, multiply_exchanging, multiply_line, scale_line, scatter_lines

contains

  !> Multiply complex numbers, `z` (real and imaginary parts), by others, `factors` (2, :).
  pure subroutine multiply_line(factors, z)
    real(dp), intent(in), contiguous :: factors(:, :)
    real(c_double), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(factors, 2)
      real_part = z(2*k - 1)*factors(1, k) - z(2*k)*factors(2, k)
      z(2*k) = z(2*k - 1)*factors(2, k) + z(2*k)*factors(1, k)
      z(2*k - 1) = real_part
    end do
  end subroutine multiply_line

  !> Multiply complex numbers, `z` (real and imaginary parts), by one.
  pure subroutine scale_line(factor, z)
    real(dp), intent(in) :: factor(2)
    real(c_double), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(z)/2
      real_part = z(2*k - 1)*factor(1) - z(2*k)*factor(2)
      z(2*k) = z(2*k - 1)*factor(2) + z(2*k)*factor(1)
      z(2*k - 1) = real_part
    end do
  end subroutine scale_line

  !> Multiply complex numbers, `z`, by real ones, and exchange their parts.
  pure subroutine multiply_exchanging(factors, z)
    real(dp), intent(in), contiguous :: factors(:)
    real(c_double), intent(inout), contiguous :: z(:)
    real(dp) :: real_part
    integer :: k

    do k = 1, size(factors)
      real_part = z(2*k - 1)
      z(2*k - 1) = factors(k)*z(2*k)
      z(2*k) = factors(k)*real_part
    end do
  end subroutine multiply_exchanging

  !> `lines` 1 .. count: the rows `first` .. of a table of `rows` by `columns` complex numbers.
  pure subroutine gather_lines(rows, columns, first, count, table, lines)
    integer, intent(in) :: rows, columns, first, count
    real(c_double), intent(in), contiguous :: table(:)
    real(c_double), intent(inout), contiguous :: lines(:, :)
    integer :: begin, j, k

    do k = 1, columns
      begin = 2*((k - 1)*rows + first - 1)
      do j = 1, count
        lines(2*k - 1, j) = table(begin + 2*j - 1)
        lines(2*k, j) = table(begin + 2*j)
      end do
    end do
  end subroutine gather_lines

  !> The reverse of `gather_lines`.
  pure subroutine scatter_lines(rows, columns, first, count, lines, table)
    integer, intent(in) :: rows, columns, first, count
    real(c_double), intent(in), contiguous :: lines(:, :)
    real(c_double), intent(inout), contiguous :: table(:)
    integer :: begin, j, k

    do k = 1, columns
      begin = 2*((k - 1)*rows + first - 1)
      do j = 1, count
        table(begin + 2*j - 1) = lines(2*k - 1, j)
        table(begin + 2*j) = lines(2*k, j)
      end do
    end do
  end subroutine scatter_lines

end module fuge_complex_lines
