!> Bounds of the error of a solution with a matrix.
!>
!> 1. A is positive definite on the forces that motions leave free, so the solution is the only one.
!> 2. The equations for the states of the solution are enclosed, and the signs of all forces and gaps are certain: what
!>    is enclosed is the solution.
!> 3. Points whose sign is not certain, U, count as at a stop. The problem on U alone, with the other points in their
!>    states, has the Schur complement M of these as its matrix, which is positive definite, and so one solution f. With
!>    the enclosed forces f' on U, e = f' - f and f' + eta within the law, (e + eta) . M e <= 0, because the law is
!>    monotone. So |e| <= |eta| in the norm of M, which bounds all: the inverse of M is a block of that of the equations
!>    (compare R. Mathias and J.-S. Pang, Linear Algebra and its Applications 132, 1990). If all other signs stay
!>    certain, this is a solution of the whole problem, and by 1 the only one.
module fuge_matrix_proof
  use fuge_claimed_states, only: claim_point, point_claim, state_by_law, state_of
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_proof_type, only: fuge_proof
  use fuge_rounding_bounds, only: raised, LEAST
  use fuge_scaled_contact, only: scaled_contact, scale_contact
  use fuge_set_enclosure, only: add_columns, enclose_set, fill_equations, set_enclosure
  use fuge_status, only: fuge_info, report, require_memory, FUGE_WARN_NOT_PROVED
  use fuge_verified_inverse, only: verified_inverse
  implicit none
  private

  public :: prove_with_matrix

  !> How often states may be chosen anew.
  integer, parameter :: MOST_SETS = 4

