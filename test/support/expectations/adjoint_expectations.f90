!> Gradients against derivatives: the reverse of a derivative gives the same number in any direction.
module adjoint_expectations
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_adjoint_solution, only: fuge_solve_adjoint
  use fuge_gradients_type, only: fuge_gradients
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info
  use general_reference, only: draw
  implicit none
  private

  public :: change_of, irreversible

  integer, parameter :: REPORT_LENGTH = 400
  !> Both sums of products, relative to their terms.
  real(dp), parameter :: AGREEMENT = 1.0e-10_dp

contains

  !> What is not as expected of the last solution of `solver`, else blank: for irregular weights and changes, the change
  !> of the objective by the derivative must be that by the gradient. Weights of gaps are left out where `forces_only`.
  function irreversible(solver, operator, problem, solution, forces_only) result(fault)
    type(fuge_solver), intent(in) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    logical, intent(in), optional :: forces_only
    character(len=REPORT_LENGTH) :: fault
    type(fuge_solution) :: change, weight
    type(fuge_gradients) :: gradients
    type(fuge_info) :: info
    real(dp) :: gap_change(size(solution%force)), load_change(size(solution%motion))
    real(dp) :: forward, reverse, terms, units(2)
    integer(int64) :: seed

    seed = 11_int64
    allocate (weight%force(size(gap_change)), weight%gap(size(gap_change)), weight%motion(size(load_change)))
    call draw(seed, gap_change)
    call draw(seed, load_change)
    gap_change = gap_change - 0.4_dp
    load_change = load_change - 0.4_dp
    fault = 'derivative: '
    call solver%derivative(operator, gap_change, load_change, change, info)
    if (info%failed()) then
      fault = trim(fault)//info%message
      return
    end if
    ! Terms of all kinds of one size.
    units = [maxval(abs(change%force)), maxval(abs(change%gap))]
    where (.not. units > 0.0_dp) units = 1.0_dp
    call draw(seed, weight%force)
    call draw(seed, weight%gap)
    call draw(seed, weight%motion)
    weight%force = (weight%force - 0.4_dp)/units(1)
    weight%gap = (weight%gap - 0.4_dp)/units(2)
    weight%motion = (weight%motion - 0.4_dp)/maxval(abs([change%motion, tiny(1.0_dp)]))
    if (present(forces_only)) then
      if (forces_only) deallocate (weight%gap)
    end if
    fault = 'gradient: '
    call fuge_solve_adjoint(solver, operator, problem, solution, weight, gradients, info)
    if (info%failed()) then
      fault = trim(fault)//info%message
      return
    end if
    forward = change_of(weight, change)
    reverse = dot_product(gradients%gap, gap_change) + dot_product(gradients%load, load_change)
    terms = sum(abs(gradients%gap*gap_change)) + sum(abs(gradients%load*load_change)) + 1.0_dp
    fault = ''
    if (.not. abs(forward - reverse) <= AGREEMENT*terms) then
      fault = 'by the derivative '//text(forward)//', by the gradient '//text(reverse)//', terms '//text(terms)
    end if
  end function irreversible

  !> The change of the objective with the weights `weight` for a change of the solution.
  pure function change_of(weight, change) result(total)
    type(fuge_solution), intent(in) :: weight, change
    real(dp) :: total

    total = 0.0_dp
    if (allocated(weight%force)) total = total + dot_product(weight%force, change%force)
    if (allocated(weight%gap)) total = total + dot_product(weight%gap, change%gap)
    if (allocated(weight%motion)) total = total + dot_product(weight%motion, change%motion)
  end function change_of

end module adjoint_expectations
