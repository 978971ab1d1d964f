!> Block principal pivoting, the fast engine for a matrix.
!>
!> Solve the equations of a guessed contact set, exchange every point that violates a sign, repeat (J. J. Judice,
!> F. M. Pires, Computers & Operations Research 21, 1994). When the number of violations has not fallen
!> for a while, although points join, the primal active-set method goes on, which ends.
module fuge_block_pivoting
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: translation_at_shallowest
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_primal_active_set, only: run_primal_active_set, NOISE
  use fuge_stall_counter, only: stall_counter
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  use fuge_working_set, only: working_set, SIGN_TOLERANCE
  implicit none
  private

  public :: run_block_pivoting

  !> Block exchanges in a row with points that join, and without a new minimum of wrong points, before single exchanges
  !> begin: an eighth of the number of points, within these bounds. The fewer points, the fewer single exchanges.
  integer, parameter :: LEAST_STALLS = 3, MOST_STALLS = 10
  !> Points whose forces are rounding are left out at most this many times, because others may lose theirs.
  integer, parameter :: MOST_ATTEMPTS = 3
  !> Forces on a singular contact below this fraction of the largest one of the body are rounding.
  real(dp), parameter :: IDLE_FORCE = 1.0e-10_dp
  !> A length up to this fraction of its terms is rounding.
  real(dp), parameter :: NO_LENGTH = 16.0_dp*epsilon(1.0_dp)
  !> Violations that count as rounding grow with the ratio of the pivots, times this factor.
  real(dp), parameter :: NOISE_GROWTH = 1.0e-8_dp
  !> A violation above this fraction of the last one is not on its way to zero.
  real(dp), parameter :: LASTING = 0.5_dp
  !> Ratio of the pivots above which signs are judged after refinement only.
  real(dp), parameter :: ILL_CONDITIONED = 1.0e8_dp

  !> Where the pivoting stands between two sets.
  type :: pivoting_progress
    !> Refine forces and motion before their signs are judged.
    logical :: refine_now = .false.
    !> The set is a new one, not the last one again with refinement.
    logical :: is_new_set = .true.
    !> Of the block exchanges; once they have stalled, single exchanges go on to the end.
    type(stall_counter) :: stalls
    !> The largest violation that the primal active-set method has left.
    real(dp) :: violation_left = huge(1.0_dp)
  end type pivoting_progress

