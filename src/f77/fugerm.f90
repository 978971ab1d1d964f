!> FUGERM: rigid modes of a body from the positions of its nodes. Arguments in doc/legacy.md.
subroutine fugerm(ndim, nn, x, z, ldz, info)
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_status, only: fuge_info, FUGE_ERR_SIZE
  implicit none
  integer, intent(in) :: ndim, nn, ldz
  real(dp), intent(in) :: x(ndim, nn)
  real(dp), intent(inout) :: z(ldz, 3*ndim - 3)
  integer, intent(out) :: info
  type(fuge_info) :: outcome
  integer :: k

  info = FUGE_ERR_SIZE
  if (ndim < 2 .or. ndim > 3 .or. nn < 1) return
  ! Not ndim*nn, which might overflow.
  if (ldz/ndim < nn) return
  do k = 1, nn
    call check_finite(x(:, k), 'X', outcome)
    info = outcome%status
    if (outcome%failed()) return
  end do
  z(:ndim*nn, :) = fuge_rigid_modes(x)
end subroutine fugerm
