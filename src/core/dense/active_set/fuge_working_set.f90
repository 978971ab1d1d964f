!> The equations of a working set: solved, refined, and measured against the contact conditions.
!>
!> Block principal pivoting and the primal active-set method try one set after the other, and share these operations
!> on each.
module fuge_working_set
  use fuge_canonical_problem, only: canonical_problem
  use fuge_compensated_sums, only: difference_rounding
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_displacements, only: add_elastic_displacement, add_open_displacement, displacement_magnitude_at
  use fuge_kinds, only: dp
  use fuge_kkt_base_set, only: stand_in_compliance
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: find_force_error, refine_solution, refinement_arrays, solve_set
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  use fuge_stops_and_limits, only: excess_over_range
  implicit none
  private

  !> Violations below this fraction of the largest force, or of the lengths at the point, are rounding.
  real(dp), parameter, public :: SIGN_TOLERANCE = 1.0e-14_dp
  !> A force displaces its point by much if that is above this fraction of all terms of the gap.
  real(dp), parameter :: SOFT = 1.0e-10_dp

  type, public :: working_set
    !> Gaps less `gap_datum`, (n), length.
    real(dp), allocatable :: reduced_gap(:)
    !> Taken out of all gaps if there is a translation to take it up, else 0; length.
    real(dp) :: gap_datum = 0.0_dp
    !> Forces up to this one are rounding; 0 if there is a load to compare them with. The second one is that of the gaps
    !> alone, without points at their limits, whose forces are a load too.
    real(dp) :: zero_force = 0.0_dp
    real(dp), private :: unloaded_force = 0.0_dp
    !> Scaled violation of the sign conditions at each point, (n).
    real(dp), allocatable :: violation(:)
    !> Displacement by the forces at each open point, (n), from the last measure.
    real(dp), allocatable :: elastic(:)
    !> The points of the set, and the gaps that displacements have to close there, (n): at the upper stop the play
    !> stays open.
    logical, allocatable :: contact(:)
    real(dp), allocatable, private :: gap_at_stops(:)
    !> Forces at the points that are at their limits, zero elsewhere, and the displacements by them, (n); allocated only
    !> where such points exist.
    real(dp), allocatable, private :: limit_force(:), limit_displacement(:)
    type(refinement_arrays), private :: arrays
  contains
    procedure :: start
    procedure :: mark
    procedure :: move_gap_datum
    procedure :: solve
    procedure :: refine
    procedure :: estimate_error
    procedure :: measure
    procedure :: has_no_length
    procedure :: find_gaps
  end type working_set

