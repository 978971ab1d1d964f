!> The half-space that is as stiff as a layered body under a contact of given size.
module fuge_effective_modulus
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_constants, only: LARGEST_EXPONENT_OF_4, PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_layered_body_type, only: fuge_layered_body
  use fuge_mixture_fit, only: wave_symbol
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_SIZE, FUGE_ERR_WIDTH
  implicit none
  private

  public :: check_radius, fuge_find_effective_modulus, punch_factor

  !> Functions of which the pressure under the punch is made; the first one alone has a resultant.
  integer, parameter :: FUNCTIONS = 8
  !> Nodes of a panel.
  integer, parameter :: NODES = 8
  !> Panels below the first quarter of a wave, each half as wide as the next: what is left is less than rounding.
  integer, parameter :: HALVINGS = 60
  !> Quarters of waves that are summed one by one. Beyond, products of functions are their means over a wave.
  integer, parameter :: QUARTERS = 400
  !> Most panels beyond, each twice as wide as the one before: up to the largest numbers.
  integer, parameter :: DOUBLINGS = 1000
  !> T that is as near to 1 as this is 1 for all shorter waves; what is left of an energy below this part is rounding.
  real(dp), parameter :: CLOSE = 1.0e-15_dp
  !> Spherical Bessel functions: the highest order, up to which x the recurrence runs down, and from which order.
  integer, parameter :: HIGHEST = 2*FUNCTIONS - 2, BEGIN = HIGHEST + 26
  real(dp), parameter :: LARGE_X = 16.0_dp

