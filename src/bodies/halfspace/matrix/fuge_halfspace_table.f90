!> Influence coefficients of a grid of equal rectangles on an elastic half-space, side by side.
module fuge_halfspace_table
  use fuge_cell_elements, only: FUGE_CENTRE
  use fuge_double_double, only: double_double, exact_product, operator(/)
  use fuge_kinds, only: dp
  use fuge_rectangle_influence, only: new_rectangle_kernel, pair_coefficients, rectangle_kernel, set_widths, &
    HALFSPACE_FACTOR, PAIRS
  use fuge_rectangle_multipoles, only: FAR_RATIO
  use fuge_rectangle_potential, only: near_table
  implicit none
  private

  public :: fill_halfspace_rows, fill_halfspace_table

contains

  !> `table(i, j)`: the coefficient of two rectangles that are i and j rectangles apart along x and y, from 0.
  !>
  !> `spacing` (2): widths along x and y, length; `e_star` force per length squared; `element` FUGE_CENTRE or FUGE_MEAN;
  !> all valid. `table`, displacement into the body per force of a rectangle, to half a unit in the last place.
  !> `stat` as in an allocate statement; `table` is untouched unless it is 0.
  pure subroutine fill_halfspace_table(spacing, e_star, element, table, stat)
    real(dp), intent(in) :: spacing(2), e_star
    integer, intent(in) :: element
    real(dp), intent(inout) :: table(0:, 0:)
    integer, intent(out) :: stat

    call fill_halfspace_rows(spacing, e_star, element, 0, size(table, 2), table, stat)
  end subroutine fill_halfspace_table

  !> As fill_halfspace_table, the rows from number `begin` on of a table that has `rows` of them.
  pure subroutine fill_halfspace_rows(spacing, e_star, element, begin, rows, table, stat)
    real(dp), intent(in) :: spacing(2), e_star
    integer, intent(in) :: element, begin, rows
    real(dp), intent(inout) :: table(0:, begin:)
    integer, intent(out) :: stat
    type(rectangle_kernel) :: kernel
    type(double_double) :: factor, offset
    real(dp), allocatable :: near(:, :), x_high(:), x_low(:)
    real(dp) :: observed(2)
    integer :: near_x, near_y, first, i, j

    factor = HALFSPACE_FACTOR/double_double(e_star, 0.0_dp)
    call new_rectangle_kernel(factor, kernel, stat)
    if (stat == 0) allocate (x_high(0:size(table, 1) - 1), x_low(0:size(table, 1) - 1), stat=stat)
    if (stat /= 0) return
    observed = spacing
    if (element == FUGE_CENTRE) observed = 0.0_dp
    call set_widths(kernel, observed, spacing)
    near_x = near_count(observed, spacing, 1, size(table, 1))
    near_y = near_count(observed, spacing, 2, rows)
    if (begin < near_y) then
      allocate (near(0:near_x - 1, 0:near_y - 1), stat=stat)
      if (stat == 0) call near_table(spacing, element == FUGE_CENTRE, factor, near, stat)
      if (stat /= 0) return
      do j = begin, min(near_y - 1, ubound(table, 2))
        table(:near_x - 1, j) = near(:, j)
      end do
    end if
    do i = 0, ubound(table, 1)
      offset = exact_product(real(i, dp), spacing(1))
      x_high(i) = offset%high
      x_low(i) = offset%low
    end do
    do j = begin, ubound(table, 2)
      first = merge(near_x, 0, j < near_y)
      call fill_row(kernel, x_high(first:), x_low(first:), spacing(2), j, table(first:, j))
    end do
  end subroutine fill_halfspace_rows

  !> How many rectangles in `direction` may be too close for the multipoles, at most `most`.
  pure function near_count(observed, loaded, direction, most) result(count)
    real(dp), intent(in) :: observed(2), loaded(2)
    integer, intent(in) :: direction, most
    integer :: count
    real(dp) :: radius

    radius = 0.5_dp*hypot(observed(1) + loaded(1), observed(2) + loaded(2))/sqrt(FAR_RATIO)
    count = most
    if (radius < most*loaded(direction)) count = min(most, 1 + int(radius/loaded(direction)))
  end function near_count

  !> The coefficients of the rectangles with the offsets x = `x_high` + `x_low` in row `j`.
  pure subroutine fill_row(kernel, x_high, x_low, spacing_y, j, row)
    type(rectangle_kernel), intent(inout) :: kernel
    real(dp), intent(in), contiguous :: x_high(:), x_low(:)
    real(dp), intent(in) :: spacing_y
    integer, intent(in) :: j
    real(dp), intent(inout), contiguous :: row(:)
    type(double_double) :: offset
    real(dp), dimension(PAIRS) :: y_high, y_low
    integer :: first, last, count

    offset = exact_product(real(j, dp), spacing_y)
    y_high = offset%high
    y_low = offset%low
    do first = 1, size(row), PAIRS
      last = min(first + PAIRS - 1, size(row))
      count = last - first + 1
      call pair_coefficients(kernel, x_high(first:last), x_low(first:last), y_high(:count), y_low(:count), &
                             row(first:last))
    end do
  end subroutine fill_row

end module fuge_halfspace_table
