!> The field of a force that is spread evenly over a circle on the surface.
!>
!> Its potentials are means over the circle. Close to the circle they are complete elliptic integrals, by the means of
!> C. F. Gauss and the transformation of F. Bartky (Rev. Mod. Phys. 10, 1938, 264; R. Bulirsch, Numer. Math. 13, 1969,
!> 305), which also has that of the third kind; elsewhere the trapezoidal rule over the angle converges at once. Either
!> way one-signed integrals are sums of terms of one sign.
module fuge_circle_field
  use fuge_axial_field, only: AXIAL, FLUX, HOOP, INTEGRALS, POTENTIAL, RADIAL, SHEAR, SIDEWARD, SPREAD
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: circle_field, new_circle_rules

  !> Points of the trapezoidal rule on half of the circle, at most.
  integer, parameter :: MOST_ANGLES = 36
  !> The rule needs DIGITS/theta points, cosh(theta) = (r**2 + s**2 + z**2)/(2 r s), or DIGITS/ln(s/r) well inside, and
  !> MORE_ANGLES; it is used where cosh(theta) - 1 is at least FAR.
  real(dp), parameter :: DIGITS = 20.5_dp, FAR = 0.5_dp
  integer, parameter :: MORE_ANGLES = 3
  !> Two numbers with a smaller relative difference have the same means up to rounding.
  real(dp), parameter :: CLOSE = 1.0e-8_dp

  !> Angles of the trapezoidal rules; allocated, because the stack of a thread may be small.
  type, public :: circle_rules
    private
    !> sin(angle), and sin(angle/2)**2.
    real(dp), allocatable :: sine(:, :), half_square(:, :)
  end type circle_rules

