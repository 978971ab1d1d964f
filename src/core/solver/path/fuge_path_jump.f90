!> Jumps on a path: where the points with force do not resist all motions, and the weakly active ones cannot carry the
!> change of the load, the bodies move at constant forces until other points can.
module fuge_path_jump
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_states, only: is_at_stop, FUGE_OPEN
  use fuge_displacements, only: rigid_displacement
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_law_corners, only: corner_sense, corners_of_state, distance_to_corner, fixed_force, law_corner, MOST_CORNERS
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
      loaded = is_at_stop(position%state) .and. position%weakly_active == FUGE_OPEN
      ! Any point resists the translation of all of them.
      if (canonical%has_translation .and. size(load_rate) == 1 .and. any(loaded)) return
      call find_unresisted_basis(canonical%modes, loaded, position%unresisted)
      if (size(position%unresisted, 2) < 1) return
      call find_equilibrium(canonical%modes, load_rate, merge(-huge(force), 0.0_dp, loaded .or. position%sense() < 0), &
                            merge(huge(force), 0.0_dp, loaded .or. position%sense() > 0), force, motion)
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
    type(law_corner) :: corner(size(loaded))
    integer :: k

    closing = rigid_displacement(canonical%modes, direction)
    where (loaded .or. canonical%excluded) closing = 0.0_dp
    where (abs(closing) <= ROUNDING*maxval(abs(closing))) closing = 0.0_dp
    ! A point that seems to move into the stop where it is does so by rounding.
    where (closing*real(position%sense(), dp) > 0.0_dp) closing = 0.0_dp
    do k = 1, size(loaded)
      if (abs(closing(k)) > 0.0_dp) call leave_corner(canonical, k, position)
      call find_reach(canonical, k, closing(k), position, reach(k), corner(k))
    end do
    least = minval(reach)
    status = merge(FUGE_DONE, FUGE_ERR_NO_EQUILIBRIUM, least < huge(least))
    if (status /= FUGE_DONE) return
    position%motion = position%motion + least*direction
    position%gap = position%gap - least*closing
    position%has_rates = .false.
    do k = 1, size(loaded)
      if (reach(k) <= least*(1.0_dp + ROUNDING)) call position%set_corner(k, corner(k))
    end do
  end subroutine move_to_stop

  !> Point `k` moves away from the stop at which it is without force, or at its limit.
  pure subroutine leave_corner(canonical, k, position)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k
    type(path_position), intent(inout) :: position

    if (position%weakly_active(k) /= FUGE_OPEN) position%state(k) = position%corner(k)%free_state
    position%force(k) = fixed_force(canonical, k, position%state(k))
    call position%set_corner(k, law_corner())
  end subroutine leave_corner

  !> How far point `k`, whose force is fixed, can close by `closing` per unit of the motion until it comes to a corner;
  !> huge if it comes to none.
  pure subroutine find_reach(canonical, k, closing, position, reach, corner)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: k
    real(dp), intent(in) :: closing
    type(path_position), intent(in) :: position
    real(dp), intent(out) :: reach
    type(law_corner), intent(out) :: corner
    type(law_corner) :: corners(MOST_CORNERS)
    integer :: i, number

    reach = huge(reach)
    if (.not. abs(closing) > 0.0_dp) return
    call corners_of_state(canonical, k, position%state(k), corners, number)
    do i = 1, number
      if (.not. corner_sense(corners(i))*closing > 0.0_dp) cycle
      reach = max(distance_to_corner(canonical, k, corners(i), position%state(k), position%gap(k)), 0.0_dp)/abs(closing)
      corner = corners(i)
    end do
  end subroutine find_reach

end module fuge_path_jump
