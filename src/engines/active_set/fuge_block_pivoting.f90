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
  use fuge_canonical_problem, only: contact_scene
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
  !> unless the scene has a translation; `scene` the rest of the problem; `side` (n) the
  !> guess, then the answer: 1 at the lower stop, -1 at the upper one, 0 between; `factor`
  !> is that of the set on return; out: `force` (n), `gap_out` (n), `motion` (m).
  !> `iterations` counts the sets tried, `monitor` hears of each, with its worst violation.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_CANCELLED.
  subroutine run_active_set(alpha, datum, scene, limit, monitor, factor, side, force, gap_out, motion, iterations, &
                            status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    integer, intent(inout) :: side(:)
    real(dp), intent(out) :: force(:), gap_out(:), motion(:)
    integer, intent(out) :: iterations, status
    real(dp) :: shape(size(side)), terms(size(side)), violation(size(side)), distance(size(side)), base, nothing
    logical :: wrong(size(side)), careful, fresh
    integer :: fewest, patience_left

    base = 0.0_dp
    if (scene%constant) base = minval(scene%gap, mask=.not. scene%excluded)
    shape = scene%gap - base
    nothing = rounding_force(alpha, shape, scene)
    where (scene%excluded) side = 0
    where (scene%upper <= 0.0_dp .and. .not. scene%excluded) side = 1
    fewest = huge(fewest)
    patience_left = PATIENCE
    iterations = 0
    careful = .false.
    fresh = .true.
    do
      call factor%set(alpha, scene%modes, scene%constant, side /= 0, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, at_stops(shape, scene%upper, side), scene%load, force, motion)
      if (fresh) iterations = iterations + 1
      careful = careful .or. factor%spread > ILL_CONDITIONED .or. factor%ridge > 0.0_dp
      if (careful) then
        if (scene%constant) then
          ! Gaps are counted from where the bodies meet: one point far below the others
          ! would cost them digits.
          base = scene%gap(minloc(abs(shape - displaced(scene%modes, motion)), dim=1, mask=.not. scene%excluded))
          shape = scene%gap - base
          call solve_set(factor, datum, at_stops(shape, scene%upper, side), scene%load, force, motion)
        end if
        call refine(alpha, datum, scene%modes, at_stops(shape, scene%upper, side), scene%load, factor, factor%ridge, &
                    side /= 0, force, motion)
      end if
      distance = shape - displaced(scene%modes, motion)
      gap_out = distance
      call add_deflection(alpha, datum, side /= 0, force, gap_out)
      if (careful) then
        terms = terms_of(alpha, datum, side /= 0, force)
      else
        terms = largest_term(alpha, datum, force)
      end if
      violation = violations(distance, terms, side, scene%upper, scene%excluded, nothing, force, gap_out)
      if (fresh) call tell_monitor(monitor, iterations, maxval(violation), count(side /= 0), status)
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
        call descend(alpha, datum, scene, shape, nothing, limit, monitor, factor, side, force, iterations, status)
        if (status /= FUGE_DONE) return
      else
        side = changed(side, wrong, gap_out, scene%upper)
        fresh = .true.
      end if
    end do
    if (factor%ridge > 0.0_dp) call refine(alpha, datum, scene%modes, at_stops(shape, scene%upper, side), scene%load, &
                                           factor, 0.0_dp, side /= 0, force, motion)
    where (scene%upper > 0.0_dp) force = real(side, dp)*max(side*force, 0.0_dp)
    where (abs(force) <= nothing) force = 0.0_dp
    if (scene%plain) motion(1) = motion_at_shallowest(alpha, datum, shape, side /= 0, force, motion(1))
    gap_out = shape - displaced(scene%modes, motion)
    call add_deflection(alpha, datum, side /= 0, force, gap_out)
    where (.not. scene%excluded) gap_out = min(max(gap_out, 0.0_dp), scene%upper)
    gap_out = merge(merge(0.0_dp, scene%upper, side > 0), gap_out, side /= 0)
    if (scene%constant) motion(1) = motion(1) + base + datum*scene%load(1)
  end subroutine run_active_set

  !> Without a load there may be no force but rounding to compare forces with: then those
  !> count that displace by a part of the gaps, or of how far points lie beyond their stops
  !> if no motion is free. Otherwise zero.
  pure function rounding_force(alpha, shape, scene) result(nothing)
    real(dp), intent(in) :: alpha(:, :), shape(:)
    type(contact_scene), intent(in) :: scene
    real(dp) :: nothing
    real(dp) :: length, largest
    integer :: k

    nothing = 0.0_dp
    if (any(abs(scene%load) > 0.0_dp)) return
    length = 0.0_dp
    largest = 0.0_dp
    do k = 1, size(shape)
      largest = max(largest, maxval(abs(alpha(:size(shape), k))))
      if (scene%excluded(k)) cycle
      if (size(scene%load) > 0) then
        length = max(length, abs(shape(k)))
      else
        length = max(length, -shape(k), shape(k) - scene%upper(k))
      end if
    end do
    if (largest > 0.0_dp) nothing = SIGN_TOLERANCE*(length/largest)
  end function rounding_force

  !> Gaps less those that the stops leave open.
  pure function at_stops(shape, upper, side) result(rest)
    real(dp), intent(in) :: shape(:), upper(:)
    integer, intent(in) :: side(:)
    real(dp) :: rest(size(shape))

    rest = shape
    where (side < 0) rest = shape - upper
  end function at_stops

  !> A point in contact that pulls leaves; an open one beyond a stop comes to it.
  pure function changed(side, wrong, gap_out, upper) result(anew)
    integer, intent(in) :: side(:)
    logical, intent(in) :: wrong(:)
    real(dp), intent(in) :: gap_out(:), upper(:)
    integer :: anew(size(side))

    anew = side
    where (wrong .and. side /= 0) anew = 0
    where (wrong .and. side == 0) anew = merge(1, -1, gap_out < 0.5_dp*upper)
  end function changed

  !> Down the energy: from forces that push at their stops towards the answer of their
  !> set as far as none pulls, then the point furthest beyond a stop joins, until none is.
  !> `force` (n) in: where to start; `side` and `factor` out.
  subroutine descend(alpha, datum, scene, shape, nothing, limit, monitor, factor, side, force, iterations, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, shape(:), nothing
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    integer, intent(inout) :: side(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(inout) :: iterations
    integer, intent(out) :: status
    real(dp) :: wanted(size(shape)), gap_out(size(shape)), terms(size(shape)), distance(size(shape))
    real(dp) :: motion(size(scene%load)), beyond(size(shape)), violation(size(shape))
    logical :: barred(size(shape)), wrong(size(shape)), tied(size(shape))
    real(dp) :: rounding, last(size(shape))
    integer :: newest, stalled

    tied = scene%upper <= 0.0_dp .and. .not. scene%excluded
    call start_pushing(scene, side, force)
    barred = .false.
    newest = 0
    stalled = 0
    do
      call factor%set(alpha, scene%modes, scene%constant, side /= 0, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, at_stops(shape, scene%upper, side), scene%load, wanted, motion)
      call refine(alpha, datum, scene%modes, at_stops(shape, scene%upper, side), scene%load, factor, factor%ridge, &
                  side /= 0, wanted, motion)
      iterations = iterations + 1
      distance = shape - displaced(scene%modes, motion)
      gap_out = distance
      call add_deflection(alpha, datum, side /= 0, wanted, gap_out)
      terms = terms_of(alpha, datum, side /= 0, wanted)
      violation = violations(distance, terms, side, scene%upper, scene%excluded, nothing, wanted, gap_out)
      call tell_monitor(monitor, iterations, maxval(violation), count(side /= 0), status)
      if (status /= FUGE_DONE) return
      ! A point that holds a motion may pull by rounding: without it the set would be wrong.
      if (all(violation <= SIGN_TOLERANCE)) return
      ! One translation is held by any point; several motions by points that may carry nothing.
      ! Where forces have not moved for long, rounding may lead in a circle.
      rounding = merge(NOISE, SIGN_TOLERANCE, stalled > size(side))
      rounding = merge(0.0_dp, max(rounding*maxval(abs(wanted)), nothing), scene%plain)
      last = force
      if (any(pulls(wanted, rounding, side, tied))) then
        call step_back(wanted, rounding, tied, side, force, newest, barred)
      else
        force = wanted
        if (newest > 0) barred = barred .and. barred(newest)
        wrong = side == 0 .and. violation > SIGN_TOLERANCE .and. .not. barred
        if (.not. any(wrong)) return
        beyond = max(-gap_out, gap_out - scene%upper)
        ! The least index ends circles (Y.-Y. Chang, R. W. Cottle, Mathematical Programming 18, 1980).
        if (stalled > size(side)) beyond = 1.0_dp
        newest = maxloc(beyond, dim=1, mask=wrong)
        side(newest) = merge(1, -1, gap_out(newest) < 0.5_dp*scene%upper(newest))
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
  pure subroutine start_pushing(scene, side, force)
    type(contact_scene), intent(in) :: scene
    integer, intent(inout) :: side(:)
    real(dp), intent(inout) :: force(:)

    if (scene%plain) then
      force = max(force, 0.0_dp)
      force = force*(scene%load(1)/sum(force))
    else
      force = scene%start
    end if
    side = 0
    where (force > 0.0_dp) side = 1
    where (force < 0.0_dp) side = -1
    where (scene%upper <= 0.0_dp .and. .not. scene%excluded) side = 1
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
