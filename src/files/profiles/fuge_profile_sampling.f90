!> Profiles, heights z over positions x: interpolation at other points, and levelling.
!>
!> Heights are positive upwards. The initial gap of two profiles that face each other,
!> sampled at the same points, is upper - lower; its constant part is arbitrary, it changes the
!> approach only.
module fuge_profile_sampling
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_sample_profile, fuge_level_profile

  !> Value of `form`: subtract the mean height.
  integer, parameter, public :: FUGE_LEVEL_MEAN = 0
  !> Value of `form`: subtract the least-squares line.
  integer, parameter, public :: FUGE_LEVEL_LINE = 1

  !> A point outside the profile by less than this fraction of its length counts as its end.
  real(dp), parameter :: END_TOLERANCE = 1.0e-12_dp

contains

  !> Heights of a profile at other points, by linear interpolation.
  !>
  !> `x` (n), strictly increasing, and `z` (n), n >= 2: the profile. `centre` (k): the other
  !> points in any order, within x(1) .. x(n), or outside by at most 1e-12 of the length, where
  !> the height is that of the end. `height` (k): the result. All are lengths.
  !> Errors, `height` unchanged: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_WIDTH if x does not increase or a centre is outside.
  pure subroutine fuge_sample_profile(x, z, centre, height, info)
    real(dp), intent(in) :: x(:), z(:), centre(:)
    real(dp), intent(inout) :: height(:)
    type(fuge_info), intent(out) :: info
    integer :: k, left

    call check_profile(x, z, info)
    if (.not. info%failed()) call check_centres(x, centre, size(height), info)
    if (info%failed()) return
    left = 1
    do k = 1, size(centre)
      left = find_interval(x, centre(k), left)
      height(k) = interpolate(x(left:left + 1), z(left:left + 1), centre(k))
    end do
  end subroutine fuge_sample_profile

  !> The interval x(left) .. x(left + 1) that contains `point`: `guess` and the next one are tried
  !> before bisection.
  pure function find_interval(x, point, guess) result(left)
    real(dp), intent(in) :: x(:), point
    integer, intent(in) :: guess
    integer :: left
    integer :: right, middle

    do left = guess, min(guess + 1, size(x) - 1)
      if (x(left) <= point .and. point <= x(left + 1)) return
    end do
    left = 1
    right = size(x)
    do while (right - left > 1)
      middle = left + (right - left)/2
      if (x(middle) <= point) then
        left = middle
      else
        right = middle
      end if
    end do
  end function find_interval

  !> Linear interpolation, exact at both ends and constant beyond them.
  pure function interpolate(x, z, point) result(height)
    real(dp), intent(in) :: x(2), z(2), point
    real(dp) :: height
    real(dp) :: fraction

    fraction = max(0.0_dp, min(1.0_dp, (point - x(1))/(x(2) - x(1))))
    height = (1.0_dp - fraction)*z(1) + fraction*z(2)
  end function interpolate

  !> Subtract the mean height or the least-squares line from a profile, as usual for roughness.
  !>
  !> `x` (n), strictly increasing, n >= 2; `z` (n) is changed in place; `form` is
  !> FUGE_LEVEL_MEAN or FUGE_LEVEL_LINE. The weight of a point is half the length of the
  !> intervals next to it, so that neither mean nor line depends on where a profile is sampled
  !> densely.
  !> Errors, `z` unchanged: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_WIDTH if x does not increase, FUGE_ERR_OPTION for `form`.
  pure subroutine fuge_level_profile(x, z, form, info)
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: z(:)
    integer, intent(in) :: form
    type(fuge_info), intent(out) :: info

    call check_profile(x, z, info)
    if (info%failed()) return
    if (form /= FUGE_LEVEL_MEAN .and. form /= FUGE_LEVEL_LINE) then
      call report(info, FUGE_ERR_OPTION, 'form = '//text(form)//' is unknown: use FUGE_LEVEL_MEAN or FUGE_LEVEL_LINE')
      return
    end if
    z = z - mean_height(x, z)
    if (form == FUGE_LEVEL_LINE) call subtract_slope(x, z)
  end subroutine fuge_level_profile

  !> Weight of each point, (n): the fraction of the length that is nearest to it.
  pure function weights(x) result(weight)
    real(dp), intent(in) :: x(:)
    real(dp) :: weight(size(x))
    integer :: n

    n = size(x)
    weight = 0.0_dp
    weight(:n - 1) = 0.5_dp*((x(2:) - x(:n - 1))/(x(n) - x(1)))
    weight(2:) = weight(2:) + 0.5_dp*((x(2:) - x(:n - 1))/(x(n) - x(1)))
  end function weights

  !> Mean height of a profile.
  pure function mean_height(x, z) result(mean)
    real(dp), intent(in) :: x(:), z(:)
    real(dp) :: mean

    ! Relative to the first height, so that an offset costs no digits.
    mean = z(1) + dot_product(weights(x), z - z(1))
  end function mean_height

  !> Subtract the least-squares line from heights with mean zero.
  pure subroutine subtract_slope(x, z)
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: z(:)
    real(dp) :: abscissa(size(x)), weight(size(x))

    ! Dimensionless, so that no square overflows.
    abscissa = (x - x(1))/(x(size(x)) - x(1))
    weight = weights(x)
    abscissa = abscissa - dot_product(weight, abscissa)
    z = z - abscissa*(dot_product(weight, abscissa*z)/dot_product(weight, abscissa**2))
  end subroutine subtract_slope

  !> Refuse a profile with fewer than two points, values that are not finite or out of range, or x
  !> that does not increase.
  pure subroutine check_profile(x, z, info)
    real(dp), intent(in) :: x(:), z(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (size(x) < 2 .or. size(z) /= size(x)) then
      call report(info, FUGE_ERR_SIZE, 'x has '//text(size(x))//' and z '//text(size(z)) &
                  //' value(s): both need the same number, 2 or more')
      return
    end if
    call check_finite(x, 'x', info)
    if (.not. info%failed()) call check_finite(z, 'z', info)
    if (info%failed()) return
    do k = 1, size(x)
      if (max(exponent(x(k)), exponent(z(k))) <= LARGEST_EXPONENT) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'point '//index_text(k)//' at x = '//text(x(k))//', z = '//text(z(k)) &
                  //' is out of range: choose another unit of length')
      return
    end do
    do k = 2, size(x)
      if (x(k) > x(k - 1)) cycle
      call report(info, FUGE_ERR_WIDTH, 'x('//index_text(k)//') = '//text(x(k))//' does not exceed x(' &
                  //index_text(k - 1)//') = ' &
                  //text(x(k - 1))//': x must increase; sort the points and merge repeated ones')
      return
    end do
  end subroutine check_profile

  !> Refuse points that are not finite or outside the profile, or another number of heights.
  pure subroutine check_centres(x, centre, heights, info)
    real(dp), intent(in) :: x(:), centre(:)
    integer, intent(in) :: heights
    type(fuge_info), intent(inout) :: info
    real(dp) :: first, last
    integer :: k

    if (heights /= size(centre)) then
      call report(info, FUGE_ERR_SIZE, 'centre has '//text(size(centre))//' and height '//text(heights) &
                  //' value(s): they need the same number')
      return
    end if
    call check_finite(centre, 'centre', info)
    if (info%failed()) return
    first = x(1)
    last = x(size(x))
    do k = 1, size(centre)
      if (max(first - centre(k), centre(k) - last) <= END_TOLERANCE*(last - first)) cycle
      call report(info, FUGE_ERR_WIDTH, 'centre('//index_text(k)//') = '//text(centre(k))//' is outside the profile, ' &
                  //text(first)//' .. '//text(last)//': extend the profile, or leave the point out')
      return
    end do
  end subroutine check_centres

end module fuge_profile_sampling