contains

  !> The effective modulus of a layered body under round contacts of given size.
  !>
  !> `radius` (n), > 0, length. `modulus` (n), force per length squared: E/(1 - nu**2) of the half-space on which a
  !> rigid flat punch of this radius a is as stiff, with the other body of `body`: dF/dd = 2 a E. That is also the
  !> stiffness of a round punch of any profile with this contact radius, because it moves on as a flat one, so this is
  !> the modulus that indentation measures. It goes from that of the top layer, under small contacts, to that of the
  !> half-space below, and grows without limit on a rigid base.
  !>
  !> The waves of the pressure are the cosine transform of a function on 0 .. a (N. N. Lebedev and Ia. S. Ufliand,
  !> Journal of Applied Mathematics and Mechanics 22, 1958), here of eight even Legendre polynomials with the least
  !> energy, so that the modulus is never too large. For moduli 1 : 100 .. 100 : 1 and on a rigid base it is exact to
  !> 4e-6 for thicknesses from 0.1 radii on, to 1e-3 from 0.03 and to 5e-3 from 0.01 on. Far thinner layers on an
  !> elastic half-space have its modulus; those on a rigid base are exact to 5e-3, to 1e-2 if they are incompressible.
  !>
  !> Errors, `modulus` untouched: FUGE_ERR_CALL_ORDER before the `set` of body, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE,
  !> FUGE_ERR_WIDTH for a radius that is not positive, FUGE_ERR_OVERFLOW.
  subroutine fuge_find_effective_modulus(body, radius, modulus, info)
    type(fuge_layered_body), intent(in) :: body
    real(dp), intent(in) :: radius(:)
    real(dp), intent(inout) :: modulus(:)
    type(fuge_info), intent(out) :: info
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
    do k = 1, size(radius)
      modulus(k) = body%e_star()/punch_factor(body, radius(k))
    end do
  end subroutine fuge_find_effective_modulus

  !> Refuse a radius of this `name`: FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_OVERFLOW.
  subroutine check_radius(radius, name, info)
    real(dp), intent(in) :: radius
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. ieee_is_finite(radius)) then
      call report(info, FUGE_ERR_NOT_FINITE, name//' = '//text(radius)//' is not a finite number')
    else if (.not. radius > 0.0_dp) then
      call report(info, FUGE_ERR_WIDTH, name//' = '//text(radius)//' is not positive')
    else if (abs(exponent(radius)) > LARGEST_EXPONENT_OF_4) then
      call report(info, FUGE_ERR_OVERFLOW, name//' = '//text(radius)//' is out of range: choose another unit of length')
    end if
  end subroutine check_radius

  !> T of the half-space on which a rigid flat punch is as stiff as on the body of `symbol`.
  function punch_factor(symbol, radius) result(factor)
    class(wave_symbol), intent(in) :: symbol
    real(dp), intent(in) :: radius
    real(dp) :: factor
    real(dp), parameter :: QUARTER = 0.5_dp*PI
    ! Energies of each two functions, on the body and on a half-space of T = 1.
    real(dp) :: energy(FUNCTIONS, FUNCTIONS), known(FUNCTIONS, FUNCTIONS)
    real(dp) :: from, node(NODES), weight(NODES)
    integer :: k

    call gauss_rule(node, weight)
    energy = 0.0_dp
    known = 0.0_dp
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
    ! What is left, with the T of the last wave: of the function that does not end at zero, whose waves are sin(x)/x.
    energy(FUNCTIONS, FUNCTIONS) = energy(FUNCTIONS, FUNCTIONS) + 0.5_dp/from*symbol%wave_factor(from/radius)
    known(FUNCTIONS, FUNCTIONS) = known(FUNCTIONS, FUNCTIONS) + 0.5_dp/from
    factor = least_energy(energy)/least_energy(known)

  contains

    !> The waves `start` .. `start` + `width`.
    subroutine add_panel(start, width)
      real(dp), intent(in) :: start, width
      real(dp) :: x
      integer :: i

      do i = 1, NODES
        x = start + width*node(i)
        call add_products(waves_of_pressure(x), width*weight(i), symbol%wave_factor(x/radius))
      end do
    end subroutine add_panel

    !> The waves `start` .. 2 `start`, with the means of products: half the products of Bessel functions of the first
    !> kind, and of the second kind, of which only the phase at `x` does not count.
    subroutine add_tail(start)
      real(dp), intent(in) :: start
      real(dp) :: t, x
      integer :: i

      do i = 1, NODES
        x = start*(1.0_dp + node(i))
        t = symbol%wave_factor(x/radius)
        call add_products(from_first_orders(0.0_dp, -1.0_dp/x, x), 0.5_dp*start*weight(i), t)
        call add_products(from_first_orders(1.0_dp/x, (1.0_dp/x)/x, x), 0.5_dp*start*weight(i), t)
      end do
    end subroutine add_tail

    subroutine add_products(wave, share, t)
      real(dp), intent(in) :: wave(FUNCTIONS), share, t
      real(dp) :: product(FUNCTIONS)
      integer :: j

      do j = 1, FUNCTIONS
        product = share*wave*wave(j)
        known(:, j) = known(:, j) + product
        energy(:, j) = energy(:, j) + t*product
      end do
    end subroutine add_products

  end function punch_factor

  !> The least energy of the first function, which alone has a resultant, with any amounts of the others: what is left
  !> of its own when they are eliminated.
  pure function least_energy(matrix) result(energy)
    real(dp), intent(in) :: matrix(:, :)
    real(dp) :: energy
    real(dp) :: a(size(matrix, 1), size(matrix, 1))
    integer :: j, k

    a = matrix
    do k = size(a, 1), 2, -1
      if (a(k, k) <= CLOSE*matrix(k, k)) cycle
      do j = 1, k - 1
        a(:k - 1, j) = a(:k - 1, j) - a(:k - 1, k)*(a(k, j)/a(k, k))
      end do
    end do
    energy = max(a(1, 1), CLOSE*matrix(1, 1))
  end function least_energy

  !> The integrals of cos(x s) f(s) over s = 0 .. 1, of functions f that end at zero but for the last one: differences
  !> of the Legendre polynomials of the degrees 0, 2, 4 .., and the polynomial of the highest degree.
  !>
  !> Those of the polynomials are the spherical Bessel functions of these orders, with alternating signs, and two of
  !> them add up to one of the order between. On a body that hardly yields to long waves the last function takes far
  !> more energy than all others, which would be lost by rounding if all functions were polynomials.
  pure function waves_of_pressure(x) result(wave)
    real(dp), intent(in) :: x
    real(dp) :: wave(FUNCTIONS)
    real(dp) :: bessel(0:BEGIN)
    integer :: n

    if (x < LARGE_X) then
      ! Miller's downward recurrence for ratios of spherical Bessel functions, from an order where they are negligible.
      bessel(BEGIN) = 0.0_dp
      do n = BEGIN - 1, 1, -1
        bessel(n) = x/(real(2*n + 1, dp) - x*bessel(n + 1))
      end do
      bessel(0) = sin(x)/x
      do n = 1, HIGHEST
        bessel(n) = bessel(n - 1)*bessel(n)
      end do
      wave = from_orders(bessel(:HIGHEST), x)
    else
      wave = from_first_orders(sin(x)/x, (sin(x)/x - cos(x))/x, x)
    end if
  end function waves_of_pressure

  !> `waves_of_pressure`, of the spherical Bessel functions of the orders 0 and 1.
  pure function from_first_orders(zero, one, x) result(wave)
    real(dp), intent(in) :: zero, one, x
    real(dp) :: wave(FUNCTIONS)
    real(dp) :: bessel(0:HIGHEST)
    integer :: n

    bessel(0) = zero
    bessel(1) = one
    do n = 1, HIGHEST - 1
      bessel(n + 1) = real(2*n + 1, dp)/x*bessel(n) - bessel(n - 1)
    end do
    wave = from_orders(bessel, x)
  end function from_first_orders

  !> `waves_of_pressure`, of all spherical Bessel functions.
  pure function from_orders(bessel, x) result(wave)
    real(dp), intent(in) :: bessel(0:HIGHEST), x
    real(dp) :: wave(FUNCTIONS)
    integer :: n

    do n = 1, FUNCTIONS - 1
      wave(n) = real(4*n - 1, dp)/x*bessel(2*n - 1)
    end do
    wave(FUNCTIONS) = bessel(HIGHEST)
  end function from_orders

end module fuge_effective_modulus
