!> FUGEED: the intervals of contact and their edges, from forces on equal cells of a half-plane. Arguments in
!> doc/legacy.md.
subroutine fugeed(n, x, width, f, nelem, nsym, maxi, ni, xleft, xright, eleft, eright, kleft, kright, msg, info)
  use fuge_edge_refinement, only: fuge_contact_edges, fuge_interval
  use fuge_f77_problem, only: check_room
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  integer, intent(in) :: n, nelem, nsym, maxi
  real(dp), intent(in) :: x(n), width(n), f(n)
  integer, intent(inout) :: ni, kleft(maxi), kright(maxi)
  real(dp), intent(inout) :: xleft(maxi), xright(maxi), eleft(maxi), eright(maxi)
  character(len=*), intent(inout) :: msg
  integer, intent(out) :: info
  type(fuge_interval), allocatable :: intervals(:)
  type(fuge_info) :: outcome
  integer :: last

  call check_room(maxi, 'MAXI', outcome)
  if (.not. outcome%failed()) call fuge_contact_edges(x, width, f, nelem, intervals, outcome, nsym /= 0)
  info = outcome%status
  msg = outcome%message
  if (outcome%failed()) return
  ni = size(intervals)
  last = min(ni, maxi)
  xleft(:last) = intervals(:last)%left
  xright(:last) = intervals(:last)%right
  eleft(:last) = intervals(:last)%left_error
  eright(:last) = intervals(:last)%right_error
  kleft(:last) = intervals(:last)%left_kind
  kright(:last) = intervals(:last)%right_kind
end subroutine fugeed
