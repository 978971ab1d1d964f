!> The exact course of a contact as its load changes, without load steps: as the load of
!> the plain problem grows from zero, or from one general problem to another.
module fuge_path_types
  use fuge_input_checks, only: check_finite
  use fuge_kkt_factor, only: contact_factor
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_active_set_engine, only: solve_by_active_set
  use fuge_matrix_checks, only: check_magnitudes, check_matrix
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: monitor_relay
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_parametric_pivoting, only: follow_line, start_at, states_at, path_line, path_position, path_record
  use fuge_problem_type, only: fuge_problem, fuge_solution, check_problem, check_load, set_problem
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  use fuge_number_text, only: text
  implicit none
  private

  public :: fuge_load_path, fuge_follow_path

  !> Starting resultants larger than their change by more than this cost parameters no
  !> more digits: ties would be lost, but events that differ kept apart.
  real(dp), parameter :: LARGEST_ORIGIN = 1.0e3_dp

  !> The events in the order of the load. Points that change at the same load have an
  !> entry each; approach, stiffness and contacts are then those after all of them.
  type, public :: fuge_path
    !> Entries in use.
    integer :: events = 0
    !> Load at the event, force; 0 for the points that touch first.
    real(dp), allocatable :: load(:)
    !> Approach v_0 there, length.
    real(dp), allocatable :: approach(:)
    !> dF_0/dv_0 from here to the next event, force per length.
    real(dp), allocatable :: stiffness(:)
    !> The point that joins (> 0) or leaves (< 0).
    integer, allocatable :: point(:)
    !> Points in contact from here on.
    integer, allocatable :: contacts(:)
  contains
    procedure :: contact_set
  end type fuge_path

  !> The events between two general problems, in their order, after an entry for the start.
  !> Points that change together have an entry each; motions, rates and contacts are then
  !> those after all of them.
  type, public :: fuge_general_path
    !> Entries in use, the start included.
    integer :: entries = 0
    !> Sides at the start, (n): 1 at the lower stop (tied points too), -1 at the upper one,
    !> 0 between.
    integer, allocatable :: start(:)
    !> Parameter t of each entry, from 0 at the start to 1 at the end.
    real(dp), allocatable :: parameter(:)
    !> The point that changes, and its new side; both 0 for the start.
    integer, allocatable :: point(:), state(:)
    !> Points at a stop from here on.
    integer, allocatable :: contacts(:)
    !> Motions q there and dq/dt from there to the next entry, (m, entries), prescribed
    !> ones included. Where nothing holds a motion it may jump; the value is that after it.
    real(dp), allocatable :: motion(:, :), rate(:, :)
  contains
    procedure :: states
  end type fuge_general_path

