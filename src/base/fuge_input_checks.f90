!> Checks of input arrays for NaN and infinity.
module fuge_input_checks
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_NOT_FINITE
  implicit none
  private

  public :: check_finite, is_finite_everywhere

  integer, parameter :: int64 = selected_int_kind(18)

contains

  !> Are all values finite? Reads the bits of the exponents, in one pass without a
  !> branch, because a comparison with NaN may trap.
  pure function is_finite_everywhere(values) result(finite)
    real(dp), intent(in), contiguous :: values(:)
    logical :: finite
    integer(int64) :: exponent_bits, worst
    integer :: k

    exponent_bits = ishft(2047_int64, 52)
    worst = 0
    do k = 1, size(values)
      worst = max(worst, iand(transfer(values(k), worst), exponent_bits))
    end do
    finite = worst < exponent_bits
  end function is_finite_everywhere


  !> Refuse NaN and infinity (FUGE_ERR_NOT_FINITE); the message names the first such value `name`(k).
  pure subroutine check_finite(values, name, info)
    real(dp), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(values)
      if (ieee_is_finite(values(k))) cycle
      call report(info, FUGE_ERR_NOT_FINITE, name//'('//text(k)//') = '//text(values(k)) &
        //' is not a finite number')
      return
    end do
  end subroutine check_finite

end module fuge_input_checks
