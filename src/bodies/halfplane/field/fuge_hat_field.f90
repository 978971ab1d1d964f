!> Stresses and displacements in a half-plane under hats of pressure, which fall linearly from a peak to both sides.
!>
!> Source: the potentials of K. L. Johnson, Contact Mechanics, 1985, section 2.5, for a pressure whose second derivative
!> is three line loads. With the distances s of a point from the left end, the middle and the right end of a hat, r
!> those in the plane, and d2 F = F(left) - 2 F(middle) + F(right),
!>
!>     zz = -(2 p/(pi w)) d2 (s atan(s/z)/2),   xx = zz + (2 p/(pi w)) z d2 ln(r),   xz = (p/(pi w)) z d2 atan(s/z).
!>
!> Farther away than the half base w, where second differences cancel, hats are integrated by Gauss-Legendre quadrature:
!> all terms of xx, and all of zz, then have one sign.
!>
!> Lengths are in a unit of the order of the narrowest hat; none exceeds 2**250.
module fuge_hat_field
  use fuge_arc_excess, only: arc_excess
  use fuge_compensated_sums, only: difference_rounding
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_strip_field, only: LEAST_SQUARE
  implicit none
  private

  public :: add_hats, add_hat_displacements

  !> Numbers of nodes in each half of a hat, and from which distance beside or below it, in half bases, they suffice.
  integer, parameter :: RULES = 5, NODES(RULES) = [17, 12, 8, 6, 4], MOST_NODES = maxval(NODES)
  real(dp), parameter :: FROM(RULES) = [1.0_dp, 2.0_dp, 5.0_dp, 12.0_dp, 200.0_dp]
  !> Terms of the series for displacements from two half bases on, and from eight on.
  integer, parameter :: TERMS = 24, TERMS_FAR = 9

  !> Nodes in the half base, 0 .. 1, and weights of the rules for a unit force in half a hat.
  type, public :: hat_rules
    private
    real(dp) :: node(MOST_NODES, RULES) = 0.0_dp, weight(MOST_NODES, RULES) = 0.0_dp
  contains
    procedure :: prepare
  end type hat_rules

