!> Stresses in closed form, for the example `stress` to be compared with.
module stress_known
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: flat_punch_stress, hertz_axis_stress, known_peaks, line_axis_shear

  real(dp), parameter :: PI = acos(-1.0_dp)

contains

  !> Largest shear stress in the plane on the axis below a cylinder, over p_0; `z` over the half width of the contact.
  elemental function line_axis_shear(z) result(shear)
    real(dp), intent(in) :: z
    real(dp) :: shear

    shear = z/(sqrt(1.0_dp + z**2)*(sqrt(1.0_dp + z**2) + z))
  end function line_axis_shear

  !> The stresses xx, yy, zz on the axis below Hertz's ellipse, over p_0; the semi-axes are 1 along x and `ratio` along
  !> y, and `z` is the depth in the same unit.
  !>
  !> With the potential V of the pressure p_0 sqrt(1 - x**2 - (y/ratio)**2) and the integral W of V from the depth to
  !> infinity (A. E. H. Love, Phil. Trans. A 228, 1929), s the variable that ends at infinity:
  !>
  !>     2 pi zz = V_z - z V_zz,   2 pi xx = 2 nu V_z - z V_xx + (1 - 2 nu) W_xx
  !>     V_xx = -2 pi ratio integral of ds/(A**3 B),   W_xx = -2 pi ratio integral of (s - z) ds/(A**3 B)
  !>     A**2 = 1 + s**2,   B**2 = ratio**2 + s**2,   V_zz = -V_xx - V_yy,   V_z = W_xx + W_yy
  pure function hertz_axis_stress(ratio, poisson, z) result(stress)
    real(dp), intent(in) :: ratio, poisson, z
    real(dp) :: stress(3)
    !> For the sums: step and number of terms on each side.
    real(dp), parameter :: STEP = 0.04_dp
    integer, parameter :: TERMS = 100
    real(dp) :: v_xx, v_yy, w_xx, w_yy, beyond, s, weight, a, b
    integer :: k

    v_xx = 0.0_dp
    v_yy = 0.0_dp
    w_xx = 0.0_dp
    w_yy = 0.0_dp
    do k = -TERMS, TERMS
      ! s - z goes from 0 to infinity doubly exponentially (H. Takahasi, M. Mori 1974).
      beyond = ratio*exp(0.5_dp*PI*sinh(STEP*k))
      weight = -ratio*STEP*0.5_dp*PI*cosh(STEP*k)*beyond
      s = z + beyond
      a = sqrt(1.0_dp + s**2)
      b = sqrt(ratio**2 + s**2)
      v_xx = v_xx + weight/(a**3*b)
      v_yy = v_yy + weight/(a*b**3)
      w_xx = w_xx + weight*beyond/(a**3*b)
      w_yy = w_yy + weight*beyond/(a*b**3)
    end do
    stress(1) = 2.0_dp*poisson*(w_xx + w_yy) - z*v_xx + (1.0_dp - 2.0_dp*poisson)*w_xx
    stress(2) = 2.0_dp*poisson*(w_xx + w_yy) - z*v_yy + (1.0_dp - 2.0_dp*poisson)*w_yy
    stress(3) = w_xx + w_yy + z*(v_xx + v_yy)
  end function hertz_axis_stress

  !> The largest shear stress and the largest von Mises stress on the axis below that ellipse, over p_0, in `value`, and
  !> their depths.
  pure subroutine known_peaks(ratio, poisson, value, depth)
    real(dp), intent(in) :: ratio, poisson
    real(dp), intent(out) :: value(2), depth(2)
    real(dp), parameter :: GOLDEN = 0.5_dp*(sqrt(5.0_dp) - 1.0_dp)
    real(dp) :: low, high, left(2), right(2)
    integer :: k, step

    do k = 1, 2
      low = 0.0_dp
      high = 2.0_dp*ratio
      do step = 1, 60
        left = measures(hertz_axis_stress(ratio, poisson, high - GOLDEN*(high - low)))
        right = measures(hertz_axis_stress(ratio, poisson, low + GOLDEN*(high - low)))
        if (left(k) < right(k)) then
          low = high - GOLDEN*(high - low)
        else
          high = low + GOLDEN*(high - low)
        end if
      end do
      depth(k) = 0.5_dp*(low + high)
      left = measures(hertz_axis_stress(ratio, poisson, depth(k)))
      value(k) = left(k)
    end do
  end subroutine known_peaks

  !> Shear and von Mises stress of three principal stresses.
  pure function measures(stress)
    real(dp), intent(in) :: stress(3)
    real(dp) :: measures(2)

    measures = [0.5_dp*(maxval(stress) - minval(stress)), sqrt(0.5_dp*sum((stress - cshift(stress, 1))**2))]
  end function measures

  !> The stresses xx, zz, xz below a flat punch on |x| <= 1 that touches with its whole face, under a unit force at
  !> `eccentricity`. With w = x + i z and P the integral of p(s)/(pi (w - s)) ds,
  !>
  !>     zz + xx = 2 Im P,   zz - xx = -2 z Re P',   xz = -z Im P'
  !>     p = (1 + 2 e s)/(pi sqrt(1 - s**2)),   P = [1/q + 2 e (w/q - 1)]/pi,   q = sqrt(w**2 - 1)
  pure function flat_punch_stress(eccentricity, x, z) result(stress)
    real(dp), intent(in) :: eccentricity, x, z
    real(dp) :: stress(3)
    complex(dp) :: w, q, p, slope

    w = cmplx(x, z, dp)
    ! Each root alone, so that q is cut along the face only.
    q = sqrt(w - 1.0_dp)*sqrt(w + 1.0_dp)
    p = (1.0_dp/q + 2.0_dp*eccentricity/(q*(w + q)))/PI
    slope = -(w + 2.0_dp*eccentricity)/(PI*q**3)
    stress(1) = aimag(p) + z*real(slope, dp)
    stress(2) = aimag(p) - z*real(slope, dp)
    stress(3) = -z*aimag(slope)
  end function flat_punch_stress

end module stress_known
