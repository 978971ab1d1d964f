!> The contact of a smooth punch with a half-plane, in closed form once its ends and the
!> coefficients of its pressure are known.
!>
!> With x = centre + half t the pressure is sqrt(1 - t**2) sum_k c_k U_k(t), k = 0 .. n.
!> Its finite Hilbert transform is pi sum_k c_k T_(k+1)(t) inside and, with w the
!> root of w + 1/w = 2 t that is less than 1, pi sum_k c_k w**(k+1) outside (F. G.
!> Tricomi, Integral Equations, 1957, section 4.3; K. L. Johnson, Contact Mechanics, 1985,
!> section 2.7). See doc/theory.md, "Smooth punches".
module fuge_smooth_contact_type
  use fuge_chebyshev, only: second_kind_sum
  use fuge_kinds, only: dp
  implicit none
  private

  public :: contact_slope

  !> A half-plane's contact in one interval. No force: the ends are the same point.
  type, public :: fuge_smooth_contact
    !> Left and right end of the contact; length.
    real(dp) :: ends(2) = 0.0_dp
    !> Half of its length, and in two parts, anchor + offset, its middle: with more digits than
    !> the ends have where these are far from 0.
    real(dp) :: half_width = 0.0_dp, anchor = 0.0_dp, offset = 0.0_dp
    !> Force per depth, and its moment about x = 0.
    real(dp) :: force = 0.0_dp, moment = 0.0_dp
    !> The punch moves by approach + tilt x; length, no unit. The displacement by a line
    !> load is taken as zero at twice the length of the profile, upper - lower, as in
    !> `fuge_halfplane_matrix` for cells that cover it.
    real(dp) :: approach = 0.0_dp, tilt = 0.0_dp
    !> Modulus; force per length squared.
    real(dp) :: e_star = 0.0_dp
    !> c_0, c_1, .. as above; force per length squared.
    real(dp), allocatable :: coefficients(:)
    !> Estimates of the errors: of half_width and of the ends, relative to it; of the
    !> pressure, relative to the highest.
    real(dp) :: end_error = 0.0_dp, pressure_error = 0.0_dp
    !> Initial gap at the ends; length.
    real(dp) :: end_gaps(2) = 0.0_dp
  contains
    procedure, private :: pressure_at
    procedure, private :: pressures_at
    !> Contact pressure at any x, one or several; force per length squared.
    generic :: pressure => pressure_at, pressures_at
    procedure, private :: gap_at
    procedure, private :: gaps_at
    !> Gap under load at any x, one or several, from the initial gap there; length.
    !> 0 in the contact, elsewhere to rounding of the initial gap.
    generic :: gap => gap_at, gaps_at
  end type fuge_smooth_contact

contains

  !> At one `x`, length: force per length squared; 0 outside of the contact.
  pure function pressure_at(self, x) result(pressure)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: pressure
    real(dp) :: one(1)

    one = self%pressures_at([x])
    pressure = one(1)
  end function pressure_at

  !> At several `x`, length: (size(x)), force per length squared; 0 outside of the contact.
  pure function pressures_at(self, x) result(pressure)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: x(:)
    real(dp) :: pressure(size(x))
    real(dp) :: t(size(x))

    pressure = 0.0_dp
    if (.not. allocated(self%coefficients)) return
    t = max(-1.0_dp, min(1.0_dp, ((x - self%anchor) - self%offset)/self%half_width))
    pressure = sqrt((1.0_dp - t)*(1.0_dp + t))*second_kind_sum(self%coefficients, t)
  end function pressures_at

  !> At one `x`, length, where the initial gap is `initial_gap`, length.
  pure function gap_at(self, x, initial_gap) result(gap)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: x, initial_gap
    real(dp) :: gap
    real(dp) :: one(1)

    one = self%gaps_at([x], [initial_gap])
    gap = one(1)
  end function gap_at

  !> At several `x`, length, where the initial gaps are `initial_gap` (size(x)), length.
  !>
  !> The slope of the gap outside is g' - tilt - sum_k (2 c_(k-1)/E*) w**k, k >= 1, whose
  !> integral over t from the end is known term by term.
  pure function gaps_at(self, x, initial_gap) result(gap)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: x(:), initial_gap(:)
    real(dp) :: gap(size(x))
    real(dp) :: outside(size(x)), w(size(x)), series(size(x))
    integer :: side(size(x))

    side = merge(1, 2, x <= self%ends(1))
    outside = merge(self%ends(1) - x, x - self%ends(2), side == 1)
    gap = (initial_gap - self%end_gaps(side)) - self%tilt*(x - self%ends(side))
    if (allocated(self%coefficients)) then
      w = small_root(max(0.0_dp, outside)/self%half_width)
      series = integrals(self%coefficients, w, merge(-1, 1, side == 1))
      gap = gap - 2.0_dp*self%half_width/self%e_star*series
      gap = merge(gap, 0.0_dp, outside > 0.0_dp)
    end if
  end function gaps_at

  !> The root w of w + 1/w = 2 t below 1, with t = 1 + beyond.
  elemental function small_root(beyond) result(w)
    real(dp), intent(in) :: beyond
    real(dp) :: w

    w = 1.0_dp/(1.0_dp + beyond + sqrt(beyond*(2.0_dp + beyond)))
  end function small_root

  !> sum_k c_(k-1) times the integral of w**k from the end outwards, for t >= 1
  !> (`direction` 1), or from t <= -1 where w < 0 and t falls (-1).
  pure function integrals(c, w, direction) result(series)
    real(dp), intent(in) :: c(0:), w(:)
    integer, intent(in) :: direction(:)
    real(dp) :: series(size(w))
    real(dp) :: power(size(w)), sign_now(size(w))
    integer :: k

    series = 0.5_dp*c(0)*(0.5_dp*(w - 1.0_dp)*(w + 1.0_dp) - log(w))
    sign_now = 1.0_dp
    ! w**(k-1)
    power = 1.0_dp
    do k = 2, size(c)
      power = power*w
      sign_now = sign_now*real(direction, dp)
      series = series + 0.5_dp*c(k - 1)*sign_now &
               *((power*w**2 - 1.0_dp)/real(k + 1, dp) - (power - 1.0_dp)/real(k - 1, dp))
    end do
  end function integrals

  !> Slope of the gap at x outside of the contact (inside it is zero), from the initial one.
  pure function contact_slope(contact, x, initial_slope) result(slope)
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: x(:), initial_slope(:)
    real(dp) :: slope(size(x))
    real(dp) :: w(size(x)), sum_now(size(x))
    integer :: k

    w = small_root(max(0.0_dp, contact%ends(1) - x, x - contact%ends(2))/contact%half_width)
    where (x <= contact%ends(1)) w = -w
    sum_now = 0.0_dp
    do k = size(contact%coefficients), 1, -1
      sum_now = w*(sum_now + contact%coefficients(k))
    end do
    slope = initial_slope - contact%tilt - 2.0_dp/contact%e_star*sum_now
  end function contact_slope

end module fuge_smooth_contact_type
