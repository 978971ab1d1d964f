!> Checks of compliances, limits of forces and stiffnesses.
module fuge_law_checks
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_LAW, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: check_limits, check_stiffnesses

contains

  !> Refuse limits of forces that are not `expected` many (FUGE_ERR_SIZE), NaN (FUGE_ERR_NOT_FINITE) or negative
  !> (FUGE_ERR_LAW). Infinity is no limit. Not allocated: none to check.
  pure subroutine check_limits(limits, expected, name, info)
    real(dp), intent(in), allocatable :: limits(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_count(limits, expected, name, info)
    if (info%failed() .or. .not. allocated(limits)) return
    do k = 1, size(limits)
      ! The caller's arrays may begin with another number than 1.
      associate (limit => limits(lbound(limits, 1) + k - 1))
        if (ieee_is_nan(limit)) then
          call report(info, FUGE_ERR_NOT_FINITE, name//'('//index_text(k)//') is NaN: use infinity for a force ' &
                      //'without a limit')
        else if (limit < 0.0_dp) then
          call report(info, FUGE_ERR_LAW, name//'('//index_text(k)//') = '//text(limit)//' is negative: a limit is ' &
                      //'the size of a force; 0 for none, infinity without a limit')
        end if
      end associate
      if (info%failed()) return
    end do
  end subroutine check_limits

  !> Refuse compliances or stiffnesses that are not `expected` many (FUGE_ERR_SIZE), not finite (FUGE_ERR_NOT_FINITE),
  !> negative (FUGE_ERR_LAW), or too close to overflow to be summed (FUGE_ERR_OVERFLOW). Not allocated: none to check.
  pure subroutine check_stiffnesses(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_count(values, expected, name, info)
    if (info%failed() .or. .not. allocated(values)) return
    do k = 1, size(values)
      associate (value => values(lbound(values, 1) + k - 1))
        if (.not. ieee_is_finite(value)) then
          call report(info, FUGE_ERR_NOT_FINITE, name//'('//index_text(k)//') = '//text(value) &
                      //' is not a finite number')
        else if (value < 0.0_dp) then
          call report(info, FUGE_ERR_LAW, name//'('//index_text(k)//') = '//text(value)//' is negative: a spring ' &
                      //'resists, so it must be >= 0')
        else if (exponent(value) > LARGEST_EXPONENT) then
          call report(info, FUGE_ERR_OVERFLOW, name//'('//index_text(k)//') = '//text(value) &
                      //': choose units in which it is smaller')
        end if
      end associate
      if (info%failed()) return
    end do
  end subroutine check_stiffnesses

  pure subroutine check_count(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(values)) return
    if (size(values) /= expected) call report(info, FUGE_ERR_SIZE, name//' has '//text(size(values)) &
                                              //' value(s): it needs '//text(expected))
  end subroutine check_count

end module fuge_law_checks
