!> Checks of forces, depths and results on grids.
module fuge_stress_grid_checks
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  use fuge_stress_checks, only: check_depth
  implicit none
  private

  public :: check_grid_depth, check_grid_force, check_grid_result, check_grid_strain

  !> A depth is at most 2**DEEPEST spacings, 1.8e75.
  integer, parameter :: DEEPEST = 250

contains

  !> Refuse forces that are not finite, or whose pressure on the `area` of a cell is out of range:
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW.
  pure subroutine check_grid_force(force, area, info)
    real(dp), intent(in) :: force(:), area
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    call check_finite(force, 'force', info)
    do k = 1, size(force)
      if (info%failed()) return
      if (max(exponent(force(k)) - exponent(area), 2*exponent(force(k))) <= LARGEST_EXPONENT) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'force('//index_text(k)//') = '//text(force(k)) &
                  //' is out of range: choose other units')
    end do
  end subroutine check_grid_force

  !> Refuse forces whose pressure over Young's modulus is out of range (FUGE_ERR_OVERFLOW); `young` may be infinite.
  pure subroutine check_grid_strain(force, area, young, info)
    real(dp), intent(in) :: force(:), area, young
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest

    if (info%failed() .or. young > huge(young)) return
    largest = maxval(abs(force))
    if (exponent(largest) - exponent(area) - exponent(young) > LARGEST_EXPONENT) call report(info, FUGE_ERR_OVERFLOW, &
      'the largest force, '//text(largest)//', is out of range for young = '//text(young)//': choose other units')
  end subroutine check_grid_strain

  !> Refuse depths that are not finite, above the surface, or more than 1e75 times the least `spacing`:
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW.
  pure subroutine check_grid_depth(depth, spacing, info)
    real(dp), intent(in) :: depth(:), spacing
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_depth(depth, 'depth', info)
    do k = 1, size(depth)
      if (info%failed()) return
      if (exponent(depth(k)) - exponent(spacing) < DEEPEST) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'depth('//index_text(k)//') = '//text(depth(k)) &
                  //' is more than 1e75 times the spacing: leave it out')
    end do
  end subroutine check_grid_depth

  !> Refuse a result whose shape, `given` (3), is not the one that is needed: FUGE_ERR_SIZE.
  pure subroutine check_grid_result(given, name, needed, info)
    integer, intent(in) :: given(3), needed(3)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. all(given == needed)) return
    call report(info, FUGE_ERR_SIZE, name//' is '//text(given(1))//' by '//text(given(2))//' by '//text(given(3)) &
                //': it needs '//text(needed(1))//' by '//text(needed(2))//' by '//text(needed(3)))
  end subroutine check_grid_result

end module fuge_stress_grid_checks
