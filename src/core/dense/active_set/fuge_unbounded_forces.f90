!> Forces that would have to grow without bound: the contact problem has no solution then.
!>
!> Where alpha is singular, some forces store no energy. If they do work on the gaps too, no forces are large
!> enough (Farkas' lemma, for a convex quadratic program). An engine then returns such forces, as large as rounding lets
!> them become.
module fuge_unbounded_forces
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_OPEN
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
  !> Forces at their limits are bounded, and loads to the others: these are judged, beside the data, the limited forces
  !> and what those displace.
  !>
  !> `canonical` with its matrix; `solution` of its contact set.
  function forces_are_unbounded(canonical, solution) result(unbounded)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical :: unbounded
    real(dp), dimension(size(solution%force)) :: by_limited, displacement, force, length, limited_terms, magnitude
    real(dp) :: energy, largest
    logical, dimension(size(solution%force)) :: contact, limited
    integer :: j

    unbounded = .false.
    if (canonical%plain) return
    limited = abs(solution%state) > FUGE_AT_LOWER_STOP
    contact = solution%state /= FUGE_OPEN .and. .not. limited
    length = canonical%gap
    where (contact .and. solution%state < FUGE_OPEN) length = length - canonical%upper
    limited_terms = 0.0_dp
    by_limited = 0.0_dp
    if (any(limited)) then
      call add_elastic_displacement(canonical%alpha, canonical%datum, limited, solution%force, by_limited)
      limited_terms = displacement_magnitude(canonical%alpha, canonical%datum, limited, solution%force)
    end if
    unbounded = any(has_no_force(canonical, contact, length, by_limited, limited_terms, solution%motion))
    largest = maxval(abs(solution%force), mask=contact)
    if (unbounded .or. .not. largest > 0.0_dp) return
    if (any(limited)) then
      ! A force that is large within a limit of its own is bounded too.
      if (any(has_limit_ahead(canonical, solution%force, largest) .and. contact)) return
    end if
    force = merge(solution%force/largest, 0.0_dp, contact)
    do j = 1, size(canonical%load)
      if ((abs(canonical%load(j)) + sum(abs(canonical%modes(:, j)*solution%force), mask=limited))/largest &
          > DWARFED*sum(abs(canonical%modes(:, j)*force))) return
    end do
    magnitude = displacement_magnitude(canonical%alpha, canonical%datum, contact, force)
    energy = sum(magnitude*abs(force))
    length = length + by_limited
    if (canonical%has_translation) length = length - length(maxloc(abs(force), dim=1))
    if (sum(((abs(length) + limited_terms)/largest)*abs(force), mask=contact) > DWARFED*energy) return
    displacement = 0.0_dp
    call add_elastic_displacement(canonical%alpha, canonical%datum, contact, force, displacement)
    unbounded = abs(sum(displacement*force)) <= ROUNDINGS*epsilon(energy)*energy
  end function forces_are_unbounded

  !> Points (n) whose `force` (n) is of the size of the `largest` one and may only grow up to a limit.
  pure function has_limit_ahead(canonical, force, largest) result(ahead)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: force(:), largest
    logical :: ahead(size(force))

    ahead = merge(canonical%limit, canonical%limit_upper, force > 0.0_dp) < huge(largest)
    ahead = ahead .and. abs(force) > ALIKE*largest
  end function has_limit_ahead

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

  !> Points (n) of the contact that no contact force displaces, and that neither the motion (m) nor the forces at their
  !> limits bring to their stops: `length` (n) from them, displaced by `by_limited` (n), the sum of `limited_terms` (n).
  pure function has_no_force(canonical, contact, length, by_limited, limited_terms, motion)
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: length(:), by_limited(:), limited_terms(:), motion(:)
    logical :: has_no_force(size(length))
    real(dp) :: rest(size(length)), terms(size(length)), largest
    integer :: j

    rest = length + by_limited
    terms = abs(length) + limited_terms
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
