!> The mechanism by which a structure that no link holds gives way.
module fuge_structure_mechanism
  use fuge_condensation, only: fuge_condensed
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE
  use fuge_unbalanced_motion, only: fuge_find_unbalanced_motion
  implicit none
  private

  public :: fuge_find_mechanism

contains

  !> After FUGE_ERR_NO_EQUILIBRIUM: how the structure moves, because no forces of the links balance its loads.
  !>
  !> `condensed` and `problem` as posed; `u` (degrees), out: displacements of the mechanism, the largest of size 1,
  !> along which no link closes while the loads do work. Zero where there is equilibrium. Errors, `u` unchanged:
  !> FUGE_ERR_SIZE, FUGE_ERR_CALL_ORDER, and those of `fuge_find_unbalanced_motion`.
  subroutine fuge_find_mechanism(condensed, problem, u, info)
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: motion(:)

    if (.not. allocated(condensed%resultant)) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no body has been condensed: call fuge_condense first')
    else if (problem%points() /= size(condensed%displacement) &
             .or. problem%mode_count() < size(condensed%resultant)) then
      call report(info, FUGE_ERR_SIZE, 'the problem is not that of this body: pose it with links%pose')
    end if
    if (.not. info%failed()) call fuge_find_unbalanced_motion(problem, motion, info)
    if (info%failed()) return
    call condensed%move_rigidly(motion(:size(condensed%resultant)), u, info)
    if (info%failed()) return
    if (any(abs(u) > 0.0_dp)) u = u/maxval(abs(u))
  end subroutine fuge_find_mechanism

end module fuge_structure_mechanism
