!> The exact course of a contact as the load grows from zero: parametric pivoting.
!>
!> Between two events forces, gaps and approach are linear in the load F_0. An event
!> is a load at which points join or leave the contact. Which they are when several
!> could at once, and how the next piece runs, is a small contact problem in the rates
!> for the points that have neither force nor gap there. No load steps.
module fuge_parametric
  use fuge_active_set, only: PATIENCE, keep_first
  use fuge_check, only: check_finite
  use fuge_contact_factor, only: contact_factor
  use fuge_dense, only: fuge_dense_operator
  use fuge_dense_engines, only: check_scene, ITERATIONS_PER_ROW
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, check_problem, set_problem
  use fuge_set_answer, only: add_deflection
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_SIZE, &
    FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_UNSUPPORTED
  use fuge_text, only: text
  implicit none
  private

  public :: fuge_load_path

  !> Rates below this part of the largest are zero, and loads that agree to it are one
  !> event.
  real(dp), parameter :: TIE_TOLERANCE = 1.0e-12_dp

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

  !> Where the path stands: values at `load`, and their rates from there on.
  type :: position
    real(dp) :: load = 0.0_dp, approach = 0.0_dp, approach_rate = 0.0_dp
    logical, allocatable :: contact(:), undecided(:)
    real(dp), allocatable :: force(:), gap(:), force_rate(:), gap_rate(:)
  end type position

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
    integer :: status

    call set_problem(gap, load, problem, info)
    if (info%failed()) return
    select type (operator)
    class is (fuge_dense_operator)
      if (operator%points() < 1) then
        call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before')
      else
        call check_problem(problem, operator%points(), info)
      end if
      if (.not. info%failed() .and. load > 0.0_dp) call check_scene(operator%alpha, load, info)
      if (info%failed()) return
      call follow(operator%alpha, gap, load, found, status)
      if (status /= FUGE_DONE) then
        call report(info, status, 'after '//text(found%events)//' events: '//fuge_status_text(status))
      else
        info%iterations = found%events
        call take(found, path)
      end if
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

  subroutine follow(alpha, gap, most, path, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: gap(:), most
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status
    type(contact_factor) :: factor
    type(position) :: here
    logical :: before(size(gap))
    real(dp) :: lowest, step
    integer :: turn

    call stand_at_first_touch(gap, here, status)
    if (status == FUGE_DONE) call grow(path, size(gap) + 8, status)
    lowest = minval(gap)
    do turn = 1, ITERATIONS_PER_ROW*(size(gap) + 1)
      if (status /= FUGE_DONE) return
      before = here%contact
      call find_rates(alpha, factor, here, status)
      if (status == FUGE_DONE) call note(path, here, before, status)
      if (status /= FUGE_DONE) return
      call next_event(here, step)
      if (.not. here%load + step < most) return
      here%load = here%load + step
      call values_at(alpha, factor, gap - lowest, here)
      here%approach = here%approach + lowest
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine follow

  !> No load: the lowest points touch, and nothing says yet which will carry.
  subroutine stand_at_first_touch(gap, here, status)
    real(dp), intent(in) :: gap(:)
    type(position), intent(out) :: here
    integer, intent(out) :: status
    integer :: n, stat

    n = size(gap)
    allocate (here%contact(n), here%undecided(n), here%force(n), here%gap(n), here%force_rate(n), &
              here%gap_rate(n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    here%approach = minval(gap)
    here%gap = gap - here%approach
    here%force = 0.0_dp
    here%contact = .false.
    here%undecided = here%gap <= 0.0_dp
  end subroutine stand_at_first_touch

  !> The rates per unit of load. Points in contact stay in it, open ones stay open; for
  !> the undecided the rates satisfy a contact problem, solved by block pivoting with
  !> single changes as the way out.
  subroutine find_rates(alpha, factor, here, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(contact_factor), intent(inout) :: factor
    type(position), intent(inout) :: here
    integer, intent(out) :: status
    logical :: wrong(size(here%gap))
    real(dp) :: none(size(here%gap)), ones(size(here%gap), 1), motion(1)
    integer :: trial, fewest, patience_left

    none = 0.0_dp
    ones = 1.0_dp
    here%contact = here%contact .or. here%undecided
    fewest = huge(fewest)
    patience_left = PATIENCE
    do trial = 1, ITERATIONS_PER_ROW*(count(here%undecided) + 1)
      call factor%set(alpha, ones, .true., here%contact, status)
      if (status /= FUGE_DONE) return
      call factor%solve(none, [1.0_dp], here%force_rate, motion)
      here%gap_rate = -motion(1)
      call add_deflection(alpha, factor%datum, here%contact, here%force_rate, here%gap_rate)
      here%approach_rate = motion(1) + factor%datum
      wrong = here%undecided .and. merge(is_falling(here%force_rate), is_falling(here%gap_rate), here%contact)
      if (.not. any(wrong)) return
      patience_left = patience_left - 1
      if (count(wrong) < fewest) patience_left = PATIENCE
      fewest = min(fewest, count(wrong))
      if (patience_left < 0) call keep_first(wrong)
      here%contact = here%contact .neqv. wrong
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine find_rates

  pure function is_falling(rate) result(falling)
    real(dp), intent(in) :: rate(:)
    logical :: falling(size(rate))

    falling = rate < -TIE_TOLERANCE*maxval(abs(rate))
  end function is_falling

  !> How much more load the next event needs, and the points that could change at it.
  subroutine next_event(here, step)
    type(position), intent(inout) :: here
    real(dp), intent(out) :: step
    real(dp) :: reach(size(here%gap))

    reach = huge(step)
    where (here%contact)
      where (is_falling(here%force_rate)) reach = max(here%force, 0.0_dp)/abs(here%force_rate)
    else where
      where (is_falling(here%gap_rate)) reach = max(here%gap, 0.0_dp)/abs(here%gap_rate)
    end where
    step = minval(reach)
    here%undecided = reach < huge(step) .and. reach - step <= TIE_TOLERANCE*(here%load + step)
  end subroutine next_event

  !> Forces, gaps and approach at the present load, not carried along but solved.
  subroutine values_at(alpha, factor, shape, here)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(contact_factor), intent(in) :: factor
    real(dp), intent(in) :: shape(:)
    type(position), intent(inout) :: here
    real(dp) :: motion(1)

    call factor%solve(shape, [here%load], here%force, motion)
    here%gap = shape - motion(1)
    call add_deflection(alpha, factor%datum, here%contact, here%force, here%gap)
    here%approach = motion(1) + factor%datum*here%load
  end subroutine values_at

  !> Write an entry for each point that has changed sides.
  subroutine note(path, here, before, status)
    type(fuge_path), intent(inout) :: path
    type(position), intent(in) :: here
    logical, intent(in) :: before(:)
    integer, intent(out) :: status
    integer :: k

    status = FUGE_DONE
    do k = 1, size(before)
      if (here%contact(k) .eqv. before(k)) cycle
      if (path%events == size(path%load)) call grow(path, 2*path%events, status)
      if (status /= FUGE_DONE) return
      path%events = path%events + 1
      path%load(path%events) = here%load
      path%approach(path%events) = here%approach
      path%stiffness(path%events) = 1.0_dp/here%approach_rate
      path%point(path%events) = merge(k, -k, here%contact(k))
      path%contacts(path%events) = count(here%contact)
    end do
  end subroutine note

  subroutine grow(path, capacity, status)
    type(fuge_path), intent(inout) :: path
    integer, intent(in) :: capacity
    integer, intent(out) :: status
    type(fuge_path) :: larger
    integer :: stat

    allocate (larger%load(capacity), larger%approach(capacity), larger%stiffness(capacity), &
              larger%point(capacity), larger%contacts(capacity), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    larger%events = path%events
    if (path%events > 0) then
      larger%load(:path%events) = path%load
      larger%approach(:path%events) = path%approach
      larger%stiffness(:path%events) = path%stiffness
      larger%point(:path%events) = path%point
      larger%contacts(:path%events) = path%contacts
    end if
    call take(larger, path)
  end subroutine grow

end module fuge_parametric
