!> Checks of rectangles on the surface of a half-space.
module fuge_rectangle_checks
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_MEAN
  use fuge_constants, only: LARGEST_EXPONENT_OF_2, LARGEST_EXPONENT_OF_4
  use fuge_elastic_moduli, only: check_e_star
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_ELEMENT, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, &
    FUGE_ERR_WIDTH
  implicit none
  private

  public :: check_area_element, check_area_modulus, check_places, check_rectangles

  !> Widths with a smaller relative difference count as equal.
  real(dp), parameter :: WIDTH_TOLERANCE = 1.0e-10_dp
  !> An overlap below this fraction of the narrower width counts as rounding of the positions.
  real(dp), parameter :: OVERLAP_TOLERANCE = 1.0e-6_dp
  !> Closed forms of two rectangles lose their digits where one width is below this fraction of another one.
  real(dp), parameter :: SMALLEST_RATIO = 1.0e-5_dp

contains

  !> Refuse what `check_places` does, and rectangles that overlap or whose widths are too different.
  !>
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW.
  pure subroutine check_rectangles(x, y, width_x, width_y, element, symmetric, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    integer, intent(in) :: element
    logical, intent(in) :: symmetric(2)
    type(fuge_info), intent(inout) :: info

    call check_places(x, y, width_x, width_y, element, symmetric, info)
    if (.not. info%failed()) call check_ratio(width_x, width_y, info)
    if (.not. info%failed()) call check_overlap(x, y, width_x, width_y, info)
  end subroutine check_rectangles

  !> Refuse arrays of different lengths, numbers that are not finite or out of range, and widths that `element` cannot
  !> have. `symmetric` (2): about x = 0, about y = 0.
  !>
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_GRID, FUGE_ERR_OVERFLOW.
  pure subroutine check_places(x, y, width_x, width_y, element, symmetric, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    integer, intent(in) :: element
    logical, intent(in) :: symmetric(2)
    type(fuge_info), intent(inout) :: info

    if (size(x) < 1 .or. any([size(y), size(width_x), size(width_y)] /= size(x))) then
      call report(info, FUGE_ERR_SIZE, 'x has '//text(size(x))//', y '//text(size(y))//', width_x ' &
                  //text(size(width_x))//' and width_y '//text(size(width_y))//' value(s): all need n >= 1')
      return
    end if
    call check_direction(x, width_x, 'x', element, symmetric(1), info)
    if (.not. info%failed()) call check_direction(y, width_y, 'y', element, symmetric(2), info)
  end subroutine check_places

  !> Refuse an element that areas do not have (FUGE_ERR_ELEMENT).
  pure subroutine check_area_element(element, info)
    integer, intent(in) :: element
    type(fuge_info), intent(inout) :: info

    if (element /= FUGE_CENTRE .and. element /= FUGE_MEAN) call report(info, FUGE_ERR_ELEMENT, 'element = ' &
      //text(element)//' is not one of rectangles: use FUGE_CENTRE or FUGE_MEAN')
  end subroutine check_area_element

  !> Refuse a modulus that is not positive or out of range (FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW).
  pure subroutine check_area_modulus(e_star, info)
    real(dp), intent(in) :: e_star
    type(fuge_info), intent(inout) :: info

    call check_e_star(e_star, info)
    if (info%failed()) return
    if (abs(exponent(e_star)) > LARGEST_EXPONENT_OF_2) call report(info, FUGE_ERR_OVERFLOW, 'e_star = ' &
      //text(e_star)//' is out of range: choose other units')
  end subroutine check_area_modulus

  !> The checks along one axis, whose name is `axis`.
  pure subroutine check_direction(x, width, axis, element, symmetric, info)
    real(dp), intent(in) :: x(:), width(:)
    character, intent(in) :: axis
    integer, intent(in) :: element
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_finite(x, axis, info)
    if (.not. info%failed()) call check_finite(width, 'width_'//axis, info)
    do k = 1, size(x)
      if (info%failed()) return
      if (.not. width(k) > 0.0_dp) then
        call report(info, FUGE_ERR_WIDTH, 'width_'//axis//'('//index_text(k)//') = '//text(width(k)) &
                    //' is not positive')
      else if (exponent(x(k)) > LARGEST_EXPONENT_OF_4 .or. abs(exponent(width(k))) > LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'rectangle '//index_text(k)//' at '//axis//' = '//text(x(k)) &
                    //' of width '//text(width(k))//' is out of range: choose another unit of length')
      else if (element == FUGE_CENTRE .and. abs(width(k) - width(1)) > WIDTH_TOLERANCE*width(1)) then
        call report(info, FUGE_ERR_GRID, 'width_'//axis//'('//index_text(k)//') = '//text(width(k)) &
                    //' differs from width_'//axis//'('//index_text(1)//') by '//text(width(k) - width(1)) &
                    //': on unequal rectangles only FUGE_MEAN is symmetric, use it')
      else if (symmetric) then
        call check_half(x(k), width(k), k, axis, info)
      end if
    end do
  end subroutine check_direction

  !> Refuse a rectangle of a symmetric model on the other side of the axis, or cut by it outside its middle.
  pure subroutine check_half(x, width, k, axis, info)
    real(dp), intent(in) :: x, width
    integer, intent(in) :: k
    character, intent(in) :: axis
    type(fuge_info), intent(inout) :: info

    if (x < 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, axis//'('//index_text(k)//') = '//text(x)//' is negative: a model symmetric' &
                  //' about '//axis//' = 0 takes the rectangles with '//axis//' >= 0 only')
    else if (x > OVERLAP_TOLERANCE*width .and. 2.0_dp*x < (1.0_dp - OVERLAP_TOLERANCE)*width) then
      call report(info, FUGE_ERR_WIDTH, 'rectangle '//index_text(k)//' at '//axis//' = '//text(x)//' of width ' &
                  //text(width)//' overlaps its mirror image: move it to '//axis//' = 0 or cut it there')
    end if
  end subroutine check_half

  !> Refuse widths so different that coefficients of neighbours would lose digits (FUGE_ERR_WIDTH).
  pure subroutine check_ratio(width_x, width_y, info)
    real(dp), intent(in) :: width_x(:), width_y(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: least, most

    least = min(minval(width_x), minval(width_y))
    most = max(maxval(width_x), maxval(width_y))
    if (least < SMALLEST_RATIO*most) call report(info, FUGE_ERR_WIDTH, 'the widths lie between '//text(least)//' and ' &
      //text(most)//': the ratio of two of them is at most '//text(1.0_dp/SMALLEST_RATIO))
  end subroutine check_ratio

  !> Refuse two rectangles that overlap or are the same one (FUGE_ERR_WIDTH).
  pure subroutine check_overlap(x, y, width_x, width_y, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: depth_x, depth_y, rounding_x, rounding_y
    integer :: i, j

    rounding_x = 4.0_dp*epsilon(x)*maxval(abs(x))
    rounding_y = 4.0_dp*epsilon(y)*maxval(abs(y))
    do j = 1, size(x)
      do i = j + 1, size(x)
        depth_x = 0.5_dp*(width_x(i) + width_x(j)) - abs(x(i) - x(j))
        if (depth_x <= rounding_x) cycle
        depth_y = 0.5_dp*(width_y(i) + width_y(j)) - abs(y(i) - y(j))
        if (depth_y <= rounding_y) cycle
        if (depth_x <= OVERLAP_TOLERANCE*min(width_x(i), width_x(j))) cycle
        if (depth_y <= OVERLAP_TOLERANCE*min(width_y(i), width_y(j))) cycle
        call report(info, FUGE_ERR_WIDTH, 'rectangles '//index_text(j)//' and '//index_text(i)//' overlap, by ' &
                    //text(depth_x)//' along x and '//text(depth_y)//' along y: pass each part of the surface once')
        return
      end do
    end do
  end subroutine check_overlap

end module fuge_rectangle_checks
