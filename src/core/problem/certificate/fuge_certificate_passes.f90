!> The passes of the certificate over the points, in chunks (fuge_point_chunks). What can be had from the data of a
!> point is not kept, because large arrays do not stay in the cache from one pass to the next.
module fuge_certificate_passes
  use fuge_data_scales, only: free_resultant
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass, CHUNK
  use fuge_point_law, only: point_law
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: add_rounding_of_bodies, find_arms, find_rigid_displacement, law, survey_displacements, survey_forces, &
    sum_open_lengths, sum_terms, upper_stop

  !> Points of which the lengths are computed at once, into arrays that stay in the cache.
  integer, parameter, public :: TILE = 128

  !> What the passes read, with arrays of (n): pointers to what belongs to the caller, whose arrays may begin with
  !> another number than 1. These begin with 1, so that no pass reads an array through the problem.
  type, extends(chunked_pass), public :: certificate_pass
    type(fuge_problem), pointer :: problem => null()
    !> Of the solution and of the problem, those of the problem but for the gap where it has them; `motion` is (m),
    !> `modes` are (n, m).
    real(dp), pointer, contiguous :: gap(:) => null(), force(:) => null(), gap_under_load(:) => null()
    real(dp), pointer, contiguous :: motion(:) => null(), modes(:, :) => null()
    real(dp), pointer, contiguous :: gap_upper(:) => null(), compliance(:) => null()
    real(dp), pointer, contiguous :: limit(:) => null(), limit_upper(:) => null()
    logical, pointer, contiguous :: excluded(:) => null()
    !> Of each mode, (m): the prescribed motion, 0 where it is free, if any is prescribed; the resultant, 0 where it is
    !> prescribed, where there are modes.
    real(dp), allocatable :: prescribed_motion(:), resultants(:)
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
    !> The sum of the forces of points that are not excluded, as fractions of the largest one, if it is wanted.
    real(dp) :: shares = 0.0_dp
    logical :: with_shares = .false.
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: point_to
    procedure :: do_chunk
    procedure :: go
    procedure :: included
    procedure :: find_lengths
    procedure :: find_magnitudes
    procedure :: find_reference
  end type certificate_pass

  !> Lengths of TILE points or less; not initialised, because most of them are overwritten at once.
  type, public :: tile_lengths
    !> Gap less R q and the displacement by the datum.
    real(dp) :: rigid_gap(TILE)
    !> Error of equation (9), and the magnitude with which it is compared.
    real(dp) :: error(TILE), magnitude(TILE)
    !> Size of the terms of displacements by forces, and by motions and the datum.
    real(dp) :: elastic(TILE), rigid_magnitude(TILE)
  end type tile_lengths

  abstract interface
    !> The points `first` .. `last` of a chunk. `found` is zero before.
    subroutine chunk_operation(pass, first, last, found)
      import :: certificate_pass, dp
      class(certificate_pass), intent(in) :: pass
      integer, intent(in) :: first, last
      real(dp), intent(inout), contiguous :: found(:)
    end subroutine chunk_operation
  end interface

