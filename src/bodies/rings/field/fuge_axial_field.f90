!> Stresses and displacements below pressure that is symmetric about an axis, from its potentials.
!>
!> With d the vector from a point of the surface under pressure to the point in the body, R its length and dr, dt, z
!> its components, J. Boussinesq's stresses and displacements (K. L. Johnson, Contact Mechanics, 1985, equations 3.19
!> and 3.20) are combinations of eight integrals of the pressure, of which each kind of pressure finds its own way to
!> be free of cancellation.
module fuge_axial_field
  use fuge_constants, only: PI
  use fuge_kinds, only: dp
  implicit none
  private

  public :: axial_displacement, axial_stress, surface_field

  !> The integral of the pressure times 1/R; dr/(r R (R + z)); z/R**3; 3 z dr**2/R**5; 3 z dt**2/R**5;
  !> 3 z**2 dr/R**5; 3 z**3/R**5; z dr/R**3.
  integer, parameter, public :: POTENTIAL = 1, SPREAD = 2, FLUX = 3, RADIAL = 4, HOOP = 5, SHEAR = 6, AXIAL = 7, &
    SIDEWARD = 8, INTEGRALS = 8

contains

  !> rr, tt, zz, rz in units of the pressure; tension is positive.
  pure function axial_stress(field, poisson) result(stress)
    real(dp), intent(in) :: field(INTEGRALS), poisson
    real(dp) :: stress(4)
    real(dp) :: share

    share = 1.0_dp - 2.0_dp*poisson
    stress(1) = share*field(SPREAD) - field(RADIAL)
    stress(2) = share*(field(FLUX) - field(SPREAD)) - field(HOOP)
    stress(3) = -field(AXIAL)
    stress(4) = -field(SHEAR)
    stress = stress/(2.0_dp*PI)
  end function axial_stress

  !> Displacements along r and z times E/(1 - poisson**2), in units of the pressure times the length, at the distance
  !> `r` from the axis and the depth `z`.
  pure function axial_displacement(field, poisson, r, z) result(displacement)
    real(dp), intent(in) :: field(INTEGRALS), poisson, r, z
    real(dp) :: displacement(2)
    real(dp) :: share

    share = 0.5_dp/(1.0_dp - poisson)
    displacement(1) = share*(field(SIDEWARD) - (1.0_dp - 2.0_dp*poisson)*(r*field(SPREAD)))
    displacement(2) = field(POTENTIAL) + share*(z*field(FLUX))
    displacement = displacement/PI
  end function axial_displacement

  !> The integrals at the surface, in the limit from inside, under the `pressure` there; `whole_spread` and
  !> `whole_potential` are those of all the pressure.
  pure function surface_field(pressure, whole_spread, whole_potential) result(field)
    real(dp), intent(in) :: pressure, whole_spread, whole_potential
    real(dp) :: field(INTEGRALS)

    field = 0.0_dp
    field(POTENTIAL) = whole_potential
    field(SPREAD) = whole_spread
    field([FLUX, RADIAL, HOOP, AXIAL]) = 2.0_dp*PI*pressure
  end function surface_field

end module fuge_axial_field
