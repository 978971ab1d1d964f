!> The profile of a smooth punch: its initial gap as a function of position.
module fuge_smooth_profile_type
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_chebyshev, only: chebyshev_coefficients, chebyshev_derivative, chebyshev_points, chebyshev_sum
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, &
    FUGE_ERR_WIDTH
  implicit none
  private

  public :: sample_profile

  !> Extend it for a profile of your own. The gap has to be smooth from `lower` to `upper`, the ends
  !> of the body, and is never evaluated beyond them.
  type, abstract, public :: fuge_smooth_profile
    !> Ends of the profile; length.
    real(dp) :: lower = 0.0_dp, upper = 0.0_dp
  contains
    !> Gaps and slopes at given positions.
    procedure(evaluate_at), deferred :: evaluate
  end type fuge_smooth_profile

  abstract interface
    !> The initial `gap` (size(x)), length, and its derivative `slope` (size(x)), no unit, at positions
    !> `x`, length. A `status` other than 0 ends the solve: an error of `fuge_status` keeps its
    !> meaning, any other value becomes FUGE_ERR_CALLBACK with the value in the message. NaN
    !> and infinity are detected and need no status.
    subroutine evaluate_at(self, x, gap, slope, status)
      import :: fuge_smooth_profile, dp
      class(fuge_smooth_profile), intent(in) :: self
      real(dp), intent(in) :: x(:)
      real(dp), intent(out) :: gap(:), slope(:)
      integer, intent(out) :: status
    end subroutine evaluate_at
  end interface

  !> Initial gap sum_k coefficients(k + 1) (x - centre)**k, k = 0, 1, ..; set the
  !> components by name.
  type, extends(fuge_smooth_profile), public :: fuge_polynomial_profile
    !> Where the powers vanish; length.
    real(dp) :: centre = 0.0_dp
    !> From the power 0 on, (degree + 1); for power k, length per length**k.
    real(dp), allocatable :: coefficients(:)
  contains
    procedure :: evaluate => evaluate_polynomial
  end type fuge_polynomial_profile

  !> A profile from gaps at Chebyshev points, those of `points`, and between them the polynomial through
  !> all: for a smooth profile as exact as the gaps.
  type, extends(fuge_smooth_profile), public :: fuge_sampled_profile
    real(dp), allocatable, private :: height(:), derivative(:)
  contains
    procedure, nopass :: points => sampling_points
    procedure :: set => set_heights
    procedure :: evaluate => evaluate_samples
  end type fuge_sampled_profile

contains

  !> Evaluate a profile at `x` and check the result. Errors: the status of the profile, or
  !> FUGE_ERR_CALLBACK; the message has the position.
  subroutine sample_profile(profile, x, gap, slope, info)
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    type(fuge_info), intent(inout) :: info
    integer :: status, k

    call profile%evaluate(x, gap, slope, status)
    if (status > FUGE_DONE) then
      call report(info, FUGE_ERR_CALLBACK, 'the profile returned the status '//text(status)//' at '//text(size(x)) &
                  //' point(s) from x = '//text(x(1)))
    else if (status == FUGE_ERR_CALL_ORDER) then
      call report(info, status, 'the profile has no data: set it first')
    else if (status < FUGE_DONE) then
      call report(info, status, 'the profile could not be evaluated at x = '//text(x(1)))
    end if
    if (info%failed()) return
    do k = 1, size(x)
      if (ieee_is_finite(gap(k)) .and. ieee_is_finite(slope(k))) cycle
      call report(info, FUGE_ERR_CALLBACK, 'at x = '//text(x(k))//' the profile returned the gap '//text(gap(k)) &
                  //' and the slope '//text(slope(k))//': both must be finite from lower to upper')
      return
    end do
  end subroutine sample_profile

  !> `x` length; `gap` (size(x)) length and `slope` (size(x)) no unit. `status`: FUGE_DONE, or
  !> FUGE_ERR_CALL_ORDER without coefficients.
  subroutine evaluate_polynomial(self, x, gap, slope, status)
    class(fuge_polynomial_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    integer :: k

    gap = 0.0_dp
    slope = 0.0_dp
    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%coefficients)) return
    status = FUGE_DONE
    do k = size(self%coefficients), 1, -1
      slope = slope*(x - self%centre) + gap
      gap = gap*(x - self%centre) + self%coefficients(k)
    end do
  end subroutine evaluate_polynomial

  !> The n + 1 sampling points, n a power of two, from `upper` down to `lower`; length.
  pure function sampling_points(lower, upper, n) result(x)
    real(dp), intent(in) :: lower, upper
    integer, intent(in) :: n
    real(dp) :: x(n + 1)

    x = 0.5_dp*(lower + upper) + 0.5_dp*(upper - lower)*chebyshev_points(n)
    x(1) = upper
    x(n + 1) = lower
  end function sampling_points

  !> Set a profile from its `gap` (n + 1) at the points of `points(lower, upper, n)`; length.
  !> Errors, the profile untouched: FUGE_ERR_SIZE unless n is a power of two,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH unless lower < upper.
  subroutine set_heights(self, lower, upper, gap, info)
    class(fuge_sampled_profile), intent(inout) :: self
    real(dp), intent(in) :: lower, upper, gap(:)
    type(fuge_info), intent(out) :: info
    integer :: n

    n = size(gap) - 1
    if (n < 2 .or. popcnt(max(n, 0)) /= 1) then
      call report(info, FUGE_ERR_SIZE, 'gap has '//text(size(gap)) &
                  //' value(s): give 2**k + 1 of them, k >= 1, at the points of the procedure points')
      return
    end if
    call check_finite(lower, 'lower', info)
    if (.not. info%failed()) call check_finite(upper, 'upper', info)
    if (.not. info%failed()) call check_finite(gap, 'gap', info)
    if (info%failed()) return
    if (.not. lower < upper) then
      call report(info, FUGE_ERR_WIDTH, 'lower = '//text(lower)//' is not below upper = '//text(upper))
      return
    end if
    self%lower = lower
    self%upper = upper
    self%height = chebyshev_coefficients(gap)
    self%derivative = chebyshev_derivative(self%height)
  end subroutine set_heights

  !> `x` length; `gap` (size(x)) length and `slope` (size(x)) no unit. `status`: FUGE_DONE, or
  !> FUGE_ERR_CALL_ORDER before `set`.
  subroutine evaluate_samples(self, x, gap, slope, status)
    class(fuge_sampled_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp) :: t(size(x)), half_width

    gap = 0.0_dp
    slope = 0.0_dp
    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%height)) return
    status = FUGE_DONE
    half_width = 0.5_dp*(self%upper - self%lower)
    t = ((x - self%lower) - (self%upper - x))/(2.0_dp*half_width)
    gap = chebyshev_sum(self%height, t)
    slope = chebyshev_sum(self%derivative, t)/half_width
  end subroutine evaluate_samples

end module fuge_smooth_profile_type
