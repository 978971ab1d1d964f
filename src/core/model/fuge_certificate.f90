!> The independent certificate: how far a solution is from the conditions of the contact problem.
!>
!> It shares no code with any engine but the call of the operator, and sees only the caller's data.
module fuge_certificate
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_data_scales, only: data_length, is_loaded, largest_by_mode, largest_of_body
  use fuge_elastic_energy, only: elastic_energy
  use fuge_kinds, only: dp
  use fuge_load_balance, only: equilibrium_violation, BESIDE, ROUNDINGS
  use fuge_operator_products, only: multiply_with_magnitude
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_point_law, only: point_law
  use fuge_point_space, only: point_space
  use fuge_relative_size, only: relative
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_residual, find_violation

  !> Forces dwarf the data if the terms of their displacements exceed the lengths of the data by one over this factor.
  real(dp), parameter :: DWARFED = 1.0e-6_dp
  !> Violations of the gap equation above this may be those of rounding alone.
  real(dp), parameter :: LEAST_SUSPECT = 1.0e-10_dp
  !> A magnitude below this fraction of the displacement by the largest forces is no scale.
  real(dp), parameter :: NO_SCALE = 256.0_dp*epsilon(1.0_dp)
  !> Lengths left open count as resolved up to this fraction of the data.
  real(dp), parameter :: RESOLVED = 1.0e-3_dp

  !> Violations, each relative to the data; no unit. Huge until they are known.
  type, public :: fuge_violation
    !> Gap equation (9): c - (gap + A f - R q).
    real(dp) :: gap_equation = huge(1.0_dp)
    !> Signs, equation (10): negative forces, negative gaps, gaps beyond the upper stop; forces beyond their limits.
    real(dp) :: sign = huge(1.0_dp)
    !> Complementary slackness, equation (10): the smaller one of a force and the distance from
    !> its stop. Where forces have limits, the distance from the law of the point.
    real(dp) :: complementarity = huge(1.0_dp)
    !> Equilibrium, equation (11): R^T f - w + S q; prescribed motions that q does not have.
    real(dp) :: equilibrium = huge(1.0_dp)
    !> Forces that dwarf the data: lengths that they leave open, or that are their rounding, relative to gaps, plays and
    !> the displacement by the load, of the points where these forces are. 0 where that is no more than a thousandth.
    real(dp) :: unresolved = huge(1.0_dp)
  contains
    procedure :: worst
  end type fuge_violation

