!> Edges of contact on a half-plane, to third order in the cell width.
!>
!> The contact set gives an edge to half a cell; the forces give it more exactly. `fuge_edge_expansion` finds the
!> pressure at a distance s from the *effective edge* from the forces of four cells,
!>
!>     p = D s^(-3/2) + K s^(-1/2) + L s^(1/2) + M s^(3/2) + ..
!>
!> The forces end at the effective edge; if that were the true edge, K would vanish. D is
!> the discretisation error of L. Moving an edge outwards changes the pressure at the rate
!> -K/2 times the eigensolution with s^(-3/2), which is known for one interval; from this
!> follows the shift for which K = 0. See doc/theory.md, "Edges of the contact".
!>
!> The pressure is another one where it reaches its limit within a few cells of the edge, and on a bed; then
!> `fuge_edge_estimates` places the edge.
module fuge_edge_refinement
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: fuge_contact_edges

  !> Kind of an edge (`left_kind`, `right_kind`): refined, third order in the cell width, on a bed of second order. An
  !> edge of another kind, except FUGE_EDGE_LIMITED, is the outer edge of the last cell in contact.
  integer, parameter, public :: FUGE_EDGE_REFINED = 0
  !> Kind of an edge: not refined, because fewer than five cells are in contact.
  integer, parameter, public :: FUGE_EDGE_FEW_CELLS = 1
  !> Kind of an edge: not refined, because the pressure does not fall like a square root, as under a corner.
  integer, parameter, public :: FUGE_EDGE_SINGULAR = 2
  !> Kind of an edge: not refined, because contact reaches the last cell of the grid.
  integer, parameter, public :: FUGE_EDGE_GRID_END = 3
  !> Kind of an edge: not refined, because the force of one of the first five cells is at its limit. The edge is
  !> estimated from the forces of the others.
  integer, parameter, public :: FUGE_EDGE_LIMITED = 4

  !> One interval of contact: consecutive cells with a positive force.
  type, public :: fuge_interval
    !> Positions of the edges; length.
    real(dp) :: left = 0.0_dp, right = 0.0_dp
    !> Estimates of their errors, to an order of magnitude; length. The width of a cell if they are not refined.
    real(dp) :: left_error = 0.0_dp, right_error = 0.0_dp
    !> Kinds of the edges: FUGE_EDGE_REFINED or why an edge is not refined.
    integer :: left_kind = FUGE_EDGE_FEW_CELLS, right_kind = FUGE_EDGE_FEW_CELLS
    !> Numbers of the first and the last cell, from 1.
    integer :: first = 0, last = 0
  end type fuge_interval

  interface
    !> The intervals of contact and their edges, from forces on a uniform grid.
    !>
    !> `x` (n) centres and `width` (n) widths of the cells, all equal and side by side,
    !> ascending, length; `force` (n), in contact where positive; `element` as for
    !> `fuge_halfplane_matrix`; out: `intervals`, from left to right. `symmetric` (default
    !> .false.): a folded problem, x(1) = 0 or width/2 if it starts on the axis; an interval
    !> that touches the axis is returned whole, left = -right, of others the right image.
    !>
    !> `state` (n), optional, those of the solution: needed where forces have limits. `compliance` (n), optional, length
    !> per force, that of the problem: needed where points have one. These two are the eighth and the ninth argument,
    !> because only problems with a law of the points need them.
    !>
    !> For a smooth gap the error is of third order in the width; of second order with a
    !> small factor if there are other contacts or the far edge is a corner, and on a bed. For FUGE_MEAN the
    !> gap has to be the mean over the cell too; if it is the gap at the centre, pass
    !> FUGE_HAT, whose forces are the same. An edge that cannot be refined is the outer
    !> edge of the last cell with a force, and its kind says why:
    !>
    !> - FUGE_EDGE_FEW_CELLS: fewer than five cells in contact;
    !> - FUGE_EDGE_SINGULAR: the pressure does not fall like a square root there, as under
    !>   a corner;
    !> - FUGE_EDGE_GRID_END: contact reaches the last cell of the grid.
    !>
    !> FUGE_EDGE_LIMITED: the force of one of the first five cells is at its limit, so that the pressure rises to the
    !> limit within a few cells. The forces of the others give the edge to 0.6 cells at worst, 0.25 in the root mean
    !> square. With five cells below the limit an edge is refined as without one.
    !>
    !> On a bed (compliance c per area of a cell, c E* a length) the pressure falls linearly if c E* is more than some
    !> widths, and like a square root if it is much less. The forces decide, by the estimates of the errors. Where
    !> c E* is about a width, neither fits, and the error reaches 0.3 cells.
    !>
    !> Forces of a solve to the tolerance t put an edge of a contact of N cells wrong by up to about t sqrt(N)/2 of its
    !> half width. Beyond some 600 cells that is more than the error of third order for the default t = 1e-10; with
    !> 1e-13 the edges are as exact as the grid allows, and a solve takes up to a sixth longer. The errors of
    !> `intervals` are estimates of both, from how smoothly the forces near an edge follow each other; they grow, too,
    !> where the gap is not smooth from cell to cell.
    !>
    !> The grid is not taken as periodic. Without forces there are no intervals.
    !> Errors, `intervals` untouched: those of `fuge_halfplane_matrix` for the cells;
    !> FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE for `force`; FUGE_ERR_GRID unless the grid is uniform; FUGE_ERR_SIZE for
    !> `state`; FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_LAW, FUGE_ERR_OVERFLOW for `compliance`.
    pure module subroutine fuge_contact_edges(x, width, force, element, intervals, info, symmetric, state, compliance)
      real(dp), intent(in) :: x(:), width(:), force(:)
      integer, intent(in) :: element
      type(fuge_interval), allocatable, intent(inout) :: intervals(:)
      type(fuge_info), intent(out) :: info
      logical, intent(in), optional :: symmetric
      integer, intent(in), optional :: state(:)
      real(dp), intent(in), optional :: compliance(:)
    end subroutine fuge_contact_edges
  end interface

end module fuge_edge_refinement
