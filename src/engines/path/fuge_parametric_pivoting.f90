!> Parametric pivoting: a contact along a straight line of problems, without steps.
!>
!> Gaps and resultants change linearly with a parameter t. Between two events forces,
!> gaps and motions are linear in t too. An event is a t at which points come to a stop
!> or leave it. Which they are when several could at once, and how the next piece runs,
!> is a small contact problem in the rates for the points that are at a stop without
!> force. Where no such rates exist the motions that nothing holds jump.
module fuge_parametric_pivoting
  use fuge_block_pivoting, only: PATIENCE, keep_first
  use fuge_kkt_factor, only: contact_factor
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_free_modes, only: find_loose, without_loose
  use fuge_canonical_problem, only: canonical_problem
  use fuge_kkt_solution, only: solve_set, displaced, add_deflection
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: follow_line, start_at, states_at

  !> Rates below this part of the largest are zero, and parameters that agree to it are
  !> one event.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-12_dp
  !> A resultant below this part of all is none in a loose motion.
  real(dp), parameter :: NO_LOAD = 1.0e-10_dp

  !> The line: gaps shape + t*shape_rate, resultants load + t*load_rate, those at t = 0
  !> from the scene, up to t = most. Parameters are as exact as t + origin.
  type, public :: path_line
    real(dp), allocatable :: reduced_gap_rate(:), load_rate(:)
    real(dp) :: most = 0.0_dp, origin = 0.0_dp
  end type path_line

  !> Values at t, and their rates from there on. `state` (n) is 1 at the lower stop, -1 at
  !> the upper one, 0 between; `undecided` (n) the stop at which a point without force
  !> may stay or not, 0 for all others.
  type, public :: path_position
    real(dp) :: t = 0.0_dp
    integer, allocatable :: state(:), undecided(:)
    real(dp), allocatable :: force(:), gap(:), motion(:), force_rate(:), gap_rate(:), motion_rate(:)
    !> Motions that the points at their stops leave free, (m, those).
    real(dp), allocatable :: loose(:, :)
  end type path_position

  !> The events in their order, after an entry for the start.
  type, public :: path_record
    integer :: entries = 0
    !> Sides (n) at the start.
    integer, allocatable :: start(:)
    !> For each entry: t, the point and its new side (both 0 for the start), points at a
    !> stop; motions (m) and their rates from there on.
    real(dp), allocatable :: parameter(:), motion(:, :), rate(:, :)
    integer, allocatable :: point(:), state(:), contacts(:)
  end type path_record

