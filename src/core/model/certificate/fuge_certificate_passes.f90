!> The passes of the certificate over the points, in chunks (fuge_point_chunks). What can be had from the data of a
!> point is not kept, because large arrays do not stay in the cache from one pass to the next.
module fuge_certificate_passes
  use fuge_data_scales, only: gap_less_motions, is_loaded, largest_of_body
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_load_balance, only: ROUNDINGS
  use fuge_point_chunks, only: chunked_pass
  use fuge_point_law, only: point_law
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_relative_size, only: relative
  implicit none
  private

  public :: add_rounding_of_bodies, find_arms, find_reference, find_rigid_displacement, judge_points, &
    survey_displacements, survey_forces, sum_open_lengths, sum_terms

  !> Numbers that a pass finds in each chunk, used or not, so that all passes share one array.
  integer, parameter :: RESULTS = 6

  !> What the passes read, with arrays of (n): pointers to what belongs to the caller.
  type, extends(chunked_pass), public :: certificate_pass
    type(fuge_problem), pointer :: problem => null()
    type(fuge_solution), pointer :: solution => null()
    real(dp), pointer, contiguous :: gap(:) => null(), force(:) => null(), gap_under_load(:) => null()
    !> A f less the datum; after `survey_displacements` with the compliances.
    real(dp), pointer, contiguous :: displacement(:) => null()
    !> The terms of A f, where they differ from point to point, else `common_terms`.
    real(dp), pointer, contiguous :: terms(:) => null()
    !> R q less the displacement by the datum, and the magnitude of its terms, where there are modes, else
    !> `common_rigid` and `common_rigid_magnitude`; these are the parts without modes.
    real(dp), pointer, contiguous :: rigid(:) => null(), rigid_magnitude(:) => null()
    !> The error of equation (9) where it is not what the displacements give.
    real(dp), pointer, contiguous :: error(:) => null()
    real(dp) :: common_terms = 0.0_dp, common_rigid = 0.0_dp, common_rigid_magnitude = 0.0_dp
    !> The largest force, and that of the points that are not excluded.
    real(dp) :: largest_force = 0.0_dp, largest_included = 0.0_dp
    logical :: is_any_included = .false.
    !> What `find_rigid_displacement` has found, (2 m): the largest length at the points that each of the m modes moves,
    !> and the largest force at them.
    real(dp), allocatable :: by_mode(:)
    !> One over the units of force and length in which works are summed.
    real(dp) :: inverse_unit(2) = 1.0_dp
    !> The error that all points share, the magnitude and the gap of the reference point.
    real(dp) :: shared_error = 0.0_dp, reference_magnitude = 0.0_dp, reference_gap = 0.0_dp
    !> Only points with larger forces count where lengths of the data are sought.
    real(dp) :: least_force = -1.0_dp
    !> The sum of the forces as fractions of the largest one.
    real(dp) :: shares = 0.0_dp
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: point_to
    procedure :: do_chunk
    procedure :: go
    procedure :: included
    procedure :: lengths_at
    procedure :: reference
  end type certificate_pass

  !> Lengths of a point.
  type, public :: point_lengths
    !> Error of equation (9), and the magnitude with which it is compared.
    real(dp) :: error = 0.0_dp, magnitude = 0.0_dp
    !> Size of the terms of its displacement by forces, and by motions and the datum.
    real(dp) :: elastic = 0.0_dp, rigid_magnitude = 0.0_dp
  end type point_lengths

  abstract interface
    !> Chunk `k`, the points `first` .. `last`.
    subroutine chunk_operation(pass, k, first, last)
      import :: certificate_pass
      class(certificate_pass), intent(inout) :: pass
      integer, intent(in) :: k, first, last
    end subroutine chunk_operation
  end interface