contains

  !> Follow the contact from zero load up to `load`.
  !>
  !> `operator` a fuge_dense_operator with n points, `gap` (n) length, `load` >= 0
  !> force; out: `path`, untouched on an error. Errors: as for a solve, and
  !> FUGE_ERR_ITERATION_LIMIT after more events than 50 for each point.
  subroutine fuge_load_path(operator, gap, load, path, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: gap(:), load
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: problem
    type(fuge_path) :: found

    call set_problem(gap, load, problem, info)
    if (info%failed()) return
    select type (operator)
    class is (fuge_dense_operator)
      if (operator%points() < 1) then
        call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before')
      else
        call check_problem(problem, operator%points(), info)
      end if
      if (.not. info%failed() .and. load > 0.0_dp) call check_matrix(operator%alpha, load, info)
      if (info%failed()) return
      call follow_load(operator, gap, load, found, info)
      if (.not. info%failed()) call take(found, path)
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'the load path needs the coefficients of a fuge_dense_operator')
    end select
  end subroutine fuge_load_path

  subroutine take(found, path)
    type(fuge_path), intent(inout) :: found, path

    path%events = found%events
    call move_alloc(found%load, path%load)
    call move_alloc(found%approach, path%approach)
    call move_alloc(found%stiffness, path%stiffness)
    call move_alloc(found%point, path%point)
    call move_alloc(found%contacts, path%contacts)
  end subroutine take

  !> The points of n in contact after event `event`; for event 0 none.
  pure function contact_set(self, event, n) result(contact)
    class(fuge_path), intent(in) :: self
    integer, intent(in) :: event, n
    logical :: contact(n)
    integer :: k

    contact = .false.
    do k = 1, min(event, self%events)
      contact(abs(self%point(k))) = self%point(k) > 0
    end do
  end function contact_set

  !> From the plain problem without load, whose lowest points just touch.
  subroutine follow_load(operator, gap, load, path, info)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: gap(:), load
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: problem
    type(canonical_problem) :: canonical
    type(path_line) :: line
    type(path_record) :: record
    integer :: k, events

    call set_problem(gap, 0.0_dp, problem, info)
    if (.not. info%failed()) call make_canonical(problem, canonical, info)
    if (info%failed()) return
    line%load_rate = [1.0_dp]
    line%reduced_gap_rate = 0.0_dp*gap
    line%most = load
    call run_line(operator, canonical, line, record, info)
    if (info%failed()) return
    ! The start is no event of its own.
    events = record%entries - 1
    info%iterations = events
    path%events = events
    path%load = record%parameter(2:events + 1)
    path%approach = record%motion(1, 2:events + 1)
    path%stiffness = 1.0_dp/record%rate(1, 2:events + 1)
    path%point = [(merge(1, -1, record%state(k) > 0)*record%point(k), k=2, events + 1)]
    path%contacts = record%contacts(2:events + 1)
  end subroutine follow_load

  !> Follow the contact from a general problem to another with other resultants and
  !> prescribed motions, w(t) = w + t*(finish - w) for t from 0 to 1: every t < 1 at which a
  !> point comes to a stop or leaves it.
  !>
  !> `operator` a fuge_dense_operator with n points; `problem` the start, in equilibrium;
  !> `finish` (m) the resultants at the end, where prescribed the motions; out: `path`,
  !> untouched on an error, info%iterations its events. A motion that nothing holds at the
  !> start begins where it just touches, if the change presses it on. Errors: as for a
  !> solve; FUGE_ERR_NO_EQUILIBRIUM also where the path comes to the edge of equilibrium:
  !> the message has the parameter, short of which a path can end;
  !> FUGE_ERR_ITERATION_LIMIT after more events than 50 for each point.
  subroutine fuge_follow_path(operator, problem, finish, path, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: finish(:)
    type(fuge_general_path), intent(inout) :: path
    type(fuge_info), intent(out) :: info

    select type (operator)
    class is (fuge_dense_operator)
      if (operator%points() < 1) then
        call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before')
      else
        call check_problem(problem, operator%points(), info)
      end if
      if (.not. info%failed()) call check_finish(operator%alpha, problem, finish, info)
      if (.not. info%failed()) call follow_problem(operator, problem, finish, path, info)
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'the path needs the coefficients of a fuge_dense_operator')
    end select
  end subroutine fuge_follow_path

  !> Refuse an end that no path leads to.
  pure subroutine check_finish(alpha, problem, finish, info)
    real(dp), intent(in) :: alpha(:, :), finish(:)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info

    if (size(finish) /= problem%mode_count()) then
      call report(info, FUGE_ERR_SIZE, 'finish has '//text(size(finish))//' value(s): it needs ' &
                  //text(problem%mode_count()))
    else if (size(finish) > 0) then
      call check_finite(finish, 'finish', info)
      if (.not. info%failed()) call check_magnitudes(alpha(:size(alpha, 2), :), maxval(abs(finish)), info)
      if (.not. info%failed() .and. problem%is_plain()) call check_load(finish(1), info)
    end if
  end subroutine check_finish

  !> Resultants of the start, where prescribed its motions, (m).
  pure function start_values(problem) result(values)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: values(problem%mode_count())

    values = 0.0_dp
    if (allocated(problem%resultant)) values = problem%resultant
    if (allocated(problem%prescribed)) where (problem%prescribed) values = problem%motion
  end function start_values

  subroutine follow_problem(operator, problem, finish, path, info)
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: finish(:)
    type(fuge_general_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info
    type(canonical_problem) :: canonical
    type(path_line) :: line
    type(path_record) :: record
    real(dp) :: start(size(finish)), change(size(finish)), no_change(problem%points())

    call make_canonical(problem, canonical, info)
    if (info%failed()) return
    start = start_values(problem)
    change = finish - start
    no_change = 0.0_dp
    call canonical%change_of(no_change, change, line%reduced_gap_rate, line%load_rate)
    line%most = 1.0_dp
    line%origin = 1.0_dp + min(ratio(start, change), LARGEST_ORIGIN)
    call run_line(operator, canonical, line, record, info)
    if (info%failed()) return
    info%iterations = record%entries - 1
    call hand_over(canonical, start, change, record, path)
  end subroutine follow_problem

  pure function ratio(values, changes)
    real(dp), intent(in) :: values(:), changes(:)
    real(dp) :: ratio, largest, change

    ratio = 0.0_dp
    if (size(values) < 1) return
    largest = maxval(abs(values))
    change = maxval(abs(changes))
    if (largest > LARGEST_ORIGIN*change) then
      ratio = LARGEST_ORIGIN
    else if (change > 0.0_dp) then
      ratio = largest/change
    end if
  end function ratio

  !> From the answer at the start of the line to its end; motions in the record are those
  !> of the scene.
  subroutine run_line(operator, canonical, line, record, info)
    type(fuge_dense_operator), intent(in) :: operator
    type(canonical_problem), intent(inout) :: canonical
    type(path_line), intent(in) :: line
    type(path_record), intent(inout) :: record
    type(fuge_info), intent(inout) :: info
    type(path_position) :: here
    real(dp) :: base, datum
    integer :: k, status

    base = 0.0_dp
    datum = 0.0_dp
    if (canonical%has_translation) then
      base = minval(canonical%gap)
      datum = operator%datum()
    end if
    call stand_at_start(operator, base, datum, canonical, here, info)
    if (info%failed()) return
    call follow_line(operator%alpha, datum, canonical, line, here, record, status)
    call explain(status, record%entries, here%t, info)
    if (info%failed() .or. .not. canonical%has_translation) return
    do k = 1, record%entries
      record%motion(1, k) = record%motion(1, k) + base &
        + datum*(canonical%load(1) + record%parameter(k)*line%load_rate(1))
      record%rate(1, k) = record%rate(1, k) + datum*line%load_rate(1)
    end do
  end subroutine run_line

  !> The answer at the start. `base` is taken off the gaps of the scene, and with `datum`
  !> off its translation.
  subroutine stand_at_start(operator, base, datum, canonical, here, info)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: base, datum
    type(canonical_problem), intent(inout) :: canonical
    type(path_position), intent(out) :: here
    type(fuge_info), intent(inout) :: info
    type(fuge_solution) :: answer
    type(contact_factor) :: factor
    type(monitor_relay) :: nobody
    integer :: state(size(canonical%gap)), stat, status

    allocate (answer%force(size(state)), answer%gap(size(state)), answer%motion(size(canonical%load)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the start of the path')
      return
    end if
    state = 0
    if (rests(canonical)) then
      answer%force = 0.0_dp
      answer%motion = 0.0_dp
      canonical%gap = canonical%gap - base
      answer%gap = canonical%gap
    else
      call solve_by_active_set(operator%alpha, operator%datum(), canonical, fuge_options(), nobody, state, factor, &
                               answer, &
                               info)
      if (info%failed()) return
      ! The path says itself where the motions begin; forces have to be unique.
      if (.not. factor%ridge > 0.0_dp) call report(info, FUGE_DONE, '')
      canonical%gap = canonical%gap - base
      if (canonical%has_translation) answer%motion(1) = answer%motion(1) - (base + datum*canonical%load(1))
    end if
    call start_at(canonical, state, answer%force, answer%gap, answer%motion, here, status)
    if (status /= FUGE_DONE) call report(info, status, fuge_status_text(status))
  end subroutine stand_at_start

  !> The plain problem without a load, where the bodies just touch.
  pure function rests(canonical)
    type(canonical_problem), intent(in) :: canonical
    logical :: rests

    rests = canonical%plain
    if (rests) rests = .not. canonical%load(1) > 0.0_dp
  end function rests

  !> Put the end of a path into words.
  pure subroutine explain(status, entries, t, info)
    integer, intent(in) :: status, entries
    real(dp), intent(in) :: t
    type(fuge_info), intent(inout) :: info

    if (status == FUGE_ERR_NO_EQUILIBRIUM) then
      call report(info, status, 'equilibrium ends at parameter '//text(t)//' of the path: choose an end before it')
    else if (status /= FUGE_DONE) then
      call report(info, status, 'after '//text(max(entries - 1, 0))//' events: '//fuge_status_text(status))
    end if
  end subroutine explain

  !> The record in the caller's motions.
  subroutine hand_over(canonical, start, change, record, path)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: start(:), change(:)
    type(path_record), intent(inout) :: record
    type(fuge_general_path), intent(inout) :: path
    real(dp), allocatable :: motion(:, :), rate(:, :)
    integer :: k

    allocate (motion(size(start), record%entries), rate(size(start), record%entries))
    do k = 1, record%entries
      call canonical%motions_of(start + record%parameter(k)*change, record%motion(:, k), motion(:, k))
      call canonical%motions_of(change, record%rate(:, k), rate(:, k))
    end do
    path%entries = record%entries
    path%parameter = record%parameter(:record%entries)
    path%point = record%point(:record%entries)
    path%state = record%state(:record%entries)
    path%contacts = record%contacts(:record%entries)
    call move_alloc(record%start, path%start)
    call move_alloc(motion, path%motion)
    call move_alloc(rate, path%rate)
  end subroutine hand_over

  !> Sides (n) of all points after an entry: 1 at the lower stop, -1 at the upper one, 0
  !> between.
  pure function states(self, entry)
    class(fuge_general_path), intent(in) :: self
    integer, intent(in) :: entry
    integer, allocatable :: states(:)

    states = states_at(self%start, self%point, self%state, min(entry, self%entries))
  end function states

end module fuge_path_types
