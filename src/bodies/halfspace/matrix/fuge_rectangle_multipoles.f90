!> The mean of 1/r over rectangles far from each other, by multipoles.
!>
!> With the offset R of the centres, and q the difference of two points of the rectangles
!> measured from the centres, 1/|R + q| is the sum over l of |q|**l P_l(cos gamma)/R**(l + 1), gamma being
!> the angle between q and R. In the mean over q, whose distribution is even along x and along y, only
!> even l = 2 m remain, and of P_2m, a sum of cosines of even multiples of gamma with positive
!> coefficients, only the part even in the angle theta of R:
!>
!>     mean = (1/R) (1 + sum over m >= 1, 0 <= j <= m of weight(j, m) (s/R)**(2 m) cos(2 j theta)),
!>
!> weight(j, m) = a(j, m) times the mean of |q/s|**(2 m) cos(2 j phi), phi the angle of q and s the greatest |q|.
module fuge_rectangle_multipoles
  use fuge_kinds, only: dp
  implicit none
  private

  public :: expansion_order, new_cosine_powers, new_multipoles, sum_mixed_multipoles, sum_multipoles

  !> The highest order m of the series.
  integer, parameter, public :: HIGHEST_ORDER = 20
  !> The series is used where (s/R)**2 is below this; then HIGHEST_ORDER terms leave less than ROUNDING.
  real(dp), parameter, public :: FAR_RATIO = 0.18_dp
  real(dp), parameter :: ROUNDING = epsilon(1.0_dp)/32.0_dp

  !> Polynomials that do not depend on the rectangles; too many for the stack of a small thread.
  type, public :: cosine_powers
    !> Coefficient of x**(2 k) y**(2 (m - k)) in a(j, m) |q|**(2 m) cos(2 j phi), q = (x, y): (k, j, m).
    real(dp), allocatable :: coefficient(:, :, :)
  end type cosine_powers

  !> The multipoles of a pair of rectangles.
  type, public :: multipoles
    real(dp) :: weight(0:HIGHEST_ORDER, 0:HIGHEST_ORDER)
    integer :: order = 0
  end type multipoles

