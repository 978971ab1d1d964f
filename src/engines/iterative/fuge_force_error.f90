!> An estimate of the error of forces from the residual that they leave, and from the rounding of the products.
!>
!> The residual is a backward error: where the operator is nearly singular on the contact, small residuals belong to
!> large errors. Divided by the smallest value of Lanczos, the preconditioned residual bounds the error in the norm of the
!> preconditioner (doc/theory.md).
module fuge_force_error
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
  !> with. What the preconditioner would make of the residual follows from what it made of those before. Costs two
  !> passes over the contact, and no product.
  pure function estimated_force_error(iterate) result(error)
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: error
    real(dp) :: largest

    error = 0.0_dp
    largest = max_abs_over(iterate%segments, iterate%force)
    if (.not. largest > 0.0_dp) return
    error = epsilon(error)
    ! Forces that follow from equilibrium alone take no step.
    if (.not. iterate%smallest_value > 0.0_dp) return
    error = (iterate%residual_norm + epsilon(error)*max_abs_over(iterate%segments, iterate%work))*iterate%amplification
    error = merge(error/iterate%smallest_value/largest, 1.0_dp, error < iterate%smallest_value*largest)
  end function estimated_force_error

end module fuge_force_error
