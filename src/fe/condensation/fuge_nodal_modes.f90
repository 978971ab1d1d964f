!> The rigid modes of a body from the positions of its nodes.
module fuge_nodal_modes
  use fuge_kinds, only: dp
  implicit none
  private

  public :: fuge_rigid_modes

contains

  !> Rigid modes of nodes in the plane or in space, for `rigid_modes` of a fuge_body.
  !>
  !> `position` is (2, nodes) or (3, nodes), length. The result has a row for each degree of
  !> freedom, node by node the displacements along the axes, and 3 or 6 columns: the
  !> translations along the axes, then small rotations about axes through the centre of the
  !> nodes, in the plane about z, in space about x, y and z. If a body has rotations among its
  !> degrees of freedom, insert their rows yourself.
  pure function fuge_rigid_modes(position) result(modes)
    real(dp), intent(in) :: position(:, :)
    real(dp) :: modes(size(position), 3*size(position, 1) - 3)
    real(dp) :: arm(3), centre(3)
    integer :: axis, dimensions, node, row

    dimensions = size(position, 1)
    modes = 0.0_dp
    arm = 0.0_dp
    centre = 0.0_dp
    do axis = 1, dimensions
      centre(axis) = sum(position(axis, :))/max(size(position, 2), 1)
    end do
    do node = 1, size(position, 2)
      row = dimensions*(node - 1)
      arm(:dimensions) = position(:, node) - centre(:dimensions)
      do axis = 1, dimensions
        modes(row + axis, axis) = 1.0_dp
      end do
      if (dimensions == 2) then
        modes(row + 1:row + 2, 3) = [-arm(2), arm(1)]
      else
        modes(row + 1:row + 3, 4) = [0.0_dp, -arm(3), arm(2)]
        modes(row + 1:row + 3, 5) = [arm(3), 0.0_dp, -arm(1)]
        modes(row + 1:row + 3, 6) = [-arm(2), arm(1), 0.0_dp]
      end if
    end do
  end function fuge_rigid_modes

end module fuge_nodal_modes