contains

  pure function new_circle_rules() result(rules)
    type(circle_rules) :: rules
    real(dp) :: angle
    integer :: j, n

    allocate (rules%sine(MOST_ANGLES, MOST_ANGLES), rules%half_square(MOST_ANGLES, MOST_ANGLES), source=0.0_dp)
    do n = 1, MOST_ANGLES
      do j = 1, n
        angle = PI*(real(j, dp) - 0.5_dp)/real(n, dp)
        rules%sine(j, n) = sin(angle)
        rules%half_square(j, n) = sin(0.5_dp*angle)**2
      end do
    end do
  end function new_circle_rules

  !> The integrals of `fuge_axial_field` for a unit force on a circle of radius `s` > 0.
  !>
  !> `r`, `z` >= 0: the point in the body; `offset` = s - r, which may have more digits than the difference. z and
  !> offset are not both 0. The largest length is about 1.
  pure function circle_field(rules, s, r, z, offset) result(field)
    type(circle_rules), intent(in) :: rules
    real(dp), intent(in) :: s, r, z, offset
    real(dp) :: field(INTEGRALS)
    real(dp) :: excess
    logical :: inside
    integer :: n

    ! cosh(theta) - 1 times 2 r s.
    excess = offset**2 + z**2
    if (excess < 2.0_dp*FAR*r*s) then
      field = near_field(s, r, z, offset)
      return
    end if
    ! Close to the surface within the circle the spread would cancel but for a form of its own.
    inside = 2.0_dp*r < s .and. z < s
    n = MORE_ANGLES
    if (inside .and. r > tiny(r)) then
      n = n + int(DIGITS/log(s/r))
    else if (r*s > tiny(r)) then
      excess = 0.5_dp*excess/(r*s)
      n = n + int(DIGITS/asinh(sqrt(excess)*sqrt(excess + 2.0_dp)))
    end if
    field = far_field(s, r, z, offset, inside, rules%sine(:n, n), rules%half_square(:n, n))
  end function circle_field

  !> The same far from the circle, relative to r and s, by the trapezoidal rule.
  !> `inside`: as in `circle_field`.
  pure function far_field(s, r, z, offset, inside, sine, half_square) result(field)
    real(dp), intent(in) :: s, r, z, offset, sine(:), half_square(:)
    logical, intent(in) :: inside
    real(dp) :: field(INTEGRALS)
    real(dp) :: inverse, sum_inverse, root, depth, dr, dt, square, spread_term
    integer :: j

    field = 0.0_dp
    do j = 1, size(sine)
      root = sqrt((offset**2 + z**2) + 4.0_dp*r*s*half_square(j))
      inverse = 1.0_dp/root
      depth = z*inverse
      dr = (2.0_dp*s*half_square(j) - offset)*inverse
      dt = s*sine(j)*inverse
      if (inside) then
        spread_term = depth*(inverse*inverse)*sine(j)*winding(s, r, offset, sine(j), half_square(j))
      else
        sum_inverse = 1.0_dp/(root + z)
        spread_term = (1.0_dp - dt**2*((2.0_dp*root + z)*sum_inverse))*(inverse*sum_inverse)
      end if
      square = inverse**2
      field(POTENTIAL) = field(POTENTIAL) + inverse
      field(SPREAD) = field(SPREAD) + spread_term
      field(FLUX) = field(FLUX) + depth*square
      field(RADIAL) = field(RADIAL) + depth*dr**2*square
      field(HOOP) = field(HOOP) + depth*dt**2*square
      field(SHEAR) = field(SHEAR) + depth**2*(inverse*square)*(1.0_dp - 5.0_dp*dt**2)
      field(AXIAL) = field(AXIAL) + depth**3*square
    end do
    field([RADIAL, HOOP, AXIAL]) = 3.0_dp*field([RADIAL, HOOP, AXIAL])
    field(SHEAR) = 3.0_dp*r*field(SHEAR)
    field = field/real(size(sine), dp)
    ! By parts over the angle: no difference of the two sides of the circle.
    field(SIDEWARD) = r*(field(FLUX) - field(HOOP))
  end function far_field

  !> s/r times the angle at the point between the directions to the middle and to a point of the circle, r < s.
  pure function winding(s, r, offset, sine, half_square) result(angle)
    real(dp), intent(in) :: s, r, offset, sine, half_square
    real(dp) :: angle

    if (r > epsilon(r)*s) then
      angle = s/r*atan2(r*sine, offset + 2.0_dp*r*half_square)
    else
      angle = sine
    end if
  end function winding

  !> The same close to the circle, by elliptic integrals of the modulus k, k**2 = 4 r s/large**2.
  pure function near_field(s, r, z, offset) result(field)
    real(dp), intent(in) :: s, r, z, offset
    real(dp) :: field(INTEGRALS)
    real(dp) :: large, small, ratio, square, b, d, third, depth, side, fifth, unit

    large = hypot(r + s, z)
    small = hypot(offset, z)
    ratio = small/large
    square = ratio**2
    call elliptic_integrals(ratio, -offset/(r + s), b, d, third)
    depth = z/small
    side = offset/small
    unit = 2.0_dp/PI/large/small
    fifth = (2.0_dp + square)*b + square*(1.0_dp + 2.0_dp*square)*d
    field(POTENTIAL) = 2.0_dp/PI*(b + d)/large
    field(SPREAD) = (passed(offset)/r - z*(2.0_dp/PI)*third/(large*(r + s)))/r
    field(FLUX) = unit*depth*(b + square*d)
    field(RADIAL) = unit*depth*(side**2*fifth + square*(8.0_dp*r*s/large**2 + s/r)*d &
                                - s/r*((offset*(3.0_dp*r + s) + z**2)/large**2)*b)
    field(HOOP) = unit*depth*(s/r)*(b - square*d)
    field(SHEAR) = unit*depth**2*(2.0_dp*s*(small/large)/large*(b + 2.0_dp*square*d) - side*fifth)
    field(AXIAL) = unit*depth**3*fifth
    field(SIDEWARD) = 2.0_dp/PI/large*(2.0_dp*s*(z/large)/large*d - side*depth*(b + square*d))
  end function near_field

  !> The fraction of the force that lies nearer to the axis than the point.
  pure function passed(offset) result(fraction)
    real(dp), intent(in) :: offset
    real(dp) :: fraction

    fraction = 0.5_dp
    if (offset > 0.0_dp) fraction = 0.0_dp
    if (offset < 0.0_dp) fraction = 1.0_dp
  end function passed

  !> Integrals over a quarter of the circle, with c = cos**2, s = sin**2, Delta = sqrt(c + ratio**2 s), 0 < `ratio` < 1:
  !> `b` of c/Delta, `d` of s/Delta, `third` of (c + side s)/((c + side**2 s) Delta), its principal value for side = 0.
  !>
  !> Each is an integral of (x c + y s)/((c + p**2 s) sqrt(m**2 c + g**2 s)). It keeps its value while m and g are
  !> replaced by their means, until they are equal.
  pure subroutine elliptic_integrals(ratio, side, b, d, third)
    real(dp), intent(in) :: ratio, side
    real(dp), intent(out) :: b, d, third
    real(dp) :: m, g, p(3), x(3), y(3), next(3), product_of_means
    logical :: last

    m = 1.0_dp
    g = ratio
    p = [1.0_dp, 1.0_dp, abs(side)]
    x = [1.0_dp, 0.0_dp, 1.0_dp]
    ! y is that of the integral over p.
    y = [0.0_dp, 1.0_dp, sign(1.0_dp, side)]
    if (.not. abs(side) > 0.0_dp) then
      p(3) = 1.0_dp
      y(3) = 1.0_dp
    end if
    do
      last = abs(m - g) <= CLOSE*m
      product_of_means = m*g
      next = 0.5_dp*(x + y/p)
      y = 0.5_dp*(y + x*(product_of_means/p))
      x = next
      p = 0.5_dp*(p + product_of_means/p)
      m = 0.5_dp*(m + g)
      g = sqrt(product_of_means)
      if (last) exit
    end do
    x = 0.5_dp*PI*(x*m + y)/(m*(m + p))
    b = x(1)
    d = x(2)
    third = x(3)
  end subroutine elliptic_integrals

end module fuge_circle_field
