!> The mean of 1/r over rings about one axis, close to each other, in closed form.
!>
!> Uniform pressure on a disc displaces the surface by complete elliptic integrals (K. L. Johnson, Contact Mechanics,
!> 1985, section 3.4), and so do two coaxial discs each other in the mean. With K(k) and D = (K - E)/k**2, the
!> integral of 1/r over the discs of radii a <= b, over pi**2, is
!>
!>     8/(3 pi) b a**2 (2 K - (1 + k**2) D),   k = a/b.
!>
!> K and D/K follow from the arithmetic-geometric mean of b and sqrt(b**2 - a**2) (C. F. Gauss; NIST Digital Library of
!> Mathematical Functions, section 19.8), D by a sum of positive terms. Rings are differences of discs, which cancel
!> by the ratios of the radii to the widths; so they are formed with 32 digits.
module fuge_ring_potential
  use fuge_double_double, only: double_double, exact_difference, exact_product, exact_sum, operator(+), operator(-), &
    operator(*), operator(/), sqrt
  use fuge_kinds, only: dp
  implicit none
  private

  public :: near_ring_mean, near_ring_value

  type(double_double), parameter :: ONE = double_double(1.0_dp, 0.0_dp)
  !> 16/(3 pi) and 4/pi.
  type(double_double), parameter :: EQUAL_DISCS = double_double(1.6976527263135504_dp, -1.0495294226763993e-16_dp), &
    DISC_EDGE = double_double(1.2732395447351628_dp, -7.871470670072994e-17_dp)
  !> The mean of two numbers converges quadratically: below this ratio of their difference the next one is exact.
  real(dp), parameter :: LAST_DIFFERENCE = 1.0e-17_dp

contains

  !> The mean of 1/r over two rings, rounded once; 1 over length. `observed` (2), `loaded` (2): inner and outer radius.
  pure function near_ring_mean(observed, loaded) result(mean)
    real(dp), intent(in) :: observed(2), loaded(2)
    real(dp) :: mean
    real(dp) :: seen(2), pressed(2)
    type(double_double) :: total
    integer :: unit

    unit = exponent(max(observed(2), loaded(2)))
    seen = scale(observed, -unit)
    pressed = scale(loaded, -unit)
    total = (pair_potential(seen(2), pressed(2)) - pair_potential(seen(1), pressed(2))) &
            - (pair_potential(seen(2), pressed(1)) - pair_potential(seen(1), pressed(1)))
    total = total/(ring_area(seen)*ring_area(pressed))
    mean = scale(total%high, -unit)
  end function near_ring_mean

  !> The mean of 1/r over a ring from a point at the distance `place` from the axis; 1 over length. `loaded` as above.
  pure function near_ring_value(place, loaded) result(mean)
    real(dp), intent(in) :: place, loaded(2)
    real(dp) :: mean
    real(dp) :: seen, pressed(2)
    type(double_double) :: total
    integer :: unit

    unit = exponent(max(place, loaded(2)))
    seen = scale(place, -unit)
    pressed = scale(loaded, -unit)
    total = (point_potential(seen, pressed(2)) - point_potential(seen, pressed(1)))/ring_area(pressed)
    mean = scale(total%high, -unit)
  end function near_ring_value

  !> The area of a ring over pi.
  pure function ring_area(radii) result(area)
    real(dp), intent(in) :: radii(2)
    type(double_double) :: area

    area = exact_difference(radii(2), radii(1))*exact_sum(radii(2), radii(1))
  end function ring_area

  !> The integral of 1/r over two discs, over pi**2; `a`, `b` their radii, length.
  pure function pair_potential(a, b) result(potential)
    real(dp), intent(in) :: a, b
    type(double_double) :: potential, mean, ratio, modulus
    real(dp) :: small, large

    small = min(a, b)
    large = max(a, b)
    if (.not. small > 0.0_dp) then
      potential = double_double(0.0_dp, 0.0_dp)
    else if (.not. small < large) then
      potential = EQUAL_DISCS*exact_product(large, large)*large
    else
      call elliptic_mean(small, large, mean, ratio)
      modulus = double_double(small, 0.0_dp)/double_double(large, 0.0_dp)
      potential = (double_double(2.0_dp, 0.0_dp) - (ONE + modulus*modulus)*ratio)/(mean*3.0_dp)
      potential = potential*exact_product(small, small)*exact_product(large, large)*4.0_dp
    end if
  end function pair_potential

  !> The integral of 1/r over a disc of radius `b` from a point at `r` from its axis, over pi; length.
  pure function point_potential(r, b) result(potential)
    real(dp), intent(in) :: r, b
    type(double_double) :: potential, mean, ratio, modulus

    if (.not. b > 0.0_dp) then
      potential = double_double(0.0_dp, 0.0_dp)
    else if (r < b) then
      call elliptic_mean(r, b, mean, ratio)
      modulus = double_double(r, 0.0_dp)/double_double(b, 0.0_dp)
      potential = (ONE - modulus*modulus*ratio)/mean*exact_product(b, b)*2.0_dp
    else if (r > b) then
      call elliptic_mean(b, r, mean, ratio)
      potential = (ONE - ratio)/mean*exact_product(b, b)*2.0_dp
    else
      potential = DISC_EDGE*b
    end if
  end function point_potential

  !> The arithmetic-geometric mean pi `large`/(2 K) and the ratio D/K, for the modulus small/large < 1.
  !>
  !> With c_0 = small and c_(n+1) = c_n**2/(4 a_(n+1)), D/K is the sum of 2**(n - 1) (c_n/c_0)**2.
  pure subroutine elliptic_mean(small, large, mean, ratio)
    real(dp), intent(in) :: small, large
    type(double_double), intent(out) :: mean, ratio
    type(double_double) :: geometric, next, c, relative
    real(dp) :: factor

    mean = double_double(large, 0.0_dp)
    geometric = sqrt(exact_difference(large, small)*exact_sum(large, small))
    c = double_double(small, 0.0_dp)
    relative = ONE
    ratio = double_double(0.5_dp, 0.0_dp)
    factor = 1.0_dp
    do
      next = (mean + geometric)*0.5_dp
      relative = relative*c/(next*4.0_dp)
      c = c*c/(next*4.0_dp)
      ratio = ratio + relative*relative*factor
      factor = 2.0_dp*factor
      if (c%high <= LAST_DIFFERENCE*next%high) exit
      geometric = sqrt(mean*geometric)
      mean = next
    end do
    mean = next
  end subroutine elliptic_mean

end module fuge_ring_potential
