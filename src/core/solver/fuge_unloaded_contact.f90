!> Contact without a load: the bodies just touch.
module fuge_unloaded_contact
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: is_unloaded, solve_without_load

contains

  !> One translation without a load, which has no unique approach.
  pure function is_unloaded(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: is_unloaded

    is_unloaded = problem%has_one_load()
    if (is_unloaded) is_unloaded = .not. problem%resultant(1) > 0.0_dp
  end function is_unloaded

  !> The limit of a vanishing load: the bodies just touch at the smallest gap.
  subroutine solve_without_load(problem, space, solution, info)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%force(problem%points()), solution%gap(problem%points()), solution%motion(1), &
              solution%state(problem%points()), stat=stat)
    call require_memory(stat, 'the forces and gaps of', problem%points(), 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    solution%force = 0.0_dp
    solution%motion = space%least(minval(problem%gap))
    solution%gap = problem%gap - solution%motion(1)
    solution%state = FUGE_OPEN
  end subroutine solve_without_load

end module fuge_unloaded_contact
