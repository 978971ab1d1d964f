!> Stresses and displacements in a half-plane under uniform strips of pressure, in closed form.
!>
!> Source: K. L. Johnson, Contact Mechanics, 1985, section 2.5. With x1 and x2 the distances of a point from the left
!> and the right end of a strip, r1 and r2 its distances from them in the plane, w = x1 - x2 and A the angle under
!> which it sees the strip,
!>
!>     zz = -(p/pi) (A + w z (z**2 - x1 x2)/(r1 r2)**2),   xx with - for +,   xz = -(p/pi) w z**2 (x1 + x2)/(r1 r2)**2.
!>
!> The two terms of zz cancel beside the strip, those of xx below it. With D = x1 x2 + z**2 and t = tan(A) = w z/D
!>
!>     zz = -(p/pi) (w z**3 (w**2/D + 2)/(r1 r2)**2 - (t - atan(t))),
!>     xx = -(p/pi) (w z (w**2 z**2/D + 2 x1 x2)/(r1 r2)**2 - (t - atan(t))),
!>
!> have no such terms; they are used where A < pi/4, so that zz and xx are accurate relative to themselves at any depth
!> and distance.
!>
!> Lengths are in a unit of the order of the narrowest strip; none exceeds 2**250.
module fuge_strip_field
  use fuge_arc_excess, only: arc_excesses
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_strips, add_strip_displacements, view_angle

  !> Added to squares of distances, so that none is 0: points closer to an end of a strip than about 1e-78 count as
  !> lying at it.
  real(dp), parameter, public :: LEAST_SQUARE = scale(1.0_dp, -520)
  !> Strips whose terms are computed together.
  integer, parameter :: BLOCK = 32

