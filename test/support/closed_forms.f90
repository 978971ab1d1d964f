!> Frictionless contacts of an elastic half-plane in closed form.
!>
!> Tests and benchmarks share them; only the kind of real numbers comes from the library.
!> Everything is per unit depth, with the modulus E* of 1/E* = 1/E1* + 1/E2*; the contact is
!> |x| <= a. Sources:
!> K. L. Johnson, Contact Mechanics, 1985, sections 2.8 (flat punches), 4.2 (cylinder), 5.2 (wedge), 13.2
!> (waves, after H. M. Westergaard, Bearing pressures and cracks, J. Appl. Mech. 6, 1939);
!> the punch A x**4 is the paper's. A flat punch that has lifted off is a punch in full contact, at
!> its limiting moment, on the part that still touches.
!>
!> Pressure and slope of the gap are the two parts of one analytic function, so that gaps
!> are integrals of the pressure's formula continued beyond the edge, times 2/E*.
module closed_forms
  use fuge_kinds, only: dp
  implicit none
  private

  public :: press_cylinder, press_quartic, press_wedge, press_flat, press_beside, press_wave

  real(dp), parameter :: PI = acos(-1.0_dp)

  !> A contact known in closed form.
  type, abstract, public :: closed_form
    !> Modulus, force per length squared; load, force per depth; half width, length.
    real(dp) :: e_star = 0.0_dp, load = 0.0_dp, a = 0.0_dp
  contains
    !> Contact pressure at x, 0 outside of the contact.
    procedure(at_point), deferred :: pressure
    !> Force between the middle of the contact and x, negative to the left of it.
    procedure(at_point), deferred :: force_to
    !> Gap before loading.
    procedure(at_point), deferred :: initial_gap
    !> Gap under load, 0 in the contact: initial gap + displacement - approach.
    procedure(at_point), deferred :: gap
    !> Mean of ln|x|, weighted by the pressure; for a wave of ln|2 sin(pi x/length)|.
    procedure(of_contact), deferred :: mean_log
    !> Force on a cell, exactly: its mean pressure times its width.
    procedure, non_overridable :: cell_force
    !> Approach, if a line load displaces the surface at distance r by -2 F/(pi E*) ln(r/datum); for a
    !> wave with datum 1 it counts from the mean of the surface.
    procedure, non_overridable :: approach
  end type closed_form

  abstract interface
    elemental function at_point(self, x) result(value)
      import :: closed_form, dp
      class(closed_form), intent(in) :: self
      real(dp), intent(in) :: x
      real(dp) :: value
    end function at_point

    elemental function of_contact(self) result(value)
      import :: closed_form, dp
      class(closed_form), intent(in) :: self
      real(dp) :: value
    end function of_contact
  end interface

  !> Hertz's line contact, initial gap x**2/(2 R).
  type, extends(closed_form), public :: cylinder
    real(dp) :: radius = 0.0_dp
  contains
    procedure :: pressure => cylinder_pressure
    procedure :: force_to => cylinder_force_to
    procedure :: initial_gap => cylinder_initial_gap
    procedure :: gap => cylinder_gap
    procedure :: mean_log => cylinder_mean_log
  end type cylinder

  !> Initial gap A x**4, A the `factor`.
  type, extends(closed_form), public :: quartic_punch
    real(dp) :: factor = 0.0_dp
  contains
    procedure :: pressure => quartic_pressure
    procedure :: force_to => quartic_force_to
    procedure :: initial_gap => quartic_initial_gap
    procedure :: gap => quartic_gap
    procedure :: mean_log => quartic_mean_log
  end type quartic_punch

  !> A blunt wedge, initial gap `slope` |x|.
  type, extends(closed_form), public :: wedge
    real(dp) :: slope = 0.0_dp
  contains
    procedure :: pressure => wedge_pressure
    procedure :: force_to => wedge_force_to
    procedure :: initial_gap => wedge_initial_gap
    procedure :: gap => wedge_gap
    procedure :: mean_log => wedge_mean_log
  end type wedge

  !> A flat rigid face under load and moment, in contact for |x| <= a.
  !>
  !> `gap` is measured from the plane of the face: beside a corner it is negative, because the surface
  !> is higher.
  type, extends(closed_form), public :: flat_punch
    !> Sum of force times x; the face sinks by `tilt` x.
    real(dp) :: moment = 0.0_dp, tilt = 0.0_dp
    !> Position of the middle of the contact relative to that of the face.
    real(dp) :: middle = 0.0_dp
  contains
    procedure :: pressure => flat_pressure
    procedure :: force_to => flat_force_to
    procedure :: initial_gap => flat_initial_gap
    procedure :: gap => flat_gap
    procedure :: mean_log => flat_mean_log
  end type flat_punch

  !> Initial gap Delta (1 - cos(2 pi x/lambda)): amplitude Delta, from crest to trough
  !> 2 Delta. `load` is that of one wave.
  type, extends(closed_form), public :: sinusoidal_wave
    real(dp) :: length = 0.0_dp, amplitude = 0.0_dp
    !> p* = pi E* Delta/lambda, the mean pressure that closes all gaps.
    real(dp) :: closing = 0.0_dp
  contains
    procedure :: pressure => wave_pressure
    procedure :: force_to => wave_force_to
    procedure :: initial_gap => wave_initial_gap
    procedure :: gap => wave_gap
    procedure :: mean_log => wave_mean_log
    procedure :: is_full
  end type sinusoidal_wave

