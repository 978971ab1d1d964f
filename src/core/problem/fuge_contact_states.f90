!> The state of a contact point between its two stops.
!>
!> A point is at its lower stop where the gap is zero and the force pushes, at its upper stop
!> where the gap has reached the play and the force pulls, and open in between, without force.
!> A one-sided point has no upper stop. A tied point (play zero) counts as at its lower stop. Where the force of a stop
!> has a limit and has reached it, the point gives way: its gap is free beyond the stop.
!>
!> The values have the signs of the forces: the engines multiply by them, so that force*state < 0 is tension at either
!> stop.
module fuge_contact_states
  implicit none
  private

  public :: is_at_stop

  !> State of a contact point: the gap is zero, the force is not negative (either sign if tied).
  integer, parameter, public :: FUGE_AT_LOWER_STOP = 1
  !> State of a contact point: the gap lies between the stops, or beyond one that takes no force; the force is
  !> zero.
  integer, parameter, public :: FUGE_OPEN = 0
  !> State of a contact point: the gap equals the play, the force is not positive.
  integer, parameter, public :: FUGE_AT_UPPER_STOP = -1
  !> State of a contact point: the force of the lower stop is at its limit, the gap is not positive.
  integer, parameter, public :: FUGE_LIMITED_LOWER = 2
  !> State of a contact point: the force of the upper stop is at its limit, the gap is at least the play.
  integer, parameter, public :: FUGE_LIMITED_UPPER = -2

contains

  !> Is the gap given by a stop, and the force unknown?
  elemental function is_at_stop(state)
    integer, intent(in) :: state
    logical :: is_at_stop

    is_at_stop = abs(state) == 1
  end function is_at_stop

end module fuge_contact_states
