!> Cells that overlap: they would press on the same strip of the surface twice, and a repeated cell makes the influence
!> matrix singular.
!>
!> A cell extends half its width to both sides of its centre, for every element: hats, which reach over
!> their neighbours, have their centres at least one width apart.
module fuge_cell_overlaps
  use fuge_heap_sort, only: heap_sort
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_WIDTH
  implicit none
  private

  public :: check_overlaps

  !> Cells may overlap by this fraction of the narrower width, because the positions of cells side by
  !> side may have been read from a file with few digits.
  real(dp), parameter :: ALLOWANCE = 1.0e-4_dp
  !> Cells may also overlap by this many units in the last place of the largest |x|, but by no more than half the width.
  real(dp), parameter :: ROUNDINGS = 8.0_dp

contains

  !> Refuse cells that overlap, naming a pair (FUGE_ERR_WIDTH); FUGE_ERR_MEMORY.
  !>
  !> `x` (n) centres in any order, `width` (n) > 0, all finite. In a `symmetric` model a cell may not
  !> overlap its mirror image either, unless it is its own. O(n log n).
  pure subroutine check_overlaps(x, width, symmetric, info)
    real(dp), intent(in) :: x(:), width(:)
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: order(:)
    real(dp), allocatable :: left(:)
    real(dp) :: rounding
    integer :: k, farthest, stat

    allocate (order(size(x)), left(size(x)), stat=stat)
    call require_memory(stat, 'the order of', size(x), 'cells', info)
    if (stat /= 0) return
    left = x - 0.5_dp*width
    order = [(k, k=1, size(x))]
    if (any(left(2:) < left(:size(x) - 1))) call heap_sort(left, order)
    rounding = ROUNDINGS*epsilon(rounding)*maxval(abs(x))
    ! The cell that reaches farthest to the right, of those before.
    farthest = order(1)
    do k = 1, size(x)
      associate (next => order(k))
        if (symmetric) call check_mirror_image(next, x(next), width(next), rounding, info)
        if (k > 1) call check_pair(farthest, next, x, width, rounding, info)
        if (info%failed()) return
        if (x(next) + 0.5_dp*width(next) > x(farthest) + 0.5_dp*width(farthest)) farthest = next
      end associate
    end do
  end subroutine check_overlaps

  pure subroutine check_pair(i, j, x, width, rounding, info)
    integer, intent(in) :: i, j
    real(dp), intent(in) :: x(:), width(:), rounding
    type(fuge_info), intent(inout) :: info
    real(dp) :: shared
    integer :: a, b

    shared = overlap(x(j) - x(i), width(i), width(j))
    if (shared <= allowance_of(min(width(i), width(j)), rounding)) return
    a = min(i, j)
    b = max(i, j)
    call report(info, FUGE_ERR_WIDTH, 'cells '//index_text(a)//' and '//index_text(b)//', at x = '//text(x(a)) &
                //' and '//text(x(b))//' of widths '//text(width(a))//' and '//text(width(b))//', overlap by ' &
                //text(shared)//': leave one out, or make them narrower')
  end subroutine check_pair

  !> A cell at x = 0 is its own mirror image.
  pure subroutine check_mirror_image(cell, x, width, rounding, info)
    integer, intent(in) :: cell
    real(dp), intent(in) :: x, width, rounding
    type(fuge_info), intent(inout) :: info

    if (x <= allowance_of(width, rounding)) return
    if (overlap(2.0_dp*x, width, width) <= allowance_of(width, rounding)) return
    call report(info, FUGE_ERR_WIDTH, 'cell '//index_text(cell)//' at x = '//text(x)//' of width '//text(width) &
                //' overlaps its mirror image: in a symmetric model the first cell lies at x = 0 or ends there')
  end subroutine check_mirror_image

  !> The length that two cells share whose centres are `distance` apart; negative if they are apart.
  elemental function overlap(distance, width, other_width) result(length)
    real(dp), intent(in) :: distance, width, other_width
    real(dp) :: length

    length = min(0.5_dp*width + 0.5_dp*other_width - abs(distance), width, other_width)
  end function overlap

  !> The overlap that rounding may cause.
  elemental function allowance_of(width, rounding) result(length)
    real(dp), intent(in) :: width, rounding
    real(dp) :: length

    length = min(ALLOWANCE*width + rounding, 0.5_dp*width)
  end function allowance_of

end module fuge_cell_overlaps