contains

  !> Passes over `problem` and its `solution`, whose arrays are as long as each other.
  subroutine point_to(self, problem, solution)
    class(certificate_pass), intent(inout) :: self
    type(fuge_problem), intent(in), target :: problem
    type(fuge_solution), intent(in), target :: solution
    integer :: j, n

    n = size(problem%gap)
    self%problem => problem
    ! With both bounds: gfortran 12 copies the distance of the values else, which reshape has not always set.
    self%gap(1:n) => problem%gap
    self%force(1:n) => solution%force
    self%gap_under_load(1:n) => solution%gap
    self%motion(1:size(solution%motion)) => solution%motion
    if (allocated(problem%excluded)) self%excluded(1:n) => problem%excluded
    if (allocated(problem%gap_upper)) self%gap_upper(1:n) => problem%gap_upper
    if (allocated(problem%compliance)) self%compliance(1:n) => problem%compliance
    if (allocated(problem%limit)) self%limit(1:n) => problem%limit
    if (allocated(problem%limit_upper)) self%limit_upper(1:n) => problem%limit_upper
    if (allocated(problem%prescribed)) self%prescribed_motion = problem%prescribed_motion()
    if (.not. allocated(problem%modes)) return
    self%modes(1:n, 1:size(problem%modes, 2)) => problem%modes
    self%resultants = [(free_resultant(problem, j), j=1, size(self%modes, 2))]
  end subroutine point_to

  !> Do `operation` on all chunks. Of the numbers that it finds in each, `found` has the sums of the first ones, so many
  !> as `sums`, and the largest of the others. One chunk needs no memory.
  subroutine go(self, operation, sums, found)
    class(certificate_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: sums
    real(dp), intent(out), contiguous :: found(:)

    if (size(self%gap) <= CHUNK) then
      found = 0.0_dp
      call operation(self, 1, size(self%gap), found)
    else
      self%operation => operation
      call self%run(size(self%gap), size(found))
      call self%take(sums + 1, found(:sums), found(sums + 1:))
    end if
  end subroutine go

  !> Chunk `k`, the points `first` .. `last`.
  subroutine do_chunk(self, k, first, last)
    class(certificate_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    real(dp) :: found(size(self%found, 1))

    found = 0.0_dp
    call self%operation(self, first, last, found)
    self%found(:, k) = found
  end subroutine do_chunk

  !> Does point `k` take part in the contact?
  pure function included(self, k)
    class(certificate_pass), intent(in) :: self
    integer, intent(in) :: k
    logical :: included

    included = .true.
    if (associated(self%excluded)) included = .not. self%excluded(k)
  end function included

  !> The magnitudes and their terms of the points `first` .. `last`, at most TILE.
  pure subroutine find_magnitudes(self, first, last, at)
    class(certificate_pass), intent(in) :: self
    integer, intent(in) :: first, last
    type(tile_lengths), intent(inout) :: at
    integer :: n

    n = last - first + 1
    if (associated(self%terms)) then
      at%elastic(:n) = self%terms(first:last)
    else
      at%elastic(:n) = self%common_terms
    end if
    if (associated(self%compliance)) at%elastic(:n) = at%elastic(:n) &
                                                      + self%compliance(first:last)*abs(self%force(first:last))
    if (associated(self%rigid)) then
      at%rigid_gap(:n) = self%gap(first:last) - self%rigid(first:last)
      at%rigid_magnitude(:n) = self%rigid_magnitude(first:last)
    else
      at%rigid_gap(:n) = self%gap(first:last) - self%common_rigid
      at%rigid_magnitude(:n) = self%common_rigid_magnitude
    end if
    at%magnitude(:n) = abs(at%rigid_gap(:n)) + at%elastic(:n)
  end subroutine find_magnitudes

  !> All lengths of these points.
  pure subroutine find_lengths(self, first, last, at)
    class(certificate_pass), intent(in) :: self
    integer, intent(in) :: first, last
    type(tile_lengths), intent(inout) :: at
    integer :: n

    call find_magnitudes(self, first, last, at)
    n = last - first + 1
    if (associated(self%error)) then
      at%error(:n) = self%error(first:last)
    else
      at%error(:n) = at%rigid_gap(:n) + self%displacement(first:last) - self%gap_under_load(first:last)
    end if
  end subroutine find_lengths

  !> Found: the sum of the forces and that of their magnitudes; 1 if a force is not finite, in place of the rest, the
  !> largest magnitude, that of the points that are not excluded, and 1 if there are such points.
  subroutine survey_forces(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    real(dp) :: any_included, force, largest, most_included, total, total_magnitude
    integer :: i

    if (.not. is_finite_everywhere(pass%force(first:last))) then
      found(3) = 1.0_dp
      return
    end if
    total = 0.0_dp
    total_magnitude = 0.0_dp
    largest = 0.0_dp
    do i = first, last
      force = abs(pass%force(i))
      total = total + pass%force(i)
      total_magnitude = total_magnitude + force
      largest = max(largest, force)
    end do
    any_included = merge(1.0_dp, 0.0_dp, last >= first)
    most_included = largest
    if (associated(pass%excluded)) then
      any_included = 0.0_dp
      most_included = 0.0_dp
      do i = first, last
        if (pass%excluded(i)) cycle
        any_included = 1.0_dp
        most_included = max(most_included, abs(pass%force(i)))
      end do
    end if
    found(:6) = [total, total_magnitude, 0.0_dp, largest, most_included, any_included]
  end subroutine survey_forces

  !> Add the displacements by compliances. Found: the largest magnitude of a displacement without them, and with them.
  subroutine survey_displacements(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)

    if (last < first) return
    found(1) = maxval(abs(pass%displacement(first:last)))
    found(2) = found(1)
    if (.not. associated(pass%compliance)) return
    pass%displacement(first:last) = pass%displacement(first:last) &
                                    + pass%compliance(first:last)*pass%force(first:last)
    found(2) = maxval(abs(pass%displacement(first:last)))
  end subroutine survey_displacements

  !> `rigid` and the terms of it in `rigid_magnitude`, where there are m modes. Found, (2 m): for each mode the largest
  !> size of a gap and these terms at the points that it moves, and the largest force at them.
  subroutine find_rigid_displacement(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    real(dp) :: force, length
    integer :: i, j

    associate (modes => pass%modes, motion => pass%motion)
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
          if (abs(pass%force(i)) > force) force = abs(pass%force(i))
          if (abs(pass%gap(i)) + pass%rigid_magnitude(i) > length) then
            if (included(pass, i)) length = abs(pass%gap(i)) + pass%rigid_magnitude(i)
          end if
        end do
        found(j) = length
        found(size(motion) + j) = force
      end do
    end associate
  end subroutine find_rigid_displacement

  !> Motions are solved for together: each one that moves a point is rounded like the largest length of the body, of
  !> `by_mode`. Finds nothing.
  subroutine add_rounding_of_bodies(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    real(dp) :: largest
    integer :: i, j, moving

    found = 0.0_dp
    associate (modes => pass%modes)
      do i = first, last
        largest = 0.0_dp
        moving = 0
        do j = 1, size(modes, 2)
          if (.not. abs(modes(i, j)) > 0.0_dp) cycle
          moving = moving + 1
          if (pass%by_mode(j) > largest) largest = pass%by_mode(j)
        end do
        pass%rigid_magnitude(i) = pass%rigid_magnitude(i) + moving*largest
      end do
    end associate
  end subroutine add_rounding_of_bodies

  !> The `work` of the forces on the displacements in the units of which `inverse_unit` has the inverse; `shares`, the
  !> sum of the forces of points that are not excluded, as fractions of the largest one, if they are wanted; the number
  !> of the contact point with the least magnitude, or with the least gap where there are no forces, 0 if there is none.
  subroutine find_reference(self, work, shares, reference)
    class(certificate_pass), intent(inout) :: self
    real(dp), intent(out) :: work, shares
    integer, intent(out) :: reference
    real(dp) :: found(4), key
    integer :: k

    call self%go(survey_references, 2, found)
    work = found(1)
    shares = found(2)
    reference = int(found(4))
    if (size(self%gap) <= CHUNK) return
    reference = 0
    key = 0.0_dp
    do k = 1, size(self%found, 2)
      if (.not. self%found(4, k) > 0.0_dp) cycle
      if (.not. comes_before(self%found(3, k), key, reference)) cycle
      key = self%found(3, k)
      reference = int(self%found(4, k))
    end do
  end subroutine find_reference

  !> Found: the work of the forces on the displacements in the units of which `inverse_unit` has the inverse; the sum of
  !> the forces of points that are not excluded, as fractions of the largest one; the least magnitude of a contact
  !> point, or the least gap where there are no forces, and the number of that point, 0 if there is none.
  subroutine survey_references(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    type(tile_lengths) :: at
    real(dp) :: contact_force, force, inverse(2), key, shares, work
    integer :: i, reference, start
    logical :: excludes, has_forces

    work = 0.0_dp
    shares = 0.0_dp
    key = 0.0_dp
    reference = 0
    excludes = associated(pass%excluded)
    inverse = pass%inverse_unit
    has_forces = pass%largest_force > 0.0_dp
    ! A force of rounding size is no contact.
    contact_force = -1.0_dp
    if (has_forces) contact_force = sqrt(epsilon(force))*pass%largest_force
    do start = first, last, TILE
      if (has_forces) then
        call find_magnitudes(pass, start, min(start + TILE - 1, last), at)
      else
        call find_gaps(pass, start, min(start + TILE - 1, last), at)
      end if
      do i = start, min(start + TILE - 1, last)
        force = abs(pass%force(i))
        if (force > 0.0_dp) work = work + (pass%force(i)*inverse(1))*(pass%displacement(i)*inverse(2))
        if (.not. force > contact_force .and. .not. pass%with_shares) cycle
        if (excludes) then
          if (.not. included(pass, i)) cycle
        end if
        if (pass%with_shares) shares = shares + force/pass%largest_included
        if (.not. force > contact_force) cycle
        if (.not. comes_before(at%magnitude(i - start + 1), key, reference)) cycle
        key = at%magnitude(i - start + 1)
        reference = i
      end do
    end do
    found(:4) = [work, shares, key, real(reference, dp)]
  end subroutine survey_references

  !> Gaps in place of magnitudes.
  pure subroutine find_gaps(pass, first, last, at)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    type(tile_lengths), intent(inout) :: at

    at%magnitude(:last - first + 1) = pass%gap(first:last)
  end subroutine find_gaps

  !> Is `value` less than the `key` of the point `reference`, or is there no such point? Numbers are less than NaN.
  pure function comes_before(value, key, reference)
    real(dp), intent(in) :: value, key
    integer, intent(in) :: reference
    logical :: comes_before

    comes_before = reference == 0 .or. value < key .or. .not. key <= huge(key)
  end function comes_before

  !> The upper stop of point `k`; huge without one.
  pure function upper_stop(pass, k) result(upper)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(dp) :: upper

    upper = huge(upper)
    if (associated(pass%gap_upper)) upper = min(pass%gap_upper(k), upper)
  end function upper_stop

  !> The law of point `k`, which is not excluded, huge where infinite.
  pure function law(pass, k)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    type(point_law) :: law

    law%play = upper_stop(pass, k)
    if (associated(pass%limit)) law%limit = min(pass%limit(k), huge(law%limit))
    if (associated(pass%limit_upper)) law%limit_upper = min(pass%limit_upper(k), huge(law%limit_upper))
  end function law

  !> Found, of the points that are not excluded and have forces above `least_force`: the sum of the terms of
  !> displacements, each with its share of the forces; the largest of the magnitude of a gap less prescribed motions, of
  !> that gap, of minus that gap and of the terms; the largest play. -huge where there are none.
  subroutine sum_terms(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    type(tile_lengths) :: at
    real(dp) :: elastic, extremes(3), gap, terms, upper
    integer :: i, start
    logical :: excludes, prescribes, with_stops

    excludes = associated(pass%excluded)
    prescribes = allocated(pass%prescribed_motion)
    with_stops = associated(pass%gap_upper)
    extremes = -huge(extremes)
    upper = -huge(upper)
    terms = 0.0_dp
    do start = first, last, TILE
      call find_magnitudes(pass, start, min(start + TILE - 1, last), at)
      do i = start, min(start + TILE - 1, last)
        if (.not. abs(pass%force(i)) > pass%least_force) cycle
        if (excludes) then
          if (.not. included(pass, i)) cycle
        end if
        elastic = at%elastic(i - start + 1)
        gap = pass%gap(i)
        if (prescribes) gap = gap_less_motions(pass, i)
        if (gap > extremes(1)) extremes(1) = gap
        if (-gap > extremes(2)) extremes(2) = -gap
        if (elastic > extremes(3)) extremes(3) = elastic
        if (with_stops) then
          if (upper_stop(pass, i) < huge(upper)) upper = max(upper, upper_stop(pass, i))
        end if
        terms = terms + abs(pass%force(i))/pass%largest_included/pass%shares*elastic
      end do
    end do
    found(:6) = [terms, max(extremes(1), extremes(2)), extremes, upper]
  end subroutine sum_terms

  !> The gap of point `k` less the displacements by the prescribed motions.
  pure function gap_less_motions(pass, k) result(gap)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(dp) :: gap
    integer :: j

    gap = pass%gap(k)
    if (associated(pass%modes)) then
      do j = 1, size(pass%prescribed_motion)
        gap = gap - pass%modes(k, j)*pass%prescribed_motion(j)
      end do
    else
      gap = gap - pass%prescribed_motion(1)
    end if
  end function gap_less_motions

  !> Found, (m): the largest displacement of these points by a unit of each motion; -huge where there are none.
  subroutine find_arms(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    real(dp) :: arm
    integer :: i, j

    do j = 1, size(found)
      arm = -huge(arm)
      do i = first, last
        if (.not. abs(pass%force(i)) > pass%least_force) cycle
        if (.not. abs(pass%modes(i, j)) > arm) cycle
        if (included(pass, i)) arm = abs(pass%modes(i, j))
      end do
      found(j) = arm
    end do
  end subroutine find_arms

  !> Found: the lengths that forces leave open, or that are their rounding, each with its share of the forces.
  subroutine sum_open_lengths(pass, first, last, found)
    class(certificate_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: found(:)
    type(tile_lengths) :: at
    type(point_law) :: law_here
    real(dp) :: excess, open
    integer :: i, j, start

    open = 0.0_dp
    do start = first, last, TILE
      call find_lengths(pass, start, min(start + TILE - 1, last), at)
      do i = start, min(start + TILE - 1, last)
        if (.not. included(pass, i)) cycle
        j = i - start + 1
        law_here = law(pass, i)
        ! Elsewhere the terms of a displacement excuse rounding; here only those of R q and the datum do.
        excess = max(abs(at%error(j)) - 2.0_dp*epsilon(excess)*(abs(pass%gap(i)) + at%rigid_magnitude(j)), &
                     epsilon(excess)*at%elastic(j), law_here%stop_distance(pass%force(i), pass%gap_under_load(i)))
        open = open + abs(pass%force(i))/pass%largest_included/pass%shares*excess
      end do
    end do
    found(1) = open
  end subroutine sum_open_lengths

end module fuge_certificate_passes
