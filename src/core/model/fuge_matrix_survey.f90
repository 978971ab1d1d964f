!> The survey of an influence matrix in one pass: whether all of it is usable, its extremes, how symmetric it is, and
!> whether any pair of points is unstable.
!>
!> The pass reads each coefficient once, in square tiles together with the tile on the other side of the diagonal. An
!> operator keeps the result, so that a solve has nothing left to check.
module fuge_matrix_survey
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  implicit none
  private

  public :: survey_matrix

  !> A negative energy below this fraction of the coefficients is rounding.
  real(dp), parameter, public :: PAIR_TOLERANCE = 1.0e-12_dp

  integer, parameter :: int64 = selected_int_kind(18)
  !> Edge of the square tiles: two of them stay in the first-level cache.
  integer, parameter :: TILE = 32

  type, public :: matrix_survey
    !> All coefficients are finite, and small enough to be summed. If not, nothing else here is known.
    logical :: is_usable = .false.
    !> Extreme coefficients.
    real(dp) :: least = 0.0_dp, most = 0.0_dp
    !> Largest difference of two coefficients that ought to be equal.
    real(dp) :: asymmetry = 0.0_dp
    !> No pair of opposite forces gains energy.
    logical :: pairs_hold = .false.
  contains
    procedure :: largest
    procedure :: nearest_to_zero
  end type matrix_survey

