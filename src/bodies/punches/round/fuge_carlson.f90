!> Symmetric elliptic integrals by Carlson's duplication.
!>
!> B. C. Carlson, Numerical computation of real or complex elliptic integrals, Numerical Algorithms 10 (1995);
!> NIST Digital Library of Mathematical Functions, sections 19.16 and 19.36. No tables, and no cancellation: all terms
!> of the sums are positive.
module fuge_carlson
  use fuge_kinds, only: dp
  implicit none
  private

  public :: carlson_rd, carlson_rf

  !> Arguments this close to their mean, relatively, leave less than rounding to the series.
  real(dp), parameter :: CLOSE = 1.0e-3_dp

contains

  !> R_F(x, y, z): half the integral of 1/sqrt((t + x)(t + y)(t + z)) over t > 0.
  !>
  !> `x`, `y`, `z` >= 0, at most one of them 0, neither subnormal nor close to overflow.
  elemental function carlson_rf(x, y, z) result(rf)
    real(dp), intent(in) :: x, y, z
    real(dp) :: rf
    real(dp) :: argument(3), deviation(3), mean, shift, e2, e3

    argument = [x, y, z]
    do
      mean = sum(argument)/3.0_dp
      deviation = (mean - argument)/mean
      if (maxval(abs(deviation)) < CLOSE) exit
      shift = pair_sum(argument)
      argument = 0.25_dp*(argument + shift)
    end do
    e2 = deviation(1)*deviation(2) - deviation(3)**2
    e3 = product(deviation)
    rf = (1.0_dp - e2/10.0_dp + e3/14.0_dp + e2**2/24.0_dp - 3.0_dp*e2*e3/44.0_dp)/sqrt(mean)
  end function carlson_rf

  !> R_D(x, y, z): three halves of the integral of (t + z)**(-3/2)/sqrt((t + x)(t + y)) over t > 0.
  !>
  !> `x`, `y` >= 0, at most one of them 0, `z` > 0, neither subnormal nor close to overflow.
  elemental function carlson_rd(x, y, z) result(rd)
    real(dp), intent(in) :: x, y, z
    real(dp) :: rd
    real(dp) :: argument(3), deviation(3), mean, shift, power, total, xy, e2, e3, e4, e5

    argument = [x, y, z]
    power = 1.0_dp
    total = 0.0_dp
    do
      mean = (argument(1) + argument(2) + 3.0_dp*argument(3))/5.0_dp
      deviation = (mean - argument)/mean
      if (maxval(abs(deviation)) < CLOSE) exit
      shift = pair_sum(argument)
      total = total + power/(sqrt(argument(3))*(argument(3) + shift))
      power = 0.25_dp*power
      argument = 0.25_dp*(argument + shift)
    end do
    xy = deviation(1)*deviation(2)
    e2 = xy - 6.0_dp*deviation(3)**2
    e3 = (3.0_dp*xy - 8.0_dp*deviation(3)**2)*deviation(3)
    e4 = 3.0_dp*(xy - deviation(3)**2)*deviation(3)**2
    e5 = xy*deviation(3)**3
    rd = 3.0_dp*total + power/(mean*sqrt(mean))*(1.0_dp - 3.0_dp*e2/14.0_dp + e3/6.0_dp + 9.0_dp*e2**2/88.0_dp &
                                                 - 3.0_dp*e4/22.0_dp - 9.0_dp*e2*e3/52.0_dp + 3.0_dp*e5/26.0_dp)
  end function carlson_rd

  !> sqrt(x y) + sqrt(y z) + sqrt(z x) of the three arguments.
  pure function pair_sum(argument) result(shift)
    real(dp), intent(in) :: argument(3)
    real(dp) :: shift
    real(dp) :: root(3)

    root = sqrt(argument)
    shift = root(1)*root(2) + root(2)*root(3) + root(3)*root(1)
  end function pair_sum

end module fuge_carlson
