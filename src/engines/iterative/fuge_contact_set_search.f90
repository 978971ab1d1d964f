!> The contact set of one grid, by products only: conjugate gradients on a set, judged just
!> well enough to change sides, and the way down the energy where that does not get on.
module fuge_contact_set_search
  use fuge_set_exchange, only: exchange, exchange_in_row
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_projected_gradients, only: iterate, relax, measure, deflect, open_gap
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CANCELLED
  use fuge_blocking_step, only: step_back
  use fuge_number_text, only: text
  implicit none
  private

  public :: find_contact, restart

  !> Residual asked of a grid that only gives a start to a finer one.
  real(dp), parameter :: COARSE_TOLERANCE = 1.0e-4_dp
  !> The engine aims below the tolerance by this factor, because the certificate
  !> counts more than the equations of the set.
  real(dp), parameter :: MARGIN = 0.4_dp
  !> Block changes without fewer wrong points before single ones; the foresight ends
  !> when half of them are used.
  integer, parameter :: PATIENCE = 10

  !> What is asked of one grid.
  type, public :: demands
    real(dp) :: tolerance = COARSE_TOLERANCE
    !> Contact sets allowed, on all grids together.
    integer :: limit = 0
    !> A consistent set is enough: its forces only start a finer grid.
    logical :: only_start = .true.
    !> The motion is prescribed.
    logical :: held = .false.
  end type demands

