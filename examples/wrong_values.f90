!> A test of the verdict of the examples: wrong values, not-a-number among them, are counted and end the program.
program wrong_values
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp
  implicit none

  type(verdict) :: known

  call known%compare([1.0e-6_dp, -3.0e-6_dp], 1.0e-5_dp, 'a small error')
  call known%compare(-0.5_dp, 1.0e-5_dp, 'a large error')
  call known%compare(ieee_value(1.0_dp, ieee_quiet_nan), 1.0e-5_dp, 'not-a-number')
  call known%hold(.false., 'a condition')
  call known%give('as known')
end program wrong_values
