!> Forces that would have to grow without bound: the contact problem has no solution then.
!>
!> Where alpha is singular, some forces store no energy. If they do work on the gaps too, no forces are large
!> enough (Farkas' lemma, for a convex quadratic program). An engine then returns such forces, as large as rounding lets
!> them become.
module fuge_unbounded_forces
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_displacements, only: add_elastic_displacement, displacement_magnitude
  use fuge_kinds, only: dp
  implicit none
  private

  public :: equal_forces_hold_nothing, forces_are_unbounded

  !> An energy below this many units in the last place of its terms counts as zero.
  real(dp), parameter :: ROUNDINGS = 256.0_dp
  !> Forces dwarf the data if the terms of displacements exceed the gaps, and those of resultants the loads, by one over
  !> this factor.
  real(dp), parameter :: DWARFED = 1.0e-6_dp
  !> A length below this fraction of the largest gap, play or displacement by a load is rounding.
  real(dp), parameter :: NO_LENGTH = 1.0e-10_dp
  !> Unbounded forces that differ by less than this fraction count as equal: the rest is what the gaps require.
  real(dp), parameter :: ALIKE = 1.0e-3_dp

contains

  !> Do the forces of a solution store no energy, beside data that they dwarf?
  !>
  !> `canonical` with its matrix; `solution` of its contact set.
  pure function forces_are_unbounded(canonical, solution) result(unbounded)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical :: unbounded
    real(dp), dimension(size(solution%force)) :: force, displacement, length, magnitude
    real(dp) :: energy, largest
    integer :: j

    unbounded = .false.
    ! Forces at their limits are bounded; what they leave to others is judged by the certificate.
    if (canonical%plain .or. any(abs(solution%state) > 1)) return
    associate (contact => solution%state /= FUGE_OPEN)
      length = canonical%gap
      where (solution%state < FUGE_OPEN) length = length - canonical%upper
      unbounded = any(has_no_force(canonical, contact, length, solution%motion))
      largest = maxval(abs(solution%force))
      if (unbounded .or. .not. largest > 0.0_dp) return
      force = solution%force/largest
      do j = 1, size(canonical%load)
        if (abs(canonical%load(j))/largest > DWARFED*sum(abs(canonical%modes(:, j)*force))) return
      end do
      magnitude = displacement_magnitude(canonical%alpha, canonical%datum, contact, force)
      energy = sum(magnitude*abs(force))
      if (canonical%has_translation) length = length - length(maxloc(abs(force), dim=1))
      if (sum(abs((length/largest)*force), mask=contact) > DWARFED*energy) return
      displacement = 0.0_dp
      call add_elastic_displacement(canonical%alpha, canonical%datum, contact, force, displacement)
      unbounded = abs(sum(displacement*force)) <= ROUNDINGS*epsilon(energy)*energy
    end associate
  end function forces_are_unbounded

  !> Are the unbounded forces of a solution equal at all points, one-sided under prescribed motions? Then these close
  !> the mean gap, which no forces raise.
  pure function equal_forces_hold_nothing(canonical, solution) result(nothing)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical :: nothing

    nothing = canonical%mode_count() > 0 .and. size(canonical%load) < 1 .and. .not. any(canonical%excluded) &
              .and. all(canonical%upper >= huge(1.0_dp))
    if (nothing) nothing = minval(solution%force) >= (1.0_dp - ALIKE)*maxval(solution%force)
  end function equal_forces_hold_nothing

  !> Points (n) of the contact that no contact force displaces, and that the motion (m) does not bring to their stops:
  !> `length` (n) from them.
  pure function has_no_force(canonical, contact, length, motion)
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: length(:), motion(:)
    logical :: has_no_force(size(length))
    real(dp) :: rest(size(length)), terms(size(length)), largest
    integer :: j

    rest = length
    terms = abs(length)
    if (canonical%has_translation) then
      rest = rest + canonical%datum*canonical%load(1)
      terms = terms + abs(canonical%datum*canonical%load(1))
    end if
    do j = 1, size(motion)
      rest = rest - canonical%modes(:, j)*motion(j)
      terms = terms + abs(canonical%modes(:, j)*motion(j))
    end do
    largest = max(maxval(abs(canonical%gap), mask=.not. canonical%excluded), &
                  maxval(canonical%upper, mask=canonical%upper < huge(largest) .and. .not. canonical%excluded), &
                  (canonical%survey%most - canonical%survey%least)*canonical%largest_load())
    has_no_force = contact .and. abs(rest) > NO_LENGTH*largest + ROUNDINGS*epsilon(largest)*terms
    do j = 1, size(length)
      if (.not. contact(j)) cycle
      has_no_force = has_no_force .and. abs(canonical%alpha(:size(length), j) - canonical%datum) <= 0.0_dp
    end do
  end function has_no_force

end module fuge_unbounded_forces
