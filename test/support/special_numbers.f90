!> Numbers that are none.
module special_numbers
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
  use fuge_kinds, only: dp
  implicit none
  private

  public :: infinity, nan

contains

  pure function infinity()
    real(dp) :: infinity

    infinity = ieee_value(infinity, ieee_positive_inf)
  end function infinity

  pure function nan()
    real(dp) :: nan

    nan = ieee_value(nan, ieee_quiet_nan)
  end function nan

end module special_numbers
