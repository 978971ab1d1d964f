!> The field of a flat round punch, of which that of any round punch is a sum.
!>
!> The pressure 1/sqrt(t**2 - r**2) on a disc of radius t has potentials that are those of a point at the complex depth
!> z + i t (I. N. Sneddon, Proc. Camb. Phil. Soc. 42, 1946, 29; W. D. Collins, Mathematika 6, 1959, 120):
!>
!>     S = sqrt(r**2 + (z + i t)**2) = t (lambda + i mu),   dV/dz = 2 pi Im(1/S),   V = 2 pi arccot(lambda), ..
!>
!> lambda and mu are oblate spheroidal coordinates, z = t lambda mu, 0 <= mu <= 1. In them all derivatives are rational,
!> and those that have one sign are sums of terms of one sign.
module fuge_flat_punch_field
  use fuge_axial_field, only: AXIAL, FLUX, HOOP, INTEGRALS, POTENTIAL, RADIAL, SHEAR, SIDEWARD, SPREAD
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: flat_punch_field

contains

  !> The integrals of `fuge_axial_field` over the disc of radius `t` > 0.
  !>
  !> `r`, `z` >= 0: the point in the body; `offset` = r - t, which may have more digits than the difference. z and
  !> offset are not both 0.
  pure function flat_punch_field(t, r, z, offset) result(field)
    real(dp), intent(in) :: t, r, z, offset
    real(dp) :: field(INTEGRALS)
    real(dp) :: lambda, mu, modulus, a, b, outer, sine

    call spheroidal_coordinates(t, r, z, offset, lambda, mu)
    modulus = lambda**2 + mu**2
    a = lambda*(lambda/modulus)
    b = mu*(mu/modulus)
    outer = 1.0_dp/(1.0_dp + lambda**2)
    ! 1 - mu**2, which may have lost its digits.
    sine = (r/t)*((r/t)*outer)
    field(POTENTIAL) = t*atan2(1.0_dp, lambda)
    field(SPREAD) = outer/(1.0_dp + mu)
    field(FLUX) = mu/modulus
    field(RADIAL) = mu*(outer*((2.0_dp*a**2*sine + b*(b - a))/modulus + a*b**2*(3.0_dp + lambda**2)) &
                        + 3.0_dp*a**3*(sine*outer))
    field(HOOP) = field(FLUX)*outer
    field(SHEAR) = lambda*mu*(r/t)*(mu/modulus)*((3.0_dp*a - b)/modulus)
    field(AXIAL) = mu*b*((b + a*(5.0_dp - mu**2))/modulus + 3.0_dp*a**2)
    field(SIDEWARD) = r*(mu*a*outer)
    field = 2.0_dp*PI/t*field
  end function flat_punch_field

  !> S/t = lambda + i mu.
  pure subroutine spheroidal_coordinates(t, r, z, offset, lambda, mu)
    real(dp), intent(in) :: t, r, z, offset
    real(dp), intent(out) :: lambda, mu
    real(dp) :: square, size_of_square

    ! In units of t, whose own square may vanish close to the axis.
    square = (offset/t)*((r + t)/t) + (z/t)**2
    size_of_square = hypot(offset/t, z/t)*hypot((r + t)/t, z/t)
    if (square >= 0.0_dp) then
      lambda = sqrt(0.5_dp*(size_of_square + square))
      mu = z/t/lambda
    else
      mu = sqrt(0.5_dp*(size_of_square - square))
      lambda = z/t/mu
    end if
  end subroutine spheroidal_coordinates

end module fuge_flat_punch_field
