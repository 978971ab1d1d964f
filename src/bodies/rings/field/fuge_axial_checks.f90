!> Checks of points in a round body, given by their distance from its axis and their depth.
module fuge_axial_checks
  use fuge_kinds, only: dp
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH
  use fuge_stress_checks, only: check_coordinate, check_depth, check_result
  implicit none
  private

  public :: check_axial_points

  !> A distance from the contact is at most about 2**MOST_ORDERS of its radii.
  integer, parameter :: MOST_ORDERS = 200

contains

  !> Refuse points outside of the body, or out of the range of a contact of this `radius`, and a result of
  !> `shape_given` that is not (`components`, points).
  !>
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID for a point above the surface, FUGE_ERR_WIDTH for a
  !> negative distance from the axis, FUGE_ERR_OVERFLOW.
  pure subroutine check_axial_points(pr, pz, radius, shape_given, name, components, info)
    real(dp), intent(in) :: pr(:), pz(:), radius
    integer, intent(in) :: shape_given(2), components
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_coordinate(pr, 'pr', pz, info)
    call check_depth(pz, 'pz', info)
    call check_result(shape_given, name, components, size(pz), info)
    if (info%failed()) return
    do k = 1, size(pr)
      if (pr(k) < 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'pr('//index_text(k)//') = '//text(pr(k)) &
                    //' is negative: it is a distance from the axis')
        return
      else if (exponent(max(pr(k), pz(k))) > min(exponent(radius) + MOST_ORDERS, LARGEST_EXPONENT_OF_2)) then
        call report(info, FUGE_ERR_OVERFLOW, 'the point pr('//index_text(k)//') = '//text(pr(k))//', pz(' &
                    //index_text(k)//') = '//text(pz(k)) &
                    //' is out of range: so far away the field is that of one force')
        return
      end if
    end do
  end subroutine check_axial_points

end module fuge_axial_checks
