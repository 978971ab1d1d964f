!> FUGESP: a smooth punch pressed into a half-plane, without a grid; its profile is a subroutine of the caller.
!> Arguments in doc/legacy.md.
subroutine fugesp(profil, xmin, xmax, estar, f0, ntilt, w2, nx, x, p, c, xleft, xright, v0, tilt, &
                  eend, epress, resid, msg, info)
  use fuge_f77_smooth, only: check_places, external_profile, initial_gaps, profile_values
  use fuge_kinds, only: dp
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_punch, only: fuge_solve_smooth_punch
  use fuge_status, only: fuge_info
  implicit none
  procedure(profile_values) :: profil
  integer, intent(in) :: ntilt, nx
  real(dp), intent(in) :: xmin, xmax, estar, f0, w2, x(nx)
  real(dp), intent(inout) :: p(nx), c(nx), xleft, xright, v0, tilt, eend, epress, resid
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(external_profile) :: punch
  type(fuge_smooth_contact) :: contact
  type(fuge_info) :: outcome, places
  real(dp), allocatable :: gap(:)

  punch%lower = xmin
  punch%upper = xmax
  punch%profile => profil
  if (ntilt /= 0) then
    call fuge_solve_smooth_punch(punch, estar, f0, contact, outcome, w2)
  else
    call fuge_solve_smooth_punch(punch, estar, f0, contact, outcome)
  end if
  ! After the solve, which has checked the ends of the profile, and whose warning stays.
  if (.not. outcome%failed()) then
    call check_places(nx, x, punch, places)
    call initial_gaps(punch, x, gap, places)
    if (places%failed()) outcome = places
  end if
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  p = contact%pressure(x)
  c = contact%gap(x, gap)
  xleft = contact%ends(1)
  xright = contact%ends(2)
  v0 = contact%approach
  tilt = contact%tilt
  eend = contact%end_error
  epress = contact%pressure_error
  resid = outcome%residual
end subroutine fugesp