contains

  !> Passes over `problem` and its `solution`, whose arrays are as long as each other.
  subroutine point_to(self, problem, solution)
    class(certificate_pass), intent(inout) :: self
    type(fuge_problem), intent(in), target :: problem
    type(fuge_solution), intent(in), target :: solution

    self%problem => problem
    self%solution => solution
    self%gap => problem%gap
    self%force => solution%force
    self%gap_under_load => solution%gap
  end subroutine point_to

  !> Do `operation` on all chunks; it finds RESULTS numbers in each, or `numbers`.
  subroutine go(self, operation, numbers)
    class(certificate_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in), optional :: numbers

    self%operation => operation
    if (present(numbers)) then
      call self%run(size(self%gap), numbers)
    else
      call self%run(size(self%gap), RESULTS)
    end if
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(certificate_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call self%operation(self, k, first, last)
  end subroutine do_chunk

  !> Does point `k` take part in the contact?
  pure function included(self, k)
    class(certificate_pass), intent(in) :: self
    integer, intent(in) :: k
    logical :: included

    included = .true.
    if (allocated(self%problem%excluded)) included = .not. self%problem%excluded(k)
  end function included

  !> The lengths of point `k`.
  pure function lengths_at(self, k) result(lengths)
    class(certificate_pass), intent(in) :: self
    integer, intent(in) :: k
    type(point_lengths) :: lengths
    real(dp) :: rigid_gap

    if (associated(self%terms)) then
      lengths%elastic = self%terms(k)
    else
      lengths%elastic = self%common_terms
    end if
    if (allocated(self%problem%compliance)) lengths%elastic = lengths%elastic &
      + self%problem%compliance(k)*abs(self%force(k))
    if (associated(self%rigid)) then
      rigid_gap = self%gap(k) - self%rigid(k)
      lengths%rigid_magnitude = self%rigid_magnitude(k)
    else
      rigid_gap = self%gap(k) - self%common_rigid
      lengths%rigid_magnitude = self%common_rigid_magnitude
    end if
    lengths%magnitude = abs(rigid_gap) + lengths%elastic
    if (associated(self%error)) then
      lengths%error = self%error(k)
    else
      lengths%error = rigid_gap + self%displacement(k) - self%gap_under_load(k)
    end if
  end function lengths_at

  !> Found: 1 if a force is not finite, in place of the rest; the sum of the forces, that of their magnitudes, the
  !> largest magnitude, that of the points that are not excluded, and 1 if there are such points.
  subroutine survey_forces(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: found(6), size_of_force
    integer :: i

    found = 0.0_dp
    if (is_finite_everywhere(pass%force(first:last))) then
      if (allocated(pass%problem%excluded)) then
        do i = first, last
          if (pass%problem%excluded(i)) cycle
          found(5) = max(found(5), abs(pass%force(i)))
          found(6) = 1.0_dp
        end do
      end if
      do i = first, last
        size_of_force = abs(pass%force(i))
        found(2) = found(2) + pass%force(i)
        found(3) = found(3) + size_of_force
        found(4) = max(found(4), size_of_force)
      end do
      if (.not. allocated(pass%problem%excluded)) then
        found(5) = found(4)
        if (last >= first) found(6) = 1.0_dp
      end if
    else
      found(1) = 1.0_dp
    end if
    pass%found(:, k) = found
  end subroutine survey_forces

  !> Add the displacements by compliances. Found: the largest magnitude of a displacement without them, and with them.
  subroutine survey_displacements(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (last < first) return
    pass%found(1, k) = maxval(abs(pass%displacement(first:last)))
    pass%found(2, k) = pass%found(1, k)
    if (.not. allocated(pass%problem%compliance)) return
    pass%displacement(first:last) = pass%displacement(first:last) &
                                    + pass%problem%compliance(first:last)*pass%force(first:last)
    pass%found(2, k) = maxval(abs(pass%displacement(first:last)))
  end subroutine survey_displacements

  !> `rigid` and the terms of it in `rigid_magnitude`, where there are m modes. Found, (2 m): for each mode the largest
  !> size of a gap and these terms at the points that it moves, and the largest force at them.
  subroutine find_rigid_displacement(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: force, length
    integer :: i, j

    associate (modes => pass%problem%modes, motion => pass%solution%motion)
      pass%rigid(first:last) = pass%common_rigid
      pass%rigid_magnitude(first:last) = pass%common_rigid_magnitude
      do j = 1, size(motion)
        pass%rigid(first:last) = pass%rigid(first:last) + modes(first:last, j)*motion(j)
        pass%rigid_magnitude(first:last) = pass%rigid_magnitude(first:last) + abs(modes(first:last, j)*motion(j))
      end do
      do j = 1, size(motion)
        force = 0.0_dp
        length = 0.0_dp
        do i = first, last
          if (.not. abs(modes(i, j)) > 0.0_dp) cycle
          force = max(force, abs(pass%force(i)))
          if (included(pass, i)) length = max(length, abs(pass%gap(i)) + pass%rigid_magnitude(i))
        end do
        pass%found(j, k) = length
        pass%found(size(motion) + j, k) = force
      end do
    end associate
  end subroutine find_rigid_displacement

  !> Motions are solved for together: each one that moves a point is rounded like the largest length of the body, of
  !> `by_mode`.
  subroutine add_rounding_of_bodies(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: i

    if (k < 1) return
    associate (modes => pass%problem%modes)
      do i = first, last
        pass%rigid_magnitude(i) = pass%rigid_magnitude(i) + max(count(abs(modes(i, :)) > 0.0_dp), 1) &
                                  *largest_of_body(modes, pass%by_mode(:size(modes, 2)), i)
      end do
    end associate
  end subroutine add_rounding_of_bodies

  !> Found: the work of the forces on the displacements in the units of which `inverse_unit` has the inverse; the least
  !> magnitude of a contact point, or the least gap where there are no forces, and the number of that point, 0 if there
  !> is none; the sum of the forces of points that are not excluded, as fractions of the largest one.
  subroutine find_reference(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    type(point_lengths) :: at
    real(dp) :: contact_force, force, key, shares, value, work
    integer :: i, reference

    work = 0.0_dp
    shares = 0.0_dp
    key = 0.0_dp
    reference = 0
    ! A force of rounding size is no contact.
    contact_force = sqrt(epsilon(force))*pass%largest_force
    do i = first, last
      force = abs(pass%force(i))
      if (force > 0.0_dp) then
        work = work + (pass%force(i)*pass%inverse_unit(1))*(pass%displacement(i)*pass%inverse_unit(2))
        if (force > contact_force) then
          if (included(pass, i)) then
            at = lengths_at(pass, i)
            if (comes_before(at%magnitude, key, reference)) then
              key = at%magnitude
              reference = i
            end if
          end if
        end if
        if (pass%largest_included > 0.0_dp) then
          if (included(pass, i)) shares = shares + force/pass%largest_included
        end if
      else if (.not. pass%largest_force > 0.0_dp) then
        value = pass%gap(i)
        if (included(pass, i)) then
          if (comes_before(value, key, reference)) then
            key = value
            reference = i
          end if
        end if
      end if
    end do
    pass%found(:4, k) = [work, key, real(reference, dp), shares]
  end subroutine find_reference

  !> Is `value` less than the `key` of the point `reference`, or is there no such point? Numbers are less than NaN.
  pure function comes_before(value, key, reference)
    real(dp), intent(in) :: value, key
    integer, intent(in) :: reference
    logical :: comes_before

    comes_before = reference == 0 .or. value < key .or. .not. key <= huge(key)
  end function comes_before

  !> The point that `find_reference` has found; 0 if there is none.
  pure function reference(self)
    class(certificate_pass), intent(in) :: self
    integer :: reference
    real(dp) :: key
    integer :: k

    reference = 0
    key = 0.0_dp
    do k = 1, size(self%found, 2)
      if (.not. self%found(3, k) > 0.0_dp) cycle
      if (.not. comes_before(self%found(2, k), key, reference)) cycle
      key = self%found(2, k)
      reference = int(self%found(3, k))
    end do
  end function reference

  !> Found: the largest violations of equation (9), of signs and of complementarity.
  subroutine judge_points(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    type(point_lengths) :: at
    real(dp) :: body_force, rounding, violations(3)
    logical :: limited
    integer :: i

    violations = 0.0_dp
    limited = pass%problem%has_limits()
    rounding = 0.0_dp
    body_force = pass%largest_force
    do i = first, last
      at = lengths_at(pass, i)
      call judge_gap(pass, pass%gap(i), at, violations(1))
      if (.not. included(pass, i)) then
        call raise_to(violations(2), abs(pass%force(i)), pass%largest_force)
        cycle
      end if
      if (allocated(pass%by_mode)) call find_force_of_body(pass, i, body_force, rounding)
      if (limited) then
        call judge_law(pass%problem%law(i), pass%force(i), pass%gap_under_load(i), body_force, at%magnitude, rounding, &
                       violations(2:3))
      else
        call judge_stops(pass%force(i), pass%gap_under_load(i), upper_stop(pass, i), body_force, at%magnitude, &
                         rounding, violations(2:3))
      end if
    end do
    pass%found(:3, k) = violations
  end subroutine judge_points

  !> The upper stop of point `k`; huge without one.
  pure function upper_stop(pass, k) result(upper)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(dp) :: upper

    upper = huge(upper)
    if (allocated(pass%problem%gap_upper)) upper = min(pass%problem%gap_upper(k), upper)
  end function upper_stop

  !> Raise `violation` to that of equation (9) at a point with the initial `gap`.
  pure subroutine judge_gap(pass, gap, at, violation)
    class(certificate_pass), intent(in) :: pass
    real(dp), intent(in) :: gap
    type(point_lengths), intent(in) :: at
    real(dp), intent(inout) :: violation
    real(dp) :: excess, rounding

    ! max may ignore a NaN, which must not pass for small.
    if (.not. abs(at%error) <= huge(violation)) violation = huge(violation)
    ! Half a unit in the last place each, of the gaps and of the motions, and as much for their sum.
    rounding = abs(gap) + abs(pass%reference_gap) + at%rigid_magnitude
    excess = max(abs(at%error - pass%shared_error) - 2.0_dp*epsilon(excess)*rounding, 0.0_dp)
    call raise_to(violation, excess, at%magnitude + pass%reference_magnitude)
  end subroutine judge_gap

  !> The largest force of the body of point `k`, and what of the forces there may be `rounding`.
  pure subroutine find_force_of_body(pass, k, body_force, rounding)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(dp), intent(out) :: body_force, rounding

    body_force = largest_of_body(pass%problem%modes, pass%by_mode(size(pass%problem%modes, 2) + 1:), k)
    if (.not. body_force > 0.0_dp) body_force = pass%largest_force
    ! Beside the largest force, smaller ones of other bodies may be rounding, but for those that carry a load.
    rounding = 0.0_dp
    if (body_force < pass%largest_force) then
      if (.not. is_loaded(pass%problem, k)) rounding = ROUNDINGS*epsilon(rounding)*pass%largest_force
    end if
  end subroutine find_force_of_body

  !> Raise `violations`, of signs and of complementarity, to those of equation (10) at both stops. Forces are compared
  !> with `force_scale`, lengths with `length_scale`.
  pure subroutine judge_stops(force, gap, upper, force_scale, length_scale, rounding, violations)
    real(dp), intent(in) :: force, gap, upper, force_scale, length_scale, rounding
    real(dp), intent(inout) :: violations(2)
    real(dp) :: stop_distance

    call raise_to(violations(1), -gap, length_scale)
    if (upper < huge(upper)) then
      call raise_to(violations(1), gap - upper, length_scale)
    else
      call raise_to(violations(1), max(-force - rounding, 0.0_dp), force_scale)
    end if
    stop_distance = gap
    if (force < 0.0_dp .and. upper < huge(upper)) stop_distance = gap - upper
    if (abs(force) <= rounding) return
    if (may_exceed(violations(2), abs(stop_distance), length_scale)) then
      violations(2) = max(violations(2), min(relative(abs(force) - rounding, force_scale), &
                                             relative(abs(stop_distance), length_scale)))
    end if
  end subroutine judge_stops

  !> As `judge_stops`, for a point with limits of its forces. `noise` as in `point_law`.
  pure subroutine judge_law(law, force, gap, force_scale, length_scale, noise, violations)
    type(point_law), intent(in) :: law
    real(dp), intent(in) :: force, gap, force_scale, length_scale, noise
    real(dp), intent(inout) :: violations(2)

    violations(1) = max(violations(1), relative(max(force - law%most_force() - noise, &
                                                    law%least_force() - force - noise, 0.0_dp), force_scale))
    violations(2) = max(violations(2), law%distance(force, gap, force_scale, length_scale, noise))
  end subroutine judge_law

  !> Raise `violation` to `value` relative to `measure`. Few values do, and only they are divided.
  pure subroutine raise_to(violation, value, measure)
    real(dp), intent(inout) :: violation
    real(dp), intent(in) :: value, measure

    if (may_exceed(violation, value, measure)) violation = max(violation, relative(value, measure))
  end subroutine raise_to

  !> May `value` relative to `measure` exceed `violation`?
  pure function may_exceed(violation, value, measure)
    real(dp), intent(in) :: violation, value, measure
    logical :: may_exceed

    may_exceed = .true.
    ! The product must not overflow; a NaN may exceed anything.
    if (violation < 1.0_dp) may_exceed = .not. value <= violation*measure
  end function may_exceed

  !> Found, of the points that are not excluded and have forces above `least_force`: the sum of the terms of
  !> displacements, each with its share of the forces; the largest of the magnitude of a gap less prescribed motions, of
  !> that gap, of minus that gap and of the terms; the largest play. -huge where there are none.
  subroutine sum_terms(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    type(point_lengths) :: at
    real(dp) :: extremes(4), gap, terms, upper
    integer :: i

    extremes = -huge(extremes)
    upper = -huge(upper)
    terms = 0.0_dp
    do i = first, last
      if (.not. abs(pass%force(i)) > pass%least_force) cycle
      if (.not. included(pass, i)) cycle
      at = lengths_at(pass, i)
      gap = gap_less_motions(pass%problem, i)
      extremes = max(extremes, [abs(gap), gap, -gap, at%elastic])
      if (upper_stop(pass, i) < huge(upper)) upper = max(upper, upper_stop(pass, i))
      terms = terms + abs(pass%force(i))/pass%largest_included/pass%shares*at%elastic
    end do
    pass%found(:, k) = [terms, extremes, upper]
  end subroutine sum_terms

  !> Found, (m): the largest displacement of these points by a unit of each motion; -huge where there are none.
  subroutine find_arms(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: arm
    integer :: i, j

    do j = 1, size(pass%found, 1)
      arm = -huge(arm)
      do i = first, last
        if (.not. abs(pass%force(i)) > pass%least_force) cycle
        if (included(pass, i)) arm = max(arm, abs(pass%problem%modes(i, j)))
      end do
      pass%found(j, k) = arm
    end do
  end subroutine find_arms

  !> Found: the lengths that forces leave open, or that are their rounding, each with its share of the forces.
  subroutine sum_open_lengths(pass, k, first, last)
    class(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    type(point_lengths) :: at
    type(point_law) :: law
    real(dp) :: excess, open
    integer :: i

    open = 0.0_dp
    do i = first, last
      if (.not. included(pass, i)) cycle
      at = lengths_at(pass, i)
      law = pass%problem%law(i)
      ! Elsewhere the terms of a displacement excuse rounding; here only those of R q and the datum do.
      excess = max(abs(at%error) - 2.0_dp*epsilon(excess)*(abs(pass%gap(i)) + at%rigid_magnitude), &
                   epsilon(excess)*at%elastic, law%stop_distance(pass%force(i), pass%gap_under_load(i)))
      open = open + abs(pass%force(i))/pass%largest_included/pass%shares*excess
    end do
    pass%found(1, k) = open
  end subroutine sum_open_lengths

end module fuge_certificate_passes