contains

  !> The contact set of one grid and its forces, from forces to start with.
  !>
  !> Errors: those of the operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY,
  !> FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CANCELLED.
  subroutine find_contact(operator, wanted, reduced_gap, monitor, state, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    real(dp), intent(in), contiguous :: reduced_gap(:)
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    type(contact_preconditioner) :: preconditioner
    real(dp) :: before
    integer :: wrong, fewest, patience_left
    logical :: thorough, reached, in_row

    in_row = operator%in_row()
    fewest = huge(fewest)
    patience_left = PATIENCE
    before = huge(before)
    thorough = .false.
    state%contact = state%force > 0.0_dp
    call restart(operator, state, info)
    do while (.not. info%failed())
      call settle(operator, wanted, preconditioner, reduced_gap, thorough, monitor, state, reached, info)
      if (info%failed()) exit
      wrong = count(state%contact .and. state%force < 0.0_dp) &
              + count(.not. state%contact .and. open_gap(reduced_gap, state%displacement, state%motion) &
                      < -noise_of(wanted, state))
      if (wrong == 0) then
        if (wanted%only_start) exit
        if (thorough .or. reached) then
          call confirm(operator, wanted, reduced_gap, before, state, reached, info)
          if (reached .or. info%failed()) exit
        end if
        thorough = .true.
        cycle
      end if
      thorough = .false.
      patience_left = patience_left - 1
      if (wrong < fewest) patience_left = PATIENCE
      fewest = min(fewest, wrong)
      if (patience_left < 0) then
        call descend(operator, wanted, preconditioner, reduced_gap, monitor, state, info)
        exit
      end if
      call change_sides(reduced_gap, noise_of(wanted, state), in_row .and. 2*patience_left > PATIENCE, state, info)
      if (info%failed()) exit
      call restart(operator, state, info)
    end do
    info%preconditionings = info%preconditionings + ceiling(preconditioner%coarse_share)
  end subroutine find_contact

  !> Points that pull leave, points that penetrate join. Error: FUGE_ERR_MEMORY.
  subroutine change_sides(reduced_gap, noise, foresight, state, info)
    real(dp), intent(in) :: reduced_gap(:), noise
    logical, intent(in) :: foresight
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: pulls(:), penetrates(:)
    integer :: stat

    ! Not kept, to have the memory for products.
    allocate (pulls(size(reduced_gap)), penetrates(size(reduced_gap)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the contact set of '//text(size(reduced_gap))//' points')
      return
    end if
    pulls = state%contact .and. state%force < 0.0_dp
    penetrates = .not. state%contact .and. open_gap(reduced_gap, state%displacement, state%motion) < -noise
    if (foresight) then
      call exchange_in_row(pulls, penetrates, state%contact)
    else
      call exchange(pulls, penetrates, state%contact)
    end if
  end subroutine change_sides

  !> Is a set without wrong points solved, judged by a fresh product and not by
  !> recurrences, which drift? `done` also if the residual does not fall any more, from
  !> the one `before`: then the certificate has the last word.
  subroutine confirm(operator, wanted, reduced_gap, before, state, done, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(inout) :: before
    type(iterate), intent(inout) :: state
    logical, intent(out) :: done
    type(fuge_info), intent(inout) :: info

    done = .false.
    call restart(operator, state, info)
    if (.not. info%failed()) call measure(operator, reduced_gap, state, info)
    if (info%failed()) return
    done = state%residual <= MARGIN*wanted%tolerance*state%least_length .or. .not. state%residual < 0.5_dp*before
    before = state%residual
  end subroutine confirm

  !> Penetrations below this are rounding.
  pure function noise_of(wanted, state) result(noise)
    type(demands), intent(in) :: wanted
    type(iterate), intent(in) :: state
    real(dp) :: noise

    noise = MARGIN**2*wanted%tolerance*state%least_length
  end function noise_of

  !> Solve for the forces of the present set; one more iteration.
  subroutine settle(operator, wanted, preconditioner, reduced_gap, thorough, monitor, state, reached, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    type(contact_preconditioner), intent(inout) :: preconditioner
    real(dp), intent(in), contiguous :: reduced_gap(:)
    logical, intent(in) :: thorough
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    logical, intent(out) :: reached
    type(fuge_info), intent(inout) :: info
    real(dp) :: relative
    integer :: status

    reached = .false.
    if (info%iterations >= wanted%limit) then
      call report(info, FUGE_ERR_ITERATION_LIMIT, text(wanted%limit)//' contact sets were not enough: raise ' &
                  //'max_iterations (0 allows '//text(ITERATIONS_PER_ROW)//' for each point)')
      return
    end if
    call preconditioner%set(operator, state%contact, maxval(abs(state%displacement)), info)
    if (info%failed()) return
    call relax(operator, preconditioner, reduced_gap, MARGIN*wanted%tolerance, thorough, state, reached, info)
    if (info%failed()) return
    info%iterations = info%iterations + 1
    relative = 0.0_dp
    if (state%residual > 0.0_dp) relative = state%residual/max(state%least_length, state%residual)
    call tell_monitor(monitor, info%iterations, relative, count(state%contact), status)
    if (status /= FUGE_DONE) call report(info, FUGE_ERR_CANCELLED, 'cancelled by the progress callback after ' &
                                         //text(info%iterations)//' contact sets')
  end subroutine settle

  !> Forces of the contact set that only push, and sum to one unless the motion is held, and
  !> their displacements.
  subroutine restart(operator, state, info)
    class(fuge_operator), intent(in) :: operator
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp) :: total

    where (state%contact)
      state%force = max(state%force, 0.0_dp)
    else where
      state%force = 0.0_dp
    end where
    total = sum(state%force)
    if (total > 0.0_dp .and. .not. state%held) then
      state%force = state%force/total
    else if (.not. state%held) then
      where (state%contact) state%force = 1.0_dp/real(count(state%contact), dp)
    end if
    call deflect(operator, state%held, state%force, state%displacement, info)
  end subroutine restart

  !> Down the energy: from pushing forces towards the answer of their set as far as no
  !> force pulls, then the point with the most negative gap joins, until none has one or
  !> sets are not solved well enough any more for that to mean something.
  subroutine descend(operator, wanted, preconditioner, reduced_gap, monitor, state, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    type(contact_preconditioner), intent(inout) :: preconditioner
    real(dp), intent(in), contiguous :: reduced_gap(:)
    class(fuge_monitor), intent(inout) :: monitor
    type(iterate), intent(inout) :: state
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: force(:)
    logical, allocatable :: barred(:), tied(:)
    integer, allocatable :: side(:)
    integer :: newest, n, stat
    logical :: reached

    n = size(reduced_gap)
    allocate (force(n), barred(n), tied(n), side(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the way down the energy of '//text(n)//' points')
      return
    end if
    barred = .false.
    tied = .false.
    newest = 0
    call restart(operator, state, info)
    state%contact = state%force > 0.0_dp
    do while (.not. info%failed())
      force = state%force
      call settle(operator, wanted, preconditioner, reduced_gap, .true., monitor, state, reached, info)
      if (info%failed()) exit
      if (any(state%contact .and. state%force <= 0.0_dp)) then
        side = merge(1, 0, state%contact)
        call step_back(state%force, 0.0_dp, tied, side, force, newest, barred)
        state%contact = side /= 0
        state%force = force
      else
        if (newest > 0) barred = barred .and. barred(newest)
        newest = worst_gap(reduced_gap, state, noise_of(wanted, state), barred)
        if (newest == 0 .or. .not. reached) exit
        state%contact(newest) = .true.
      end if
      call restart(operator, state, info)
    end do
    if (.not. info%failed()) call restart(operator, state, info)
    if (.not. info%failed()) call measure(operator, reduced_gap, state, info)
  end subroutine descend

  !> The point that penetrates most, of those not barred; 0 if there is none.
  pure function worst_gap(reduced_gap, state, noise, barred) result(worst)
    real(dp), intent(in) :: reduced_gap(:)
    type(iterate), intent(in) :: state
    real(dp), intent(in) :: noise
    logical, intent(in) :: barred(:)
    integer :: worst
    real(dp) :: gap, deepest
    integer :: k

    worst = 0
    deepest = -noise
    do k = 1, size(reduced_gap)
      if (state%contact(k) .or. barred(k)) cycle
      gap = open_gap(reduced_gap(k), state%displacement(k), state%motion)
      if (gap >= deepest) cycle
      worst = k
      deepest = gap
    end do
  end function worst_gap

end module fuge_contact_set_search
