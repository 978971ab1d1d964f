!> The cells of a surface that carry force, as the search for the largest stress needs them.
module fuge_pressed_cells
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: allocate_cells, is_own_image

  !> Cells on a line (`axes` 1) or on an area (`axes` 2); all carry force.
  type, public :: pressed_cells
    integer :: axes = 1
    !> Is the pressure continuous? Otherwise it jumps from cell to cell, and the stresses near the surface follow the
    !> cells rather than the contact.
    logical :: continuous = .false.
    !> Of cells that are symmetric about x = 0, or y = 0, the search takes those on one side.
    logical :: symmetric(2) = .false.
    !> (axes, cells), length.
    real(dp), allocatable :: centre(:, :), width(:, :)
    !> Mean, or peak of a hat, (cells), force per length squared; compressive positive.
    real(dp), allocatable :: pressure(:)
    !> The stress at the surface of a body under uniform pressure grows with this factor, 1 - 2 poisson.
    real(dp) :: surface_factor = 1.0_dp
    !> Does pressure stress the surface beside it too? In a plane it does not.
    logical :: spreads = .false.
    !> The end of a continuous pressure that is 0 beyond, (axes, places): there the stress at the surface has a cusp.
    real(dp), allocatable :: rim(:, :)
  contains
    procedure :: size_of
    procedure :: least_depth
  end type pressed_cells

  !> The least depth of the search below a cell of uniform pressure, in widths of the cell.
  real(dp), parameter :: RESOLVED_DEPTH = 0.25_dp

contains

  !> Room for a number of cells (FUGE_ERR_MEMORY).
  pure subroutine allocate_cells(axes, number, cells, info)
    integer, intent(in) :: axes, number
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    cells%axes = axes
    allocate (cells%centre(axes, number), cells%width(axes, number), cells%pressure(number), stat=stat)
    call require_memory(stat, 'the', number, 'cells with a force', info)
  end subroutine allocate_cells

  !> Is a cell of a symmetric model its own mirror image? The checks of such models refuse cells that overlap their
  !> images otherwise: none lies between the axis, but for rounding, and half of its width.
  elemental function is_own_image(place, width) result(own)
    real(dp), intent(in) :: place, width
    logical :: own

    own = abs(place) < 0.25_dp*width
  end function is_own_image

  !> A length for a cell: its width, or the side of a square of its area.
  pure function size_of(self, k) result(length)
    class(pressed_cells), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: length

    length = sqrt(self%width(1, k))*sqrt(self%width(self%axes, k))
  end function size_of

  !> Above this depth the stresses below cell k are those of its edges.
  pure function least_depth(self, k) result(depth)
    class(pressed_cells), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: depth

    depth = 0.0_dp
    if (.not. self%continuous) depth = RESOLVED_DEPTH*minval(self%width(:, k))
  end function least_depth

end module fuge_pressed_cells