contains

  !> The largest of the violations: the residual of a solve; no unit.
  pure function worst(self)
    class(fuge_violation), intent(in) :: self
    real(dp) :: worst

    associate (violations => [self%gap_equation, self%sign, self%complementarity, self%equilibrium, self%unresolved])
      worst = maxval(violations)
      ! maxval may ignore a NaN, which must not pass for small.
      if (.not. all(violations <= huge(worst))) worst = huge(worst)
    end associate
  end function worst

  !> How far a solution violates equations (9), (10) and (11).
  !>
  !> `operator` with n points; `problem` and `solution` in the same units; out: `violation`, huge
  !> where a force is not finite. One product A f, and another one where lengths may be rounding.
  !>
  !> With d the datum of the operator, lengths at point k are compared with the magnitude
  !> |gap_k - (R q)_k + d sum f| + sum_j |A_kj - d| |f_j|: the depth to which the point is pressed,
  !> or its rigid gap, and the terms of its displacement. The magnitude depends neither on the
  !> datum of the gaps or of A nor on other points. For one translation, the error of equation (9)
  !> at the contact point of the least magnitude shows how exact v_0 is, and is compared with v_0
  !> and its terms; elsewhere the error less that one is compared with the magnitude. For several
  !> modes the whole error is. The rounding of the caller's own numbers, and that of R q, is not
  !> counted. Forces are compared with the largest force of their body. Because the magnitudes grow with the forces,
  !> `unresolved` compares the same errors with the data alone. A + D takes the place of A where there are compliances.
  !> info%energy is the elastic energy of the forces.
  !>
  !> Errors: FUGE_ERR_SIZE if an array is missing or of the wrong length; FUGE_ERR_MEMORY; those of
  !> the product, FUGE_ERR_CALLBACK also for one that is not finite.
  subroutine fuge_residual(operator, problem, solution, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(out) :: info

    call find_violation(operator, problem, solution, violation, info)
  end subroutine fuge_residual

  !> As `fuge_residual`, within a solve: `info` goes on counting products, and its status and
  !> message change on an error only. Errors of the gaps up to `enough` stay as they are, although a further product
  !> might show that some of them is rounding.
  subroutine find_violation(operator, problem, solution, violation, info, enough)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_violation), intent(out) :: violation
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), optional :: enough
    real(dp), allocatable :: lengths(:, :)
    real(dp) :: suspect
    logical, allocatable :: included(:)
    type(point_space) :: space
    integer :: n, stat

    suspect = LEAST_SUSPECT
    if (present(enough)) suspect = max(suspect, enough)

    space = operator%ranks()
    if (.not. space%everywhere(sizes_agree(operator, problem, solution))) then
      call report(info, FUGE_ERR_SIZE, 'certificate: an array is missing or not as long as the operator has points')
      return
    end if
    ! Violations stay huge: a product with NaN would show nothing.
    if (.not. space%everywhere(all(ieee_is_finite(solution%force)))) return
    n = operator%points()
    allocate (lengths(n, 5), included(n), stat=stat)
    call require_memory(stat, 'the certificate of', n, 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    ! One array, because small problems spend much of their time on allocations.
    associate (error => lengths(:, 1), magnitude => lengths(:, 2), rigid_displacement => lengths(:, 3), &
               rigid_magnitude => lengths(:, 4), elastic => lengths(:, 5))
      call displace(operator, problem, solution%force, error, elastic, info)
      if (info%failed()) return
      info%energy = elastic_energy(problem, solution, error, operator%datum(), space)

      included = .true.
      if (allocated(problem%excluded)) included = .not. problem%excluded
      call find_rigid_displacement(problem, solution, operator%datum(), space, rigid_displacement, rigid_magnitude)
      error = (problem%gap - rigid_displacement) + error - solution%gap
      if (allocated(problem%modes)) then
        magnitude = merge(abs(problem%gap) + rigid_magnitude, 0.0_dp, included)
        call add_magnitude_of_bodies(problem%modes, magnitude, space, rigid_magnitude)
      end if
      magnitude = abs(problem%gap - rigid_displacement) + elastic
      violation%equilibrium = equilibrium_violation(problem, solution, space)
      violation%unresolved = unresolved_lengths(problem, solution, error, elastic, rigid_magnitude, included, space)
      call contact_violations(problem, solution, magnitude, included, space, violation)
      violation%gap_equation = gap_violation(error, magnitude, solution%force, problem%gap, rigid_magnitude, included, &
                                             .not. allocated(problem%modes), space)
      if (.not. violation%gap_equation > suspect) return
      call take_out_rounding(operator, problem, solution%force, elastic, included, magnitude, rigid_magnitude, error, &
                             info)
      if (info%failed()) return
      violation%gap_equation = gap_violation(error, magnitude, solution%force, problem%gap, rigid_magnitude, included, &
                                             .not. allocated(problem%modes), space)
    end associate
  end subroutine find_violation

  !> (A + D) f of the `force` (n), less the datum of the operator, and the `terms` of it. Errors: those of the product.
  subroutine displace(operator, problem, force, displacement, terms, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    real(dp), intent(out), contiguous :: displacement(:), terms(:)
    type(fuge_info), intent(inout) :: info

    call multiply_with_magnitude(operator, force, displacement, terms, info)
    if (info%failed() .or. .not. allocated(problem%compliance)) return
    displacement = displacement + problem%compliance*force
    terms = terms + problem%compliance*abs(force)
  end subroutine displace

  !> Motions are solved for together: each one that moves a point is rounded like the largest `magnitude` (n) of the
  !> body.
  subroutine add_magnitude_of_bodies(modes, magnitude, space, rigid_magnitude)
    real(dp), intent(in) :: modes(:, :), magnitude(:)
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: rigid_magnitude(:)
    real(dp) :: by_mode(size(modes, 2))
    integer :: k

    by_mode = largest_by_mode(modes, magnitude, space)
    do k = 1, size(magnitude)
      rigid_magnitude(k) = rigid_magnitude(k) + max(count(abs(modes(k, :)) > 0.0_dp), 1) &
                           *largest_of_body(modes, by_mode, k)
    end do
  end subroutine add_magnitude_of_bodies

  !> `largest` (n): at each point the largest magnitude of `values` (n) on its body.
  subroutine spread_over_bodies(modes, values, space, largest)
    real(dp), intent(in) :: modes(:, :), values(:)
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: largest(:)
    real(dp) :: by_mode(size(modes, 2))
    integer :: k

    by_mode = largest_by_mode(modes, values, space)
    do k = 1, size(largest)
      largest(k) = largest_of_body(modes, by_mode, k)
    end do
  end subroutine spread_over_bodies

  !> Where all forces that displace a point are zero but for rounding, so is its magnitude, with which nothing can be
  !> compared. There the error becomes smaller by the rounding of forces as large as the largest one of the body (M.
  !> Arioli, J. W. Demmel, I. S. Duff, SIAM Journal on Matrix Analysis and Applications 10, 1989), and everywhere by
  !> that of the motions, which follow from all displacements of the body.
  !>
  !> `elastic` (n) are the terms of A f. One more product. The arguments are more than eight because each length has
  !> terms of its own. Errors: those of the product, FUGE_ERR_MEMORY.
  subroutine take_out_rounding(operator, problem, force, elastic, included, magnitude, rigid_magnitude, error, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:), elastic(:), magnitude(:), rigid_magnitude(:)
    logical, intent(in) :: included(:)
    real(dp), intent(inout) :: error(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    real(dp), allocatable, dimension(:) :: largest, of_bodies, rounding, terms
    integer :: stat

    space = operator%ranks()
    allocate (largest(size(force)), of_bodies(size(force)), rounding(size(force)), terms(size(force)), stat=stat)
    call require_memory(stat, 'the certificate of', size(force), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    largest = space%largest(maxval(abs(force)))
    if (allocated(problem%modes)) call spread_over_bodies(problem%modes, force, space, largest)
    where (.not. included) largest = 0.0_dp
    call displace(operator, problem, largest, of_bodies, terms, info)
    if (info%failed()) return
    where (.not. included .or. magnitude > NO_SCALE*terms) terms = 0.0_dp
    rounding = NO_SCALE*terms
    ! Where no force displaces a point, its rigid gap may be the rounding of the gap and the motions.
    where (elastic <= 0.0_dp .and. magnitude <= NO_SCALE*(abs(problem%gap) + rigid_magnitude))
      rounding = NO_SCALE*(abs(problem%gap) + rigid_magnitude)
    end where
    terms = merge(terms + elastic, 0.0_dp, included)
    largest = space%largest(maxval(terms + rigid_magnitude, mask=included))
    if (allocated(problem%modes)) then
      call spread_over_bodies(problem%modes, terms, space, of_bodies)
      ! A body that no force displaces has no lengths of its own.
      where (of_bodies > 0.0_dp) largest = of_bodies
    end if
    rounding = rounding + 2.0_dp*epsilon(error)*largest
    where (abs(error) <= rounding)
      error = 0.0_dp
    else where
      error = error - sign(rounding, error)
    end where
  end subroutine take_out_rounding

  !> R q less the displacement by the `datum`, (n), and the magnitude of its terms.
  subroutine find_rigid_displacement(problem, solution, datum, space, rigid_displacement, rigid_magnitude)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: datum
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: rigid_displacement(:), rigid_magnitude(:)
    real(dp) :: shift
    integer :: j

    shift = datum*space%total(sum(solution%force))
    ! Forces of both signs may cancel in the sum, but not their rounding.
    rigid_magnitude = abs(datum)*space%total(sum(abs(solution%force)))
    if (allocated(problem%modes)) then
      rigid_displacement = -shift
      do j = 1, size(solution%motion)
        rigid_displacement = rigid_displacement + problem%modes(:, j)*solution%motion(j)
        rigid_magnitude = rigid_magnitude + abs(problem%modes(:, j)*solution%motion(j))
      end do
    else
      rigid_displacement = solution%motion(1) - shift
      rigid_magnitude = rigid_magnitude + abs(solution%motion(1))
    end if
  end subroutine find_rigid_displacement

  !> The error of equation (9); for one translation, the error that all points share (that of v_0)
  !> and the rest are judged separately.
  function gap_violation(error, magnitude, force, gap, rigid_magnitude, included, translation, space) result(violation)
    real(dp), intent(in) :: error(:), magnitude(:), force(:), gap(:), rigid_magnitude(:)
    logical, intent(in) :: included(:), translation
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: at_reference(4), key, largest, shared, rounding, excess
    integer :: k, reference

    violation = 0.0_dp
    if (.not. space%anywhere(any(included))) return
    largest = space%largest(maxval(abs(force)))
    if (largest > 0.0_dp) then
      ! A force of rounding size is no contact.
      reference = minloc(magnitude, dim=1, mask=included .and. abs(force) > sqrt(epsilon(shared))*largest)
    else
      reference = minloc(gap, dim=1, mask=included)
    end if
    key = huge(key)
    at_reference = 0.0_dp
    if (reference > 0) then
      key = merge(magnitude(reference), gap(reference), largest > 0.0_dp)
      at_reference = [error(reference), magnitude(reference), gap(reference), rigid_magnitude(reference)]
    end if
    call space%take_from_least(key, at_reference)
    shared = 0.0_dp
    if (translation) shared = at_reference(1)
    do k = 1, size(error)
      ! max may ignore a NaN, which must not pass for small.
      if (.not. abs(error(k)) <= huge(violation)) violation = huge(violation)
      ! Half a unit in the last place each, of the gaps and of the motions, and as much for their sum.
      rounding = abs(gap(k)) + abs(at_reference(3)) + rigid_magnitude(k)
      excess = max(abs(error(k) - shared) - 2.0_dp*epsilon(shared)*rounding, 0.0_dp)
      call raise_to(violation, excess, magnitude(k) + at_reference(2))
    end do
    violation = space%largest(violation)
    if (translation) violation = max(violation, &
      relative(abs(shared), max(at_reference(4), abs(at_reference(3)), at_reference(2))))
  end function gap_violation

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

  !> Signs and complementarity, equation (10) at both stops.
  subroutine contact_violations(problem, solution, magnitude, included, space, violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: magnitude(:)
    logical, intent(in) :: included(:)
    type(point_space), intent(in) :: space
    type(fuge_violation), intent(inout) :: violation
    real(dp), allocatable :: by_mode(:)
    real(dp) :: largest, body_force, rounding, upper, stop_distance, violations(2)
    logical :: has_limits
    integer :: k

    violation%sign = 0.0_dp
    violation%complementarity = 0.0_dp
    largest = space%largest(maxval(abs(solution%force)))
    upper = huge(upper)
    has_limits = problem%has_limits()
    body_force = largest
    ! Not by assignment, for which gfortran compares bounds that are not there yet.
    if (allocated(problem%modes)) allocate (by_mode, source=largest_by_mode(problem%modes, solution%force, space))
    do k = 1, size(magnitude)
      if (allocated(by_mode)) body_force = largest_of_body(problem%modes, by_mode, k)
      if (.not. body_force > 0.0_dp) body_force = largest
      ! Beside the largest force, smaller ones of other bodies may be rounding, but for those that carry a load.
      rounding = 0.0_dp
      if (body_force < largest) then
        if (.not. is_loaded(problem, k)) rounding = ROUNDINGS*epsilon(rounding)*largest
      end if
      associate (f => solution%force(k), c => solution%gap(k))
        if (.not. included(k)) then
          call raise_to(violation%sign, abs(f), largest)
          cycle
        end if
        if (has_limits) then
          call judge_law(problem%law(k), f, c, body_force, magnitude(k), rounding, violation)
          cycle
        end if
        if (allocated(problem%gap_upper)) upper = min(problem%gap_upper(k), huge(upper))
        call raise_to(violation%sign, -c, magnitude(k))
        if (upper < huge(upper)) then
          call raise_to(violation%sign, c - upper, magnitude(k))
        else
          call raise_to(violation%sign, max(-f - rounding, 0.0_dp), body_force)
        end if
        stop_distance = c
        if (f < 0.0_dp .and. upper < huge(upper)) stop_distance = c - upper
        if (abs(f) <= rounding) cycle
        if (may_exceed(violation%complementarity, abs(stop_distance), magnitude(k))) then
          violation%complementarity = max(violation%complementarity, min(relative(abs(f) - rounding, body_force), &
                                                                         relative(abs(stop_distance), magnitude(k))))
        end if
      end associate
    end do
    violations = [violation%sign, violation%complementarity]
    call space%raise(violations)
    violation%sign = violations(1)
    violation%complementarity = violations(2)
  end subroutine contact_violations

  !> How far a point with limits of its forces is from its law. `force_scale`, `length_scale` and `noise` as in
  !> `point_law`.
  pure subroutine judge_law(law, force, gap, force_scale, length_scale, noise, violation)
    type(point_law), intent(in) :: law
    real(dp), intent(in) :: force, gap, force_scale, length_scale, noise
    type(fuge_violation), intent(inout) :: violation

    violation%sign = max(violation%sign, relative(max(force - law%most_force() - noise, &
                                                      law%least_force() - force - noise, 0.0_dp), force_scale))
    violation%complementarity = max(violation%complementarity, &
                                    law%distance(force, gap, force_scale, length_scale, noise))
  end subroutine judge_law

  !> The lengths that forces leave open where they dwarf the data, as a fraction of the lengths in the data; 0 up to
  !> RESOLVED. Each point counts with its share of the forces, as in the work that they do: the terms of displacements
  !> may be as large at a soft point beside a stiff one, but not where the forces are. The lengths are those of the
  !> points with the large forces: a wide gap elsewhere excuses nothing, but for RESOLVED of it, where these have none.
  !>
  !> `error` (n) of equation (9), `elastic` (n) the terms of A f, `rigid_magnitude` (n) those of the motions.
  function unresolved_lengths(problem, solution, error, elastic, rigid_magnitude, included, space) result(violation)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: error(:), elastic(:), rigid_magnitude(:)
    logical, intent(in) :: included(:)
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: excess, largest, length, open, terms, total
    type(point_law) :: law
    integer :: k

    violation = 0.0_dp
    ! Forces that push with one load between them do not dwarf it.
    if (problem%is_plain()) return
    largest = space%largest(maxval(abs(solution%force), mask=included))
    if (.not. largest > 0.0_dp) return
    total = 0.0_dp
    do k = 1, size(error)
      if (included(k)) total = total + abs(solution%force(k))/largest
    end do
    total = space%total(total)
    terms = 0.0_dp
    do k = 1, size(error)
      if (included(k)) terms = terms + abs(solution%force(k))/largest/total*elastic(k)
    end do
    length = data_length(problem, solution%force, elastic, included, space)
    if (DWARFED*space%total(terms) <= length) return
    open = 0.0_dp
    do k = 1, size(error)
      law = problem%law(k)
      ! Elsewhere the terms of a displacement excuse rounding; here only those of R q and the datum do.
      excess = max(abs(error(k)) - 2.0_dp*epsilon(excess)*(abs(problem%gap(k)) + rigid_magnitude(k)), &
                   epsilon(excess)*elastic(k), law%stop_distance(solution%force(k), solution%gap(k)))
      open = open + merge(abs(solution%force(k)), 0.0_dp, included(k))/largest/total*excess
    end do
    length = max(RESOLVED*length, data_length(problem, solution%force, elastic, &
                                              included .and. abs(solution%force) > BESIDE*largest, space))
    violation = relative(space%total(open), length)
    if (violation <= RESOLVED) violation = 0.0_dp
  end function unresolved_lengths

  !> Is every array allocated, and as long as the operator has points? Where ranks share the points, one may have none.
  function sizes_agree(operator, problem, solution)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical :: sizes_agree
    type(point_space) :: space
    integer :: m, n

    m = problem%mode_count()
    n = operator%points()
    space = operator%ranks()
    sizes_agree = (n > 0 .or. .not. space%is_alone()) .and. size_of(problem%gap) == n &
      .and. size_of(solution%force) == n &
      .and. size_of(solution%gap) == n .and. size_of(solution%motion) == m
    if (allocated(problem%modes)) sizes_agree = sizes_agree .and. size(problem%modes, 1) == n
    if (allocated(problem%gap_upper)) sizes_agree = sizes_agree .and. size(problem%gap_upper) == n
    if (allocated(problem%excluded)) sizes_agree = sizes_agree .and. size(problem%excluded) == n
    if (allocated(problem%compliance)) sizes_agree = sizes_agree .and. size(problem%compliance) == n
    if (allocated(problem%limit)) sizes_agree = sizes_agree .and. size(problem%limit) == n
    if (allocated(problem%limit_upper)) sizes_agree = sizes_agree .and. size(problem%limit_upper) == n
    if (allocated(problem%motion_stiffness)) sizes_agree = sizes_agree .and. size(problem%motion_stiffness) == m
    if (allocated(problem%prescribed)) then
      sizes_agree = sizes_agree .and. size(problem%prescribed) == m .and. size_of(problem%motion) == m
      if (.not. all(problem%prescribed)) sizes_agree = sizes_agree .and. size_of(problem%resultant) == m
    else if (m > 0) then
      sizes_agree = sizes_agree .and. size_of(problem%resultant) == m
    end if
  end function sizes_agree

  !> Number of values; -1 if not allocated.
  pure function size_of(values) result(n)
    real(dp), intent(in), allocatable :: values(:)
    integer :: n

    n = -1
    if (allocated(values)) n = size(values)
  end function size_of

end module fuge_certificate
