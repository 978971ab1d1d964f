!> Numbers in words of the command line and of tables.
module number_words
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_core, only: dp => fuge_dp
  implicit none
  private

  public :: number_text, read_integer, read_real, short_text

contains

  !> Read a finite number, with a decimal point and an exponent after e or d.
  pure subroutine read_real(word, value, valid)
    character(len=*), intent(in) :: word
    real(dp), intent(out) :: value
    logical, intent(out) :: valid
    integer :: status

    value = 0.0_dp
    valid = len(word) > 0 .and. verify(word, '0123456789+-.eEdD') == 0 .and. scan(word, '0123456789') > 0
    if (.not. valid) return
    read (word, *, iostat=status) value
    valid = status == 0
    if (valid) valid = ieee_is_finite(value)
    if (.not. valid) value = 0.0_dp
  end subroutine read_real

  !> Read a whole number.
  pure subroutine read_integer(word, value, valid)
    character(len=*), intent(in) :: word
    integer, intent(out) :: value
    logical, intent(out) :: valid
    integer :: status

    value = 0
    valid = len(word) > 0 .and. verify(word, '0123456789+-') == 0 .and. scan(word, '0123456789') > 0
    if (.not. valid) return
    read (word, *, iostat=status) value
    valid = status == 0
    if (.not. valid) value = 0
  end subroutine read_integer

  !> A whole number as text.
  pure function number_text(value) result(text)
    integer, intent(in) :: value
    character(len=:), allocatable :: text
    character(len=12) :: digits

    write (digits, '(i0)') value
    text = trim(digits)
  end function number_text

  !> A number as text, to six digits.
  pure function short_text(value) result(text)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: text
    character(len=16) :: digits

    write (digits, '(es13.5e3)') value
    text = trim(adjustl(digits))
  end function short_text

end module number_words
