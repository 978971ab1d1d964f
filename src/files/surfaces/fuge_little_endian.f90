!> Numbers in the bytes of a file, the least significant byte first, whatever the machine has.
module fuge_little_endian
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: real_at, signed_at, unsigned_at

contains

  !> The whole number without sign of `length` bytes, 1 to 4, from position `first` on.
  pure function unsigned_at(bytes, first, length) result(value)
    character(len=*), intent(in) :: bytes
    integer(int64), intent(in) :: first
    integer, intent(in) :: length
    integer(int64) :: value
    integer :: k

    value = 0_int64
    do k = length - 1, 0, -1
      value = 256_int64*value + int(iand(ichar(bytes(first + k:first + k)), 255), int64)
    end do
  end function unsigned_at

  !> The whole number with a sign, in two's complement, of `length` bytes, 1 to 4.
  pure function signed_at(bytes, first, length) result(value)
    character(len=*), intent(in) :: bytes
    integer(int64), intent(in) :: first
    integer, intent(in) :: length
    integer(int64) :: value

    value = unsigned_at(bytes, first, length)
    if (btest(value, 8*length - 1)) value = value - ishft(1_int64, 8*length)
  end function signed_at

  !> The double of 8 bytes, which may be NaN or infinity.
  pure function real_at(bytes, first) result(value)
    character(len=*), intent(in) :: bytes
    integer(int64), intent(in) :: first
    real(dp) :: value

    value = transfer(ior(unsigned_at(bytes, first, 4), ishft(unsigned_at(bytes, first + 4_int64, 4), 32)), value)
  end function real_at

end module fuge_little_endian
