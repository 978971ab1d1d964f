!> The violations of `fuge_certificate`, point by point.
submodule(fuge_certificate) fuge_violation_search
  use fuge_certificate_judgement, only: judge_points
  use fuge_certificate_passes, only: add_rounding_of_bodies, certificate_pass, find_arms, find_rigid_displacement, &
    law, sum_open_lengths, sum_terms, survey_displacements, survey_forces, tile_lengths, TILE
  use fuge_data_scales, only: data_length, largest_by_mode, largest_of_body
  use fuge_elastic_energy, only: elastic_energy, energy_units
  use fuge_load_balance, only: equilibrium_violation, BESIDE
  use fuge_operator_products, only: multiply, multiply_with_magnitude
  use fuge_point_law, only: point_law
  use fuge_point_space, only: point_space
  use fuge_relative_size, only: relative
  use fuge_status, only: report, require_memory, FUGE_ERR_SIZE
  implicit none

  !> Forces dwarf the data if the terms of their displacements exceed the lengths of the data by one over this factor.
  real(dp), parameter :: DWARFED = 1.0e-6_dp
  !> Violations of the gap equation above this may be those of rounding alone.
  real(dp), parameter :: LEAST_SUSPECT = 1.0e-10_dp
  !> A magnitude below this fraction of the displacement by the largest forces is no scale.
  real(dp), parameter :: NO_SCALE = 256.0_dp*epsilon(1.0_dp)
  !> Lengths left open count as resolved up to this fraction of the data.
  real(dp), parameter :: RESOLVED = 1.0e-3_dp

