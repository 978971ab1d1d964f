!> Checks of input arrays for NaN and infinity.
module fuge_input_checks
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_FINITE
  implicit none
  private

  public :: check_finite, find_asymmetry, is_finite_everywhere

  !> Refuse NaN and infinity (FUGE_ERR_NOT_FINITE): one value, or the first of an array with its index.
  interface check_finite
    module procedure check_value
    module procedure check_array
  end interface check_finite

  integer, parameter :: int64 = selected_int_kind(18)
  !> Edge of the square tiles in which a matrix is compared with its transpose.
  integer, parameter :: TILE = 64

contains

  !> Are all values finite? Reads the bits of the exponents, in one pass without a
  !> branch, because a comparison with NaN may trap: adding 1 carries only where all of them are set.
  pure function is_finite_everywhere(values) result(finite)
    real(dp), intent(in), contiguous :: values(:)
    logical :: finite
    integer(int64) :: carries
    integer(int64), parameter :: ONE = ishft(1_int64, 51), EXPONENT_BITS = ishft(2047_int64, 51)
    integer :: k

    carries = 0
    do k = 1, size(values)
      ! Shifted by one bit, so that the sign does not overflow.
      carries = ior(carries, iand(ishft(transfer(values(k), carries), -1), EXPONENT_BITS) + ONE)
    end do
    finite = .not. btest(carries, 62)
  end function is_finite_everywhere

  pure subroutine check_value(value, name, info)
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (ieee_is_finite(value)) return
    call report(info, FUGE_ERR_NOT_FINITE, name//' = '//text(value)//' is not a finite number')
  end subroutine check_value

  pure subroutine check_array(values, name, info)
    real(dp), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(values)
      if (ieee_is_finite(values(k))) cycle
      call check_value(values(k), name//'('//index_text(k)//')', info)
      return
    end do
  end subroutine check_array

  !> The coefficients (row, column) and (column, row) of a square matrix that differ most beyond
  !> what is allowed, `tolerance` weight(row) weight(column).
  !>
  !> `matrix` (m, n), m >= n, of which the first n rows count; `weight` (n), not negative.
  !> row > column; both are zero if no difference exceeds what is allowed.
  pure subroutine find_asymmetry(matrix, weight, tolerance, row, column)
    real(dp), intent(in) :: matrix(:, :), weight(:), tolerance
    integer, intent(out) :: row, column
    real(dp) :: difference, largest
    integer :: i, j, first_row, first_column, n

    n = size(matrix, 2)
    row = 0
    column = 0
    largest = 0.0_dp
    ! A tile and its transpose both stay in the cache.
    do first_column = 1, n, TILE
      do first_row = first_column, n, TILE
        do j = first_column, min(first_column + TILE - 1, n)
          do i = max(first_row, j + 1), min(first_row + TILE - 1, n)
            difference = abs(matrix(i, j) - matrix(j, i))
            if (difference <= largest) cycle
            difference = difference - tolerance*weight(i)*weight(j)
            if (difference <= largest) cycle
            largest = difference
            row = i
            column = j
          end do
        end do
      end do
    end do
  end subroutine find_asymmetry

end module fuge_input_checks
