!> The fast engine for a dense matrix: block principal pivoting, with a way down the
!> energy where that does not get on.
!>
!> Solve the equations of a guessed contact set, let every point that violates a sign
!> change sides, repeat (J. J. Judice, F. M. Pires, Computers & Operations Research
!> 21, 1994). When the number of violations has not fallen for a while, go on with
!> pushing forces only, one point joining at a time: the primal active set method
!> (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23), in
!> which the energy falls with every point that joins, so that it ends.
module fuge_block_pivoting
  use fuge_kkt_factor, only: contact_factor
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_canonical_problem, only: canonical_problem
  use fuge_kkt_solution, only: solve_set, displaced, refine, add_deflection, violations, terms_of, largest_term, &
    motion_at_shallowest
  use fuge_blocking_step, only: step_back, pulls
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: run_active_set, keep_first

  !> Violations below this part of the largest force, or of a length, are rounding.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-14_dp
  !> Block changes without progress before single ones.
  integer, parameter, public :: PATIENCE = 3
  !> Violations below this part that are left after single changes are rounding too; a
  !> large spread of the pivots raises it.
  real(dp), parameter :: NOISE = 1.0e-11_dp
  real(dp), parameter :: NOISE_GROWTH = 1.0e-8_dp
  !> Spread of the pivots above which signs are judged after refinement only.
  real(dp), parameter :: ILL_CONDITIONED = 1.0e8_dp

