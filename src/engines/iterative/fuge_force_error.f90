!> An estimate of the error of forces from the residual that they leave, and from the rounding of the products.
!>
!> The residual is a backward error: where the operator is nearly singular on the contact, small residuals belong to
!> large errors. The preconditioned residual divided by the smallest value of Lanczos bounds the error in the norm of
!> the preconditioner (doc/theory.md).
module fuge_force_error
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: max_abs_over
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_projected_gradients, only: precondition_residual
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: estimate_force_error

contains

  !> The largest error of the forces over the largest force, iterate%force_error; no unit, at most 1.
  !>
  !> `iterate` as evaluated last, so that iterate%work holds the magnitudes of the displacements; its residual is changed.
  !> `smallest_value` that of the preconditioned operator on the contact, 0 if unknown: then the preconditioner counts
  !> as the inverse. One preconditioning. Errors: those of the preconditioner.
  subroutine estimate_force_error(operator, scene, preconditioner, smallest_value, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_preconditioner), intent(inout) :: preconditioner
    real(dp), intent(in) :: smallest_value
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: energy, largest, error

    iterate%force_error = 0.0_dp
    largest = max_abs_over(iterate%segments, iterate%force)
    if (.not. largest > 0.0_dp) return
    call add_rounding(iterate)
    call precondition_residual(operator, scene, preconditioner, iterate, energy, info)
    if (info%failed()) return
    error = max_abs_over(iterate%segments, iterate%work)
    if (smallest_value > 0.0_dp) then
      iterate%force_error = 1.0_dp
      if (error < smallest_value*largest) iterate%force_error = error/smallest_value/largest
    else
      iterate%force_error = min(error/largest, 1.0_dp)
    end if
  end subroutine estimate_force_error

  !> Add the rounding of each displacement to the residual, with signs that follow no pattern.
  pure subroutine add_rounding(iterate)
    type(contact_iterate), intent(inout) :: iterate
    integer :: i, k, number

    number = 1
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i)
        ! A linear congruential generator: the same signs in each solve.
        number = modulo(number*4096 + 150889, 714025)
        iterate%residual(k) = iterate%residual(k) &
                              + sign(epsilon(1.0_dp)*abs(iterate%work(k)), real(number, dp) - 357012.0_dp)
      end do
    end do
  end subroutine add_rounding

end module fuge_force_error