contains

  !> Prepare for a problem; arrays of an earlier one are used again. Excluded points of `state` (n) are opened, tied
  !> ones closed unless they are at a limit. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine start(self, canonical, state, status)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(inout) :: state(:)
    integer, intent(out) :: status
    integer :: n, stat

    n = size(state)
    call self%arrays%fit(n, size(canonical%load), stat)
    if (allocated(self%contact)) then
      if (size(self%contact) /= n) then
        deallocate (self%reduced_gap, self%violation, self%elastic, self%contact, self%gap_at_stops)
      end if
    end if
    if (stat == 0 .and. .not. allocated(self%contact)) then
      allocate (self%reduced_gap(n), self%violation(n), self%elastic(n), self%gap_at_stops(n), self%contact(n), &
                stat=stat)
    end if
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    self%gap_datum = 0.0_dp
    if (canonical%has_translation) self%gap_datum = minval(canonical%gap, mask=.not. canonical%excluded)
    self%reduced_gap = canonical%gap - self%gap_datum
    self%violation = 0.0_dp
    self%elastic = 0.0_dp
    self%unloaded_force = largest_zero_force(canonical, self%reduced_gap)
    self%zero_force = self%unloaded_force
    where (canonical%excluded) state = FUGE_OPEN
    where (.not. (canonical%upper > 0.0_dp .or. canonical%excluded .or. abs(state) > 1)) state = FUGE_AT_LOWER_STOP
  end subroutine start

  !> Take these states (n) as the set.
  subroutine mark(self, canonical, state)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)

    self%contact = abs(state) == FUGE_AT_LOWER_STOP
    call find_gap_at_stops(self, canonical, state)
    self%zero_force = self%unloaded_force
    if (allocated(self%limit_force)) deallocate (self%limit_force, self%limit_displacement)
    if (.not. canonical%has_limits()) return
    if (.not. any(abs(state) > 1)) return
    call load_limited_points(self, canonical, state)
    if (any(abs(self%limit_force) > 0.0_dp)) &
      self%zero_force = min(self%zero_force, SIGN_TOLERANCE*maxval(abs(self%limit_force)))
  end subroutine mark

  !> The forces of the points at their limits, and what they displace.
  subroutine load_limited_points(self, canonical, state)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    integer :: n

    n = size(state)
    allocate (self%limit_force(n), self%limit_displacement(n))
    self%limit_force = 0.0_dp
    where (state == FUGE_LIMITED_LOWER) self%limit_force = canonical%limit
    where (state == FUGE_LIMITED_UPPER) self%limit_force = -canonical%limit_upper
    self%limit_displacement = 0.0_dp
    call add_elastic_displacement(canonical%alpha, canonical%datum, abs(state) > 1, self%limit_force, &
                                  self%limit_displacement)
  end subroutine load_limited_points

  pure subroutine find_gap_at_stops(self, canonical, state)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    integer :: k

    do k = 1, size(state)
      self%gap_at_stops(k) = self%reduced_gap(k)
      if (state(k) < FUGE_OPEN) self%gap_at_stops(k) = self%reduced_gap(k) - canonical%upper(k)
    end do
  end subroutine find_gap_at_stops

  !> The rounding errors of the gaps at the stops.
  pure subroutine find_gap_rounding(self, canonical, state)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    integer :: k

    associate (rounding => self%arrays%gap_rounding)
      do k = 1, size(state)
        rounding(k) = difference_rounding(canonical%gap(k), self%gap_datum, self%reduced_gap(k))
        if (state(k) < FUGE_OPEN) rounding(k) = rounding(k) + difference_rounding(self%reduced_gap(k), &
                                                                                  canonical%upper(k), &
                                                                                  self%gap_at_stops(k))
      end do
    end associate
  end subroutine find_gap_rounding

  !> The largest force that counts as zero: 0 if there is a load; without one, all forces may be rounding, and it is the
  !> force that displaces by SIGN_TOLERANCE times the gaps or, if no mode is free, times the largest overlap.
  pure function largest_zero_force(canonical, reduced_gap) result(zero_force)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: reduced_gap(:)
    real(dp) :: zero_force
    real(dp) :: length, largest
    integer :: k

    zero_force = 0.0_dp
    if (any(abs(canonical%load) > 0.0_dp)) return
    length = 0.0_dp
    largest = canonical%survey%largest()
    do k = 1, size(reduced_gap)
      if (canonical%excluded(k)) cycle
      if (size(canonical%load) > 0) then
        length = max(length, abs(reduced_gap(k)))
      else
        length = max(length, -reduced_gap(k), reduced_gap(k) - canonical%upper(k))
      end if
    end do
    ! Where alpha is zero, the factor regularises it by such a coefficient.
    if (.not. largest > 0.0_dp) largest = 1.0e-12_dp*stand_in_compliance(canonical)
    zero_force = SIGN_TOLERANCE*(length/largest)
  end function largest_zero_force

  !> Count gaps from where the bodies meet under the motion of the solution, which follows: one point far below the
  !> others would cost them digits.
  pure subroutine move_gap_datum(self, canonical, solution)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(inout) :: solution
    real(dp) :: distance, least, before
    integer :: k, nearest

    least = huge(least)
    nearest = 0
    do k = 1, size(self%reduced_gap)
      if (canonical%excluded(k)) cycle
      distance = abs(self%reduced_gap(k) - sum(canonical%modes(k, :)*solution%motion))
      if (distance >= least) cycle
      least = distance
      nearest = k
    end do
    if (nearest == 0) return
    before = self%gap_datum
    self%gap_datum = canonical%gap(nearest)
    self%reduced_gap = canonical%gap - self%gap_datum
    solution%motion(1) = solution%motion(1) - (self%gap_datum - before)
    call find_gap_at_stops(self, canonical, solution%state)
  end subroutine move_gap_datum

  !> Forces and motion of the set that was marked last, whose `factor` is set.
  subroutine solve(self, canonical, factor, solution)
    class(working_set), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(inout) :: solution

    if (allocated(self%limit_force)) then
      call solve_set(factor, canonical%datum, self%gap_at_stops + self%limit_displacement, &
                     canonical%load - matmul(self%limit_force, canonical%modes), solution%force, solution%motion)
      where (abs(solution%state) > 1) solution%force = self%limit_force
    else
      call solve_set(factor, canonical%datum, self%gap_at_stops, canonical%load, solution%force, solution%motion)
    end if
  end subroutine solve

  !> Iterative refinement of forces and motion; `regularisation` as in `refine_solution`.
  subroutine refine(self, canonical, factor, regularisation, solution)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    real(dp), intent(in) :: regularisation
    type(contact_solution), intent(inout) :: solution

    call find_gap_rounding(self, canonical, solution%state)
    call refine_solution(canonical, self%gap_at_stops, factor, regularisation, self%contact, self%arrays, &
                         solution%force, solution%motion)
  end subroutine refine

  !> Estimate the largest error of a force that the refinement of this solution has left.
  subroutine estimate_error(self, canonical, factor, solution)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(inout) :: solution

    call find_force_error(canonical, self%gap_at_stops, factor, solution%force, solution%motion, self%arrays, &
                          solution%force_error)
    solution%unrefined_error = self%arrays%changes(1)
  end subroutine estimate_error

  !> Are the displacements on the contact zero, and the gaps that they have to close, and does no open point need a
  !> motion?
  pure function has_no_length(self, canonical)
    class(working_set), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    logical :: has_no_length
    integer :: k, n

    n = size(self%contact)
    has_no_length = any(self%contact)
    do k = 1, n
      if (canonical%excluded(k)) cycle
      if (self%contact(k)) then
        has_no_length = abs(self%gap_at_stops(k)) <= 0.0_dp
        if (has_no_length) has_no_length = all(abs(canonical%alpha(:n, k) - canonical%datum) <= 0.0_dp &
                                               .or. .not. self%contact)
      else
        has_no_length = self%reduced_gap(k) + self%elastic(k) >= 0.0_dp &
                        .and. self%reduced_gap(k) + self%elastic(k) <= canonical%upper(k)
      end if
      if (.not. has_no_length) return
    end do
  end function has_no_length

  !> Gaps that follow from forces and motion at the open points, those of the stops at the others, and the violations.
  !> Lengths are compared with all that displaces the point if `exact`, else with the contribution of the largest
  !> force, which costs one column.
  subroutine measure(self, canonical, exact, solution)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: exact
    type(contact_solution), intent(inout) :: solution

    self%elastic = 0.0_dp
    if (allocated(self%limit_force)) then
      call add_elastic_displacement(canonical%alpha, canonical%datum, solution%state /= FUGE_OPEN, solution%force, &
                                    self%elastic)
    else
      call add_open_displacement(canonical%alpha, canonical%datum, self%contact, solution%force, self%elastic)
    end if
    call self%find_gaps(canonical, solution)
    call judge_signs(self, canonical, exact, solution)
  end subroutine measure

  !> The gaps from the motion of the solution and the displacements that `measure` found.
  pure subroutine find_gaps(self, canonical, solution)
    class(working_set), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(inout) :: solution
    integer :: j

    solution%gap = self%reduced_gap
    do j = 1, size(solution%motion)
      solution%gap = solution%gap - canonical%modes(:, j)*solution%motion(j)
    end do
    solution%gap = solution%gap + self%elastic
    where (solution%state == FUGE_AT_LOWER_STOP) solution%gap = 0.0_dp
    where (solution%state == FUGE_AT_UPPER_STOP) solution%gap = canonical%upper
  end subroutine find_gaps

  !> A force of the wrong sign, by `beyond`, that is small beside others may still displace a soft point `j` by much: by
  !> more than what all terms of its gap leave to rounding. Then it is a violation.
  pure function own_violation(self, canonical, solution, j, beyond) result(violation)
    class(working_set), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    integer, intent(in) :: j
    real(dp), intent(in) :: beyond
    real(dp) :: violation
    real(dp) :: own, terms

    violation = 0.0_dp
    own = abs(canonical%alpha(j, j) - canonical%datum)*beyond
    terms = displacement_magnitude_at(canonical%alpha, canonical%datum, abs(solution%force) > 0.0_dp, solution%force, &
                                      j) + abs(canonical%gap(j)) + abs(self%gap_datum) &
            + abs(self%gap_at_stops(j) - self%reduced_gap(j)) + sum(abs(canonical%modes(j, :)*solution%motion))
    if (own > SOFT*terms) violation = min(own/terms, 1.0_dp)
  end function own_violation

  !> Forces of the wrong sign as fractions of the largest force of the body, and gaps beyond a stop as fractions of a
  !> length: the gap less the rigid displacement, which the elastic displacement has to make up for at a point in
  !> contact, and the terms of that displacement. Excluded points cannot be wrong.
  pure subroutine judge_signs(self, canonical, exact, solution)
    class(working_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: exact
    type(contact_solution), intent(in) :: solution
    real(dp), allocatable :: scale(:)
    real(dp) :: least(size(self%contact)), most(size(self%contact))
    real(dp) :: largest, beyond, rigid_gap, terms
    integer :: j, strongest

    call canonical%force_range(solution%state, least, most)
    strongest = maxloc(abs(solution%force), dim=1)
    largest = abs(solution%force(strongest))
    self%violation = 0.0_dp
    do j = 1, size(self%violation)
      if (canonical%excluded(j)) cycle
      associate (state => solution%state(j), force => solution%force(j), gap => solution%gap(j))
        if (self%contact(j)) then
          beyond = excess_over_range(force, least(j), most(j))
          if (beyond <= self%zero_force) cycle
          if (.not. allocated(scale)) allocate (scale, source=canonical%force_scale(solution%force))
          self%violation(j) = beyond/scale(j)
          if (exact .and. self%violation(j) <= SIGN_TOLERANCE) then
            self%violation(j) = max(self%violation(j), own_violation(self, canonical, solution, j, beyond))
          end if
          cycle
        end if
        ! Most open points lie between their stops.
        if (state == FUGE_OPEN .and. gap >= 0.0_dp .and. gap <= canonical%upper(j)) cycle
        beyond = -canonical%slack(j, state, gap)
        if (.not. beyond > 0.0_dp) cycle
        rigid_gap = abs(gap - self%elastic(j))
        terms = abs((canonical%alpha(j, strongest) - canonical%datum)*largest)
        ! The other forces can only make the violation smaller.
        if (exact .and. beyond > SIGN_TOLERANCE*(rigid_gap + terms)) then
          terms = displacement_magnitude_at(canonical%alpha, canonical%datum, abs(solution%force) > 0.0_dp, &
                                            solution%force, j)
        end if
        self%violation(j) = beyond/max(rigid_gap + terms, beyond)
      end associate
    end do
  end subroutine judge_signs

end module fuge_working_set
