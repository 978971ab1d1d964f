!> Rows of a grid and of the next coarser one, whose cells are twice as wide: sums over the cells of a coarser one,
!> linear interpolation between these, and its transpose. The rows are circles.
!>
!> A row of the coarser grid has m cells, one of the finer grid n = 2*m or, if the last coarse cell has only one of
!> them, n = 2*m - 1. No two arrays are the same, so that the compiler can do several numbers at once.
module fuge_extension_kernels
  use fuge_kinds, only: sp
  implicit none
  private

  public :: add_open_row, add_row, collect_row, coarser_row, fill_row, interpolate_row, spread_row, sum_pairs

  !> Weights of the coarser cell that holds the finer one, and of that next to it.
  real(sp), parameter, public :: NEAR = 0.75_sp, NEXT = 0.25_sp

contains

  !> y = y + cover*x.
  pure subroutine add_row(n, cover, x, y)
    integer, intent(in) :: n
    real(sp), intent(in) :: cover(n), x(n)
    real(sp), intent(inout) :: y(n)

    y = y + cover*x
  end subroutine add_row

  !> y = y + weight*(1 - cover)*x.
  pure subroutine add_open_row(n, weight, cover, x, y)
    integer, intent(in) :: n
    real(sp), intent(in) :: weight, cover(n), x(n)
    real(sp), intent(inout) :: y(n)

    y = y + weight*((1.0_sp - cover)*x)
  end subroutine add_open_row

  !> x = cover*x + (1 - cover)*filling.
  pure subroutine fill_row(n, cover, filling, x)
    integer, intent(in) :: n
    real(sp), intent(in) :: cover(n), filling(n)
    real(sp), intent(inout) :: x(n)

    x = cover*x + (1.0_sp - cover)*filling
  end subroutine fill_row

  !> x = cover*(x + y), where y is the product of `factor` and `coarse` of the cell that holds the finer one.
  pure subroutine spread_row(m, n, factor, coarse, cover, x)
    integer, intent(in) :: m, n
    real(sp), intent(in) :: factor(m), coarse(m), cover(n)
    real(sp), intent(inout) :: x(n)
    real(sp) :: y(2*m)
    integer :: i

    do i = 1, m
      y(2*i - 1) = factor(i)*coarse(i)
      y(2*i) = factor(i)*coarse(i)
    end do
    x = cover*(x + y(:n))
  end subroutine spread_row

  !> The sums over pairs of cells.
  pure subroutine sum_pairs(m, fine, sums)
    integer, intent(in) :: m
    real(sp), intent(in) :: fine(2*m)
    real(sp), intent(out) :: sums(m)
    integer :: i

    do i = 1, m
      sums(i) = fine(2*i - 1) + fine(2*i)
    end do
  end subroutine sum_pairs

  !> The row of the coarser grid that is next to row `j` of the finer one, besides that which holds it; it may be beyond
  !> the first or the last one.
  elemental function coarser_row(j) result(row)
    integer, intent(in) :: j
    integer :: row

    row = (j + 1)/2 + merge(-1, 1, modulo(j, 2) == 1)
  end function coarser_row

  !> Interpolate linearly between the centres of the coarser cells.
  pure subroutine interpolate_row(m, coarse, fine)
    integer, intent(in) :: m
    real(sp), intent(in) :: coarse(m)
    real(sp), intent(out) :: fine(2*m)
    integer :: i

    fine(1) = NEAR*coarse(1) + NEXT*coarse(m)
    do i = 1, m - 1
      fine(2*i) = NEAR*coarse(i) + NEXT*coarse(i + 1)
      fine(2*i + 1) = NEAR*coarse(i + 1) + NEXT*coarse(i)
    end do
    fine(2*m) = NEAR*coarse(m) + NEXT*coarse(1)
  end subroutine interpolate_row

  !> The transpose of interpolate_row.
  pure subroutine collect_row(m, fine, coarse)
    integer, intent(in) :: m
    real(sp), intent(in) :: fine(2*m)
    real(sp), intent(out) :: coarse(m)
    integer :: i

    coarse(1) = NEAR*(fine(1) + fine(2)) + NEXT*(fine(2*m) + fine(modulo(2, 2*m) + 1))
    coarse(m) = NEAR*(fine(2*m - 1) + fine(2*m)) + NEXT*(fine(modulo(2*m - 3, 2*m) + 1) + fine(1))
    do i = 2, m - 1
      coarse(i) = NEAR*(fine(2*i - 1) + fine(2*i)) + NEXT*(fine(2*i - 2) + fine(2*i + 1))
    end do
  end subroutine collect_row

end module fuge_extension_kernels