contains

  elemental function cell_force(self, x, width) result(force)
    class(closed_form), intent(in) :: self
    real(dp), intent(in) :: x, width
    real(dp) :: force

    force = self%force_to(x + 0.5_dp*width) - self%force_to(x - 0.5_dp*width)
  end function cell_force

  elemental function approach(self, datum)
    class(closed_form), intent(in) :: self
    real(dp), intent(in) :: datum
    real(dp) :: approach

    approach = self%initial_gap(0.0_dp) + 2.0_dp*self%load/(PI*self%e_star)*(log(datum) - self%mean_log())
  end function approach

  !> x, limited to the contact.
  elemental function clamped(x, a) result(inside)
    real(dp), intent(in) :: x, a
    real(dp) :: inside

    inside = max(-a, min(a, x))
  end function clamped

  !> The integral of sqrt(s**2 - a**2) from a to s, 0 for s < a.
  elemental function root_integral(s, a) result(integral)
    real(dp), intent(in) :: s, a
    real(dp) :: integral

    integral = 0.0_dp
    if (s > a) integral = 0.5_dp*(s*root(s, a) - a**2*acosh(s/a))
  end function root_integral

  !> sqrt(s**2 - a**2), without cancellation.
  elemental function root(s, a)
    real(dp), intent(in) :: s, a
    real(dp) :: root

    root = sqrt(max(0.0_dp, (s - a)*(s + a)))
  end function root

  !> a**2 = 4 F R/(pi E*).
  pure function press_cylinder(e_star, load, radius) result(form)
    real(dp), intent(in) :: e_star, load, radius
    type(cylinder) :: form

    form%e_star = e_star
    form%load = load
    form%radius = radius
    form%a = sqrt(4.0_dp*load*radius/(PI*e_star))
  end function press_cylinder

  !> p = E* sqrt(a**2 - x**2)/(2 R).
  elemental function cylinder_pressure(self, x) result(value)
    class(cylinder), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = self%e_star*root(self%a, abs(x))/(2.0_dp*self%radius)
  end function cylinder_pressure

  elemental function cylinder_force_to(self, x) result(value)
    class(cylinder), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, s

    s = clamped(x, self%a)
    value = self%load*(s*root(self%a, abs(s))/self%a**2 + asin(s/self%a))/PI
  end function cylinder_force_to

  elemental function cylinder_initial_gap(self, x) result(value)
    class(cylinder), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = x**2/(2.0_dp*self%radius)
  end function cylinder_initial_gap

  elemental function cylinder_gap(self, x) result(value)
    class(cylinder), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = root_integral(abs(x), self%a)/self%radius
  end function cylinder_gap

  !> With x = a sin(t) the series of ln|2 sin(t)|, -sum cos(2 k t)/k, against cos(t)**2.
  elemental function cylinder_mean_log(self) result(value)
    class(cylinder), intent(in) :: self
    real(dp) :: value

    value = log(0.5_dp*self%a) - 0.5_dp
  end function cylinder_mean_log

  !> F = (3 pi/4) E* A a**4.
  pure function press_quartic(e_star, load, factor) result(form)
    real(dp), intent(in) :: e_star, load, factor
    type(quartic_punch) :: form

    form%e_star = e_star
    form%load = load
    form%factor = factor
    form%a = sqrt(sqrt(load/(0.75_dp*PI*e_star*factor)))
  end function press_quartic

  !> p = E* A (2 x**2 + a**2) sqrt(a**2 - x**2).
  elemental function quartic_pressure(self, x) result(value)
    class(quartic_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = self%e_star*self%factor*(2.0_dp*x**2 + self%a**2)*root(self%a, abs(x))
  end function quartic_pressure

  elemental function quartic_force_to(self, x) result(value)
    class(quartic_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, angle

    angle = asin(clamped(x, self%a)/self%a)
    value = self%e_star*self%factor*self%a**4 &
            *(0.75_dp*angle + 0.25_dp*sin(2.0_dp*angle) - 0.0625_dp*sin(4.0_dp*angle))
  end function quartic_force_to

  elemental function quartic_initial_gap(self, x) result(value)
    class(quartic_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = self%factor*x**4
  end function quartic_initial_gap

  elemental function quartic_gap(self, x) result(value)
    class(quartic_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, s

    s = abs(x)
    value = self%factor*(s*root(s, self%a)**3 + 3.0_dp*self%a**2*root_integral(s, self%a))
  end function quartic_gap

  !> As for the cylinder: two thirds of the load have its pressure, and one third adds 1/4.
  elemental function quartic_mean_log(self) result(value)
    class(quartic_punch), intent(in) :: self
    real(dp) :: value

    value = log(0.5_dp*self%a) - 0.25_dp
  end function quartic_mean_log

  !> F = E* slope a.
  pure function press_wedge(e_star, load, slope) result(form)
    real(dp), intent(in) :: e_star, load, slope
    type(wedge) :: form

    form%e_star = e_star
    form%load = load
    form%slope = slope
    form%a = load/(e_star*slope)
  end function press_wedge

  !> p = (E* slope/pi) arccosh(a/|x|), infinite at the tip, where this returns 0.
  elemental function wedge_pressure(self, x) result(value)
    class(wedge), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 0.0_dp
    if (abs(x) < self%a .and. abs(x) > 0.0_dp) value = self%e_star*self%slope/PI*acosh(self%a/abs(x))
  end function wedge_pressure

  elemental function wedge_force_to(self, x) result(value)
    class(wedge), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, s

    s = clamped(x, self%a)
    value = 0.0_dp
    if (abs(s) > 0.0_dp) value = self%e_star*self%slope/PI*(s*acosh(self%a/abs(s)) + self%a*asin(s/self%a))
  end function wedge_force_to

  elemental function wedge_initial_gap(self, x) result(value)
    class(wedge), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = self%slope*abs(x)
  end function wedge_initial_gap

  elemental function wedge_gap(self, x) result(value)
    class(wedge), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 0.0_dp
    if (abs(x) > self%a) value = 2.0_dp*self%slope/PI*(abs(x)*acos(self%a/abs(x)) - self%a*acosh(abs(x)/self%a))
  end function wedge_gap

  !> By parts: the integral of ln(t) arccosh(1/t) from 0 to 1 is -(pi/2) (1 + ln(2)).
  elemental function wedge_mean_log(self) result(value)
    class(wedge), intent(in) :: self
    real(dp) :: value

    value = log(0.5_dp*self%a) - 1.0_dp
  end function wedge_mean_log

  !> A face of half width a; |moment| <= load a/2, or it lifts off at one edge.
  pure function press_flat(e_star, load, a, moment) result(form)
    real(dp), intent(in) :: e_star, load, a
    real(dp), intent(in), optional :: moment
    type(flat_punch) :: form

    form%e_star = e_star
    form%load = load
    form%a = a
    if (present(moment)) form%moment = moment
    form%tilt = 4.0_dp*form%moment/(PI*e_star*a**2)
  end function press_flat

  !> The same face under a force at the distance `arm` from its middle, a/2 <= arm < a: it
  !> lifts off on the left, and what still touches, of half width 2 (a - `arm`), is in full
  !> contact under a force at half of its own half width.
  pure function press_beside(e_star, load, a, arm) result(form)
    real(dp), intent(in) :: e_star, load, a, arm
    type(flat_punch) :: form

    form = press_flat(e_star, load, 2.0_dp*(a - arm), load*(a - arm))
    form%middle = 2.0_dp*arm - a
  end function press_beside

  !> p = (F + 2 M x/a**2)/(pi sqrt(a**2 - x**2)), infinite at the edges, where this returns 0.
  elemental function flat_pressure(self, x) result(value)
    class(flat_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 0.0_dp
    if (abs(x) < self%a) value = (self%load + 2.0_dp*self%moment*x/self%a**2)/(PI*root(self%a, abs(x)))
  end function flat_pressure

  elemental function flat_force_to(self, x) result(value)
    class(flat_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, s

    s = clamped(x, self%a)
    ! The part of the moment vanishes at both edges, not in the middle.
    value = (self%load*asin(s/self%a) &
             + 2.0_dp*self%moment/self%a*(1.0_dp - root(self%a, abs(s))/self%a))/PI
  end function flat_force_to

  elemental function flat_initial_gap(self, x) result(value)
    class(flat_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = -self%tilt*x
  end function flat_initial_gap

  !> -(2 F/(pi E*)) arccosh(|x|/a), and the part of the tilt.
  elemental function flat_gap(self, x) result(value)
    class(flat_punch), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 0.0_dp
    if (abs(x) > self%a) value = -2.0_dp*self%load/(PI*self%e_star)*acosh(abs(x)/self%a) &
                                 - self%tilt*sign(root(abs(x), self%a), x)
  end function flat_gap

  !> The load contributes the constant of the series only, and the moment is odd.
  elemental function flat_mean_log(self) result(value)
    class(flat_punch), intent(in) :: self
    real(dp) :: value

    value = log(0.5_dp*self%a)
  end function flat_mean_log

  !> `mean` pressure p = p* sin(pi a/lambda)**2; from p* on the contact is full.
  pure function press_wave(e_star, mean, length, amplitude) result(form)
    real(dp), intent(in) :: e_star, mean, length, amplitude
    type(sinusoidal_wave) :: form

    form%e_star = e_star
    form%load = mean*length
    form%length = length
    form%amplitude = amplitude
    form%closing = PI*e_star*amplitude/length
    form%a = length/PI*asin(sqrt(min(1.0_dp, mean/form%closing)))
  end function press_wave

  elemental function is_full(self)
    class(sinusoidal_wave), intent(in) :: self
    logical :: is_full

    is_full = self%load >= self%closing*self%length
  end function is_full

  !> p = 2 p* cos(psi) sqrt(sin(psi_a)**2 - sin(psi)**2), psi = pi x/lambda; in full contact
  !> the mean + p* cos(2 psi).
  elemental function wave_pressure(self, x) result(value)
    class(sinusoidal_wave), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, psi, psi_a

    psi = PI*x/self%length
    if (self%is_full()) then
      value = self%load/self%length + self%closing*cos(2.0_dp*psi)
    else
      psi_a = PI*self%a/self%length
      value = 2.0_dp*self%closing*abs(cos(psi))*root(sin(psi_a), abs(sin(psi)))
    end if
  end function wave_pressure

  elemental function wave_force_to(self, x) result(value)
    class(sinusoidal_wave), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value, waves, s, edge

    if (self%is_full()) then
      value = self%load*x/self%length + self%closing*self%length/(2.0_dp*PI)*sin(2.0_dp*PI*x/self%length)
      return
    end if
    waves = anint(x/self%length)
    edge = sin(PI*self%a/self%length)
    s = clamped(sin(PI*(x/self%length - waves)), edge)
    value = self%load*waves &
            + self%closing*self%length/PI*(s*root(edge, abs(s)) + edge**2*asin(s/edge))
  end function wave_force_to

  elemental function wave_initial_gap(self, x) result(value)
    class(sinusoidal_wave), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 2.0_dp*self%amplitude*sin(PI*x/self%length)**2
  end function wave_initial_gap

  elemental function wave_gap(self, x) result(value)
    class(sinusoidal_wave), intent(in) :: self
    real(dp), intent(in) :: x
    real(dp) :: value

    value = 0.0_dp
    if (self%is_full()) return
    value = 4.0_dp*self%amplitude*root_integral(abs(sin(PI*x/self%length)), sin(PI*self%a/self%length))
  end function wave_gap

  !> As for the cylinder, in sin(pi x/length).
  elemental function wave_mean_log(self) result(value)
    class(sinusoidal_wave), intent(in) :: self
    real(dp) :: value

    if (self%is_full()) then
      ! The surface moves to its mean, by the amplitude.
      value = -0.5_dp*PI*self%e_star*self%amplitude/self%load
    else
      value = log(sin(PI*self%a/self%length)) - 0.5_dp
    end if
  end function wave_mean_log

end module closed_forms
