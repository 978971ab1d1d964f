!> The motion along which nothing holds the bodies, where no contact forces can be in equilibrium with the resultants.
module fuge_unbalanced_motion
  use fuge_kinds, only: dp
  use fuge_problem_type, only: check_problem, copy_problem, fuge_problem
  use fuge_status, only: fuge_info, require_memory, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: fuge_find_unbalanced_motion

contains

  !> After FUGE_ERR_NO_EQUILIBRIUM of a solve: the motions q along which no contact closes, or the forces at their
  !> limits do less work than the resultants, while the resultants do work (Farkas' lemma).
  !>
  !> `problem` that of the solve; `motion` (m), replaced on success: all zero where there is equilibrium. Prescribed
  !> motions and those on springs are zero. The size has no meaning. Errors: those of the check of the problem,
  !> FUGE_ERR_MODES, FUGE_ERR_MEMORY.
  subroutine fuge_find_unbalanced_motion(problem, motion, info)
    use fuge_canonical_problem, only: canonical_problem, make_canonical
    type(fuge_problem), intent(in) :: problem
    real(dp), allocatable, intent(inout) :: motion(:)
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: free
    type(canonical_problem) :: canonical
    real(dp), allocatable :: found(:)
    integer :: stat

    call check_problem(problem, problem%points(), info)
    if (info%failed()) return
    allocate (found(problem%mode_count()), stat=stat)
    call require_memory(stat, 'a motion', info)
    if (stat /= 0) return
    found = 0.0_dp
    call copy_problem(problem, free, info)
    if (info%failed()) return
    ! Springs balance any resultant of their motions.
    if (allocated(free%motion_stiffness)) then
      free%motion = free%prescribed_motion()
      if (allocated(free%prescribed)) then
        free%prescribed = free%prescribed .or. free%motions_on_springs()
      else
        free%prescribed = free%motions_on_springs()
      end if
      deallocate (free%motion_stiffness)
    end if
    call make_canonical(free, canonical, info)
    if (info%status == FUGE_ERR_NO_EQUILIBRIUM .and. allocated(canonical%unbalanced)) then
      info = fuge_info()
      found(canonical%free) = canonical%unbalanced
    else if (info%status == FUGE_ERR_NO_EQUILIBRIUM) then
      ! All points are excluded: any free motion.
      info = fuge_info()
      found = free%resultants()
    end if
    if (.not. info%failed()) call move_alloc(found, motion)
  end subroutine fuge_find_unbalanced_motion

end module fuge_unbalanced_motion
