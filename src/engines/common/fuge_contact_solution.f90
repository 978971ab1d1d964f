!> Forces, gaps and motions of the canonical problem together with the state of each point.
module fuge_contact_solution
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
  implicit none
  private

  public :: allocate_solution

  !> `force` (n), `gap` (n) and `motion` (m) as in `fuge_solution`, the motion in the modes of the canonical problem.
  type, extends(fuge_solution), public :: contact_solution
    !> FUGE_AT_LOWER_STOP, FUGE_OPEN or FUGE_AT_UPPER_STOP of each point, (n).
    integer, allocatable :: state(:)
  end type contact_solution

contains

  !> Allocate a solution of n points, all open, with m motions. Error: FUGE_ERR_MEMORY.
  pure subroutine allocate_solution(n, m, solution, info)
    integer, intent(in) :: n, m
    type(contact_solution), intent(out) :: solution
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (solution%force(n), solution%gap(n), solution%motion(m), solution%state(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the forces and gaps of '//text(n)//' points')
      return
    end if
    solution%state = FUGE_OPEN
  end subroutine allocate_solution

end module fuge_contact_solution
