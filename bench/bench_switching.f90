!> The rules by which programs for structures find which one-way members carry: linear solves, after each of which
!> members are dropped, or dropped and taken back, until nothing changes.
module bench_switching
  use bench_lapack, only: dpotrf, dpotrs
  use fuge, only: dp => fuge_dp
  use one_way_structures, only: one_way_structure
  implicit none
  private

  public :: switch_members

  !> Drop all that carry the wrong way for good; the worst one only; drop, and take back what is needed again.
  integer, parameter, public :: DROP_ALL = 1, DROP_WORST = 2, DROP_AND_TAKE_BACK = 3
  !> Nothing changes any more; a mechanism is left; no end.
  integer, parameter, public :: SETTLED = 0, UNSTABLE = 1, ENDLESS = 2

  !> A rule has no end after so many linear solves; dropping alone ends sooner.
  integer, parameter :: MOST_ROUNDS = 100
  !> A force or gap of the wrong sign counts from this fraction of the largest one on, so that ties are not switched by
  !> rounding; a pivot below this fraction of its diagonal is that of a mechanism.
  real(dp), parameter :: NOTHING = 1.0e-9_dp, NO_PIVOT = 1.0e-12_dp

contains

  !> Forces of the rows, (n), by a rule. All rows have a compliance, none has limits. Rows of one stop begin as members
  !> that carry, guides with play between their stops.
  subroutine switch_members(structure, rule, force, rounds, outcome)
    type(one_way_structure), intent(in) :: structure
    integer, intent(in) :: rule
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: rounds, outcome
    real(dp) :: u(structure%degrees()), gap(structure%rows())
    integer :: state(structure%rows()), next(structure%rows())

    state = merge(1, 0, structure%play > huge(1.0_dp))
    do rounds = 1, max(MOST_ROUNDS, structure%rows() + 1)
      call solve_linear(structure, state, u, outcome)
      if (outcome /= SETTLED) return
      call find_forces(structure, state, u, force, gap)
      next = next_states(structure, rule, state, force, gap)
      if (all(next == state)) return
      if (rule == DROP_AND_TAKE_BACK .and. rounds == MOST_ROUNDS) exit
      state = next
    end do
    outcome = ENDLESS
  end subroutine switch_members

  !> Displacements if the rows in these states are springs of either sign.
  subroutine solve_linear(structure, state, u, outcome)
    type(one_way_structure), intent(in) :: structure
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: u(:)
    integer, intent(out) :: outcome
    real(dp) :: matrix(size(u), size(u)), diagonal(size(u)), right(size(u), 1), offset
    integer :: i, j, k, info, nd

    nd = size(u)
    matrix = structure%stiffness
    right(:, 1) = structure%load
    do i = 1, size(state)
      if (state(i) == 0) cycle
      offset = structure%gap(i)
      if (state(i) < 0) offset = offset - structure%play(i)
      associate (dof => structure%dof(:, i), normal => structure%normal(:, i), &
                 stiffness => 1.0_dp/structure%compliance(i))
        do j = 1, size(dof)
          if (dof(j) < 1) cycle
          right(dof(j), 1) = right(dof(j), 1) - stiffness*offset*normal(j)
          do k = 1, size(dof)
            if (dof(k) > 0) matrix(dof(k), dof(j)) = matrix(dof(k), dof(j)) + stiffness*normal(k)*normal(j)
          end do
        end do
      end associate
    end do
    diagonal = [(matrix(k, k), k=1, nd)]
    call dpotrf('L', nd, matrix, nd, info)
    outcome = UNSTABLE
    if (info /= 0) return
    if (any([(matrix(k, k)**2, k=1, nd)] < NO_PIVOT*diagonal)) return
    call dpotrs('L', nd, 1, matrix, nd, right, nd, info)
    u = right(:, 1)
    outcome = SETTLED
  end subroutine solve_linear

  !> Forces of the rows that carry, and gaps without what the row itself gives way.
  pure subroutine find_forces(structure, state, u, force, gap)
    type(one_way_structure), intent(in) :: structure
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: u(:)
    real(dp), intent(out) :: force(:), gap(:)
    integer :: i

    force = 0.0_dp
    do i = 1, size(state)
      gap(i) = structure%gap(i) + structure%row_displacement(i, u)
      if (state(i) > 0) force(i) = -gap(i)/structure%compliance(i)
      if (state(i) < 0) force(i) = -(gap(i) - structure%play(i))/structure%compliance(i)
    end do
  end subroutine find_forces

  !> The states after a linear solve.
  pure function next_states(structure, rule, state, force, gap) result(next)
    type(one_way_structure), intent(in) :: structure
    integer, intent(in) :: rule, state(:)
    real(dp), intent(in) :: force(:), gap(:)
    integer :: next(size(state))
    real(dp) :: wrong(size(state)), closed
    integer :: worst

    next = state
    ! Positive where a row carries the wrong way.
    wrong = -force*state
    if (rule == DROP_WORST) then
      worst = maxloc(wrong, dim=1)
      if (wrong(worst) > NOTHING*maxval(abs(force))) next(worst) = 0
      return
    end if
    where (wrong > NOTHING*maxval(abs(force))) next = 0
    if (rule == DROP_ALL) return
    closed = NOTHING*maxval(abs(gap))
    where (state == 0 .and. gap < -closed) next = 1
    where (state == 0 .and. gap > structure%play + closed) next = -1
  end function next_states

end module bench_switching