contains

  !> Survey the first n rows of `alpha` (at least n, n).
  pure subroutine survey_matrix(alpha, survey)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(matrix_survey), intent(out) :: survey
    real(dp) :: tile_here(TILE, TILE), tile_across(TILE, TILE)
    integer(int64) :: mark
    integer :: first_row, first_column, rows, columns, k, n

    n = size(alpha, 2)
    if (n < 1 .or. size(alpha, 1) < n) return
    survey%pairs_hold = .true.
    survey%least = huge(1.0_dp)
    survey%most = -huge(1.0_dp)
    mark = 0
    ! The energies of pairs read the diagonal before its tiles have their turn.
    do k = 1, n
      mark = ior(mark, marked(alpha(k, k)))
    end do
    if (is_marked(mark)) return
    do first_column = 1, n, TILE
      columns = min(TILE, n - first_column + 1)
      do first_row = first_column, n, TILE
        rows = min(TILE, n - first_row + 1)
        call copy_tile(alpha, first_row, first_column, rows, columns, tile_here, mark)
        call copy_transposed(alpha, first_column, first_row, columns, rows, tile_across, mark)
        ! Before anything is compared, because a comparison with NaN may trap.
        if (is_marked(mark)) return
        call survey_tile(alpha, first_row, first_column, rows, columns, tile_here, tile_across, survey)
      end do
    end do
    survey%is_usable = .true.
  end subroutine survey_matrix

  !> A copy of a tile. `mark` collects the exponents, see `marked`.
  pure subroutine copy_tile(alpha, first_row, first_column, rows, columns, tile_out, mark)
    real(dp), intent(in), contiguous :: alpha(:, :)
    integer, intent(in) :: first_row, first_column, rows, columns
    real(dp), intent(inout) :: tile_out(TILE, TILE)
    integer(int64), intent(inout) :: mark
    integer :: i, j

    do j = 1, columns
      do i = 1, rows
        tile_out(i, j) = alpha(first_row + i - 1, first_column + j - 1)
        mark = ior(mark, marked(alpha(first_row + i - 1, first_column + j - 1)))
      end do
    end do
  end subroutine copy_tile

  !> A transposed copy of a tile, which makes row and column of its points lie alike.
  pure subroutine copy_transposed(alpha, first_row, first_column, rows, columns, tile_out, mark)
    real(dp), intent(in), contiguous :: alpha(:, :)
    integer, intent(in) :: first_row, first_column, rows, columns
    real(dp), intent(inout) :: tile_out(TILE, TILE)
    integer(int64), intent(inout) :: mark
    integer :: i, j

    do j = 1, columns
      do i = 1, rows
        mark = ior(mark, marked(alpha(first_row + i - 1, first_column + j - 1)))
      end do
      do i = 1, rows
        tile_out(j, i) = alpha(first_row + i - 1, first_column + j - 1)
      end do
    end do
  end subroutine copy_transposed

  !> Bits of which the last but one is set if the value is not finite or beyond LARGEST_EXPONENT: its biased exponent
  !> is moved up until those overflow its eleven bits. Integers, because they cannot trap.
  elemental function marked(value) result(bits)
    real(dp), intent(in) :: value
    integer(int64) :: bits
    integer(int64), parameter :: EXPONENT_BITS = ishft(2047_int64, 51)
    integer(int64), parameter :: OFFSET = ishft(2048_int64 - int(LARGEST_EXPONENT + 1023, int64), 51)

    bits = iand(ishft(transfer(value, bits), -1), EXPONENT_BITS) + OFFSET
  end function marked

  pure function is_marked(mark)
    integer(int64), intent(in) :: mark
    logical :: is_marked

    is_marked = btest(mark, 62)
  end function is_marked

  !> Extremes and pairs from the half below the diagonal: the other half differs by the asymmetry only.
  pure subroutine survey_tile(alpha, first_row, first_column, rows, columns, here, across, survey)
    real(dp), intent(in), contiguous :: alpha(:, :)
    integer, intent(in) :: first_row, first_column, rows, columns
    real(dp), intent(in) :: here(TILE, TILE), across(TILE, TILE)
    type(matrix_survey), intent(inout) :: survey
    real(dp) :: least, most, asymmetry, row_energy(TILE), column_energy(TILE)
    integer :: below, i, j

    least = survey%least
    most = -huge(most)
    asymmetry = survey%asymmetry
    do j = 1, columns
      below = merge(j + 1, 1, first_row == first_column)
      do i = below, rows
        least = min(least, here(i, j))
        most = max(most, here(i, j))
        asymmetry = max(asymmetry, abs(here(i, j) - across(i, j)))
      end do
    end do
    survey%least = least
    survey%most = max(survey%most, most)
    survey%asymmetry = asymmetry
    do i = 1, rows
      row_energy(i) = tolerated(alpha(first_row + i - 1, first_row + i - 1))
    end do
    do j = 1, columns
      column_energy(j) = tolerated(alpha(first_column + j - 1, first_column + j - 1))
      if (first_row /= first_column) cycle
      survey%least = min(survey%least, here(j, j))
      survey%most = max(survey%most, here(j, j))
    end do
    ! The largest coefficient beside the diagonal settles most tiles.
    if (most <= 0.5_dp*(minval(row_energy(:rows)) + minval(column_energy(:columns)))) return
    do j = 1, columns
      below = merge(j + 1, 1, first_row == first_column)
      if (any(2.0_dp*here(below:rows, j) - row_energy(below:rows) > column_energy(j))) survey%pairs_hold = .false.
    end do
  end subroutine survey_tile

  !> The contribution of a point to the energy of a pair, rounding included.
  elemental function tolerated(own)
    real(dp), intent(in) :: own
    real(dp) :: tolerated

    tolerated = own + PAIR_TOLERANCE*abs(own)
  end function tolerated

  !> The largest coefficient without its sign.
  pure function largest(self)
    class(matrix_survey), intent(in) :: self
    real(dp) :: largest

    largest = max(abs(self%least), abs(self%most))
  end function largest

  !> The coefficient nearest to zero, or 0 if there are both signs: subtracting it from the coefficients costs no
  !> digits.
  pure function nearest_to_zero(self) result(datum)
    class(matrix_survey), intent(in) :: self
    real(dp) :: datum

    datum = max(self%least, 0.0_dp) + min(self%most, 0.0_dp)
  end function nearest_to_zero

end module fuge_matrix_survey
