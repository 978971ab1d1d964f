!> Checks of the forces on a body, and of the points in it at which stresses and displacements are asked for.
module fuge_stress_checks
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: check_coordinate, check_depth, check_displacement_range, check_forces, check_result

contains

  !> Refuse forces that are not finite, or not one for each of the `number` of `pieces` of the surface, cells or rings:
  !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE.
  pure subroutine check_forces(force, number, pieces, info)
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: number
    character(len=*), intent(in) :: pieces
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (size(force) /= number) then
      call report(info, FUGE_ERR_SIZE, 'force has '//text(size(force))//' values for the '//text(number)//' '//pieces)
    else
      call check_finite(force, 'force', info)
    end if
  end subroutine check_forces

  !> Refuse a modulus of the body by which its displacements overflow under forces that act on pieces of the surface
  !> of the `least` width: FUGE_ERR_OVERFLOW.
  pure subroutine check_displacement_range(force, least, young, info)
    real(dp), intent(in) :: force(:), least, young
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest

    if (info%failed() .or. .not. young <= huge(young)) return
    largest = maxval(abs(force))
    if (.not. largest > 0.0_dp) return
    if (exponent(largest) - exponent(least) + max(0, -exponent(young)) > LARGEST_EXPONENT) &
      call report(info, FUGE_ERR_OVERFLOW, 'the displacements by forces up to '//text(largest)//' with young = ' &
                  //text(young)//' are out of range: choose other units')
  end subroutine check_displacement_range

  !> Refuse coordinates that are not finite, or not one for each `depth`: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE.
  pure subroutine check_coordinate(values, name, depth, info)
    real(dp), intent(in) :: values(:), depth(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (size(values) /= size(depth)) then
      call report(info, FUGE_ERR_SIZE, name//' has '//text(size(values))//' values for the '//text(size(depth)) &
                  //' points of pz')
    else
      call check_finite(values, name, info)
    end if
  end subroutine check_coordinate

  !> Refuse points above the surface (FUGE_ERR_GRID) and depths that are not finite (FUGE_ERR_NOT_FINITE).
  pure subroutine check_depth(depth, name, info)
    real(dp), intent(in) :: depth(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    call check_finite(depth, name, info)
    if (info%failed()) return
    do k = 1, size(depth)
      if (depth(k) >= 0.0_dp) cycle
      call report(info, FUGE_ERR_GRID, name//'('//index_text(k)//') = '//text(depth(k)) &
                  //' lies above the surface: z counts from 0 into the body')
      return
    end do
  end subroutine check_depth

  !> Refuse a result that is not (`components`, `points`): FUGE_ERR_SIZE.
  pure subroutine check_result(shape_given, name, components, points, info)
    integer, intent(in) :: shape_given(2), components, points
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. all(shape_given == [components, points])) return
    call report(info, FUGE_ERR_SIZE, name//' is '//text(shape_given(1))//' by '//text(shape_given(2))//': it needs ' &
                //text(components)//' rows and '//text(points)//' columns')
  end subroutine check_result

end module fuge_stress_checks
