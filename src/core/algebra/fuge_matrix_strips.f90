!> The pass of `fuge_matrix_survey`, whose strips of columns are shared by threads.
submodule(fuge_matrix_survey) fuge_matrix_strips
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_threads, only: run_in_parts, work_in_parts
  implicit none

  integer, parameter :: int64 = selected_int_kind(18)
  !> Edge of the square tiles, of which two stay in the first-level cache; as many columns are the work of one part.
  integer, parameter :: TILE = 32
  !> Numbers of a column that are looked at side by side.
  integer, parameter :: LANES = 8
  !> Threads share the survey of matrices with as many points as this.
  integer, parameter :: MANY_POINTS = 512
  !> The bits of a number but for its sign, and those of the largest number that is small enough to be summed.
  integer(int64), parameter :: MAGNITUDE_BITS = not(ishft(1_int64, 63))
  integer(int64), parameter :: LARGEST_BITS = ishft(int(LARGEST_EXPONENT + 1023, int64), 52) - 1

  !> The survey of each strip of columns, with the rows from its diagonal on.
  type, extends(work_in_parts) :: strip_surveys
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    !> The contribution of each point to the energy of a pair, (n).
    real(dp), allocatable :: energy(:)
    type(matrix_survey), allocatable :: strips(:)
  contains
    procedure :: do_part => survey_part
  end type strip_surveys

