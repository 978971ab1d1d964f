!> FUGECX: FUGECP with the angle of an edge, and for bodies of revolution. Arguments in doc/legacy.md.
subroutine fugecx(ndim, nn, x, np, nf, iface, id, nno, xo, npo, nfo, ifaceo, ido, method, norm, nsmth, nkind, d, &
                  reach, crease, nrev, maxn, nw, n, nwmin, idof, dn, gap, nstop, play, area, node, nopp, msg, info)
  use fuge_contact_pairs_search, only: fuge_find_pairs
  use fuge_contact_pairs_type, only: fuge_contact_pairs, fuge_pair_options
  use fuge_f77_pairs, only: check_pair_room, check_surface_sizes, copy_pairs, set_pair_options, set_surface
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  implicit none
  integer, intent(in) :: ndim, nn, np, nf, nno, npo, nfo, method, norm, nsmth, nkind, nrev, maxn, nw
  integer, intent(in) :: iface(np, nf), id(ndim, nn), ifaceo(npo, nfo), ido(ndim, nno)
  real(dp), intent(in) :: x(ndim, nn), xo(ndim, nno), d, reach, crease
  integer, intent(inout) :: n, nwmin, idof(nw, maxn), nstop(maxn), node(maxn), nopp(maxn)
  real(dp), intent(inout) :: dn(nw, maxn), gap(maxn), play(maxn), area(maxn)
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_surface_mesh) :: contact, opposite
  type(fuge_pair_options) :: options
  type(fuge_contact_pairs) :: pairs
  type(fuge_info) :: outcome
  logical :: asks

  asks = maxn == 0
  call check_surface_sizes(ndim, nn, np, nf, '', outcome)
  call check_surface_sizes(ndim, nno, npo, nfo, 'O', outcome)
  call set_pair_options(method, norm, nsmth, nkind, d, reach, options, outcome)
  options%crease = crease
  options%revolution = nrev /= 0
  call set_surface(x, iface, id, contact, outcome)
  call set_surface(xo, ifaceo, ido, opposite, outcome)
  if (.not. outcome%failed()) call fuge_find_pairs(contact, opposite, options, pairs, outcome)
  if (.not. asks) call check_pair_room(pairs, maxn, nw, outcome)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  n = pairs%points()
  nwmin = size(pairs%dof, 1)
  if (.not. asks) call copy_pairs(pairs, idof, dn, gap, nstop, play, area, node, nopp)
end subroutine fugecx
