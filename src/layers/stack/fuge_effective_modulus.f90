!> The half-space that is as stiff as a layered body under a contact of given size.
module fuge_effective_modulus
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_mixture_fit, only: wave_symbol
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_FINITE, FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: fuge_find_effective_modulus, mean_wave_factor

  !> Nodes of a panel.
  integer, parameter :: NODES = 8
  !> Panels below the first quarter of a wave, each half as wide as the next: what is left is less than rounding.
  integer, parameter :: HALVINGS = 60
  !> Quarters of waves that are summed one by one. Beyond, sin(x)**2 is one half: these end where sin(2 x) = 0, so that
  !> the error is of the order 1/x**3 of the last one.
  integer, parameter :: QUARTERS = 200
  !> Panels beyond, each twice as wide as the one before.
  integer, parameter :: DOUBLINGS = 60
  !> T that is as near to 1 as this is 1 for all shorter waves.
  real(dp), parameter :: CLOSE = 1.0e-15_dp

  !> The waves of a body.
  type, extends(wave_symbol) :: body_symbol
    type(fuge_layered_body) :: body
  contains
    procedure :: wave_factor
  end type body_symbol

contains

  !> The effective modulus of a layered body under round contacts of given size.
  !>
  !> `radius` (n), > 0, length. `modulus` (n), force per length squared: E/(1 - nu**2) of the half-space whose surface
  !> gives way as much, with the other body of `body`, under the pressure F/(2 pi a sqrt(a**2 - r**2)) of a flat round
  !> punch of this radius a, in the mean weighted by that pressure. It goes from that of the top layer, under small
  !> contacts, to that of the half-space below, and grows without limit on a rigid base.
  !>
  !> The stiffness dF/dd = 2 a E of a round punch of any profile is that of the flat punch of its contact radius, so
  !> this is about the modulus that indentation measures. It is never above that of a rigid punch, whose own pressure
  !> does the least work, and differs from it in the second order of the difference of the moduli: by at most 0.08 of it
  !> for moduli 10 : 1 or 1 : 10 and thicknesses of 0.1 .. 10 radii, by up to 0.24 for 1 : 100, by more for thin layers
  !> on a rigid base. To the first order it is the formula of H. Gao, C.-H. Chiu and J. Lee, International Journal of
  !> Solids and Structures 29, 1992. Quadrature is exact to about 1e-7.
  !>
  !> Errors, `modulus` untouched: FUGE_ERR_CALL_ORDER before the `set` of body, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_WIDTH for a radius that is not positive.
  subroutine fuge_find_effective_modulus(body, radius, modulus, info)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: radius(:)
    real(dp), intent(inout) :: modulus(:)
    type(fuge_info), intent(out) :: info
    type(body_symbol) :: symbol
    integer :: k

    if (.not. body%is_set()) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no layers are set')
    else if (size(radius) /= size(modulus)) then
      call report(info, FUGE_ERR_SIZE, 'radius has '//text(size(radius))//' numbers and modulus '//text(size(modulus)))
    end if
    do k = 1, size(radius)
      if (info%failed()) return
      call check_radius(radius(k), 'radius('//index_text(k)//')', info)
    end do
    if (info%failed()) return
    symbol%body = body
    do k = 1, size(radius)
      modulus(k) = body%e_star()/mean_wave_factor(symbol, radius(k))
    end do
  end subroutine fuge_find_effective_modulus

  !> Refuse a radius.
  subroutine check_radius(radius, name, info)
    real(dp), intent(in) :: radius
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(radius)) then
      call report(info, FUGE_ERR_NOT_FINITE, name//' = '//text(radius)//' is not a finite number')
    else if (.not. radius > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, name//' = '//text(radius)//' is not positive')
    end if
  end subroutine check_radius

  !> The mean of T over the waves of the pressure under a flat round punch: 2/pi times the integral of
  !> T(x/radius) (sin(x)/x)**2 over all x > 0.
  function mean_wave_factor(symbol, radius) result(mean)
    class(wave_symbol), intent(in) :: symbol
    real(dp), intent(in) :: radius
    real(dp) :: mean
    real(dp), parameter :: QUARTER = 0.5_dp*PI
    real(dp) :: from, node(NODES), total, weight(NODES), weights
    integer :: k

    call gauss_rule(node, weight)
    total = 0.0_dp
    weights = 0.0_dp
    do k = 1, HALVINGS
      from = QUARTER*0.5_dp**k
      call add_panel(from, from)
    end do
    do k = 1, QUARTERS - 1
      call add_panel(QUARTER*k, QUARTER)
    end do
    from = QUARTER*QUARTERS
    do k = 1, DOUBLINGS
      if (abs(symbol%wave_factor(from/radius) - 1.0_dp) <= CLOSE) exit
      call add_tail(from)
      from = 2.0_dp*from
    end do
    mean = (total + 0.5_dp/from)/(weights + 0.5_dp/from)

  contains

    !> The waves `start` .. `start` + `width`.
    subroutine add_panel(start, width)
      real(dp), intent(in) :: start, width
      real(dp) :: share, x
      integer :: i

      do i = 1, NODES
        x = start + width*node(i)
        share = width*weight(i)*(sin(x)/x)**2
        weights = weights + share
        total = total + share*symbol%wave_factor(x/radius)
      end do
    end subroutine add_panel

    !> The waves `start` .. 2 `start`, with one half for sin(x)**2.
    subroutine add_tail(start)
      real(dp), intent(in) :: start
      real(dp) :: share, x
      integer :: i

      do i = 1, NODES
        x = start*(1.0_dp + node(i))
        share = 0.5_dp*start*weight(i)/x**2
        weights = weights + share
        total = total + share*symbol%wave_factor(x/radius)
      end do
    end subroutine add_tail

  end function mean_wave_factor

  pure function wave_factor(self, q) result(factor)
    class(body_symbol), intent(in) :: self
    real(dp), intent(in) :: q
    real(dp) :: factor

    factor = self%body%factor_of_wave(q)
  end function wave_factor

end module fuge_effective_modulus
