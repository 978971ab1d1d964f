!> Stresses and displacements in a half-plane under uniform strips of pressure, in closed form.
!>
!> Source: K. L. Johnson, Contact Mechanics, 1985, section 2.5. With x1 and x2 the distances of a point from the left and
!> the right end of a strip, r1 and r2 its distances from them in the plane, w = x1 - x2 and A the angle under which it
!> sees the strip,
!>
!>     zz = -(p/pi) (A + w z (z**2 - x1 x2)/(r1 r2)**2),   xx with - for +,   xz = -(p/pi) w z**2 (x1 + x2)/(r1 r2)**2.
!>
!> The two terms of zz cancel beside the strip, those of xx below it. There, with D = x1 x2 + z**2 and t = tan(A) = w z/D,
!>
!>     zz = -(p/pi) (w z**3 (w**2/D + 2)/(r1 r2)**2 - (t - atan(t))),
!>     xx = -(p/pi) (w z (w**2 z**2/D + 2 x1 x2)/(r1 r2)**2 - (t - atan(t))),
!>
!> where they do not, so that zz and xx are accurate relative to themselves everywhere, however deep or far away.
!>
!> Lengths are in a unit of the order of the narrowest strip; none exceeds 2**250.
module fuge_strip_field
  use fuge_arc_excess, only: arc_excesses
  use fuge_compensated_sums, only: difference_rounding
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_strips, add_strip_displacements, view_angle

  !> Added to squares of distances: what lies closer to an end of a strip, 1e-78 of its width, counts as the end.
  real(dp), parameter, public :: LEAST_SQUARE = scale(1.0_dp, -520)
  !> Strips whose terms are computed together.
  integer, parameter :: BLOCK = 32

contains

  !> Add -pi times the stresses xx, zz and xz of strips to `total` (3).
  !>
  !> `centre`, `width`, `pressure` (n) of the strips; `px`, `pz` the point. At z = 0 the stresses at an end of a strip are
  !> the mean of those at both sides.
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

  pure subroutine add_block(n, centre, width, pressure, px, pz, total)
    integer, intent(in) :: n
    real(dp), intent(in) :: centre(n), width(n), pressure(n), px, pz
    real(dp), intent(inout) :: total(3)
    real(dp), dimension(BLOCK) :: left, right, cross, tangent, excess
    real(dp) :: terms(3), block_total(3)
    integer :: k

    do k = 1, n
      left(k) = beyond(px, centre(k), 0.5_dp*width(k))
      right(k) = beyond(px, centre(k), -0.5_dp*width(k))
      cross(k) = left(k)*right(k) + pz**2
      tangent(k) = min(abs(cross(k)), width(k)*pz)/max(abs(cross(k)), width(k)*pz, LEAST_SQUARE)
    end do
    call arc_excesses(n, tangent, excess)
    block_total = 0.0_dp
    do k = 1, n
      call strip_terms(left(k), right(k), width(k), pz, cross(k), tangent(k), excess(k), terms)
      block_total = block_total + pressure(k)*terms
    end do
    total = total + block_total
  end subroutine add_block

  !> x - c + h, rounded once or nearly so wherever it is.
  pure function beyond(x, c, h) result(distance)
    real(dp), intent(in) :: x, c, h
    real(dp) :: distance

    distance = x - c
    distance = (distance + h) + difference_rounding(x, c, distance)
  end function beyond

  !> -pi times the stresses under a unit pressure, as above; `excess` is t - atan(t), or that of 1/t where t > 1.
  pure subroutine strip_terms(left, right, width, z, cross, tangent, excess, terms)
    real(dp), intent(in) :: left, right, width, z, cross, tangent, excess
    real(dp), intent(out) :: terms(3)
    real(dp) :: over_left, over_right, steep, flat, ratio, angle, bend, small

    over_left = 1.0_dp/(left**2 + z**2 + LEAST_SQUARE)
    over_right = 1.0_dp/(right**2 + z**2 + LEAST_SQUARE)
    steep = (z*over_left)*(z*over_right)
    flat = (left*over_left)*(right*over_right)
    ratio = width**2/max(cross, LEAST_SQUARE)
    small = tangent - excess
    angle = 0.5_dp*PI - sign(small, cross)
    if (cross < -width*z) angle = PI - small
    bend = width*z*(steep - flat)
    if (cross > width*z) then
      terms(1) = width*z*(ratio*steep + 2.0_dp*flat) - excess
      terms(2) = width*z*steep*(ratio + 2.0_dp) - excess
    else
      terms(1) = angle - bend
      terms(2) = angle + bend
    end if
    terms(3) = width*steep*(left + right)
  end subroutine strip_terms

  !> Add the means of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over each strip, times its force, to `total` (4), r being
  !> the distance from a point of the strip and x its part along the surface.
  !>
  !> Arguments as for `add_strips`.
  pure subroutine add_strip_displacements(centre, width, pressure, px, pz, total)
    real(dp), intent(in), contiguous :: centre(:), width(:), pressure(:)
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(4)
    real(dp) :: left, right
    integer :: k

    do k = 1, size(centre)
      left = beyond(px, centre(k), 0.5_dp*width(k))
      right = beyond(px, centre(k), -0.5_dp*width(k))
      total = total + pressure(k)*strip_integrals(left, right, width(k), pz)
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
