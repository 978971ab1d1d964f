!> Checks of a grid of equal cells on a half-plane, and of the depths below it.
module fuge_halfplane_grid_checks
  use fuge_cell_elements, only: check_element, FUGE_FREE, FUGE_PERIODIC
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, &
    FUGE_ERR_WIDTH
  use fuge_stress_grid_checks, only: check_grid_depth, check_grid_force, check_grid_result
  implicit none
  private

  public :: check_halfplane_grid

contains

  !> Refuse what makes no grid: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION,
  !> FUGE_ERR_GRID, FUGE_ERR_OVERFLOW.
  !>
  !> `given` (3): the shape of the result `name`, which must be (`components`, n, depths). Nine arguments: those of the
  !> public procedures.
  pure subroutine check_halfplane_grid(spacing, force, element, boundary, depth, given, name, components, info)
    real(dp), intent(in) :: spacing, force(:), depth(:)
    integer, intent(in) :: element, boundary, given(3), components
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (size(force) < 1) call report(info, FUGE_ERR_SIZE, 'force has no values: at least one cell is needed')
    if (.not. info%failed()) call check_finite(spacing, 'spacing', info)
    if (info%failed()) return
    if (.not. spacing > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, 'spacing = '//text(spacing)//' is not positive: it is the width of a cell')
    else if (abs(exponent(spacing)) > LARGEST_EXPONENT_OF_2) then
      call report(info, FUGE_ERR_OVERFLOW, 'spacing = '//text(spacing) &
                  //' is out of range: choose another unit of length')
    else
      call check_element(element, info)
    end if
    if (info%failed()) return
    if (all(boundary /= [FUGE_FREE, FUGE_PERIODIC])) call report(info, FUGE_ERR_OPTION, 'boundary = '//text(boundary) &
      //' is unknown: use FUGE_FREE or FUGE_PERIODIC')
    call check_grid_force(force, spacing, info)
    call check_grid_depth(depth, spacing, info)
    call check_grid_result(given, name, [components, size(force), size(depth)], info)
  end subroutine check_halfplane_grid

end module fuge_halfplane_grid_checks
