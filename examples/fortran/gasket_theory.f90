!> Closed forms for the example `gasket`: the joint diagram, a ring and a beam on an elastic foundation.
module gasket_theory
  use fuge, only: dp => fuge_dp
  use gasket_ring, only: flange_ring
  implicit none
  private

  public :: beam_pressure

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Harmonics of the ring, whose deflections fall with the fourth power.
  integer, parameter :: HARMONICS = 2000

  !> A joint as long as the gasket is pressed everywhere: linear in the force of the bolts and in the thrust.
  type, public :: linear_joint
    type(flange_ring) :: ring
    logical :: rigid = .false.
    integer :: bolts = 0
    !> Of the gasket, force per length of the ring and deflection; of a bolt, length per force.
    real(dp) :: foundation = 0.0_dp, bolt_compliance = 0.0_dp
    !> Force of a bolt without thrust.
    real(dp) :: preload = 0.0_dp
  contains
    procedure :: bolt_force
    procedure :: pressure
    procedure :: stretch
    procedure :: opening_thrust
    procedure, private :: sinking
    procedure, private :: circumference
  end type linear_joint

contains

  !> Force of a bolt under the thrust. For a rigid ring the load factor c_b/(c_b + c_g) of the joint diagram.
  pure function bolt_force(self, thrust) result(force)
    class(linear_joint), intent(in) :: self
    real(dp), intent(in) :: thrust
    real(dp) :: force

    force = self%preload + thrust/(self%circumference()*self%foundation)/(self%bolt_compliance + self%sinking(0.0_dp))
  end function bolt_force

  !> Force per length of the gasket at the angle `angle` from a bolt.
  pure function pressure(self, thrust, angle)
    class(linear_joint), intent(in) :: self
    real(dp), intent(in) :: thrust, angle
    real(dp) :: pressure

    pressure = self%foundation*self%bolt_force(thrust)*self%sinking(angle) - thrust/self%circumference()
  end function pressure

  !> How far the nut of each bolt is turned down on the ring, which lies on the gasket, for the preload.
  pure function stretch(self)
    class(linear_joint), intent(in) :: self
    real(dp) :: stretch

    stretch = self%preload*(self%bolt_compliance + self%sinking(0.0_dp))
  end function stretch

  !> The thrust at which the gasket opens midway between the bolts.
  pure function opening_thrust(self) result(thrust)
    class(linear_joint), intent(in) :: self
    real(dp) :: thrust
    real(dp) :: middle

    middle = self%sinking(PI/real(self%bolts, dp))
    thrust = self%circumference()*self%foundation*self%preload*middle &
      /(1.0_dp - middle/(self%bolt_compliance + self%sinking(0.0_dp)))
  end function opening_thrust

  !> Deflection downwards at `angle` from a bolt by the force 1 at each bolt, on the foundation. To deflect a ring that
  !> twists freely by cos(m angle) takes the force per length m**2 (m**2 - 1)**2 EI GJ/(EI + m**2 GJ)/r**4 cos(m angle),
  !> the least energy of bending and torsion over all twists.
  pure function sinking(self, angle)
    class(linear_joint), intent(in) :: self
    real(dp), intent(in) :: angle
    real(dp) :: sinking
    real(dp) :: m
    integer :: j

    sinking = 0.5_dp/self%foundation
    if (.not. self%rigid) then
      do j = HARMONICS, 1, -1
        m = real(j*self%bolts, dp)
        sinking = sinking + cos(m*angle)/(self%foundation + (m*(m**2 - 1.0_dp))**2*self%ring%bending*self%ring%torsion &
          /(self%ring%bending + m**2*self%ring%torsion)/self%ring%radius**4)
      end do
    end if
    sinking = sinking*2.0_dp*real(self%bolts, dp)/self%circumference()
  end function sinking

  pure function circumference(self)
    class(linear_joint), intent(in) :: self
    real(dp) :: circumference

    circumference = 2.0_dp*PI*self%ring%radius
  end function circumference

  !> Force per length below an endless straight beam at `x` from one of the forces, which are `pitch` apart: the sum of
  !> the deflections by each of them (M. Hetenyi, Beams on Elastic Foundation, 1946), a geometric series.
  pure function beam_pressure(force, pitch, bending, foundation, x) result(pressure)
    real(dp), intent(in) :: force, pitch, bending, foundation, x
    real(dp) :: pressure
    complex(dp) :: root
    real(dp) :: lambda

    lambda = (foundation/(4.0_dp*bending))**0.25_dp
    root = cmplx(lambda, -lambda, dp)
    pressure = 0.5_dp*force*real(root*cosh(root*(0.5_dp*pitch - x))/sinh(0.5_dp*root*pitch), dp)
  end function beam_pressure

end module gasket_theory
