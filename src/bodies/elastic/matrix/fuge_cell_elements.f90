!> What forces and displacements of cells stand for, and what lies beyond the cells, for all bodies.
module fuge_cell_elements
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_ELEMENT
  implicit none
  private

  public :: check_element, datum_length

  !> `element`: uniform pressure f/width on a cell, displacement at its centre; equal widths.
  integer, parameter, public :: FUGE_CENTRE = 0
  !> `element`: uniform pressure f/width on a cell, mean displacement of a cell; any widths.
  integer, parameter, public :: FUGE_MEAN = 1
  !> `element`: a hat of pressure with peak f/width at x and base 2 width, displacement at x;
  !> equal widths.
  integer, parameter, public :: FUGE_HAT = 2

  !> `boundary`: beyond the cells the surface is free.
  integer, parameter, public :: FUGE_FREE = 0
  !> `boundary`: the cells repeat periodically.
  integer, parameter, public :: FUGE_PERIODIC = 1

contains

  !> Refuse an unknown element (FUGE_ERR_ELEMENT).
  pure subroutine check_element(element, info)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info

    if (all(element /= [FUGE_CENTRE, FUGE_MEAN, FUGE_HAT])) call report(info, FUGE_ERR_ELEMENT, 'element = ' &
      //text(element)//' is unknown: use FUGE_CENTRE, FUGE_MEAN or FUGE_HAT')
  end subroutine check_element

  !> D: twice the length from the outer edge of the first cell to that of the last one.
  pure function datum_length(x, width, folded) result(length)
    real(dp), intent(in) :: x(:), width(:)
    logical, intent(in) :: folded
    real(dp) :: length

    if (folded) then
      length = 4.0_dp*maxval(x + 0.5_dp*width)
    else
      length = 2.0_dp*(maxval((x - x(1)) + 0.5_dp*width) - minval((x - x(1)) - 0.5_dp*width))
    end if
  end function datum_length

end module fuge_cell_elements