contains

  !> Stand at the start of a line: values of the scene's answer with `state` (n), `force`
  !> (n), `motion` (m), and `gap` (n) as they follow from it. Error: FUGE_ERR_MEMORY.
  subroutine start_at(canonical, state, force, gap, motion, here, status)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:), gap(:), motion(:)
    type(path_position), intent(out) :: here
    integer, intent(out) :: status
    real(dp) :: length(size(state))
    integer :: j, m, n, stat

    n = size(state)
    m = size(motion)
    allocate (here%state(n), here%undecided(n), here%force(n), here%gap(n), here%motion(m), here%force_rate(n), &
              here%gap_rate(n), here%motion_rate(m), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    here%state = state
    here%force = force
    here%gap = gap
    here%motion = motion
    length = abs(canonical%gap)
    do j = 1, m
      length = length + abs(canonical%modes(:, j)*motion(j))
    end do
    here%undecided = 0
    where (state /= 0 .and. canonical%upper > 0.0_dp)
      where (abs(force) <= TIE_TOLERANCE*maxval(abs(force))) here%undecided = state
    end where
    where (state == 0 .and. .not. canonical%excluded)
      where (canonical%upper - gap <= TIE_TOLERANCE*length) here%undecided = -1
      where (gap <= TIE_TOLERANCE*length) here%undecided = 1
    end where
  end subroutine start_at

  !> Follow the line from where `here` stands to its end, or as far as it goes.
  !>
  !> `alpha` (at least n rows, n columns), `datum` its coefficient nearest to zero, or 0
  !> unless the scene has a translation. `here` and `record` stay where the path ended.
  !> Errors: those of a factor, FUGE_ERR_MEMORY, FUGE_ERR_NO_EQUILIBRIUM beyond here%t,
  !> FUGE_ERR_ITERATION_LIMIT after more events than 50 for each point.
  subroutine follow_line(alpha, datum, canonical, line, here, record, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(path_line), intent(in) :: line
    type(path_position), intent(inout) :: here
    type(path_record), intent(inout) :: record
    integer, intent(out) :: status
    type(contact_factor) :: factor
    integer :: before(size(here%state))
    real(dp) :: step
    integer :: turn

    call grow(record, size(before) + 8, size(here%motion), status)
    if (status /= FUGE_DONE) return
    allocate (record%start(size(before)))
    record%start = here%state
    do turn = 1, ITERATIONS_PER_ROW*(size(before) + 1)
      before = here%state
      call move_freely(canonical, line%load_rate, here, status)
      if (status == FUGE_DONE) call find_rates(alpha, datum, canonical, line, factor, here, status)
      if (status == FUGE_DONE .and. turn == 1) call note(record, here, 0, status)
      if (status == FUGE_DONE) call note_changes(record, here, before, status)
      if (status /= FUGE_DONE) return
      call next_event(canonical, line, here, step)
      if (.not. here%t + step < line%most - tie_width(line, line%most)) return
      call go_on(alpha, datum, canonical, line, factor, step, here)
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine follow_line

  !> Parameters near t that differ by less are one.
  pure function tie_width(line, t) result(width)
    type(path_line), intent(in) :: line
    real(dp), intent(in) :: t
    real(dp) :: width

    width = TIE_TOLERANCE*(t + line%origin)
  end function tie_width

  !> Where the points with force do not hold all motions and those without cannot carry
  !> the change of the load, the bodies move at no change of force until they can.
  subroutine move_freely(canonical, load_rate, here, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: load_rate(:)
    type(path_position), intent(inout) :: here
    integer, intent(out) :: status
    real(dp) :: force(size(here%state)), way(size(load_rate))
    logical :: held(size(here%state))
    integer :: turn

    status = FUGE_DONE
    if (size(load_rate) < 1) return
    do turn = 1, ITERATIONS_PER_ROW*(size(held) + 1)
      held = here%state /= 0 .and. here%undecided == 0
      call find_loose(canonical%modes, held, here%loose)
      if (size(here%loose, 2) < 1) return
      call find_equilibrium(canonical%modes, load_rate, held .or. here%undecided > 0, held .or. here%undecided < 0, &
                            force, &
                            way)
      if (.not. any(abs(way) > 0.0_dp)) return
      call move_along(canonical, way, held, here, status)
      if (status /= FUGE_DONE) return
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine move_freely

  !> Move as far along `way` (m) as the stops allow; FUGE_ERR_NO_EQUILIBRIUM if none does.
  subroutine move_along(canonical, way, held, here, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: way(:)
    logical, intent(in) :: held(:)
    type(path_position), intent(inout) :: here
    integer, intent(out) :: status
    real(dp) :: closing(size(held)), reach(size(held)), least

    closing = displaced(canonical%modes, way)
    where (held .or. canonical%excluded) closing = 0.0_dp
    where (abs(closing) <= TIE_TOLERANCE*maxval(abs(closing))) closing = 0.0_dp
    ! No point is pressed into the stop where it is: that is rounding.
    where (closing*real(here%undecided, dp) > 0.0_dp) closing = 0.0_dp
    reach = huge(least)
    where (closing > 0.0_dp) reach = max(here%gap, 0.0_dp)/closing
    where (closing < 0.0_dp .and. canonical%upper < huge(least)) reach = max(canonical%upper - here%gap, &
        0.0_dp)/abs(closing)
    least = minval(reach)
    status = merge(FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, least < huge(least))
    if (status /= FUGE_DONE) return
    here%motion = here%motion + least*way
    where (abs(closing) > 0.0_dp)
      here%gap = here%gap - least*closing
      here%state = 0
      here%force = 0.0_dp
      here%undecided = 0
    end where
    where (reach <= least*(1.0_dp + TIE_TOLERANCE)) here%undecided = merge(1, -1, closing > 0.0_dp)
  end subroutine move_along

  !> The rates per unit of t. Points with force stay at their stop, open ones stay open;
  !> for the undecided the rates satisfy a contact problem, solved by block pivoting with
  !> single changes as the way out.
  subroutine find_rates(alpha, datum, canonical, line, factor, here, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(path_line), intent(in) :: line
    type(contact_factor), intent(inout) :: factor
    type(path_position), intent(inout) :: here
    integer, intent(out) :: status
    logical :: wrong(size(here%state))
    integer :: trial, fewest, patience_left

    where (here%undecided /= 0) here%state = here%undecided
    fewest = huge(fewest)
    patience_left = PATIENCE
    do trial = 1, ITERATIONS_PER_ROW*(count(here%undecided /= 0) + 1)
      call factor%set(alpha, canonical%modes, canonical%has_translation, here%state /= 0, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, line%reduced_gap_rate, line%load_rate, here%force_rate, here%motion_rate)
      call find_loose(canonical%modes, here%state /= 0, here%loose)
      if (is_balanced(line%load_rate, here%loose)) here%motion_rate = without_loose(here%motion_rate, here%loose)
      here%gap_rate = line%reduced_gap_rate - displaced(canonical%modes, here%motion_rate)
      call add_deflection(alpha, datum, here%state /= 0, here%force_rate, here%gap_rate)
      where (here%state /= 0 .or. canonical%excluded) here%gap_rate = 0.0_dp
      wrong = here%undecided /= 0 .and. merge(is_falling(here%undecided*here%force_rate), &
                                              is_falling(here%undecided*here%gap_rate), here%state /= 0)
      if (.not. any(wrong)) return
      patience_left = patience_left - 1
      if (count(wrong) < fewest) patience_left = PATIENCE
      fewest = min(fewest, count(wrong))
      if (patience_left < 0) call keep_first(wrong)
      where (wrong) here%state = here%undecided - here%state
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine find_rates

  !> Does the load leave the loose motions alone, but for rounding?
  pure function is_balanced(load_rate, loose) result(balanced)
    real(dp), intent(in) :: load_rate(:), loose(:, :)
    logical :: balanced

    balanced = .true.
    if (size(loose, 2) > 0) balanced = maxval(abs(matmul(load_rate, loose))) <= NO_LOAD*maxval(abs(load_rate))
  end function is_balanced

  pure function is_falling(rate) result(falling)
    real(dp), intent(in) :: rate(:)
    logical :: falling(size(rate))

    falling = rate < -TIE_TOLERANCE*maxval(abs(rate))
  end function is_falling

  !> How far it is to the next event, and the points that could change at it.
  subroutine next_event(canonical, line, here, step)
    type(canonical_problem), intent(in) :: canonical
    type(path_line), intent(in) :: line
    type(path_position), intent(inout) :: here
    real(dp), intent(out) :: step
    real(dp) :: reach(size(here%state))
    logical :: open(size(here%state)), reached(size(here%state))

    reach = huge(step)
    open = here%state == 0 .and. .not. canonical%excluded
    where (here%state /= 0 .and. canonical%upper > 0.0_dp)
      where (is_falling(here%state*here%force_rate)) reach = max(here%state*here%force, 0.0_dp)/abs(here%force_rate)
    end where
    where (open .and. is_falling(here%gap_rate)) reach = max(here%gap, 0.0_dp)/abs(here%gap_rate)
    where (open .and. is_falling(-here%gap_rate) .and. canonical%upper < huge(step))
      reach = max(canonical%upper - here%gap, 0.0_dp)/abs(here%gap_rate)
    end where
    step = minval(reach)
    reached = reach < huge(step)
    if (step < huge(step)) reached = reached .and. reach - step <= tie_width(line, here%t + step)
    ! Points of an event that is no more than rounding away are of this one too.
    if (step > tie_width(line, here%t + step)) here%undecided = 0
    where (reached) here%undecided = merge(here%state, merge(1, -1, here%gap_rate < 0.0_dp), here%state /= 0)
  end subroutine next_event

  !> Values further on, solved anew but for motions that nothing holds.
  subroutine go_on(alpha, datum, canonical, line, factor, step, here)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, step
    type(canonical_problem), intent(in) :: canonical
    type(path_line), intent(in) :: line
    type(contact_factor), intent(in) :: factor
    type(path_position), intent(inout) :: here
    real(dp) :: residual(size(here%state)), correction(size(here%state))
    real(dp) :: missing(size(here%motion)), shift(size(here%motion))

    here%t = here%t + step
    where (here%state == 0) here%force = 0.0_dp
    here%force = here%force + step*here%force_rate
    here%motion = here%motion + step*here%motion_rate
    missing = canonical%load + here%t*line%load_rate - matmul(here%force, canonical%modes)
    residual = gaps_at(alpha, datum, canonical, line, here)
    where (here%state < 0) residual = residual - canonical%upper
    call solve_set(factor, datum, residual, missing, correction, shift)
    here%force = here%force + correction
    here%motion = here%motion + without_loose(shift, here%loose)
    here%gap = gaps_at(alpha, datum, canonical, line, here)
    where (here%state /= 0) here%gap = merge(0.0_dp, canonical%upper, here%state > 0)
  end subroutine go_on

  !> c = g + A f - R q, (n).
  pure function gaps_at(alpha, datum, canonical, line, here) result(gap)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(path_line), intent(in) :: line
    type(path_position), intent(in) :: here
    real(dp) :: gap(size(here%state))

    gap = canonical%gap + here%t*line%reduced_gap_rate - displaced(canonical%modes, here%motion)
    call add_deflection(alpha, datum, here%state /= 0, here%force, gap)
  end function gaps_at

  !> An entry for each point that has changed sides.
  subroutine note_changes(record, here, before, status)
    type(path_record), intent(inout) :: record
    type(path_position), intent(in) :: here
    integer, intent(in) :: before(:)
    integer, intent(out) :: status
    integer :: k

    status = FUGE_DONE
    do k = 1, size(before)
      if (here%state(k) /= before(k)) call note(record, here, k, status)
      if (status /= FUGE_DONE) return
    end do
  end subroutine note_changes

  subroutine note(record, here, point, status)
    type(path_record), intent(inout) :: record
    type(path_position), intent(in) :: here
    integer, intent(in) :: point
    integer, intent(out) :: status

    status = FUGE_DONE
    if (record%entries == size(record%point)) call grow(record, 2*record%entries, size(here%motion), status)
    if (status /= FUGE_DONE) return
    record%entries = record%entries + 1
    associate (last => record%entries)
      record%parameter(last) = here%t
      record%motion(:, last) = here%motion
      record%rate(:, last) = here%motion_rate
      record%point(last) = point
      record%state(last) = 0
      if (point > 0) record%state(last) = here%state(point)
      record%contacts(last) = count(here%state /= 0)
    end associate
  end subroutine note

  subroutine grow(record, capacity, motions, status)
    type(path_record), intent(inout) :: record
    integer, intent(in) :: capacity, motions
    integer, intent(out) :: status
    type(path_record) :: larger
    integer :: stat

    allocate (larger%parameter(capacity), larger%motion(motions, capacity), larger%rate(motions, capacity), &
              larger%point(capacity), larger%state(capacity), larger%contacts(capacity), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    associate (used => record%entries)
      if (used > 0) then
        larger%parameter(:used) = record%parameter(:used)
        larger%motion(:, :used) = record%motion(:, :used)
        larger%rate(:, :used) = record%rate(:, :used)
        larger%point(:used) = record%point(:used)
        larger%state(:used) = record%state(:used)
        larger%contacts(:used) = record%contacts(:used)
      end if
    end associate
    call move_alloc(larger%parameter, record%parameter)
    call move_alloc(larger%motion, record%motion)
    call move_alloc(larger%rate, record%rate)
    call move_alloc(larger%point, record%point)
    call move_alloc(larger%state, record%state)
    call move_alloc(larger%contacts, record%contacts)
  end subroutine grow

  !> Sides (n) after an entry, from those at the start.
  pure function states_at(start, point, state, entry) result(now)
    integer, intent(in) :: start(:), point(:), state(:), entry
    integer :: now(size(start))
    integer :: k

    now = start
    do k = 1, entry
      if (point(k) > 0) now(point(k)) = state(k)
    end do
  end function states_at

end module fuge_parametric_pivoting
