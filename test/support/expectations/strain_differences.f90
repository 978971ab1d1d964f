!> Strains, by differences of displacements, against those of the stresses by Hooke's law.
module strain_differences
  use expectations, only: relative_difference
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  implicit none
  private

  public :: plane_strain_difference, round_strain_difference

  !> Where to take displacements, in steps from the point: for differences of eighth order in the plane, and of sixth
  !> order about the axis.
  real(dp), parameter, public :: PLANE_STEPS(8) = [-4.0_dp, -3.0_dp, -2.0_dp, -1.0_dp, 1.0_dp, 2.0_dp, 3.0_dp, 4.0_dp]
  real(dp), parameter, public :: ROUND_STEPS(6) = [-3.0_dp, -2.0_dp, -1.0_dp, 1.0_dp, 2.0_dp, 3.0_dp]

  real(dp), parameter :: PLANE_WEIGHTS(8) = [3.0_dp, -32.0_dp, 168.0_dp, -672.0_dp, 672.0_dp, -168.0_dp, 32.0_dp, &
                                             -3.0_dp]/840.0_dp
  real(dp), parameter :: ROUND_WEIGHTS(6) = [-1.0_dp, 9.0_dp, -45.0_dp, 45.0_dp, -9.0_dp, 1.0_dp]/60.0_dp

contains

  !> Relative difference of the strains in the plane, from the displacements (2, 8) along x and along z and the stresses
  !> xx, zz, xz.
  pure function plane_strain_difference(along_x, along_z, step, stress, young, poisson, plane_state) result(difference)
    real(dp), intent(in) :: along_x(:, :), along_z(:, :), step, stress(3), young, poisson
    integer, intent(in) :: plane_state
    real(dp) :: difference, strain(3), expected(3), across

    strain(1) = dot_product(PLANE_WEIGHTS, along_x(1, :))/step
    strain(2) = dot_product(PLANE_WEIGHTS, along_z(2, :))/step
    strain(3) = (dot_product(PLANE_WEIGHTS, along_x(2, :)) + dot_product(PLANE_WEIGHTS, along_z(1, :)))/step
    across = 0.0_dp
    if (plane_state == FUGE_PLANE_STRAIN) across = poisson*(stress(1) + stress(2))
    expected(1) = (stress(1) - poisson*(stress(2) + across))/young
    expected(2) = (stress(2) - poisson*(stress(1) + across))/young
    expected(3) = 2.0_dp*(1.0_dp + poisson)*stress(3)/young
    difference = relative_difference(strain, expected)
  end function plane_strain_difference

  !> Relative difference of the strains about the axis, from the displacements (2, 6) along r and along z, the `hoop`
  !> strain, which is the radial displacement over the radius, and the stresses rr, hoop, zz, rz.
  pure function round_strain_difference(along_r, along_z, hoop, step, stress, young, poisson) result(difference)
    real(dp), intent(in) :: along_r(:, :), along_z(:, :), hoop, step, stress(4), young, poisson
    real(dp) :: difference, strain(4), expected(4)

    strain = [dot_product(ROUND_WEIGHTS, along_r(1, :))/step, hoop, &
              dot_product(ROUND_WEIGHTS, along_z(2, :))/step, &
              dot_product(ROUND_WEIGHTS, along_z(1, :) + along_r(2, :))/step]
    expected(:3) = ((1.0_dp + poisson)*stress(:3) - poisson*sum(stress(:3)))/young
    expected(4) = 2.0_dp*(1.0_dp + poisson)*stress(4)/young
    difference = relative_difference(strain, expected)
  end function round_strain_difference

end module strain_differences