contains

  module procedure survey_matrix
    type(strip_surveys) :: work
    integer :: k, n

    n = size(alpha, 2)
    if (n < 1 .or. size(alpha, 1) < n) return
    allocate (work%energy(n))
    do k = 1, n
      if (is_too_large(alpha(k, k))) return
      work%energy(k) = tolerated(alpha(k, k))
    end do
    survey = empty_survey()
    if (n < MANY_POINTS) then
      do k = 1, n, TILE
        call survey_strip(size(alpha, 1), n, alpha, work%energy, k, survey)
        if (.not. survey%is_usable) return
      end do
    else
      work%alpha => alpha
      allocate (work%strips((n + TILE - 1)/TILE))
      call run_in_parts(size(work%strips), work)
      do k = 1, size(work%strips)
        call join(work%strips(k), survey)
      end do
    end if
  end procedure survey_matrix

  subroutine survey_part(self, part, parts)
    class(strip_surveys), intent(inout) :: self
    integer, intent(in) :: part, parts

    if (part >= parts) return
    self%strips(part + 1) = empty_survey()
    call survey_strip(size(self%alpha, 1), size(self%alpha, 2), self%alpha, self%energy, TILE*part + 1, &
                      self%strips(part + 1))
  end subroutine survey_part

  !> The survey of no coefficients.
  pure function empty_survey() result(survey)
    type(matrix_survey) :: survey

    survey%is_usable = .true.
    survey%pairs_hold = .true.
    survey%least = huge(1.0_dp)
    survey%most = -huge(1.0_dp)
  end function empty_survey

  !> Add the survey of a part to that of the whole.
  pure subroutine join(part, whole)
    type(matrix_survey), intent(in) :: part
    type(matrix_survey), intent(inout) :: whole

    whole%is_usable = whole%is_usable .and. part%is_usable
    whole%pairs_hold = whole%pairs_hold .and. part%pairs_hold
    whole%least = min(whole%least, part%least)
    whole%most = max(whole%most, part%most)
    whole%asymmetry = max(whole%asymmetry, part%asymmetry)
  end subroutine join

  !> Add the strip of columns from `first` on to a survey.
  pure subroutine survey_strip(lda, n, alpha, energy, first, survey)
    integer, intent(in) :: lda, n, first
    real(dp), intent(in) :: alpha(lda, n), energy(n)
    type(matrix_survey), intent(inout) :: survey
    type(matrix_survey) :: part
    integer :: columns, row, rows

    columns = min(TILE, n - first + 1)
    if (columns == TILE) then
      call survey_diagonal_tile(lda, alpha(first, first), energy(first:first + TILE - 1), part)
    else
      call survey_last_tile(columns, lda, alpha(first, first), energy(first:), part)
    end if
    call join(part, survey)
    do row = first + columns, n, TILE
      if (.not. survey%is_usable) return
      rows = min(TILE, n - row + 1)
      if (rows == TILE) then
        call survey_tile(lda, alpha(row, first), alpha(first, row), part)
      else
        call survey_piece(rows, columns, lda, alpha(row, first), alpha(first, row), part)
      end if
      if (part%is_usable) then
        ! The largest coefficient settles most tiles.
        if (part%most > 0.5_dp*(minval(energy(row:row + rows - 1)) + minval(energy(first:first + columns - 1)))) then
          call judge_pairs(rows, columns, lda, alpha(row, first), energy(row:row + rows - 1), &
                           energy(first:first + columns - 1), part)
        end if
      end if
      call join(part, survey)
    end do
  end subroutine survey_strip

  !> The survey of a tile on the diagonal, with extremes and pairs from its lower half.
  pure subroutine survey_diagonal_tile(lda, here, energy, survey)
    integer, intent(in) :: lda
    real(dp), intent(in) :: here(lda, TILE), energy(TILE)
    type(matrix_survey), intent(out) :: survey
    real(dp) :: beside(TILE, TILE)
    integer :: j

    survey = empty_survey()
    call check_tile(lda, here, survey%is_usable)
    if (.not. survey%is_usable) return
    beside = here(:TILE, :)
    if (is_different(lda, here, here)) then
      survey%asymmetry = asymmetry_of(lda, here, here)
      do j = 2, TILE
        beside(:j - 1, j) = beside(j, :j - 1)
      end do
    end if
    do j = 1, TILE
      beside(j, j) = beside(2, 1)
    end do
    call find_extremes(TILE, beside, survey%least, survey%most)
    if (survey%most > minval(energy)) call judge_pairs(TILE, TILE, TILE, beside, energy, energy, survey)
    do j = 1, TILE
      survey%least = min(survey%least, here(j, j))
      survey%most = max(survey%most, here(j, j))
    end do
  end subroutine survey_diagonal_tile

  !> As `survey_diagonal_tile`, of the last tile on the diagonal, (n, n).
  pure subroutine survey_last_tile(n, lda, here, energy, survey)
    integer, intent(in) :: n, lda
    real(dp), intent(in) :: here(lda, n), energy(n)
    type(matrix_survey), intent(out) :: survey
    integer :: i, j
    real(dp) :: least, most, asymmetry

    survey = empty_survey()
    ! Before anything is compared, because a comparison with NaN may trap.
    do j = 1, n
      do i = 1, n
        if (is_too_large(here(i, j))) survey%is_usable = .false.
      end do
    end do
    if (.not. survey%is_usable) return
    least = here(1, 1)
    most = here(1, 1)
    asymmetry = 0.0_dp
    do j = 1, n
      least = min(least, here(j, j))
      most = max(most, here(j, j))
      do i = j + 1, n
        least = min(least, here(i, j))
        most = max(most, here(i, j))
        asymmetry = max(asymmetry, abs(here(i, j) - here(j, i)))
        if (2.0_dp*here(i, j) - energy(i) > energy(j)) survey%pairs_hold = .false.
      end do
    end do
    survey%least = least
    survey%most = most
    survey%asymmetry = asymmetry
  end subroutine survey_last_tile

  !> The survey of what is left of a tile at the end of the columns, `across` the one on the other side of the diagonal;
  !> without pairs.
  pure subroutine survey_piece(rows, columns, lda, here, across, survey)
    integer, intent(in) :: rows, columns, lda
    real(dp), intent(in) :: here(lda, columns), across(lda, rows)
    type(matrix_survey), intent(out) :: survey
    integer :: i, j
    real(dp) :: least, most, asymmetry

    survey = empty_survey()
    do j = 1, columns
      do i = 1, rows
        if (is_too_large(here(i, j)) .or. is_too_large(across(j, i))) survey%is_usable = .false.
      end do
    end do
    if (.not. survey%is_usable) return
    least = here(1, 1)
    most = here(1, 1)
    asymmetry = 0.0_dp
    do j = 1, columns
      do i = 1, rows
        least = min(least, here(i, j))
        most = max(most, here(i, j))
        asymmetry = max(asymmetry, abs(here(i, j) - across(j, i)))
      end do
    end do
    survey%least = least
    survey%most = most
    survey%asymmetry = asymmetry
  end subroutine survey_piece

  !> As `survey_piece`, of a whole tile.
  pure subroutine survey_tile(lda, here, across, survey)
    integer, intent(in) :: lda
    real(dp), intent(in) :: here(lda, TILE), across(lda, TILE)
    type(matrix_survey), intent(out) :: survey

    survey = empty_survey()
    call check_tile(lda, here, survey%is_usable)
    if (.not. survey%is_usable) return
    if (is_different(lda, here, across)) then
      call check_tile(lda, across, survey%is_usable)
      if (.not. survey%is_usable) return
      survey%asymmetry = asymmetry_of(lda, here, across)
    end if
    call find_extremes(lda, here, survey%least, survey%most)
  end subroutine survey_tile

  !> Clear `is_usable` if a number of a tile is not finite or too large.
  pure subroutine check_tile(lda, values, is_usable)
    integer, intent(in) :: lda
    real(dp), intent(in) :: values(lda, TILE)
    logical, intent(inout) :: is_usable
    integer(int64) :: mark(LANES)
    integer :: i, j, k

    mark = 0
    do j = 1, TILE
      do i = 0, TILE - LANES, LANES
        do k = 1, LANES
          mark(k) = ior(mark(k), LARGEST_BITS - iand(transfer(values(i + k, j), 0_int64), MAGNITUDE_BITS))
        end do
      end do
    end do
    if (any(mark < 0)) is_usable = .false.
  end subroutine check_tile

  !> Is a number not finite, or too large to be summed? In integers, because they cannot trap.
  elemental function is_too_large(value)
    real(dp), intent(in) :: value
    logical :: is_too_large

    is_too_large = iand(transfer(value, 0_int64), MAGNITUDE_BITS) > LARGEST_BITS
  end function is_too_large

  !> Does a tile differ in any bit from the one across the diagonal?
  pure function is_different(lda, here, across)
    integer, intent(in) :: lda
    real(dp), intent(in) :: here(lda, TILE), across(lda, TILE)
    logical :: is_different
    integer(int64) :: difference(LANES)
    integer :: i, j, k

    difference = 0
    do i = 0, TILE - LANES, LANES
      do j = 1, TILE
        do k = 1, LANES
          difference(k) = ior(difference(k), ieor(transfer(here(i + k, j), 0_int64), &
                                                  transfer(across(j, i + k), 0_int64)))
        end do
      end do
    end do
    is_different = any(difference /= 0)
  end function is_different

  !> The largest difference of a tile from the one across the diagonal.
  pure function asymmetry_of(lda, here, across) result(asymmetry)
    integer, intent(in) :: lda
    real(dp), intent(in) :: here(lda, TILE), across(lda, TILE)
    real(dp) :: asymmetry
    real(dp) :: largest_of(LANES)
    integer :: i, j, k

    largest_of = 0.0_dp
    do i = 0, TILE - LANES, LANES
      do j = 1, TILE
        do k = 1, LANES
          largest_of(k) = max(largest_of(k), abs(here(i + k, j) - across(j, i + k)))
        end do
      end do
    end do
    asymmetry = maxval(largest_of)
  end function asymmetry_of

  !> The least and the largest number of a tile.
  pure subroutine find_extremes(lda, values, least, most)
    integer, intent(in) :: lda
    real(dp), intent(in) :: values(lda, TILE)
    real(dp), intent(out) :: least, most
    real(dp) :: least_of(LANES), most_of(LANES)
    integer :: i, j, k

    least_of = values(1, 1)
    most_of = values(1, 1)
    do j = 1, TILE
      do i = 0, TILE - LANES, LANES
        do k = 1, LANES
          least_of(k) = min(least_of(k), values(i + k, j))
          most_of(k) = max(most_of(k), values(i + k, j))
        end do
      end do
    end do
    least = minval(least_of)
    most = maxval(most_of)
  end subroutine find_extremes

  !> Clear `pairs_hold` if a pair with one point of the rows and one of the columns gains energy.
  pure subroutine judge_pairs(rows, columns, lda, here, row_energy, column_energy, survey)
    integer, intent(in) :: rows, columns, lda
    real(dp), intent(in) :: here(lda, columns), row_energy(rows), column_energy(columns)
    type(matrix_survey), intent(inout) :: survey
    integer :: j

    do j = 1, columns
      if (any(2.0_dp*here(:rows, j) - row_energy > column_energy(j))) survey%pairs_hold = .false.
    end do
  end subroutine judge_pairs

  !> The contribution of a point to the energy of a pair, rounding included.
  elemental function tolerated(own)
    real(dp), intent(in) :: own
    real(dp) :: tolerated

    tolerated = own + PAIR_TOLERANCE*abs(own)
  end function tolerated

end submodule fuge_matrix_strips
