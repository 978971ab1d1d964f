!> The law of a contact point: its force falls in steps as its gap grows.
!>
!>     f = u              c <= 0        limited at the lower stop: the point gives way, -c is its penetration
!>     0 <= f <= u        c = 0         at the lower stop
!>     f = 0              0 <= c <= d   open
!>     -l <= f <= 0       c = d         at the upper stop
!>     f = -l             c >= d        limited at the upper stop
!>
!> d is the play, u and l are the limits of the force at the two stops, any of them infinite. An excluded point is one
!> whose limits are zero, a tied point one whose play is zero.
module fuge_point_law
  use fuge_kinds, only: dp
  use fuge_relative_size, only: relative
  implicit none
  private

  !> An infinite play or limit is `huge`.
  type, public :: point_law
    !> Play d, length.
    real(dp) :: play = huge(1.0_dp)
    !> Limits u and l, force.
    real(dp) :: limit = huge(1.0_dp), limit_upper = huge(1.0_dp)
  contains
    procedure :: most_force
    procedure :: least_force
    procedure :: distance
    procedure :: stop_distance
  end type point_law

contains

  !> The largest force that the point can have.
  elemental function most_force(self)
    class(point_law), intent(in) :: self
    real(dp) :: most_force

    most_force = self%limit
  end function most_force

  !> The least force that the point can have: zero without an upper stop.
  elemental function least_force(self)
    class(point_law), intent(in) :: self
    real(dp) :: least_force

    least_force = 0.0_dp
    if (self%play < huge(1.0_dp)) least_force = -self%limit_upper
  end function least_force

  !> How far a `force` and a `gap` are from the law: the least distance from one of its steps, with forces as fractions
  !> of `force_scale` and lengths of `length_scale`; no unit. Forces up to `noise` beside a step are rounding.
  elemental function distance(self, force, gap, force_scale, length_scale, noise)
    class(point_law), intent(in) :: self
    real(dp), intent(in) :: force, gap, force_scale, length_scale, noise
    real(dp) :: distance

    distance = min(max(lengths(gap), forces(beyond(force, 0.0_dp, self%limit))), &
                   max(forces(force), lengths(beyond(gap, 0.0_dp, self%play))))
    if (self%limit < huge(1.0_dp)) then
      distance = min(distance, max(forces(force - self%limit), lengths(max(gap, 0.0_dp))))
    end if
    if (.not. self%play < huge(1.0_dp)) return
    distance = min(distance, max(lengths(gap - self%play), forces(beyond(force, -self%limit_upper, 0.0_dp))))
    if (self%limit_upper < huge(1.0_dp)) then
      distance = min(distance, max(forces(force + self%limit_upper), lengths(max(self%play - gap, 0.0_dp))))
    end if

  contains

    pure function lengths(length)
      real(dp), intent(in) :: length
      real(dp) :: lengths

      lengths = relative(abs(length), length_scale)
    end function lengths

    pure function forces(difference)
      real(dp), intent(in) :: difference
      real(dp) :: forces

      forces = relative(max(abs(difference) - noise, 0.0_dp), force_scale)
    end function forces

  end function distance

  !> How far a value lies outside of an interval.
  elemental function beyond(value, least, most)
    real(dp), intent(in) :: value, least, most
    real(dp) :: beyond

    beyond = 0.0_dp
    if (value > most) beyond = value - most
    if (value < least) beyond = least - value
  end function beyond

  !> How far a point whose force is not zero is from the stop that the force belongs to, length; zero where it has given
  !> way under its limit.
  elemental function stop_distance(self, force, gap) result(length)
    class(point_law), intent(in) :: self
    real(dp), intent(in) :: force, gap
    real(dp) :: length

    if (force < 0.0_dp .and. self%play < huge(length)) then
      length = gap - self%play
      if (force <= -self%limit_upper) length = min(length, 0.0_dp)
    else
      length = gap
      if (force >= self%limit) length = max(length, 0.0_dp)
    end if
    length = abs(length)
  end function stop_distance

end module fuge_point_law
