!> Abel's transform of the profile of a round punch, on which its contact depends in closed form.
!>
!> A rigid punch with the profile g(r) that touches a half-space in a disc of radius a has
!>
!>     chi(t) = t integral of g'(r)/sqrt(t**2 - r**2) dr, r = 0 .. t,
!>     approach = g(0) + chi(a),   load = 2 E* integral of t chi'(t) dt, t = 0 .. a
!>
!> (I. N. Sneddon, Int. J. Engng Sci. 3, 1965; L. A. Galin). The derivative chi' has no unit. It is a Chebyshev series
!> in t from 0 to a: smooth wherever g is smooth from the axis on, also for a tip. A power r**n becomes one of t.
module fuge_abel_transform
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points, chebyshev_sum
  use fuge_constants, only: PI
  use fuge_gauss_legendre, only: gauss_rule
  use fuge_kinds, only: dp
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_profile_edges, only: edge_depth, edge_rim_slope, edge_thrust, profile_edge
  use fuge_smooth_profile_type, only: fuge_smooth_profile, sample_profile
  use fuge_smooth_slope_series, only: anchored_interval, expand_slope, slope_series
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: expand_transform

  !> Nodes of the quadrature over the angle beyond those of a polynomial of the same degree.
  integer, parameter :: MORE_NODES = 14
  !> A slope on the axis below this fraction of that at the rim is rounding, not a tip.
  real(dp), parameter :: LEAST_TIP = 3.0e-11_dp
  !> Above this argument the gamma function itself might overflow.
  real(dp), parameter :: LARGEST_ARGUMENT = 150.0_dp

  !> chi'(t) = sum_k coefficients(k + 1) T_k(2 t/radius - 1) + sum_k factors(k) (t/radius)**(powers(k) - 1), and the
  !> edges.
  type, public :: abel_transform
    !> Radius of the contact; length.
    real(dp) :: radius = 0.0_dp
    real(dp), allocatable :: coefficients(:), factors(:), powers(:)
    !> Terms that begin within the contact, in units of its radius.
    type(profile_edge), allocatable :: edges(:)
    !> chi'(0), which is not 0 for a tip.
    real(dp) :: tip = 0.0_dp
    !> The slope g' from which the series was made, without powers.
    type(slope_series) :: slope
    !> Estimated error of chi'.
    real(dp) :: error = 0.0_dp
  contains
    procedure :: slopes
    procedure :: rim_slope
    procedure :: depth
    procedure :: thrust
  end type abel_transform

