!> The lengths that decide about an iterate: its errors, and what they are compared with.
module fuge_iterate_lengths
  use fuge_kinds, only: dp
  implicit none
  private

  !> Scaled as the gaps of the scene are.
  type, public :: iterate_lengths
    !> Largest magnitude of gap plus displacement less motion on the contact set.
    real(dp) :: residual_norm = huge(1.0_dp)
    !> Deepest penetration of an open point, 0 if none penetrates.
    real(dp) :: penetration = 0.0_dp
    !> Residuals are compared with this length: the least magnitude at a contact point, as in the
    !> certificate (|gap less rigid motion| plus the magnitude of the displacement).
    real(dp) :: least_magnitude = 0.0_dp
    !> The largest magnitude of a displacement at a contact point, as the certificate forms it.
    real(dp) :: largest_magnitude = 0.0_dp
    !> Lengths up to this are rounding of the gaps and of rigid displacements, beside which there may be no others; 0
    !> where there are no modes.
    real(dp) :: rounding = 0.0_dp
    !> `relative_error` of the forces to start from, no unit; negative before that is known.
    real(dp) :: start_error = -1.0_dp
  contains
    procedure :: allowed
    procedure :: is_accurate
    procedure :: confirm
    procedure :: relative_error
    procedure :: note_start
  end type iterate_lengths

contains

  !> Lengths up to this are within `tolerance`, relative to the least magnitude, or rounding.
  pure function allowed(self, tolerance)
    class(iterate_lengths), intent(in) :: self
    real(dp), intent(in) :: tolerance
    real(dp) :: allowed

    allowed = tolerance*self%least_magnitude + self%rounding
  end function allowed

  !> Is the residual within `tolerance`, or rounding?
  pure function is_accurate(self, tolerance)
    class(iterate_lengths), intent(in) :: self
    real(dp), intent(in) :: tolerance
    logical :: is_accurate

    is_accurate = self%residual_norm <= self%allowed(tolerance)
  end function is_accurate

  !> Is a contact set that these lengths, from a fresh product, belong to confirmed? The residual is within `tolerance`,
  !> or has not halved since the last confirmation, `previous_residual`, which it replaces: then only rounding is left,
  !> and the certificate decides.
  subroutine confirm(self, tolerance, previous_residual, confirmed)
    class(iterate_lengths), intent(in) :: self
    real(dp), intent(in) :: tolerance
    real(dp), intent(inout) :: previous_residual
    logical, intent(out) :: confirmed

    confirmed = self%is_accurate(tolerance) .or. .not. self%residual_norm < 0.5_dp*previous_residual
    previous_residual = self%residual_norm
  end subroutine confirm

  !> The greater of residual norm and penetration over the least magnitude; huge where that is zero.
  pure function relative_error(self) result(error)
    class(iterate_lengths), intent(in) :: self
    real(dp) :: error

    error = max(self%residual_norm, self%penetration)
    if (error > 0.0_dp) then
      if (self%least_magnitude > 0.0_dp .and. error < self%least_magnitude*sqrt(huge(error))) then
        error = error/self%least_magnitude
      else
        error = huge(error)
      end if
    end if
  end function relative_error

  !> The first lengths are those of the forces to start from.
  pure subroutine note_start(self)
    class(iterate_lengths), intent(inout) :: self

    if (self%start_error < 0.0_dp) self%start_error = self%relative_error()
  end subroutine note_start

end module fuge_iterate_lengths
