!> Forces, gaps, motions and states of the canonical problem, and how exact they are.
module fuge_contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: allocate_solution

  !> Move the array `spare` to `values` if it has the right `length`.
  interface take_over
    module procedure take_over_reals
    module procedure take_over_integers
  end interface take_over

  !> All arrays as in `fuge_solution`, the motion in the modes of the canonical problem.
  type, extends(fuge_solution), public :: contact_solution
    !> Estimate of the largest error of a force that refinement has left, and the one before it, which rounding had made
    !> of all terms of the equations; force.
    real(dp) :: force_error = 0.0_dp, unrefined_error = 0.0_dp
    !> By how much signs were wrong that rounding was taken to have turned, relative; no unit.
    real(dp) :: violation = 0.0_dp
  end type contact_solution

contains

  !> Allocate a solution of n points, all open, with m motions; arrays of `spare` that fit are taken over. Error:
  !> FUGE_ERR_MEMORY.
  pure subroutine allocate_solution(n, m, solution, info, spare)
    integer, intent(in) :: n, m
    type(contact_solution), intent(out) :: solution
    type(fuge_info), intent(inout) :: info
    type(fuge_solution), intent(inout), optional :: spare
    integer :: stat

    stat = 0
    if (present(spare)) then
      call take_over(spare%force, n, solution%force)
      call take_over(spare%gap, n, solution%gap)
      call take_over(spare%motion, m, solution%motion)
      call take_over(spare%state, n, solution%state)
    end if
    if (.not. allocated(solution%force)) allocate (solution%force(n), stat=stat)
    if (stat == 0 .and. .not. allocated(solution%gap)) allocate (solution%gap(n), stat=stat)
    if (stat == 0 .and. .not. allocated(solution%motion)) allocate (solution%motion(m), stat=stat)
    if (stat == 0 .and. .not. allocated(solution%state)) allocate (solution%state(n), stat=stat)
    call require_memory(stat, 'the forces and gaps of', n, 'points', info)
    if (stat /= 0) return
    solution%state = FUGE_OPEN
  end subroutine allocate_solution

  pure subroutine take_over_reals(spare, length, values)
    real(dp), allocatable, intent(inout) :: spare(:), values(:)
    integer, intent(in) :: length

    if (.not. allocated(spare)) return
    if (size(spare) == length) call move_alloc(spare, values)
  end subroutine take_over_reals

  pure subroutine take_over_integers(spare, length, values)
    integer, allocatable, intent(inout) :: spare(:), values(:)
    integer, intent(in) :: length

    if (.not. allocated(spare)) return
    if (size(spare) == length) call move_alloc(spare, values)
  end subroutine take_over_integers

end module fuge_contact_solution
