!> Jumps on a path: where the points with force do not resist all motions, and the weakly active ones cannot carry the
!> change of the load, the bodies move at constant forces until other points can.
module fuge_path_jump
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_OPEN
  use fuge_displacements, only: rigid_displacement
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_options_type, only: ITERATIONS_PER_ROW
  use fuge_path_position, only: path_position, ROUNDING
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_unresisted_motions, only: find_unresisted_basis
  implicit none
  private

  public :: move_until_resisted

contains

  !> Move until the contact can carry the change of the load, (m) per unit of the parameter. `status`: FUGE_DONE,
  !> FUGE_ERR_NO_EQUILIBRIUM if no stop is in the way, FUGE_ERR_ITERATION_LIMIT.
  subroutine move_until_resisted(canonical, load_rate, position, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: load_rate(:)
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    real(dp) :: force(size(position%state)), motion(size(load_rate))
    logical :: loaded(size(position%state))
    integer :: turn

    status = FUGE_DONE
    if (size(load_rate) < 1) return
    do turn = 1, ITERATIONS_PER_ROW*(size(loaded) + 1)
      loaded = position%state /= FUGE_OPEN .and. position%weakly_active == FUGE_OPEN
      ! Any point resists the translation of all of them.
      if (canonical%has_translation .and. size(load_rate) == 1 .and. any(loaded)) return
      call find_unresisted_basis(canonical%modes, loaded, position%unresisted)
      if (size(position%unresisted, 2) < 1) return
      call find_equilibrium(canonical%modes, load_rate, loaded .or. position%weakly_active > FUGE_OPEN, &
                            loaded .or. position%weakly_active < FUGE_OPEN, force, motion)
      if (.not. any(abs(motion) > 0.0_dp)) return
      call move_to_stop(canonical, motion, loaded, position, status)
      if (status /= FUGE_DONE) return
    end do
    status = FUGE_ERR_ITERATION_LIMIT
  end subroutine move_until_resisted

  !> Move along `direction` (m) as far as the stops allow. `status`: FUGE_DONE, or FUGE_ERR_NO_EQUILIBRIUM if no stop
  !> is reached.
  subroutine move_to_stop(canonical, direction, loaded, position, status)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: direction(:)
    logical, intent(in) :: loaded(:)
    type(path_position), intent(inout) :: position
    integer, intent(out) :: status
    real(dp) :: closing(size(loaded)), reach(size(loaded)), least

    closing = rigid_displacement(canonical%modes, direction)
    where (loaded .or. canonical%excluded) closing = 0.0_dp
    where (abs(closing) <= ROUNDING*maxval(abs(closing))) closing = 0.0_dp
    ! A point that seems to move into the stop where it is does so by rounding.
    where (closing*real(position%weakly_active, dp) > 0.0_dp) closing = 0.0_dp
    reach = huge(least)
    where (closing > 0.0_dp) reach = max(position%gap, 0.0_dp)/closing
    where (closing < 0.0_dp .and. canonical%upper < huge(least))
      reach = max(canonical%upper - position%gap, 0.0_dp)/abs(closing)
    end where
    least = minval(reach)
    status = merge(FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, least < huge(least))
    if (status /= FUGE_DONE) return
    position%motion = position%motion + least*direction
    position%has_rates = .false.
    where (abs(closing) > 0.0_dp)
      position%gap = position%gap - least*closing
      position%state = FUGE_OPEN
      position%force = 0.0_dp
      position%weakly_active = FUGE_OPEN
    end where
    where (reach <= least*(1.0_dp + ROUNDING))
      position%weakly_active = merge(FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, closing > 0.0_dp)
    end where
  end subroutine move_to_stop

end module fuge_path_jump