contains

  module procedure fuge_residual
    call find_violation(operator, problem, solution, violation, info)
  end procedure fuge_residual

  module procedure find_violation
    real(dp) :: suspect
    type(point_space) :: space

    suspect = LEAST_SUSPECT
    if (present(enough)) suspect = max(suspect, enough)
    space = operator%ranks()
    if (space%everywhere(sizes_agree(operator, problem, solution))) then
      call judge(operator, problem, solution, suspect, violation, info)
    else
      call report(info, FUGE_ERR_SIZE, 'certificate: an array is missing or not as long as the operator has points')
    end if
  end procedure find_violation

  !> As `find_violation`, for arrays of the right sizes. Errors of the gaps above `suspect` may be rounding.
  subroutine judge(operator, problem, solution, suspect, violation, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in), target :: problem
    type(fuge_solution), intent(in), target :: solution
    real(dp), intent(in) :: suspect
    type(fuge_violation), intent(inout) :: violation
    type(fuge_info), intent(inout) :: info
    type(certificate_pass) :: pass
    type(point_space) :: space
    real(dp), allocatable, target :: error(:), lengths(:, :)
    real(dp) :: forces(3), found(6), sums(2), units(2)
    integer :: columns, reference, stat
    logical :: common

    space = operator%ranks()
    call pass%point_to(problem, solution)
    call pass%go(survey_forces, 2, found)
    ! Violations stay huge: a product with NaN would show nothing.
    if (space%anywhere(found(3) > 0.0_dp)) return
    call take_forces(pass, space, found, forces)
    ! Kept of each point: its displacement; R q and the terms of it, where there are modes; the terms of displacements,
    ! where they differ from point to point. One array, because small problems spend much of their time on allocations.
    common = operator%common_magnitude(0.0_dp, 0.0_dp) >= 0.0_dp
    columns = merge(1, 3, .not. allocated(problem%modes)) + merge(0, 1, common)
    allocate (lengths(size(solution%force), columns), stat=stat)
    call require_memory(stat, 'the certificate of', size(solution%force), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    pass%displacement => lengths(:, 1)
    if (allocated(problem%modes)) then
      pass%rigid => lengths(:, 2)
      pass%rigid_magnitude => lengths(:, 3)
    end if
    if (.not. common) pass%terms => lengths(:, columns)

    call find_displacements(operator, forces, pass, units, info)
    if (info%failed()) return
    call find_motions(operator%datum(), forces, space, pass)
    call pass%find_reference(sums(1), sums(2), reference)
    call space%add(sums)
    pass%shares = sums(2)
    info%energy = elastic_energy(problem, solution%motion, sums(1), units, forces(1), operator%datum())
    call judge_with_reference(pass, reference, space, violation)
    violation%equilibrium = equilibrium_violation(problem, solution, forces, space)
    violation%unresolved = unresolved_lengths(pass, forces(2), space)
    if (.not. violation%gap_equation > suspect) return
    call take_out_rounding(operator, pass, error, info)
    if (info%failed()) return
    pass%error => error
    call judge_with_reference(pass, reference, space, violation)
  end subroutine judge

  !> Take what `survey_forces` has `found`, of all ranks. `forces`: their sum, that of their magnitudes, and the largest
  !> magnitude.
  subroutine take_forces(pass, space, found, forces)
    type(certificate_pass), intent(inout) :: pass
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: found(6)
    real(dp), intent(out) :: forces(3)

    call space%add(found(:2))
    call space%raise(found(4:))
    forces = [found(1), found(2), found(4)]
    pass%largest_force = found(4)
    pass%largest_included = found(5)
    pass%is_any_included = found(6) > 0.0_dp
    ! Forces that push with one load between them do not dwarf it.
    pass%with_shares = pass%largest_included > 0.0_dp .and. .not. pass%problem%is_plain()
  end subroutine take_forces

  !> The displacements by the `forces`, as from `take_forces`, the terms of them, and the units in which works are
  !> summed. Errors: those of the product.
  subroutine find_displacements(operator, forces, pass, units, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: forces(3)
    type(certificate_pass), intent(inout) :: pass
    real(dp), intent(out) :: units(2)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    real(dp) :: largest(2)

    units = 1.0_dp
    space = operator%ranks()
    if (associated(pass%terms)) then
      call multiply_with_magnitude(operator, pass%force, pass%displacement, pass%terms, info)
    else
      call multiply(operator, pass%force, pass%displacement, info)
    end if
    if (info%failed()) return
    call pass%go(survey_displacements, 0, largest)
    call space%raise(largest)
    if (.not. associated(pass%terms)) pass%common_terms = operator%common_magnitude(largest(1), forces(2))
    units = energy_units([forces(3), largest(2)])
    pass%inverse_unit = 1.0_dp/units
  end subroutine find_displacements

  !> R q less the displacement by the `datum`, and the magnitude of its terms.
  subroutine find_motions(datum, forces, space, pass)
    real(dp), intent(in) :: datum, forces(3)
    type(point_space), intent(in) :: space
    type(certificate_pass), intent(inout) :: pass
    real(dp), allocatable :: by_mode(:)
    real(dp) :: nothing(0)

    pass%common_rigid = -datum*forces(1)
    ! Forces of both signs may cancel in the sum, but not their rounding.
    pass%common_rigid_magnitude = abs(datum)*forces(2)
    if (.not. associated(pass%rigid)) then
      pass%common_rigid = pass%motion(1) + pass%common_rigid
      pass%common_rigid_magnitude = pass%common_rigid_magnitude + abs(pass%motion(1))
      return
    end if
    allocate (by_mode(2*size(pass%motion)))
    call pass%go(find_rigid_displacement, 0, by_mode)
    call space%raise(by_mode)
    call move_alloc(by_mode, pass%by_mode)
    call pass%go(add_rounding_of_bodies, 0, nothing)
  end subroutine find_motions

  !> Judge all points, with the one that `find_reference` has found here. For one translation, the error that all points
  !> share (that of v_0) and the rest are judged separately.
  subroutine judge_with_reference(pass, reference, space, violation)
    type(certificate_pass), intent(inout) :: pass
    integer, intent(in) :: reference
    type(point_space), intent(in) :: space
    type(fuge_violation), intent(inout) :: violation
    type(tile_lengths) :: at
    real(dp) :: at_reference(4), key, violations(3)

    key = huge(key)
    at_reference = 0.0_dp
    if (reference > 0) then
      call pass%find_lengths(reference, reference, at)
      key = merge(at%magnitude(1), pass%gap(reference), pass%largest_force > 0.0_dp)
      at_reference = [at%error(1), at%magnitude(1), pass%gap(reference), at%rigid_magnitude(1)]
    end if
    call space%take_from_least(key, at_reference)
    if (.not. associated(pass%rigid)) pass%shared_error = at_reference(1)
    pass%reference_magnitude = at_reference(2)
    pass%reference_gap = at_reference(3)
    call pass%go(judge_points, 0, violations)
    call space%raise(violations)
    violation%gap_equation = max(violations(1), relative(abs(pass%shared_error), &
      max(at_reference(4), abs(at_reference(3)), at_reference(2))))
    if (.not. pass%is_any_included) violation%gap_equation = 0.0_dp
    violation%sign = violations(2)
    violation%complementarity = violations(3)
  end subroutine judge_with_reference

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
  !> that of the motions, which follow from all displacements of the body. Motions on springs follow from the loads
  !> that these carry too: where all gaps are zero and no body gives way, how far a load alone moves a point is the
  !> only length.
  !>
  !> `error` (n) are the errors that remain. One more product. Errors: those of the product, FUGE_ERR_MEMORY.
  subroutine take_out_rounding(operator, pass, error, info)
    class(fuge_operator), intent(in) :: operator
    type(certificate_pass), intent(in) :: pass
    real(dp), allocatable, intent(out) :: error(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    type(tile_lengths) :: at
    real(dp), allocatable, dimension(:) :: largest, of_bodies, rounding, soft, terms
    real(dp) :: most, only, reach(pass%problem%mode_count()), widest
    integer :: k, n, stat

    space = operator%ranks()
    n = size(pass%force)
    allocate (error(n), largest(n), of_bodies(n), rounding(n), soft(n), terms(n), stat=stat)
    call require_memory(stat, 'the certificate of', n, 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    largest = pass%largest_force
    if (associated(pass%rigid)) call spread_over_bodies(pass%modes, pass%force, space, largest)
    if (associated(pass%excluded)) then
      where (pass%excluded) largest = 0.0_dp
    end if
    call multiply_with_magnitude(operator, largest, of_bodies, terms, info)
    if (info%failed()) return
    soft = 0.0_dp
    only = 0.0_dp
    if (associated(pass%compliance)) then
      call find_longest(pass, space, error, rounding)
      call find_soft_terms(pass, largest, rounding, soft)
      only = only_length(pass, largest, terms, space)
    end if
    most = -huge(most)
    reach = spring_reach(pass%problem)
    widest = 0.0_dp
    do k = 1, n
      if (mod(k - 1, TILE) == 0) call pass%find_lengths(k, min(k + TILE - 1, n), at)
      if (pass%included(k)) widest = max(widest, abs(pass%gap(k)), at%elastic(mod(k - 1, TILE) + 1))
    end do
    widest = space%largest(widest)
    if (.not. widest > 0.0_dp) widest = huge(widest)
    do k = 1, n
      if (mod(k - 1, TILE) == 0) call pass%find_lengths(k, min(k + TILE - 1, n), at)
      associate (elastic => at%elastic(mod(k - 1, TILE) + 1), magnitude => at%magnitude(mod(k - 1, TILE) + 1), &
                 rigid => abs(pass%gap(k)) + at%rigid_magnitude(mod(k - 1, TILE) + 1) &
                          + min(reach_at(pass, reach, k), widest))
        error(k) = at%error(mod(k - 1, TILE) + 1)
        rounding(k) = NO_SCALE*(terms(k) + soft(k))
        if (.not. pass%included(k) .or. magnitude > rounding(k)) then
          terms(k) = 0.0_dp
          rounding(k) = 0.0_dp
        end if
        ! Where no force displaces a point, its rigid gap may be the rounding of the gap and the motions.
        if (elastic <= 0.0_dp .and. magnitude <= NO_SCALE*rigid) rounding(k) = NO_SCALE*rigid
        terms(k) = merge(terms(k) + elastic, 0.0_dp, pass%included(k))
        if (pass%included(k)) most = max(most, terms(k) + (at%rigid_magnitude(mod(k - 1, TILE) + 1)))
      end associate
    end do
    largest = space%largest(most)
    if (associated(pass%rigid)) then
      call spread_over_bodies(pass%modes, terms, space, of_bodies)
      ! A body that no force displaces has no lengths of its own.
      where (of_bodies > 0.0_dp) largest = of_bodies
    end if
    rounding = rounding + 2.0_dp*epsilon(error)*max(largest, only)
    where (abs(error) <= rounding)
      error = 0.0_dp
    else where
      error = error - sign(rounding, error)
    end where
  end subroutine take_out_rounding

  !> The `terms` (n) of the compliances under forces as large as `largest` (n). Where the error is no force
  !> that the point may have at its stop, but a gap, they are no larger than the `longest` (n) lengths: the rounding of
  !> a force may displace a soft point by more than any length is rounded.
  pure subroutine find_soft_terms(pass, largest, longest, terms)
    type(certificate_pass), intent(in) :: pass
    real(dp), intent(in) :: largest(:), longest(:)
    real(dp), intent(out) :: terms(:)
    type(tile_lengths) :: at
    type(point_law) :: law_here
    real(dp) :: force, least, most, soft
    integer :: k

    do k = 1, size(terms)
      if (mod(k - 1, TILE) == 0) call pass%find_lengths(k, min(k + TILE - 1, size(terms)), at)
      terms(k) = 0.0_dp
      if (.not. pass%compliance(k) > 0.0_dp .or. .not. pass%included(k)) cycle
      law_here = law(pass, k)
      least = 0.0_dp
      most = 0.0_dp
      if (pass%gap_under_load(k) <= 0.0_dp) most = law_here%most_force()
      if (pass%gap_under_load(k) >= law_here%play) least = law_here%least_force()
      force = pass%force(k) - at%error(mod(k - 1, TILE) + 1)/pass%compliance(k)
      soft = pass%compliance(k)*largest(k)
      if (force < least .or. force > most) soft = min(soft, longest(k))
      terms(k) = soft
    end do
  end subroutine find_soft_terms

  !> How far the stiffest of the compliances gives way under forces as large as `largest` (n), where that is the only
  !> length: all gaps are zero, before the load and under it, and no body gives way, `terms` (n). Else 0.
  function only_length(pass, largest, terms, space) result(length)
    type(certificate_pass), intent(in) :: pass
    real(dp), intent(in) :: largest(:), terms(:)
    type(point_space), intent(in) :: space
    real(dp) :: length
    real(dp) :: found(3)
    integer :: k

    length = 0.0_dp
    if (allocated(pass%prescribed_motion)) return
    found = [0.0_dp, 0.0_dp, -huge(length)]
    do k = 1, size(terms)
      if (.not. pass%included(k)) cycle
      found(1) = max(found(1), abs(pass%gap(k)), terms(k))
      found(2) = max(found(2), abs(pass%gap_under_load(k)))
      if (pass%compliance(k)*largest(k) > 0.0_dp) found(3) = max(found(3), -pass%compliance(k)*largest(k))
    end do
    call space%raise(found)
    if (found(1) > 0.0_dp .or. found(2) > -NO_SCALE*found(3) .or. .not. found(3) > -huge(length)) return
    length = -found(3)
  end function only_length

  !> `longest` (n): the largest term of a gap on the body of each point. `lengths` (n) is work space.
  subroutine find_longest(pass, space, lengths, longest)
    type(certificate_pass), intent(in) :: pass
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: lengths(:), longest(:)
    type(tile_lengths) :: at
    real(dp) :: most
    integer :: first, k, last

    do first = 1, size(lengths), TILE
      last = min(first + TILE - 1, size(lengths))
      call pass%find_lengths(first, last, at)
      do k = first, last
        lengths(k) = 0.0_dp
        if (pass%included(k)) lengths(k) = max(abs(pass%gap(k)), at%rigid_magnitude(k - first + 1), &
                                               at%elastic(k - first + 1))
      end do
    end do
    most = space%largest(maxval(lengths))
    longest = 0.0_dp
    if (associated(pass%rigid)) call spread_over_bodies(pass%modes, lengths, space, longest)
    where (.not. longest > 0.0_dp) longest = most
  end subroutine find_longest

  !> How far the load of each motion on a spring alone would move it, (m); 0 without a spring.
  pure function spring_reach(problem) result(reach)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: reach(problem%mode_count())
    real(dp) :: stiffness(problem%mode_count())

    reach = 0.0_dp
    stiffness = problem%stiffnesses()
    ! The quotient must not overflow.
    where (stiffness > 0.0_dp) reach = min(abs(problem%resultants()), huge(reach)*min(stiffness, 1.0_dp))/stiffness
  end function spring_reach

  !> How far the motions, each as far as `reach` (m), move point `k`.
  pure function reach_at(pass, reach, k) result(length)
    type(certificate_pass), intent(in) :: pass
    real(dp), intent(in) :: reach(:)
    integer, intent(in) :: k
    real(dp) :: length

    if (associated(pass%rigid)) then
      length = sum(abs(pass%modes(k, :))*reach)
    else
      length = sum(reach)
    end if
  end function reach_at

  !> The lengths that forces leave open where they dwarf the data, as a fraction of the lengths in the data; 0 up to
  !> RESOLVED. Each point counts with its share of the forces, as in the work that they do: the terms of displacements
  !> may be as large at a soft point beside a stiff one, but not where the forces are. The lengths are those of the
  !> points with the large forces: a wide gap elsewhere excuses nothing, but for RESOLVED of it, where these have none.
  !>
  !> `total` is the sum of the magnitudes of the forces.
  function unresolved_lengths(pass, total, space) result(violation)
    type(certificate_pass), intent(inout) :: pass
    real(dp), intent(in) :: total
    type(point_space), intent(in) :: space
    real(dp) :: violation
    real(dp) :: length, length_beside, open(1), terms

    violation = 0.0_dp
    if (.not. pass%with_shares) return
    pass%least_force = -1.0_dp
    call find_data_length(pass, total, space, length, terms)
    if (DWARFED*terms <= length) return
    pass%least_force = BESIDE*pass%largest_included
    call find_data_length(pass, total, space, length_beside, terms)
    length = max(RESOLVED*length, length_beside)
    call pass%go(sum_open_lengths, 1, open)
    call space%add(open)
    violation = relative(open(1), length)
    if (violation <= RESOLVED) violation = 0.0_dp
  end function unresolved_lengths

  !> The `length` in the data of the points with forces above the least of `pass`, and the terms of their displacements,
  !> each with its share of the forces. `total` as for `unresolved_lengths`.
  subroutine find_data_length(pass, total, space, length, terms)
    type(certificate_pass), intent(inout) :: pass
    real(dp), intent(in) :: total
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: length, terms
    real(dp) :: arms(pass%problem%mode_count()), found(6)

    arms = 1.0_dp
    if (associated(pass%rigid)) then
      call pass%go(find_arms, 0, arms)
      call space%raise(arms)
    end if
    call pass%go(sum_terms, 1, found)
    terms = space%total(found(1))
    call space%raise(found(2:))
    length = data_length(pass%problem, arms, found(2:), total)
  end subroutine find_data_length

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

end submodule fuge_violation_search
