!> An estimate of the error of forces from the residual that they leave, and from the rounding of the products.
!>
!> The residual is a backward error: where the operator is nearly singular on the contact, small residuals belong to
!> large errors. Divided by the smallest value of Lanczos, the preconditioned residual bounds the error in the norm of
!> the preconditioner (doc/theory.md).
module fuge_iteration_error
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_segments, only: max_abs_over
  use fuge_kinds, only: dp
  implicit none
  private

  public :: estimated_force_error

contains

  !> The largest error of the forces over the largest force; no unit, at most 1.
  !>
  !> `iterate` as evaluated last, so that iterate%work holds the magnitudes of the displacements, which rounding goes
  !> with. What the preconditioner would make of the residual follows from what it made of those before;
  !> `pair_compliance` as least_pair_compliance of fuge_operator, because conjugate gradients do not see forces that
  !> hardly displace anything. Costs two passes over the contact, and no product.
  function estimated_force_error(iterate, pair_compliance) result(error)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: pair_compliance
    real(dp) :: error
    real(dp) :: compliance, largest

    error = 0.0_dp
    largest = max_abs_over(iterate%segments, iterate%force)
    if (.not. largest > 0.0_dp) return
    error = epsilon(error)
    ! Half of it, because the pair has the norm sqrt(2).
    compliance = 0.5_dp*pair_compliance
    if (iterate%least_compliance > 0.0_dp) then
      compliance = min(compliance, iterate%least_compliance)
    else if (compliance >= 0.5_dp*huge(error)) then
      ! Forces that follow from equilibrium alone take no step.
      return
    end if
    associate (length => iterate%residual_norm + epsilon(error)*max_abs_over(iterate%segments, iterate%work))
      error = 1.0_dp
      if (length < compliance*largest) error = length/compliance/largest
    end associate
  end function estimated_force_error

end module fuge_iteration_error