contains

  !> Bound what `proof` holds, whose bounds are infinite on entry, by the matrix `alpha` (lda, n), of which the lower
  !> triangle counts. FUGE_WARN_NOT_PROVED with the reason where they stay infinite. Error: FUGE_ERR_MEMORY.
  subroutine prove_with_matrix(alpha, problem, solution, proof, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    type(fuge_info), intent(inout) :: info
    type(scaled_contact) :: contact
    logical :: is_proved
    integer :: stat

    call scale_contact(alpha, problem, solution, contact, is_proved, stat)
    if (stat == 0 .and. is_proved) call contact%prove_uniqueness(is_proved, stat)
    call require_memory(stat, 'a copy of the matrix of', problem%points(), 'points', info)
    if (stat /= 0) return
    if (is_proved) then
      call prove_states(contact, problem, solution, proof, info)
    else
      call report(info, FUGE_WARN_NOT_PROVED, 'it cannot be proved that the matrix is positive definite on forces ' &
                  //'without resultants: merge points that nearly coincide, or give them compliances')
    end if
  end subroutine prove_with_matrix

  !> Steps 2 and 3, with points at stops whose gaps are not certain.
  subroutine prove_states(contact, problem, solution, proof, info)
    type(scaled_contact), intent(in) :: contact
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(inout) :: proof
    type(fuge_info), intent(inout) :: info
    type(point_claim), allocatable :: claims(:)
    type(set_enclosure) :: enclosure
    integer, allocatable :: states(:)
    logical, allocatable :: as_said(:), certain(:)
    logical :: is_proved
    integer :: k, set, stat

    allocate (states(contact%points), claims(contact%points), as_said(contact%points), certain(contact%points), &
              stat=stat)
    call require_memory(stat, 'the states of', contact%points, 'points', info)
    if (stat /= 0) return
    states = [(state_by_law(problem%law(k), state_of(problem, solution, k)), k=1, contact%points)]
    do set = 1, MOST_SETS
      claims = [(claim_point(problem%law(k), states(k)), k=1, contact%points)]
      call prove_set(contact, claims, enclosure, certain, is_proved, stat)
      call require_memory(stat, 'the inverse of the equations of', contact%points, 'points', info)
      if (stat /= 0) return
      if (is_proved .or. all(certain .or. claims%at_stop) .or. .not. enclosure%is_enclosed) exit
      call put_at_stops(contact, problem, claims, enclosure, certain, states)
    end do
    as_said = states == [(state_of(problem, solution, k), k=1, contact%points)]
    if (is_proved) then
      call fill_proof(contact, problem, solution, claims, enclosure, proof)
      proof%state_proved = certain .and. as_said
    end if
    if (enclosure%in_range) then
      call report_states(certain, as_said, enclosure%is_enclosed, is_proved, info)
    else
      call report(info, FUGE_WARN_NOT_PROVED, 'a play or a limit at which a point is said to be is out of range ' &
                  //'beside the other numbers: leave it out')
    end if
  end subroutine prove_states

  !> Say which states are not `certain`, or not `as_said` by the solution, and why nothing is proved, unless it is.
  pure subroutine report_states(certain, as_said, is_enclosed, is_proved, info)
    logical, intent(in) :: certain(:), as_said(:), is_enclosed, is_proved
    type(fuge_info), intent(inout) :: info

    if (is_proved .and. all(certain .and. as_said)) return
    if (is_proved .and. all(certain)) then
      call report(info, info%status, text(count(.not. as_said))//' point(s) are in another state than the solution ' &
                  //'says, the first is point '//index_text(findloc(as_said, .false., 1))//': solve again, or leave ' &
                  //'the states out')
    else if (is_proved) then
      call report(info, info%status, text(count(.not. certain))//' point(s) are so close to the border of two states ' &
                  //'that theirs are not proved, the first is point '//index_text(findloc(certain, .false., 1)))
    else if (is_enclosed) then
      call report(info, FUGE_WARN_NOT_PROVED, 'the states of '//text(count(.not. certain))//' point(s) are not ' &
                  //'certain, the first is point '//index_text(findloc(certain, .false., 1)) &
                  //', and the other ones do not bound the solution: solve to a smaller tolerance')
    else
      call report(info, FUGE_WARN_NOT_PROVED, 'the equations of the points in contact are too badly conditioned to ' &
                  //'be enclosed, or leave a motion free')
    end if
  end subroutine report_states

  !> Enclose the solution of the problem, if `claims` (n) say so much: is_proved. Which signs are `certain` (n)? `stat`
  !> is not 0 without memory.
  subroutine prove_set(contact, claims, enclosure, certain, is_proved, stat)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(out) :: enclosure
    logical, intent(inout) :: certain(:)
    logical, intent(out) :: is_proved
    integer, intent(out) :: stat
    type(set_enclosure) :: wider
    type(verified_inverse) :: inverse
    logical :: now_certain(size(certain))

    certain = claims%at_stop
    call enclose_set(contact, claims, enclosure, stat)
    is_proved = enclosure%is_enclosed
    if (stat /= 0 .or. .not. is_proved) return
    call judge_signs(contact, claims, enclosure, certain)
    is_proved = all(certain)
    if (is_proved .or. .not. all(certain .or. claims%at_stop)) return
    call invert_equations(contact, enclosure, inverse, stat)
    do while (all(certain .or. claims%at_stop) .and. .not. is_proved .and. stat == 0 .and. inverse%is_proved)
      wider = enclosure
      call widen(contact, claims, .not. certain, inverse, wider, is_proved, stat)
      if (stat /= 0 .or. .not. is_proved) return
      call judge_signs(contact, claims, wider, now_certain)
      is_proved = all(now_certain .or. .not. certain)
      certain = certain .and. now_certain
      if (is_proved) enclosure = wider
    end do
  end subroutine prove_set

  !> The inverse of the equations of the enclosure, for step 3. `stat` is not 0 without memory.
  subroutine invert_equations(contact, enclosure, inverse, stat)
    type(scaled_contact), intent(in) :: contact
    type(set_enclosure), intent(in) :: enclosure
    type(verified_inverse), intent(inout) :: inverse
    integer, intent(out) :: stat
    real(dp), allocatable :: matrix(:, :)
    integer :: p

    p = size(enclosure%place) + size(enclosure%motion_place)
    allocate (matrix(p, p), stat=stat)
    if (stat /= 0) return
    call fill_equations(contact, enclosure%place, enclosure%motion_place, matrix)
    ! What the rounding of A + D took is less than the roundings that the inverse counts beyond those of its products.
    call inverse%find(matrix, stat)
  end subroutine invert_equations

  !> Which forces at stops, and which other gaps, are within their ranges?
  pure subroutine judge_signs(contact, claims, enclosure, certain)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(in) :: enclosure
    logical, intent(out) :: certain(:)
    integer :: k

    do k = 1, size(claims)
      certain(k) = is_within(contact, claims(k), enclosure, k)
    end do
  end subroutine judge_signs

  !> Is point `k` within the range of the `claim`?
  pure function is_within(contact, claim, enclosure, k) result(within)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claim
    type(set_enclosure), intent(in) :: enclosure
    integer, intent(in) :: k
    logical :: within
    real(dp) :: ends(2), range(2)

    call find_ranges(contact, claim, enclosure, k, range, ends)
    within = range(1) > ends(1) .and. range(2) < ends(2)
  end function is_within

  !> The range of the force or gap of point `k`, and the ends between which it has to be, in scaled units.
  pure subroutine find_ranges(contact, claim, enclosure, k, range, ends)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claim
    type(set_enclosure), intent(in) :: enclosure
    integer, intent(in) :: k
    real(dp), intent(out) :: range(2), ends(2)
    integer :: power

    if (claim%at_stop) then
      range = enclosure%force_range(k)
      power = -contact%point_power(k) - contact%unit
    else
      range = enclosure%gap_range(k)
      power = contact%point_power(k) - contact%unit
    end if
    ends = [scaled_end(claim%least, power), scaled_end(claim%most, power)]
  end subroutine find_ranges

  !> An end of a range times 2**power, huge where that is out of range, as for an infinite end.
  elemental function scaled_end(value, power) result(scaled)
    real(dp), intent(in) :: value
    integer, intent(in) :: power
    real(dp) :: scaled

    scaled = 0.0_dp
    ! Zero has no exponent.
    if (.not. abs(value) > 0.0_dp) return
    scaled = sign(huge(value), value)
    if (abs(value) < huge(value) .and. exponent(value) + power < maxexponent(value)) scaled = scale(value, power)
  end function scaled_end

  !> Put points whose gaps are not certain at the stop that is next to them.
  pure subroutine put_at_stops(contact, problem, claims, enclosure, certain, states)
    type(scaled_contact), intent(in) :: contact
    type(fuge_problem), intent(in) :: problem
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(in) :: enclosure
    logical, intent(in) :: certain(:)
    integer, intent(inout) :: states(:)
    real(dp) :: ends(2), range(2)
    integer :: k

    do k = 1, size(states)
      if (certain(k) .or. claims(k)%at_stop .or. .not. contact%included(k)) cycle
      if (states(k) /= FUGE_OPEN) then
        states(k) = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, states(k) > FUGE_OPEN)
      else
        call find_ranges(contact, claims(k), enclosure, k, range, ends)
        ! Each end is a stop, and at least one is not infinite: halves do not overflow.
        states(k) = merge(FUGE_AT_UPPER_STOP, FUGE_AT_LOWER_STOP, &
                          0.5_dp*range(1) + 0.5_dp*range(2) > 0.5_dp*ends(1) + 0.5_dp*ends(2))
      end if
      states(k) = state_by_law(problem%law(k), states(k))
    end do
  end subroutine put_at_stops

  !> Step 3: widen the `enclosure` of points at stops, of which U are `undecided` (n), to enclose the solution.
  !> `is_bounded`: the other points hold the bodies. `stat` is not 0 without memory.
  subroutine widen(contact, claims, undecided, inverse, enclosure, is_bounded, stat)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    logical, intent(in) :: undecided(:)
    type(verified_inverse), intent(in) :: inverse
    type(set_enclosure), intent(inout) :: enclosure
    logical, intent(out) :: is_bounded
    integer, intent(out) :: stat
    type(verified_inverse) :: schur
    real(dp), allocatable :: block(:, :), error(:, :), gap(:), least_change(:), norms(:, :)
    integer, allocatable :: among(:)
    real(dp) :: largest, norm
    integer :: j, u

    is_bounded = .false.
    u = count(undecided(enclosure%place))
    allocate (among(u), block(u, u), error(u, u), gap(u), least_change(u), norms(u, u), stat=stat)
    if (stat /= 0) return
    among(:) = pack([(j, j=1, size(enclosure%place))], undecided(enclosure%place))
    do j = 1, u
      associate (column_error => inverse%column_error(among(j)))
        error(:, j) = column_error(among)
      end associate
      block(:, j) = inverse%approximate(among, among(j))
      least_change(j) = distance_from_range(contact, claims, enclosure, enclosure%place(among(j)))
    end do
    call schur%find(block, stat, error)
    is_bounded = schur%is_proved
    if (stat /= 0 .or. .not. is_bounded) return
    do j = 1, u
      norms(:, j) = raised(abs(schur%approximate(:, j)) + schur%column_error(j), 2)
    end do
    ! As fractions of the largest, squares do not underflow.
    largest = maxval(least_change)
    least_change = raised(least_change/largest, 1) + LEAST
    norm = raised(sqrt(raised(dot_product(least_change, matmul(norms, least_change)), 2*u + 4)), 2)
    norm = raised(largest*norm, 1)
    gap = [(raised(norm*sqrt(norms(j, j)), 4), j=1, u)]
    call add_changes(contact, inverse, among, gap, norm, enclosure)
  end subroutine widen

  !> How far the force of point `k` may be out of its range, in scaled units.
  pure function distance_from_range(contact, claims, enclosure, k) result(distance)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(in) :: enclosure
    integer, intent(in) :: k
    real(dp) :: distance
    real(dp) :: ends(2), range(2)

    call find_ranges(contact, claims(k), enclosure, k, range, ends)
    distance = raised(max(ends(1) - range(1), range(2) - ends(2), 0.0_dp), 2) + LEAST
  end function distance_from_range

  !> Add to the radii what the solution may differ, if the gaps of the points number `among` of those at stops do by at
  !> most `gap`, and their forces by at most `norm` in the norm of their Schur complement.
  subroutine add_changes(contact, inverse, among, gap, norm, enclosure)
    type(scaled_contact), intent(in) :: contact
    type(verified_inverse), intent(in) :: inverse
    integer, intent(in) :: among(:)
    real(dp), intent(in) :: gap(:), norm
    type(set_enclosure), intent(inout) :: enclosure
    real(dp) :: change(size(inverse%approximate, 1)), error(size(change)), most
    type(set_enclosure) :: column
    integer :: i, j

    change = 0.0_dp
    column = enclosure
    associate (k => size(enclosure%place))
      do j = 1, size(among)
        error = inverse%column_error(among(j))
        change = change + raised(abs(inverse%approximate(:, among(j))) + error, 2)*gap(j)
        call column%spread(inverse%approximate(:, among(j)), error)
        call add_columns(contact, column%force_change, column%motion_change, column%force_radius, &
                         column%motion_radius, column%gap_change, column%gap_radius)
        enclosure%gap_radius = raised(enclosure%gap_radius + raised(abs(column%gap_change) + column%gap_radius, 2) &
                                      *gap(j), 3)
      end do
      change = raised(change, 2*size(among) + 2)
      ! No diagonal element of the inverse of a positive definite matrix is less than that of its part.
      do i = 1, k
        error = inverse%column_error(i)
        most = raised(norm*sqrt(raised(abs(inverse%approximate(i, i)) + error(i), 2)), 4)
        change(i) = min(change(i), most)
      end do
      enclosure%force_radius(enclosure%place) = raised(enclosure%force_radius(enclosure%place) + change(:k), 2)
      enclosure%motion_radius(enclosure%motion_place) = raised(enclosure%motion_radius(enclosure%motion_place) &
                                                               + change(k + 1:), 2)
      enclosure%gap_radius(enclosure%place) = 0.0_dp
      enclosure%gap_radius(enclosure%place(among)) = gap
    end associate
  end subroutine add_changes

  !> The bounds, in the caller's units.
  pure subroutine fill_proof(contact, problem, solution, claims, enclosure, proof)
    type(scaled_contact), intent(in) :: contact
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(in) :: enclosure
    type(fuge_proof), intent(inout) :: proof
    real(dp) :: motion(contact%motions)

    proof%force_bound = contact%force_of(raised(abs(enclosure%force_change) + enclosure%force_radius, 2))
    proof%gap_bound = contact%length_of(raised(abs(enclosure%gap_change) + enclosure%gap_radius, 2))
    proof%motion_bound = contact%motion_of(raised(abs(enclosure%motion_change) + enclosure%motion_radius, 2))
    ! Claimed numbers may differ from those that the states give.
    where (claims%at_stop)
      proof%gap_bound = raised(proof%gap_bound + abs(solution%gap - claims%known), 3)
    else where
      proof%force_bound = raised(proof%force_bound + abs(solution%force - claims%known), 3)
    end where
    motion = solution%motion
    if (allocated(problem%prescribed)) where (problem%prescribed) motion = problem%motion
    proof%motion_bound = raised(proof%motion_bound + abs(solution%motion - motion), 3)
  end subroutine fill_proof

end module fuge_matrix_proof
