!> FUGERM: rigid modes of a body from the positions of its nodes. Arguments in doc/legacy.md.
subroutine fugerm(ndim, nn, x, z, ldz, info)
  use fuge_f77_body, only: check_nodes
  use fuge_kinds, only: dp
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: ndim, nn, ldz
  real(dp), intent(in) :: x(ndim, nn)
  real(dp), intent(inout) :: z(ldz, 3*ndim - 3)
  integer, intent(out) :: info
  type(fuge_info) :: outcome

  call check_nodes(ndim, nn, x, ldz, outcome)
  info = outcome%status
  if (.not. outcome%failed()) z(:ndim*nn, :) = fuge_rigid_modes(x)
end subroutine fugerm