contains

  !> From a guess to the contact set, its forces and gaps.
  !>
  !> `alpha` (at least n rows, n columns); `datum` its coefficient nearest to zero, or 0
  !> unless the scene has a translation; `canonical` the rest of the problem; `state` (n) the
  !> guess, then the answer: 1 at the lower stop, -1 at the upper one, 0 between; `factor`
  !> is that of the set on return; out: `force` (n), `gap_out` (n), `motion` (m).
  !> `iterations` counts the sets tried, `monitor` hears of each, with its worst violation.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_CANCELLED.
  subroutine run_active_set(alpha, datum, canonical, limit, monitor, factor, state, force, gap_out, motion, &
                            iterations, &
                            status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    integer, intent(inout) :: state(:)
    real(dp), intent(out) :: force(:), gap_out(:), motion(:)
    integer, intent(out) :: iterations, status
    real(dp) :: reduced_gap(size(state)), terms(size(state)), violation(size(state)), distance(size(state)), base, &
      zero_force
    logical :: wrong(size(state)), careful, fresh
    integer :: fewest, patience_left

    base = 0.0_dp
    if (canonical%has_translation) base = minval(canonical%gap, mask=.not. canonical%excluded)
    reduced_gap = canonical%gap - base
    zero_force = rounding_force(alpha, reduced_gap, canonical)
    where (canonical%excluded) state = 0
    where (canonical%upper <= 0.0_dp .and. .not. canonical%excluded) state = 1
    fewest = huge(fewest)
    patience_left = PATIENCE
    iterations = 0
    careful = .false.
    fresh = .true.
    do
      call factor%set(alpha, canonical%modes, canonical%has_translation, state /= 0, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, at_stops(reduced_gap, canonical%upper, state), canonical%load, force, motion)
      if (fresh) iterations = iterations + 1
      careful = careful .or. factor%spread > ILL_CONDITIONED .or. factor%ridge > 0.0_dp
      if (careful) then
        if (canonical%has_translation) then
          ! Gaps are counted from where the bodies meet: one point far below the others
          ! would cost them digits.
          base = canonical%gap(minloc(abs(reduced_gap - displaced(canonical%modes, motion)), dim=1, &
                                      mask=.not. canonical%excluded))
          reduced_gap = canonical%gap - base
          call solve_set(factor, datum, at_stops(reduced_gap, canonical%upper, state), canonical%load, force, motion)
        end if
        call refine(alpha, datum, canonical%modes, at_stops(reduced_gap, canonical%upper, state), canonical%load, &
                    factor, factor%ridge, &
                    state /= 0, force, motion)
      end if
      distance = reduced_gap - displaced(canonical%modes, motion)
      gap_out = distance
      call add_deflection(alpha, datum, state /= 0, force, gap_out)
      if (careful) then
        terms = terms_of(alpha, datum, state /= 0, force)
      else
        terms = largest_term(alpha, datum, force)
      end if
      violation = violations(distance, terms, state, canonical%upper, canonical%excluded, zero_force, force, gap_out)
      if (fresh) call tell_monitor(monitor, iterations, maxval(violation), count(state /= 0), status)
      if (status /= FUGE_DONE) return
      fresh = .false.
      wrong = violation > SIGN_TOLERANCE
      if (.not. any(wrong)) then
        if (careful) exit
        ! Once more with care, before the set is believed.
        careful = .true.
        cycle
      end if
      ! What single changes have left is rounding; the certificate has the last word.
      if (patience_left < 0 .and. maxval(violation) < NOISE*max(1.0_dp, NOISE_GROWTH*factor%spread)) exit
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
      patience_left = patience_left - 1
      if (count(wrong) < fewest .and. patience_left >= 0) patience_left = PATIENCE
      fewest = min(fewest, count(wrong))
      careful = patience_left < PATIENCE
      if (patience_left < 0) then
        call descend(alpha, datum, canonical, reduced_gap, zero_force, limit, monitor, factor, state, force, &
                     iterations, status)
        if (status /= FUGE_DONE) return
      else
        state = changed(state, wrong, gap_out, canonical%upper)
        fresh = .true.
      end if
    end do
    if (factor%ridge > 0.0_dp) call refine(alpha, datum, canonical%modes, at_stops(reduced_gap, canonical%upper, &
        state), canonical%load, &
                                           factor, 0.0_dp, state /= 0, force, motion)
    where (canonical%upper > 0.0_dp) force = real(state, dp)*max(state*force, 0.0_dp)
    where (abs(force) <= zero_force) force = 0.0_dp
    if (canonical%plain) motion(1) = motion_at_shallowest(alpha, datum, reduced_gap, state /= 0, force, motion(1))
    gap_out = reduced_gap - displaced(canonical%modes, motion)
    call add_deflection(alpha, datum, state /= 0, force, gap_out)
    where (.not. canonical%excluded) gap_out = min(max(gap_out, 0.0_dp), canonical%upper)
    gap_out = merge(merge(0.0_dp, canonical%upper, state > 0), gap_out, state /= 0)
    if (canonical%has_translation) motion(1) = motion(1) + base + datum*canonical%load(1)
  end subroutine run_active_set

  !> Without a load there may be no force but rounding to compare forces with: then those
  !> count that displace by a part of the gaps, or of how far points lie beyond their stops
  !> if no motion is free. Otherwise zero.
  pure function rounding_force(alpha, reduced_gap, canonical) result(zero_force)
    real(dp), intent(in) :: alpha(:, :), reduced_gap(:)
    type(canonical_problem), intent(in) :: canonical
    real(dp) :: zero_force
    real(dp) :: length, largest
    integer :: k

    zero_force = 0.0_dp
    if (any(abs(canonical%load) > 0.0_dp)) return
    length = 0.0_dp
    largest = 0.0_dp
    do k = 1, size(reduced_gap)
      largest = max(largest, maxval(abs(alpha(:size(reduced_gap), k))))
      if (canonical%excluded(k)) cycle
      if (size(canonical%load) > 0) then
        length = max(length, abs(reduced_gap(k)))
      else
        length = max(length, -reduced_gap(k), reduced_gap(k) - canonical%upper(k))
      end if
    end do
    if (largest > 0.0_dp) zero_force = SIGN_TOLERANCE*(length/largest)
  end function rounding_force

  !> Gaps less those that the stops leave open.
  pure function at_stops(reduced_gap, upper, state) result(rest)
    real(dp), intent(in) :: reduced_gap(:), upper(:)
    integer, intent(in) :: state(:)
    real(dp) :: rest(size(reduced_gap))

    rest = reduced_gap
    where (state < 0) rest = reduced_gap - upper
  end function at_stops

  !> A point in contact that pulls leaves; an open one beyond a stop comes to it.
  pure function changed(state, wrong, gap_out, upper) result(anew)
    integer, intent(in) :: state(:)
    logical, intent(in) :: wrong(:)
    real(dp), intent(in) :: gap_out(:), upper(:)
    integer :: anew(size(state))

    anew = state
    where (wrong .and. state /= 0) anew = 0
    where (wrong .and. state == 0) anew = merge(1, -1, gap_out < 0.5_dp*upper)
  end function changed

  !> Down the energy: from forces that push at their stops towards the answer of their
  !> set as far as none pulls, then the point furthest beyond a stop joins, until none is.
  !> `force` (n) in: where to start; `state` and `factor` out.
  subroutine descend(alpha, datum, canonical, reduced_gap, zero_force, limit, monitor, factor, state, force, &
                     iterations, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), zero_force
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(inout) :: iterations
    integer, intent(out) :: status
    real(dp) :: wanted(size(reduced_gap)), gap_out(size(reduced_gap)), terms(size(reduced_gap)), &
      distance(size(reduced_gap))
    real(dp) :: motion(size(canonical%load)), beyond(size(reduced_gap)), violation(size(reduced_gap))
    logical :: barred(size(reduced_gap)), wrong(size(reduced_gap)), tied(size(reduced_gap))
    real(dp) :: rounding, last(size(reduced_gap))
    integer :: newest, stalled

    tied = canonical%upper <= 0.0_dp .and. .not. canonical%excluded
    call start_pushing(canonical, state, force)
    barred = .false.
    newest = 0
    stalled = 0
    do
      call factor%set(alpha, canonical%modes, canonical%has_translation, state /= 0, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, at_stops(reduced_gap, canonical%upper, state), canonical%load, wanted, motion)
      call refine(alpha, datum, canonical%modes, at_stops(reduced_gap, canonical%upper, state), canonical%load, &
                  factor, factor%ridge, &
                  state /= 0, wanted, motion)
      iterations = iterations + 1
      distance = reduced_gap - displaced(canonical%modes, motion)
      gap_out = distance
      call add_deflection(alpha, datum, state /= 0, wanted, gap_out)
      terms = terms_of(alpha, datum, state /= 0, wanted)
      violation = violations(distance, terms, state, canonical%upper, canonical%excluded, zero_force, wanted, gap_out)
      call tell_monitor(monitor, iterations, maxval(violation), count(state /= 0), status)
      if (status /= FUGE_DONE) return
      ! A point that holds a motion may pull by rounding: without it the set would be wrong.
      if (all(violation <= SIGN_TOLERANCE)) return
      ! One translation is held by any point; several motions by points that may carry nothing.
      ! Where forces have not moved for long, rounding may lead in a circle.
      rounding = merge(NOISE, SIGN_TOLERANCE, stalled > size(state))
      rounding = merge(0.0_dp, max(rounding*maxval(abs(wanted)), zero_force), canonical%plain)
      last = force
      if (any(pulls(wanted, rounding, state, tied))) then
        call step_back(wanted, rounding, tied, state, force, newest, barred)
      else
        force = wanted
        if (newest > 0) barred = barred .and. barred(newest)
        wrong = state == 0 .and. violation > SIGN_TOLERANCE .and. .not. barred
        if (.not. any(wrong)) return
        beyond = max(-gap_out, gap_out - canonical%upper)
        ! The least index ends circles (Y.-Y. Chang, R. W. Cottle, Mathematical Programming 18, 1980).
        if (stalled > size(state)) beyond = 1.0_dp
        newest = maxloc(beyond, dim=1, mask=wrong)
        state(newest) = merge(1, -1, gap_out(newest) < 0.5_dp*canonical%upper(newest))
      end if
      stalled = merge(stalled + 1, 0, maxval(abs(force - last)) <= NOISE*maxval(abs(force)))
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
    end do
  end subroutine descend

  !> Forces in equilibrium that push at their stops: for the plain problem those there
  !> are, as far as they push, else those that the scene knows.
  pure subroutine start_pushing(canonical, state, force)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(inout) :: state(:)
    real(dp), intent(inout) :: force(:)

    if (canonical%plain) then
      force = max(force, 0.0_dp)
      force = force*(canonical%load(1)/sum(force))
    else
      force = canonical%start
    end if
    state = 0
    where (force > 0.0_dp) state = 1
    where (force < 0.0_dp) state = -1
    where (canonical%upper <= 0.0_dp .and. .not. canonical%excluded) state = 1
  end subroutine start_pushing

  !> Only the true element of least index stays true.
  pure subroutine keep_first(mask)
    logical, intent(inout) :: mask(:)
    integer :: k

    do k = 1, size(mask)
      if (.not. mask(k)) cycle
      mask(k + 1:) = .false.
      return
    end do
  end subroutine keep_first

end module fuge_block_pivoting