contains

  !> Add -pi times the stresses xx, zz and xz of strips to `total` (3).
  !>
  !> `centre`, `width`, `pressure` (n) of the strips; `px`, `pz` the point. At z = 0 the stresses at an end of a strip
  !> are the mean of those at both sides.
  pure subroutine add_strips(centre, width, pressure, px, pz, total)
    real(dp), intent(in), contiguous :: centre(:), width(:), pressure(:)
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(3)
    integer :: first, last

    do first = 1, size(centre), BLOCK
      last = min(first + BLOCK - 1, size(centre))
      call add_block(last - first + 1, centre(first:last), width(first:last), pressure(first:last), px, pz, total)
    end do
  end subroutine add_strips

  !> The same for at most BLOCK strips, one step after the other for all of them, so that compilers vectorise each step.
  pure subroutine add_block(n, centre, width, pressure, px, pz, total)
    integer, intent(in) :: n
    real(dp), intent(in) :: centre(n), width(n), pressure(n), px, pz
    real(dp), intent(inout) :: total(3)
    real(dp), dimension(BLOCK) :: left, right, cross, tangent, excess, xx, zz, xz, wide_xx, wide_zz
    integer :: k

    call find_ends(n, centre, width, px, left, right)
    do k = 1, n
      cross(k) = left(k)*right(k) + pz**2
      tangent(k) = smaller(abs(cross(k)), width(k)*pz)/(larger(abs(cross(k)), width(k)*pz) + LEAST_SQUARE)
    end do
    call arc_excesses(n, tangent, excess)
    do k = 1, n
      call strip_terms(left(k), right(k), width(k), pz, cross(k), tangent(k), excess(k), xx(k), zz(k), xz(k), &
                       wide_xx(k), wide_zz(k))
    end do
    do k = 1, n
      xx(k) = merge(xx(k), wide_xx(k), cross(k) > width(k)*pz)
      zz(k) = merge(zz(k), wide_zz(k), cross(k) > width(k)*pz)
    end do
    total = total + [dot_product(pressure, xx(:n)), dot_product(pressure, zz(:n)), dot_product(pressure, xz(:n))]
  end subroutine add_block

  !> Distances from the left and the right ends, rounded once or nearly so wherever the strips are: px - centre in full,
  !> by D. E. Knuth, The Art of Computer Programming 2, section 4.2.2.
  pure subroutine find_ends(n, centre, width, px, left, right)
    integer, intent(in) :: n
    real(dp), intent(in) :: centre(n), width(n), px
    real(dp), intent(out) :: left(n), right(n)
    real(dp) :: distance, rest, rounding
    integer :: k

    do k = 1, n
      distance = px - centre(k)
      rest = px - distance
      rounding = (px - (distance + rest)) + (rest - centre(k))
      left(k) = (distance + 0.5_dp*width(k)) + rounding
      right(k) = (distance - 0.5_dp*width(k)) + rounding
    end do
  end subroutine find_ends

  !> The smaller one of two numbers, neither of which is NaN. Unlike the intrinsic function it is vectorised.
  pure function smaller(a, b)
    real(dp), intent(in) :: a, b
    real(dp) :: smaller

    smaller = merge(a, b, a < b)
  end function smaller

  pure function larger(a, b)
    real(dp), intent(in) :: a, b
    real(dp) :: larger

    larger = merge(a, b, a > b)
  end function larger

  !> -pi times the stresses under a unit pressure, `wide_xx` and `wide_zz` those of a strip seen under more than pi/4;
  !> `excess` is t - atan(t), or that of 1/t where t > 1.
  !>
  !> Both pairs are always computed, because a loop with a branch is not vectorised. The arguments are twelve, because
  !> with plain numbers a loop over points is vectorised.
  pure subroutine strip_terms(left, right, width, z, cross, tangent, excess, xx, zz, xz, wide_xx, wide_zz)
    real(dp), intent(in) :: left, right, width, z, cross, tangent, excess
    real(dp), intent(out) :: xx, zz, xz, wide_xx, wide_zz
    real(dp) :: over_left, over_right, steep, flat, ratio, angle, bend
    logical :: obtuse

    over_left = 1.0_dp/(left**2 + z**2 + LEAST_SQUARE)
    over_right = 1.0_dp/(right**2 + z**2 + LEAST_SQUARE)
    steep = (z*over_left)*(z*over_right)
    flat = (left*over_left)*(right*over_right)
    xz = width*steep*(left + right)
    ratio = width**2/larger(cross, LEAST_SQUARE)
    xx = width*z*(ratio*steep + 2.0_dp*flat) - excess
    zz = width*z*steep*(ratio + 2.0_dp) - excess
    ! More than 3 pi/4.
    obtuse = cross < -width*z
    angle = merge(PI, 0.5_dp*PI, obtuse) - merge(-1.0_dp, 1.0_dp, obtuse)*sign(tangent - excess, cross)
    bend = width*z*(steep - flat)
    wide_xx = angle - bend
    wide_zz = angle + bend
  end subroutine strip_terms

  !> Add the means of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over each strip, times its force, to `total` (4), r being
  !> the distance from a point of the strip and x its part along the surface.
  !>
  !> Arguments as for `add_strips`.
  pure subroutine add_strip_displacements(centre, width, pressure, px, pz, total)
    real(dp), intent(in), contiguous :: centre(:), width(:), pressure(:)
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(4)
    real(dp) :: left(1), right(1)
    integer :: k

    do k = 1, size(centre)
      call find_ends(1, centre(k:k), width(k:k), px, left, right)
      total = total + pressure(k)*strip_integrals(left(1), right(1), width(k), pz)
    end do
  end subroutine add_strip_displacements

  !> The integrals of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over a strip, without cancellation far from it.
  pure function strip_integrals(left, right, width, z) result(integral)
    real(dp), intent(in) :: left, right, width, z
    real(dp) :: integral(4)
    real(dp) :: log_left, log_right, log_ratio, turn_left, turn_right, angle, middle, slope

    log_left = 0.5_dp*log(left**2 + z**2 + LEAST_SQUARE)
    log_right = 0.5_dp*log(right**2 + z**2 + LEAST_SQUARE)
    turn_left = atan2(left, z + LEAST_SQUARE)
    turn_right = atan2(right, z + LEAST_SQUARE)
    angle = view_angle(width*z, left*right + z**2)
    middle = 0.5_dp*(left + right)
    slope = width*(2.0_dp*middle)/(left**2 + right**2 + 2.0_dp*z**2)
    if (abs(slope) < 0.5_dp) then
      log_ratio = atanh(slope)
      integral(1) = 0.5_dp*width*(log_left + log_right) + middle*log_ratio
      integral(4) = 0.5_dp*width*(turn_left + turn_right) + middle*angle
    else
      log_ratio = log_left - log_right
      integral(1) = left*log_left - right*log_right
      integral(4) = left*turn_left - right*turn_right
    end if
    integral(1) = integral(1) + (z*angle - width)
    integral(2) = z*angle
    integral(3) = z*log_ratio
    integral(4) = integral(4) - z*log_ratio
  end function strip_integrals

  !> The angle 0 .. pi whose tangent is `opposite`/`adjacent`; pi/2 if both are 0.
  pure function view_angle(opposite, adjacent) result(angle)
    real(dp), intent(in) :: opposite, adjacent
    real(dp) :: angle

    angle = 0.5_dp*PI
    if (max(opposite, abs(adjacent)) > 0.0_dp) angle = atan2(opposite, adjacent)
  end function view_angle

end module fuge_strip_field
