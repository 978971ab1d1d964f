!> Sizes relative to a measure, for judgements that must survive zero, NaN and overflow.
module fuge_relative_size
  use fuge_kinds, only: dp
  implicit none
  private

  public :: relative

contains

  !> value/measure; a value of zero is no violation, even with a measure of zero.
  elemental function relative(value, measure)
    real(dp), intent(in) :: value, measure
    real(dp) :: relative

    if (.not. abs(value) <= huge(value)) then
      ! NaN or infinite: return a number, because maxval may ignore a NaN.
      relative = huge(value)
    else if (abs(value) <= 0.0_dp) then
      relative = 0.0_dp
    else if (measure >= 1.0_dp) then
      relative = value/measure
    else if (abs(value) < measure*huge(value)) then
      relative = value/measure
    else
      ! The quotient would overflow, or the measure is NaN.
      relative = sign(huge(value), value)
    end if
  end function relative

end module fuge_relative_size
