!> What both methods of pairing find for each node of the contact surface.
module fuge_pair_draft_type
  use fuge_kinds, only: dp
  use fuge_weight_rows, only: start_rows, weight_rows
  implicit none
  private

  public :: start_draft

  !> All sums are weighted; `weight` is the sum of the weights, 0 where a node has no opposite.
  type, public :: pair_draft
    real(dp), allocatable :: weight(:)
    !> Area, or length in the plane, whose pressure the node carries.
    real(dp), allocatable :: area(:)
    !> From the contact surface to the opposite one, and normals of the latter, (3, nodes).
    real(dp), allocatable :: way(:, :), normal(:, :)
    !> Gaps along directions that turn from place to place; those along one direction are in `way`.
    real(dp), allocatable :: gap(:)
    !> The opposite face with the largest share of the weight, that share, and the sum of places in it, (2, nodes).
    integer, allocatable :: face(:)
    real(dp), allocatable :: share(:), place(:, :)
    !> Weights of the nodes of the contact surface and of the opposite one.
    type(weight_rows) :: own, other
    !> Two faces across from each other whose normals point the same way, if any.
    integer :: alike(2) = 0
  end type pair_draft

contains

  !> A draft for `nodes` nodes. `stat` is not zero without memory.
  pure subroutine start_draft(draft, nodes, stat)
    type(pair_draft), intent(inout) :: draft
    integer, intent(in) :: nodes
    integer, intent(out) :: stat

    allocate (draft%weight(nodes), draft%area(nodes), draft%way(3, nodes), draft%normal(3, nodes), draft%gap(nodes), &
              draft%face(nodes), draft%share(nodes), draft%place(2, nodes), stat=stat)
    if (stat == 0) call start_rows(draft%own, nodes, stat)
    if (stat == 0) call start_rows(draft%other, nodes, stat)
    if (stat /= 0) return
    draft%weight = 0.0_dp
    draft%area = 0.0_dp
    draft%way = 0.0_dp
    draft%gap = 0.0_dp
    draft%normal = 0.0_dp
    draft%face = 0
    draft%share = 0.0_dp
    draft%place = 0.0_dp
  end subroutine start_draft

end module fuge_pair_draft_type
