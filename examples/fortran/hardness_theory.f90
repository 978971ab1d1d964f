!> Persson's areas of an elastic-plastic rough contact, for the example `hardness`.
module hardness_theory
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: persson_areas

  real(dp), parameter :: PI = acos(-1.0_dp)

  !> Fractions of the nominal area.
  type, public :: areas
    real(dp) :: contact = 0.0_dp, limited = 0.0_dp
  end type areas

contains

  !> Areas at the mean pressure `pressure` and the hardness `limit`, both in E* g.
  !>
  !> The distribution P of the pressure s obeys dP/dv = P''/2 with P = 0 at s = 0 and s = H, from all at the mean
  !> pressure for v = 0 to v = (E* g)**2/4. What is left is the elastic contact. The area that has been absorbed at H
  !> carries, with the pressure H, what the elastic one does not. (B. N. J. Persson, Phys. Rev. Lett. 87, 116101, 2001)
  pure function persson_areas(pressure, limit) result(theory)
    real(dp), intent(in) :: pressure, limit
    type(areas) :: theory
    real(dp), parameter :: VARIANCE = 0.25_dp
    real(dp) :: elastic, faded
    integer :: n

    if (limit >= huge(limit)) then
      theory%contact = erf(pressure/sqrt(2.0_dp*VARIANCE))
      return
    end if
    elastic = 0.0_dp
    theory%limited = pressure/limit
    do n = 1, 200
      faded = sin(real(n, dp)*PI*pressure/limit)*exp(-0.5_dp*VARIANCE*(real(n, dp)*PI/limit)**2)*2.0_dp/(real(n, dp)*PI)
      if (mod(n, 2) == 1) then
        elastic = elastic + 2.0_dp*faded
        theory%limited = theory%limited - faded
      else
        theory%limited = theory%limited + faded
      end if
    end do
    theory%contact = elastic + theory%limited
  end function persson_areas

end module hardness_theory