contains

  pure subroutine prepare(self)
    class(hat_rules), intent(inout) :: self
    integer :: k

    do k = 1, RULES
      call gauss_rule(self%node(:NODES(k), k), self%weight(:NODES(k), k))
      self%weight(:, k) = self%weight(:, k)*(1.0_dp - self%node(:, k))
    end do
  end subroutine prepare

  !> Add -pi times the stresses xx, zz and xz of hats to `total` (3).
  !>
  !> `centre`, half base `width`, peak `pressure` (n); `px`, `pz` the point; `rules` prepared.
  pure subroutine add_hats(rules, centre, width, pressure, px, pz, total)
    type(hat_rules), intent(in) :: rules
    real(dp), intent(in), contiguous :: centre(:), width(:), pressure(:)
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(3)
    real(dp) :: away, distance, terms(3)
    integer :: k

    do k = 1, size(centre)
      distance = px - centre(k)
      away = max(abs(distance) - width(k), pz)
      if (away < FROM(1)*width(k)) then
        call close_terms(px, centre(k), width(k), pz, terms)
      else
        associate (rule => count(away >= FROM*width(k)))
          call quadrature(NODES(rule), rules%node(:, rule), rules%weight(:, rule), distance, width(k), pz, terms)
        end associate
      end if
      total = total + pressure(k)*terms
    end do
  end subroutine add_hats

  !> -pi times the stresses under a hat with a unit peak, from the half base on.
  pure subroutine quadrature(n, node, weight, distance, width, z, terms)
    integer, intent(in) :: n
    real(dp), intent(in) :: node(n), weight(n), distance, width, z
    real(dp), intent(out) :: terms(3)
    real(dp) :: s(2), across(2), along(2)
    integer :: k

    terms = 0.0_dp
    do k = 1, n
      s(1) = distance + width*node(k)
      s(2) = distance - width*node(k)
      across = z/(s**2 + z**2)
      along = s/(s**2 + z**2)
      terms(1) = terms(1) + weight(k)*sum(along**2)
      terms(2) = terms(2) + weight(k)*sum(across**2)
      terms(3) = terms(3) + weight(k)*sum(along*across)
    end do
    terms = 2.0_dp*z*width*terms
  end subroutine quadrature

  !> The same close to a hat.
  !>
  !> s atan(s/z)/2 is pi |s|/4 + z g/2 less a constant, where g = 1 - atan(z/|s|) |s|/z: the second difference of |s| is
  !> known, and that of g has no large terms to cancel beside the hat. Deep below its middle s atan(s/z) has none.
  pure subroutine close_terms(px, centre, width, z, terms)
    real(dp), intent(in) :: px, centre, width, z
    real(dp), intent(out) :: terms(3)
    real(dp) :: middle, rest, left, right, stretch, side
    real(dp) :: squares(3)

    ! As if the point lay on the right.
    side = sign(1.0_dp, px - centre)
    middle = abs(px - centre)
    rest = side*difference_rounding(px, centre, px - centre)
    left = (middle + width) + rest
    right = (middle - width) + rest
    if (middle < 0.5_dp*width .and. 2.0_dp*z > width) then
      terms(2) = 0.5_dp*(left*atan2(left, z) + right*atan2(right, z)) - middle*atan2(middle, z)
    else
      terms(2) = 0.5_dp*PI*max(0.0_dp, -right) + 0.5_dp*(lift(left, z) - 2.0_dp*lift(middle, z) + lift(abs(right), z))
    end if
    squares = [left, middle, right]**2 + z**2 + LEAST_SQUARE
    stretch = width**2*(width**2 - 2.0_dp*(middle - z)*(middle + z))
    if (abs(stretch) < 0.5_dp*squares(2)**2) then
      stretch = stretch/squares(2)**2
      stretch = 2.0_dp*atanh(stretch/(2.0_dp + stretch))
    else
      stretch = log(squares(1)/squares(2)) + log(squares(3)/squares(2))
    end if
    terms(1) = terms(2) - 0.5_dp*z*stretch
    terms(3) = side*0.5_dp*z*turns(left, middle, right, z)
    terms = 2.0_dp/width*terms
  end subroutine close_terms

  !> z g, s >= 0.
  pure function lift(s, z) result(lifted)
    real(dp), intent(in) :: s, z
    real(dp) :: lifted

    if (z <= s) then
      lifted = 0.0_dp
      if (s > 0.0_dp) lifted = s*arc_excess(z/s)
    else
      lifted = z - s*atan2(z, s)
    end if
  end function lift

  !> 2 atan(middle/z) - atan(left/z) - atan(right/z), by the angles between the lines of sight.
  pure function turns(left, middle, right, z) result(turn)
    real(dp), intent(in) :: left, middle, right, z
    real(dp) :: turn

    turn = 0.0_dp
    if (z > 0.0_dp) turn = atan2(z*(middle - right), z**2 + middle*right) - atan2(z*(left - middle), z**2 + left*middle)
  end function turns

  !> Add the means of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over each hat, times its force, to `total` (4), as
  !> `add_strip_displacements` does.
  pure subroutine add_hat_displacements(centre, width, pressure, px, pz, total)
    real(dp), intent(in), contiguous :: centre(:), width(:), pressure(:)
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(4)
    real(dp) :: distance
    integer :: k

    do k = 1, size(centre)
      distance = px - centre(k)
      if (max(abs(distance), pz) < 2.0_dp*width(k)) then
        total = total + pressure(k)*width(k)*close_means(distance/width(k), pz/width(k), width(k))
      else
        total = total + pressure(k)*width(k)*far_means(distance, pz, width(k))
      end if
    end do
  end subroutine add_hat_displacements

  !> The means over a hat of half base 1, whose middle is at the distance s; ln(r) in the unit of `width`.
  pure function close_means(s, z, width) result(mean)
    real(dp), intent(in) :: s, z, width
    real(dp) :: mean(4)
    real(dp) :: ends(3), logs(3), turn(3)
    real(dp), parameter :: WEIGHT(3) = [1.0_dp, -2.0_dp, 1.0_dp]

    ends = s + [1.0_dp, 0.0_dp, -1.0_dp]
    logs = WEIGHT*0.5_dp*log(ends**2 + z**2 + LEAST_SQUARE)
    turn = WEIGHT*atan2(ends, z + LEAST_SQUARE)
    mean(1) = sum(0.5_dp*(ends - z)*(ends + z)*logs + ends*z*turn) - 1.5_dp + log(width)
    mean(2) = z*sum(ends*turn - z*logs)
    mean(3) = z*sum(ends*logs + z*turn)
    mean(4) = sum(0.5_dp*(ends - z)*(ends + z)*turn - ends*z*logs)
  end function close_means

  !> The same from two half bases on, by the moments of the hat: its mean of (zeta - t)**(-1) is the sum of
  !> 2 width**(2 k)/((2 k + 1)(2 k + 2) zeta**(2 k + 1)), zeta = x + i z.
  pure function far_means(x, z, width) result(mean)
    real(dp), intent(in) :: x, z, width
    real(dp) :: mean(4)
    complex(dp) :: small, ratio, logarithm, inverse
    integer :: k, last

    small = width/cmplx(x, z, dp)
    ratio = small**2
    logarithm = 0.0_dp
    inverse = 0.0_dp
    last = merge(TERMS_FAR, TERMS, max(abs(x), z) >= 8.0_dp*width)
    do k = last, 1, -1
      logarithm = ratio*(logarithm + 1.0_dp/real(k*(2*k + 1)*(2*k + 2), dp))
      inverse = ratio*(inverse + 1.0_dp/real((2*k + 1)*(k + 1), dp))
    end do
    inverse = small*(1.0_dp + inverse)
    mean(1) = log(hypot(x, z)) - real(logarithm, dp)
    mean(2) = -(z/width)*aimag(inverse)
    mean(3) = (z/width)*real(inverse, dp)
    mean(4) = atan2(x, z) + aimag(logarithm)
  end function far_means

end module fuge_hat_field
