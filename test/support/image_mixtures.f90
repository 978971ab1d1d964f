!> Bodies whose waves are known in closed form: a half-space with the images of its forces at a depth.
module image_mixtures
  use fuge_kinds, only: dp
  use fuge_wave_mixture, only: wave_mixture, STEP
  implicit none
  private

  public :: image_mixture

contains

  !> T = 1 - `part` exp(-q `depth`): the weights are 1 - part exp(-(depth/(2 t))**2).
  pure function image_mixture(part, depth) result(mixture)
    real(dp), intent(in) :: part, depth
    type(wave_mixture) :: mixture
    !> From where the weights are 1 to where their second term is less than rounding.
    real(dp), parameter :: FIRST = 1.0_dp/13.0_dp, LAST = 1.0e4_dp
    real(dp) :: t
    integer :: count, k

    mixture%unit = FIRST*depth
    count = ceiling(log(LAST/FIRST)/STEP)
    allocate (mixture%weight(count))
    do k = 1, count
      t = mixture%unit*exp(STEP*real(k - 1, dp))
      mixture%weight(k) = 1.0_dp - part*exp(-(0.5_dp*depth/t)**2)
    end do
    mixture%limit = 1.0_dp - part
    mixture%tail = part*(0.5_dp*depth/t)**2
  end function image_mixture

end module image_mixtures
