!> Profiles of smooth punches for tests, by number.
module smooth_profiles
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use fuge_kinds, only: dp
  use fuge_power_profile_type, only: fuge_power_profile
  use fuge_smooth_profile_type, only: fuge_polynomial_profile, fuge_smooth_profile
  implicit none
  private

  public :: power_punch, sum_of_powers

  !> Values of `form`, with p the `parameter`: 1 - cos(p x), |x|**3, exp(x) - x, x**4 - p x**2,
  !> x**2 + p cos(20 x), sqrt(1 + (p x)**2), |x|; x**2 whose slope has the relative error p,
  !> x**2 that is NaN for x > p, that fails there, and that fails outside of the profile.
  integer, parameter, public :: COSINE = 1, ABSOLUTE_CUBE = 2, EXPONENTIAL = 3, TWO_WELLS = 4, WAVY = 5, &
    HYPERBOLA = 6, WEDGE = 7, SLOPE_TOO_LARGE = 8, NAN_BEYOND = 9, FAILS_BEYOND = 10, FAILS_OUTSIDE = 11

  type, extends(fuge_smooth_profile), public :: numbered_profile
    integer :: form = 0
    real(dp) :: parameter = 0.0_dp
  contains
    procedure :: evaluate
  end type numbered_profile

  !> x**2 with a dent at a `place`.
  type, extends(fuge_smooth_profile), public :: dented_parabola
    real(dp) :: depth = 0.0_dp, place = 4.0_dp, sharpness = 25.0_dp
  contains
    procedure :: evaluate => evaluate_dented
  end type dented_parabola

contains

  subroutine evaluate_dented(self, x, gap, slope, status)
    class(dented_parabola), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp) :: dent(size(x))

    status = 0
    dent = self%depth*exp(-self%sharpness*(x - self%place)**2)
    gap = x**2 - dent
    slope = 2.0_dp*x + 2.0_dp*self%sharpness*(x - self%place)*dent
  end subroutine evaluate_dented

  !> x**power on -reach .. reach.
  pure function power_punch(power, reach) result(punch)
    integer, intent(in) :: power
    real(dp), intent(in) :: reach
    type(fuge_polynomial_profile) :: punch

    punch%lower = -reach
    punch%upper = reach
    allocate (punch%coefficients(power + 1))
    punch%coefficients = 0.0_dp
    punch%coefficients(power + 1) = 1.0_dp
  end function power_punch

  !> The sum of factors (r - starts)**powers, each from its start on, at r from 0 to `reach`; without starts all at 0.
  pure function sum_of_powers(factors, powers, reach, starts) result(punch)
    real(dp), intent(in) :: factors(:), powers(:), reach
    real(dp), intent(in), optional :: starts(:)
    type(fuge_power_profile) :: punch

    punch%upper = reach
    allocate (punch%coefficients, source=factors)
    allocate (punch%powers, source=powers)
    if (present(starts)) allocate (punch%starts, source=starts)
  end function sum_of_powers

  subroutine evaluate(self, x, gap, slope, status)
    class(numbered_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status

    status = 0
    gap = x**2
    slope = 2.0_dp*x
    associate (p => self%parameter)
      select case (self%form)
      case (COSINE)
        gap = 2.0_dp*sin(0.5_dp*p*x)**2
        slope = p*sin(p*x)
      case (ABSOLUTE_CUBE)
        gap = abs(x)**3
        slope = 3.0_dp*x*abs(x)
      case (EXPONENTIAL)
        gap = exp(x) - x
        slope = exp(x) - 1.0_dp
      case (TWO_WELLS)
        gap = x**4 - p*x**2
        slope = 4.0_dp*x**3 - 2.0_dp*p*x
      case (WAVY)
        gap = x**2 + p*cos(20.0_dp*x)
        slope = 2.0_dp*x - 20.0_dp*p*sin(20.0_dp*x)
      case (HYPERBOLA)
        gap = sqrt(1.0_dp + (p*x)**2)
        slope = p**2*x/gap
      case (WEDGE)
        gap = abs(x)
        slope = sign(1.0_dp, x)
      case (SLOPE_TOO_LARGE)
        slope = 2.0_dp*x*(1.0_dp + p)
      case (NAN_BEYOND)
        where (x > p) gap = ieee_value(p, ieee_quiet_nan)
      case (FAILS_BEYOND)
        if (any(x > p)) status = 7
      case (FAILS_OUTSIDE)
        if (any(x < self%lower .or. x > self%upper)) status = 7
      case default
        status = 8
      end select
    end associate
  end subroutine evaluate

end module smooth_profiles
