!> Numbers as text, for messages.
module fuge_text
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  implicit none
  private

  public :: text

  !> An integer, or a real number to six digits or so, without blanks.
  interface text
    module procedure text_integer
    module procedure text_real
  end interface text

contains

  pure function text_integer(value) result(string)
    integer, intent(in) :: value
    character(len=:), allocatable :: string
    character(len=12) :: buffer

    write (buffer, '(i0)') value
    string = trim(buffer)
  end function text_integer

  pure function text_real(value) result(string)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: string
    character(len=24) :: buffer

    if (.not. ieee_is_finite(value)) then
      ! Apart, because a comparison with NaN may trap.
      write (buffer, '(es13.5e3)') value
    else if (abs(value) >= 1.0e-3_dp .and. abs(value) < 1.0e5_dp) then
      write (buffer, '(f14.6)') value
    else
      write (buffer, '(es13.5e3)') value
    end if
    string = trim(adjustl(buffer))
  end function text_real

end module fuge_text
