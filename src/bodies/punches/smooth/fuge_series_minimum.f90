!> Signs of a Chebyshev series on -1 <= t <= 1, decided by bounds instead of samples.
!>
!> With t = cos(theta) the series of degree n is a trigonometric polynomial, whose second derivative is
!> at most n**2 times its largest magnitude (Bernstein's inequality). So its values at equidistant
!> angles bound it from below in the cells between them. Where this bound does not decide, the
!> polynomial of degree 8 through points of the cell, which differs by rounding only, is halved until
!> the sum of its coefficients does.
module fuge_series_minimum
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_points, chebyshev_sum, chebyshev_values
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: cells_for, find_minimum, positive_cells

  !> Cells for each degree of the series, and the least number of cells: powers of two.
  integer, parameter :: CELLS_PER_DEGREE = 8, MIN_CELLS = 16
  !> Degree of the polynomial in a cell: the error is below 1e-14 of the largest magnitude of the series.
  integer, parameter :: LOCAL_DEGREE = 8
  !> A cell is halved at most this many times: beyond that its ends are the same number.
  integer, parameter :: MAX_HALVINGS = 52
  !> A sum is rounded by this many units in the last place for each term.
  real(dp), parameter :: ROUNDINGS = 4.0_dp

contains

  !> The least value of sum_k a_k T_k(t), and its position t.
  !>
  !> The sum is nowhere below min(`least`, `level`) - `tolerance`, which has the unit of the sum and is
  !> at least its rounding: what lies above `level` is not of interest and need not be exact. `least` is
  !> a value of the sum.
  pure subroutine find_minimum(a, level, tolerance, least, position)
    real(dp), intent(in) :: a(0:), level, tolerance
    real(dp), intent(out) :: least, position
    real(dp) :: values(0:cells_for(size(a))), t(0:cells_for(size(a)))
    real(dp) :: sag, allowance
    integer :: n, j

    n = cells_for(size(a))
    values = chebyshev_values(a, n)
    t = chebyshev_points(n)
    j = minloc(values, 1) - 1
    least = values(j)
    position = t(j)
    sag = largest_sag(values, size(a) - 1)
    allowance = max(tolerance, rounding(a))
    do j = 1, n
      if (min(values(j - 1), values(j)) - sag >= min(least, level) - allowance) cycle
      call search_cell(a, j, n, level, allowance, least, position)
    end do
  end subroutine find_minimum

  !> Is sum_k a_k T_k(t) positive, by more than `tolerance`, anywhere in cell j between the points j - 1
  !> and j of `chebyshev_points(n)`, n = cells_for(size(a))?
  pure function positive_cells(a, tolerance) result(positive)
    real(dp), intent(in) :: a(0:), tolerance
    logical :: positive(cells_for(size(a)))
    real(dp) :: values(0:cells_for(size(a))), least, position, sag, allowance
    integer :: n, j

    n = cells_for(size(a))
    values = chebyshev_values(a, n)
    sag = largest_sag(values, size(a) - 1)
    allowance = max(tolerance, rounding(a))
    do j = 1, n
      least = -max(values(j - 1), values(j))
      if (least >= -allowance .and. least - sag < -allowance) &
        call search_cell(-a, j, n, -allowance, 0.5_dp*allowance, least, position)
      positive(j) = least < -allowance
    end do
  end function positive_cells

  !> Number of cells in which a series with this number of coefficients is examined: a power of two.
  pure function cells_for(terms) result(n)
    integer, intent(in) :: terms
    integer :: n

    n = MIN_CELLS
    do while (n < CELLS_PER_DEGREE*(terms - 1))
      n = 2*n
    end do
  end function cells_for

  !> How far the sum may at most be below the lower one of its values at both ends of a cell: the square of
  !> the cell's angle over 8 times the largest second derivative. The largest magnitude follows from that
  !> at the points (H. Ehlich, K. Zeller, Math. Z. 86, 1964).
  pure function largest_sag(values, degree) result(sag)
    real(dp), intent(in) :: values(0:)
    integer, intent(in) :: degree
    real(dp) :: sag
    real(dp) :: angle

    ! Degrees times the angle of a cell.
    angle = PI*real(degree, dp)/real(size(values) - 1, dp)
    sag = angle**2/8.0_dp*maxval(abs(values))/cos(0.5_dp*angle)
  end function largest_sag

  pure function rounding(a)
    real(dp), intent(in) :: a(0:)
    real(dp) :: rounding

    rounding = ROUNDINGS*epsilon(a)*real(size(a), dp)*maxval(abs(a))
  end function rounding

  !> Lower `least` to the minimum in cell j of n, unless that is above `level`.
  pure subroutine search_cell(a, j, n, level, tolerance, least, position)
    real(dp), intent(in) :: a(0:), level, tolerance
    integer, intent(in) :: j, n
    real(dp), intent(inout) :: least, position
    real(dp), parameter :: SIDES(2) = [-0.5_dp, 0.5_dp]
    ! Middle, half width and coefficients of the parts still to be examined.
    real(dp) :: middle(MAX_HALVINGS + 2), half(MAX_HALVINGS + 2), part(0:LOCAL_DEGREE, MAX_HALVINGS + 2)
    real(dp), dimension(0:LOCAL_DEGREE) :: nodes, parent
    real(dp) :: centre, width
    integer :: parts, side

    nodes = chebyshev_points(LOCAL_DEGREE)
    middle(1) = PI*(real(j, dp) - 0.5_dp)/real(n, dp)
    half(1) = 0.5_dp*PI/real(n, dp)
    part(:, 1) = chebyshev_coefficients(chebyshev_sum(a, cos(middle(1) + half(1)*nodes)))
    parts = 1
    do while (parts > 0)
      parent = part(:, parts)
      centre = middle(parts)
      width = half(parts)
      parts = parts - 1
      if (value_in_middle(parent) < least) then
        least = value_in_middle(parent)
        position = cos(centre)
      end if
      if (parent(0) - sum(abs(parent(1:))) >= min(least, level) - tolerance) cycle
      if (parts + 2 > size(half) .or. .not. centre + 0.5_dp*width > centre) cycle
      do side = 1, 2
        parts = parts + 1
        middle(parts) = centre + SIDES(side)*width
        half(parts) = 0.5_dp*width
        part(:, parts) = chebyshev_coefficients(chebyshev_sum(parent, SIDES(side) + 0.5_dp*nodes))
      end do
    end do
  end subroutine search_cell

  !> The value of the series of a part in its middle: T_k(0) is 1, 0, -1, 0, ..
  pure function value_in_middle(a) result(value)
    real(dp), intent(in) :: a(0:)
    real(dp) :: value

    value = sum(a(0::4)) - sum(a(2::4))
  end function value_in_middle

end module fuge_series_minimum