contains

  !> From a guess to the contact set, its forces, gaps and motion.
  !>
  !> `solution` allocated; `solution%state` (n) the guess, then the contact set; `factor` is that of the set on
  !> return. `iterations` counts the sets tried, at most `limit`; `monitor` hears of each, with its largest
  !> violation. With `kept`, the arrays of an earlier call are used again. Errors: FUGE_ERR_MEMORY,
  !> FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CANCELLED.
  subroutine run_block_pivoting(canonical, limit, monitor, factor, solution, iterations, status, kept)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    integer, intent(out) :: iterations, status
    type(working_set), intent(inout), optional :: kept
    type(working_set) :: set

    if (present(kept)) then
      call pivot_blocks(canonical, limit, monitor, kept, factor, solution, iterations, status)
    else
      call pivot_blocks(canonical, limit, monitor, set, factor, solution, iterations, status)
    end if
  end subroutine run_block_pivoting

  subroutine pivot_blocks(canonical, limit, monitor, set, factor, solution, iterations, status)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(working_set), intent(inout) :: set
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    integer, intent(out) :: iterations, status
    type(pivoting_progress) :: progress

    iterations = 0
    call progress%stalls%start(min(max(size(solution%state)/8, LEAST_STALLS), MOST_STALLS))
    call set%start(canonical, solution%state, status)
    if (status /= FUGE_DONE) return
    do
      call solve_working_set(canonical, set, progress, factor, solution, status)
      if (status /= FUGE_DONE) return
      if (progress%is_new_set) then
        iterations = iterations + 1
        call tell_monitor(monitor, iterations, maxval(set%violation), count(solution%state /= FUGE_OPEN), status)
        if (status /= FUGE_DONE) return
      end if
      progress%is_new_set = .false.
      if (all(set%violation <= SIGN_TOLERANCE) .and. .not. progress%refine_now) then
        ! Refine before the set is accepted.
        progress%refine_now = .true.
        call refine_working_set(canonical, set, factor, solution)
      end if
      if (all(set%violation <= SIGN_TOLERANCE)) then
        if (progress%stalls%has_stalled() .or. canonical%is_carried_by(solution%force)) exit
        ! Soft springs carry the rest of the load, because the motions that it causes close no gap.
        call progress%stalls%give_up()
      else
        if (is_noise(set, progress, factor)) exit
        if (progress%stalls%has_stalled()) then
          ! A violation that the primal active-set method leaves twice is rounding of gaps and motions.
          if (maxval(set%violation) > LASTING*progress%violation_left) exit
          progress%violation_left = maxval(set%violation)
        end if
        call count_progress(set%violation > SIGN_TOLERANCE, .not. set%contact, progress)
      end if
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
      if (progress%stalls%has_stalled()) then
        call run_primal_active_set(canonical, limit, monitor, set, factor, solution, iterations, status)
        if (status /= FUGE_DONE) return
      else
        call exchange_violating(canonical, set, solution)
        progress%is_new_set = .true.
      end if
    end do
    call remove_rounding(canonical, set, factor, solution)
  end subroutine pivot_blocks

  !> Factor the set, solve its equations, refine where that is called for, and measure the violations.
  subroutine solve_working_set(canonical, set, progress, factor, solution, status)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(inout) :: set
    type(pivoting_progress), intent(inout) :: progress
    type(kkt_factor), intent(inout) :: factor
    type(contact_solution), intent(inout) :: solution
    integer, intent(out) :: status

    call set%mark(canonical, solution%state)
    call factor%set(canonical, set%contact, status)
    if (status /= FUGE_DONE) return
    call set%solve(canonical, factor, solution)
    progress%refine_now = progress%refine_now .or. factor%pivot_ratio > ILL_CONDITIONED &
      .or. factor%regularisation > 0.0_dp
    if (progress%refine_now) then
      call refine_working_set(canonical, set, factor, solution)
    else
      call set%measure(canonical, .false., solution)
    end if
  end subroutine solve_working_set

  !> Refine the solution of the set and measure its violations exactly.
  subroutine refine_working_set(canonical, set, factor, solution)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(inout) :: set
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(inout) :: solution

    if (canonical%has_translation) call set%move_gap_datum(canonical, solution)
    call set%refine(canonical, factor, factor%regularisation, solution)
    call set%measure(canonical, .true., solution)
  end subroutine refine_working_set

  !> Are the violations that the primal active-set method has left no more than rounding? The certificate then decides
  !> about the solution.
  pure function is_noise(set, progress, factor)
    type(working_set), intent(in) :: set
    type(pivoting_progress), intent(in) :: progress
    type(kkt_factor), intent(in) :: factor
    logical :: is_noise

    is_noise = progress%stalls%has_stalled() &
               .and. maxval(set%violation) < NOISE*max(1.0_dp, NOISE_GROWTH*factor%pivot_ratio)
  end function is_noise

  !> Count an exchange of the `wrong` points (n), of which the `open` ones join. An exchange that only opens points is
  !> no stall: as long as none joins, the contact shrinks, be it by a layer of points at a time, and no set comes again.
  pure subroutine count_progress(wrong, open, progress)
    logical, intent(in) :: wrong(:), open(:)
    type(pivoting_progress), intent(inout) :: progress

    if (any(wrong .and. open)) call progress%stalls%spend()
    if (.not. progress%stalls%has_stalled()) call progress%stalls%renew_if_fewer(count(wrong))
    progress%refine_now = progress%stalls%left < progress%stalls%limit
  end subroutine count_progress

  !> Every point that violates the conditions of its state goes to the next one.
  pure subroutine exchange_violating(canonical, set, solution)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(inout) :: solution
    integer :: k

    do k = 1, size(set%violation)
      if (set%violation(k) <= SIGN_TOLERANCE) cycle
      solution%state(k) = canonical%next_state(k, solution%state(k), solution%force(k), solution%gap(k))
    end do
  end subroutine exchange_violating

  !> Take rounding out of forces, gaps and motion of the accepted set.
  subroutine remove_rounding(canonical, set, factor, solution)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(inout) :: set
    type(kkt_factor), intent(in) :: factor
    type(contact_solution), intent(inout) :: solution
    real(dp) :: before(size(solution%force))

    before = solution%force
    if (factor%regularisation > 0.0_dp) then
      call set%refine(canonical, factor, 0.0_dp, solution)
      call solve_without_idle(canonical, set, solution)
    end if
    call set%estimate_error(canonical, factor, solution)
    solution%violation = maxval(set%violation)
    associate (state => solution%state, force => solution%force, motion => solution%motion)
      call canonical%keep_in_range(state, force)
      where (abs(force) <= set%zero_force .and. abs(state) < 2) force = 0.0_dp
      if (canonical%plain) then
        motion(1) = translation_at_shallowest(canonical%alpha, canonical%datum, set%reduced_gap, set%contact, force, &
                                              motion(1))
      end if
      solution%force_error = solution%force_error + maxval(abs(force - before))
      ! A motion is rounding then.
      if (set%has_no_length(canonical)) motion = 0.0_dp
      if (any(abs(force - before) > 0.0_dp)) call set%measure(canonical, .false., solution)
      call set%find_gaps(canonical, solution)
      call canonical%keep_beyond_stops(state, solution%gap)
      if (canonical%has_translation) motion(1) = motion(1) + set%gap_datum + canonical%datum*canonical%load(1)
    end associate
  end subroutine remove_rounding

  !> Solve anew without the points of a singular contact whose forces are rounding, if they stay at their stops: these
  !> forces, or what is taken from them where they pull, would displace the others.
  subroutine solve_without_idle(canonical, set, solution)
    type(canonical_problem), intent(in) :: canonical
    type(working_set), intent(in) :: set
    type(contact_solution), intent(inout) :: solution
    type(contact_solution) :: trial
    type(working_set) :: loaded
    type(kkt_factor) :: factor
    logical :: idle(size(solution%state))
    integer :: attempt, left_out, status

    trial = solution
    left_out = 0
    do attempt = 1, MOST_ATTEMPTS
      where (canonical%upper > 0.0_dp .and. &
             trial%state*trial%force <= IDLE_FORCE*canonical%force_scale(trial%force)) trial%state = FUGE_OPEN
      idle = solution%state /= trial%state
      if (count(idle) == left_out) return
      left_out = count(idle)
      call loaded%start(canonical, trial%state, status)
      if (status /= FUGE_DONE) return
      call loaded%mark(canonical, trial%state)
      call factor%set(canonical, loaded%contact, status)
      if (status /= FUGE_DONE) return
      call loaded%solve(canonical, factor, trial)
      call loaded%refine(canonical, factor, factor%regularisation, trial)
      call loaded%refine(canonical, factor, 0.0_dp, trial)
      call loaded%measure(canonical, .true., trial)
      if (all(idle .or. loaded%violation <= SIGN_TOLERANCE)) exit
    end do
    if (any(loaded%violation > SIGN_TOLERANCE .and. .not. idle)) return
    if (.not. (canonical%is_carried_by(trial%force) .and. stays_closed(canonical, idle, solution, trial))) return
    solution%force = trial%force
    solution%motion = trial%motion
    if (canonical%has_translation) then
      solution%motion(1) = solution%motion(1) + (loaded%gap_datum - set%gap_datum)
    end if
  end subroutine solve_without_idle

  !> Are the gaps of the `idle` points (n) in `trial` still those of their stops in `solution`, but for rounding?
  pure function stays_closed(canonical, idle, solution, trial) result(closed)
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: idle(:)
    type(contact_solution), intent(in) :: solution, trial
    logical :: closed
    real(dp) :: stop_distance(size(idle)), length

    stop_distance = trial%gap
    where (solution%state < FUGE_OPEN) stop_distance = trial%gap - canonical%upper
    length = canonical%survey%largest()*sum(abs(trial%force))
    closed = all(abs(stop_distance) <= NO_LENGTH*(length + abs(canonical%gap)) .or. .not. idle)
  end function stays_closed

end module fuge_block_pivoting
