!> Profiles of round punches as sums of powers of the radius: powers that are no integers, parts that begin at an edge.
module fuge_power_profile_type
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_smooth_profile_type, only: fuge_smooth_profile
  use fuge_status, only: FUGE_DONE, FUGE_ERR_CALL_ORDER, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH
  implicit none
  private

  !> Initial gap sum_k coefficients(k) (r - starts(k))**powers(k), each term from r = starts(k) on; set the components
  !> by name, `upper` too. Powers >= 1: 1 for a cone, 2 for a paraboloid, any other one for a profile that a polynomial
  !> cannot follow at the axis. A flat end of radius b with an edge rounded by R is (r - b)**2/(2 R); a ball worn flat
  !> there has b (r - b)/R in addition.
  type, extends(fuge_smooth_profile), public :: fuge_power_profile
    !> Coefficients and powers, of the same size; the coefficient of the power n has the unit length per length**n.
    real(dp), allocatable :: coefficients(:), powers(:)
    !> Radii from which on the terms act, of that size too, >= 0, length; all are 0 if it is not allocated. Where one is
    !> not 0 the power is 1 or 2.
    real(dp), allocatable :: starts(:)
  contains
    procedure :: evaluate
    !> The starts, or zeros.
    procedure :: all_starts
  end type fuge_power_profile

contains

  !> `x` the radius, length; `gap` (size(x)) length and `slope` (size(x)) no unit. `status`: FUGE_DONE,
  !> FUGE_ERR_CALL_ORDER without coefficients or powers, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for a power below 1, a
  !> start below 0, or a start with another power than 1 or 2.
  subroutine evaluate(self, x, gap, slope, status)
    class(fuge_power_profile), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp), intent(out) :: gap(:), slope(:)
    integer, intent(out) :: status
    real(dp), dimension(size(x)) :: r, power
    real(dp), allocatable :: start(:)
    integer :: k

    gap = 0.0_dp
    slope = 0.0_dp
    status = FUGE_ERR_CALL_ORDER
    if (.not. allocated(self%coefficients) .or. .not. allocated(self%powers)) return
    if (size(self%coefficients) /= size(self%powers)) return
    allocate (start, source=self%all_starts())
    if (size(start) /= size(self%powers)) return
    status = FUGE_ERR_NOT_FINITE
    if (.not. (is_finite_everywhere(self%powers) .and. is_finite_everywhere(start))) return
    status = FUGE_ERR_WIDTH
    if (.not. all(self%powers >= 1.0_dp .and. start >= 0.0_dp)) return
    if (any(start > 0.0_dp .and. abs(self%powers - 1.0_dp) > 0.0_dp .and. abs(self%powers - 2.0_dp) > 0.0_dp)) return
    status = FUGE_DONE
    do k = 1, size(self%powers)
      r = max(0.0_dp, x - start(k))
      power = merge(self%coefficients(k), 0.0_dp, x >= start(k))
      if (self%powers(k) > 1.0_dp) power = power*r**(self%powers(k) - 1.0_dp)
      gap = gap + power*r
      slope = slope + power*self%powers(k)
    end do
  end subroutine evaluate

  !> The starts, or zeros if there are none; of the size of the powers.
  pure function all_starts(self) result(start)
    class(fuge_power_profile), intent(in) :: self
    real(dp), allocatable :: start(:)

    if (allocated(self%starts)) then
      allocate (start, source=self%starts)
    else
      allocate (start(size(self%powers)))
      start = 0.0_dp
    end if
  end function all_starts

end module fuge_power_profile_type