contains

  !> The polynomials, by the recurrence of |q|**(2 j) cos(2 j phi), which is that of Chebyshev's
  !> polynomials of x**2 - y**2 and x**2 + y**2. `stat` as in an allocate statement.
  pure subroutine new_cosine_powers(powers, stat)
    type(cosine_powers), intent(out) :: powers
    integer, intent(out) :: stat
    real(dp), dimension(0:HIGHEST_ORDER) :: cosine, former, latter
    integer :: j, m

    allocate (powers%coefficient(0:HIGHEST_ORDER, 0:HIGHEST_ORDER, 0:HIGHEST_ORDER), source=0.0_dp, stat=stat)
    if (stat /= 0) return
    cosine = 0.0_dp
    cosine(0) = 1.0_dp
    former = 0.0_dp
    do j = 0, HIGHEST_ORDER
      latter = cosine
      do m = j, HIGHEST_ORDER
        if (m > j) latter = latter + eoshift(latter, -1)
        powers%coefficient(:, j, m) = legendre_cosine(j, m)*latter
      end do
      latter = eoshift(cosine, -1) - cosine
      if (j > 0) latter = 2.0_dp*latter - twice_shifted(former)
      former = cosine
      cosine = latter
    end do
  end subroutine new_cosine_powers

  !> A polynomial times (x**2 + y**2)**2.
  pure function twice_shifted(polynomial) result(shifted)
    real(dp), intent(in) :: polynomial(0:)
    real(dp) :: shifted(0:size(polynomial) - 1)

    shifted = polynomial + 2.0_dp*eoshift(polynomial, -1) + eoshift(polynomial, -2)
  end function twice_shifted

  !> a(j, m): the coefficient of cos(2 j gamma) in P_2m(cos gamma).
  pure function legendre_cosine(j, m) result(a)
    integer, intent(in) :: j, m
    real(dp) :: a

    a = central(m - j)*central(m + j)
    if (j > 0) a = 2.0_dp*a
  end function legendre_cosine

  !> The central binomial coefficient (2 k over k), divided by 4**k.
  pure function central(k) result(c)
    integer, intent(in) :: k
    real(dp) :: c
    integer :: i

    c = 1.0_dp
    do i = 1, k
      c = c*real(2*i - 1, dp)/real(2*i, dp)
    end do
  end function central

  !> The smallest order that leaves less than rounding at (s/R)**2 = `ratio`, because the mean of
  !> |q/s|**(2 m) is at most 1/(2 m + 1), that of a needle.
  pure function expansion_order(ratio) result(order)
    real(dp), intent(in) :: ratio
    integer :: order
    real(dp) :: rest

    rest = ratio**2
    do order = 1, HIGHEST_ORDER - 1
      if (rest < ROUNDING*real(2*order + 3, dp)) exit
      rest = rest*ratio
    end do
  end function expansion_order

  !> The multipoles up to `order` of rectangles of the widths `observed` (2) and `loaded` (2), along x and y;
  !> `observed` = 0 is a point. `reach` is s, half the diagonal of the sums of the widths.
  pure subroutine new_multipoles(powers, order, observed, loaded, reach, terms)
    type(cosine_powers), intent(in) :: powers
    integer, intent(in) :: order
    real(dp), intent(in) :: observed(2), loaded(2), reach
    type(multipoles), intent(inout) :: terms
    real(dp) :: along_x(1, 0:HIGHEST_ORDER), along_y(1, 0:HIGHEST_ORDER), moment(0:HIGHEST_ORDER)
    integer :: j, m

    call even_moments(observed(1:1), loaded(1), [reach**2], order, along_x)
    call even_moments(observed(2:2), loaded(2), [reach**2], order, along_y)
    terms%order = order
    do m = 1, order
      moment(:m) = along_x(1, :m)*along_y(1, m:0:-1)
      do j = 0, m
        terms%weight(j, m) = dot_product(powers%coefficient(:m, j, m), moment(:m))
      end do
    end do
  end subroutine new_multipoles

  !> `moment(i, k)`: the means of (s - t)**(2 k) over |s| <= a(i)/2 and |t| <= b/2, for k = 0 .. `order`, divided by
  !> `square(i)`**k.
  !>
  !> With 2 p = a + b and 2 q = a - b, the mean is the sum of all p**(2 i) q**(2 (k - i)), divided by (2 k + 1)(k + 1).
  !> All terms are positive.
  pure subroutine even_moments(a, b, square, order, moment)
    real(dp), intent(in) :: a(:), b, square(:)
    integer, intent(in) :: order
    real(dp), intent(out) :: moment(:, 0:)
    real(dp), dimension(size(a)) :: p2, q2, power, total
    integer :: k

    p2 = 0.25_dp*(a + b)**2/square
    q2 = 0.25_dp*(a - b)**2/square
    power = 1.0_dp
    total = 1.0_dp
    moment(:, 0) = 1.0_dp
    do k = 1, order
      power = power*q2
      total = total*p2 + power
      moment(:, k) = total*(1.0_dp/real((2*k + 1)*(k + 1), dp))
    end do
  end subroutine even_moments

  !> The sum over m >= 1 and j at places with (s/R)**2 = `ratio` and cos(2 theta) = `cosine`, by Horner's rule in the
  !> one and Clenshaw's in the other. All arrays have one length. `terms` has at least `order` orders.
  pure subroutine sum_multipoles(terms, order, ratio, cosine, correction)
    type(multipoles), intent(in) :: terms
    integer, intent(in) :: order
    real(dp), intent(in), contiguous :: ratio(:), cosine(:)
    real(dp), intent(out), contiguous :: correction(:)
    real(dp), dimension(size(ratio)) :: scaled_cosine, above, two_above
    real(dp) :: radial
    integer :: j, k, m

    above = 0.0_dp
    two_above = 0.0_dp
    scaled_cosine = ratio*cosine
    ! Each term of Clenshaw's recurrence is divided by ratio**j.
    do j = order, 1, -1
      correction = 0.0_dp
      do m = order, j, -1
        do k = 1, size(ratio)
          correction(k) = correction(k)*ratio(k) + terms%weight(j, m)
        end do
      end do
      do k = 1, size(ratio)
        radial = correction(k) + 2.0_dp*scaled_cosine(k)*above(k) - ratio(k)**2*two_above(k)
        two_above(k) = above(k)
        above(k) = radial
      end do
    end do
    correction = 0.0_dp
    do m = order, 1, -1
      do k = 1, size(ratio)
        correction(k) = (correction(k) + terms%weight(0, m))*ratio(k)
      end do
    end do
    correction = correction + scaled_cosine*above - ratio**2*two_above
  end subroutine sum_multipoles

  !> As `sum_multipoles`, for pairs of different widths: `observed_x`, `observed_y` (n), and `loaded` (2) of all;
  !> `square` (n) is s**2. The moments cost (order + 1)**3/3 operations for each pair. Nine arguments: what is known of
  !> each pair.
  pure subroutine sum_mixed_multipoles(powers, order, observed_x, observed_y, loaded, square, ratio, cosine, correction)
    type(cosine_powers), intent(in) :: powers
    integer, intent(in) :: order
    real(dp), intent(in), contiguous :: observed_x(:), observed_y(:), square(:), ratio(:), cosine(:)
    real(dp), intent(in) :: loaded(2)
    real(dp), intent(out), contiguous :: correction(:)
    real(dp), dimension(size(ratio), 0:order) :: along_x, along_y, moment, radial
    real(dp), dimension(size(ratio)) :: power, weight, above, two_above
    integer :: i, j, k, m

    call even_moments(observed_x, loaded(1), square, order, along_x)
    call even_moments(observed_y, loaded(2), square, order, along_y)
    radial = 0.0_dp
    power = 1.0_dp
    do m = 1, order
      power = power*ratio
      do k = 0, m
        moment(:, k) = along_x(:, k)*along_y(:, m - k)
      end do
      do j = 0, m
        weight = 0.0_dp
        do k = 0, m
          do i = 1, size(ratio)
            weight(i) = weight(i) + powers%coefficient(k, j, m)*moment(i, k)
          end do
        end do
        radial(:, j) = radial(:, j) + power*weight
      end do
    end do
    above = 0.0_dp
    two_above = 0.0_dp
    do j = order, 1, -1
      weight = radial(:, j) + 2.0_dp*cosine*above - two_above
      two_above = above
      above = weight
    end do
    correction = radial(:, 0) + cosine*above - two_above
  end subroutine sum_mixed_multipoles

end module fuge_rectangle_multipoles
