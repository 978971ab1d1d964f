!> The contact of a smooth punch with a half-plane, in closed form once its ends and the
!> coefficients of its pressure are known.
!>
!> With x = centre + half_width t the pressure is sqrt(1 - t**2) sum_k c_k U_k(t), k = 0 .. n.
!> Its finite Hilbert transform is pi sum_k c_k T_(k+1)(t) inside the contact and, with w the
!> root of w + 1/w = 2 t with |w| < 1, pi sum_k c_k w**(k+1) outside (F. G. Tricomi, Integral
!> Equations, 1957, section 4.3; K. L. Johnson, Contact Mechanics, 1985, section 2.7). See
!> doc/theory_punch.md, "Smooth punches".
module fuge_smooth_contact_type
  use fuge_chebyshev, only: second_kind_sum
  use fuge_kinds, only: dp
  use fuge_punch_contact_type, only: punch_contact
  implicit none
  private

  !> A contact in one interval. Without force both ends are the same point.
  type, extends(punch_contact), public :: fuge_smooth_contact
    !> Left and right end of the contact; length.
    real(dp) :: ends(2) = 0.0_dp
    !> Half the length of the contact, and its middle, anchor + offset, as a sum of two numbers,
    !> because one number has too few digits for a narrow contact far from 0; length.
    real(dp) :: half_width = 0.0_dp, anchor = 0.0_dp, offset = 0.0_dp
    !> Force per unit depth, and its moment about x = 0: force per length, and force.
    real(dp) :: force = 0.0_dp, moment = 0.0_dp
    !> The punch moves by approach + tilt x; tilt has no unit. The displacement by a line load
    !> is zero at the distance 2 (upper - lower), with the ends of the profile, as in
    !> `fuge_halfplane_matrix` for cells that cover the profile.
    real(dp) :: tilt = 0.0_dp
    !> That distance; length. 0 without force.
    real(dp) :: datum = 0.0_dp
    !> Coefficients c_0, c_1, .. of the pressure; force per length squared.
    real(dp), allocatable :: coefficients(:)
    !> Estimated error of half_width and of the ends, relative to half_width; that of the pressure is relative to its
    !> maximum.
    real(dp) :: end_error = 0.0_dp
    !> Initial gap at the ends; length.
    real(dp) :: end_gaps(2) = 0.0_dp
  contains
    procedure :: pressures_at
    procedure :: gaps_at
  end type fuge_smooth_contact

contains

  !> Pressures at several `places`, length; (size(places)), force per length squared, 0 outside of the contact.
  pure function pressures_at(self, places) result(pressure)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: places(:)
    real(dp) :: pressure(size(places))
    real(dp) :: t(size(places))

    pressure = 0.0_dp
    if (.not. allocated(self%coefficients)) return
    t = max(-1.0_dp, min(1.0_dp, ((places - self%anchor) - self%offset)/self%half_width))
    pressure = sqrt((1.0_dp - t)*(1.0_dp + t))*second_kind_sum(self%coefficients, t)
  end function pressures_at

  !> Gaps at several `places`, length, where the initial gaps are `initial_gap` (size(places)), length.
  !>
  !> The slope of the gap outside of the contact is g' - tilt - sum_k (2 c_(k-1)/E*) w**k, k >= 1,
  !> which is integrated over t from the end term by term.
  pure function gaps_at(self, places, initial_gap) result(gap)
    class(fuge_smooth_contact), intent(in) :: self
    real(dp), intent(in) :: places(:), initial_gap(:)
    real(dp) :: gap(size(places))
    real(dp) :: outside(size(places)), w(size(places)), series(size(places))
    integer :: side(size(places))

    side = merge(1, 2, places <= self%ends(1))
    outside = merge(self%ends(1) - places, places - self%ends(2), side == 1)
    gap = (initial_gap - self%end_gaps(side)) - self%tilt*(places - self%ends(side))
    if (allocated(self%coefficients)) then
      w = small_root(max(0.0_dp, outside)/self%half_width)
      series = slope_integrals(self%coefficients, w, merge(-1, 1, side == 1))
      gap = gap - 2.0_dp*self%half_width/self%e_star*series
      gap = merge(gap, 0.0_dp, outside > 0.0_dp)
    end if
  end function gaps_at

  !> The root w < 1 of w + 1/w = 2 t, with t = 1 + beyond.
  elemental function small_root(beyond) result(w)
    real(dp), intent(in) :: beyond
    real(dp) :: w

    w = 1.0_dp/(1.0_dp + beyond + sqrt(beyond*(2.0_dp + beyond)))
  end function small_root

  !> sum_k c_(k-1) times the integral of w**k over t from the end outwards: for t >= 1 (`direction`
  !> 1), or for t <= -1, where w < 0 (`direction` -1).
  pure function slope_integrals(c, w, direction) result(series)
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
  end function slope_integrals

end module fuge_smooth_contact_type
