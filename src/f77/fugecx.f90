!> FUGECX: FUGECP with the angle of an edge, and for bodies of revolution. Arguments in doc/legacy.md.
subroutine fugecx(ndim, nn, x, np, nf, iface, id, nno, xo, npo, nfo, ifaceo, ido, method, norm, nsmth, nkind, d, &
                  reach, crease, nrev, maxn, nw, n, nwmin, idof, dn, gap, nstop, play, area, node, nopp, msg, info)
  use fuge_f77_pairs, only: find_contact_points
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: ndim, nn, np, nf, nno, npo, nfo, method, norm, nsmth, nkind, nrev, maxn, nw
  integer, intent(in) :: iface(np, nf), id(ndim, nn), ifaceo(npo, nfo), ido(ndim, nno)
  real(dp), intent(in) :: x(ndim, nn), xo(ndim, nno), d, reach, crease
  integer, intent(inout) :: n, nwmin, idof(nw, maxn), nstop(maxn), node(maxn), nopp(maxn)
  real(dp), intent(inout) :: dn(nw, maxn), gap(maxn), play(maxn), area(maxn)
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_info) :: outcome

  call find_contact_points(ndim, nn, x, np, nf, iface, id, nno, xo, npo, nfo, ifaceo, ido, method, norm, nsmth, &
                           nkind, d, reach, crease, nrev /= 0, maxn, nw, n, nwmin, idof, dn, gap, &
                           nstop, play, area, node, nopp, outcome)
  info = outcome%status
  msg = outcome%message
end subroutine fugecx
