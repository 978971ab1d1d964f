!> Matrices that several hard scenes share.
module hard_matrices
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge, only: dp => fuge_dp, fuge_halfplane_matrix, fuge_info, FUGE_MEAN
  use fuge_halfplane_influence, only: mean_log
  use general_reference, only: integers
  implicit none
  private

  public :: halfplane, integer_bed, cell_middles, overlapping_halfplane, ring_of_springs, string, tridiagonal

contains

  !> The half-plane of plane modulus 1: mean displacements of cells with uniform pressure.
  pure function halfplane(x, width) result(alpha)
    real(dp), intent(in) :: x(:), width
    real(dp) :: alpha(size(x), size(x))
    type(fuge_info) :: info

    call fuge_halfplane_matrix(x, spread(width, 1, size(x)), 1.0_dp, FUGE_MEAN, alpha, info)
  end function halfplane

  !> The same for cells that overlap, which fuge_halfplane_matrix refuses; `x` ascending.
  pure function overlapping_halfplane(x, width) result(alpha)
    real(dp), intent(in) :: x(:), width
    real(dp) :: alpha(size(x), size(x))
    integer :: j

    do j = 1, size(x)
      alpha(:, j) = -2.0_dp/acos(-1.0_dp)*(mean_log(x - x(j), width, width) - log(2.0_dp*(x(size(x)) - x(1) + width)))
    end do
  end function overlapping_halfplane

  !> The middles of n cells around 0.
  pure function cell_middles(n, spacing) result(x)
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing
    real(dp) :: x(n)
    integer :: k

    x = [(spacing*(real(k, dp) - 0.5_dp*real(n + 1, dp)), k=1, n)]
  end function cell_middles

  !> A stretched string: alpha falls linearly with the distance, in whole numbers where x and `top` are whole.
  pure function string(x, top) result(alpha)
    real(dp), intent(in) :: x(:), top
    real(dp) :: alpha(size(x), size(x))
    integer :: j

    do j = 1, size(x)
      alpha(:, j) = top - abs(x - x(j))
    end do
  end function string

  !> A ring of springs, each of which also displaces 7 neighbours on either side.
  pure function ring_of_springs(n) result(alpha)
    integer, intent(in) :: n
    real(dp) :: alpha(n, n)
    integer :: i, j, distance

    do j = 1, n
      do i = 1, n
        distance = min(abs(i - j), n - abs(i - j))
        alpha(i, j) = real(max(0, 8 - distance) + merge(1, 0, i == j), dp)
      end do
    end do
  end function ring_of_springs

  !> 2 on the diagonal, -1 beside it.
  pure function tridiagonal(n) result(alpha)
    integer, intent(in) :: n
    real(dp) :: alpha(n, n)
    integer :: i, j

    do j = 1, n
      alpha(:, j) = [(real(merge(2, merge(-1, 0, abs(i - j) == 1), i == j), dp), i=1, n)]
    end do
  end function tridiagonal

  !> B B^T + n I, where B has random whole numbers from -2 to 2.
  pure function integer_bed(n, start) result(alpha)
    integer, intent(in) :: n
    integer(int64), intent(in) :: start
    real(dp) :: alpha(n, n), b(n, n)
    integer(int64) :: seed
    integer :: k

    seed = start
    do k = 1, n
      call integers(seed, -2, 2, b(:, k))
    end do
    alpha = matmul(b, transpose(b))
    do k = 1, n
      alpha(k, k) = alpha(k, k) + real(n, dp)
    end do
  end function integer_bed

end module hard_matrices
