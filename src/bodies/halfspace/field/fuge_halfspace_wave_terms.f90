!> The response of a half-space to a wave of pressure, as terms of fuge_halfspace_wave_factors.
!>
!> A wave exp(i(q_x x + q_y y)) of pressure p, with s = |q|, gives at the depth z, by Boussinesq's potentials (K. L.
!> Johnson, Contact Mechanics, 1985, section 3.2),
!>
!>     zz = -(1 + s z) exp(-s z) p,   xz = i q_x z exp(-s z) p,
!>     xx = -(q_x**2 (1 - s z) + 2 nu q_y**2) exp(-s z)/s**2 p,   xy = -q_x q_y (1 - 2 nu - s z) exp(-s z)/s**2 p,
!>     2 mu u_z = (2 (1 - nu) + s z) exp(-s z)/s p,   2 mu u_x = i q_x (1 - 2 nu - s z) exp(-s z)/s**2 p,
!>
!> and likewise with x and y exchanged. The imaginary unit is that of a kernel that is odd in one direction
!> (fuge_grid_waves).
module fuge_halfspace_wave_terms
  use fuge_halfspace_wave_factors, only: wave_term
  use fuge_kinds, only: dp
  implicit none
  private

  public :: displacement_terms, stress_terms

contains

  !> Component 1 .. 6 of the stress at the depth `z` in the unit of the waves.
  pure function stress_terms(component, nu, z) result(terms)
    integer, intent(in) :: component
    real(dp), intent(in) :: nu, z
    type(wave_term), allocatable :: terms(:)

    select case (component)
    case (1)
      terms = [wave_term([2, 0], over_square=-1.0_dp, over_wave=z), wave_term([0, 2], over_square=-2.0_dp*nu)]
    case (2)
      terms = [wave_term([0, 2], over_square=-1.0_dp, over_wave=z), wave_term([2, 0], over_square=-2.0_dp*nu)]
    case (3)
      terms = [wave_term([0, 0], rising=-1.0_dp)]
    case (4)
      terms = [wave_term([0, 1], plain=z)]
    case (5)
      terms = [wave_term([1, 0], plain=z)]
    case default
      terms = [wave_term([1, 1], over_square=2.0_dp*nu - 1.0_dp, over_wave=z)]
    end select
  end function stress_terms

  !> Component 1 .. 3 of the displacement, times Young's modulus, in the unit of the waves, as is the depth `z`.
  pure function displacement_terms(component, nu, z) result(terms)
    integer, intent(in) :: component
    real(dp), intent(in) :: nu, z
    type(wave_term) :: terms(1)
    real(dp) :: factor

    ! Young's modulus over twice the shear modulus.
    factor = 1.0_dp + nu
    select case (component)
    case (1)
      terms = wave_term([1, 0], over_square=factor*(1.0_dp - 2.0_dp*nu), over_wave=-factor*z)
    case (2)
      terms = wave_term([0, 1], over_square=factor*(1.0_dp - 2.0_dp*nu), over_wave=-factor*z)
    case default
      terms = wave_term([0, 0], over_wave=2.0_dp*factor*(1.0_dp - nu), plain=factor*z)
    end select
  end function displacement_terms

end module fuge_halfspace_wave_terms
