!> What the contacts of smooth and of round punches have in common.
module fuge_punch_contact_type
  use fuge_kinds, only: dp
  implicit none
  private

  !> The contact of a punch without a grid: its pressures and gaps in closed form. Places are coordinates x along a
  !> half-plane, or distances r from the axis on a half-space; length.
  type, abstract, public :: punch_contact
    !> How far the bodies approach each other; length.
    real(dp) :: approach = 0.0_dp
    !> The modulus E*; force per length squared.
    real(dp) :: e_star = 0.0_dp
    !> Estimated error of the pressure, no unit; each extension says relative to what.
    real(dp) :: pressure_error = 0.0_dp
  contains
    procedure, private :: pressure_at
    procedure(pressures_of_contact), deferred :: pressures_at
    !> Contact pressure at any place, one or several; force per length squared.
    generic :: pressure => pressure_at, pressures_at
    procedure, private :: gap_at
    procedure(gaps_of_contact), deferred :: gaps_at
    !> Gap under load at any place, one or several, from the initial gap there; length. 0 in the
    !> contact, elsewhere exact to the rounding of the initial gap.
    generic :: gap => gap_at, gaps_at
  end type punch_contact

  abstract interface
    !> Pressures at several `places`, length; (size(places)), force per length squared, 0 outside of the contact.
    pure function pressures_of_contact(self, places) result(pressure)
      import :: punch_contact, dp
      class(punch_contact), intent(in) :: self
      real(dp), intent(in) :: places(:)
      real(dp) :: pressure(size(places))
    end function pressures_of_contact

    !> Gaps at several `places`, length, where the initial gaps are `initial_gap` (size(places)), length.
    pure function gaps_of_contact(self, places, initial_gap) result(gap)
      import :: punch_contact, dp
      class(punch_contact), intent(in) :: self
      real(dp), intent(in) :: places(:), initial_gap(:)
      real(dp) :: gap(size(places))
    end function gaps_of_contact
  end interface

contains

  !> Pressure at one `place`, length; force per length squared, 0 outside of the contact.
  pure function pressure_at(self, place) result(pressure)
    class(punch_contact), intent(in) :: self
    real(dp), intent(in) :: place
    real(dp) :: pressure
    real(dp) :: one(1)

    one = self%pressures_at([place])
    pressure = one(1)
  end function pressure_at

  !> Gap at one `place`, length, where the initial gap is `initial_gap`, length.
  pure function gap_at(self, place, initial_gap) result(gap)
    class(punch_contact), intent(in) :: self
    real(dp), intent(in) :: place, initial_gap
    real(dp) :: gap
    real(dp) :: one(1)

    one = self%gaps_at([place], [initial_gap])
    gap = one(1)
  end function gap_at

end module fuge_punch_contact_type