contains

  !> The transform of `profile` up to `radius` > 0, length. `tolerance` and `degrees` (2) as in `expand_slope`.
  !> Errors: those of the profile.
  subroutine expand_transform(profile, radius, tolerance, degrees, transform, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: radius, tolerance
    integer, intent(in) :: degrees(2)
    type(abel_transform), intent(out) :: transform
    type(fuge_info), intent(inout) :: info
    real(dp) :: gap(2), slope(2)
    integer :: terms

    transform%radius = radius
    call sample_profile(profile, [0.0_dp, radius], gap, slope, info)
    if (info%failed()) return
    transform%tip = 0.5_dp*PI*slope(1)
    select type (profile)
    class is (fuge_power_profile)
      allocate (transform%coefficients(0))
      call set_powers(profile, radius, transform)
    class default
      call expand_slope(profile, anchored_interval(0.0_dp, 0.5_dp*radius, 0.5_dp*radius), tolerance, degrees, &
                        transform%slope, info)
      if (info%failed()) return
      terms = terms_above_noise(transform%slope)
      allocate (transform%coefficients, source=transformed(transform%slope%coefficients(:terms)))
      allocate (transform%powers(0), transform%factors(0), transform%edges(0))
      transform%error = transform%slope%series_error
    end select
    if (abs(transform%tip) <= LEAST_TIP*maxval(abs(transform%slopes([0.5_dp, 1.0_dp])))) transform%tip = 0.0_dp
    call fix_tip(transform%tip, transform%coefficients)
  end subroutine expand_transform

  !> The terms of a profile in closed form; those that begin outside of the contact are left out.
  pure subroutine set_powers(profile, radius, transform)
    class(fuge_power_profile), intent(in) :: profile
    real(dp), intent(in) :: radius
    type(abel_transform), intent(inout) :: transform
    real(dp) :: start(size(profile%powers))
    integer :: k, last

    start = profile%all_starts()
    allocate (transform%powers, source=pack(profile%powers, .not. start > 0.0_dp))
    allocate (transform%factors, source=power_factors(pack(profile%coefficients, .not. start > 0.0_dp), &
                                                      transform%powers, radius))
    allocate (transform%edges(count(start > 0.0_dp .and. start < radius)))
    last = 0
    do k = 1, size(start)
      if (.not. (start(k) > 0.0_dp .and. start(k) < radius)) cycle
      last = last + 1
      associate (edge => transform%edges(last))
        edge%power = nint(profile%powers(k))
        edge%start = start(k)/radius
        edge%rest = (radius - start(k))/radius
        edge%factor = profile%coefficients(k)
        if (edge%power == 2) edge%factor = 2.0_dp*radius*edge%factor
      end associate
    end do
  end subroutine set_powers

  !> Terms of a series up to the last one above its error: the derivative in chi' would magnify what is noise.
  pure function terms_above_noise(series) result(terms)
    type(slope_series), intent(in) :: series
    integer :: terms

    terms = size(series%coefficients)
    do while (terms > 4)
      if (abs(series%coefficients(terms)) > series%leading_error) exit
      terms = terms - 1
    end do
  end function terms_above_noise

  !> Make the series exact on the axis: its rounding error there would be integrated over 1/t. The change is shared
  !> equally, so that it is large on the axis only.
  pure subroutine fix_tip(tip, coefficients)
    real(dp), intent(in) :: tip
    real(dp), intent(inout) :: coefficients(:)
    real(dp) :: change

    if (size(coefficients) == 0) return
    change = (tip - (sum(coefficients(1::2)) - sum(coefficients(2::2))))/real(size(coefficients), dp)
    coefficients(1::2) = coefficients(1::2) + change
    coefficients(2::2) = coefficients(2::2) - change
  end subroutine fix_tip

  !> Factors of chi' for the profile sum_k c_k r**n_k: c n**2 B(n) radius**(n - 1), B the integral of sin**(n - 1) over
  !> a quarter of the circle.
  elemental function power_factors(coefficient, power, radius) result(factor)
    real(dp), intent(in) :: coefficient, power, radius
    real(dp) :: factor

    if (power < LARGEST_ARGUMENT) then
      factor = gamma(0.5_dp*power)/gamma(0.5_dp*(power + 1.0_dp))
    else
      factor = exp(log_gamma(0.5_dp*power) - log_gamma(0.5_dp*(power + 1.0_dp)))
    end if
    factor = coefficient*power**2*(0.5_dp*sqrt(PI))*factor
    if (power > 1.0_dp) factor = factor*radius**(power - 1.0_dp)
  end function power_factors

  !> Coefficients of chi' from those of g': chi(t)/t is the integral of g'(t sin(angle)) over a quarter of the circle.
  pure function transformed(a) result(derivative)
    real(dp), intent(in) :: a(0:)
    real(dp) :: derivative(0:size(a) - 1)
    real(dp), dimension(size(a)/2 + MORE_NODES) :: node, weight
    real(dp) :: mean(0:degree_for(size(a))), t(0:degree_for(size(a))), g(0:size(a))
    integer :: i, n

    n = size(a) - 1
    call gauss_rule(node, weight)
    t = 0.5_dp + 0.5_dp*chebyshev_points(size(t) - 1)
    do i = 0, size(t) - 1
      mean(i) = 0.5_dp*PI*dot_product(weight, chebyshev_sum(a, 2.0_dp*t(i)*sin(0.5_dp*PI*node) - 1.0_dp))
    end do
    mean = chebyshev_coefficients(mean)
    ! 2 t/a = 1 + x times the mean, with x T_k = (T_(k+1) + T_(k-1))/2 and x T_0 = T_1; then the derivative by x.
    g(:n) = mean(:n)
    g(n + 1) = 0.0_dp
    g(1) = g(1) + 0.5_dp*mean(0)
    g(1:) = g(1:) + 0.5_dp*mean(:n)
    g(:n - 1) = g(:n - 1) + 0.5_dp*mean(1:n)
    derivative = chebyshev_derivative(g)
  end function transformed

  !> The least power of two that is not below the degree of a series of `terms` terms.
  pure function degree_for(terms) result(n)
    integer, intent(in) :: terms
    integer :: n

    n = 2
    do while (n < terms - 1)
      n = 2*n
    end do
  end function degree_for

  !> chi' without the edges at the `fraction` (m), 0 to 1, of the radius; no unit.
  pure function slopes(self, fraction) result(values)
    class(abel_transform), intent(in) :: self
    real(dp), intent(in) :: fraction(:)
    real(dp) :: values(size(fraction))
    integer :: k

    values = 0.0_dp
    if (size(self%coefficients) > 0) values = chebyshev_sum(self%coefficients, 2.0_dp*fraction - 1.0_dp)
    do k = 1, size(self%powers)
      if (self%powers(k) > 1.0_dp) then
        values = values + self%factors(k)*fraction**(self%powers(k) - 1.0_dp)
      else
        values = values + self%factors(k)
      end if
    end do
  end function slopes

  !> chi' at the rim; no unit.
  pure function rim_slope(self) result(slope)
    class(abel_transform), intent(in) :: self
    real(dp) :: slope

    slope = sum(self%coefficients) + sum(self%factors) + sum(edge_rim_slope(self%edges))
  end function rim_slope

  !> chi(a) over the radius a; no unit.
  pure function depth(self)
    class(abel_transform), intent(in) :: self
    real(dp) :: depth
    integer :: k

    depth = sum(self%factors/self%powers)
    do k = 1, size(self%edges)
      depth = depth + edge_depth(self%edges(k))
    end do
    do k = 0, size(self%coefficients) - 1
      depth = depth + 0.5_dp*self%coefficients(k + 1)*moment(k)
    end do
  end function depth

  !> The load over 2 E* radius**2; no unit.
  pure function thrust(self)
    class(abel_transform), intent(in) :: self
    real(dp) :: thrust
    integer :: k

    thrust = sum(self%factors/(self%powers + 1.0_dp))
    do k = 1, size(self%edges)
      thrust = thrust + edge_thrust(self%edges(k))
    end do
    do k = 0, size(self%coefficients) - 1
      thrust = thrust + 0.25_dp*self%coefficients(k + 1)*(moment(k) + 0.5_dp*(moment(k + 1) + moment(abs(k - 1))))
    end do
  end function thrust

  !> The integral of T_k from -1 to 1.
  elemental function moment(k) result(integral)
    integer, intent(in) :: k
    real(dp) :: integral

    integral = 0.0_dp
    if (modulo(k, 2) == 0) integral = 2.0_dp/(1.0_dp - real(k, dp)**2)
  end function moment

end module fuge_abel_transform
