!> Gradients by the data that the equations of a fixed contact set have linearly: from those by gaps and loads.
!>
!> With p the gradient by the gaps and r that by the resultants, a datum that changes the gap equation at point k by dg
!> and a resultant by dw changes the objective by p dg + r dw.
module fuge_law_gradients
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER
  use fuge_gradients_type, only: fuge_gradients
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_modes, only: add_rigid_displacement
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: displacement_is_lost, find_law_gradients, find_limited, set_displacement

  !> Where the terms of displacements are larger than these by this factor, too many digits cancel.
  real(dp), parameter :: MOST_CANCELLED = 2.0_dp**10

contains

  !> Fill the gradients by compliances, springs on motions, play and modulus from those by gap and load, which
  !> `gradients` has; its arrays have their sizes.
  !>
  !> `displacement` (n) by the forces of `solution`, less `constant`; `weight` the partial derivatives of the objective,
  !> all of them; `translation` that of `free_translation`.
  subroutine find_law_gradients(problem, solution, weight, displacement, constant, translation, space, gradients)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, weight
    real(dp), intent(in) :: displacement(:), constant, translation(:)
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients

    gradients%compliance = solution%force*gradients%gap
    gradients%motion_stiffness = -solution%motion*gradients%load
    if (allocated(problem%prescribed)) where (problem%prescribed) gradients%motion_stiffness = 0.0_dp
    ! The sum of the gradient by the gaps is the weight of the translation.
    gradients%log_modulus = -space%total(dot_product(gradients%gap, displacement)) &
                            - constant*dot_product(translation, weight%motion)
    if (allocated(gradients%gap_upper)) gradients%gap_upper = merge(weight%gap - gradients%gap, 0.0_dp, &
                                                                    is_at_play(problem, solution))
  end subroutine find_law_gradients

  !> Is the gap the play, (n)? A tied point that pulls would do so at an upper stop.
  pure function is_at_play(problem, solution) result(at_play)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical :: at_play(size(solution%state))

    at_play = solution%state == FUGE_AT_UPPER_STOP .or. (solution%state == FUGE_AT_LOWER_STOP &
                                                         .and. solution%force < 0.0_dp)
    if (allocated(problem%excluded)) at_play = at_play .and. .not. problem%excluded
  end function is_at_play

  !> At which points is the force a limit, that of the lower stop or that of the upper one, (n)? Where the limit is zero
  !> the state may be open.
  pure subroutine find_limited(problem, solution, lower, upper)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical, intent(out) :: lower(:), upper(:)

    lower = solution%state == FUGE_LIMITED_LOWER
    upper = solution%state == FUGE_LIMITED_UPPER
    if (allocated(problem%limit)) lower = lower .or. (.not. problem%limit > 0.0_dp .and. solution%gap < 0.0_dp)
    if (allocated(problem%limit_upper) .and. allocated(problem%gap_upper)) then
      upper = upper .or. (.not. problem%limit_upper > 0.0_dp .and. solution%gap > problem%gap_upper)
    end if
    if (.not. allocated(problem%excluded)) return
    lower = lower .and. .not. problem%excluded
    upper = upper .and. .not. problem%excluded
  end subroutine find_limited

  !> The displacements by the forces of `solution` as the gaps show them, A f, less `constant`, (n): no product.
  !> `translation` takes up the constant.
  pure subroutine set_displacement(problem, solution, constant, translation, displacement)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: constant, translation(:)
    real(dp), intent(out) :: displacement(:)

    displacement = solution%gap - problem%gap
    call add_rigid_displacement(problem, solution%motion - constant*translation, displacement)
    if (allocated(problem%compliance)) displacement = displacement - problem%compliance*solution%force
  end subroutine set_displacement

  !> Have displacements by `set_displacement`, the `largest` of all ranks, lost digits beside large gaps, motions or
  !> compliances?
  pure function displacement_is_lost(problem, solution, largest) result(lost)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: largest
    logical :: lost
    logical :: counts(size(problem%gap))
    real(dp) :: most

    most = MOST_CANCELLED*largest
    counts = .true.
    if (allocated(problem%excluded)) counts = .not. problem%excluded
    lost = any(counts .and. max(abs(problem%gap), abs(solution%gap)) > most)
    if (allocated(problem%compliance)) lost = lost .or. any(counts .and. problem%compliance*abs(solution%force) > most)
  end function displacement_is_lost

end module fuge_law_gradients
