!> Gradients by the data that the equations of a fixed contact set have linearly: from those by gaps and loads.
!>
!> With p the gradient by the gaps and r that by the resultants, a datum that changes the gap equation at point k by dg
!> and a resultant by dw changes the objective by p dg + r dw.
module fuge_law_gradients
  use fuge_contact_states, only: FUGE_AT_UPPER_STOP
  use fuge_gradients_type, only: fuge_gradients
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_modes, only: add_rigid_displacement
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: find_law_gradients, set_displacement

contains

  !> Fill the gradients by compliances, springs on motions, play and modulus from those by gap and load, which
  !> `gradients` has; its arrays have their sizes.
  !>
  !> `displacement` (n) by the forces of `solution`; `weight` the partial derivatives of the objective.
  subroutine find_law_gradients(problem, solution, weight, displacement, space, gradients)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, weight
    real(dp), intent(in) :: displacement(:)
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients

    gradients%compliance = solution%force*gradients%gap
    gradients%motion_stiffness = -solution%motion*gradients%load
    if (allocated(problem%prescribed)) where (problem%prescribed) gradients%motion_stiffness = 0.0_dp
    gradients%log_modulus = -space%total(dot_product(gradients%gap, displacement))
    if (.not. allocated(gradients%gap_upper)) return
    gradients%gap_upper = merge(-gradients%gap, 0.0_dp, solution%state == FUGE_AT_UPPER_STOP)
    ! There the gap is the play.
    if (allocated(weight%gap)) where (solution%state == FUGE_AT_UPPER_STOP) gradients%gap_upper = gradients%gap_upper &
      + weight%gap
  end subroutine find_law_gradients

  !> The displacements by the forces of `solution`, A f, (n), as the gaps show them: no product.
  subroutine set_displacement(problem, solution, displacement)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(out) :: displacement(:)

    displacement = solution%gap - problem%gap
    call add_rigid_displacement(problem, solution%motion, displacement)
    if (allocated(problem%compliance)) displacement = displacement - problem%compliance*solution%force
  end subroutine set_displacement

end module fuge_law_gradients
